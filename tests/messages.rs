//! What an iteration sends and reduces, counted by a layer of MPI's profiling interface: docs/scaling/counting.c.

#[path = "support/process.rs"]
mod process;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Reductions of an iteration: those of GMRES, all products at once and a norm; and in newer PETSc than 3.18, as we met it in
/// 3.22, one more on several ranks.
fn reductions_of_an_iteration(ranks: usize) -> f64 {
    let is_newer = !mezha::petsc::versions::petsc().starts_with("3.18.");
    if is_newer && ranks > 1 { 3.0 } else { 2.0 }
}

/// Levels that are spread over the ranks, and not on every rank as a whole; see `GATHERED` in src/system/interpolation.
const SPREAD_LEVELS: f64 = 2.0;

/// Messages to each neighbour in an iteration: three exchanges in a V-cycle on each of the spread levels, as often as an F-cycle
/// comes there, and those of the product.
const MOST_MESSAGES: f64 = 16.0;

/// Counts of each rank by their names, and iterations on the finest mesh.
type Counted = (Vec<BTreeMap<String, f64>>, u64);

#[test]
fn an_iteration_reduces_rarely_and_sends_each_neighbour_as_many_messages_on_any_number_of_ranks() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let layer = folder.path().join("counting.so");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scaling/counting.c");
    let mut compile = Command::new("mpicc");
    compile.args(["-shared", "-fPIC", "-O1", "-o"]).arg(&layer).arg(source).arg("-lm");
    let (code, output, errors) = process::finish(compile);
    assert_eq!(code, Some(0), "{output}{errors}");
    for ranks in [1, 2, 4] {
        let [loose, tight] = ["1e-6", "1e-12"].map(|tolerance| counted(folder.path(), &layer, ranks, tolerance));
        let more = (tight.1 - loose.1) as f64;
        assert!(more >= 4.0, "the tight solve makes {more} iterations more");
        for (rank, (before, after)) in loose.0.iter().zip(&tight.0).enumerate() {
            let each = |name: &str| (after[name] - before[name]) / more;
            let [reductions, sums] = ["reductions", "sums"].map(each);
            let others = each("gatherings") + each("broadcasts") + each("barriers") + each("others");
            let messages = each("messages") / after["neighbours"].max(1.0);
            let words = format!(
                "rank {rank} of {ranks}: {reductions} reductions, {sums} sums of vectors, {others} other collectives, {messages} messages to a neighbour"
            );
            assert!(reductions <= reductions_of_an_iteration(ranks) && sums <= SPREAD_LEVELS + 1.0 && others == 0.0, "{words}");
            assert!(messages <= MOST_MESSAGES, "{words}");
            assert!(if ranks == 1 { messages == 0.0 } else { messages > 0.0 }, "{words}");
        }
    }
}

/// Solves to a tolerance.
fn counted(folder: &Path, layer: &Path, ranks: usize, tolerance: &str) -> Counted {
    let (counts, out) = (folder.join("counts"), folder.join("result"));
    let mut command = Command::new("mpirun");
    command.args(["-n", &ranks.to_string(), "--oversubscribe", "--bind-to", "none", "env"]);
    command.args([format!("LD_PRELOAD={}", layer.display()), format!("COUNTING={}", counts.display())]);
    command.arg(env!("CARGO_BIN_EXE_mezha")).args(["run", "cases/bars_inclined/even.toml", "--force", "--out"]).arg(&out);
    for setting in ["mesh.order=1", "contact.seam.multiplier=p0", "exact.must_hold=false", "output.fields=false"] {
        command.args(["--set", setting]);
    }
    command.args(["--set", "solver.inf_sup=false", "--set", &format!("solver.tolerance={tolerance}")]);
    let (code, output, errors) = process::finish(command);
    assert_eq!(code, Some(0), "{output}{errors}");
    let summary = std::fs::read_to_string(out.join("summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&summary).expect("summary.json is JSON");
    let of_rank = |rank: usize| {
        let text = std::fs::read_to_string(folder.join(format!("counts.{rank}"))).expect("the counts of a rank");
        let words: Vec<&str> = text.split_whitespace().collect();
        words.chunks_exact(2).map(|pair| (pair[0].to_string(), pair[1].parse().expect("a number"))).collect()
    };
    let solver = summary["solver"]["krylov"].as_str().expect("words");
    assert_eq!(solver, "fieldsplit (multigrid F-cycle)", "{ranks} ranks: no mesh of the sequence was left to a factor");
    let iterations = summary["solver"]["iterations"].as_array().expect("a list");
    assert_eq!(iterations.len(), 1, "one pass on the finest mesh");
    ((0..ranks).map(of_rank).collect(), iterations[0].as_u64().expect("a number"))
}
