//! Keys of a case: a curve of the plane, as boundaries and rigid tools have it.

use super::form::{ABOVE_ZERO, ANY, KeyForm, ListForm, NUMBER, POINT, TableForm, ValueForm, key, list};

/// A curve of the plane.
pub const SURFACE: &[KeyForm] = &[
    key("x", ALONG, "The curve, by formulas of t.").like("\"t\", or circle = { centre = [0, 0], radius = 1 }").unit("length"),
    key("y", ALONG, "The curve, by formulas of t.").like("\"t^2\", or circle = { centre = [0, 0], radius = 1 }").unit("length"),
    key("t", ValueForm::List(&ListForm { count: [2, 2], ..list(NUMBER, "two numbers") }), "The range of t, `[0, 4]`; ascending.")
        .like("[0, 1], or circle = { centre = [0, 0], radius = 1 }")
        .refused("must be two ascending numbers, the range of t"),
    key("circle", ValueForm::Table(&CIRCLE), "Instead of `x`, `y` and `t`: `{ centre = [0, 0], radius = 1 }`."),
];

/// A formula along a curve.
const ALONG: ValueForm = ValueForm::Formula(&["t"], ANY);

static CIRCLE: TableForm = TableForm {
    name: "circle",
    sentence: "",
    keys: &[&[
        key("centre", POINT, "Its centre.").required("[0, 0]").unit("length"),
        key("radius", ABOVE_ZERO, "Its radius.").required("1.0").unit("length"),
    ]],
    rules: &[],
    inline: true,
};
