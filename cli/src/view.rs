//! Live page of a run: its steps, the robot in its scene, lanes over time, questions and controls in a
//! browser.
//!
//! A [`motet::page::feed::PageFeed`] turns the entries of a journal into items. They come from a run that
//! goes on ([`onlooker`]) or from a folder ([`journal`]). A [`hub::Hub`] keeps the items, a [`server`] hands
//! them to pages, and [`file`] writes them into one. The sources of the page are in `view/`.

pub(crate) mod access;
pub(crate) mod answered;
pub(crate) mod conversation;
pub(crate) mod file;
pub(crate) mod hub;
pub(crate) mod journal;
pub(crate) mod live;
pub(crate) mod onlooker;
pub(crate) mod server;
