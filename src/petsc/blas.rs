//! The working memory of BLAS.

use super::error::{Error, Result};
use super::ffi;

/// What OpenBLAS takes of the address space with the first product that wants it, whatever the processor (0.3.21, 0.3.29); other
/// libraries take less.
const WORKING_MEMORY: usize = 128 << 20;

/// Makes BLAS take its working memory now. Where OpenBLAS cannot get it, it asks again for ever: so a run under `ulimit -v` would
/// hang in the middle of a solve.
///
/// # Errors
/// [`Error::OutOfMemory`] if there is not as much.
pub fn start_blas() -> Result<()> {
    match unsafe { ffi::mezha_start_blas(WORKING_MEMORY) } {
        0 => Ok(()),
        _ => Err(Error::OutOfMemory { call: format!("BLAS, which wants {} MiB of address space,", WORKING_MEMORY >> 20) }),
    }
}
