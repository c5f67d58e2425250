//! Motion queries and their answers.

pub(crate) mod answer;
pub(crate) mod contact_tally;
