//! Fits with a gap formula that leave the bodies: two quarter rings, pressed together by their interference (Lamé, Michell).

use super::exact::{Material, rings};
use super::{Answer, Known, sampled};
use crate::layers::Layers;
use crate::scene::{Body, Gap, Press, Scene, Settings};
use crate::shape::{Frame, Shape};
use std::f64::consts::FRAC_PI_2;

struct Rings {
    radii: [f64; 3],
    young: [f64; 2],
    poisson: [f64; 2],
    interference: [f64; 2],
    scale: f64,
    order: usize,
    refine: usize,
    space: &'static str,
    counts: [usize; 2],
}

impl Rings {
    fn known(&self, name: &str, ranks: usize) -> Known {
        let ([a, b, c], size) = (self.radii, self.scale);
        let seam = Shape::Arc { radius: b, from: 0.0, to: FRAC_PI_2 };
        let materials = [0, 1].map(|k| Material { young: self.young[k], poisson: self.poisson[k] });
        let depths = [b - a, c - b];
        let body = |k: usize| Body {
            seam,
            range: [0.0, 1.0],
            depth: depths[k],
            young: self.young[k],
            poisson: self.poisson[k],
            walls: [true, true],
        };
        let [even, twice] = self.interference;
        let scene = Scene {
            frame: Frame { scale: size, ..Frame::PLAIN },
            stress: 1.0,
            bodies: [body(0), body(1)],
            gap: Gap::Formula(format!("-{:?}-({:?})*(x^2-y^2)/{:?}", even * size, twice * size, (b * size).powi(2))),
            press: Press::Sides,
            table: false,
            drawn_aside: 0.0,
            focus: Vec::new(),
        };
        let settings = Settings {
            order: self.order,
            refine: self.refine,
            space: self.space,
            segments: None,
            curve: "fit",
            deformed: false,
            swapped: false,
            ranks,
            layers: [0, 1].map(|k| Layers::even(self.counts[k], depths[k] / seam.length(), 0.15, 7 + k as u64)),
        };
        let [even, twice] = rings(materials, self.radii, self.interference);
        let length = seam.length() * size;
        let profile = sampled(0.0, 1.0, length, |u| even + twice * (2.0 * u * FRAC_PI_2).cos());
        Known {
            name: format!("rings, {name}"),
            mesh: scene.mesh(&settings.layers),
            case: scene.case(&settings),
            ranks,
            answer: Answer::Pressure { profile, parameter: Box::new(move |x| scene.parameter(x)), centred: false },
        }
    }
}

pub fn all() -> Vec<Known> {
    let plain = Rings {
        radii: [1.0, 2.0, 3.0],
        young: [5000.0, 11000.0],
        poisson: [0.33, 0.2],
        interference: [0.004, 0.0015],
        scale: 1.0,
        order: 2,
        refine: 2,
        space: "p1-discontinuous",
        counts: [7, 9],
    };
    vec![
        plain.known("as it was found", 1),
        Rings { refine: 3, counts: [6, 11], space: "p1-continuous", ..plain }.known("finer, continuous", 2),
        Rings { radii: [0.5, 1.5, 1.9], interference: [0.01, -0.004], scale: 1e-3, ..plain }.known("thin outside, in metres", 3),
        Rings { young: [2e5, 2e3], interference: [0.002, 0.0], space: "p0", ..plain }.known("stiff inside, p0", 1),
        Rings { radii: [2.0, 2.5, 4.0], order: 1, refine: 3, scale: 1e6, ..plain }.known("thin inside, P1, large", 2),
        Rings { interference: [0.0004, 0.0001], counts: [12, 5], ..plain }.known("a tenth of the interference", 3),
    ]
}
