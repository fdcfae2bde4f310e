//! `report.html`: all of a result to look at in one file. The verdict stands first, then figures, then numbers.

mod drawings;
mod history;
mod layout;
mod numbers;
mod page;
mod trust;
mod verdict;

pub use layout::write_report;
pub use page::{ExpectedValue, ReportPage};
