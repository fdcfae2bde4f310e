//! Preconditioners of the displacements.

use crate::discretisation::{SMALL, Scene};
use crate::element::Plane;

/// What preconditions the displacements, the weakest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Preconditioning {
    /// Multigrid with one symmetric Gauss-Seidel sweep.
    Sweep,
    /// Multigrid with a few steps of CG, preconditioned by the sweep.
    Steps,
    /// A Cholesky factor.
    Factor,
}

/// Steps of CG of one smoothing. Thin shells of revolution (P2, ν = 0.49, two ranks, 1.5·10⁴ to 3.4·10⁶ unknowns) take 16 to 18
/// iterations with two, 11 to 14 with three and 8 to 10 with four; flat needles 24, 16 and 13, upright ones of P2 25, 22 and 21.
/// Seconds are alike to a fifth.
const STEPS: usize = 4;

/// Unknowns up to which a factor is tried: a thick sphere of P2 and 4.3 million unknowns takes 11.3 GB.
pub const LARGEST_FACTOR: usize = 4_500_000;

/// Ratio of graded refinement below which triangles are too flat for a sweep: it needs more iterations on each level.
const FLAT: f64 = 0.25;

/// Poisson's ratio above which a sweep is slow, in the plane and of a body of revolution. A thin shell of revolution (P2, 1.5·10⁴
/// unknowns, two ranks) takes 13 iterations with 0.45, 15 with 0.46, 18 with 0.47 and 25 with 0.49; a thick sphere of P1 and P2 (1.8·10³
/// to 4.3·10⁵ unknowns) 11 to 13 with 0.42, 12 to 14 with 0.43, and 13 to 16 with 0.45.
const STIFF: [f64; 2] = [0.45, 0.42];

/// Poisson's ratio above which steps of CG are slow, too, where the rows of the finest mesh are stored. Bars of P2 and 2.6·10⁵
/// unknowns without levels take 11 to 15 iterations with 0.494, in the time of a factor, and 32 to 39 with 0.499, in three times its
/// time. Bars of P1 lose: with 0.494 and 6.5·10⁴ unknowns the factor takes 1.4 times as long. A thick sphere of P2 takes 13 to 14
/// iterations with 0.492, 13 to 16 with 0.494, in four fifths of the factor's time, and 37 with 0.496, in twice its time (1.1·10⁵ unknowns).
const STIFFEST: [f64; 2] = [0.494, 0.491];

impl Preconditioning {
    /// The cheapest one that does on a scene after so many refinements.
    pub fn of(scene: &Scene, refine: usize) -> Self {
        if is_flat(scene, refine) || scene.poisson() > of_plane(STIFF, scene) { Self::Steps } else { Self::Sweep }
    }

    /// Where to begin on a scene of so many unknowns if the choice is free, and why, in words.
    pub fn first(scene: &Scene, unknowns: usize) -> (Self, String) {
        let no_levels = "the mesh has no levels (refine = 0)";
        if scene.refine == 0 && unknowns <= SMALL {
            let words = format!(
                "fieldsplit with a Cholesky factor, because {no_levels}, and {unknowns} unknowns are no more than {SMALL}"
            );
            return (Self::Factor, words);
        }
        let are_stored = scene.refine == 0 || scene.mesh.plane == Plane::Revolution;
        if are_stored && scene.poisson() > of_plane(STIFFEST, scene) && unknowns <= LARGEST_FACTOR {
            let ratio = of_plane(STIFFEST, scene);
            let words = format!("fieldsplit with a Cholesky factor, because some Poisson's ratio is above {ratio}");
            return (Self::Factor, words);
        }
        let preconditioning = Self::of(scene, scene.refine);
        let (cycle, levels) = match scene.refine {
            0 => ("multigrid on auxiliary levels", format!("{no_levels}, and {unknowns} unknowns are more than {SMALL}")),
            refine => ("multigrid", format!("the mesh has {} levels", refine + 1)),
        };
        let why = match preconditioning {
            Self::Sweep | Self::Factor => String::new(),
            Self::Steps if is_flat(scene, scene.refine) => format!(" and some mesh.grade.ratio is below {FLAT}"),
            Self::Steps => format!(" and some Poisson's ratio is above {}", of_plane(STIFF, scene)),
        };
        (preconditioning, format!("fieldsplit with {}, because {levels}{why}", preconditioning.words(cycle)))
    }

