//! A first step that began while the rest of its policy was still being written, and what follows it.

use motet_graph::Value;
use smol_str::SmolStr;

use super::Conversation;
use crate::builtin::PlannedRequest;
use crate::model::{ReplyVerdict, judge, without_first_step};
use crate::{Planner, RemainingSteps, Wait};
use motet_requests::Intent;

/// The first step of a policy that is still being written.
pub(super) struct First {
    /// Fate of the remaining steps, once it is known: a whole policy that could not take over at once, or
    /// none.
    pub(super) rest: Option<RemainingSteps>,
    /// Bindings of the first step.
    pub(super) bound: Vec<(SmolStr, Value)>,
    pub(super) understood: Intent,
}

/// Continuation after a first step.
pub(super) enum After {
    Done,
    /// A person stopped it.
    Stopped,
    /// The rest of the policy.
    Runs(Box<PlannedRequest>),
    /// Another policy: the rest cannot be used.
    PlansAnew,
}

impl First {
    pub(super) fn new(rest: Option<RemainingSteps>, answered: &PlannedRequest) -> Self {
        Self { rest, bound: Vec::new(), understood: answered.understood.clone() }
    }
}

impl Conversation<'_> {
    /// Chooses the continuation after the first step of a policy has ended.
    pub(super) fn after_first(
        &self,
        first: First,
        planner: &mut dyn Planner,
        base: Option<[f64; 3]>,
    ) -> After {
        let policy = match first.rest.unwrap_or_else(|| planner.rest(Wait::ToTheEnd)) {
            RemainingSteps::Whole(policy) => policy,
            RemainingSteps::Stopped => return After::Stopped,
            RemainingSteps::Nothing | RemainingSteps::Coming | RemainingSteps::Broken => {
                return After::PlansAnew;
            }
        };
        let Ok(rest) = without_first_step(&policy, &first.bound) else { return After::PlansAnew };
        let Some(rest) = rest else { return After::Done };
        let scene = self.known.scene(&self.setting.scene);
        match judge(&self.session(&scene, &self.known, base), &rest) {
            ReplyVerdict::Good { planned, changed, .. } if changed.is_empty() => {
                After::Runs(Box::new(PlannedRequest { understood: first.understood, planned: *planned }))
            }
            ReplyVerdict::Good { .. } | ReplyVerdict::Bad { .. } => After::PlansAnew,
        }
    }
}
