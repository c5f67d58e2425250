//! Steps with a cleanup, which runs however the step is left, and then lets control go on as it was.

use super::Turn;
use crate::schedule::NodeExit;
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use motet_graph::{NodeId, RegionId};

impl Turn<'_> {
    /// By how many suspensions a region that is about to be entered is held.
    pub(super) fn suspensions(&self, owner: NodeId, region: RegionId) -> u32 {
        let (mut owner, mut region) = (owner, region);
        // Around a cleanup everything up to what was stopped is over but for it, and holds it no longer.
        while self.stopping(self.region_of(owner)).is_some() {
            region = self.region_of(owner);
            match self.plan.region(region).owner {
                Some(outer) => owner = outer,
                None => return 0,
            }
        }
        self.run.regions.at(self.region_of(owner).index()).suspended + self.imposed(owner, region)
    }

    /// What is stopped holds the cleanups in it no longer.
    pub(super) fn release_cleanup(&mut self, node: NodeId, cleanup: RegionId) {
        let state = self.run.regions.at(cleanup.index());
        if state.active {
            let held = state.suspended;
            (self.suspensions(node, cleanup)..held).for_each(|_| self.go_on(cleanup));
        }
    }

    /// The body of a step with a cleanup is over.
    pub(super) fn clean_up(&mut self, node: NodeId, cleanup: RegionId, exit: NodeExit) {
        let stopping = self.stopping(self.region_of(node));
        let exit = stopping.map_or(exit, |cause| interrupted(node, cause));
        let by_driver =
            stopping.is_none() && (exit.ending == NodeEnding::Interrupted || exit.cause == EndCause::Lost);
        if self.run.halted || by_driver {
            self.skip_cleanup(node);
            self.exit(node, exit);
        } else {
            self.run.composites.at_mut(node.index()).body_ended = Some(exit);
            self.enter_region(cleanup);
        }
    }

    fn skip_cleanup(&mut self, node: NodeId) {
        self.run.uncleaned.push(node);
        self.report(move || TraceEventKind::CleanupSkipped { node });
    }

    /// The cleanup of a step is over: the step ends as its body did.
    pub(super) fn cleaned_up(&mut self, node: NodeId, exit: NodeExit) {
        let before = self.run.composites.at_mut(node.index()).body_ended.take();
        match exit.ending {
            NodeEnding::Success => {}
            NodeEnding::Failure(failure) => {
                self.report(move || TraceEventKind::CleanupFailed { node, failure });
            }
            NodeEnding::Interrupted => self.skip_cleanup(node),
        }
        let exit = match (self.stopping(self.region_of(node)), exit.ending) {
            (Some(cause), _) => interrupted(node, cause),
            (None, NodeEnding::Interrupted) => exit,
            (None, NodeEnding::Success | NodeEnding::Failure(_)) => before.unwrap_or(exit),
        };
        self.exit(node, exit);
    }
}

fn interrupted(node: NodeId, cause: EndCause) -> NodeExit {
    NodeExit { ending: NodeEnding::Interrupted, cause, origin: node }
}
