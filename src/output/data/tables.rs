//! Tables: all contacts, the points of one contact boundary, and load steps, with a row each.

use super::{SIGNS, csv_line, quoted};
use crate::output::summary::{Status, StepSummary, Summary};
use crate::recovery::TracePoint;

/// Name of the table in a result folder.
pub const CONTACTS: &str = "contacts.csv";

/// A resultant below this share of the force is rounding, as that of a pressure all around: it has no direction.
const ROUNDING: f64 = 1e-6;

const COLUMNS: &str = "name,boundary_1,boundary_2,force,direction_x,direction_y,x,y,width,pressure_max,trust,verdict";

/// The text of `contacts.csv`: a line with the names of the columns, and one for each contact of the summary, given by its name and
/// its two boundaries. What is not known, or does not apply, is left empty.
pub fn contacts_table(contacts: &[(&str, &[String; 2])], summary: &Summary) -> String {
    let row = |(name, [one, two]): &(&str, &[String; 2])| {
        let contact = summary.contact.get(*name)?;
        let least = ROUNDING * contact.force.unwrap_or(0.0).abs();
        let size = contact.resultant.map(|[x, y]| x.hypot(y)).filter(|size| *size > least);
        let along = |axis: usize| Some(contact.resultant?[axis] / size?);
        let place = |axis: usize| contact.place.map(|place| place[axis]);
        let numbers = [contact.force, along(0), along(1), place(0), place(1), contact.width(), contact.pressure_max];
        let trust = contact.judged.trust.map_or(String::new(), |trust| trust.to_string());
        let verdict = quoted(contact.judged.verdict.as_deref().unwrap_or_default());
        Some(csv_line(&[&[*name, one, two].map(quoted)[..], &numbers.map(number_cell), &[trust, verdict]].concat()))
    };
    format!("{COLUMNS}\n{}", contacts.iter().filter_map(row).collect::<String>())
}

