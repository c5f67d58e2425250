//! Motion queries: decides whether a robot in a scene can do a motion, with the motion as the witness.
//!
//! A [`RobotModel`] is made once for a robot, a [`QueryContext`] once for a [`SceneState`]; then
//! [`QueryContext::answer`] answers any number of queries. A feasible answer is a path of which every edge
//! was certified free, so it holds for the shapes that the card and the scene give. An infeasible answer says
//! whether it is proven. A motion that is not computed is unknown, with the reason.

mod base;
mod certify;
mod checking;
mod context;
mod grasp;
mod motions;
mod placing;
mod query;
mod scene;
mod search;
mod timing;

pub use context::{BaseMapCache, QueryContext};
pub use placing::{ExactNumber, MapPose, Misfit, PlaceRules};
pub use query::{
    BearingLimit, ContactShare, Gap, Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer,
    MotionQuery, MotionWitness, ReachLength, SearchBudget, TightGroup, TightSpot, UnknownReason,
};
pub use scene::{
    AllowedCollisions, Articulation, Configuration, Contact, HandModel, IkSolver, KeptRegion, MIN_CLEARANCE,
    PlanningScene, RobotModel, SceneState, components,
};
pub(crate) use scene::{STANDS_OUT, THICK, WALL, solid_shape, walls};
pub use timing::{MotionLimits, PathTime, SpeedShare};
