//! Which transition comes next, and monitors.

use super::clock::nanos;
use super::state::{After, At, Flow, Naive, Wish};
use motet_graph::{NodeId, NodeKind, Reaction, RegionId};

impl Naive {
    /// Makes transitions until none is enabled.
    pub(super) fn settle(&mut self) {
        while !self.over && (self.watch() || self.transition() || self.grant()) {}
    }

    /// The first watch that fires or whose pause is over.
    pub(super) fn watch(&mut self) -> bool {
        let monitors = self.nodes.iter().filter(|(_, live)| live.at == At::Inside).map(|(node, _)| *node);
        for node in monitors.collect::<Vec<_>>() {
            let NodeKind::Monitor { watches, .. } = self.kind(node) else { continue };
            for (index, watch) in watches.iter().enumerate() {
                let holds = self.holds(&watch.condition);
                let now = self.now;
                let since = &mut self.live(node).watches[index].holds_since;
                let since = if holds { *since.get_or_insert(now) } else { since.take().unwrap_or(now) };
                let is_due = holds && since + nanos(watch.hold_secs) <= now;
                let live = self.nodes[&node].clone();
                if live.watches[index].paused_at.is_some() {
                    if !holds {
                        self.stop_pausing(node, index);
                        if let Some(part) = self.running_part(node) {
                            self.go_on(part);
                        }
                        return true;
                    }
                    continue;
                }
                let region = self.region_of(node);
                let blocked = self.is_stopping(region)
                    || self.is_suspended(region)
                    || live.after != After::Nothing
                    || match &watch.reaction {
                        Reaction::Resume { .. } => {
                            live.resuming.is_some() || live.watches.iter().any(|of| of.paused_at.is_some())
                        }
                        _ => live.resuming == Some(index),
                    };
                if is_due && !blocked {
                    self.fire(node, index, &watch.reaction);
                    return true;
                }
            }
        }
        false
    }

    pub(super) fn fire(&mut self, node: NodeId, index: usize, reaction: &Reaction) {
        match reaction {
            Reaction::End { how, of, .. } => self.end_policy(node, *how, *of),
            Reaction::Pause { within_secs } => {
                let now = self.now;
                let watch = &mut self.live(node).watches[index];
                let left = nanos(*within_secs).saturating_sub(watch.spent);
                if left == 0 {
                    self.stop_within(node, After::Exit(Flow::Fail("timeout".into(), node)));
                    return;
                }
                (watch.paused_at, watch.until) = (Some(now), Some(now + left));
                if let Some(part) = self.running_part(node) {
                    self.suspend(part, Wish::Hold);
                }
            }
            Reaction::Restart { at_most } | Reaction::Resume { at_most, .. } => {
                let fired = &mut self.live(node).watches[index].fired;
                *fired += 1;
                if *fired > *at_most {
                    self.stop_within(node, After::Exit(Flow::Fail("exhausted".into(), node)));
                } else if let Reaction::Restart { .. } = reaction {
                    self.stop_within(node, After::Restart);
                } else {
                    let NodeKind::Monitor { body, .. } = self.kind(node) else { panic!("no monitor") };
                    self.suspend(body, Wish::Suspend);
                    let live = self.live(node);
                    (live.resuming, live.clearing) = (Some(index), true);
                    self.check_clearing();
                }
            }
        }
    }

    /// Adds a pause in force to the time that a watch has paused in all.
    pub(super) fn stop_pausing(&mut self, node: NodeId, index: usize) {
        let now = self.now;
        let watch = &mut self.live(node).watches[index];
        watch.until = None;
        if let Some(began) = watch.paused_at.take() {
            watch.spent += now - began;
        }
    }

    pub(super) fn running_part(&self, node: NodeId) -> Option<RegionId> {
        let NodeKind::Monitor { watches, body } = self.kind(node) else { return None };
        match self.nodes[&node].resuming.map(|index| &watches[index].reaction) {
            Some(Reaction::Resume { body, .. }) => Some(*body),
            _ => Some(body),
        }
    }

    pub(super) fn stop_within(&mut self, node: NodeId, after: After) {
        let live = self.live(node);
        live.after = after.clone();
        (live.resuming, live.clearing) = (None, false);
        (0..self.nodes[&node].watches.len()).for_each(|index| self.stop_pausing(node, index));
        for region in self.owned(node) {
            self.stop(region);
        }
        if self.is_down(node) {
            self.all_down(node, after);
        }
    }

    pub(super) fn all_down(&mut self, node: NodeId, after: After) {
        match after {
            After::Nothing => {}
            After::Exit(flow) => self.live(node).at = At::Ended(flow),
            After::Restart => {
                let live = self.live(node);
                (live.after, live.body_ended) = (After::Nothing, None);
                live.watches.iter_mut().for_each(|watch| watch.holds_since = None);
                let NodeKind::Monitor { body, .. } = self.kind(node) else { panic!("no monitor") };
                self.enter_region(body);
            }
        }
    }

    /// Runs the blocks of monitors whose bodies have no goal any more.
    pub(super) fn check_clearing(&mut self) {
        let clearing = self.nodes.iter().filter(|(_, live)| live.clearing).map(|(node, _)| *node);
        for node in clearing.collect::<Vec<_>>() {
            let NodeKind::Monitor { body, .. } = self.kind(node) else { continue };
            if !self.is_stopping(self.region_of(node)) && !self.has_goals(body) {
                self.live(node).clearing = false;
                if let Some(block) = self.running_part(node) {
                    self.enter_region(block);
                }
            }
        }
    }

    pub(super) fn has_goals(&self, region: RegionId) -> bool {
        let Some(node) = self.regions.get(&region).and_then(|region| region.current) else { return false };
        match self.nodes[&node].at {
            At::Goal(..) => true,
            At::Inside => self.owned(node).iter().any(|region| self.has_goals(*region)),
            _ => false,
        }
    }
}
