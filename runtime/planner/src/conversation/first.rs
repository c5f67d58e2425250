//! A first step that began while the rest of its policy was still being written, and what follows it.

use motet_graph::Value;
use smol_str::SmolStr;

use super::{Conversation, Planner, Rest, Wait};
use crate::builtin::Answered;
use crate::model::{Judged, judge, without_first_step};
use motet_requests::Intent;

/// The first step of a policy that is still being written.
pub(super) struct First {
    /// What became of the rest, where that is known: the whole policy, which could not take over at once, or none.
    pub(super) rest: Option<Rest>,
    /// What the names of the first step were bound to.
    pub(super) bound: Vec<(SmolStr, Value)>,
    pub(super) understood: Intent,
}

/// What follows such a first step.
pub(super) enum After {
    /// Nothing.
    Done,
    /// A person stopped it.
    Stopped,
    /// The rest of the policy.
    Runs(Box<Answered>),
    /// Another policy: the rest cannot be used.
    PlansAnew,
}

impl First {
    pub(super) fn new(rest: Option<Rest>, answered: &Answered) -> Self {
        Self { rest, bound: Vec::new(), understood: answered.understood.clone() }
    }
}

impl Conversation<'_> {
    /// What follows the first step of a policy, which is done.
    pub(super) fn after_first(
        &self,
        first: First,
        planner: &mut dyn Planner,
        base: Option<[f64; 3]>,
    ) -> After {
        let policy = match first.rest.unwrap_or_else(|| planner.rest(Wait::ToTheEnd)) {
            Rest::Whole(policy) => policy,
            Rest::Stopped => return After::Stopped,
            Rest::Nothing | Rest::Coming | Rest::Broken => return After::PlansAnew,
        };
        let Ok(rest) = without_first_step(&policy, &first.bound) else { return After::PlansAnew };
        let Some(rest) = rest else { return After::Done };
        let scene = self.known.scene(&self.setting.scene);
        match judge(&self.session(&scene, &self.known, base), &rest) {
            Judged::Good { planned, changed, .. } if changed.is_empty() => {
                After::Runs(Box::new(Answered { understood: first.understood, planned: *planned }))
            }
            Judged::Good { .. } | Judged::Bad { .. } => After::PlansAnew,
        }
    }
}
