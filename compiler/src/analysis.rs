//! Abstract interpretation (Cousot 1977): one walk over the steps of a program, for every abstract domain.
//!
//! A [`Domain`] holds the set of states at the present program point, and says how steps and conditions
//! change it. The walk is the same for all domains: it forks at branches, joins where paths meet, iterates
//! loops to their fixed points, and carries failures to their handlers. The prover is the domain of facts,
//! motion feasibility the domain of possible worlds.
//!
//! A domain says for itself how monitors and parallel branches interfere with the steps beside them, since
//! facts are weakened one by one and worlds are lost as a whole.

mod enclosing;

use motet_syntax::Span;
use motet_syntax::ast::EndKind;

pub(crate) use self::enclosing::{Enclosing, Ended, Handler, Leaving};
use crate::declare::Library;
use crate::ir::{
    BindingId, Call, Catch, Condition, Failure, Program, Reaction, StepId, StepKind, TIMEOUT, Term, When,
};

/// Reason for which control leaves the straight path.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Exit {
    /// A step failed: the state is one in which it may have.
    Failure,
    /// An inlined policy is done.
    Done,
}

/// Kind of a loop.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Loop<'p> {
    /// Up to `times` rounds, or until a test holds.
    Repeat { times: u32, until: Option<&'p Condition> },
    /// One round for each item of a list, of which some are certain.
    Each { item: BindingId, least: usize },
}

impl Loop<'_> {
    /// The loop over the items of a list: one that is written out has as many rounds as elements.
    pub(crate) fn each(item: BindingId, list: &Term) -> Self {
        let least = if let Term::List(items) = list { items.len() } else { 0 };
        Self::Each { item, least }
    }
}

/// Paths from the end of a loop's body.
#[derive(Debug)]
pub(crate) struct Round<P> {
    /// Paths out of the loop.
    pub(crate) exits: Vec<P>,
    /// Path back to its head.
    pub(crate) back: Option<P>,
}

