//! What surrounds the engine on a robot's own computer and does input and output: the journal on disk and as MCAP
//! files, and drivers in other processes. The engine itself, the lines of a journal and their replay are `motet-runtime`'s.

pub mod journal;
pub mod mcap;
pub mod remote;
