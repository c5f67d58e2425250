//! InteLiPlan's dialect: the words of a person, the perceptions and the plan of a robot as one text with a
//! tag before each part, and plans as lists of actions in words (Ly, Zhang, Hauser et al., "InteLiPlan: An
//! Interactive Lightweight LLM-Based Planner for Domestic Robot Autonomy", 2024).
//!
//! [`exchange`] reads and writes the tagged text. [`actions`] converts a list of actions to a policy, and
//! back. The reader is tolerant: it reports each interpretation, and the policy is checked like any other.

mod action_list;
pub mod actions;
pub mod exchange;