/// A column of a table of points of a contact boundary: its name, and what stands there.
type TraceColumn = (&'static str, fn(&TracePoint) -> f64);

/// What is told at each point of a contact boundary, by the names of the columns.
pub const TRACE_COLUMNS: [TraceColumn; 11] = [
    ("s", |p| p.arc),
    ("x", |p| p.x.x),
    ("y", |p| p.x.y),
    ("nx", |p| p.normal.x),
    ("ny", |p| p.normal.y),
    ("lambda", |p| p.lambda),
    ("gap", |p| p.gap),
    ("un_1", |p| p.displacement[0]),
    ("un_2", |p| p.displacement[1]),
    ("sigma_1", |p| p.stress[0]),
    ("sigma_2", |p| p.stress[1]),
];

/// The text of `contact_NAME.csv`: [`SIGNS`] as lines that start with `# `, the names of the columns, one line per point.
///
/// Numbers are the shortest that read back as the same double.
pub fn contact_table(points: &[TracePoint]) -> String {
    let head = SIGNS.iter().map(|line| format!("# {line}\n"));
    let row = |point: &TracePoint| csv_line(&TRACE_COLUMNS.map(|(_, value)| format!("{:?}", value(point))));
    head.chain([csv_line(&TRACE_COLUMNS.map(|(name, _)| name.to_owned()))]).chain(points.iter().map(row)).collect()
}

/// A cell of the table with the name of its column; empty where nothing is known.
type RowValue = (String, Option<f64>);

/// The text of `steps.csv`: a line with the names of the columns, as `summary.json` names the values, and one line per step. What a
/// step does not know is left empty.
pub fn steps_table(steps: &[StepSummary]) -> String {
    let rows: Vec<Vec<RowValue>> = steps.iter().map(cells).collect();
    // A step that could not be solved knows fewer values than the others.
    let Some(columns) = rows.iter().max_by_key(|row| row.len()) else { return String::new() };
    let names = ["step", "status", "iterations"].into_iter().chain(columns.iter().map(|(name, _)| name.as_str()));
    let row = |(step, row): (&StepSummary, &Vec<RowValue>)| {
        let status = match step.status {
            Status::Converged => "converged",
            Status::Unresolved => "unresolved",
            Status::NotConverged | Status::Interrupted => "not_converged",
        };
        let first = [step.step.to_string(), status.into(), step.iterations.iter().sum::<usize>().to_string()];
        let value = |name: &String| row.iter().find(|(own, _)| own == name).and_then(|(_, value)| *value);
        csv_line(&first.into_iter().chain(columns.iter().map(|(name, _)| number_cell(value(name)))).collect::<Vec<_>>())
    };
    csv_line(&names.map(quoted).collect::<Vec<_>>()) + &steps.iter().zip(&rows).map(row).collect::<String>()
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

/// A number as a cell of a table; nothing stands there if it is not known, or not finite.
fn number_cell(number: Option<f64>) -> String {
    number.filter(|number| number.is_finite()).map_or(String::new(), |number| format!("{number:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::output::summary::{ContactSummary, ContactTrust, StepContact};
    use proptest::prelude::*;

    #[test]
    fn a_pressure_all_around_has_no_direction() {
        let cells = |resultant: [f64; 2]| {
            let contact = ContactSummary { force: Some(2.0), resultant: Some(resultant), ..ContactSummary::default() };
            let summary = Summary { contact: [("c".to_owned(), contact)].into(), ..Summary::default() };
            let between = ["a".to_owned(), "b".to_owned()];
            let text = contacts_table(&[("c", &between)], &summary);
            let row: Vec<String> = text.lines().nth(1).expect("a row").split(',').map(String::from).collect();
            [row[4].clone(), row[5].clone()]
        };
        assert_eq!(cells([0.0, -1e-9]), ["", ""]);
        assert_eq!(cells([0.0, -1e-3]).map(|cell| cell.parse::<f64>().expect("a number")), [0.0, -1.0]);
    }

    proptest! {
        #[test]
        fn a_row_reads_back_as_the_contact_was(
            force in proptest::array::uniform2(-1e9..1e9), place in proptest::array::uniform2(-1e-9..1e9),
            closed in proptest::collection::vec(0.0..1.0, 0..4), trust in proptest::option::of(proptest::bool::ANY)
        ) {
            let contact = ContactSummary {
                force: Some(f64::hypot(force[0], force[1])),
                resultant: Some(force),
                place: Some(place),
                closed: Some(closed.iter().map(|width| [3.0, 3.0 + width]).collect()),
                judged: ContactTrust { trust, verdict: Some("not trusted: \"a\"; b".into()), ..ContactTrust::default() },
                ..ContactSummary::default()
            };
            let summary = Summary { contact: [("a,b".to_owned(), contact.clone())].into(), ..Summary::default() };
            let between = ["one.rim".to_owned(), "two \"x\"".to_owned()];
            let text = contacts_table(&[("a,b", &between), ("none", &between)], &summary);
            let lines: Vec<&str> = text.lines().collect();
            prop_assert_eq!(lines.len(), 2, "what is not solved has no row");
            let rest = lines[1].strip_prefix("\"a,b\",one.rim,\"two \"\"x\"\"\",").expect("names");
            let cells: Vec<&str> = rest.splitn(9, ',').collect();
            let number = |at: usize| cells[at].parse::<f64>().expect("a number");
            prop_assert_eq!(number(0), contact.force.unwrap());
            prop_assert!((number(1) * number(0) - force[0]).abs() <= 1e-6 && (number(2) * number(0) - force[1]).abs() <= 1e-6);
            prop_assert_eq!([number(3), number(4), number(5)], [place[0], place[1], contact.width().unwrap()]);
            prop_assert_eq!((cells[6], cells[7]), ("", trust.map_or("", |trust| if trust { "true" } else { "false" })));
            prop_assert_eq!(cells[8], "\"not trusted: \"\"a\"\"; b\"");
        }
    }

    #[test]
    fn numbers_read_back_as_they_were() {
        let point = TracePoint {
            arc: 1.0 / 3.0,
            x: Point::new(-0.0, 1e-300),
            normal: Point::new(0.1 + 0.2, 1.0),
            lambda: std::f64::consts::PI * 1e20,
            gap: -5e-324,
            displacement: [7.0, f64::MAX],
            stress: [f64::MIN_POSITIVE, -1.5e-9],
            ..TracePoint::default()
        };
        let text = contact_table(&[point, point]);
        let mut lines = text.lines().skip_while(|line| line.starts_with("# "));
        assert_eq!(lines.next(), Some("s,x,y,nx,ny,lambda,gap,un_1,un_2,sigma_1,sigma_2"));
        let row: Vec<f64> = lines.next().unwrap().split(',').map(|number| number.parse().unwrap()).collect();
        let TracePoint { arc, x, normal, lambda, gap, displacement, stress, .. } = point;
        assert_eq!(row[..7], [arc, x.x, x.y, normal.x, normal.y, lambda, gap]);
        assert_eq!(row[7..], [displacement, stress].concat());
        assert_eq!(lines.count(), 1);
        assert!(text.lines().all(|line| line.len() < 260));
    }

    #[test]
    fn signs_are_stated_before_the_table() {
        let text = contact_table(&[]);
        assert!(SIGNS.iter().all(|sign| text.contains(&format!("# {sign}\n"))));
        assert_eq!(text.lines().count(), SIGNS.len() + 1);
    }

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
        let text = steps_table(&[unsolved, step(2)]);
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].starts_with("step,status,iterations,factors.press,\"contact.a,b.force\""), "{text}");
        assert_eq!(lines[1], "1,not_converged,0,0.5,,,,,,,,,");
        assert_eq!(lines[2], "2,converged,12,1.0,0.2,,,2.0,,,,,");
    }
}
