//! A row: what a model is shown, and what it shall answer.

use motet_planner::dialogue::Kind;
use smol_str::SmolStr;

use crate::wordings::Task;

/// Properties of a row, beside its texts.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct About {
    /// The robot's name.
    pub robot: SmolStr,
    /// The name of the room as it is in this row: that of the varied room, with a number behind a point
    /// where something
    /// has happened in it.
    pub scene: SmolStr,
    pub task: Task,
    /// Failures in the conversation, in their order.
    pub failures: Vec<Kind>,
    /// Turn of the conversation, from 0.
    pub turn: usize,
}

/// One turn of a conversation in which a planner is asked.
#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    pub about: About,
    /// System message, as `motet do` sends it.
    pub system: String,
    pub user: String,
    /// The picture that it is shown: a path as seen from the folder of the row's file.
    pub image: Option<SmolStr>,
    /// The policy on the model surface.
    pub policy: String,
    /// The request in its words.
    pub request: String,
    pub history: String,
    /// Visibility of the named things.
    pub vision: String,
    /// Reachability of the named things.
    pub feasibility: String,
    /// The plan as a list of actions, or the question.
    pub actions: String,
}
