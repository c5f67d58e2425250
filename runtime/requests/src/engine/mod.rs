//! The engine: words, lists of templates and their matcher, rules that rewrite, nouns and places, verbs, and
//! the things of a scene that all these name. The files beside this folder read sentences with it, and turn
//! what they read into goals and answers.

pub(crate) mod asking;
pub(crate) mod effort;
pub(crate) mod english;
pub(crate) mod noun;
pub(crate) mod phrases;
pub(crate) mod reader;
pub(crate) mod rewrite;
pub(crate) mod rule;
pub(crate) mod template;
pub(crate) mod token;
pub(crate) mod verb;
pub(crate) mod vocabulary;
