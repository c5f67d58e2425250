//! Motion queries: decides whether a robot in a scene can do a motion, with the motion as the witness.
//!
//! A [`RobotModel`] is made once for a robot, a [`QueryContext`] once for a [`SceneState`]; then [`QueryContext::answer`] answers
//! any number of queries. A feasible answer is a path of which every edge was certified free, so it holds for the shapes that the
//! card and the scene give. An infeasible answer says whether it is proven. A motion that is not computed is unknown, with the reason.

mod base;
mod certify;
mod checking;
mod grasp;
mod motions;
mod query;
mod scene;
mod search;

pub use query::answer::{
    BearingLimit, ContactShare, Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer,
    MotionQuery, MotionWitness, SearchBudget, UnknownReason,
};
pub use scene::articulation::Articulation;
pub use scene::configuration::Configuration;
pub use scene::contact::{AllowedCollisions, Contact, MIN_CLEARANCE};
pub use scene::ik_solver::IkSolver;
pub use scene::robot_model::{HandModel, RobotModel};
pub use scene::scene_state::{SceneState, components};
pub use search::context::{BaseMapCache, QueryContext};

impl QueryContext<'_> {
    /// Answers a query in this room. The same room, query and budget give the same answer, bit for bit.
    #[must_use]
    pub fn answer(&self, query: &MotionQuery, budget: SearchBudget) -> MotionAnswer {
        if let Some(why) = self.blind_spot() {
            return MotionAnswer::Unknown(UnknownReason::Because(why));
        }
        if let Some(Contact { link, other, .. }) = self.start_contact() {
            return MotionAnswer::Unknown(UnknownReason::Because(format!(
                "at the start `{link}` touches `{other}`"
            )));
        }
        match query {
            MotionQuery::GoTo(to) => self.go_to(to, budget),
            MotionQuery::Reach(object, side) => self.reach(object, *side, budget),
            MotionQuery::Put(object, on) => self.put(object, on, budget),
            MotionQuery::Offer(object, to) => self.offer(object, to, budget),
            MotionQuery::Look(at) => self.look(at, budget),
            MotionQuery::Pull(what) => self.pull(what, [0.0, 1.0], budget),
            MotionQuery::Push(what) => self.push(what, budget),
            MotionQuery::Posture(name) => self.to_posture(name),
            MotionQuery::Other(name) => {
                MotionAnswer::Unknown(UnknownReason::Because(format!("`{name}` is not computed yet")))
            }
        }
    }
}
