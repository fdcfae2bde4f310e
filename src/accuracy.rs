//! What accuracy a case asks for, and what was reached on each mesh.

use crate::geometry::Point;

/// Share of what is asked for that the estimate of a single value must not exceed on the first mesh.
const FIRST: f64 = 0.25;

/// A contact that carries less than this share of the largest force of all, where no accuracy is asked for, only touches: it is a
/// hundred times what solves to a residual of 1e-8 leave of such forces, and a hundredth of what forces are trusted to.
pub const CARRIES_NOTHING: f64 = 1e-4;

/// A point of a body that is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbePoint {
    /// Name in the case.
    pub name: String,
    /// Name of the body, or of a part of one; two of them may touch there.
    pub body: String,
    /// Where (length).
    pub point: Point,
}

/// A quantity whose error is to be small. Contacts go by their names.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// The displacement in the energy norm.
    Energy,
    /// `∫λ ds` of a contact.
    Force(String),
    /// λ of a contact, root mean square over the middle of what presses.
    Pressure(String),
    /// The largest λ of a contact.
    Peak(String),
    /// The ends of contact, by its width.
    Ends(String),
    /// The displacement at a point, by its own size.
    Displacement(ProbePoint),
    /// The stress at a point, by its own size.
    Stress(ProbePoint),
}

/// A relative error that is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// Of what.
    pub quantity: Quantity,
    /// The largest error, relative to the quantity.
    pub tolerance: f64,
}

/// The accuracy that a case asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// All of them must hold.
    pub goals: Vec<Goal>,
    /// Displacement unknowns of the finest mesh, at most; nothing leaves it to the memory of the machine.
    pub most_unknowns: Option<usize>,
    /// Seconds after which no further mesh is begun.
    pub most_seconds: Option<f64>,
}

/// One mesh of a sequence, in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct AdaptedMesh {
    /// Number, from 1.
    pub number: usize,
    /// Its macro triangles.
    pub macro_triangles: usize,
    /// Refinements of each of them.
    pub refine: usize,
    /// Displacement unknowns.
    pub unknowns: usize,
    /// Displacement unknowns of each refinement that was solved on it, the coarsest first, and Krylov iterations of all its solves.
    pub cycles: Vec<[usize; 2]>,
    /// Estimated error of each goal; nothing where there is not enough to tell.
    pub errors: Vec<Option<f64>>,
    /// True error of each goal, where the case tells it; empty if nobody has looked.
    pub true_errors: Vec<Option<f64>>,
    /// Seconds since the first mesh was begun.
    pub seconds: f64,
}

/// Why a sequence of meshes has ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SequenceEnd {
    /// A mesh could not be solved.
    #[default]
    Unsolved,
    /// All goals hold.
    Reached,
    /// The next mesh would have more unknowns than are allowed.
    Unknowns,
    /// The seconds are over.
    Seconds,
    /// There are as many meshes as there may be.
    Meshes,
    /// The estimate of a goal no longer falls, or cannot be had.
    Stuck,
    /// Finer meshes could not be solved.
    Refused,
    /// The largest λ of a contact is asked for, and grows without bound.
    Unbounded,
}

/// How meshes were adapted to an accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct Adaptation {
    /// What was asked for.
    pub accuracy: Accuracy,
    /// Contacts that lay at a point, on whose width the first mesh was refined before it was solved.
    pub resolved: Vec<String>,
    /// Every mesh, the last one is that of the solution.
    pub meshes: Vec<AdaptedMesh>,
    /// Why there is no further one.
    pub end: SequenceEnd,
    /// Why finer meshes could not be solved, if they could not.
    pub refusal: Option<String>,
}

/// Edges that the narrowest contact which counts has at least: on less than one no element can bend to a pressure.
pub const NARROWEST: f64 = 1.0;

/// Force that overlaps within segments are worth, as a share of the force that was found, beyond which a contact is not resolved.
pub const WORTH_WITHIN_SEGMENTS: f64 = 0.5;

/// That share beyond which its pressure is doubted, and a finer mesh is taken where an accuracy is asked for: a tenth of Hertz's approach,
/// some 3 F/E, is worth as much (an overlap by F/E was worth .3).
pub const DOUBTED_WITHIN_SEGMENTS: f64 = 0.1;

/// How deep bodies may lie in each other, as a share of how far they have come together: in all cases of the project it is below 3 %.
pub const DEEPEST: f64 = 0.1;

/// A depth by less than this share of the largest displacement is what the solve leaves.
pub const LEFT: f64 = 1e-6;

