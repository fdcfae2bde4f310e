//! Pages of every kind of run: whole, well-formed as far as tags go, and without anything that is loaded from elsewhere.

use super::super::page::ExpectedValue;
use super::*;
use crate::output::summary::{
    AccuracyStep, ContactEstimate, ContactSummary, ContactTrust, GoalSummary, ProbeSummary, RigidSummary, Status, StepContact,
    StepSummary, Summary, SupportSummary, ZoneSummary,
};
use crate::procedure::{BoundaryStep, Pass};

/// A name that must not become markup.
const NAME: &str = "<script>alert('&')</script>";

fn summary(status: Status) -> Summary {
    let mut summary = Summary::new(NAME, 2);
    summary.status = status;
    summary.reason = Some("the set stands (a; b); nothing presses on contact <b>".into());
    if status == Status::Interrupted {
        return summary;
    }
    let zone = ZoneSummary { ends: Some([1.0, 1.5]), lambda: Some(0.006), peak: Some(0.03), ..ZoneSummary::default() };
    let contact = ContactSummary {
        force: Some(-1.25e-7),
        closed: Some(vec![[1.0, 1.5]]),
        closed_points: Some(vec![[[1.0, f64::NAN], [1.5, 0.0]]]),
        resultant: Some([f64::NAN, 1.0]),
        judged: ContactTrust { trust: Some(status == Status::Converged), ..ContactTrust::default() },
        zones: vec![zone],
        ..ContactSummary::default()
    };
    summary.contact.insert(NAME.into(), contact);
    summary.estimate.contact.insert(NAME.into(), ContactEstimate { force: Some(0.01), ..ContactEstimate::default() });
    summary.estimate.energy = Some(0.0123);
    summary.support.insert(NAME.into(), SupportSummary { reaction: Some([0.0, 2.0]), moment: None });
    summary.rigid.insert(NAME.into(), RigidSummary { motion: Some([0.1, 0.2, 0.3]), ..RigidSummary::default() });
    summary.probe.insert(NAME.into(), ProbeSummary { x: Some([1.0, 2.0]), ..ProbeSummary::default() });
    summary.energy.strain.insert(NAME.into(), Some(3.0));
    summary.strain_max.insert(NAME.into(), Some(0.001));
    summary.balance.force = Some(1e-12);
    summary.outer = (1..=100).map(|iteration| Pass { iteration, ..Pass::default() }).collect();
    summary.boundaries.push(BoundaryStep::default());
    let goal = GoalSummary { estimate: Some(2e-3), error: None, asked: 1e-3 };
    summary.accuracy = Some(vec![AccuracyStep { energy: Some(goal), ..AccuracyStep::default() }]);
    let contact = [(NAME.to_owned(), StepContact::default())].into();
    let factors = [(NAME.to_owned(), 0.5)].into();
    summary.steps = Some(vec![StepSummary { step: 1, contact, factors, ..StepSummary::default() }]);
    summary
}

fn page(status: Status, figures: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    for name in figures {
        std::fs::write(
            folder.path().join(name),
            format!("<svg xmlns=\"http://www.w3.org/2000/svg\"><text>{name}</text></svg>\n"),
        )
        .unwrap();
    }
    let expected = ExpectedValue {
        name: format!("force of {NAME}"),
        expected: "2".into(),
        found: "2.1".into(),
        error: Some(0.05),
        tolerance: Some(0.01),
    };
    let contacts = [(NAME.to_owned(), [NAME.to_owned(), "upper".to_owned()])];
    let page = ReportPage {
        title: NAME,
        summary: &summary(status),
        expected: &[expected],
        contacts: &contacts,
        warnings: &[format!("beware of {NAME}")],
        case: "[mesh]\nfile = \"a&b.msh\"\n",
    };
    write_report(folder.path(), &page).unwrap();
    std::fs::read_to_string(folder.path().join("report.html")).unwrap()
}

/// Whether every tag is closed in its order; the style and texts hold no brackets but those of tags.
fn check_tags(page: &str) {
    let mut open = Vec::new();
    for tag in page.split('<').skip(1).map(|rest| rest.split_once('>').expect("a whole tag").0) {
        let name = tag.trim_matches('/').split_whitespace().next().unwrap_or_default();
        match tag {
            _ if tag.starts_with('!') || tag.ends_with('/') => {}
            _ if tag.starts_with('/') => assert_eq!(open.pop(), Some(name), "{tag}"),
            _ => open.push(name),
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn every_status_has_its_page() {
    for (status, words) in [
        (Status::Converged, "Converged"),
        (Status::NotConverged, "Not converged"),
        (Status::Unresolved, "Not resolved"),
        (Status::Interrupted, "Interrupted"),
    ] {
        let page = page(status, &["deformed.svg"]);
        check_tags(&page);
        assert!(page.contains(&format!("<strong>{words}</strong>")), "{page}");
        for words in [
            "<li>the set stands (a; b)</li>\n<li>nothing presses on contact &lt;b&gt;</li>",
            "a&amp;b.msh",
            "missed",
            "beware of",
        ] {
            assert!(page.contains(words), "{words}: {page}");
        }
        assert!(page.matches("<script").count() == 1 && page.contains("<script>\n//") && !page.contains("NaN"), "{page}");
        for loaded in ["src=", "url(", "@import", "<link", "<iframe", "xlink", "href=\"http"] {
            assert!(!page.contains(loaded), "{loaded}: {page}");
        }
        assert_eq!(page.matches("http://").count(), page.matches("http://www.w3.org/").count());
    }
}

#[test]
fn the_page_holds_every_figure_that_is_there() {
    let of_contact = ["pressure", "gap", "displacement"].map(|figure| format!("{figure}_{NAME}.svg").replace('/', "_"));
    let figures = ["deformed.svg", "steps.svg", "accuracy.svg"];
    let text = page(Status::Converged, &figures);
    for name in figures {
        assert_eq!(text.matches(&format!("<text>{name}</text>")).count(), 1, "{name}");
    }
    // No file has a name with a stroke, so that a contact of that name has no figure.
    assert!(of_contact.iter().all(|name| !text.contains(name)) && text.matches("<figure>").count() == 3);
    assert!(text.contains("40 rows are left out here"), "100 passes");
    assert_eq!(page(Status::Interrupted, &[]).matches("<figure>").count(), 0);
}

#[test]
fn what_is_not_known_makes_no_section() {
    let folder = tempfile::tempdir().unwrap();
    let summary = Summary::new("bars", 1);
    let bare = ReportPage { title: "", summary: &summary, expected: &[], contacts: &[], warnings: &[], case: "" };
    let page = html(folder.path(), &bare);
    check_tags(&page);
    for place in ["figures", "contacts", "estimate", "history", "provenance", "points"] {
        assert!(!page.contains(&format!("id=\"{place}\"")), "{place}: {page}");
    }
    assert!(page.contains("<h1>bars</h1>") && page.contains("Not converged"));
}
