//! Finds PETSc and MPI, compiles the C shim, writes the Rust declarations of the PETSc names in [`FUNCTIONS`], and notes what the
//! program is built from.

use std::path::{Path, PathBuf};
use std::process::{Command, exit};

/// Every PETSc function mezha calls, one line per room of `src/petsc`.
const FUNCTIONS: &[&str] = &[
    // session, error, options
    "PetscInitialize|PetscFinalize|PetscPushErrorHandler|PetscPopErrorHandler|PetscErrorMessage",
    "PetscObjectReference|PetscGetVersionNumber",
    "PetscOptionsSetValue|PetscOptionsClearValue|PetscOptionsGetAll|PetscOptionsFindPair",
    "PetscOptionsLeftGet|PetscOptionsLeftRestore",
    // stage
    "PetscLogStage(Register|GetId|Push|Pop)",
    // vector, index_set
    "Vec(Create|SetSizes|SetType|Duplicate|Destroy|GetArray|RestoreArray|GetArrayRead|RestoreArrayRead)",
    "Vec(GetLocalSize|GetSize|GetOwnershipRange|Set|Norm|AXPY|Copy)",
    "VecCreate(SeqWithArray|MPIWithArray)|Vec(Place|Reset)Array",
    "IS(Destroy|GetLocalSize|GetIndices|RestoreIndices)",
    // matrix, nest, shell
    "Mat(Create|SetSizes|SetType|Destroy|SetOption|AssemblyBegin|AssemblyEnd|Norm|Convert)",
    "Mat(SetValues|SetValuesBlocked|Mult|MultAdd|Residual|CreateVecs)",
    "Mat(GetLocalSize|GetSize|GetOwnershipRange)",
    "MatXAIJSetPreallocation|MatCreateNest|MatNestGetISs|MatCreateTranspose",
    "MatCreateShell|MatShell(SetOperation|GetContext)|PCShell(SetContext|GetContext|SetApply|SetDestroy|SetName)",
    // krylov, preconditioner
    "KSP(Create|Destroy|SetOptionsPrefix|GetOptionsPrefix|SetOperators|SetTolerances|SetFromOptions|SetUp|GetPC)",
    "KSP(SetInitialGuessNonzero|Solve|GetConvergedReason|GetConvergedReasonString|GetIterationNumber|GetResidualNorm)",
    "KSP(MonitorSet|GetResidualHistory|SetComputeEigenvalues|ComputeEigenvalues)",
    "PC(Set|Get)ApplicationContext|PC(Destroy|SetType|GetType|GetFailedReason)",
    "PCFieldSplit(SetIS|SetType|SetSchurPre|SetSchurFactType|GetSubKSP)",
    // partition
    "MatCreateMPIAdj|MatPartitioning(Create|Destroy|SetAdjacency|SetType|SetNParts|SetVertexWeights)",
    "MatPartitioning(SetUseEdgeWeights|Apply)",
    // the shim
    "mezha_.*",
];

/// What the program is built from. When one of these changes, the commit is looked up again.
const SOURCES: [&str; 4] = ["src", "build.rs", "Cargo.toml", "Cargo.lock"];

fn main() {
    for path in SOURCES {
        println!("cargo:rerun-if-changed={path}");
    }
    origin();
    let petsc = petsc();
    let includes: Vec<PathBuf> = petsc.include_paths.iter().cloned().chain(mpi_includes()).collect();
    for path in run_time_paths(&petsc) {
        // The library of this PETSc flavour, at run time too: no environment variable is needed.
        println!("cargo:rustc-link-arg=-Wl,-rpath,{}", path.display());
    }

    cc::Build::new().file("src/petsc/shim.c").includes(&includes).warnings(true).extra_warnings(false).compile("mezha_shim");

    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    declarations(&includes, &out.join("petsc.rs"));
}

/// Notes the commit and the compiler for `src/origin.rs`. A commit alone rebuilds nothing: the program is the same before and
/// after it, and says what it was built from then, as in "0123456789ab with changes". `MEZHA_COMMIT` speaks for sources that come
/// without their repository.
fn origin() {
    println!("cargo:rerun-if-env-changed=MEZHA_COMMIT");
    let given = std::env::var("MEZHA_COMMIT").ok().filter(|given| !given.trim().is_empty());
    let commit = given.or_else(commit).unwrap_or_else(|| "unknown".into());
    println!("cargo:rustc-env=MEZHA_COMMIT={}", commit.trim());

    let compiler = std::env::var("RUSTC").ok().and_then(|rustc| first_line(Command::new(rustc).arg("--version")));
    println!("cargo:rustc-env=MEZHA_COMPILER={}", compiler.unwrap_or_else(|| "unknown".into()));
}

/// The commit that is checked out, and whether the sources differ from it. A repository that the sources merely lie in is
/// another project's.
fn commit() -> Option<String> {
    if !Path::new(".git").exists() {
        return None;
    }
    let commit = first_line(Command::new("git").args(["rev-parse", "--short=12", "HEAD"]))?;
    let same = Command::new("git").args(["diff", "--quiet", "HEAD", "--"]).args(SOURCES).status().ok()?.success();
    Some(if same { commit } else { format!("{commit} with changes") })
}

