//! Motion queries: decides whether a robot in a scene can do a motion, with the motion as the witness.
//!
//! A [`RobotModel`] is made once for a robot, a [`QueryContext`] once for a [`SceneState`]; then
//! [`QueryContext::answer`] answers
//! any number of queries. A feasible answer is a path of which every edge was certified free, so it holds
//! for the shapes that the
//! card and the scene give. An infeasible answer says whether it is proven. A motion that is not computed
//! is unknown, with the reason.

mod base;
mod certify;
mod checking;
mod context;
mod grasp;
mod motions;
mod query;
mod scene;
mod search;

pub use context::{BaseMapCache, QueryContext};
pub use query::answer::{
    BearingLimit, ContactShare, Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer,
    MotionQuery, MotionWitness, SearchBudget, UnknownReason,
};
pub use scene::articulation::Articulation;
pub use scene::configuration::Configuration;
pub use scene::contact::{AllowedCollisions, Contact, MIN_CLEARANCE};
pub use scene::ik_solver::IkSolver;
pub use scene::planning_scene::PlanningScene;
pub use scene::robot_model::{HandModel, RobotModel};
pub use scene::scene_state::{SceneState, components};
