//! Options of a simulated world.

use crate::faults::Faults;
use indexmap::IndexMap;
use smol_str::SmolStr;

/// Choices about a simulated world. The default: seed 0, nothing goes wrong, people answer as it pleases the
/// robot.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct SimOptions {
    /// Decides how long things take, within a tenth. Same seed, same run.
    pub seed: u64,
    pub faults: Faults,
    /// Scripted answers of people.
    pub script: PersonScript,
    /// The parent of each kind that the policy's library declares, so that a `Tray: Surface` counts as a
    /// surface. Kinds of the standard library need not be in it.
    pub kinds: IndexMap<SmolStr, SmolStr>,
    /// Entities beside the scene's, with their kind, that shall have a place in the world all the same. One
    /// of a scene with the same name counts before it.
    pub entities: Vec<(SmolStr, SmolStr)>,
    /// Facts that hold at the start, by fluent and arguments. The world is made such that they do: what is
    /// told to be on the table is put there. Those of fluents that it does not simulate answer observations
    /// of them.
    pub initial_facts: IndexMap<(SmolStr, Vec<SmolStr>), bool>,
    /// Position where the camera is: in the frame of the base on the floor, in m. Above its middle where that
    /// is not said.
    pub eye: Option<[f64; 3]>,
}

/// Scripted answers of people.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PersonScript {
    /// Answers to `ask` and `choose`, in order; `None` refuses. Where they have run out, people say "yes" and
    /// take the first thing that they are offered.
    pub answers: Vec<Option<String>>,
}
