//! Bands of contact: too few segments for a wave (Westergaard), and a leaf that is wrapped on a parabola (beam).

use super::exact::{Material, stiffness, westergaard};
use super::{Answer, Known, sampled};
use crate::layers::Layers;
use crate::scene::{Body, Gap, Press, Scene, Settings};
use crate::shape::{Frame, Shape};
use std::f64::consts::PI;

struct Wave {
    /// Mean pressure by that which closes all.
    share: f64,
    segments: Option<usize>,
    order: usize,
    refine: usize,
    space: &'static str,
    size: f64,
    young: [f64; 2],
    counts: [usize; 2],
}

impl Wave {
    fn known(&self, name: &str, ranks: usize) -> Known {
        let materials = self.young.map(|young| Material { young, poisson: 0.3 });
        let rise = 1e-3;
        let mean = self.share * PI * stiffness(materials) * rise;
        let body = |k: usize| Body {
            seam: Shape::Line { height: 0.0 },
            range: [0.0, 1.0],
            depth: 1.2,
            young: self.young[k],
            poisson: 0.3,
            walls: [true, true],
        };
        let gap = format!("{:?}*(1+cos(2*pi*x/{:?}))", rise * self.size, self.size);
        let scene = Scene {
            frame: Frame { scale: self.size, ..Frame::PLAIN },
            stress: 1.0,
            bodies: [body(0), body(1)],
            gap: Gap::Formula(gap),
            press: Press::Pressure { mean, tilt: 0.0 },
            table: true,
            drawn_aside: 0.0,
            focus: Vec::new(),
        };
        let settings = Settings {
            order: self.order,
            refine: self.refine,
            space: self.space,
            segments: self.segments,
            curve: "line",
            deformed: false,
            swapped: false,
            ranks,
            layers: [0, 1].map(|k| Layers::even(self.counts[k], 1.2, 0.15, 11 + k as u64)),
        };
        let profile = sampled(0.0, 1.0, self.size, |u| westergaard(u - 0.5, 1.0, self.share, mean));
        Known {
            name: format!("wave, {name}"),
            mesh: scene.mesh(&settings.layers),
            case: scene.case(&settings),
            ranks,
            answer: Answer::Pressure { profile, parameter: Box::new(move |x| scene.parameter(x)), centred: false },
        }
    }
}

pub fn all() -> Vec<Known> {
    let plain = Wave {
        share: 0.5,
        segments: Some(3),
        order: 2,
        refine: 2,
        space: "p1-discontinuous",
        size: 1.0,
        young: [1000.0, 1000.0],
        counts: [9, 12],
    };
    vec![
        plain.known("3 segments", 1),
        Wave { space: "p1-continuous", ..plain }.known("3 segments, continuous", 2),
        Wave { segments: Some(5), share: 0.3, space: "p0", ..plain }.known("5 segments, p0", 3),
        Wave { segments: Some(4), share: 0.15, size: 1e3, young: [1e6, 1e3], ..plain }.known("4 segments, stiff below", 1),
        Wave { segments: Some(7), share: 0.2, space: "p1-continuous", order: 1, ..plain }.known("7 segments, P1", 2),
        Wave { segments: Some(6), share: 0.7, refine: 1, size: 1e-3, ..plain }.known("6 segments, refine 1", 3),
        Wave { segments: None, ..plain }.known("auto", 1),
        Wave { segments: None, share: 0.004, ..plain }.known("auto, narrow", 2),
        Wave { segments: None, share: 0.02, space: "p1-continuous", ..plain }.known("auto, a tenth wide", 3),
        Wave { segments: None, share: 0.15, refine: 1, order: 1, space: "p0", counts: [7, 60], ..plain }
            .known("auto, refine 1, P1", 1),
        Wave { segments: None, share: 0.4, refine: 0, counts: [30, 41], ..plain }.known("auto, refine 0", 2),
    ]
}

struct Leaf {
    length: f64,
    thickness: f64,
    /// Where it lifts off, by its length.
    lift: f64,
    force: f64,
    size: f64,
    segments: Option<usize>,
    space: &'static str,
    /// The force, where the leaf's left end is clamped instead of a plane of symmetry.
    clamped: Option<f64>,
}

impl Leaf {
    /// Half a leaf pulled down at the right onto a stiff parabola of radius R. Contact carries all of the load. Along the
    /// parabola the leaf's bending moment is E'I/R, so no shear: it presses where it lifts off, at c with
    /// load (length - c) = E'I/R.
    fn known(&self, name: &str, ranks: usize) -> Known {
        let (young, poisson, size) = (210000.0, 0.3, self.size);
        let bending = young / (1.0 - poisson * poisson) * self.thickness.powi(3) / 12.0;
        let radius = bending / (self.force * self.length * (1.0 - self.lift));
        let body = |depth: f64, young: f64| Body {
            seam: Shape::Line { height: 0.0 },
            range: [0.0, 1.0],
            depth: depth / self.length,
            young,
            poisson,
            walls: [true, false],
        };
        let scene = Scene {
            frame: Frame { scale: size * self.length, ..Frame::PLAIN },
            stress: 1.0,
            bodies: [body(0.3 * self.length, 1e3 * young), body(self.thickness, young)],
            gap: Gap::Formula(format!("x^2/{:?}", 2.0 * radius * size)),
            press: Press::Sides,
            table: true,
            drawn_aside: 0.0,
            focus: Vec::new(),
        };
        let count = (1.2 * self.length / self.thickness) as usize;
        let settings = Settings {
            order: 2,
            refine: 2,
            space: self.space,
            segments: self.segments,
            curve: "line",
            deformed: false,
            swapped: false,
            ranks,
            layers: [Layers::even(count + 3, 0.3, 0.1, 21), Layers::even(count, self.thickness / self.length, 0.1, 22)],
        };
        let mut case = scene.case(&settings);
        if self.clamped.is_some() {
            case += "[support.clamp]\non = \"upper.left\"\nuy = 0.0\n";
        }
        case += &format!("[load.tip]\non = \"upper.right\"\ntraction = [0.0, {:?}]\n", -self.force / self.thickness);
        let answer = match self.clamped {
            Some(force) => Answer::Force { force, most: 0.025, at: None },
            None => Answer::Force {
                force: self.force * size,
                most: 0.01,
                at: Some([self.lift * self.length * size, self.thickness * size]),
            },
        };
        Known { name: format!("leaf, {name}"), mesh: scene.mesh(&settings.layers), case, ranks, answer }
    }
}

pub fn leaves() -> Vec<Known> {
    let plain = Leaf {
        length: 100.0,
        thickness: 4.0,
        lift: 0.5,
        force: 12.0,
        size: 1.0,
        segments: None,
        space: "p1-discontinuous",
        clamped: None,
    };
    vec![
        plain.known("lifts off in the middle", 1),
        Leaf { segments: Some(40), ..plain }.known("40 segments", 2),
        Leaf { segments: Some(20), ..plain }.known("20 segments", 3),
        Leaf { lift: 0.25, thickness: 6.0, size: 1e-3, ..plain }.known("lifts off early, in metres", 1),
        Leaf { lift: 0.7, space: "p1-continuous", ..plain }.known("lifts off late, continuous", 2),
        Leaf { lift: 0.4, force: 1.0, thickness: 3.0, space: "p0", ..plain }.known("light load, p0", 3),
        // Beside the clamp the leaf's lower corner presses as well: 77.0 to 77.7 at refine 3 and 4, with p1-discontinuous,
        // p1-continuous and p0, towards 78.
        Leaf { clamped: Some(78.0), ..plain }.known("clamped", 1),
    ]
}
