//! Settings that MPI and the libraries under PETSc read from the environment when they start.

use std::env;

/// Whether this process was started by `mpirun`, and if so whether all of its ranks share one machine.
#[derive(Clone, Copy, PartialEq)]
enum Launch {
    Alone,
    OneNode,
    ManyNodes,
}

/// Sets what makes a start quick and a run reproducible, where the user has not set it:
/// one thread per library, a fixed order in PTScotch, and on one node only the transports that are used there.
pub(super) fn prepare() {
    preset("OMP_NUM_THREADS", "1");
    preset("OPENBLAS_NUM_THREADS", "1");
    preset("SCOTCH_PTHREAD_NUMBER", "1");
    let launch = launch();
    if launch != Launch::ManyNodes {
        preset("OMPI_MCA_pml", "ob1");
        preset("OMPI_MCA_btl", "self,vader");
        preset("OMPI_MCA_osc", "pt2pt");
    }
    if launch == Launch::Alone {
        preset("OMPI_MCA_ess_singleton_isolated", "1");
        // All processes that are isolated have the same name, and would make and remove one folder between them.
        preset("OMPI_MCA_orte_create_session_dirs", "0");
    }
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
