//! Tables of what the solution says.

use serde_json::Value;

use super::page::{ReportPage, TableColumn, count, exact, long_table, number, table_of, trust_word};
use crate::output::data::CONTACTS;
use crate::output::markup::{UNKNOWN, paragraph, subsection, table};
use crate::output::plot::number_text;
use crate::output::summary::{ContactSummary, ProbeSummary, RigidSummary, Summary};

/// Intervals of one contact that are named one by one.
const MOST_INTERVALS: usize = 6;

fn pair(vector: Option<[f64; 2]>) -> [String; 2] {
    [0, 1].map(|axis| exact(vector.map(|vector| vector[axis])))
}

/// What each contact carries, and where it is closed.
pub fn contacts(page: &ReportPage) -> String {
    let summary = page.summary;
    if summary.contact.is_empty() {
        return String::new();
    }
    let (length, units) = (summary.units.length(), &summary.units);
    let (force, largest) = (units.resultant().of("force ∫λ ds"), units.stress().of("largest λ"));
    let [closed_length, whole] = ["closed length", "whole length"].map(|what| length.of(what));
    let columns: [TableColumn<(&String, &[String; 2], &ContactSummary)>; 7] = [
        ("contact", &|(name, ..)| (*name).clone()),
        ("between", &|(_, bodies, _)| bodies.join(", ")),
        (&force, &|(.., contact)| exact(contact.force)),
        (&largest, &|(.., contact)| exact(contact.pressure_max)),
        (&closed_length, &|(.., contact)| number(contact.width())),
        (&whole, &|(.., contact)| number(contact.length)),
        ("pressure", &|(.., contact)| trust_word(contact.judged.trust)),
    ];
    let told = page.told().filter_map(|(name, bodies)| Some((name, bodies, summary.contact.get(name)?)));
    let all = summary.contacts_in_words().map(|words| {
        paragraph(&format!("{words}.")) + &paragraph(&format!("These are the worst and the largest; all stand in {CONTACTS}."))
    });
    all.unwrap_or_default() + &table_of(&columns, told, None) + &closed(summary)
}

/// The intervals that press, as lengths and as places.
fn closed(summary: &Summary) -> String {
    let mut rows = Vec::new();
    let mut left = 0;
    for (name, contact) in summary.contacts_told() {
        let (arcs, places) =
            (contact.closed.as_deref().unwrap_or_default(), contact.closed_points.as_deref().unwrap_or_default());
        // What is rounding beside the contact is zero.
        let tiny = 1e-9 * contact.length.unwrap_or(0.0);
        let place = |end: [f64; 2]| {
            let [x, y] = end.map(|x| number(Some(if x.abs() < tiny { 0.0 } else { x })));
            format!("({x}, {y})")
        };
        for (at, [from, to]) in arcs.iter().enumerate().take(MOST_INTERVALS) {
            let numbers = [*from, *to, to - from].map(number_text);
            let ends = places.get(at).map_or([UNKNOWN; 2].map(String::from), |ends| ends.map(place));
            rows.push([vec![name.to_owned(), (at + 1).to_string()], numbers.into(), ends.into()].concat());
        }
        left += arcs.len().saturating_sub(MOST_INTERVALS);
    }
    if rows.is_empty() {
        return paragraph("Nothing presses anywhere.");
    }
    let more = if left > 0 { paragraph(&format!("{left} more intervals stand in summary.json.")) } else { String::new() };
    let heads = ["from s", "to s", "length", "from (x, y)", "to (x, y)"].map(|what| summary.units.length().of(what));
    let header: Vec<&str> = ["contact", "interval"].into_iter().chain(heads.iter().map(String::as_str)).collect();
    subsection("Intervals in contact") + &table(&header, &rows) + &more
}

