//! The first mesh, begun by the quadratic programme, unless that is dear: where the sides come within reach, what presses, how every
//! body moves.
//!
//! It gives displacements and pressures to begin with, and finer meshes begin with those of the mesh before: with its set alone
//! 102 cases took 7 % more cycles. Solving it again on each mesh takes more time than it saves: the disc in a box takes .7 s without
//! that and 1.1 s with it, the bearing 4.4 and 5.5 s. Where the programme would take more than some 3e8 operations, some 20 000 triangles
//! of each body on the coarsest mesh, all contact is closed at first: two bars of 78 thousand triangles each, P2, took as many sets and
//! iterations either way, and the programme 65 of 79 s.

use crate::contact::Known;
use crate::discretisation::{
    BoundaryMotion, Contact, Discretisation, Scene, Space, SystemError, bilateral, finest_numbering, not_held,
    not_held_if_closed, spaces,
};
use crate::geometry::Point;
use crate::mesh::{EdgeNode, Level, Numbering};
use crate::procedure::one_mesh::wide_contact::{
    Fineness, asked, drawn_contacts, least_force, narrowed, wide_contacts, with_touch,
};
use crate::procedure::sequence::LoadedPlace;
use crate::procedure::settings::Procedure;
use crate::programme::{FoundByProgramme, Prediction, Predictor};
use crate::system::Start;

/// Operations of a programme that are less than a few sets on the same mesh cost: some tenths of a second.
pub const MOST_WORK: f64 = 3e8;

/// Gap by the length of a contact that counts as closed: what the programme leaves of none.
const TOUCHING: f64 = 1e-9;

/// What the programme says of a mesh of which nothing else is known.
pub(crate) enum Begun {
    /// The contacts as they will lie, and where to start; contacts as they are drawn and no start where the programme has no answer or is
    /// dear.
    Ready(Box<Discretisation>, Option<Start>),
    /// A body that nothing holds, or that the loads drive off all its contacts, in words.
    Free(Box<Discretisation>, String),
}

