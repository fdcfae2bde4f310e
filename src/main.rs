//! The command `mezha`.
fn main() {}
