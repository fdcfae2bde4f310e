//! `report.html`: all of a result to look at in one file. The verdict stands first, then figures, then numbers.

mod drawings;
mod history;
mod numbers;
mod page;
mod trust;
mod verdict;

pub use page::{ExpectedValue, ReportPage, write_report};
