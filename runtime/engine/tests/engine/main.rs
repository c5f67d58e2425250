//! The engine from outside: scripted runs with their effects as snapshots, and random runs against the laws.

mod calls;
mod control;
mod monitors;
mod random;
mod script;
