//! Searches for the motion queries, as functions over the query context: one file for each query. Those of
//! the base and `posture` share `go_to`. `dispatch` calls them, `explain` and `tight_spot` give reasons.

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
mod tight_spot;
