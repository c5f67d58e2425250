//! Motions: one file for each motion query, as a function over the query context.

pub(crate) mod dispatch;
pub(crate) mod explain;
pub(crate) mod follow;
pub(crate) mod go_to;
pub(crate) mod handle;
pub(crate) mod look;
pub(crate) mod offer;
pub(crate) mod outcome;
pub(crate) mod pull;
pub(crate) mod push;
pub(crate) mod put;
pub(crate) mod reach;
