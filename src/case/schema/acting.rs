//! Keys of a case: what holds bodies, what loads them, and what presses on them.

use super::form::{
    ANY, IN_PLANE, KeyForm, ListForm, NUMBER, NumberRange, POINT, POSITIVE, TableForm, TableRule, VECTOR, ValueForm, key, list,
};
use super::surface::SURFACE;

/// Springs, in number or formula.
const SPRING: ValueForm =
    ValueForm::Formula(&["x", "y"], NumberRange { words: "must be > 0: force per length and displacement", ..POSITIVE });

/// Largest mean turn that can be asked for (radians): beyond it a body would grow by more than half a per cent.
const SMALL_TURN: ValueForm = ValueForm::Number(NumberRange { least: Some(-0.1), most: Some(0.1), ..ANY });

pub static SUPPORT: TableForm = TableForm {
    name: "support",
    sentence: "",
    keys: &[&[
        key("on", ValueForm::Names, "The physical curves that are held.").like("\"bottom\", or at = [0.0, 1.0] for a point"),
        key("at", POINT, "Instead of `on`: a point of a body, whether the mesh has a vertex there or not, see [points](#points); with `ux`, `uy` or both.")
            .unit("length"),
        key("body", ValueForm::Name, "Beside `at`, where two bodies touch: the one that is held. Beside `mean`: the body. A [pattern](#patterns) stands for a support on each body.")
            .or_else("the one that is there")
            .like("\"disc\""),
        key("mean", ValueForm::Yes, "Beside `body`: holds the mean motion of a whole body, see [mean motions](#mean-motions); with `ux`, `uy`, `angle`, `along`, `tangential` (numbers) or several of them.")
            .refused("holds a mean motion only as mean = true; leave it out for a support on = or at ="),
        key("ux", IN_PLANE, "Prescribed displacement.").or_else("free").unit("length"),
        key("uy", IN_PLANE, "Prescribed displacement.").or_else("free").unit("length"),
        key("angle", SMALL_TURN, "Beside `mean`: the mean turn about the middle of the body.")
            .or_else("free")
            .unit("radians")
            .refused("must be a number from -0.1 to 0.1: radians, small ones; draw the body turned instead"),
        key("direction", POINT, "Beside `along`: its direction `[x, y]`, of any length.").like("[1.0, 1.0]"),
        key("along", NUMBER, "Beside `mean` and `direction`: the mean shift in that direction.").or_else("free").unit("length").like("0.0"),
        key("about", POINT, "Beside `tangential`: the centre `[x, y]`.").unit("length").like("[0.0, 0.0]"),
        key("tangential", NUMBER, "Beside `mean` and `about`: the mean shift of the body around that centre, along the tangent at the middle of the body, counter-clockwise.")
            .or_else("free")
            .unit("length")
            .like("0.0"),
        key("normal", IN_PLANE, "Instead of `ux` and `uy`: displacement along the outward normal, tangent free.")
            .or_else("free")
            .unit("length"),
        key("stiffness", ValueForm::Table(&STIFFNESS), "Instead, on physical curves: springs, as force per length of the boundary and per displacement. `{ normal = 100 }`, which pull as well as push, or `{ x = 100, y = 50 }`, or one of these; nowhere below 0.")
            .or_else("no springs"),
    ]],
    rules: &[
        TableRule::OneOf(&[&["ux"], &["uy"], &["normal"], &["angle"], &["along"], &["tangential"], &["stiffness"]]),
        TableRule::OneOf(&[&["on"], &["at"], &["body", "mean"]]),
        TableRule::Beside("body", &["at", "mean"]),
        TableRule::Beside("angle", &["mean"]),
        TableRule::Beside("along", &["mean"]),
        TableRule::Beside("tangential", &["mean"]),
        TableRule::Beside("along", &["direction"]),
        TableRule::Beside("direction", &["along"]),
        TableRule::Beside("tangential", &["about"]),
        TableRule::Beside("about", &["tangential"]),
        TableRule::Alone("at", &["on", "normal", "stiffness"]),
        TableRule::Alone("mean", &["on", "at", "normal", "stiffness"]),
        TableRule::Alone("normal", &["ux", "uy"]),
        TableRule::Alone("stiffness", &["ux", "uy", "normal", "body", "angle"]),
    ],
    inline: false,
};

