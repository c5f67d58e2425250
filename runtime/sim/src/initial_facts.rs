//! Facts that a host says hold at the start: the world is made such that they do, as far as it can be.

use crate::observation::InitialFacts;
use crate::thing::Rest;
use crate::world::SimWorld;
use smol_str::SmolStr;

impl SimWorld {
    /// Makes the facts true that are not yet, in order. A fact of something that does not exist is left out,
    /// and so is one that can only come about, such as `visited`.
    pub(crate) fn believe(&mut self, initial_facts: &InitialFacts) {
        for ((fluent, args), holds) in initial_facts {
            let args: Vec<&str> = args.iter().map(SmolStr::as_str).collect();
            if self.fact(fluent, &args, &InitialFacts::new()).is_none_or(|is| is == *holds) {
                continue;
            }
            self.make(fluent, &args, *holds);
        }
    }

    fn make(&mut self, fluent: &str, args: &[&str], holds: bool) {
        match (fluent, args, holds) {
            ("on", [id, support], true) => self.lay(id, support, Rest::On((*support).into())),
            ("in", [id, container], true) => self.lay(id, container, Rest::In((*container).into())),
            ("on" | "in", [id, _], false) => self.set_rest(id, Rest::Free),
            ("holding", [id], true) => self.hold_at_start(&(*id).into()),
            ("holding", [id], false) => self.slip(id),
            ("open", [id], open) => self.set_open(id, open),
            ("locked", [id], locked) => self.set_locked(id, locked),
            ("standing", ["robot"], standing) => self.standing = standing,
            ("at", ["robot", place], true) => {
                if let Some(stance) = self.place_for(place) {
                    self.base = stance;
                }
            }
            ("visible", [id], visible) => {
                if let Some(thing) = self.things.get_mut(*id) {
                    thing.visible_at_start = Some(visible);
                }
            }
            (_, _, _) => {}
        }
    }

    fn set_rest(&mut self, id: &str, rest: Rest) {
        if let Some(thing) = self.things.get_mut(id) {
            thing.rest = rest;
        }
    }
}