/// The first line that a command prints, if it ends well.
fn first_line(command: &mut Command) -> Option<String> {
    let output = command.output().ok().filter(|output| output.status.success())?;
    String::from_utf8_lossy(&output.stdout).lines().next().map(String::from)
}

/// PETSc: that of `PETSC_DIR` (and `PETSC_ARCH`) if it is set, as PETSc's own users say which one they mean; else what pkg-config
/// calls `PETSc`, and then `PETSc64`, which is Debian's name for the one with 64-bit indices.
fn petsc() -> pkg_config::Library {
    let [chosen, architecture] = ["PETSC_DIR", "PETSC_ARCH"].map(|name| {
        println!("cargo:rerun-if-env-changed={name}");
        std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from)
    });
    let probe = |name: &str| pkg_config::Config::new().atleast_version("3.18").probe(name);
    if let Some(folder) = chosen {
        let file = folder.join(architecture.unwrap_or_default()).join("lib/pkgconfig/PETSc.pc");
        return probe(&file.to_string_lossy()).unwrap_or_else(|error| {
            let words = format!("PETSC_DIR and PETSC_ARCH lead to {}. Correct or unset them.\n\n{error}", file.display());
            missing("the PETSc that PETSC_DIR names, 3.18 or newer,", "libpetsc-real-dev pkg-config", &words)
        });
    }
    probe("PETSc")
        .or_else(|error| probe("PETSc64").map_err(|_| error))
        .unwrap_or_else(|error| missing("PETSc 3.18 or newer", "libpetsc-real-dev pkg-config", &error.to_string()))
}

/// Where PETSc's library lies, if the loader does not look there by itself: Debian's PETSc is a folder of links into the
/// system's own one, which packages must not depend on.
fn run_time_paths(petsc: &pkg_config::Library) -> Vec<PathBuf> {
    let system = |folder: &Path| {
        let above = folder.parent().unwrap_or(folder);
        let names = ["/lib", "/lib64", "/usr/lib", "/usr/lib64"];
        names
            .iter()
            .any(|name| folder == Path::new(name) || above == Path::new(name) && folder.to_string_lossy().ends_with("-linux-gnu"))
    };
    let files = |path: &PathBuf| petsc.libs.iter().map(|name| path.join(format!("lib{name}.so"))).collect::<Vec<_>>();
    let needed = |path: &&PathBuf| {
        let real = |file: PathBuf| file.canonicalize().ok().and_then(|file| file.parent().map(Path::to_path_buf));
        let folders: Vec<PathBuf> = files(path).into_iter().filter_map(real).collect();
        folders.is_empty() || !folders.iter().all(|folder| system(folder))
    };
    petsc.link_paths.iter().filter(needed).cloned().collect()
}

/// Directories with `mpi.h`, as the compiler wrapper tells them.
fn mpi_includes() -> Vec<PathBuf> {
    let output = match Command::new("mpicc").arg("-show").output() {
        Ok(output) if output.status.success() => String::from_utf8_lossy(&output.stdout).into_owned(),
        Ok(output) => missing("the MPI compiler", "libopenmpi-dev", &String::from_utf8_lossy(&output.stderr)),
        Err(error) => missing("the MPI compiler (mpicc)", "libopenmpi-dev", &error.to_string()),
    };
    output.split_whitespace().filter_map(|word| word.strip_prefix("-I")).map(PathBuf::from).collect()
}

/// Writes the declarations of [`FUNCTIONS`] and of the types they need; MPI's own types come from `mpi::ffi`.
fn declarations(includes: &[PathBuf], file: &Path) {
    let mut builder = bindgen::Builder::default()
        .header("src/petsc/shim.h")
        .clang_args(includes.iter().map(|path| format!("-I{}", path.display())))
        .rust_target(bindgen::RustTarget::stable(85, 0).expect("a version that bindgen knows"))
        .rust_edition(bindgen::RustEdition::Edition2024)
        .blocklist_item("MPI_.*|ompi_.*")
        .raw_line("use mpi::ffi::MPI_Comm;")
        .default_enum_style(bindgen::EnumVariation::NewType { is_bitfield: false, is_global: false })
        .constified_enum("PetscBool")
        .allowlist_var("mezha_.*")
        .layout_tests(false)
        .derive_default(true)
        .generate_comments(false);
    for names in FUNCTIONS {
        builder = builder.allowlist_function(format!("({names})"));
    }
    let bindings = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| builder.generate()))
        .unwrap_or_else(|_| missing("libclang", "libclang-dev", "bindgen could not load it"))
        .unwrap_or_else(|error| {
            missing("a header of PETSc, MPI or the compiler", "libpetsc-real-dev libc6-dev libclang-dev", &error.to_string())
        });
    bindings.write_to_file(file).expect("OUT_DIR is writable");
}

/// Ends the build: what was not found, and the Debian packages that bring it.
fn missing(what: &str, packages: &str, detail: &str) -> ! {
    eprintln!(
        "\nmezha: {what} was not found. On Debian 12 and newer:\n\n    apt-get install {packages}\n\nFor other systems see docs/install.md.\n\n{}\n",
        detail.trim()
    );
    exit(1)
}
