//! Keys of a case: the whole file, mesh, bodies, gravity, true shapes.

use super::acting::{LOAD, RIGID, SUPPORT};
use super::asked::{ACCURACY, EXACT, OUTPUT, PROBE, SOLVER, STEPS, TOLERANCE};
use super::contact::CONTACT;
use super::form::{
    ABOVE_ZERO, ANY, EitherForm, IN_PLANE, KeyForm, ListForm, NamedForm, NumberRange, POINT, TableForm, TableRule, VECTOR,
    ValueForm, key, list, named, set,
};
use super::surface::SURFACE;

/// What the plane may stand for.
const PLANE: ValueForm = ValueForm::Word(&["strain", "stress", "axisymmetric"]);

/// A case file.
pub static CASE: TableForm = TableForm {
    name: "case",
    sentence: "",
    keys: &[&[
        key("title", ValueForm::Text, "Shown in output and figures.").or("\"\""),
        key("plane", PLANE, "Strain or stress that is zero across the plane, in all bodies that say nothing else; or \"axisymmetric\", bodies of revolution about x = 0; see [materials and the plane](#materials-and-the-plane).").or("\"strain\""),
        key("thickness", ABOVE_ZERO, "What forces, moments and energies are those of, in the case and in `summary.json`; pressures, tractions, stiffnesses and body forces are per area or volume in any case; see [materials and the plane](#materials-and-the-plane).")
            .or_else("1")
            .unit("length"),
        key("mesh", ValueForm::Table(&MESH), "").required("{ file = \"bars.msh\" }"),
        key("body", ValueForm::Named(NamedForm { table: &BODY, placeholder: "NAME", least: 1, in_files: false }), "").required(""),
        key("gravity", ValueForm::Table(&GRAVITY), ""),
        key("geometry", named(&GEOMETRY), ""),
        key("support", named(&SUPPORT), ""),
        key("load", named(&LOAD), ""),
        key("rigid", named(&RIGID), ""),
        key("contact", ValueForm::Named(NamedForm { table: &CONTACT, placeholder: "NAME", least: 0, in_files: true }), ""),
        key("solver", ValueForm::Table(&SOLVER), ""),
        key("probe", named(&PROBE), ""),
        key(
            "accuracy",
            ValueForm::Either(&EitherForm {
                of: &[TOLERANCE, ValueForm::Table(&ACCURACY)],
                wanted: "a number from 1e-8 to 0.5, the relative error that is asked for; or a table [accuracy] of such numbers",
            }),
            "The relative error that the mesh is adapted to: `accuracy = 1e-4` before all tables is short for `energy = 1e-4` in `[accuracy]`, which follows below.",
        )
        .or_else("not adapted")
        .refused("must be a number from 1e-8 to 0.5, the relative error that is asked for; or a table [accuracy] of such numbers"),
        key("steps", named(&STEPS), ""),
        key("output", ValueForm::Table(&OUTPUT), ""),
        key("exact", ValueForm::Table(&EXACT), ""),
    ]],
    rules: &[],
    inline: false,
};

/// A fraction of an edge: after twelve refinements by the least one, edges are still longer than rounding.
const RATIO: ValueForm = ValueForm::Number(NumberRange { least: Some(0.1), most: Some(0.5), ..ANY });

static MESH: TableForm = TableForm {
    name: "mesh",
    sentence: "",
    keys: &[&[
        key("file", ValueForm::Name, "A Gmsh file, 2.2 or 4.1, ASCII or binary, relative to the case; see [meshes.md](meshes.md). Physical surfaces are bodies, or [parts](#materials-and-the-plane) of bodies, physical curves boundaries. A body may be of several pieces, if each is held.")
            .required("\"bars.msh\", a mesh file of Gmsh"),
        key("order", ValueForm::Whole([1, 2]), "Order of the displacement: P1 or P2.")
            .or("2")
            .refused("must be 1 or 2, the order of the displacement"),
        key("refine", ValueForm::Whole([0, 12]), "How often each triangle is quartered. A run that would take more memory than is left (of the machine, of control groups, of `ulimit -v` and `-d`) ends with exit code 2 before it begins, and names the refinement that fits; `mezha check` tells the memory that a run takes, and warns if this machine has less.")
            .or("0")
            .refused("must be a whole number from 0 to 12; each one quarters every triangle"),
        key("grade", ValueForm::Table(&GRADE), ""),
    ]],
    rules: &[],
    inline: false,
};

