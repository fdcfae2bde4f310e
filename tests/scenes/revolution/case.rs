//! A scene of two bodies of revolution, and what its case file says beside that of the plane.

use crate::profile::Profile;
use crate::run::{Said, run_within};
use crate::scene::{Scene, Settings};
use crate::support::mesh::{Mesh, write_scene};
use std::path::Path;
use std::time::Duration;

/// The longest that a run may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// Heat of a body: the strain αϑ, and how it changes along the axis.
#[derive(Clone, Copy, Debug)]
pub struct Heat {
    pub strain: f64,
    pub slope: f64,
}

/// What the upper body is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Upper {
    /// A body like the lower one.
    Body,
    /// A body under a stiff plate that presses along the axis with this force.
    Plate(f64),
    /// A rigid tool of the shape of its seam that carries this force.
    Tool(f64),
    /// A rigid tool that goes down by this.
    Moved(f64),
}

/// A scene of the plane's kind, turned about the axis x = 0 of its frame.
pub struct Round {
    pub kind: &'static str,
    pub scene: Scene,
    pub upper: Upper,
    pub hot: [Option<Heat>; 2],
    /// The axis has no support of its own.
    pub bare_axis: bool,
    /// How far the right ends of both bodies are moved outwards.
    pub ends: [f64; 2],
    /// The error of λ and of its force that is asked for.
    pub accuracy: Option<f64>,
    /// The residual that is asked for.
    pub tolerance: f64,
    pub exact: Option<Profile>,
}

impl Round {
    pub fn is_tool(&self) -> bool {
        matches!(self.upper, Upper::Tool(_) | Upper::Moved(_))
    }

    /// Runs it in a folder.
    pub fn solve(&self, settings: &Settings, folder: &Path) -> Said {
        std::fs::create_dir_all(folder).expect("a folder");
        let blocks = self.scene.blocks(&settings.layers).into_iter().take(if self.is_tool() { 1 } else { 2 });
        let mesh = Mesh { bodies: blocks.collect() }.text();
        let file = write_scene(folder, &mesh, &self.case(settings));
        run_within(PATIENCE, &file, settings.ranks, |x| self.scene.parameter(x))
    }

    /// The case file.
    pub fn case(&self, settings: &Settings) -> String {
        let mut text =
            format!("plane = \"axisymmetric\"\nsolver.tolerance = {:?}\n{}", self.tolerance, self.scene.case(settings));
        let Scene { frame, stress, .. } = &self.scene;
        let unit = stress * frame.scale * frame.scale;
        for (k, name) in ["lower", "upper"].into_iter().enumerate() {
            if let Some(Heat { strain, slope }) = self.hot[k] {
                let heat =
                    format!("expansion = 1e-5\ntemperature = \"{:?}*(1+({slope:?})*y/{:?})\"\n", strain * 1e5, frame.scale);
                text = text.replace(&format!("[body.{name}]\n"), &format!("[body.{name}]\n{heat}"));
            }
            let wall = |side: &str| format!("[support.{name}_{side}]\non = \"{name}.{side}\"\nnormal = 0.0\n");
            if self.bare_axis || k == 1 && self.is_tool() {
                text = text.replace(&wall("left"), "");
            }
            let moved = wall("right").replace("= 0.0", &format!("= {:?}", self.ends[k] * frame.scale));
            text = text.replace(&wall("right"), &moved);
        }
        let held = match self.upper {
            Upper::Body => String::new(),
            Upper::Plate(force) => {
                text += &format!("[load.top]\non = \"upper.outer\"\nrigid = true\nforce = [0.0, {:?}]\n", -force * unit);
                String::new()
            }
            Upper::Tool(force) => format!("force = [0.0, {:?}]\n", -force * unit),
            Upper::Moved(way) => format!("uy = {:?}\n", -way * frame.scale),
        };
        if self.is_tool() {
            text = self.with_tool(&text, &held);
        }
        if let Some(error) = self.accuracy {
            text += &format!("[accuracy]\npressure = {error:?}\nforce = {error:?}\nmax_seconds = 30\n");
        }
        text
    }

    /// The upper body is a tool: its table goes, and the geometry of its seam is the tool's.
    fn with_tool(&self, text: &str, held: &str) -> String {
        let body = self.scene.bodies[1].clone();
        let (young, poisson) = (body.young * self.scene.stress, body.poisson);
        let geometry = "[geometry.two]\ncurves = [\"upper.seam\"]\n";
        let tool = format!("[rigid.tool]\n{held}");
        let mut text = text.replace(&format!("[body.upper]\nyoung = {young:?}\npoisson = {poisson:?}\n"), "");
        text = text
            .replace("\"upper.seam\"]\ncurve", "\"rigid.tool\"]\ncurve")
            .replace("[\"upper.seam\", \"lower.seam\"]", "[\"rigid.tool\", \"lower.seam\"]");
        if text.contains(geometry) {
            return text.replace(geometry, &tool).replace("t = [-0.01, 1.01]", "t = [0.0, 1.0]");
        }
        let [a, b] = body.range.map(|u| self.scene.frame.place(body.seam.at(u)));
        format!("{text}{tool}line = [{a:?}, {b:?}]\n")
    }

    /// What the truth is computed of: where one body is flat, with the gap as a formula.
    pub fn flattened(&self) -> Self {
        let scene = self.scene.flattened().unwrap_or_else(|| self.scene.clone());
        Self { scene, exact: None, accuracy: None, tolerance: 1e-8, ..*self }
    }
}
