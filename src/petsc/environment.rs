//! Settings that MPI and the libraries under PETSc read from the environment when they start.

use super::versions;
use std::env;

/// Whether this process was started by `mpirun`, and if so whether all of its ranks share one machine.
#[derive(Clone, Copy, PartialEq)]
enum Launch {
    Alone,
    OneNode,
    ManyNodes,
}

/// The first Open MPI with other names for what it is made of.
const RENAMED: u32 = 5;

/// Sets what makes a start quick and a run reproducible, where the user has not set it:
/// one thread per library, a fixed order in PTScotch, and on one node only the transports that are used there. An Open MPI
/// that is told to use what it does not have ends the run.
pub(super) fn prepare() {
    preset("OMP_NUM_THREADS", "1");
    preset("OPENBLAS_NUM_THREADS", "1");
    preset("SCOTCH_PTHREAD_NUMBER", "1");
    let launch = launch();
    if launch != Launch::ManyNodes {
        let is_renamed = open_mpi(&versions::mpi()).is_some_and(|major| major >= RENAMED);
        preset("OMPI_MCA_pml", "ob1");
        preset("OMPI_MCA_btl", if is_renamed { "self,sm" } else { "self,vader" });
        preset("OMPI_MCA_osc", if is_renamed { "^ucx" } else { "pt2pt" });
    }
    if launch == Launch::Alone {
        preset("OMPI_MCA_ess_singleton_isolated", "1");
        // All processes that are isolated have the same name, and would make and remove one folder between them.
        preset("OMPI_MCA_orte_create_session_dirs", "0");
        // MPI looks at every device of the machine and at displays before it starts, and one process alone needs none of them:
        // that was half of the time of a small run.
        preset("HWLOC_COMPONENTS", "-gl,-opencl,-pci,-linuxio");
    }
}

/// The first number of Open MPI's version, if a library that names itself so is one.
fn open_mpi(name: &str) -> Option<u32> {
    name.strip_prefix("Open MPI v")?.split('.').next()?.parse().ok()
}

fn launch() -> Launch {
    match (env::var("OMPI_COMM_WORLD_SIZE"), env::var("OMPI_COMM_WORLD_LOCAL_SIZE")) {
        (Err(_), _) => Launch::Alone,
        (Ok(world), Ok(local)) if world == local => Launch::OneNode,
        _ => Launch::ManyNodes,
    }
}

fn preset(name: &str, value: &str) {
    if env::var_os(name).is_none() {
        // No thread but this one runs before MPI and PETSc have been started.
        unsafe { env::set_var(name, value) };
    }
}

#[cfg(test)]
mod tests {
    use super::open_mpi;

    #[test]
    fn the_version_of_open_mpi_is_told_by_its_name() {
        assert_eq!(open_mpi("Open MPI v4.1.4"), Some(4));
        assert_eq!(open_mpi("Open MPI v5.0.7"), Some(5));
        assert_eq!(open_mpi("Open MPI v10.0.0rc1"), Some(10));
        assert_eq!(open_mpi("MPICH Version:\t4.0.2"), None);
        assert_eq!(open_mpi(""), None);
    }
}
