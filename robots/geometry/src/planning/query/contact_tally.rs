//! Tally of the contacts that a search met, for the reason of an infeasible answer.

use std::collections::BTreeMap;

use smol_str::{SmolStr, format_smolstr};

use crate::planning::query::answer::{ContactShare, ITSELF, Infeasible, InfeasibleReason, MotionAnswer};
use crate::planning::scene::contact::Contact;

/// Count of contacts by body.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTally {
    others: BTreeMap<SmolStr, usize>,
    /// Contacts within the robot, by the two links.
    own: BTreeMap<[SmolStr; 2], usize>,
}

impl ContactTally {
    pub(crate) fn add(&mut self, contact: &Contact) {
        if contact.is_own {
            *self.own.entry([contact.link.clone(), contact.other.clone()]).or_default() += 1;
        } else {
            self.add_entity(contact.other.clone());
        }
    }

    pub(crate) fn add_entity(&mut self, name: SmolStr) {
        *self.others.entry(name).or_default() += 1;
    }

    /// Most frequent body; the first by name among equals. The robot itself counts as one body, named with
    /// its two links that touch most often.
    pub(crate) fn most(&self) -> Option<SmolStr> {
        self.counted().map(|(name, _)| name)
    }

    /// Reason that no pose is free: the most frequent body and its share of all contacts.
    pub(crate) fn none_free(&self) -> InfeasibleReason {
        let (by, touching) = self.counted().unzip();
        let tried = self.others.values().chain(self.own.values()).sum();
        InfeasibleReason::NoFreePose { by, share: touching.map(|touching| ContactShare { touching, tried }) }
    }

    fn counted(&self) -> Option<(SmolStr, usize)> {
        let own: usize = self.own.values().sum();
        match first_most(&self.others) {
            Some((name, count)) if count >= own => Some((name.clone(), count)),
            _ => first_most(&self.own)
                .map(|([one, other], _)| (format_smolstr!("{ITSELF} (`{one}` and `{other}`)"), own)),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.others.is_empty() && self.own.is_empty()
    }
}

/// Key with the greatest count, the first of equals.
fn first_most<K>(counts: &BTreeMap<K, usize>) -> Option<(&K, usize)> {
    counts.iter().fold(None, |most, (name, count)| match most {
        Some((_, known)) if known >= *count => most,
        Some(_) | None => Some((name, *count)),
    })
}

/// Answer of a search without a path: blocked where a free configuration was found, else not free.
pub(crate) fn exhausted(found: bool, poses: &ContactTally, ways: &ContactTally) -> MotionAnswer {
    let reason = if found { InfeasibleReason::BlockedPath { by: ways.most() } } else { poses.none_free() };
    MotionAnswer::Infeasible(Infeasible::exhausted(reason))
}
