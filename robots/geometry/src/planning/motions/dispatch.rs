//! Entry points of the motion queries: methods of the query context, each a function of one file of this
//! folder.

use super::{explain, go_to, look, offer, outcome, pull, push, put, reach};
use crate::planning::context::QueryContext;
use crate::planning::query::answer::{
    Infeasible, MotionAnswer, MotionQuery, MotionWitness, SearchBudget, UnknownReason,
};
use crate::planning::scene::contact::Contact;
use crate::planning::scene::scene_state::SceneState;

impl QueryContext<'_> {
    /// Fills the caches that are otherwise filled by the first query.
    #[must_use]
    pub fn ready(self) -> Self {
        self.prepare();
        self
    }

    /// Answers a query. The same context, query and budget give the same answer, bit for bit.
    ///
    /// The answer is unknown where a shape is a mesh, or where the robot collides at the start.
    #[must_use]
    pub fn answer(&self, query: &MotionQuery, budget: SearchBudget) -> MotionAnswer {
        if let Some(why) = self.blind_spot() {
            return MotionAnswer::Unknown(UnknownReason::Because(why));
        }
        if let Some(Contact { link, other, .. }) = self.start_contact() {
            let why = format!("at the start `{link}` touches `{other}`");
            return MotionAnswer::Unknown(UnknownReason::Because(why));
        }
        match query {
            MotionQuery::GoTo(to) => go_to::go_to(self, to, budget),
            MotionQuery::Reach(object, side) => reach::reach(self, object, *side, budget),
            MotionQuery::Put(object, on) => put::put(self, object, on, budget),
            MotionQuery::Offer(object, to) => offer::offer(self, object, to, budget),
            MotionQuery::Look(at) => look::look(self, at, budget),
            MotionQuery::Pull(id) => pull::pull(self, id, [0.0, 1.0], budget),
            MotionQuery::Push(id) => push::push(self, id, budget),
            MotionQuery::Posture(name) => go_to::to_posture(self, name),
            MotionQuery::Other(name) => {
                MotionAnswer::Unknown(UnknownReason::Because(format!("`{name}` is not computed yet")))
            }
        }
    }

    /// Completes an infeasible answer with the nearest change that would help, in words, where one is known.
    ///
    /// Each suggested change was tried: with it the motion is feasible. Where every route of the base is
    /// cut off, the
    /// reason names the obstacle. Takes as long as a few queries.
    #[must_use]
    pub fn explain(&self, query: &MotionQuery, why: &Infeasible, budget: SearchBudget) -> Infeasible {
        explain::explain(self, query, why, budget)
    }

    /// State after the robot followed a path, with nothing picked up or put down.
    #[must_use]
    pub fn after_move(&self, witness: &MotionWitness) -> SceneState {
        outcome::after_move(self, witness)
    }

    /// State after the grasp of a witness of `reach`, with the robot back at the start and the object in
    /// its hand; `None`
    /// where no path back was found.
    #[must_use]
    pub fn after_reach(&self, witness: &MotionWitness) -> Option<SceneState> {
        outcome::after_reach(self, witness)
    }

    /// State after a witness of `put`, with the robot back at the start; `None` where no path back was found.
    #[must_use]
    pub fn after_put(&self, witness: &MotionWitness) -> Option<SceneState> {
        outcome::after_put(self, witness)
    }

    /// State after a person took the held object, with the robot back at the start by the path on which it
    /// came.
    #[must_use]
    pub fn after_offer(&self, to: &str) -> Option<SceneState> {
        outcome::after_offer(self, to)
    }

    /// State after a container was opened or closed as a witness of `pull` or `push` says: the contents of
    /// a drawer moved
    /// with it. The robot is back at the start, or at the handle with its arm folded where no path leads
    /// back; `None` where
    /// neither was found.
    #[must_use]
    pub fn after_pull(&self, witness: &MotionWitness) -> Option<SceneState> {
        outcome::after_pull(self, witness)
    }
}
