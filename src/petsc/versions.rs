//! Versions of the libraries that are loaded.

use super::error::petsc;
use super::ffi::Index;
use std::ptr;

/// PETSc's version, such as `3.18.5`.
pub fn petsc() -> String {
    let [mut major, mut minor, mut patch] = [0; 3];
    petsc!(PetscGetVersionNumber(&mut major, &mut minor, &mut patch, ptr::null_mut())).expect("PETSc knows its version");
    format!("{major}.{minor}.{patch}")
}

/// Bits of PETSc's indices: 32 or 64.
pub fn index_bits() -> u32 {
    Index::BITS
}

/// MPI's name and version, such as `Open MPI v4.1.4`.
pub fn mpi() -> String {
    let text = mpi::environment::library_version().unwrap_or_default();
    text.split([',', '\n', '\0']).next().unwrap_or_default().trim().to_owned()
}

/// Which BLAS is loaded, with its file: `openblas (/usr/lib/...)`, `reference (...)` or `other (...)`.
/// The reference BLAS makes factorisations several times slower.
pub fn blas() -> String {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap_or_default();
    blas_in(maps.lines().filter_map(|line| line.split_whitespace().nth(5)))
}

/// The BLAS among the files of a process: one that names itself goes before a `libblas` of unknown origin.
fn blas_in<'a>(files: impl Iterator<Item = &'a str>) -> String {
    const NAMES: [&str; 4] = ["openblas", "libmkl_", "blis", "atlas"];
    // A BLAS with 64-bit integers comes along with libraries of others; PETSc's own has 32 bits.
    let libraries: Vec<&str> = files.filter(|file| file.contains(".so") && !file.contains("blas64")).collect();
    let named = NAMES.iter().find_map(|name| libraries.iter().find(|file| file.contains(name)).map(|file| (*name, *file)));
    match named {
        Some(("openblas", file)) => format!("openblas ({file})"),
        Some((_, file)) => format!("other ({file})"),
        None => libraries
            .iter()
            .find(|file| file.contains("/libblas.so"))
            .map_or("other (not found)".into(), |file| format!("reference ({file})")),
    }
}

#[cfg(test)]
mod tests {
    use super::blas_in;

    #[test]
    fn the_blas_is_told_by_its_file() {
        let libraries = |blas: &'static str| ["/usr/lib/libc.so.6", "[heap]", blas].into_iter();
        assert!(blas_in(libraries("/usr/lib/x86_64-linux-gnu/openblas-serial/libblas.so.3")).starts_with("openblas (/usr"));
        assert!(blas_in(libraries("/usr/lib/x86_64-linux-gnu/libopenblasp-r0.3.21.so")).starts_with("openblas (/usr"));
        assert!(blas_in(libraries("/usr/lib/x86_64-linux-gnu/blas/libblas.so.3.11.0")).starts_with("reference (/usr"));
        assert!(blas_in(libraries("/usr/lib/x86_64-linux-gnu/atlas/libblas.so.3")).starts_with("other (/usr"));
        let both = ["/usr/lib/openblas64-pthread/libblas64.so.3", "/usr/lib/openblas-serial/libblas.so.3"];
        assert_eq!(blas_in(both.into_iter()), format!("openblas ({})", both[1]));
        assert_eq!(blas_in(libraries("")), "other (not found)");
    }
}
