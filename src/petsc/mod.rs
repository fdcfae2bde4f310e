//! The safe layer over PETSc and MPI.
