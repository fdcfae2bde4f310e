//! What a run's words are worth beside the truth, and the table of many.

use crate::profile::Apart;
use crate::run::Said;

/// What a run is, beside the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Right, and says so.
    Right,
    /// Wrong or impossible, and says so.
    Alarm,
    /// Right, but says otherwise, or refuses.
    FalseAlarm,
    /// Wrong by more than 5 %, without a word.
    Quiet,
    /// Wrong by more than 10 %, without a word.
    Loud,
}

/// One line of the table.
pub struct Row {
    pub seed: u64,
    pub kind: Kind,
    /// Whether the scene has an answer at all.
    pub possible: bool,
    pub apart: Option<Apart>,
    pub said: Said,
    pub words: String,
}

/// Whether a run gives no reason to doubt its pressure. A warning that segments are short is none: the case asked for
/// them; nor is one that P1 locks towards ν = 0.5: whether it does is judged.
pub fn is_quiet(said: &Said) -> bool {
    let idle = ["or more are safe", "lock towards 0.5"];
    let doubts = said.warnings.iter().filter(|words| !idle.iter().any(|known| words.contains(known)));
    said.code == Some(0) && said.trust != Some(false) && doubts.count() == 0
}

/// What a run is worth; `apart` is missing where the scene has no answer, which it must say.
pub fn judge(said: &Said, apart: Option<&Apart>) -> Kind {
    let error = apart.map_or(f64::INFINITY, |apart| apart.lambda().max(apart.force));
    match (is_quiet(said), error) {
        (true, error) if error <= 0.05 => Kind::Right,
        (true, error) if error <= 0.1 => Kind::Quiet,
        (true, _) => Kind::Loud,
        (false, error) if error <= 0.05 => Kind::FalseAlarm,
        (false, _) => Kind::Alarm,
    }
}

impl Row {
    /// The line.
    pub fn line(&self) -> String {
        let number = |value: Option<f64>| value.map_or("-".to_string(), |value| format!("{value:.1e}"));
        let of = |pick: fn(&Apart) -> f64| number(self.apart.as_ref().map(pick));
        format!(
            "{:6} {:10} exit {} trust {:5} λ {:7} peak {:7} part {:7} force {:7} ends {:7} estimate {:7} {:7} {} | {}",
            self.seed,
            format!("{:?}", self.kind),
            self.said.code.map_or("-".to_string(), |code| code.to_string()),
            self.said.trust.map_or("null".to_string(), |trust| trust.to_string()),
            of(|apart| apart.mean),
            of(|apart| apart.peak),
            of(|apart| apart.part),
            of(|apart| apart.force),
            of(|apart| apart.ends),
            number(self.said.estimate[0]),
            number(self.said.estimate[1]),
            self.words,
            if is_quiet(&self.said) { "" } else { self.said.reason.trim() },
        )
    }
}

/// What a table of rows adds up to.
pub struct Totals {
    pub text: String,
    /// Whether the figures that are wanted are held.
    pub held: bool,
    /// Whether there is nothing else than right ones.
    pub all_right: bool,
}

/// Most of the rows may be wrong by 5 to 10 % without a word, and most may be doubted without need.
const MOST_QUIET: f64 = 0.02;
const MOST_FALSE: f64 = 0.1;

/// Estimates count where the true error is above what the reference itself may be off by: of ∫λ ds, of λ.
const FLOORS: [f64; 2] = [1e-3, 0.01];

/// Adds rows up; `dropped` scenes have no reference that is good enough.
pub fn totals(rows: &[Row], dropped: usize) -> Totals {
    let count = |kind: Kind| rows.iter().filter(|row| row.kind == kind).count();
    let [right, alarm, needless, quiet, loud] = [Kind::Right, Kind::Alarm, Kind::FalseAlarm, Kind::Quiet, Kind::Loud].map(count);
    let share = |part: usize| part as f64 / rows.len().max(1) as f64;
    let steps = rows.iter().filter(|row| row.kind == Kind::Right && row.apart.is_some_and(|apart| apart.plain > 0.05)).count();
    let mut text = format!(
        "{} scenes, {dropped} dropped: {right} right, {alarm} doubted and wrong, {needless} doubted without need ({:.1} %, {:.0} at most),\n\
         {quiet} wrong by 5 to 10 % without a word ({:.1} %, {:.0} at most), {loud} by more (0 at most); {steps} right but for the steps of p0\n",
        rows.len(),
        1e2 * share(needless),
        1e2 * MOST_FALSE,
        1e2 * share(quiet),
        1e2 * MOST_QUIET,
    );
    for (k, name) in ["force", "λ"].into_iter().enumerate() {
        text += &format!("estimate of {name} by true error: {}\n", effectivity(rows, k));
    }
    let all_right = right == rows.len() && dropped == 0;
    Totals { text, all_right, held: loud == 0 && share(quiet) <= MOST_QUIET && share(needless) <= MOST_FALSE }
}

/// How estimates compare with true errors, in words.
fn effectivity(rows: &[Row], which: usize) -> String {
    let ratio = |row: &Row| {
        let apart = row.apart.filter(|_| row.possible && row.said.code == Some(0))?;
        let error = [apart.force, apart.plain][which];
        row.said.estimate[which].filter(|_| error > FLOORS[which]).map(|estimate| estimate / error)
    };
    let mut ratios: Vec<f64> = rows.iter().filter_map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let Some(least) = ratios.first() else { return "none to compare".into() };
    let below = |limit: f64| ratios.iter().filter(|ratio| **ratio < limit).count();
    format!(
        "{} rows, least {least:.2}, median {:.2}, most {:.1}; {} below .3, {} of .5 to 3",
        ratios.len(),
        ratios[ratios.len() / 2],
        ratios[ratios.len() - 1],
        below(0.3),
        below(3.0) - below(0.5),
    )
}