/// Forces of contacts, supports and rigid tools, balances and energies.
pub fn forces(page: &ReportPage) -> String {
    let summary = page.summary;
    let row = |name: String, force: Option<[f64; 2]>, moment: Option<f64>, about: String| {
        let [x, y] = pair(force);
        vec![name, x, y, exact(moment), about]
    };
    let contacts = summary.contacts_told().map(|(name, contact)| {
        let [_, two] = page.bodies(name);
        row(format!("contact {name}, on {two}"), contact.resultant, contact.moment, "the origin".into())
    });
    let supports = summary.support.iter().map(|(name, support)| {
        let about = support.moment.map_or(UNKNOWN, |_| "the middle of the body");
        row(format!("support {name}, on the bodies"), support.reaction, support.moment, about.into())
    });
    let rigid = summary.rigid.iter().map(|(name, rigid)| {
        let about = rigid.about.map_or(UNKNOWN.into(), |[x, y]| format!("({}, {})", number_text(x), number_text(y)));
        row(format!("rigid {name}, on the bodies"), rigid.force, rigid.moment, about)
    });
    let rows = contacts.chain(supports).chain(rigid).collect();
    let [x, y] = ["force x", "force y"].map(|what| summary.units.resultant().of(what));
    let forces = long_table(&["", &x, &y, "moment", "about"], rows, "summary.json");
    forces + &motions(summary) + &balances(summary) + &energies(summary)
}

/// A table below a title; nothing if it is empty.
fn titled(title: &str, table: String) -> String {
    if table.is_empty() { table } else { subsection(title) + &table }
}

fn motions(summary: &Summary) -> String {
    let row = |(name, rigid): (&String, &RigidSummary)| {
        let [x, y, turn] = rigid.motion?.map(|value| number(Some(value)));
        Some(vec![name.clone(), x, y, turn])
    };
    let rows: Vec<Vec<String>> = summary.rigid.iter().filter_map(row).collect();
    let [x, y] = ["shift x", "shift y"].map(|what| summary.units.length().of(what));
    titled("Motions of what is rigid", table(&["rigid", &x, &y, "turn (radians)"], &rows))
}

fn balances(summary: &Summary) -> String {
    let balance = &summary.balance;
    let balances = [
        ("forces of each contact on its two bodies", balance.force),
        ("moments of each contact on its two bodies", balance.moment),
        ("loads, reactions and contact on each body", balance.bodies),
        ("twice the strain energy and the work done", balance.energy),
    ];
    let rows = balances.iter().filter(|(_, value)| value.is_some());
    let rows: Vec<Vec<String>> = rows.map(|(name, value)| vec![(*name).into(), number(*value)]).collect();
    titled("Balances: what should be zero, relative", table(&["", "difference"], &rows))
}

fn energies(summary: &Summary) -> String {
    let energy = &summary.energy;
    let of_bodies = energy.strain.iter().map(|(name, value)| (format!("strain energy of {name}"), *value));
    let whole = [
        ("strain energy in all", energy.total),
        ("energy in elastic supports", energy.springs),
        ("work of loads and of prescribed displacements, without the factor ½", energy.external_work),
    ];
    let all = of_bodies.chain(whole.map(|(name, value)| (name.to_owned(), value))).filter(|(_, value)| value.is_some());
    let rows = all.map(|(name, value)| vec![name, exact(value)]).collect();
    titled("Energies", long_table(&["", "energy"], rows, "summary.json"))
}

