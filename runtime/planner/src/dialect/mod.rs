//! InteLiPlan's dialect: what a person asks and what a robot sees and plans, as one text with a tag before
//! each part, and
//! plans as lists of actions in words (Ly, Zhang, Hauser et al., "InteLiPlan: An Interactive Lightweight
//! LLM-Based Planner
//! for Domestic Robot Autonomy", 2024).
//!
//! [`exchange`] reads and writes the tagged text; [`actions`] turns a list of actions into a policy, and
//! back. It is a loose
//! front end: what it reads differently from how it is written it says, and the policy is checked like any
//! other.

pub mod actions;
pub mod exchange;
mod list;
