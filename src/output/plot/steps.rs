//! Load steps: what presses against how far it has gone, and how the contact grows.

use std::fs;
use std::path::Path;

use super::diagrams::{Axis, Diagram, DiagramBlock, LegendRow, Mark, diagrams};
use crate::output::error::OutputError;
use crate::output::summary::{Status, StepContact, StepSummary};

/// What is drawn of a contact.
type DrawnValue = fn(&StepContact) -> Option<f64>;

/// What is drawn of a step.
type OfStep<'s> = Box<dyn Fn(&StepSummary) -> Option<f64> + 's>;

/// Draws `steps.svg`: contact forces against a displacement, widths against forces, widths and largest pressures over the steps.
/// Marks of steps that have not converged are hollow.
///
/// # Errors
/// No step has a contact; the operating system refuses.
pub fn write_step_figure(path: &Path, title: &str, steps: &[StepSummary]) -> Result<(), OutputError> {
    let failed = |reason: String| OutputError::Figure { path: path.into(), reason };
    let text = diagrams(&[block(title, steps)]).map_err(failed)?;
    let text = text.ok_or_else(|| failed("no step has a contact".into()))?;
    fs::write(path, text).map_err(OutputError::io("write", path))
}

/// The diagrams of all contacts.
fn block(title: &str, steps: &[StepSummary]) -> DiagramBlock {
    let mut names: Vec<&String> = steps.iter().flat_map(|step| step.contact.keys()).collect();
    names.sort();
    names.dedup();
    let (way, moved) = displacement(steps);
    let number = |step: &StepSummary| Some(step.step as f64);
    let (force, width, peak): (DrawnValue, DrawnValue, DrawnValue) =
        (|contact| contact.force, |contact| contact.width, |contact| contact.pressure_max);
    let diagram = |title: &str, x: &str, y: &str, marks: &dyn Fn(&str) -> Vec<Mark>| Diagram {
        title: title.into(),
        x: Axis { name: x.into(), logarithmic: false },
        y: Axis { name: y.into(), logarithmic: false },
        behind: Vec::new(),
        lines: names.iter().enumerate().map(|(style, name)| (style, marks(name))).collect(),
    };
    let of = |value: DrawnValue| move |step: &StepSummary, name: &str| step.contact.get(name).and_then(value);
    let against = |x: &dyn Fn(&StepSummary, &str) -> Option<f64>, y: DrawnValue, name: &str| {
        let mark = |step: &StepSummary| {
            let (x, y) = (x(step, name)?, of(y)(step, name)?);
            Some(Mark { x, y, reach: [y, y], hollow: step.status != Status::Converged })
        };
        steps.iter().filter_map(mark).collect::<Vec<Mark>>()
    };
    let (force_axis, width_axis) = ("contact force, per thickness", "contact width, unit of length");
    DiagramBlock {
        title: title.into(),
        legend: names
            .iter()
            .enumerate()
            .map(|(style, name)| LegendRow { style, cells: vec![format!("contact {name}")] })
            .collect(),
        diagrams: vec![
            diagram("Force against displacement", &way, force_axis, &|name| against(&|step, _| moved(step), force, name)),
            diagram("Width against force", force_axis, width_axis, &|name| against(&of(force), width, name)),
            diagram("Width over the steps", "step", width_axis, &|name| against(&|step, _| number(step), width, name)),
            diagram("Largest pressure over the steps", "step", "pressure, unit of stress", &|name| {
                against(&|step, _| number(step), peak, name)
            }),
        ],
    }
}

/// The displacement that says how far the scene has gone, in words and in each step: the shift of the first rigid tool or plate
/// that is shifted, else the displacement of the first probe, else the largest one of a node.
fn displacement(steps: &[StepSummary]) -> (String, OfStep<'_>) {
    let shift = |step: &StepSummary, name: &str| {
        step.rigid.get(name).and_then(|rigid| rigid.motion).map(|motion| motion[0].hypot(motion[1]))
    };
    let is_shifted = |name: &&String| steps.iter().any(|step| shift(step, name).is_some_and(|shift| shift > 0.0));
    if let Some(name) = steps.iter().flat_map(|step| step.rigid.keys()).find(is_shifted) {
        return (format!("shift of {name}, unit of length"), Box::new(move |step| shift(step, name)));
    }
    if let Some(name) = steps.iter().flat_map(|step| step.probe.keys()).next() {
        let moved = move |step: &StepSummary| step.probe.get(name).and_then(|probe| probe.u).map(|u| u[0].hypot(u[1]));
        return (format!("displacement of probe {name}, unit of length"), Box::new(moved));
    }
    ("largest displacement, unit of length".into(), Box::new(|step| step.displacement_max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::summary::{ProbeSummary, RigidSummary};

    fn step(number: usize) -> StepSummary {
        let force = 3.0 * number as f64;
        let seam =
            StepContact { force: Some(force), width: Some(force.sqrt()), pressure_max: Some(1.0), ..StepContact::default() };
        let status = if number == 2 { Status::NotConverged } else { Status::Converged };
        StepSummary {
            step: number,
            status,
            contact: [("seam".into(), seam)].into(),
            displacement_max: Some(0.1 * force),
            ..StepSummary::default()
        }
    }

    fn draw(steps: &[StepSummary]) -> Result<String, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("steps.svg");
        write_step_figure(&path, "press", steps).map(|()| fs::read_to_string(path).unwrap())
    }

    #[test]
    fn the_displacement_is_that_of_a_tool_else_of_a_probe_else_the_largest() {
        let mut steps: Vec<StepSummary> = (1..4).map(step).collect();
        assert!(draw(&steps).unwrap().contains("largest displacement"));
        let probe = ProbeSummary { u: Some([0.3, -0.4]), ..ProbeSummary::default() };
        steps.iter_mut().for_each(|step| _ = step.probe.insert("tip".into(), probe.clone()));
        assert!(draw(&steps).unwrap().contains("displacement of probe tip"));
        assert_eq!(displacement(&steps).1(&steps[0]), Some(0.5));
        let rigid = |y| RigidSummary { motion: Some([0.0, y, 0.1]), ..RigidSummary::default() };
        for (step, y) in steps.iter_mut().zip([0.0, -0.5, -1.0]) {
            step.rigid = [("at_rest".into(), rigid(0.0)), ("die".into(), rigid(y))].into();
        }
        let text = draw(&steps).unwrap();
        assert!(text.contains("shift of die") && text.contains("contact seam") && !text.contains("NaN"));
        assert_eq!(displacement(&steps).1(&steps[2]), Some(1.0));
    }

    #[test]
    fn steps_without_contact_are_no_figure() {
        let steps = [StepSummary { contact: Default::default(), ..step(1) }];
        assert!(matches!(draw(&steps), Err(OutputError::Figure { .. })));
    }
}
