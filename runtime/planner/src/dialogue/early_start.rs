//! Early start of a policy: its first step runs while a model still writes the rest.

use motet_graph::Value;
use motet_requests::Intent;
use smol_str::SmolStr;

use super::Conversation;
use crate::builtin::PlannedRequest;
use crate::model::{ReplyVerdict, judge, without_first_step};
use crate::{Planner, RemainingSteps, Wait};

/// The first step of a policy that is still being written.
pub(super) struct EarlyStart {
    /// Fate of the remaining steps, once it is known: a whole policy that could not take over at once, or
    /// none.
    pub(super) rest: Option<RemainingSteps>,
    /// Bindings of the first step.
    pub(super) bound: Vec<(SmolStr, Value)>,
    pub(super) understood: Intent,
}

/// Continuation after a first step.
pub(super) enum Continuation {
    Done,
    /// A person stopped the planning.
    Stopped,
    /// The rest of the policy.
    Runs(Box<PlannedRequest>),
    /// Another policy: the rest cannot be used.
    PlansAnew,
}

impl EarlyStart {
    pub(super) fn new(rest: Option<RemainingSteps>, answered: &PlannedRequest) -> Self {
        Self { rest, bound: Vec::new(), understood: answered.understood.clone() }
    }
}

impl Conversation<'_> {
    /// Chooses the continuation after the first step of a policy has ended.
    pub(super) fn after_first(
        &self,
        first: EarlyStart,
        planner: &mut dyn Planner,
        base: Option<[f64; 3]>,
    ) -> Continuation {
        let policy = match first.rest.unwrap_or_else(|| planner.rest(Wait::ToTheEnd)) {
            RemainingSteps::Whole(policy) => policy,
            RemainingSteps::Stopped => return Continuation::Stopped,
            RemainingSteps::Nothing | RemainingSteps::Coming | RemainingSteps::Broken => {
                return Continuation::PlansAnew;
            }
        };
        let scene = self.known.scene(&self.setting.scene);
        let session = self.session(&scene, &self.known, base);
        let rest = without_first_step(&policy, &first.bound, session.library());
        let Ok(rest) = rest else { return Continuation::PlansAnew };
        let Some(rest) = rest else { return Continuation::Done };
        match judge(&session, &rest) {
            ReplyVerdict::Good { planned, changed, .. } if changed.is_empty() => {
                Continuation::Runs(Box::new(PlannedRequest {
                    understood: first.understood,
                    planned: *planned,
                }))
            }
            ReplyVerdict::Good { .. } | ReplyVerdict::Bad { .. } => Continuation::PlansAnew,
        }
    }
}
