//! Motions: one file for each motion query, as a function over the query context.

mod dispatch;
mod explain;
mod go_to;
mod handle;
mod look;
mod offer;
mod place_goal;
mod pull;
mod push;
mod put;
mod reach;
mod tight;
