//! `[output]` and `[probe.NAME]`: what is written of the result.

use crate::accuracy::ProbePoint;
use crate::case::bodies::body::region_names;
use crate::case::keys::*;
use crate::element::{MEASURE_NAMES, MEASURES, Plane, StressMeasure};

declare! {
    static OUTPUT = table("output");
    /// `false`: no fields, no figures and no report, only `summary.json`, `case.toml`, `case.msh` (of up to 4 MiB), `adapted.msh`
    /// of an accuracy, `contacts.csv`, `contact_NAME.csv`, and `steps.csv` of load steps; for many runs, or very large ones.
    const FIELDS: bool = key("fields", BOOLEAN).or("true");
    /// More figures of the deformed bodies, `field_sigma_1.svg` and so on, beside that of von Mises stress: `"sigma_1"` and
    /// `"sigma_2"`, the larger and the smaller principal stress in the plane; `"tau_max"`, half of the largest difference between
    /// any two of the three principal stresses; `"sigma_xx"`, `"sigma_yy"`, `"sigma_xy"`, `"sigma_zz"`; of bodies of revolution
    /// `"sigma_rr"` along the radius, `"sigma_yy"` along the axis and `"sigma_tt"` around it. Tension is positive.
    const FIGURES: Vec<StressMeasure> = key("figures", SOME_MEASURES).or("[]");
}

declare! {
    /// Displacement and stress at a point, in `summary.json`.
    static PROBE = table("probe");
    /// The point, `[1.0, 2.0]`.
    const PROBED: [f64; 2] = key("point", POINT).required("[1.0, 2.0]").unit("length");
    /// Name of a body, or of a part: between two parts, where the stress jumps, it must be one of these.
    const BODY: String = key("body", NAME).required("\"lower\"");
}

declare! {
    static NAMED_UNITS = table("units").inline();
    /// That of lengths.
    const LENGTH: String = key("length", UNIT);
    /// That of forces.
    const FORCE: String = key("force", UNIT);
}

/// Quantities of which figures are asked for.
const SOME_MEASURES: FormOf<Vec<StressMeasure>> =
    of(ValueForm::List(ListForm { count: [0, usize::MAX], unique: true, ..entries(&MEASURE, "a list of names") }));
const MEASURE: FormOf<StressMeasure> = word();

/// The name of a unit.
const UNIT: FormOf<String> = of(ValueForm::Short(12));

/// The names of the units that a case is in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct UnitNames {
    /// Of lengths.
    pub length: Option<String>,
    /// Of forces.
    pub force: Option<String>,
}

/// What is written of the result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output {
    /// Whether fields and figures are; the numbers always are.
    pub fields: bool,
    /// What figures show beside von Mises stress.
    pub figures: Vec<StressMeasure>,
}

impl Choice for StressMeasure {
    const WORDS: &[&str] = &MEASURE_NAMES;
    const MEANINGS: &[Self] = &MEASURES;
}

/// What is said of stresses whose names mean something else, or nothing, in the plane of the case.
const NOT_OF_REVOLUTION: &str =
    "\"sigma_zz\" may mean two stresses here: write \"sigma_yy\" for that along the axis, \"sigma_tt\" for that around it";
const OF_REVOLUTION: &str = "\"sigma_rr\" and \"sigma_tt\" are for bodies of revolution: write \"sigma_xx\", and \"sigma_zz\" for the stress across the plane";

/// `[output]`. Stresses have names of their own in bodies of revolution, where zz is the axis to some and the hoop to others.
pub fn read_output(root: &Section, plane: Plane) -> Output {
    let section = root.table("output");
    let output = Output { fields: section.or_default(FIELDS), figures: section.or_default(FIGURES) };
    let is_for_others = |measure: &StressMeasure| match measure {
        StressMeasure::Zz => plane == Plane::Revolution,
        StressMeasure::Radial | StressMeasure::Hoop => plane != Plane::Revolution,
        _ => false,
    };
    if output.figures.iter().any(is_for_others) {
        section.problem(&["figures"], if plane == Plane::Revolution { NOT_OF_REVOLUTION } else { OF_REVOLUTION });
    }
    output
}

/// `units`
pub fn read_units(root: &Section) -> UnitNames {
    let section = root.table("units");
    UnitNames { length: section.optional(LENGTH), force: section.optional(FORCE) }
}

/// `[probe.NAME]`, which asks a body of the case, or a part of one.
pub fn read_probe(section: &Section, root: &Section) -> Option<ProbePoint> {
    let (point, body) = (section.required(PROBED), section.required(BODY));
    let (point, body) = (point?, body?);
    section.check_name(&["body"], "body", &body, region_names(root).into_iter());
    Some(ProbePoint { name: section.name().into(), point: point.into(), body })
}
