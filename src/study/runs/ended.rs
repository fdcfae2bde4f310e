//! What is left of a run.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// How a run ended, the good ending first, and the worst one last.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RunStatus {
    /// Exit code 0.
    Converged,
    /// Exit code 3: solved on a mesh, or contact boundaries, that cannot hold what the case says.
    Unresolved,
    /// Exit code 3 too: not converged, a mechanism, or an expected value missed.
    NotConverged,
    /// Exit code 2: the case cannot be used as the study makes it.
    Refused,
    /// It took too long and was stopped.
    Timeout,
    /// Anything else.
    Failed,
}

/// What is left of a run; but for its summary and where that is, it is part of its record.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Ended {
    /// How it ended.
    pub status: RunStatus,
    /// Why, in words.
    pub reason: String,
    /// From its start to its end, with mpirun, in seconds.
    pub wall_s: f64,
    /// Seconds that it was given.
    pub timeout_s: f64,
    /// Where it was made.
    pub machine: String,
    /// `summary.json`; null if there is none.
    #[serde(skip)]
    pub summary: Value,
    /// Name of its result under the folder of the study.
    #[serde(skip)]
    pub result: String,
}

impl RunStatus {
    /// All of them, in their order, as the table has them.
    pub const ALL: [(RunStatus, &str); 6] = [
        (RunStatus::Converged, "converged"),
        (RunStatus::Unresolved, "unresolved"),
        (RunStatus::NotConverged, "not_converged"),
        (RunStatus::Refused, "refused"),
        (RunStatus::Timeout, "timeout"),
        (RunStatus::Failed, "failed"),
    ];

    /// As the table has it.
    pub fn words(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// Whether the run was solved, so that its summary says how.
    pub fn is_solved(self) -> bool {
        self <= Self::NotConverged
    }
}

impl Ended {
    /// Whether it was solved, and has left a summary that says how; that of an interrupted run only says how far it came.
    pub fn has_result(&self) -> bool {
        !self.summary.is_null() && self.status.is_solved()
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
            wall_s: 0.0,
            timeout_s: 1.0,
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
