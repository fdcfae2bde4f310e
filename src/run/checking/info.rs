//! `mezha info` and `mezha --version`.

use crate::origin::COMMIT;
use crate::petsc::{Session, versions};

/// Versions of everything that matters.
pub fn info(session: &Session) -> String {
    format!("{}\nBLAS  {}\nranks {}", version(), versions::blas(), session.size())
}

/// Versions of mezha, by its commit too, of PETSc and of MPI; neither of these needs to have started.
pub fn version() -> String {
    let (own, petsc, bits, mpi) = (env!("CARGO_PKG_VERSION"), versions::petsc(), versions::index_bits(), versions::mpi());
    format!("mezha {own}, commit {COMMIT}\nPETSc {petsc}, {bits}-bit indices\nMPI   {mpi}")
}
