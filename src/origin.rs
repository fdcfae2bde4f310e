//! What this program was built from.

/// The commit, as in `0123456789ab`, with `with changes` after it if the sources differed from it; `unknown` where the sources
/// came without their repository.
pub const COMMIT: &str = env!("MEZHA_COMMIT");

/// The Rust compiler, as it names itself.
pub const COMPILER: &str = env!("MEZHA_COMPILER");
