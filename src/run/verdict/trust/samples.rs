//! A case and a zone to judge.

use crate::case::Case;
use crate::output::summary::ZoneSummary;

/// Two blocks with one contact.
pub const CASE: &str = r#"
mesh = { file = "mesh.msh" }
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 3000.0, poisson = 0.3 }
support.table = { on = "bottom", ux = 0.0, uy = 0.0 }
contact.seam = { between = ["lower.seam", "upper.seam"] }
"#;

/// The case of a text, after some overrides.
pub fn parsed(text: &str, settings: &[&str]) -> Case {
    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
    Case::parse(text, std::path::Path::new("case.toml"), &settings).expect("a case")
}

/// [`CASE`] after some overrides.
pub fn case(settings: &[&str]) -> Case {
    parsed(CASE, settings)
}

/// A zone with nothing to doubt.
pub fn zone() -> ZoneSummary {
    ZoneSummary {
        hertz_width: None,
        ends: Some([0.0, 0.4]),
        edges: Some(8.0),
        segments: Some(6),
        share: Some(1.0),
        pressure_max: Some(2.0),
        lambda: Some(0.01),
        whole: Some(0.03),
        worst: Some(0.08),
        force: Some(0.001),
        peak: Some(0.02),
        peak_at_end: Some(false),
        singular: Some(false),
        singular_at_end: Some(false),
        singular_at: None,
        cut_off: Some(0.0),
        corner: Some(false),
    }
}