    /// Steps of CG that smooth in the place of one sweep.
    pub fn conjugate_steps(self) -> usize {
        match self {
            Self::Sweep | Self::Factor => 0,
            Self::Steps => STEPS,
        }
    }

    /// What it does, after the name of the cycle.
    pub fn words(self, cycle: &str) -> String {
        match self {
            Self::Sweep => cycle.to_string(),
            Self::Steps => format!("{cycle}, smoothed by {STEPS} CG steps"),
            Self::Factor => "Cholesky factor".to_string(),
        }
    }
}

/// Of two figures that of the plane, or that of bodies of revolution.
fn of_plane([plane, revolution]: [f64; 2], scene: &Scene) -> f64 {
    if scene.mesh.plane == Plane::Revolution { revolution } else { plane }
}

/// Whether graded refinement makes triangles too flat for a sweep.
fn is_flat(scene: &Scene, refine: usize) -> bool {
    refine > 0 && scene.mesh.ratios.values().any(|&ratio| ratio < FLAT)
}

#[cfg(test)]
mod tests {
    use super::Preconditioning::{Factor, Steps, Sweep};
    use super::*;
    use crate::contact::MultiplierSpace;
    use crate::discretisation::samples::{blocks, pair};
    use crate::geometry::Point;
    use std::rc::Rc;

    /// Two blocks of one Poisson's ratio, refined by some ratios at vertices.
    fn scene(refine: usize, poisson: f64, ratios: &[(u32, f64)]) -> Scene {
        let mut scene = blocks(pair(MultiplierSpace::P0, 2), |_| Point::zeros(), Vec::new());
        scene.refine = refine;
        scene.bodies.iter_mut().for_each(|body| body.parts[0].material.poisson = poisson);
        Rc::make_mut(&mut scene.mesh).ratios = ratios.iter().copied().collect();
        scene
    }

    /// A scene as one of bodies of revolution.
    fn turned(mut scene: Scene) -> Scene {
        Rc::make_mut(&mut scene.mesh).plane = Plane::Revolution;
        scene
    }

    #[test]
    fn a_small_mesh_without_levels_begins_with_a_factor() {
        let first = |refine, unknowns| Preconditioning::first(&scene(refine, 0.3, &[]), unknowns).0;
        assert_eq!([first(0, 2000), first(0, 10_000), first(2, 10_000)], [Factor, Sweep, Sweep]);
    }

    #[test]
    fn flat_triangles_begin_with_the_stronger_smoother() {
        let (preconditioning, words) = Preconditioning::first(&scene(2, 0.3, &[(1, 0.4), (2, 0.2)]), 10_000);
        assert_eq!((preconditioning, Preconditioning::of(&scene(2, 0.3, &[(0, 0.3)]), 2)), (Steps, Sweep));
        assert!(words.contains("smoothed by 4 CG steps, because the mesh has 3 levels and some mesh.grade.ratio"), "{words}");
        assert_eq!(Preconditioning::of(&scene(0, 0.3, &[(0, 0.2)]), 0), Sweep, "not refined at all");
    }

    #[test]
    fn nearly_incompressible_bodies_begin_with_the_stronger_smoother() {
        for refine in [0, 2] {
            let (preconditioning, words) = Preconditioning::first(&scene(refine, 0.46, &[]), 10_000);
            assert!(preconditioning == Steps && words.ends_with("and some Poisson's ratio is above 0.45"), "{words}");
            assert_eq!(Preconditioning::of(&scene(refine, 0.45, &[]), refine), Sweep);
            let of_revolution = [0.42, 0.43].map(|ratio| Preconditioning::of(&turned(scene(refine, ratio, &[])), refine));
            assert_eq!(of_revolution, [Sweep, Steps]);
        }
    }

    #[test]
    fn what_steps_of_cg_are_slow_on_begins_with_a_factor_where_rows_are_stored() {
        let first = Preconditioning::first(&scene(2, 0.496, &[]), 10_000).0;
        assert_eq!(first, Steps, "in the plane rows on a lattice are alike");
        assert_eq!(Preconditioning::first(&scene(0, 0.492, &[]), 10_000).0, Steps);
        for scene in [&scene(0, 0.496, &[]), &turned(scene(2, 0.492, &[]))] {
            assert_eq!([10_000, LARGEST_FACTOR + 1].map(|unknowns| Preconditioning::first(scene, unknowns).0), [Factor, Steps]);
        }
    }
}
