//! Krylov iterations of the field split: few with levels, on meshes of any size, for every pair of spaces, whatever the
//! ratio of the moduli. The law is bilateral, so that one linear solve counts.

use crate::support::mesh::{Mesh, write_scene};
use crate::support::{Run, pairs_on_ranks, ranks_in_turn};

const LEVELS: u64 = 15;
const STIFF_ON_SOFT: u64 = 20;
const STIFF: &str = "E2/E1 = 1e6";

/// Example 1 without its own segments and expected values.
const BARS: &str = r#"
mesh.file = "mesh.msh"
body.lower = { young = 7000.0, poisson = 0.227 }
body.upper = { young = 7000.0, poisson = 0.227 }
support.table = { on = "bottom", uy = 0.0 }
support.wall = { on = "left", ux = 0.0 }
load.top = { on = "top", pressure = 1.0 }
contact.seam = { between = ["lower.seam", "upper.seam"], curve = "line", gap = "closed", law = "bilateral" }
"#;

fn bars() -> Run {
    let run = Run::case("bars_inclined/even.toml").set("contact.seam.law", "bilateral").set("exact.must_hold", false);
    run.set("contact.seam.segments", "auto").set("solver.tolerance", "1e-8")
}

/// Every pair of spaces needs at most `most` iterations, on any number of ranks.
fn at_most(most: u64, words: &str, run: impl Fn(usize) -> Run) {
    let mut missed = Vec::new();
    for (order, space, ranks) in pairs_on_ranks() {
        let run = run(order).ranks(ranks).set("mesh.order", order).set("contact.seam.multiplier", space);
        let ended = run.converged();
        let (count, unknowns) = (ended.iterations(), ended.number("/unknowns/displacement"));
        assert_eq!(ended.value("/solver/iterations").as_array().map(Vec::len), Some(1), "one linear solve");
        // Rounding of a stiff body that moves as far as a soft one gives: at E2/E1 = 1e6 it may come first, and is told.
        let stopped = ended.value("/reason").to_string().contains("rounding allows no less");
        assert!(ended.number("/solver/residual") <= 1e-8 || stopped && words == STIFF, "{}", ended.said());
        let line = format!("{words}, P{order} and {space}, {unknowns} unknowns, {ranks} ranks: {count} iterations");
        println!("{line}");
        if count > most {
            missed.push(line);
        }
    }
    assert!(missed.is_empty(), "more than {most}:\n{}", missed.join("\n"));
}

#[test]
fn with_levels_near_1e4_unknowns() {
    at_most(LEVELS, "levels", |order| bars().set("mesh.refine", 5 - order));
}

#[test]
fn with_levels_near_1e5_unknowns() {
    at_most(LEVELS, "levels", |order| bars().set("mesh.refine", 6 - order));
}

#[test]
fn a_stiff_bar_on_a_soft_one() {
    at_most(STIFF_ON_SOFT, STIFF, |order| bars().set("mesh.refine", 5 - order).set("body.upper.young", "7e9"));
}

#[test]
fn a_soft_bar_on_a_stiff_one() {
    at_most(STIFF_ON_SOFT, "E2/E1 = 1e-6", |order| bars().set("mesh.refine", 5 - order).set("body.upper.young", "7e-3"));
}

/// Files of the mesh for P1 and for P2, `n` intervals each: fine ones get auxiliary levels.
fn of_file(n: [usize; 2], most: u64, words: &str, change: impl Fn(Run) -> Run) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let files = n.map(|n| {
        let folder = folder.path().join(n.to_string());
        std::fs::create_dir(&folder).expect("a folder");
        write_scene(&folder, &Mesh::inclined_bars(n).text(), BARS)
    });
    at_most(most, words, |order| change(Run::file(&files[order - 1]).set("solver.name", "fieldsplit")));
}

#[test]
fn without_levels_near_1e4_unknowns() {
    of_file([10, 5], LEVELS, "no levels", |run| run);
}

#[test]
fn without_levels_near_1e5_unknowns() {
    of_file([32, 16], LEVELS, "no levels", |run| run);
}

