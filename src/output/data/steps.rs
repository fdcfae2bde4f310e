//! Load steps as a table, one row each.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::number_cell;
use super::quoted;
use crate::output::error::OutputError;
use crate::output::summary::{Status, StepSummary};

/// A cell of the table with the name of its column; empty where nothing is known.
type RowValue = (String, Option<f64>);

/// Writes `steps.csv`: a line with the names of the columns, as `summary.json` names the values, and one line per step. What a
/// step does not know is left empty.
///
/// # Errors
/// The operating system refuses.
pub fn write_steps(path: &Path, steps: &[StepSummary]) -> Result<(), OutputError> {
    File::create(path).and_then(|file| write_rows(BufWriter::new(file), steps)).map_err(OutputError::io("write", path))
}

fn write_rows(mut out: impl Write, steps: &[StepSummary]) -> std::io::Result<()> {
    let rows: Vec<Vec<RowValue>> = steps.iter().map(cells).collect();
    // A step that could not be solved knows fewer values than the others.
    let Some(columns) = rows.iter().max_by_key(|row| row.len()) else { return Ok(()) };
    let names: Vec<String> = columns.iter().map(|(name, _)| quoted(name)).collect();
    writeln!(out, "step,status,iterations,{}", names.join(","))?;
    for (step, row) in steps.iter().zip(&rows) {
        let status = match step.status {
            Status::Converged => "converged",
            Status::Unresolved => "unresolved",
            Status::NotConverged | Status::Interrupted => "not_converged",
        };
        write!(out, "{},{status},{}", step.step, step.iterations.iter().sum::<usize>())?;
        for (name, _) in columns {
            let value = row.iter().find(|(own, _)| own == name).and_then(|(_, value)| *value);
            write!(out, ",{}", number_cell(value))?;
        }
        writeln!(out)?;
    }
    out.flush()
}

/// Everything of a step that is a number.
fn cells(step: &StepSummary) -> Vec<RowValue> {
    let mut all: Vec<RowValue> = step.factors.iter().map(|(name, &value)| (format!("factors.{name}"), Some(value))).collect();
    for (name, contact) in &step.contact {
        all.push((format!("contact.{name}.force"), contact.force));
        all.extend(vector(&format!("contact.{name}.resultant"), ["x", "y"], contact.resultant));
        all.push((format!("contact.{name}.width"), contact.width));
        all.push((format!("contact.{name}.pressure_max"), contact.pressure_max));
    }
    for (name, support) in &step.support {
        all.extend(vector(&format!("support.{name}.reaction"), ["x", "y"], support.reaction));
    }
    for (name, rigid) in &step.rigid {
        all.extend(vector(&format!("rigid.{name}.motion"), ["ux", "uy", "angle"], rigid.motion));
        all.extend(vector(&format!("rigid.{name}.force"), ["x", "y"], rigid.force));
        all.push((format!("rigid.{name}.moment"), rigid.moment));
    }
    for (name, probe) in &step.probe {
        all.extend(vector(&format!("probe.{name}.u"), ["x", "y"], probe.u));
        all.extend(vector(&format!("probe.{name}.stress"), ["xx", "yy", "xy"], probe.stress));
    }
    let whole = [
        ("displacement_max", step.displacement_max),
        ("energy", step.energy),
        ("external_work", step.external_work),
        ("seconds", step.seconds),
    ];
    all.extend(whole.map(|(name, value)| (name.into(), value)));
    all
}

/// The components of a vector, each with its own name behind that of the vector.
fn vector<const N: usize>(name: &str, axes: [&str; N], vector: Option<[f64; N]>) -> [RowValue; N] {
    std::array::from_fn(|k| (format!("{name}.{}", axes[k]), vector.map(|vector| vector[k])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::StepContact;

    fn step(number: usize) -> StepSummary {
        let seam = StepContact { force: Some(0.1 * number as f64), width: Some(2.0), ..StepContact::default() };
        StepSummary {
            step: number,
            factors: [("press".into(), 0.5 * number as f64)].into(),
            status: Status::Converged,
            contact: [("a,b".into(), seam)].into(),
            iterations: vec![7, 5],
            ..StepSummary::default()
        }
    }

    #[test]
    fn a_step_is_a_row_and_what_it_does_not_know_is_empty() {
        let unsolved =
            StepSummary { contact: Default::default(), status: Status::NotConverged, iterations: Vec::new(), ..step(1) };
        let mut text = Vec::new();
        write_rows(&mut text, &[unsolved, step(2)]).unwrap();
        let text = String::from_utf8(text).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].starts_with("step,status,iterations,factors.press,\"contact.a,b.force\""), "{text}");
        assert_eq!(lines[1], "1,not_converged,0,0.5,,,,,,,,,");
        assert_eq!(lines[2], "2,converged,12,1.0,0.2,,,2.0,,,,,");
    }
}
