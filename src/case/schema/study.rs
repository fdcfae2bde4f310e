//! Keys of a study file.

use super::form::{COUNT, EitherForm, NumberRange, POSITIVE, TableForm, ValueForm, key, set};

/// Longest time limit of a run, in seconds: a month.
const LONGEST: f64 = 30.0 * 86_400.0;

/// A list of case files.
const CASES: ValueForm = ValueForm::List(&set(ValueForm::Name, "a list of case files"));

/// A list of places in `summary.json`.
const PATHS: ValueForm = ValueForm::List(&set(ValueForm::Name, "a list of paths in summary.json"));

/// A study file.
pub static STUDY: TableForm = TableForm {
    name: "study",
    sentence: "",
    keys: &[&[
        key("cases", CASES, "Case files, relative to this file.").required("[\"case.toml\"]"),
        key(
            "ranks",
            ValueForm::List(&set(COUNT, "a list of numbers of ranks")),
            "Numbers of MPI ranks that each run is made on.",
        )
        .or("[1]"),
        key("repeat", COUNT, "How often each run is made.").or("1"),
        key("timeout", ValueForm::Number(NumberRange { most: Some(LONGEST), ..POSITIVE }), "Time limit of each run.")
            .or("600")
            .unit("seconds"),
        key(
            "error",
            ValueForm::Either(&EitherForm { of: &[ValueForm::Name, PATHS], wanted: "a path in summary.json, or a list of them" }),
            "The error axis: a place in `summary.json`, as in `\"errors.lambda_seam\"`, or a list of them.",
        )
        .or_else("no error axis"),
        key("time", ValueForm::Name, "The time axis: a place in `summary.json`.").or("\"time_s.total\""),
        key(
            "along",
            ValueForm::Either(&EitherForm {
                of: &[ValueForm::Name, ValueForm::List(&set(ValueForm::Name, "a list of keys of the case"))],
                wanted: "a key of the case, or a list of them",
            }),
            "Points that differ in this key of the case alone are a line; or a list of keys.",
        )
        .or_else("`\"mesh.refine\"`"),
        key("columns", PATHS, "More places in `summary.json` that become columns."),
        key("set", ValueForm::CaseKeys, "Keys of the case that are set in every run."),
        key("grid", ValueForm::CaseAxes, "Keys of the case with lists of values: every combination is a run."),
        key("curve", ValueForm::Tables(&CURVE), ""),
    ]],
    rules: &[],
    inline: false,
};

static CURVE: TableForm = TableForm {
    name: "curve",
    sentence: "Keys that move together, one curve in the figures.",
    keys: &[&[
        key("name", ValueForm::Name, "Its name.").required("\"P1/P0\""),
        key("set", ValueForm::CaseKeys, "Keys of the case that are set for this curve."),
        key(
            "grid",
            ValueForm::CaseAxes,
            "Axes of its own: in the place of those of the study's `[grid]` for the same keys, and beside the others.",
        ),
        key("cases", CASES, "Those of the study's cases that it is drawn for, as they stand in `cases`.").or_else("all of them"),
    ]],
    rules: &[],
    inline: false,
};
