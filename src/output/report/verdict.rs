//! What everybody wants to know first.

use super::numbers::number;
use super::page::{ExpectedValue, ReportPage};
use crate::output::markup::{HOLDS, MISSED, UNKNOWN, escape, folded, paragraph, subsection, table};
use crate::output::plot::number_text;
use crate::output::summary::{GoalSummary, MOST_TOLD, Status, Summary, WORST, listed};

/// The verdict in a word or two.
pub fn word(status: Status) -> &'static str {
    match status {
        Status::Converged => "Converged",
        Status::NotConverged => "Not converged",
        Status::Unresolved => "Not resolved",
        Status::Interrupted => "Interrupted",
    }
}

/// Status, a sentence, the reason, and what was asked for beside what was reached.
pub fn verdict(page: &ReportPage) -> String {
    let summary = page.summary;
    let reason = clauses(summary.reason.as_deref().unwrap_or_default());
    let rest = if reason.is_empty() { String::new() } else { format!("<p>{}.</p>\n", escape(&capital(&reason.join("; ")))) };
    let class = match summary.status {
        Status::Converged if doubtful(summary).iter().all(Vec::is_empty) => "good",
        Status::Converged => "open",
        _ => "bad",
    };
    format!(
        "<div class=\"verdict {class}\">\n<strong>{}</strong>\n<p>{}</p>\n</div>\n{rest}{}{}",
        word(summary.status),
        escape(&sentence(summary)),
        expected(page.expected),
        goals(summary),
    )
}

/// Contacts whose pressures cannot be trusted, and those of which nothing tells.
fn doubtful(summary: &Summary) -> [Vec<&str>; 2] {
    [Some(false), None].map(|trust| summary.named(|contact| contact.judged.trust == trust))
}

/// The verdict in a sentence.
fn sentence(summary: &Summary) -> String {
    let contacts = |names: &[&str]| {
        let word = if names.len() == 1 { "contact" } else { "contacts" };
        format!("{word} {}", listed(names))
    };
    let [untrusted, untold] = doubtful(summary);
    match summary.status {
        Status::Interrupted => "A signal has ended the run: there is no result, and below stands what was reached.".into(),
        Status::Unresolved => {
            "The equations are solved, but on a mesh, or contact boundaries, that cannot hold what the case says.".into()
        }
        Status::NotConverged => not_converged(summary.reason.as_deref().unwrap_or_default()).into(),
        Status::Converged if !untrusted.is_empty() => {
            format!("The equations are solved, but the pressure of {} cannot be trusted.", contacts(&untrusted))
        }
        Status::Converged if !untold.is_empty() => {
            format!("The equations are solved; nothing tells whether the pressure of {} can be trusted.", contacts(&untold))
        }
        Status::Converged if summary.contact.is_empty() => "The equations are solved.".into(),
        Status::Converged => "The equations are solved, and the contact pressure can be trusted.".into(),
    }
}

/// The sentence on a run that has not converged: the equations may be solved all the same.
fn not_converged(reason: &str) -> &'static str {
    match reason {
        _ if reason.starts_with("expected values are missed") => {
            "The equations are solved, but values that the case expects, and that must hold, are missed."
        }
        _ if reason.starts_with("the accuracy is not reached") => {
            "The equations are solved, but not to the accuracy that was asked for."
        }
        _ => "This is no result to use: figures and numbers below show where the run stood when it ended.",
    }
}

/// A reason in its parts, which semicolons outside of brackets part.
fn clauses(reason: &str) -> Vec<String> {
    let mut depth = 0_i32;
    let parts = reason.split(|letter| {
        depth += match letter {
            '(' => 1,
            ')' => -1,
            _ => 0,
        };
        letter == ';' && depth == 0
    });
    parts.map(|part| part.trim().to_owned()).filter(|part| !part.is_empty()).collect()
}

/// With a capital letter at its beginning.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The error of a value by what is allowed: 0 where anything is, infinite where it is not known.
fn excess(value: &ExpectedValue) -> f64 {
    let known = |most: f64| value.error.filter(|error| !error.is_nan()).map_or(f64::INFINITY, |error| error / most);
    value.tolerance.map_or(0.0, known)
}

