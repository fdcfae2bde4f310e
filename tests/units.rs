//! Names of units: in figures, report, console and summary, and in no number.

use crate::support::{Ended, Run};
use serde_json::json;

fn read(ended: &Ended, name: &str) -> String {
    std::fs::read_to_string(ended.out.join(name)).expect("a file of the result")
}

#[test]
fn figures_report_and_summary_have_the_units_of_the_case() {
    let run = |settings: &[(&str, &str)]| {
        let first = Run::case("closing_gap").set("mesh.refine", 1).set("exact.must_hold", false);
        settings.iter().fold(first, |run, (key, value)| run.set(key, *value)).solved()
    };
    let named = [("units.length", "mm"), ("units.force", "N")];
    let (plain, with) = (run(&[]), run(&named));
    assert_eq!(with.value("/units"), json!({"length": "mm", "force": "N", "stress": "MPa", "resultant": "N/mm"}));
    assert!(plain.summary().get("units").is_none());
    for name in ["deformed.svg", "pressure_seam.svg", "gap_seam.svg", "steps.svg"] {
        let [before, after] = [&plain, &with].map(|ended| read(ended, name));
        assert!(before.contains("of length") || before.contains("of stress"), "{name}");
        assert!(!after.contains("unit of") && !after.contains("units of"), "{name}");
        assert!(after.contains("mm]") || after.contains("MPa]") || after.contains(", mm<"), "{name}: {after}");
    }
    assert!(read(&with, "steps.svg").contains("contact force, N/mm"));
    let report = read(&with, "report.html");
    for words in ["force ∫λ ds [N/mm]", "largest λ [MPa]", "force x [N/mm]", "largest von Mises stress [MPa]"] {
        assert!(report.contains(words) && !read(&plain, "report.html").contains(words), "{words}");
    }
    for path in ["/contact/seam/force", "/energy/total", "/displacement_max"] {
        assert_eq!(plain.value(path), with.value(path), "{path}: names change no number");
    }
    let thick = run(&[named[0], named[1], ("thickness", "2.0")]);
    assert_eq!(thick.value("/units/resultant"), "N");
    assert!(read(&thick, "steps.svg").contains("contact force, N<"));
}
