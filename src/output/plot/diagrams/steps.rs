//! Load steps: what presses against how far it has gone, and how the contact grows.

use std::path::Path;

use super::blocks::{DiagramBlock, diagrams};
use super::diagram::{Diagram, DiagramLine, Mark};
use crate::output::data::write_text;
use crate::output::error::OutputError;
use crate::output::plot::drawing::{Axis, LegendCell};
use crate::output::summary::{Status, StepContact, StepSummary};
use crate::output::units::{Unit, Units};

/// What is drawn of a contact in a step.
type DrawnValue<'s> = &'s dyn Fn(&StepSummary, &StepContact) -> Option<f64>;

/// What is drawn of a step.
type OfStep<'s> = Box<dyn Fn(&StepSummary) -> Option<f64> + 's>;

/// Draws `steps.svg`: contact forces against a displacement, widths against forces, widths and largest pressures over the steps.
/// Marks of steps that have not converged are hollow.
///
/// # Errors
/// No step has a contact; the operating system refuses.
pub fn write_step_figure(path: &Path, title: &str, steps: &[StepSummary], units: &Units) -> Result<(), OutputError> {
    let failed = || OutputError::Figure { path: path.into(), reason: "no step has a contact".into() };
    write_text(path, &diagrams(&[block(title, steps, units)]).ok_or_else(failed)?)
}

/// The diagrams of all contacts.
fn block(title: &str, steps: &[StepSummary], units: &Units) -> DiagramBlock {
    let mut names: Vec<&String> = steps.iter().flat_map(|step| step.contact.keys()).collect();
    names.sort();
    names.dedup();
    let (way, moved) = displacement(steps, units.length());
    let diagram = |title: &str, [x, y]: [(&str, DrawnValue); 2]| {
        let axis = |name: &str| Axis { name: name.into(), ..Axis::default() };
        let mark = |step: &StepSummary, name: &str| {
            let contact = step.contact.get(name)?;
            Some(Mark::at(x.1(step, contact)?, y.1(step, contact)?, step.status != Status::Converged))
        };
        let marks = |name: &String| steps.iter().filter_map(|step| mark(step, name)).collect();
        let line = |(style, name): (usize, &&String)| DiagramLine { style, marks: marks(name), ..DiagramLine::default() };
        let lines = names.iter().enumerate().map(line).collect();
        Diagram { title: title.into(), x: axis(x.0), y: axis(y.0), lines, ..Diagram::default() }
    };
    let way: (&str, DrawnValue) = (&way, &|step, _| moved(step));
    let number: (&str, DrawnValue) = ("step", &|step, _| Some(step.step as f64));
    let [of_force, of_width, of_peak] = [
        units.resultant().axis("contact force", Some("per thickness")),
        units.length().axis("contact width", None),
        units.stress().axis("pressure", None),
    ];
    let force: (&str, DrawnValue) = (&of_force, &|_, contact| contact.force);
    let width: (&str, DrawnValue) = (&of_width, &|_, contact| contact.width);
    let peak: (&str, DrawnValue) = (&of_peak, &|_, contact| contact.pressure_max);
    let entry = |(style, name): (usize, &&String)| vec![LegendCell::marked(format!("contact {name}"), style)];
    DiagramBlock {
        title: title.into(),
        legend: names.iter().enumerate().map(entry).collect(),
        diagrams: vec![
            diagram("Force against displacement", [way, force]),
            diagram("Width against force", [force, width]),
            diagram("Width over the steps", [number, width]),
            diagram("Largest pressure over the steps", [number, peak]),
        ],
    }
}

/// The displacement that says how far the scene has gone, in words and in each step: the shift of the first rigid tool or plate
/// that is shifted, else the displacement of the first probe, else the largest one of a node.
fn displacement<'s>(steps: &'s [StepSummary], unit: Unit) -> (String, OfStep<'s>) {
    let shift = |step: &StepSummary, name: &str| {
        step.rigid.get(name).and_then(|rigid| rigid.motion).map(|motion| motion[0].hypot(motion[1]))
    };
    let is_shifted = |name: &&String| steps.iter().any(|step| shift(step, name).is_some_and(|shift| shift > 0.0));
    if let Some(name) = steps.iter().flat_map(|step| step.rigid.keys()).find(is_shifted) {
        return (unit.axis(&format!("shift of {name}"), None), Box::new(move |step| shift(step, name)));
    }
    if let Some(name) = steps.iter().flat_map(|step| step.probe.keys()).next() {
        let moved = move |step: &StepSummary| step.probe.get(name).and_then(|probe| probe.u).map(|u| u[0].hypot(u[1]));
        return (unit.axis(&format!("displacement of probe {name}"), None), Box::new(moved));
    }
    (unit.axis("largest displacement", None), Box::new(|step| step.displacement_max))
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

    fn units() -> Units {
        Units::new(Some("mm"), Some("N"), false)
    }

    fn draw(steps: &[StepSummary]) -> Result<String, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("steps.svg");
        write_step_figure(&path, "press", steps, &units()).map(|()| std::fs::read_to_string(path).unwrap())
    }

    #[test]
    fn the_displacement_is_that_of_a_tool_else_of_a_probe_else_the_largest() {
        let mut steps: Vec<StepSummary> = (1..4).map(step).collect();
        let text = draw(&steps).unwrap();
        assert!(
            text.contains("largest displacement, mm") && text.contains("contact force, N/mm") && text.contains("pressure, MPa")
        );
        let probe = ProbeSummary { u: Some([0.3, -0.4]), ..ProbeSummary::default() };
        steps.iter_mut().for_each(|step| _ = step.probe.insert("tip".into(), probe.clone()));
        assert!(draw(&steps).unwrap().contains("displacement of probe tip"));
        assert_eq!(displacement(&steps, units().length()).1(&steps[0]), Some(0.5));
        let rigid = |y| RigidSummary { motion: Some([0.0, y, 0.1]), ..RigidSummary::default() };
        for (step, y) in steps.iter_mut().zip([0.0, -0.5, -1.0]) {
            step.rigid = [("at_rest".into(), rigid(0.0)), ("die".into(), rigid(y))].into();
        }
        let text = draw(&steps).unwrap();
        assert!(text.contains("shift of die") && text.contains("contact seam") && !text.contains("NaN"));
        assert_eq!(displacement(&steps, units().length()).1(&steps[2]), Some(1.0));
    }

    #[test]
    fn steps_without_contact_are_no_figure() {
        let steps = [StepSummary { contact: Default::default(), ..step(1) }];
        assert!(matches!(draw(&steps), Err(OutputError::Figure { .. })));
    }
}