/// The values that the case expects; of many the worst, and all of them where the reader asks for them.
fn expected(values: &[ExpectedValue]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let row = |value: &ExpectedValue| {
        let holds = match value.tolerance {
            Some(_) if excess(value) <= 1.0 => HOLDS,
            Some(_) => MISSED,
            None => UNKNOWN,
        };
        let known = |text: &str| if text.is_empty() { UNKNOWN.into() } else { text.to_owned() };
        vec![
            value.name.clone(),
            known(&value.expected),
            known(&value.found),
            number(value.error),
            number(value.tolerance),
            holds.into(),
        ]
    };
    let shown = |values: &[&ExpectedValue]| {
        let rows: Vec<Vec<String>> = values.iter().map(|value| row(value)).collect();
        table(&["", "expected", "reached", "relative error", "allowed", ""], &rows)
    };
    let (all, title) = (values.iter().collect::<Vec<_>>(), subsection("Expected values"));
    if all.len() <= MOST_TOLD {
        return title + &shown(&all);
    }
    let mut worst = all.clone();
    worst.sort_by(|a, b| excess(b).total_cmp(&excess(a)));
    let missed = worst.iter().filter(|value| excess(value) > 1.0).count();
    let words = match missed {
        0 => "None".into(),
        count => count.to_string(),
    };
    let words = format!("{words} of {} values {} missed. The worst {WORST}:", all.len(), if missed > 1 { "are" } else { "is" });
    title + &paragraph(&words) + &shown(&worst[..WORST]) + &folded(&format!("All {} expected values", all.len()), &shown(&all))
}

/// The accuracy that the case asks for.
fn goals(summary: &Summary) -> String {
    let Some(last) = summary.accuracy.as_ref().and_then(|steps| steps.last()) else { return String::new() };
    let mut all = vec![("energy norm".to_owned(), &last.energy)];
    for (name, contact) in &last.contact {
        let goals = [
            ("force", &contact.force),
            ("pressure", &contact.pressure),
            ("largest pressure", &contact.peak),
            ("ends", &contact.ends),
        ];
        all.extend(goals.map(|(what, goal)| (format!("{what} of {name}"), goal)));
    }
    for (name, probe) in &last.probe {
        let goals = [("displacement", &probe.displacement), ("stress", &probe.stress)];
        all.extend(goals.map(|(what, goal)| (format!("{what} at {name}"), goal)));
    }
    let mut all: Vec<(String, &GoalSummary)> = all.into_iter().filter_map(|(name, goal)| Some((name, goal.as_ref()?))).collect();
    let row = |(name, goal): &(String, &GoalSummary)| {
        let holds = if goal.estimate.is_some_and(|estimate| estimate <= goal.asked) { HOLDS } else { MISSED };
        vec![name.clone(), number_text(goal.asked), number(goal.estimate), number(goal.error), holds.into()]
    };
    let count = all.len();
    let mut words = String::new();
    if count > MOST_TOLD {
        let excess = |goal: &GoalSummary| goal.estimate.map_or(f64::INFINITY, |estimate| estimate / goal.asked);
        all.sort_by(|(_, a), (_, b)| excess(b).total_cmp(&excess(a)));
        all.truncate(WORST);
        words = paragraph(&format!("The worst of {count} goals; all of them stand in summary.json."));
    }
    let rows: Vec<Vec<String>> = all.iter().map(row).collect();
    let header = ["", "error asked for", "estimated", "true", ""];
    if rows.is_empty() { String::new() } else { subsection("Accuracy") + &words + &table(&header, &rows) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_expected_values_are_folded_below_the_worst() {
        let value = |k: usize, error: Option<f64>, tolerance: Option<f64>| ExpectedValue {
            name: format!("force of c{k}"),
            error,
            tolerance,
            ..ExpectedValue::default()
        };
        let few: Vec<ExpectedValue> = (0..MOST_TOLD).map(|k| value(k, Some(1e-3), Some(1e-2))).collect();
        let text = expected(&few);
        assert!(!text.contains("<details>") && text.matches("<tr>").count() == 1 + MOST_TOLD, "{text}");
        let mut many =
            [few, vec![value(20, Some(2e-2), Some(1e-2)), value(21, None, Some(1.0)), value(22, Some(9.0), None)]].concat();
        let text = expected(&many);
        let (shown, all) = text.split_once("<details>").expect("a part that is folded");
        assert!(shown.contains("2 of 11 values are missed. The worst 3:"), "{shown}");
        assert!(["c21", "c20", "c0"].iter().all(|name| shown.contains(name)) && !shown.contains("c22"), "{shown}");
        assert!(all.contains("<summary>All 11 expected values</summary>") && all.matches("<tr>").count() == 12, "{all}");
        many[8].error = Some(1e-3);
        assert!(expected(&many).contains("1 of 11 values is missed."));
    }

    #[test]
    fn a_reason_is_parted_outside_of_brackets() {
        let reason = "the set stands; contact a (inf-sup 0.05; oscillation .2); take fewer";
        assert_eq!(clauses(reason), ["the set stands", "contact a (inf-sup 0.05; oscillation .2)", "take fewer"]);
        assert!(clauses("").is_empty());
        assert_eq!((capital("äs"), capital("")), ("Äs".into(), String::new()));
    }
}
