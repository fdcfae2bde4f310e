//! What is left of a run.

use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// How a run ended.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RunStatus {
    /// Exit code 0.
    Converged,
    /// Exit code 3: not converged, a mechanism, or an expected value missed.
    NotConverged,
    /// Exit code 3 too: solved on a mesh, or contact boundaries, that cannot hold what the case says.
    Unresolved,
    /// Exit code 2: the case cannot be used as the study makes it.
    Refused,
    /// It took too long and was stopped.
    Timeout,
    /// Anything else.
    Failed,
}

/// What is left of a run.
#[derive(Clone, Debug)]
pub struct Ended {
    /// How it ended.
    pub status: RunStatus,
    /// Why, in words.
    pub reason: String,
    /// `summary.json`; null if there is none.
    pub summary: Value,
    /// From its start to its end, with mpirun.
    pub wall: Duration,
    /// Name of its result under the folder of the study.
    pub result: String,
    /// Where it was made.
    pub machine: String,
}

impl RunStatus {
    /// All of them, the good one first.
    pub const ALL: [RunStatus; 6] = [
        RunStatus::Converged,
        RunStatus::Unresolved,
        RunStatus::NotConverged,
        RunStatus::Refused,
        RunStatus::Timeout,
        RunStatus::Failed,
    ];

    /// As the table has it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::NotConverged => "not_converged",
            Self::Unresolved => "unresolved",
            Self::Refused => "refused",
            Self::Timeout => "timeout",
            Self::Failed => "failed",
        }
    }
}

impl Ended {
    /// Whether it was solved, and has left a summary that says how; that of an interrupted run only says how far it came.
    pub fn has_result(&self) -> bool {
        !self.summary.is_null() && matches!(self.status, RunStatus::Converged | RunStatus::NotConverged | RunStatus::Unresolved)
    }

    /// Whether the run converged to a pressure that can be trusted, as far as is known; the reason goes without saying then.
    pub fn is_good(&self) -> bool {
        let mut contacts = self.summary["contact"].as_object().into_iter().flat_map(|contacts| contacts.values());
        self.status == RunStatus::Converged && contacts.all(|contact| contact["trust"] != false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn ended(trust: Value, status: RunStatus) -> Ended {
        Ended {
            status,
            reason: String::new(),
            summary: json!({ "contact": { "a": { "trust": null }, "b": { "trust": trust } } }),
            wall: Duration::ZERO,
            result: String::new(),
            machine: String::new(),
        }
    }

    #[test]
    fn an_interrupted_run_has_no_result() {
        assert!(ended(Value::Null, RunStatus::NotConverged).has_result());
        assert!(!ended(Value::Null, RunStatus::Timeout).has_result() && !ended(Value::Null, RunStatus::Failed).has_result());
    }

    #[test]
    fn a_pressure_not_to_be_trusted_is_not_good() {
        assert!(ended(json!(true), RunStatus::Converged).is_good() && ended(Value::Null, RunStatus::Converged).is_good());
        assert!(!ended(json!(false), RunStatus::Converged).is_good() && !ended(json!(true), RunStatus::NotConverged).is_good());
    }
}