impl Procedure<'_> {
    /// Begins a mesh of which nothing is known. **Collective**
    ///
    /// # Errors
    /// [`SystemError`] if contacts cannot be placed, supports contradict each other, or a triangle is turned inside out.
    pub(crate) fn begun(&self, scene: Scene) -> Result<Begun, SystemError> {
        let spaces = spaces(&scene, self.session.rank())?;
        let finest = &spaces[spaces.len() - 1].numbering;
        if !is_assembly(&scene)
            && let Ok(drawn) = Contact::all(&scene, finest, self.session.rank())
            && work_of_programme(&scene, finest.level, &drawn) > MOST_WORK
        {
            return self.begun_without_programme(scene, spaces, &drawn);
        }
        let whole = scene.on_one_rank();
        let numbering = Numbering::new(spaces[spaces.len() - 1].numbering.level, &whole.partition);
        let wide = wide_contacts(&whole, &numbering, Fineness::Graded)?;
        let free = |scene: Scene, words: String| Ok(Begun::Free(Box::new(Discretisation::new(scene, self.session)?), words));
        let unknown = |scene: Scene| Ok(Begun::Ready(Box::new(Discretisation::new(scene, self.session)?), None));
        let not_held = not_held_if_closed(&whole, &numbering, &drawn_contacts(&wide));
        if let Some(words) = self.session.agree(not_held)? {
            return free(scene, words);
        }
        let predictor = if self.session.rank() == 0 { Predictor::new(&whole, &numbering).map(Some) } else { Ok(None) };
        let predictor = self.session.agree(predictor)?;
        let predict = |contacts: &[Contact]| self.shared(predictor.as_ref(), contacts, numbering.node_count());
        let (wide, found) = match asked(&whole, &numbering, wide, self.accuracy, predict)? {
            (wide, Prediction::Held(found)) => (wide, found),
            (_, Prediction::Driven { words, .. }) => return free(scene, words),
            (_, Prediction::Unknown(_)) => return unknown(scene),
        };
        let pressing = active(&drawn_contacts(&wide), &found);
        let least = least_force(&wide, &found.pressures, self.accuracy);
        let known: Vec<Known> = wide.iter().map(|wide| narrowed(wide, &pressing, &found, least)).collect();
        let displacement = |node: EdgeNode| found.displacement[node.number(&whole.mesh, &numbering)];
        let contacts = Contact::all_again(&whole, &numbering, 0, &known, &displacement)?;
        let Prediction::Held(found) = predict(&contacts)? else { return unknown(scene) };
        drop(predictor);
        let space = &spaces[spaces.len() - 1];
        let start = Start {
            displacement: space.unknowns_of(&scene, self.session.rank(), |triangle| {
                let (there, displacement) = (numbering.triangle(&scene.mesh, triangle), &found.displacement);
                move |_, (i, j)| displacement[there.node(i, j)]
            }),
            active: active(&contacts, &found),
            pressures: found.pressures,
        };
        let motion = BoundaryMotion::new(&scene, space, &start.displacement, self.session);
        let displacement = |node: EdgeNode| motion.at(node, &scene.mesh, space);
        let placed = Contact::all_again(&scene, &space.numbering, self.session.rank(), &known, &displacement)?;
        // Where the bodies have moved on since, a boundary may have other segments: then nothing is known of them.
        let is_same = contacts.iter().map(Contact::range).eq(placed.iter().map(Contact::range));
        let problem = Discretisation::with(scene, spaces, placed, motion, self.session)?;
        if !is_same {
            return Ok(Begun::Ready(Box::new(problem), None));
        }
        Ok(Begun::Ready(Box::new(problem), Some(start)))
    }

    /// Begins a mesh with contacts as they are `drawn`, which their forces place later on where sides touch at a point. **Collective**
    fn begun_without_programme(&self, scene: Scene, spaces: Vec<Space>, drawn: &[Contact]) -> Result<Begun, SystemError> {
        let numbering = &spaces[spaces.len() - 1].numbering;
        let known = with_touch(&scene, numbering, drawn);
        let contacts = Contact::all_again(&scene, numbering, self.session.rank(), &known, &|_| Point::zeros())?;
        let problem = Discretisation::with(scene, spaces, contacts, BoundaryMotion::default(), self.session)?;
        let free = not_held(&problem, &vec![true; problem.multiplier_count()]);
        let problem = Box::new(problem);
        Ok(match free {
            Some(words) => Begun::Free(problem, words),
            None => Begun::Ready(problem, None),
        })
    }

    /// Where contacts press on the coarsest mesh, and how large their forces are; nothing if the programme has no answer, or would
    /// be dear.
    /// **Collective**
    ///
    /// # Errors
    /// As of [`Procedure::begun`].
    pub(crate) fn loaded_places(&self, scene: &Scene) -> Result<Option<Vec<LoadedPlace>>, SystemError> {
        let whole = scene.on_one_rank();
        let numbering = finest_numbering(&whole)?;
        let wide = wide_contacts(&whole, &numbering, Fineness::Graded)?;
        let drawn = drawn_contacts(&wide);
        if work_of_programme(scene, numbering.level, &drawn) > MOST_WORK {
            return Ok(None);
        }
        let predictor = if self.session.rank() == 0 { Predictor::new(&whole, &numbering).map(Some) } else { Ok(None) };
        let predictor = self.session.agree(predictor)?;
        let Prediction::Held(found) = self.shared(predictor.as_ref(), &drawn, numbering.node_count())? else { return Ok(None) };
        Ok(Some(wide.iter().enumerate().map(|(at, wide)| wide.loaded(at, &found.pressures)).collect()))
    }

    /// What the programme of rank 0 says, on every rank. **Collective**
    fn shared(&self, predictor: Option<&Predictor>, contacts: &[Contact], nodes: usize) -> Result<Prediction, SystemError> {
        let own = predictor.map(|predictor| predictor.predict(contacts)).transpose();
        let own = self.session.agree(own)?;
        let is_held = self.session.any(matches!(own, Some(Prediction::Held { .. })));
        if !is_held {
            let is_driven = self.session.any(matches!(own, Some(Prediction::Driven { .. })));
            let turns = self.session.any(matches!(own, Some(Prediction::Driven { turns: true, .. })));
            let words = || match own {
                Some(Prediction::Driven { words, .. } | Prediction::Unknown(words)) => Ok::<_, String>(words.into_bytes()),
                _ => Ok(Vec::new()),
            };
            let words = self.session.share(words)?;
            let words = String::from_utf8_lossy(&words).into_owned();
            return Ok(if is_driven { Prediction::Driven { words, turns } } else { Prediction::Unknown(words) });
        }
        let count = contacts.last().map_or(0, |contact| contact.range().end);
        let mut all = vec![0.0; 2 * nodes + 2 * count];
        if let Some(Prediction::Held(FoundByProgramme { displacement, pressures, gaps })) = own {
            let values = displacement.iter().flat_map(|u| [u.x, u.y]).chain(pressures).chain(gaps);
            all.iter_mut().zip(values).for_each(|(to, value)| *to = value);
        }
        self.session.sum(&mut all);
        let (moved, multipliers) = all.split_at(2 * nodes);
        let displacement = moved.chunks_exact(2).map(|u| Point::new(u[0], u[1])).collect();
        let (pressures, gaps) = multipliers.split_at(count);
        Ok(Prediction::Held(FoundByProgramme { displacement, pressures: pressures.to_vec(), gaps: gaps.to_vec() }))
    }
}

/// Operations of the programme on a mesh, roughly: the factor of each body, and a solve with it for each multiplier that it sees.
pub fn work_of_programme(scene: &Scene, level: Level, contacts: &[Contact]) -> f64 {
    let intervals = level.intervals as f64;
    let mut bodies = vec![[0.0; 2]; scene.bodies.len()];
    scene.mesh.triangles.iter().for_each(|triangle| bodies[triangle.body as usize][0] += intervals * intervals);
    for contact in contacts {
        contact.bodies.iter().for_each(|&body| bodies[body][1] += contact.multipliers.count() as f64);
    }
    bodies.iter().map(|[unknowns, multipliers]| 10.0 * unknowns.powf(1.5) + 60.0 * unknowns * multipliers).sum()
}

/// Whether bodies are free to roll or slide but for means that are held: without the programme nothing is known of their motions,
/// however dear it is.
fn is_assembly(scene: &Scene) -> bool {
    !scene.means.is_empty()
}

/// What presses: the pressure is worth more penetration than there is gap.
fn active(contacts: &[Contact], found: &FoundByProgramme) -> Vec<bool> {
    let both = bilateral(contacts);
    let presses = |contact: &Contact, i: usize| {
        let own = i - contact.first;
        let worth = found.pressures[i] * contact.multipliers.length(own) / contact.multiplier_moduli[own];
        both[i] || worth >= found.gaps[i] || found.gaps[i] <= TOUCHING * contact.boundary.length()
    };
    contacts.iter().flat_map(|contact| contact.range().map(move |i| (contact, i))).map(|(c, i)| presses(c, i)).collect()
}
