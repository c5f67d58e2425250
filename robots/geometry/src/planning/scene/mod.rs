//! Planning scene: robot model, scene state, obstacles and permitted contacts.

mod articulation;
mod closing;
mod configuration;
mod obstacle;
mod planning_scene;
mod robot_model;
mod scene_state;

pub use articulation::Articulation;
pub(crate) use articulation::{STANDS_OUT, THICK, WALL, walls};
pub(crate) use closing::{FingerContact, HoldDepths};
pub use configuration::Configuration;
pub(crate) use configuration::plane;
pub use obstacle::{AllowedCollisions, Contact, MIN_CLEARANCE};
pub(crate) use obstacle::{ContactTarget, Obstacle, ObstacleIndex, Padding, above_floor};
pub use planning_scene::PlanningScene;
pub(crate) use planning_scene::{ABOVE, SupportSurface};
pub(crate) use robot_model::away;
pub use robot_model::{HandModel, IkSolver, RobotModel};
pub(crate) use scene_state::{HeldObject, KEPT, isometry, solid_shape};
pub use scene_state::{KeptRegion, SceneState, components};
