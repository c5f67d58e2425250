//! Motion queries and their answers.

pub(crate) mod answer;
