//! Tally of the contacts that a search met: the reason that an answer gives.

use std::collections::BTreeMap;

use smol_str::{SmolStr, format_smolstr};

use crate::planning::query::answer::{ContactShare, ITSELF, Infeasible, InfeasibleReason, MotionAnswer};
use crate::planning::scene::contact::Contact;

/// What is met, and how often.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTally {
    others: BTreeMap<SmolStr, usize>,
    /// Of the robot itself, by the two links.
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

    /// What is met most often; of equals the first by name. The robot itself counts as one, and is told with the links that meet
    /// most often.
    pub(crate) fn most(&self) -> Option<SmolStr> {
        self.counted().map(|(name, _)| name)
    }

    /// That no pose is free of those whose touches these are: what most of them touch, and how many of how many.
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

/// The key that is counted most often, the first of equals.
fn first_most<K>(counts: &BTreeMap<K, usize>) -> Option<(&K, usize)> {
    counts.iter().fold(None, |most, (name, count)| match most {
        Some((_, known)) if known >= *count => most,
        Some(_) | None => Some((name, *count)),
    })
}

/// The answer of a search that ends without a way: what is in the way where a state was found, else what leaves none free.
pub(crate) fn exhausted(found: bool, poses: &ContactTally, ways: &ContactTally) -> MotionAnswer {
    let reason = if found { InfeasibleReason::BlockedPath { by: ways.most() } } else { poses.none_free() };
    MotionAnswer::Infeasible(Infeasible::exhausted(reason))
}
