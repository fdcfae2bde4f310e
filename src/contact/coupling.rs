//! Coupling of one body's boundary to the multipliers of Γ_C, and its share of the initial gap.
//!
//! On a closed Γ_C feet of nodes are known but for whole turns, so an edge across the seam is integrated in two parts:
//! `cases/rings_full` has the same discrete solution as its quarter, to rounding. A gap that is measured is never that of the
//! polygons: with it a prototype had errors of λ of 8 % to 1000 % on curved meshes that do not match. On two quarter rings of
//! straight edges that overlap by 1e-3 (P1, `p0`, nothing declared; 16, 32 and 64 edges against 20, 40 and 80) splines through
//! the nodes leave a relative L2 error of λ of 1.9e-2, 1.3e-2 and 9.6e-3. On the mesh of `cases/rings`, whose edges are bent,
//! the fitted curve has 1.34e-5 at `refine = 3`, as the declared circle has.

use super::contact_boundary::ContactBoundary;
use super::multiplier::Multipliers;
use super::pair::Quadrature;
use super::quadrature::quadrature_points;
use super::side::Side;
use super::trace::trace;
use crate::geometry::{Coordinates, Curve, Formula, Point};
use crate::mesh::{BoundaryEdge, EdgeNode};

/// One entry of the coupling: multiplier `i`, node `j`, and `± ∫ψ_i N_j n ds` (length), + for body 1, - for body 2. In bodies of
/// revolution each integral here has the factor `2πx`.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Multiplier, counted along its own boundary.
    pub multiplier: usize,
    /// Node of the body's boundary.
    pub node: EdgeNode,
    /// The integral.
    pub value: Point,
}

/// Where the distances to a body's undeformed boundary come from.
pub enum Distance<'a> {
    /// Not needed: the gap is declared.
    Declared,
    /// The body's smooth boundary, in pieces: where the normal meets it.
    Curves(&'a [Curve]),
    /// The body's smooth boundary, in pieces, for a normal that meets the body deformed or shifted: where the corresponding point lies
    /// undeformed.
    Places(&'a [Curve]),
}

/// What the edges of one body that a rank owns contribute to a contact.
#[derive(Clone, Debug)]
pub struct Integrals {
    /// Entries of `B`.
    pub entries: Vec<Entry>,
    /// `∫ψ_i d ds` (length squared) with the distance `d = n·(X - x)` of the undeformed corresponding point from Γ_C,
    /// signed so that both bodies' shares add up to `c`.
    pub gap: Vec<f64>,
    /// Quadrature points that the edges have taken.
    pub points: usize,
}

/// Integrates the edges of one body that a rank owns.
///
/// # Errors
/// Words, if the normal of Γ_C misses the declared shape.
pub fn integrate(
    boundary: &ContactBoundary,
    multipliers: &Multipliers,
    rule: Quadrature,
    side: Side,
    edges: &[BoundaryEdge],
    distance: &Distance,
) -> Result<Integrals, String> {
    let points = quadrature_points(boundary, edges, rule);
    let mut entries = Vec::new();
    let mut gap = vec![0.0; multipliers.count()];
    for together in points.chunk_by(|a, b| (a.edge, a.segment) == (b.edge, b.segment)) {
        let (small, segment) = (&edges[together[0].edge], together[0].segment);
        let first = entries.len();
        for i in multipliers.on_segment(segment, 0.0).0.into_iter().take(multipliers.per_segment()) {
            entries.extend(small.nodes.iter().map(|&node| Entry { multiplier: i, node, value: Point::zeros() }));
        }
        for point in together {
            let normal = boundary.normal(point.parameter);
            let here = trace(boundary, small, point.parameter);
            let (rows, values) = multipliers.on_segment(segment, point.fraction);
            let d = distance.at(boundary.point(point.parameter), normal, here.place)?;
            for k in 0..multipliers.per_segment() {
                let weight = side.sign() * point.weight * values[k];
                gap[rows[k]] -= weight * d;
                for a in 0..small.nodes.len() {
                    entries[first + k * small.nodes.len() + a].value += weight * here.values[a] * normal;
                }
            }
        }
    }
    Ok(Integrals { entries, gap, points: points.len() })
}

impl Distance<'_> {
    /// Distance along the normal from `x` on Γ_C to the boundary, undeformed; `place` is where the corresponding point
    /// lies on the mesh. A piece goes on beyond its ends, but one that is met within them comes first.
    ///
    /// # Errors
    /// Words, if the normal meets no piece.
    pub fn at(&self, x: Point, normal: Point, place: Point) -> Result<f64, String> {
        match self {
            Self::Declared => Ok(0.0),
            Self::Curves(curves) => {
                let hits = curves.iter().filter_map(|curve| curve.hit(x, normal));
                let nearer = |a: &(f64, f64), b: &(f64, f64)| a.1.total_cmp(&b.1).then(a.0.abs().total_cmp(&b.0.abs()));
                hits.min_by(nearer).map(|(distance, _)| distance).ok_or_else(|| {
                    format!(
                        "the normal of the contact boundary at {} misses the boundary of a body; give `gap` as a number or a formula",
                        Coordinates(x)
                    )
                })
            }
            Self::Places(curves) => {
                let smooth = curves.iter().map(|curve| curve.point(curve.nearest(place)));
                let nearest = smooth.min_by(|a, b| (a - place).norm().total_cmp(&(b - place).norm()));
                Ok((nearest.unwrap_or(place) - x).dot(&normal))
            }
        }
    }
}

/// Share of a segment beside its end where a gap must have a value: the end itself may lie outside by rounding.
const BESIDE: f64 = 1e-9;