#[test]
fn a_stiff_bar_without_levels() {
    of_file([10, 8], STIFF_ON_SOFT, STIFF, |run| run.set("body.upper.young", "7e9"));
}

#[test]
fn a_large_macro_mesh_with_levels() {
    of_file([10, 8], LEVELS, "a large macro mesh", |run| run.set("mesh.refine", 1));
}

/// Rounding is all that stops it: MUMPS's own pivot threshold ran out of memory from ν = 0.4999 on.
#[test]
fn the_direct_solver_nearly_incompressible() {
    for (at, poisson) in [0.49, 0.499, 0.4999, 0.49999].into_iter().enumerate() {
        for ranks in ranks_in_turn(at) {
            let run = bars().ranks(ranks).set("solver.name", "direct").set("mesh.refine", 3);
            let ended = run.set("body.lower.poisson", poisson).set("body.upper.poisson", poisson).converged();
            assert!(ended.iterations() <= 3, "ν = {poisson}, {ranks} ranks: {} iterations", ended.iterations());
            assert!((ended.number("/contact/seam/force") / 37f64.sqrt() - 1.0).abs() < 1e-7, "ν = {poisson}, {ranks} ranks");
        }
    }
}

/// Square bodies of two triangles each: no auxiliary level is smaller than their mesh, which all ranks factorise together. One lies
/// on another one, the others are alone; all bear a pressure of 1.
#[test]
fn many_small_bodies() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = write_scene(folder.path(), &squares(400), &of_squares(400));
    for ranks in ranks_in_turn(0) {
        let ended = Run::file(&file).ranks(ranks).set("solver.tolerance", "1e-9").converged();
        assert!(ended.number("/unknowns/displacement") > 2.0 * 3000.0, "a macro mesh of more than 3000 unknowns");
        assert!(ended.iterations() <= 5, "{ranks} ranks: {} iterations", ended.iterations());
        let force = ended.number("/contact/seam/force");
        assert!((force - 1.0).abs() < 1e-8, "ten times the solver's tolerance, {ranks} ranks: {force}");
    }
}

/// A mesh of unit squares, 2 apart; the last one lies on the one before. Gmsh 2.2.
fn squares(count: usize) -> String {
    let (mut names, mut nodes, mut elements) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..count {
        let ([x, y], at) = (if k + 1 < count { [2 * k, 0] } else { [2 * k - 2, 1] }, 4 * k + 1);
        let points = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
        nodes.extend(points.iter().zip(at..).map(|((x, y), number)| format!("{number} {x} {y} 0")));
        let sides = [("bottom", [at, at + 1]), ("left", [at + 3, at]), ("top", [at + 2, at + 3])];
        for ((name, [a, b]), tag) in sides.into_iter().zip(at..) {
            names.push(format!("1 {tag} \"{name}-{k}\""));
            elements.push(format!("1 2 {tag} {tag} {a} {b}"));
        }
        names.push(format!("2 {} \"body-{k}\"", at + 3));
        let halves = [[at, at + 1, at + 2], [at, at + 2, at + 3]];
        elements.extend(halves.map(|[a, b, c]| format!("2 2 {0} {0} {a} {b} {c}", at + 3)));
    }
    let elements: Vec<String> = elements.iter().zip(1..).map(|(element, number)| format!("{number} {element}")).collect();
    let section = |name: &str, lines: &[String]| format!("${name}\n{}\n{}\n$End{name}\n", lines.len(), lines.join("\n"));
    let sections = [section("PhysicalNames", &names), section("Nodes", &nodes), section("Elements", &elements)];
    format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{}", sections.concat())
}

fn of_squares(count: usize) -> String {
    let mut case = String::from("mesh = { file = \"mesh.msh\", refine = 1, order = 1 }\n");
    for k in 0..count {
        case += &format!("body.body-{k} = {{ young = 100.0, poisson = 0.3 }}\n");
        case += &format!("support.left-{k} = {{ on = \"left-{k}\", ux = 0.0 }}\n");
        if k + 1 < count {
            case += &format!("support.table-{k} = {{ on = \"bottom-{k}\", uy = 0.0 }}\n");
        }
        if k + 2 != count {
            case += &format!("load.top-{k} = {{ on = \"top-{k}\", pressure = 1.0 }}\n");
        }
    }
    let [below, above] = [format!("top-{}", count - 2), format!("bottom-{}", count - 1)];
    case + &format!(
        "contact.seam = {{ between = [\"{below}\", \"{above}\"], curve = \"line\", gap = \"closed\", multiplier = \"p0\" }}\n"
    )
}

