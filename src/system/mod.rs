//! The saddle-point system.
