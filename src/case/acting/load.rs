//! `[load.NAME]`: pressures and tractions on curves, forces at points, resultants on boundaries that stay rigid.

use super::motion::MOTION;
use super::rigid::{Plate, read_plate};
use super::spot::read_where;
use crate::body::{Load, LoadKind, PointLoad};
use crate::case::keys::{BOOLEAN, IN_PLANE, NAME, NAMES, POINT, Section, TableRule, VECTOR, declare, key, table};
use crate::geometry::Formula;

declare! {
    static LOAD = table("load").rules(RULES);
    /// The physical curves that are loaded.
    const ON: Vec<String> = key("on", NAMES).like("\"top\", or at = [0.0, 1.0] for a point");
    /// > 0 pushes onto the body.
    const PRESSURE: Formula = key("pressure", IN_PLANE).unit("force per area");
    /// Instead: `[tx, ty]` in global axes.
    const TRACTION: [Formula; 2] = key("traction", VECTOR).unit("force per area");
    /// Instead of `on`: a point, as of a support.
    const AT: [f64; 2] = key("at", POINT).unit("length");
    /// Beside `at`, where two bodies touch: the one that is loaded.
    const BODY: String = key("body", NAME).or_else("the one that is there");
    /// Beside `at`: `[fx, fy]`, of the `thickness`. Beside `rigid`: the resultant, in numbers.
    const FORCE: [Formula; 2] = key("force", VECTOR).like("[0.0, -1.0], per thickness").unit("force");
    /// `true`: the curves of `on` stay rigid, as if a stiff plate were bonded to them, and `force`, `moment` are the resultant
    /// that the plate presses with; `ux`, `uy`, `angle`, `about` as of a rigid tool, see [rigid tools and
    /// plates](#rigid-tools-and-plates).
    const RIGID: bool = key("rigid", BOOLEAN).or("false");
    ..MOTION;
}

const RULES: &[TableRule] = &[
    TableRule::OneOf(&[&["on"], &["at"]]),
    TableRule::OneOf(&[&["pressure"], &["traction"], &["force"], &["moment"]]),
    TableRule::Alone("at", &["on", "pressure", "traction", "rigid", "moment", "ux", "uy", "angle", "about"]),
    TableRule::Alone("pressure", &["traction", "force", "moment"]),
    TableRule::Alone("traction", &["force", "moment"]),
    TableRule::Beside("at", &["force"]),
    TableRule::Beside("body", &["at"]),
    TableRule::Beside("force", &["at", "rigid"]),
    TableRule::Beside("moment", &["rigid"]),
    TableRule::Beside("ux", &["rigid"]),
    TableRule::Beside("uy", &["rigid"]),
    TableRule::Beside("angle", &["rigid"]),
    TableRule::Beside("about", &["rigid"]),
];

/// What all tables `[load.NAME]` say.
#[derive(Default)]
pub struct Loads {
    /// What acts on physical curves.
    pub loads: Vec<Load>,
    /// What acts at points.
    pub point_loads: Vec<PointLoad>,
    /// Resultants on boundaries that stay rigid.
    pub plates: Vec<Plate>,
}

/// `[load.NAME]`, put with those of its kind; its curves alone are enough to look for names. Nothing if it has not even these.
pub fn read_load(section: &Section, root: &Section, all: &mut Loads) -> Option<()> {
    let place = read_where(section, root, ON, AT, BODY);
    let name = section.name().to_string();
    if section.has("at") {
        section.refuse(&["pressure", "traction"], "acts on physical curves; at a point give force = [fx, fy]");
        let force = section.required(FORCE);
        all.point_loads.push(PointLoad { name, at: place?.at?, force: force? });
        return Some(());
    }
    if section.or(RIGID)? {
        return read_plate(section, place?.on).map(|plate| all.plates.push(plate));
    }
    section.refuse(
        &["force", "moment"],
        "acts at a point, at = [x, y], or on curves that stay rigid, rigid = true; otherwise give pressure or traction",
    );
    let given = [section.has("pressure"), section.has("traction")];
    let pressure = section.optional(PRESSURE).map(LoadKind::Pressure);
    let traction = section.optional(TRACTION).map(LoadKind::Traction);
    match given {
        [false, false] => section.problem(&[], "loads nothing; give pressure or traction = [tx, ty]"),
        [true, true] => section.problem(&["pressure"], "stands beside traction; give one of them, or two loads"),
        _ => {}
    }
    let kind = pressure.or(traction).unwrap_or(LoadKind::Pressure(Formula::constant(0.0)));
    all.loads.push(Load { name, on: place?.on, kind });
    Some(())
}
