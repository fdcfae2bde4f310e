//! A round body that is moved along a flat one: Hertz does not change.

use super::exact::{Material, hertz};
use super::{Answer, Known, sampled};
use crate::layers::{Layers, Peak};
use crate::scene::{Body, Gap, Press, Scene, Settings};
use crate::shape::{Frame, Shape};

struct Shifted {
    half_width: f64,
    /// Relative to the half-width.
    shift: f64,
    young: [f64; 2],
    /// Whether the round body is the lower one.
    below: bool,
    scale: f64,
    order: usize,
    space: &'static str,
    swapped: bool,
    deformed: bool,
}

impl Shifted {
    fn known(&self, name: &str, ranks: usize) -> Known {
        let materials = self.young.map(|young| Material { young, poisson: 0.3 });
        let size = self.scale;
        let peak = 4e-3 * self.young[0].min(self.young[1]);
        let radius = self.half_width * super::exact::stiffness(materials) / (2.0 * peak);
        let force = 0.5 * std::f64::consts::PI * peak * self.half_width;
        let [peak, half_width] = hertz(materials, force, radius);
        let (flat, round) = (Shape::Line { height: 0.0 }, |radius| Shape::Cap { height: 0.0, radius, middle: 0.5 });
        let seams = if self.below { [round(-radius), flat] } else { [flat, round(radius)] };
        let body = |k: usize| Body {
            seam: seams[k],
            range: [0.0, 1.0],
            depth: 0.6,
            young: self.young[k],
            poisson: 0.3,
            walls: [true, k == 0],
        };
        let scene = Scene {
            frame: Frame { scale: size, ..Frame::PLAIN },
            stress: 1.0,
            bodies: [body(0), body(1)],
            gap: Gap::Drawn,
            press: Press::Pressure { mean: force, tilt: 0.0 },
            table: true,
            drawn_aside: -self.shift * half_width,
            focus: Vec::new(),
        };
        let fine = Peak { at: 0.5, reach: 2.5 * half_width, edge: half_width / 3.0 };
        let layers = |count, seed| Layers { peaks: vec![fine], ..Layers::even(count, 0.6, 0.15, seed) };
        let settings = Settings {
            order: self.order,
            refine: 2,
            space: self.space,
            segments: None,
            curve: "fit",
            deformed: self.deformed,
            swapped: self.swapped,
            ranks,
            layers: [layers(9, 3), layers(11, 4)],
        };
        let profile = sampled(0.5 - half_width, 0.5 + half_width, size, |u| {
            peak * (1.0 - ((u - 0.5) / half_width).powi(2)).max(0.0).sqrt()
        });
        Known {
            name: format!("shifted, {name}"),
            mesh: scene.mesh(&settings.layers),
            case: scene.case(&settings),
            ranks,
            answer: Answer::Pressure { profile, parameter: Box::new(move |x| scene.parameter(x)), centred: true },
        }
    }
}

pub fn shifted() -> Vec<Known> {
    let plain = Shifted {
        half_width: 0.05,
        shift: 0.0,
        young: [1000.0, 1000.0],
        below: false,
        scale: 1.0,
        order: 2,
        space: "p1-discontinuous",
        swapped: false,
        deformed: false,
    };
    vec![
        plain.known("by nothing", 1),
        Shifted { shift: 0.3, ..plain }.known("by .3", 2),
        Shifted { shift: -0.6, space: "p1-continuous", swapped: true, ..plain }.known("by -.6, swapped", 3),
        Shifted { shift: 1.0, half_width: 0.03, scale: 1e-3, ..plain }.known("by 1, in metres", 1),
        Shifted { shift: 0.4, young: [1e5, 1e3], order: 1, space: "p0", ..plain }.known("by .4, soft above, P1", 2),
        Shifted { shift: 0.5, below: true, scale: 1e3, ..plain }.known("by .5, round below", 3),
        Shifted { shift: 0.8, young: [1e3, 2e5], ..plain }.known("by .8, soft below", 1),
        Shifted { shift: 0.5, deformed: true, ..plain }.known("by .5, deformed", 2),
    ]
}