/// `∫ψ_i g₀ ds` of a declared gap, a formula of `x, y`.
///
/// # Errors
/// Words, if the formula has no finite value at a point of the integral or at the end of a segment.
pub fn declared_gap(boundary: &ContactBoundary, multipliers: &Multipliers, formula: &Formula) -> Result<Vec<f64>, String> {
    check_ends(boundary, formula)?;
    let mut gap = vec![0.0; multipliers.count()];
    for (k, z, t, length) in boundary.gauss_by_parameter(10) {
        let (rows, values) = multipliers.on_segment(k, z);
        let declared = formula.finite_value(boundary.point(t))?;
        for a in 0..multipliers.per_segment() {
            gap[rows[a]] += length * boundary.width(t) * values[a] * declared;
        }
    }
    Ok(gap)
}

/// A gap has a finite value at the ends of segments, where it is written out.
fn check_ends(boundary: &ContactBoundary, formula: &Formula) -> Result<(), String> {
    for ends in boundary.knots().windows(2) {
        for (end, other) in [(ends[0], ends[1]), (ends[1], ends[0])] {
            let here = boundary.point(end);
            if formula.value(&[here.x, here.y]).is_infinite() {
                formula.finite_value(here)?;
            }
            formula.finite_value(boundary.point(end + BESIDE * (other - end)))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::pair::MultiplierSpace;
    use super::*;
    use crate::element::Order;
    use crate::geometry::ParametricCurve;
    use crate::mesh::samples::two_blocks;
    use crate::mesh::{Level, MacroMesh, Numbering, Partition};
    use std::rc::Rc;

    /// A bent seam between the sample blocks, five segments, P2 edges at one refinement.
    fn setting(space: MultiplierSpace) -> (MacroMesh, ContactBoundary, Multipliers, [Vec<BoundaryEdge>; 2]) {
        let mut mesh = two_blocks();
        let read = |text| Formula::parse(text, &["t"]).expect("a formula");
        let curve = Curve::Parametric(ParametricCurve::new(read("t"), read("1 + 0.1*t*(2-t)*(t-0.9)"), [0.0, 2.0]));
        mesh.bend("seam", &["lower.seam".into(), "upper.seam".into()], &curve).expect("the vertices lie on it");
        let partition = Rc::new(Partition::new(&mesh, &[0; 6], 1));
        let numbering = Numbering::new(Level { intervals: 4, order: Order::P2 }, &partition);
        let mut boundary = ContactBoundary::new(curve, [0.0, 2.0], Point::new(0.0, 1.0));
        boundary.cut(&[0.0, 0.2, 0.35, 0.6, 0.8, 1.0]);
        let edges = ["lower.seam", "upper.seam"].map(|name| {
            let edges = &mesh.boundary(name).expect("named").edges;
            edges.iter().flat_map(|&edge| BoundaryEdge::all_of(&mesh, edge, &numbering)).collect()
        });
        let multipliers = Multipliers::new(space, &boundary);
        (mesh, boundary, multipliers, edges)
    }

    #[test]
    fn both_bodies_feel_the_same_force_and_moment_of_every_multiplier() {
        let spaces = [MultiplierSpace::P0, MultiplierSpace::P1Discontinuous, MultiplierSpace::P1Continuous];
        let rules = [Quadrature::Cut, Quadrature::Segment { points: 5 }];
        for (space, rule) in spaces.into_iter().flat_map(|space| rules.map(|rule| (space, rule))) {
            let (mesh, boundary, multipliers, edges) = setting(space);
            let mut sums = vec![[0.0; 3]; multipliers.count()];
            let partition = Rc::new(Partition::new(&mesh, &[0; 6], 1));
            let numbering = Numbering::new(Level { intervals: 4, order: Order::P2 }, &partition);
            for (side, edges) in [Side::First, Side::Second].into_iter().zip(&edges) {
                let found = integrate(&boundary, &multipliers, rule, side, edges, &Distance::Declared).expect("declared");
                for entry in found.entries {
                    let x = entry.node.place(&mesh, &numbering);
                    let sum = &mut sums[entry.multiplier];
                    sum[0] += entry.value.x;
                    sum[1] += entry.value.y;
                    sum[2] += crate::geometry::cross(x, entry.value);
                }
            }
            assert!(sums.iter().flatten().all(|sum| sum.abs() < 1e-12), "{space:?}, {rule:?}: {sums:?}");
        }
    }

    #[test]
    fn a_declared_gap_is_weighted_by_the_shape_functions() {
        let (_, boundary, multipliers, _) = setting(MultiplierSpace::P1Continuous);
        let gap = declared_gap(&boundary, &multipliers, &Formula::constant(-0.5)).expect("a number");
        assert!((gap.iter().sum::<f64>() + 0.5 * boundary.length()).abs() < 1e-13);
    }

    #[test]
    fn a_gap_without_a_value_at_an_end_or_inside_is_told_with_its_place() {
        let (_, boundary, multipliers, _) = setting(MultiplierSpace::P0);
        let of = |text| declared_gap(&boundary, &multipliers, &Formula::parse(text, &["x", "y"]).expect("a formula"));
        assert_eq!(of("1/x").unwrap_err(), "\"1/x\" has no finite value at (0, 1); correct the formula");
        assert!(of("sqrt(1.5-x)").unwrap_err().contains("\"sqrt(1.5-x)\" has no finite value at (1.6"));
        assert!(of("sqrt(x)").is_ok() && of("sqrt(x + 0*y - 1e-14)").is_ok(), "an end may lie outside by rounding");
    }
}
