//! Motions that were left to the run: somebody is asked for them just before their call starts.

use super::Turn;
use super::call::{GuardCheck, StartRefusal};
use crate::belief::Freshness;
use crate::effect::{Command, Effect};
use crate::ids::CheckId;
use crate::state::{MotionCheck, Phase};
use crate::trace::TraceEventKind;
use crate::verifier::{DeferredMotion, Verification};
use motet_graph::{CallNode, NodeId, Verdict};
use std::sync::Arc;

impl Turn<'_> {
    /// Evaluates a call's motion after all other guards hold.
    pub(super) fn look_at_motion(
        &mut self,
        node: NodeId,
        call: &CallNode,
        command: Arc<Command>,
    ) -> GuardCheck {
        let deferred = call.motion.as_ref().filter(|motion| motion.verdict == Verdict::Deferred);
        let Some(motion) = deferred.filter(|_| self.settings.verify_within.is_some()) else {
            return GuardCheck::Go(command);
        };
        let now = self.run.now;
        let Some(args) = self.values(&motion.args, Freshness::Readings(now)) else {
            return GuardCheck::Go(command);
        };
        let motion = DeferredMotion { query: motion.query.clone(), args, command };
        let known = self.run.checks.iter().find(|check| check.node == node && *check.motion == motion);
        match known.map(|check| (&check.verdict, &check.motion)) {
            None => GuardCheck::Ask(motion),
            Some((None, asked)) => GuardCheck::Wait(asked.clone()),
            Some((Some(Verification::Feasible | Verification::Unknown { .. }), _)) => {
                GuardCheck::Go(motion.command)
            }
            Some((Some(Verification::Infeasible { failure, .. }), _)) => {
                let failure = failure.clone();
                GuardCheck::Refused(StartRefusal::Motion(self.failure_id(&failure)))
            }
        }
    }

    /// The call waits for a verdict on its motion. Its resources are its own meanwhile.
    pub(super) fn ask_for_motion(&mut self, node: NodeId, motion: DeferredMotion) {
        self.stop_checking(node);
        self.run.checked += 1;
        let (id, motion) = (CheckId(self.run.checked), Arc::new(motion));
        self.run.checks.push(MotionCheck { id, node, motion: motion.clone(), verdict: None });
        self.run.nodes.at_mut(node.index()).phase = Phase::Checking;
        if let Some(within) = self.settings.verify_within {
            self.run.timers.set(self.plan.node_key(node), self.run.now.after(within));
        }
        self.out.push(Effect::Verify { check: id, node, motion });
    }

    /// A verdict came. The guards are looked at once more, because the world went on meanwhile.
    pub(super) fn verified(&mut self, id: CheckId, verdict: Verification) {
        let Some(check) = self.run.checks.iter_mut().find(|check| check.id == id) else { return };
        if check.verdict.is_some() {
            return;
        }
        let (node, told) = (check.node, Box::new(verdict.clone()));
        check.verdict = Some(verdict);
        self.report(move || TraceEventKind::Verified { node, verdict: told });
        self.push_judge(node);
    }

    /// True if a call has asked for its motion.
    pub(super) fn is_verifying(&self, node: NodeId) -> bool {
        self.run.checks.iter().any(|check| check.node == node)
    }

    /// A call that was about to start no longer waits for observations or a verdict.
    pub(super) fn stop_checking(&mut self, node: NodeId) {
        self.forget_asked(node);
        if self.is_verifying(node) {
            self.run.timers.clear(self.plan.node_key(node));
            self.run.checks.retain(|check| check.node != node);
        }
    }
}