static GRADE: TableForm = TableForm {
    name: "grade",
    sentence: "Refinement towards points, see [method.md](method.md): at each refinement, the new node on an edge that ends at one of them goes to the fraction `ratio` from it; to the middle if both ends are named.",
    keys: &[&[
        key("points", ValueForm::List(&set(POINT, "points [x, y] of the mesh file")), "Vertices of the mesh file, of all bodies there, or points (`at`) of supports and loads, as in `[[0, 3], [6, 4]]`.")
            .required("[[0, 3], [6, 4]]")
            .unit("length"),
        key(
            "ratio",
            ValueForm::Either(&EitherForm {
                of: &[ValueForm::Word(&["auto"]), RATIO, ValueForm::List(&ListForm { count: [1, usize::MAX], ..list(RATIO, "a list of numbers") })],
                wanted: "\"auto\", a number, or a list of them",
            }),
            "The fraction, one for all points or one for each; 0.5 is even. `\"auto\"`: 2^(-1.5/`exponent`) for P1, 2^(-2/`exponent`) for P2, which keep the order of the elements, within 0.15 and 0.5.",
        )
        .or("\"auto\"")
        .refused("must be a number, or a list of them, one per point, from 0.1 to 0.5, or \"auto\"; 0.5 is the middle of the edge"),
        key(
            "exponent",
            ValueForm::Either(&EitherForm {
                of: &[ABOVE_ZERO, ValueForm::List(&ListForm { count: [1, usize::MAX], ..list(ABOVE_ZERO, "a list of numbers") })],
                wanted: "a number, or a list of them",
            }),
            "The displacement goes like r^`exponent` there, for all points or for each; `ratio = \"auto\"` wants it.",
        )
        .refused("must be a number, or a list of them, one per point, above 0: u ~ r^exponent"),
    ]],
    rules: &[TableRule::OneOf(&[&["ratio"], &["exponent"]])],
    inline: false,
};

static BODY: TableForm = TableForm {
    name: "body",
    sentence: "NAME is the physical surface, or the name of a body of several, which are its parts; every surface of the mesh needs its constants.",
    keys: &[
        CONSTANTS,
        &[
            key("plane", PLANE, "In this body and all of its parts.").or_else("that before all tables"),
            key("part", ValueForm::Named(NamedForm { table: &PART, placeholder: "SURFACE", least: 1, in_files: false }), ""),
        ],
    ],
    rules: &[
        TableRule::OneOf(&[&["part"], &["young", "poisson"]]),
        TableRule::Alone("part", &["young", "poisson", "body_force", "density", "expansion", "temperature"]),
    ],
    inline: false,
};

static PART: TableForm = TableForm {
    name: "part",
    sentence: "SURFACE is a physical surface that is a part of this body, and has its constants in the place of the body's own: see [materials and the plane](#materials-and-the-plane).",
    keys: &[CONSTANTS],
    rules: &[TableRule::OneOf(&[&["young", "poisson"]])],
    inline: false,
};

/// What a body, or each of its parts, is given.
const CONSTANTS: &[KeyForm] = &[
    key(
        "young",
        ValueForm::Number(NumberRange {
            least: Some(1e-100),
            most: Some(1e100),
            words: "must lie in [1e-100, 1e100]; take other units",
            ..ANY
        }),
        "Young's modulus E.",
    )
    .like("7000.0")
    .unit("force per area"),
    key(
        "poisson",
        ValueForm::Number(NumberRange {
            above: Some(-1.0),
            most: Some(0.5),
            words: "must lie in (-1, 0.5); in plane stress 0.5 may be, too",
            ..ANY
        }),
        "Poisson's ratio ν; 0.5 in plane stress only.",
    )
    .like("0.3"),
    key("body_force", VECTOR, "`[fx, fy]`, force per area and thickness.").or("[0.0, 0.0]").unit("force per volume"),
    key(
        "density",
        ABOVE_ZERO,
        "Mass per area and thickness; with `[gravity]` the force per area density · g is added to `body_force`.",
    )
    .or_else("no weight")
    .unit("mass per volume"),
    key("expansion", ValueForm::Number(ANY), "Coefficient of linear expansion α, beside `temperature`; see [heat](#heat).")
        .like("1.2e-5")
        .unit("1/temperature"),
    key(
        "temperature",
        IN_PLANE,
        "Difference ϑ to the temperature without stress, beside `expansion`: strains `α ϑ` in all directions.",
    )
    .like("\"100.0 - 2.0*x\"")
    .unit("temperature"),
];

static GRAVITY: TableForm = TableForm {
    name: "gravity",
    sentence: "Some body needs a `density`.",
    keys: &[&[key("g", POINT, "The acceleration, `[0, -9.81]`; not `[0, 0]`.")
        .required("[0.0, -9.81]")
        .unit("length per time²")]],
    rules: &[],
    inline: false,
};

static GEOMETRY: TableForm = TableForm {
    name: "geometry",
    sentence: "The true shape of boundaries: nodes move onto it, P2 edges are curved, gaps are measured from it.",
    keys: &[
        &[key("curves", ValueForm::Names, "The physical curves of this shape; also those between parts of a body.")
            .required("[\"lower.seam\", \"upper.seam\"]")],
        SURFACE,
    ],
    rules: &[TableRule::OneOf(&[&["circle"], &["x", "y", "t"]]), TableRule::Alone("circle", &["x", "y", "t"])],
    inline: false,
};
