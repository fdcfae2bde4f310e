//! What everybody wants to know first.

use super::page::{ExpectedValue, ReportPage, TableColumn, number, table_of};
use crate::output::markup::{HOLDS, MISSED, UNKNOWN, escape, folded, paragraph, subsection, table};
use crate::output::plot::number_text;
use crate::output::summary::{GoalSummary, MOST_TOLD, Status, Summary, WORST, capital, clauses, listed};

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
    let line = |clause: &&str| format!("<li>{}</li>\n", escape(clause));
    let rest = match &reason[..] {
        [] => String::new(),
        [one] => format!("<p>{}.</p>\n", escape(&capital(one))),
        all => format!("<ul>\n{}</ul>\n", all.iter().map(line).collect::<String>()),
    };
    let class = match summary.status {
        Status::Converged if doubtful(summary).iter().all(Vec::is_empty) => "good",
        Status::Converged => "open",
        _ => "bad",
    };
    let doubt = if class == "open" && !doubtful(summary)[0].is_empty() { ", not trusted" } else { "" };
    let (word, sentence) = (word(summary.status), escape(&sentence(summary)));
    let tables = expected(page.expected) + &goals(summary);
    format!("<div class=\"verdict {class}\">\n<strong>{word}{doubt}</strong>\n<p>{sentence}</p>\n</div>\n{rest}{tables}")
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

/// The error of a value by what is allowed: 0 where anything is, infinite where it is not known.
fn excess(value: &ExpectedValue) -> f64 {
    let known = |most: f64| value.error.filter(|error| !error.is_nan()).map_or(f64::INFINITY, |error| error / most);
    value.tolerance.map_or(0.0, known)
}

/// The values that the case expects; of many the worst, and all of them where the reader asks for them.
fn expected<'a>(values: &'a [ExpectedValue]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let holds = |value: &ExpectedValue| match value.tolerance {
        Some(_) if excess(value) <= 1.0 => HOLDS,
        Some(_) => MISSED,
        None => UNKNOWN,
    };
    let known = |text: &str| if text.is_empty() { UNKNOWN.into() } else { text.to_owned() };
    let columns: [TableColumn<&'a ExpectedValue>; 6] = [
        ("", &|value| value.name.clone()),
        ("expected", &|value| known(&value.expected)),
        ("reached", &|value| known(&value.found)),
        ("relative error", &|value| number(value.error)),
        ("allowed", &|value| number(value.tolerance)),
        ("", &|value| holds(value).into()),
    ];
    let shown = |values: &[&'a ExpectedValue]| table_of(&columns, values.iter().copied(), None);
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
    let of_contact = [("force", "force"), ("pressure", "pressure"), ("peak", "largest pressure"), ("ends", "ends")];
    let of_probe = [("displacement", "displacement"), ("stress", "stress")];
    let mut all: Vec<(String, &GoalSummary)> = last.energy.iter().map(|goal| ("energy norm".to_owned(), goal)).collect();
    for (name, goals) in &last.contact {
        all.extend(of_contact.iter().filter_map(|(key, what)| Some((format!("{what} of {name}"), goals.get(*key)?))));
    }
    for (name, goals) in &last.probe {
        all.extend(of_probe.iter().filter_map(|(key, what)| Some((format!("{what} at {name}"), goals.get(*key)?))));
    }
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
}
