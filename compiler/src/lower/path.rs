//! Paths of steps as JSON Pointers.

use std::fmt::Write as _;

use smol_str::SmolStr;

use crate::ir::{BlockSlot, Program, StepId};

/// Path of a step: `/steps/2/try/0`; in an inlined policy the path of the call, `:`, and the path in that
/// policy.
pub(crate) fn pointer(program: &Program, step: StepId) -> SmolStr {
    let mut places = Vec::new();
    let mut at = Some(step);
    while let Some(place) = at.and_then(|id| program.step(id)).map(|step| step.position) {
        places.push(place);
        at = place.parent;
    }
    let mut path = String::with_capacity(places.len() * 10);
    for place in places.iter().rev() {
        let index = place.index;
        // Writing to a string cannot fail.
        let _ = match place.slot {
            BlockSlot::Steps => write!(path, "/steps/{index}"),
            BlockSlot::Then => write!(path, "/then/{index}"),
            BlockSlot::Else => write!(path, "/else/{index}"),
            BlockSlot::Try => write!(path, "/try/{index}"),
            BlockSlot::Catch(handler) => write!(path, "/catch/{handler}/steps/{index}"),
            BlockSlot::During => write!(path, "/during/{index}"),
            BlockSlot::Reaction(watch) => write!(path, "/monitor/{watch}/then/steps/{index}"),
            BlockSlot::Branch(branch) => write!(path, "/parallel/{branch}/{index}"),
            BlockSlot::Inlined => write!(path, ":/steps/{index}"),
        };
    }
    path.into()
}
