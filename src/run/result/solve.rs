//! What a run does with the events of the solution procedure: it prints them, and times the work.

use crate::case::LambdaExact;
use crate::contact::SegmentRule;
use crate::discretisation::Scene;
use crate::output::RunError;
use crate::petsc::StageGuard;
use crate::procedure::{Event, Observer, Procedure, Solved, Work};
use crate::run::reading::checks::check_pressures;
use crate::run::telling::report::Stages;
use crate::run::telling::{interruption, progress};
use crate::run::verdict::true_errors::true_errors;
use crate::run::{Run, accuracy, memory};

impl Run<'_> {
    /// Solves a scene as the case wants it, from the solution of the load step before, if there is any. **Collective**
    pub(in crate::run) fn solve(&self, scene: Scene, before: Option<&Solved>) -> Result<Solved, RunError> {
        let solver = &self.case.solver;
        let (choice, tolerance, inf_sup) = (solver.choice, solver.tolerance, solver.inf_sup);
        let accuracy = self.case.accuracy.as_ref().map(|accuracy| accuracy::limited(accuracy, self.session));
        let accuracy = accuracy.as_ref();
        let given = self.case.contacts.iter().filter(|pair| pair.segments != SegmentRule::Auto || pair.grading != [1.0, 1.0]);
        for pair in given.filter(|_| accuracy.is_some()) {
            self.report.say(&format!("contact {}: `segments` and `grading` of the case are not used; with an accuracy the segments follow the edges of each mesh", pair.name));
        }
        let procedure = Procedure { choice, tolerance, inf_sup, accuracy, session: self.session, observer: self };
        // An accuracy has a limit to its meshes.
        if accuracy.is_none() && before.is_none() {
            memory::refuse_too_large(scene.refine, |refine| procedure.need(&scene, refine), self.session)?;
        }
        if self.case.exact.contacts.iter().any(|exact| matches!(exact.lambda, Some(LambdaExact::Formula { .. }))) {
            let at_rest = Procedure::look(&scene, self.session.rank())?;
            check_pressures(self.case, &at_rest.contacts).map_err(RunError::Key)?;
        }
        Ok(procedure.solve(scene, before)?)
    }
}

impl Observer for Run<'_> {
    fn observe(&self, event: Event) {
        self.report.event(&event);
        interruption::observe(&event, self.case);
        progress::observe(&event);
        if let Event::Adapted { accuracy, solved, .. } = event {
            let _stage = self.stages.output.enter();
            let errors = true_errors(self.case, &accuracy.goals, solved);
            // What cannot be looked at is told by the evaluation of the result.
            self.true_errors.borrow_mut().push(errors.unwrap_or_default());
        }
    }

    fn enter(&self, work: Work) -> Option<StageGuard<'_>> {
        interruption::enter(work);
        progress::enter(work);
        let Stages { assemble, contact, setup, solve, output, .. } = &*self.stages;
        let stage = match work {
            Work::Contact => contact,
            Work::Assembly => assemble,
            Work::SetUp => setup,
            Work::Solve => solve,
            Work::Recovery => output,
        };
        Some(stage.enter())
    }
}
