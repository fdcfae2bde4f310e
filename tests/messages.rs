//! What an iteration sends and reduces, counted by a layer of MPI's profiling interface: docs/scaling/counting.c.

use crate::support::process;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Reductions of an iteration: those of GMRES, all products at once and a norm; and in newer PETSc than 3.18, as we met it in
/// 3.22, one more on several ranks.
fn reductions_of_an_iteration(ranks: usize) -> f64 {
    let is_newer = !mezha::petsc::versions::petsc().starts_with("3.18.");
    if is_newer && ranks > 1 { 3.0 } else { 2.0 }
}

/// Numbers of ranks, with the messages that the busiest one sends in an iteration, and all in the mean, as they were seen. In the
/// mean they fall from 4 ranks on; the busiest one has ever fewer new neighbours.
const SEEN: [(usize, [f64; 2]); 5] = [(1, [0.0; 2]), (2, [17.0; 2]), (4, [42.0, 35.0]), (8, [64.0, 33.25]), (16, [69.0, 31.3])];

/// What may be sent, in parts of that: partitioners of other releases deal otherwise.
const MARGIN: f64 = 1.1;

/// Counts of each rank by their names, and iterations on the finest mesh.
type Counted = (Vec<BTreeMap<String, f64>>, u64);

#[test]
fn an_iteration_reduces_rarely_and_its_messages_stop_growing_with_the_ranks() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let layer = folder.path().join("counting.so");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scaling/counting.c");
    let mut compile = Command::new("mpicc");
    compile.args(["-shared", "-fPIC", "-O1", "-o"]).arg(&layer).arg(source).arg("-lm");
    let (code, output, errors) = process::finish(compile);
    assert_eq!(code, Some(0), "{output}{errors}");
    for (ranks, [most, mean]) in SEEN.map(|(ranks, seen)| (ranks, seen.map(|count| MARGIN * count))) {
        let [loose, tight] = ["1e-6", "1e-12"].map(|tolerance| counted(folder.path(), &layer, ranks, tolerance));
        let more = (tight.1 - loose.1) as f64;
        assert!(more >= 4.0, "the tight solve makes {more} iterations more");
        let mut sent = Vec::new();
        for (rank, (before, after)) in loose.0.iter().zip(&tight.0).enumerate() {
            let each = |name: &str| (after[name] - before[name]) / more;
            let (reductions, messages) = (each("reductions"), each("messages"));
            let others = ["sums", "gatherings", "broadcasts", "barriers", "others"].map(each).iter().sum::<f64>();
            let words =
                format!("rank {rank} of {ranks}: {reductions} reductions, {others} other collectives, {messages} messages");
            assert!(reductions <= reductions_of_an_iteration(ranks) && others == 0.0, "{words}");
            assert!(messages <= most && (ranks == 1 || messages > 0.0), "{words}");
            sent.push(messages);
        }
        let in_the_mean = sent.iter().sum::<f64>() / ranks as f64;
        assert!(in_the_mean <= mean, "{ranks} ranks send {in_the_mean} messages in the mean: {sent:?}");
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
