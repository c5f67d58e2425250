//! Motions: one file for each motion query, as a function over the query context.

mod answer;
mod explain;
mod go_to;
mod handle;
mod look;
mod offer;
mod pull;
mod push;
mod put;
mod reach;