static STIFFNESS: TableForm = TableForm {
    name: "stiffness",
    sentence: "",
    keys: &[&[
        key("normal", SPRING, "Springs along the outward normal.").unit("force per volume"),
        key("x", SPRING, "Springs along the axes.").unit("force per volume"),
        key("y", SPRING, "Springs along the axes.").unit("force per volume"),
    ]],
    rules: &[TableRule::OneOf(&[&["normal"], &["x"], &["y"]]), TableRule::Alone("normal", &["x", "y"])],
    inline: true,
};

pub static LOAD: TableForm = TableForm {
    name: "load",
    sentence: "",
    keys: &[
        &[
            key("on", ValueForm::Names, "The physical curves that are loaded.").like("\"top\", or at = [0.0, 1.0] for a point"),
            key("pressure", IN_PLANE, "> 0 pushes onto the body.").unit("force per area"),
            key("traction", VECTOR, "Instead: `[tx, ty]` in global axes.").unit("force per area"),
            key("at", POINT, "Instead of `on`: a point, as of a support.").unit("length"),
            key("body", ValueForm::Name, "Beside `at`, where two bodies touch: the one that is loaded.").or_else("the one that is there"),
            key("force", VECTOR, "Beside `at`: `[fx, fy]`, of the `thickness`. Beside `rigid`: the resultant, in numbers.")
                .like("[0.0, -1.0], per thickness")
                .unit("force"),
            key("rigid", ValueForm::Boolean, "`true`: the curves of `on` stay rigid, as if a stiff plate were bonded to them, and `force`, `moment` are the resultant that the plate presses with; `ux`, `uy`, `angle`, `about` as of a rigid tool, see [rigid tools and plates](#rigid-tools-and-plates).")
                .or("false"),
        ],
        MOTION,
    ],
    rules: &[
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
    ],
    inline: false,
};

/// The motion of what stays rigid, but for its force.
const MOTION: &[KeyForm] = &[
    key("moment", NUMBER, "Moment about its reference point, positive from x to y: its turn is then unknown.")
        .unit("force times length"),
    key("ux", NUMBER, "Shift of its reference point.").or_else("0, or free where a `force` acts").unit("length"),
    key("uy", NUMBER, "Shift of its reference point.").or_else("0, or free where a `force` acts").unit("length"),
    key("angle", NUMBER, "Its turn about its reference point.").or_else("0, or free where a `moment` acts").unit("radians"),
    key("about", POINT, "Its reference point.").or_else("the centre of a circle, otherwise the middle").unit("length"),
];

pub static RIGID: TableForm = TableForm {
    name: "rigid",
    sentence: "A rigid tool; in `between` it is called `\"rigid.NAME\"`, see [rigid tools and plates](#rigid-tools-and-plates).",
    keys: &[
        &[key(
            "line",
            ValueForm::List(&ListForm {
                count: [2, usize::MAX],
                few: "must list two points or more, as in [[0, 1], [2, 1]]",
                ..list(POINT, "a list of points [[x, y], ...]")
            }),
            "Its surface: points, each joined to the next, `[[0, 1], [2, 1]]`. Of several lines each has a name, `\"rigid.NAME.1\"`, ...; where they turn by less than 20 degrees, the whole of them is no side of a contact: a spline would round the corner. Instead: a circle or formulas, as of a `[geometry]`.",
        )
        .unit("length")],
        SURFACE,
        &[key(
            "force",
            POINT,
            "`[fx, fy]` that it carries, of the `thickness`: its shifts are then unknown, but for `ux` or `uy` that is given.",
        )
        .unit("force")],
        MOTION,
    ],
    rules: &[
        TableRule::OneOf(&[&["line"], &["circle"], &["x", "y", "t"]]),
        TableRule::Alone("line", &["circle", "x", "y", "t"]),
        TableRule::Alone("circle", &["x", "y", "t"]),
    ],
    inline: false,
};
