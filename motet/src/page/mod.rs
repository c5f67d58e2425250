//! Items of a page that shows runs: the steps of a policy with their states, the robot in its room, goals and
//! readings over time.
//!
//! A [`feed::PageFeed`] turns the entries of a journal into items, JSON objects that the page in `view/`
//! draws. An [`entries::EntryTracker`] makes the entries of a run that goes on.

pub mod entries;
pub mod feed;
mod outline;
pub mod source;
pub mod tree;
pub mod world;
