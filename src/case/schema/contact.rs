//! Keys of a case: contacts.

use super::form::{ANY, COUNT, EitherForm, IN_PLANE, ListForm, NumberRange, TableForm, TableRule, ValueForm, key, list};

/// How many times shorter segments are at an end.
const GRADING: ValueForm = ValueForm::Number(NumberRange { least: Some(1.0), most: Some(1000.0), ..ANY });

pub static CONTACT: TableForm = TableForm {
    name: "contact",
    sentence: "NAME is part of file names: letters, digits, `-`, `_` and `.`, neither `.` nor `..` alone, 100 bytes at most, and no two that differ by capital letters only.",
    keys: &[&[
        key(
            "between",
            ValueForm::List(&ListForm { count: [2, 2], ..list(ValueForm::Names, "two physical curves, of body 1 and of body 2") }),
            "`[boundary of body 1, boundary of body 2]`; n points from 1 to 2. A side of several physical curves of one body is a list of them: `[[\"flat\", \"arc\"], \"other\"]`; messages call it \"flat + arc\".",
        )
        .required("[\"lower.seam\", \"upper.seam\"]"),
        key(
            "curve",
            ValueForm::Name,
            "`\"line\"`: both boundaries are straight, extent their overlap. `\"geometry\"`: the one `[geometry]` that lists both. `\"fit\"`: the spline half-way between both boundaries where they touch or penetrate, fitted again after each solve until it stands, see [method.md](method.md); curved boundaries without a `[geometry]` are bent onto splines through the nodes of the mesh file. One of the two boundaries, as in `\"rigid.roller\"` or `\"ring.seam\"`: its own undeformed curve, as far as they touch or penetrate, see [rigid tools and plates](#rigid-tools-and-plates). Boundaries may be whole circles or closed curves: see [closed boundaries](#closed-boundaries).",
        )
        .or_else("the tool's, if one side is a rigid tool of one curve, or one line of a tool; otherwise `\"fit\"`")
        .refused("must be \"line\", \"geometry\", \"fit\", or one of the two boundaries"),
        key(
            "spans",
            ValueForm::Either(&EitherForm { of: &[ValueForm::Word(&["auto"]), COUNT], wanted: "a whole number of at least 1, or \"auto\"" }),
            "Of a fitted curve: a number, at most a quarter of the nodes where the bodies meet, or `\"auto\"`: as few as follow the nodes as well as any number does.",
        )
        .or("\"auto\""),
        key("ends", ValueForm::Word(&["free", "fixed"]), "`\"free\"`: the contact boundary ends where the pressure does, unless a body ends before. `\"fixed\"`: it stays as long as it was placed.")
            .or_else("`\"fixed\"` with `\"line\"` and `\"geometry\"`, otherwise `\"free\"`"),
        key(
            "gap",
            ValueForm::Either(&EitherForm {
                of: &[IN_PLANE, ValueForm::Word(&["closed", "geometry"])],
                wanted: "\"closed\", \"geometry\", a number or a formula of x, y",
            }),
            "Gap of the unloaded bodies. `\"closed\"`: they touch along the curve, and are drawn so. A number, or a formula of x, y on the curve; negative is interference. It needs a value wherever the bodies may touch; how far apart they are drawn does not count then, but a warning tells if that is something else. `\"geometry\"`: measured between the smooth boundaries: `[geometry]`, straight lines, or splines through the nodes of the mesh file.",
        )
        .or("\"geometry\"")
        .unit("length"),
        key("multiplier", ValueForm::Word(&["p0", "p1-discontinuous", "p1-continuous"]), "The space of the contact pressure λ.")
            .or("\"p1-discontinuous\""),
        key(
            "segments",
            ValueForm::Either(&EitherForm {
                of: &[
                    ValueForm::Word(&["auto"]),
                    COUNT,
                    ValueForm::List(&ListForm { count: [2, usize::MAX], few: ASCEND, ..list(FRACTION, "a list of numbers") }),
                ],
                wanted: "\"auto\", a whole number >= 1, or fractions like [0, 0.2, 1]",
            }),
            "`\"auto\"`: the safe rule of [method.md](method.md), shorter where the edges are. A number, of equal length, at most 32 to an edge; or ascending fractions of the length, `[0, 0.2, 1]`.",
        )
        .or("\"auto\""),
        key(
            "grading",
            ValueForm::Either(&EitherForm {
                of: &[GRADING, ValueForm::List(&ListForm { count: [2, 2], ..list(GRADING, "two numbers") })],
                wanted: "a number from 1 to 1000, or two of them",
            }),
            "Segments shorten from the middle to the ends, by this factor in all; or `[first end, last end]`.",
        )
        .or("1")
        .refused("must be a number from 1 to 1000, or two of them for the first and the last end: so many times shorter are segments there"),
        key("law", ValueForm::Word(&["unilateral", "bilateral"]), "`\"unilateral\"`: pressure or gap. `\"bilateral\"`: equal normal displacement, λ of either sign, free sliding.")
            .or("\"unilateral\""),
        key("quadrature", ValueForm::Word(&["cut", "segment"]), "Where integrals over Γ_C are evaluated. `\"cut\"`: between segment ends and projected nodes, exact on straight lines. `\"segment\"`: at fixed points of each segment, to repeat the paper; λ is off by per cents, see [method.md](method.md).")
            .or("\"cut\""),
        key("points", ValueForm::Whole([1, 20]), "Gauss points of a segment, at least 2 for linear multipliers; beside `quadrature = \"segment\"` only.").or("5"),
        key(
            "stabilise",
            ValueForm::Either(&EitherForm { of: &[ValueForm::Word(&["auto"]), ValueForm::Boolean], wanted: "\"auto\", true or false" }),
            "A jump term; `\"auto\"`: where the segments are shorter than the safe rule, see [method.md](method.md); `\"p1-continuous\"` has none.",
        )
        .or("\"auto\""),
        key("configuration", ValueForm::Word(&["reference", "deformed"]), "`\"reference\"`: normals, corresponding points and distances of the undeformed bodies, the linear theory. `\"deformed\"`: of the deformed ones; wants `curve = \"fit\"` and `gap = \"geometry\"`.")
            .or("\"reference\""),
    ]],
    rules: &[TableRule::Beside("points", &["quadrature"])],
    inline: false,
};

/// A fraction of the length of a curve.
const FRACTION: ValueForm = ValueForm::Number(NumberRange { least: Some(0.0), most: Some(1.0), words: ASCEND, ..ANY });
const ASCEND: &str = "must ascend from 0 to 1, as in [0, 0.2, 1]";
