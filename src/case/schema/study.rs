//! Keys of a study file.

use toml::{Table, Value};

use crate::case::keys::*;

declare! {
    static STUDY = table("study");
    /// Case files, relative to this file.
    const CASES: Vec<String> = key("cases", FILES).required("[\"case.toml\"]");
    /// Numbers of MPI ranks that each run is made on.
    const RANKS: Vec<usize> = key("ranks", set(&COUNT, "a list of numbers of ranks")).or("[1]");
    /// How often each run is made.
    const REPEAT: usize = key("repeat", COUNT).or("1");
    /// Time limit of each run.
    const TIMEOUT: f64 = key("timeout", number(NumberRange { most: Some(LONGEST), ..POSITIVE })).or("600").unit("seconds");
    /// The error axis: a place in `summary.json`, as in `"errors.lambda_seam"`, or a list of them.
    const ERROR: Value = key("error", either(&[NAME.value, PATHS.value], "a path in summary.json, or a list of them"))
        .or_else("no error axis");
    /// The time axis: a place in `summary.json`.
    const TIME: Value = key("time", of(NAME.value)).or("\"time_s.total\"");
    /// Points that differ in this key of the case alone are a line; or a list of keys.
    const ALONG: Value = key("along", either(&[NAME.value, CASE_KEYS.value], "a key of the case, or a list of them"))
        .or_else("`\"mesh.refine\"`");
    /// More places in `summary.json` that become columns.
    const COLUMNS: Value = key("columns", of(PATHS.value));
    /// A figure of one column against another: what is across, what is up, and, if there are three, by what lines are told apart. A
    /// column is named by a key of a grid, a path in `summary.json`, `"curve"`, `"ranks"`, `"unknowns"`, or the last part of such a
    /// name; `"force"` or `"pressure_max"` is that of the only contact.
    const FIGURE: Vec<String> = key("figure", FIGURE_COLUMNS);
    /// Keys of the case that are set in every run.
    const SET: Table = key("set", of(ValueForm::CaseKeys));
    /// Keys of the case with lists of values: every combination is a run.
    const GRID: Table = key("grid", of(ValueForm::CaseAxes));
    const CURVES: Table = key("curve", of(ValueForm::Tables(&CURVE)));
}

declare! {
    /// Keys that move together, one curve in the figures.
    static CURVE = table("curve");
    /// Its name.
    const CURVE_NAME: String = key("name", NAME).required("\"P1/P0\"");
    /// Keys of the case that are set for this curve.
    const CURVE_SET: Table = key("set", of(ValueForm::CaseKeys));
    /// Axes of its own: in the place of those of the study's `[grid]` for the same keys, and beside the others.
    const CURVE_GRID: Table = key("grid", of(ValueForm::CaseAxes));
    /// Those of the study's cases that it is drawn for, as they stand in `cases`.
    const CURVE_CASES: Vec<String> = key("cases", FILES).or_else("all of them");
}

/// Longest time limit of a run, in seconds: a month.
const LONGEST: f64 = 30.0 * 86_400.0;

const FILES: FormOf<Vec<String>> = set(&NAME, "a list of case files");
const PATHS: FormOf<Vec<String>> = set(&NAME, "a list of paths in summary.json");
const FIGURE_COLUMNS: FormOf<Vec<String>> =
    of(ValueForm::List(ListForm { count: [2, 3], unique: true, ..entries(&NAME, "two or three names of columns") }));
const CASE_KEYS: FormOf<Vec<String>> = set(&NAME, "a list of keys of the case");
