//! Features of an editor without its protocol: functions of a document, a position and a session. The server
//! converts their results.

pub(crate) mod completion;
pub(crate) mod context;
pub(crate) mod declarations;
pub(crate) mod folding;
pub(crate) mod hints;
pub(crate) mod hover;
pub(crate) mod json_completion;
pub(crate) mod names;
pub(crate) mod point;
pub(crate) mod rename;
pub(crate) mod symbols;
pub(crate) mod tokens;
