//! A row: what a model is shown, and what it shall answer.

use motet_planner::conversation::Kind;
use smol_str::SmolStr;

use crate::wordings::Task;

/// What a row is about, beside its texts.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct About {
    /// The robot's name.
    pub robot: SmolStr,
    /// The name of the room as it is in this row: that of the varied room, with a number behind a point where something
    /// has happened in it.
    pub scene: SmolStr,
    /// What is asked for.
    pub task: Task,
    /// What goes wrong in the conversation, in order.
    pub failures: Vec<Kind>,
    /// Which turn of the conversation it is, from 0.
    pub turn: usize,
}

/// One turn of a conversation in which a planner is asked.
#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    /// What it is about.
    pub about: About,
    /// What the model is told to be, as `motet do` tells it.
    pub system: String,
    /// What it is asked.
    pub user: String,
    /// The picture that it is shown: a path as seen from the folder of the row's file.
    pub image: Option<SmolStr>,
    /// The policy on the model surface.
    pub policy: String,
    /// The request in its words.
    pub request: String,
    /// What was said and done before.
    pub history: String,
    /// What is seen of what the request names.
    pub vision: String,
    /// Whether it can be held.
    pub feasibility: String,
    /// The plan as a list of actions, or the question.
    pub actions: String,
}
