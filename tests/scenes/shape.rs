//! The smooth shapes of boundaries, in a frame of the scene's own.

use std::f64::consts::PI;

/// Where the scene lies: turned by `angle`, `scale` times as large, moved by `shift`.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub scale: f64,
    pub angle: f64,
    pub shift: [f64; 2],
}

impl Frame {
    /// The frame that changes nothing.
    pub const PLAIN: Self = Self { scale: 1.0, angle: 0.0, shift: [0.0, 0.0] };

    /// A point of the scene in the plane.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (s, c) = self.angle.sin_cos();
        [self.shift[0] + self.scale * (c * x - s * y), self.shift[1] + self.scale * (s * x + c * y)]
    }

    /// A point of the plane in the scene.
    pub fn local(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (s, c) = self.angle.sin_cos();
        let (x, y) = ((x - self.shift[0]) / self.scale, (y - self.shift[1]) / self.scale);
        [c * x + s * y, c * y - s * x]
    }

    /// The scene's own x as a formula of the x and y of the plane.
    pub fn local_x(&self) -> String {
        let (s, c) = self.angle.sin_cos();
        let [a, b] = self.shift;
        format!("((({c:?})*(x-({a:?}))+({s:?})*(y-({b:?})))/{:?})", self.scale)
    }

    /// The square of the distance from a point of the scene, as a formula of the plane's x and y.
    fn square_distance(&self, point: [f64; 2]) -> String {
        let [a, b] = self.place(point);
        format!("((x-({a:?}))^2+(y-({b:?}))^2)")
    }

    /// `exp(-d²/w²)`, d the distance from a point of the scene, as a formula of the plane's x and y.
    pub fn bump(&self, point: [f64; 2], width: f64) -> String {
        format!("exp(-{}/({:?})^2)", self.square_distance(point), width * self.scale)
    }
}

/// A boundary of a body in the scene's frame; its parameter goes from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// y = `height`, x from 0 to 1.
    Line { height: f64 },
    /// y = `height` + `slope` x, x from 0 to 1.
    Cone { height: f64, slope: f64 },
    /// y = `height` + `bend` (x - `middle`)², x from 0 to 1.
    Parabola { height: f64, bend: f64, middle: f64 },
    /// y = `height` + `rise` (1 - cos 2π(`count` x - `phase`))/2, x from 0 to 1.
    Wave { height: f64, rise: f64, count: f64, phase: f64 },
    /// The part of a circle over x from 0 to 1 that opens upwards for a positive radius.
    Cap { height: f64, radius: f64, middle: f64 },
    /// A circle about the origin between two angles.
    Arc { radius: f64, from: f64, to: f64 },
}

impl Shape {
    /// The point at a parameter.
    pub fn at(&self, u: f64) -> [f64; 2] {
        match *self {
            Self::Line { height } => [u, height],
            Self::Cone { height, slope } => [u, height + slope * u],
            Self::Parabola { height, bend, middle } => [u, height + bend * (u - middle).powi(2)],
            Self::Wave { height, rise, count, phase } => {
                [u, height + 0.5 * rise * (1.0 - (2.0 * PI * (count * u - phase)).cos())]
            }
            Self::Cap { height, radius, middle } => {
                [u, height + radius - radius.signum() * (radius * radius - (u - middle).powi(2)).sqrt()]
            }
            Self::Arc { radius, from, to } => {
                let (s, c) = (from + u * (to - from)).sin_cos();
                [radius * c, radius * s]
            }
        }
    }

    /// The parameter of the point next to this one, along the shape.
    pub fn parameter(&self, [x, y]: [f64; 2]) -> f64 {
        match *self {
            Self::Arc { from, to, .. } => {
                let turn = y.atan2(x) - from;
                (turn - 2.0 * PI * (turn / (2.0 * PI)).round()) / (to - from)
            }
            _ => x,
        }
    }

    /// The same shape, moved away by a distance: up, or outwards.
    pub fn moved(&self, by: f64) -> Self {
        match *self {
            Self::Arc { radius, from, to } => Self::Arc { radius: radius + by, from, to },
            _ => unreachable!("only arcs have outer boundaries like themselves"),
        }
    }

    /// Its length, if it is nearly straight.
    pub fn length(&self) -> f64 {
        match *self {
            Self::Arc { radius, from, to } => radius * (to - from).abs(),
            _ => 1.0,
        }
    }

    /// Whether it meets its side at a right angle, to a few degrees.
    pub fn is_square(&self, end: f64) -> bool {
        let ([a, low], [b, high]) = (self.at(end - 1e-4), self.at(end + 1e-4));
        matches!(self, Self::Arc { .. }) || ((high - low) / (b - a)).abs() < 0.05
    }

    /// Whether it is straight.
    pub fn is_line(&self) -> bool {
        matches!(self, Self::Line { .. } | Self::Cone { .. })
    }

    /// Its height over the scene's own x, as a formula of what stands for x.
    pub fn height(&self, x: &str) -> String {
        match *self {
            Self::Line { height } => format!("({height:?})"),
            Self::Cone { height, slope } => format!("({height:?})+({slope:?})*{x}"),
            Self::Parabola { height, bend, middle } => format!("({height:?})+({bend:?})*({x}-({middle:?}))^2"),
            Self::Wave { height, rise, count, phase } => {
                format!("({height:?})+({:?})*(1-cos(2*pi*({count:?}*{x}-({phase:?}))))", 0.5 * rise)
            }
            Self::Cap { height, radius, middle } => {
                format!("({:?})-({:?})*sqrt({:?}-({x}-({middle:?}))^2)", height + radius, radius.signum(), radius * radius)
            }
            Self::Arc { .. } => unreachable!("an arc is no graph"),
        }
    }

    /// What a `[geometry]` of it says after `curves`; nothing if it is straight.
    pub fn geometry(&self, frame: &Frame) -> Option<String> {
        let circle = |centre: [f64; 2], radius: f64| {
            let [a, b] = frame.place(centre);
            Some(format!("circle = {{ centre = [{a:?}, {b:?}], radius = {:?} }}", radius.abs() * frame.scale))
        };
        let (s, c) = frame.angle.sin_cos();
        let ([a, b], size) = (frame.shift, frame.scale);
        match *self {
            Self::Line { .. } | Self::Cone { .. } => None,
            Self::Parabola { .. } | Self::Wave { .. } => {
                let y = self.height("t");
                Some(format!(
                    "x = \"({a:?})+{size:?}*(({c:?})*t-({s:?})*({y}))\"\ny = \"({b:?})+{size:?}*(({s:?})*t+({c:?})*({y}))\"\nt = [-0.01, 1.01]"
                ))
            }
            Self::Cap { height, radius, middle } => circle([middle, height + radius], radius),
            Self::Arc { radius, .. } => circle([0.0, 0.0], radius),
        }
    }
}
