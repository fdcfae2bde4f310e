//! `[output]` and `[probe.NAME]`: what is written of the result.

use crate::case::bodies::body::region_names;
use crate::case::keys::{BOOLEAN, FormOf, NAME, POINT, Section, ValueForm, declare, key, of, table};

declare! {
    static OUTPUT = table("output");
    /// `false`: no fields, no figures and no report, only `summary.json`, `case.toml`, `case.msh` (of up to 4 MiB), `adapted.msh`
    /// of an accuracy, `contacts.csv`, `contact_NAME.csv`, and `steps.csv` of load steps; for many runs, or very large ones.
    const FIELDS: bool = key("fields", BOOLEAN).or("true");
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// Whether fields and figures are; the numbers always are.
    pub fields: bool,
}

/// A point whose displacement and stress are reported.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Name in the case file.
    pub name: String,
    /// Where (length).
    pub point: [f64; 2],
    /// Body that is asked, or part of one; two of them may touch there.
    pub body: String,
}

/// `[output]`
pub fn read_output(root: &Section) -> Output {
    Output { fields: root.table("output").or_default(FIELDS) }
}

/// `units`
pub fn read_units(root: &Section) -> UnitNames {
    let Some(section) = root.optional_table("units") else { return UnitNames::default() };
    UnitNames { length: section.optional(LENGTH), force: section.optional(FORCE) }
}

/// `[probe.NAME]`
pub fn read_probe(section: &Section) -> Option<Probe> {
    let (point, body) = (section.required(PROBED), section.required(BODY));
    Some(Probe { name: section.name().into(), point: point?, body: body? })
}

/// Probes ask bodies of the case, or parts of them.
pub fn check_probes(probes: &[Probe], root: &Section) {
    for probe in probes {
        root.check_name(&["probe", &probe.name, "body"], "body", &probe.body, region_names(root).into_iter());
    }
}