/// λ by its largest, where contact is cut off though the bodies go on smoothly: half an ellipse that is cut off at both ends where it has a
/// tenth of its height lacks 4e-4 of its force.
pub const CUT: f64 = 0.1;

/// Force of a contact narrower than its segment by that of an overlap within it at most (Hertz): π / (4 ln(4 R/b) - 2), and R > 5 b.
pub const HERTZ_BY_UNRESOLVED: f64 = 0.32;

/// A force below this share of what overlaps within segments are worth is what solves leave: 1e-10 to 1.6e-9 of it in a sleeve that is
/// loose between the heads of a hot bolt, where nothing else presses. What mesh and segments are too coarse for carries a hundredth of that and more.
pub const ROUNDING_BY_OVERLAP: f64 = 1e-6;

/// The share of the largest force of all contacts below which one only touches: the smallest error that is asked for, if any is.
pub fn share_of_nothing(asked: Option<&Accuracy>) -> f64 {
    let goals = asked.iter().flat_map(|asked| &asked.goals);
    goals.map(|goal| goal.tolerance).reduce(f64::min).unwrap_or(CARRIES_NOTHING)
}

impl Quantity {
    /// The word for it, as in the case.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Energy => "energy",
            Self::Force(_) => "force",
            Self::Pressure(_) => "pressure",
            Self::Peak(_) => "peak",
            Self::Ends(_) => "ends",
            Self::Displacement(_) => "displacement",
            Self::Stress(_) => "stress",
        }
    }

    /// Whether its error is a norm, that falls with the root of what lies in the parts of the mesh.
    pub fn is_norm(&self) -> bool {
        matches!(self, Self::Energy | Self::Pressure(_))
    }

    /// The contact that it is of, if it is of one.
    pub fn contact(&self) -> Option<&str> {
        match self {
            Self::Force(name) | Self::Pressure(name) | Self::Peak(name) | Self::Ends(name) => Some(name),
            Self::Energy | Self::Displacement(_) | Self::Stress(_) => None,
        }
    }

    /// The contact or the probe that it is of; nothing for the whole scene.
    pub fn of(&self) -> Option<&str> {
        match self {
            Self::Displacement(probe) | Self::Stress(probe) => Some(&probe.name),
            _ => self.contact(),
        }
    }
}

impl Accuracy {
    /// The points that goals are set for, each once.
    pub fn probes(&self) -> Vec<ProbePoint> {
        let mut all: Vec<ProbePoint> = Vec::new();
        for goal in &self.goals {
            if let Quantity::Displacement(probe) | Quantity::Stress(probe) = &goal.quantity
                && !all.contains(probe)
            {
                all.push(probe.clone());
            }
        }
        all
    }
}

impl Adaptation {
    /// Before the first mesh.
    pub fn new(accuracy: Accuracy) -> Self {
        Self { accuracy, resolved: Vec::new(), meshes: Vec::new(), end: SequenceEnd::Unsolved, refusal: None }
    }

    /// The estimate of each goal at which it counts as reached on the last mesh. The first mesh may be too coarse to show how
    /// slowly a value comes to rest: its estimate must be so much smaller, but of contacts whose width was known before.
    pub fn wanted(&self) -> Vec<f64> {
        let is_first = self.meshes.len() == 1;
        let share = |goal: &Goal| {
            let is_resolved = goal.quantity.contact().is_some_and(|name| self.resolved.iter().any(|resolved| resolved == name));
            let may_be_luck = is_first && goal.quantity != Quantity::Energy && !is_resolved;
            if may_be_luck { FIRST } else { 1.0 }
        };
        self.accuracy.goals.iter().map(|goal| share(goal) * goal.tolerance).collect()
    }

    /// Estimated error of a goal on the last mesh.
    pub fn error(&self, place: usize) -> Option<f64> {
        self.meshes.last().and_then(|mesh| mesh.errors.get(place).copied().flatten())
    }

    /// The goals that are missed on the last mesh, with their places among all.
    pub fn missed(&self) -> impl Iterator<Item = (usize, &Goal)> {
        let wanted = self.wanted();
        let holds = move |place: usize| self.error(place).is_some_and(|error| error <= wanted[place]);
        self.accuracy.goals.iter().enumerate().filter(move |(place, _)| !holds(*place))
    }

    /// Whether the errors on the last mesh are what was asked for.
    pub fn is_reached(&self) -> bool {
        !self.meshes.is_empty() && self.missed().next().is_none()
    }
}
