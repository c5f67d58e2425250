//! Planning scene: robot model, scene state, obstacles and permitted contacts.

pub(crate) mod articulation;
pub(crate) mod configuration;
pub(crate) mod contact;
pub(crate) mod grid_index;
pub(crate) mod ik_solver;
pub(crate) mod obstacle;
pub(crate) mod robot_model;
pub(crate) mod scene_state;