/// On the mesh as it comes there is one auxiliary level, and on a finer one there are several; on refined meshes there are others
/// above them. PETSc shows the cycle by its name.
#[test]
fn the_cycle_goes_down_to_auxiliary_levels() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let files = [6, 10].map(|columns| {
        let folder = folder.path().join(columns.to_string());
        std::fs::create_dir(&folder).expect("a folder");
        write_scene(&folder, &Mesh::inclined_bars(columns).text(), BARS)
    });
    for ((file, refine, order), ranks) in
        [(0, 0, 1), (1, 0, 1), (1, 1, 2)].into_iter().flat_map(|run| ranks_in_turn(1).into_iter().map(move |ranks| (run, ranks)))
    {
        let run = || {
            Run::file(&files[file])
                .ranks(ranks)
                .set("mesh.order", order)
                .set("mesh.refine", refine)
                .set("solver.tolerance", "1e-6")
        };
        let [own, of_petsc] =
            [run(), run().petsc("-fieldsplit_u_pc_type cholesky -fieldsplit_u_pc_factor_mat_solver_type mumps")]
                .map(|run| run.petsc("-ksp_view").converged());
        let unknowns = own.number("/unknowns/displacement") / 4f64.powi(refine);
        assert!(unknowns > 3000.0, "a macro mesh of more than 3000 unknowns: {unknowns}");
        let shown =
            [&own, &of_petsc].map(|ended| ended.output.contains("multigrid F-cycle on even macro triangles and stored rows"));
        assert_eq!(shown, [true, false], "{}", own.output);
        let forces = [&own, &of_petsc].map(|ended| ended.number("/contact/seam/force"));
        assert!((forces[0] / forces[1] - 1.0).abs() < 1e-6, "the solver's tolerance, {ranks} ranks: {forces:?}");
    }
}

/// Above half a million unknowns BiCGStab takes the place of GMRES, and hands over to what is stronger where it must.
#[test]
fn large_systems_are_solved_by_a_short_recurrence() {
    let large = || bars().ranks(2).set("mesh.order", 1).set("mesh.refine", 7).set("output.fields", false);
    let (long, short) = (large().petsc("-ksp_type gmres").converged(), large().converged());
    assert!(short.iterations() < long.iterations(), "{} and {}", short.iterations(), long.iterations());
    let tight = large().set("solver.tolerance", "1e-13").converged();
    for other in [&short, &tight] {
        let forces = [&long, other].map(|ended| ended.number("/contact/seam/force"));
        assert!((forces[0] / forces[1] - 1.0).abs() < 1e-7, "{forces:?}");
    }
    let soft = |run: Run| run.set("body.upper.poisson", 0.49).set("body.lower.poisson", 0.49).converged();
    let (weak, known) = (soft(large()), soft(large().petsc("-ksp_type fgmres")));
    assert!(weak.said().contains("CG steps"), "{}", weak.said());
    let forces = [&weak, &known].map(|ended| ended.number("/contact/seam/force"));
    assert!((forces[0] / forces[1] - 1.0).abs() < 1e-7, "{forces:?}");
}

/// What large systems are solved with, on a small one: BiCGStab has two cycles in an iteration.
#[test]
fn a_short_recurrence_finds_the_same() {
    for ranks in [1, 2] {
        let run = || bars().ranks(ranks).set("mesh.order", 1).set("mesh.refine", 5);
        let (long, short) = (run().converged(), run().petsc("-ksp_type fbcgs").converged());
        assert!(short.iterations() <= long.iterations(), "{} and {}", short.iterations(), long.iterations());
        let forces = [&long, &short].map(|ended| ended.number("/contact/seam/force"));
        assert!((forces[0] / forces[1] - 1.0).abs() < 1e-7, "{forces:?}");
    }
}
