//! One file for each motion query.

pub(crate) mod barrier;
pub(crate) mod explain;
pub(crate) mod follow;
pub(crate) mod go_to;
pub(crate) mod look;
pub(crate) mod offer;
pub(crate) mod opened;
pub(crate) mod outcome;
pub(crate) mod pull;
pub(crate) mod push;
pub(crate) mod put;
pub(crate) mod reach;