/// An abstract domain: the set of states at the present program point, with join, transfer and assume.
///
/// Laws: [`Self::restore`] after [`Self::mark`] is the identity; [`Self::follow`] after it, with the path
/// from the mark to a later point, leads to that point; [`Self::join`] covers each of its paths; and
/// [`Self::widen`] returns `None` after finitely many rounds. Guarded by the tests of both domains.
pub(crate) trait Domain<'p> {
    /// A program point to which the analysis returns.
    type Mark: Clone;
    /// States at the end of a path that began at a mark.
    type Path: Clone;
    /// Join of states that leave the straight path.
    type Collector;
    /// Changes that a branch of a parallel block may make.
    type Changes;

    fn program(&self) -> &'p Program;
    fn library(&self) -> &'p Library;

    /// Failure of a loop or a reaction that reached its bound.
    fn exhausted(&self) -> Option<Failure> {
        self.library().lang_items.exhausted
    }

    /// Failure of an inlined policy that ends with `fail`.
    fn failed(&self) -> Option<Failure> {
        self.library().lang_items.failed
    }
    /// The constructs around the present step, the innermost last.
    fn enclosing(&mut self) -> &mut Vec<Enclosing<Self::Collector>>;

    /// Returns whether a path leads here.
    fn is_live(&self) -> bool;
    /// Ends the present path.
    fn stop(&mut self);
    /// Returns whether the rest of a block has no influence on the result.
    fn is_over(&self) -> bool {
        !self.is_live()
    }

    fn mark(&self) -> Self::Mark;
    /// Returns to a mark, where a path leads.
    fn restore(&mut self, mark: &Self::Mark);
    /// The path from a mark to the present point.
    fn path(&self, mark: &Self::Mark) -> Self::Path;
    /// The paths from a mark to the present point, where some of them are kept apart.
    fn paths(&mut self, mark: &Self::Mark) -> Vec<Self::Path> {
        vec![self.path(mark)]
    }
    /// The paths from a mark to the end of a branch, where those of a fork that ends there are kept apart.
    fn ends(&mut self, mark: &Self::Mark) -> Vec<Self::Path> {
        vec![self.path(mark)]
    }
    /// Goes along a path from the mark where it began.
    fn follow(&mut self, path: &Self::Path);
    /// Joins paths from a mark; control ends if there is none.
    fn join(&mut self, mark: &Self::Mark, paths: &[Self::Path]);
    /// The head of a loop for the next round; `None` if the path `back` adds nothing to it. The present point
    /// is the mark at which both began.
    fn widen(&self, head: &Self::Path, back: &Self::Path, round: usize) -> Option<Self::Path>;

    /// An empty collector for states of paths from here.
    fn collector(&self) -> Self::Collector;
    /// An empty collector for states of paths from where another collector began.
    fn collector_at(&self, other: &Self::Collector) -> Self::Collector;
    /// The states of a block in which something interrupts it, as a path; `None` without any.
    fn anywhere(&self, states: &Self::Collector, _block: &'p [StepId]) -> Option<Self::Path> {
        self.collected(states)
    }
    /// Adds the present states to a collector.
    fn collect(&self, into: &mut Self::Collector, exit: Exit);
    /// The collected states as a path; `None` without any.
    fn collected(&self, states: &Self::Collector) -> Option<Self::Path>;

    /// Leads from the mark of a `try` to the states in which a handler starts. Returns false if
    /// there are none.
    fn follow_failures(&mut self, states: &Self::Collector) -> bool {
        let failed = self.collected(states);
        if let Some(failed) = &failed {
            self.follow(failed);
        }
        failed.is_some()
    }

    /// Enters a step. Returns false if it is known to be unreachable.
    fn enter(&mut self, id: StepId) -> bool;
    /// Transfer function of a call.
    fn transfer(&mut self, id: StepId, call: &'p Call, span: Span);
    /// Assumes that the run sees a condition of a step to hold, or that it does not. Returns false if that
    /// cannot be.
    fn assume_at(&mut self, id: StepId, condition: &Condition, is_seen: bool) -> bool;
    /// Lets a wait fail, while what it waits for is still not so.
    fn fail_wait(&mut self, _id: StepId, _condition: &Condition) {
        self.throw(Some(TIMEOUT), usize::MAX);
    }
    /// Assumes the condition of a wait, which something outside may have changed.
    fn await_at(&mut self, id: StepId, condition: &Condition);
    /// Walks over a wait for a time.
    fn pass_time(&mut self, _id: StepId) {}
    /// Loses everything that a step with an error may change.
    fn lose(&mut self, id: StepId);
    /// Walks over a monitor.
    fn monitor(&mut self, id: StepId, whens: &'p [When], body: &'p [StepId]);

    /// Finds the changes that each of several parallel branches may make.
    fn branch_changes(&mut self, branches: &'p [Vec<StepId>]) -> Vec<Self::Changes>;
    /// Loses all that the branches beside one may change at any moment.
    fn disturb(&mut self, id: StepId, changes: &[Self::Changes], index: usize);
    /// Leaves a branch that was disturbed.
    fn end_branch(&mut self) {}
    /// Leads to the states after all branches, which end with these paths.
    fn compose(&mut self, id: StepId, changes: &[Self::Changes], paths: &[Self::Path]);

    /// Walks over a named sequence.
    fn sequence(&mut self, _id: StepId, body: &'p [StepId]) {
        self.block(body);
    }
    /// Enters a loop or a parallel block. Returns false if it is nested too deeply.
    fn enter_fixpoint(&mut self, _id: StepId) -> bool {
        true
    }
    fn leave_fixpoint(&mut self) {}
    /// Sets the mark at which the round of the innermost loop begins, and returns the one before.
    fn replace_head(&mut self, _head: Option<Self::Mark>) -> Option<Self::Mark> {
        None
    }
    /// Forgets what a name was bound to before, such as in an earlier round.
    fn begin_round(&mut self, _item: BindingId) {}
    /// Number of findings so far.
    fn findings(&self) -> (usize, usize) {
        (0, 0)
    }
    /// Drops later findings, because a walk that counts follows.
    fn drop_findings(&mut self, _since: (usize, usize)) {}
    /// Enters a cleanup, which the monitors around it may no longer watch.
    fn begin_cleanup(&mut self) {}
    /// Leaves a cleanup.
    fn end_cleanup(&mut self) {}
    /// Checks a handler, which these failures reach, before its first step.
    fn begin_handler(&mut self, _catch: &Catch, _kinds: &[Failure]) {}
    /// Checks a handler after its last step.
    fn end_handler(&mut self, _catch: &Catch, _kinds: &[Failure]) {}
    /// Passes over a handler that no failure reaches.
    fn skip(&mut self, _block: &[StepId]) {}
    /// Ends the policy itself, by a step or at the span of a reaction.
    fn done(&mut self, _id: Option<StepId>, _span: Span) {}

    /// Walks over a block.
    fn block(&mut self, block: &'p [StepId]) {
        for id in block {
            if self.is_over() {
                return;
            }
            self.step(*id);
        }
    }

    /// Walks over a step.
    fn step(&mut self, id: StepId) {
        if !self.enter(id) {
            return self.stop();
        }
        let Some(step) = self.program().step(id) else { return };
        match &step.kind {
            StepKind::Call(call) => {
                self.transfer(id, call, step.span);
                if call.is_faulty {
                    self.lose(id);
                }
            }
            StepKind::Let { binding, value } => {
                if value.may_lack_value() {
                    self.throw(Some(TIMEOUT), usize::MAX);
                }
                self.begin_round(*binding);
            }
            StepKind::Sequence { body, .. } => self.sequence(id, body),
            StepKind::Inline { body, .. } => self.inline(id, body),
            StepKind::If { condition, then, otherwise, .. } => {
                self.branch(id, condition, then, otherwise.as_deref().unwrap_or_default());
            }
            StepKind::Wait { condition, .. } => {
                self.fail_wait(id, condition);
                self.await_at(id, condition);
            }
            StepKind::Delay { .. } => self.pass_time(id),
            StepKind::Finally { body, cleanup } => self.protect(id, body, cleanup),
            StepKind::Monitor { whens, body } => self.monitor(id, whens, body),
            StepKind::Try { body, catches } => self.attempt(body, catches),
            StepKind::Repeat { times, body, until } => {
                let until = until.as_ref().map(|(condition, _)| condition);
                self.looped(id, body, Loop::Repeat { times: *times, until });
            }
            StepKind::Each { item, list, body, .. } => {
                self.throw(self.exhausted(), usize::MAX);
                if list.may_lack_value() {
                    self.throw(Some(TIMEOUT), usize::MAX);
                }
                self.looped(id, body, Loop::each(*item, list));
            }
            StepKind::Parallel { branches } => self.parallel(id, branches),
            StepKind::End { kind, of, .. } => self.end(Some(id), *kind, *of, step.span),
            StepKind::Unknown => self.lose(id),
        }
    }

    fn branch(&mut self, id: StepId, condition: &Condition, then: &'p [StepId], otherwise: &'p [StepId]) {
        let mark = self.mark();
        let mut paths = Vec::with_capacity(2);
        for (truth, block) in [(true, then), (false, otherwise)] {
            if self.assume_at(id, condition, truth) {
                self.block(block);
                if self.is_live() {
                    paths.extend(self.ends(&mark));
                }
            }
            self.restore(&mark);
        }
        self.join(&mark, &paths);
    }

    fn inline(&mut self, id: StepId, body: &'p [StepId]) {
        let (mark, exits) = (self.mark(), self.collector());
        self.enclosing().push(Enclosing::Inline { step: id, exits });
        self.block(body);
        let Some(Enclosing::Inline { exits, .. }) = self.enclosing().pop() else { return };
        if let Some(done) = self.collected(&exits) {
            let mut paths = vec![done];
            if self.is_live() {
                paths.push(self.path(&mark));
            }
            self.join(&mark, &paths);
        }
    }

    fn attempt(&mut self, body: &'p [StepId], catches: &'p [Catch]) {
        let mark = self.mark();
        let handlers = catches.iter().map(|catch| Handler {
            on: catch.on.as_ref().map(|kinds| kinds.iter().map(|(kind, _)| *kind).collect()),
            states: self.collector(),
            kinds: Vec::new(),
        });
        let handlers = handlers.collect();
        self.enclosing().push(Enclosing::Try { handlers });
        self.block(body);
        let Some(Enclosing::Try { handlers }) = self.enclosing().pop() else { return };
        let mut paths = if self.is_live() { self.paths(&mark) } else { Vec::with_capacity(catches.len()) };
        for (catch, Handler { states, kinds, .. }) in catches.iter().zip(&handlers) {
            self.begin_handler(catch, kinds);
            self.restore(&mark);
            if !self.follow_failures(states) {
                self.skip(&catch.body);
                continue;
            }
            if let Some(caught) = catch.binds {
                self.begin_round(caught.kind);
                self.begin_round(caught.text);
            }
            self.block(&catch.body);
            self.end_handler(catch, kinds);
            if self.is_live() {
                paths.push(self.path(&mark));
            }
        }
        self.join(&mark, &paths);
    }

    /// Walks over a loop to its fixed point: the state at its head is the join of the entry and of every back
    /// edge.
    fn looped(&mut self, id: StepId, body: &'p [StepId], how: Loop<'_>) {
        if !self.enter_fixpoint(id) {
            return;
        }
        let mark = self.mark();
        let outer = self.replace_head(Some(mark.clone()));
        let exits = self.rounds(id, body, how, self.path(&mark)).exits;
        self.replace_head(outer);
        self.leave_fixpoint();
        self.join(&mark, &exits);
    }

    /// Iterates from the states `head` at the head of a loop until no round adds to them, and returns the
    /// paths of the last round. Findings of earlier rounds are dropped.
    fn rounds(
        &mut self,
        id: StepId,
        body: &'p [StepId],
        how: Loop<'_>,
        mut head: Self::Path,
    ) -> Round<Self::Path> {
        let (mark, findings) = (self.mark(), self.findings());
        let entry = self.path(&mark);
        let mut count = 0;
        loop {
            self.drop_findings(findings);
            self.follow(&head);
            if let Loop::Each { item, .. } = how {
                self.begin_round(item);
            }
            self.block(body);
            let live = self.is_live().then(|| self.exits(id, how, &mark));
            let mut round = live.unwrap_or(Round { exits: Vec::new(), back: None });
            self.restore(&mark);
            let Some(next) = round.back.as_ref().and_then(|back| self.widen(&head, back, count)) else {
                if matches!(how, Loop::Each { least: 0, .. }) {
                    // The list may be empty.
                    round.exits.insert(0, entry);
                }
                return round;
            };
            head = next;
            count += 1;
        }
    }

    /// Paths from the end of a loop's body that was entered at `mark`.
    fn exits(&mut self, id: StepId, how: Loop<'_>, mark: &Self::Mark) -> Round<Self::Path> {
        let (times, until) = match how {
            Loop::Each { .. } => (u32::MAX, None),
            Loop::Repeat { times, until } => (times, until),
        };
        let Some(until) = until else {
            let path = self.path(mark);
            return Round { back: (times > 1).then(|| path.clone()), exits: vec![path] };
        };
        let (here, mut round) = (self.mark(), Round { exits: Vec::new(), back: None });
        if self.assume_at(id, until, true) {
            round.exits.push(self.path(mark));
        }
        self.restore(&here);
        if self.assume_at(id, until, false) {
            self.throw(self.exhausted(), usize::MAX);
            round.back = (times > 1).then(|| self.path(mark));
        }
        round
    }

    /// Walks over parallel branches, each disturbed by the others.
    fn parallel(&mut self, id: StepId, branches: &'p [Vec<StepId>]) {
        if !self.enter_fixpoint(id) {
            return;
        }
        let mark = self.mark();
        let changes = self.branch_changes(branches);
        let mut paths = Vec::with_capacity(branches.len());
        let mut is_live = true;
        for (index, branch) in branches.iter().enumerate() {
            self.disturb(id, &changes, index);
            self.block(branch);
            self.end_branch();
            is_live &= self.is_live();
            paths.push(self.path(&mark));
            self.restore(&mark);
        }
        self.compose(id, &changes, &paths);
        self.leave_fixpoint();
        if !is_live {
            self.stop();
        }
    }

    /// Walks over the reaction of a monitor that fires in the present states.
    fn react(&mut self, when: &'p When) {
        match &when.reaction {
            Reaction::Pause { .. } | Reaction::Timeout => self.throw(Some(TIMEOUT), usize::MAX),
            Reaction::Restart { .. } => self.throw(self.exhausted(), usize::MAX),
            Reaction::Resume { body, .. } => {
                self.throw(self.exhausted(), usize::MAX);
                self.block(body);
            }
            Reaction::End { kind, of, .. } => self.end(None, *kind, *of, when.span),
        }
    }

    /// Ends the policy, or the inlined policy `of`.
    fn end(&mut self, id: Option<StepId>, kind: EndKind, of: Option<StepId>, span: Span) {
        let is_it = |enclosing: &Enclosing<Self::Collector>| match enclosing {
            Enclosing::Inline { step, .. } => Some(*step) == of,
            Enclosing::Try { .. } | Enclosing::Monitor { .. } => false,
            Enclosing::Finally(_) | Enclosing::Cleanup(_) => false,
        };
        // Some endings end the whole policy, wherever they stand.
        let of = of.filter(|_| matches!(kind, EndKind::Done | EndKind::Fail));
        let depth = self.enclosing().iter().rposition(is_it);
        if self.leave(Ended { id, kind, of, span }, depth) {
            return self.stop();
        }
        match (kind, of, depth) {
            (EndKind::Done, None, _) => self.done(id, span),
            (EndKind::Done, Some(_), Some(depth)) => {
                let mut enclosing = std::mem::take(self.enclosing());
                if let Some(Enclosing::Inline { exits, .. }) = enclosing.get_mut(depth) {
                    self.collect(exits, Exit::Done);
                }
                *self.enclosing() = enclosing;
            }
            (EndKind::Fail, Some(_), Some(depth)) => self.throw(self.failed(), depth),
            (EndKind::Fail | EndKind::Cannot | EndKind::Replan, _, _) => {}
            (EndKind::Done, Some(_), None) => {}
        }
        self.stop();
    }

    /// Lets the innermost cleanup inside of `depth` collect the present states, in which the policy ends.
    /// Returns false if there is none.
    fn leave(&mut self, ended: Ended, depth: Option<usize>) -> bool {
        let mut enclosing = std::mem::take(self.enclosing());
        let inside = enclosing.iter_mut().skip(depth.map_or(0, |depth| depth + 1)).rev();
        let mut cleanups = inside.filter_map(|enclosing| match enclosing {
            Enclosing::Finally(leaving) => Some(leaving),
            Enclosing::Try { .. } | Enclosing::Inline { .. } | Enclosing::Monitor { .. } => None,
            Enclosing::Cleanup(_) => None,
        });
        let found = cleanups.next();
        let is_found = found.is_some();
        if let Some(leaving) = found {
            let is_same = |other: &Ended| other.kind == ended.kind && other.of == ended.of;
            match leaving.ended.iter_mut().find(|(other, _)| is_same(other)) {
                Some((_, states)) => self.collect(states, Exit::Done),
                None => {
                    let mut states = self.collector_at(&leaving.failed);
                    self.collect(&mut states, Exit::Done);
                    leaving.ended.push((ended, states));
                }
            }
        }
        *self.enclosing() = enclosing;
        is_found
    }

    /// Walks over a block with a cleanup. The cleanup is walked from each path on which control leaves the
    /// block, and behind it the path goes on; then once from all of them, for the verdicts on its steps.
    fn protect(&mut self, id: StepId, body: &'p [StepId], cleanup: &'p [StepId]) {
        let mark = self.mark();
        let is_interruptible = self.program().is_interruptible(id);
        let mut interrupted = is_interruptible.then(|| self.collector());
        if let Some(states) = &mut interrupted {
            self.collect(states, Exit::Failure);
        }
        let (failed, kinds, ended) = (self.collector(), Vec::new(), Vec::new());
        let leaving = Leaving { failed, kinds, ended, interrupted };
        self.enclosing().push(Enclosing::Finally(Box::new(leaving)));
        self.block(body);
        let ends = if self.is_live() { self.paths(&mark) } else { Vec::new() };
        let Some(Enclosing::Finally(leaving)) = self.enclosing().pop() else { return };
        let Leaving { failed, kinds, ended, interrupted } = *leaving;
        self.restore(&mark);
        if !self.enter_fixpoint(id) {
            return;
        }
        let mut entries: Vec<Self::Path> = Vec::with_capacity(2);
        entries.extend(ends.iter().cloned());
        let mut paths = Vec::with_capacity(1 + ended.len());
        let failed = (None, &failed);
        for (ended, states) in ended.iter().map(|(ended, states)| (Some(*ended), states)).chain([failed]) {
            let Some(path) = self.collected(states) else { continue };
            entries.push(path.clone());
            paths.push((self.cleaned(&mark, &path, cleanup), ended));
        }
        if let Some(path) = interrupted.and_then(|states| self.anywhere(&states, body)) {
            entries.push(path.clone());
            // What interrupted the block goes on from any of its states, and from those of its cleanup.
            self.cleaned(&mark, &path, cleanup);
        }
        let ends: Vec<Self::Path> =
            ends.iter().filter_map(|path| self.cleaned(&mark, path, cleanup)).collect();
        self.join(&mark, &entries);
        self.clean(cleanup);
        self.leave_fixpoint();
        for (path, ended) in paths {
            self.restore(&mark);
            let Some(path) = path else { continue };
            self.follow(&path);
            match ended {
                Some(Ended { id, kind, of, span }) => self.end(id, kind, of, span),
                None => self.throw_all(&kinds),
            }
        }
        self.restore(&mark);
        self.join(&mark, &ends);
    }

    /// The states behind a cleanup that begins at the end of a path, as a path; `None` if there are none. Its
    /// findings are dropped.
    fn cleaned(&mut self, mark: &Self::Mark, path: &Self::Path, cleanup: &'p [StepId]) -> Option<Self::Path> {
        let findings = self.findings();
        self.restore(mark);
        self.follow(path);
        self.clean(cleanup);
        let end = self.is_live().then(|| self.path(mark));
        self.drop_findings(findings);
        self.restore(mark);
        end
    }

    /// Walks over the steps of a cleanup, a failure of which leads behind it.
    fn clean(&mut self, cleanup: &'p [StepId]) {
        let mark = self.mark();
        let handler = Handler { on: None, states: self.collector(), kinds: Vec::new() };
        self.enclosing().push(Enclosing::Cleanup(handler));
        self.begin_cleanup();
        self.block(cleanup);
        self.end_cleanup();
        let Some(Enclosing::Cleanup(handler)) = self.enclosing().pop() else { return };
        let mut paths = Vec::with_capacity(2);
        if self.is_live() {
            paths.push(self.path(&mark));
        }
        paths.extend(self.collected(&handler.states));
        self.join(&mark, &paths);
    }

    /// Throws a failure in the present states: the innermost handler below `depth` that catches it collects
    /// them.
    fn throw(&mut self, kind: Option<Failure>, depth: usize) {
        let Some(kind) = kind else { return };
        let mut enclosing = std::mem::take(self.enclosing());
        let mut around = enclosing.iter_mut().take(depth).rev();
        if let Some((states, kinds)) = around.find_map(|enclosing| enclosing.catcher(kind)) {
            // The same state for another kind adds nothing but the kind.
            self.collect(states, Exit::Failure);
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
        *self.enclosing() = enclosing;
    }

    /// Throws several failures in the present states.
    fn throw_all(&mut self, kinds: &[Failure]) {
        // A handler collects the same states once, however many kinds reach it.
        for kind in kinds {
            self.throw(Some(*kind), usize::MAX);
        }
    }
}