/// Displacement and stress at the points asked for, and the largest values of the bodies.
pub fn points(page: &ReportPage) -> String {
    let summary = page.summary;
    let row = |(name, probe): (&String, &ProbeSummary)| {
        let ([x, y], [ux, uy]) = (pair(probe.x), pair(probe.u));
        let stress = (0..3).map(|at| exact(probe.stress.map(|stress| stress[at])));
        [name.clone(), x, y, ux, uy].into_iter().chain(stress).collect()
    };
    let rows: Vec<Vec<String>> = summary.probe.iter().map(row).collect();
    let lengths = ["x", "y", "u x", "u y"].map(|what| summary.units.length().of(what));
    let stresses = ["σ xx", "σ yy", "σ xy"].map(|what| summary.units.stress().of(what));
    let heads = lengths.iter().chain(&stresses).map(String::as_str);
    let probes = table(&std::iter::once("point").chain(heads).collect::<Vec<_>>(), &rows);
    let row = |(name, strain): (&String, &Option<f64>)| {
        vec![name.clone(), number(*strain), number(summary.rotation_max.get(name).copied().flatten())]
    };
    let rows: Vec<Vec<String>> = summary.strain_max.iter().map(row).collect();
    let bodies = long_table(&["body", "largest strain", "largest rotation (radians)"], rows, "summary.json");
    let unit = summary.units.length().after();
    let largest =
        summary.displacement_max.map(|u| paragraph(&format!("The largest displacement of a node is {}{unit}.", number_text(u))));
    probes + &bodies + &largest.unwrap_or_default()
}

/// Sizes, solver, times and memory.
pub fn effort(page: &ReportPage) -> String {
    let Summary { mesh, unknowns, solver, time_s: time, memory_mib: memory, .. } = page.summary;
    let unit = page.summary.units.length().after();
    let seconds = |values: &[Option<f64>]| {
        let words: Option<Vec<String>> = values.iter().map(|value| value.map(|seconds| format!("{seconds:.2} s"))).collect();
        words.map(|words| words.join(", "))
    };
    let mib = |value: Option<f64>| value.filter(|mib| mib.is_finite()).map(|mib| format!("{mib:.0} MiB"));
    let counted = |value: Option<u64>| value.map(|value| count(value as usize));
    let iterations = |all: &[usize]| {
        let words: Vec<String> = all.iter().map(usize::to_string).collect();
        (!all.is_empty()).then(|| words.join(" "))
    };
    let coarse = solver
        .coarse
        .iter()
        .map(|solve| (format!("iterations on refinement {}, before", solve.refine), iterations(&solve.iterations)));
    let rows = [
        ("triangles", counted(mesh.triangles)),
        ("order of the displacement", mesh.order.map(|order| format!("P{order}"))),
        (
            "edges",
            mesh.h_min.zip(mesh.h_max).map(|(least, most)| format!("{} to {}{unit}", number_text(least), number_text(most))),
        ),
        ("displacement unknowns", counted(unknowns.displacement)),
        ("contact pressures", counted(unknowns.multiplier)),
        ("ranks", Some(page.summary.ranks.to_string())),
        ("solver", solver.krylov.clone().or(solver.name.clone())),
        ("iterations of each linear solve", iterations(&solver.iterations)),
        ("relative residual", solver.residual.map(number_text)),
        ("time in all", seconds(&[time.total])),
        ("time of mesh, contact, assembly", seconds(&[time.mesh, time.contact, time.assemble])),
        ("time of set-up, solves, output so far", seconds(&[time.setup, time.solve, time.output])),
        ("memory of the largest rank", mib(memory.max_rank)),
        ("memory in all", mib(memory.sum)),
    ];
    let rows = rows.map(|(name, value)| (name.to_owned(), value)).into_iter().chain(coarse);
    let rows: Vec<Vec<String>> = rows.filter_map(|(name, value)| Some(vec![name, value?])).collect();
    table(&["", ""], &rows)
}

/// Who has made this result, of what and where, as far as the summary tells.
pub fn provenance(page: &ReportPage) -> String {
    let told = serde_json::to_value(&page.summary.provenance).unwrap_or_default();
    let words = |value: &Value| match value {
        Value::Null => None,
        Value::String(text) => (!text.is_empty()).then(|| text.clone()),
        Value::Array(list) if list.iter().all(Value::is_string) => {
            Some(list.iter().filter_map(Value::as_str).collect::<Vec<_>>().join(" "))
        }
        other => Some(other.to_string()),
    };
    let row = |(key, value): (&String, &Value)| Some(vec![key.replace('_', " "), words(value)?]);
    table(&["", ""], &told.as_object().into_iter().flatten().filter_map(row).collect::<Vec<_>>())
}
