//! Monitors: their body under watch, and the states from which reactions start.

use motet_syntax::ast::EndKind;
use motet_syntax::{Diagnostic, Mistake as _};

use super::assume::{Outcome, mentions};
use super::collector::Collector;
use super::diagnostics::{BodyFires, NeverFires};
use super::effects::FactChange;
use super::evaluation::CallFrame;
use super::{Mode, Prover, Volatile, Watched};
use crate::analysis::{Domain, Enclosing};
use crate::declare::EffectDef;
use crate::facts::{Cause, Delta, TruthSet, effort};
use crate::ir::{BlockSlot, Call, Condition, Fact, Reaction, Step, StepId, StepKind, When};

impl<'a> Prover<'a> {
    /// Proves a monitor to a fixed point: its reactions may run in any state of the body, and again in what
    /// they left.
    pub(super) fn watch_for(&mut self, id: StepId, whens: &'a [When], body: &'a [StepId]) {
        if whens.iter().all(|when| self.is_outside(when)) {
            return self.watch(id, whens, body);
        }
        if !self.enter_fixpoint(id) {
            return;
        }
        let mark = self.state.facts.mark();
        let said = self.findings();
        let volatile = self.state.volatile.len();
        self.rehearse(id, whens, &Delta::default(), mark, volatile);
        let watched = self.watched_by(id, whens);
        self.state.watched.push(watched);
        self.free(id, whens);
        let restarts = whens.iter().filter(|when| matches!(when.reaction, Reaction::Restart { .. }));
        let restarts: Vec<_> = restarts.collect();
        let resumes = whens.iter().any(|when| matches!(when.reaction, Reaction::Resume { .. }));
        self.erode();
        let before = self.state.facts.delta(mark);
        self.enter_body(id, whens);
        // Else it fires at once, and only a restart begins the body.
        let mut head = self.control.live.then(|| self.state.facts.delta(mark));
        self.back_to(mark);
        // The body may begin again from any of its states, where a restart asks for it.
        let (end, states) = loop {
            self.drop_findings(said);
            self.control.live = head.is_some();
            self.state.facts.replay(head.as_ref().unwrap_or(&before));
            self.control.enclosing.push(Enclosing::Monitor { states: Collector::new(mark) });
            self.erode();
            self.see_states();
            if self.control.live {
                self.block(body);
                self.leave_body(id, whens);
            }
            let end = self.control.live.then(|| self.state.facts.delta(mark));
            let states = match self.control.enclosing.pop() {
                Some(Enclosing::Monitor { states }) => states.delta(),
                _ => Delta::default(),
            };
            self.back_to(mark);
            let states = states.or(&before, &self.state.facts);
            // A reaction may run in any state of the body, and again in what it left.
            let grown = self.rehearse(id, whens, &states, mark, volatile);
            let mut next = head.clone();
            for when in &restarts {
                let partitions = self.state.partitions.clone();
                self.state.facts.replay(&states);
                if self.overtake(id, &when.condition) {
                    if resumes {
                        // It may have broken off a reaction.
                        self.doubt_reactions(id);
                    }
                    let path = self.state.facts.delta(mark);
                    self.back_to(mark);
                    next = Some(match next {
                        Some(next) => next.or(&path, &self.state.facts),
                        None => path,
                    });
                } else {
                    self.back_to(mark);
                }
                self.state.partitions = partitions;
            }
            let is_same = match (&next, &head) {
                (Some(next), Some(head)) => next.same_sets(head, &self.state.facts),
                (next, head) => next.is_none() == head.is_none(),
            };
            if !grown && is_same {
                break (end, states);
            }
            head = next;
        };
        self.state.watched.pop();
        self.state.volatile.truncate(volatile);
        let mut left = whens;
        while let Some((when, later)) = left.split_first() {
            // Only another reaction that goes on waits for the end of one.
            let breaks_off = resumes && !matches!(when.reaction, Reaction::Resume { .. });
            self.fire(id, (when, later, breaks_off), &states, mark);
            left = later;
        }
        self.control.fixpoints -= 1;
        self.join(&mark, end.as_slice());
    }

    /// Fluents, measures and entities in the conditions of a monitor.
    pub(super) fn watched_by(&self, by: StepId, whens: &[When]) -> Watched {
        let (measures, fluents, near) = (Vec::new(), Vec::new(), Vec::new());
        let mut watched = Watched { by, measures, fluents, near };
        for when in whens {
            watched.add(&when.condition, &mut |term| self.argument(term, CallFrame::default()));
        }
        watched
    }

    /// Returns whether a reaction leaves the policy, or only waits, so that it needs no proof.
    fn is_outside(&self, when: &When) -> bool {
        let around = &self.control.enclosing;
        let cleaned = around.iter().any(|enclosing| matches!(enclosing, Enclosing::Finally(_)));
        let catches =
            |enclosing: &Enclosing<_>| matches!(enclosing, Enclosing::Try { .. } | Enclosing::Cleanup(_));
        let caught = cleaned || around.iter().any(catches);
        let outside = match &when.reaction {
            Reaction::Pause { .. } | Reaction::Timeout => !caught,
            Reaction::End { kind: EndKind::Fail, of: None, .. } => !cleaned,
            Reaction::End { kind: EndKind::Cannot | EndKind::Replan, .. } => !cleaned,
            Reaction::Restart { .. } | Reaction::Resume { .. } | Reaction::End { .. } => false,
        };
        outside && (matches!(when.reaction, Reaction::Timeout) || !when.condition.is_constant())
    }

    /// Proves the body of a monitor whose reactions need no proof.
    fn watch(&mut self, id: StepId, whens: &'a [When], body: &'a [StepId]) {
        self.enter_body(id, whens);
        let watched = self.watched_by(id, whens);
        self.state.watched.push(watched);
        let volatile = self.state.volatile.len();
        self.free(id, whens);
        self.erode();
        if self.control.live {
            self.block(body);
            self.leave_body(id, whens);
        }
        self.state.volatile.truncate(volatile);
        self.state.watched.pop();
    }

    /// Assumes that no condition that fires at once holds where the body begins. Behind a pause or a
    /// reaction that goes on, the world may have changed what holds now.
    fn enter_body(&mut self, id: StepId, whens: &'a [When]) {
        for when in whens.iter().filter(|when| when.hold_secs == 0.0) {
            let here = self.state.facts.mark();
            let goes_on = when.reaction.goes_on();
            if goes_on {
                // On each of the paths that have met the body may begin.
                self.forget_paths(&when.condition);
            }
            if self.assume_at(id, &when.condition, false) {
                continue;
            }
            if !goes_on || when.condition.is_constant() {
                self.control.live = false;
                continue;
            }
            self.back_to(here);
            self.undo(&when.condition, Cause::step(id));
            self.await_condition(&when.condition, false, Cause::step(id));
            // It may also go on while the condition is unknown.
            self.doubt(&when.condition, Cause::step(id));
        }
    }

    /// Drops the paths that have met and that differ in what a condition mentions.
    pub(super) fn forget_paths(&mut self, condition: &Condition) {
        self.state.partitions.retain(|partition| !partition.differs(|fluent| mentions(condition, fluent)));
    }

    /// Weakens the facts at the end of a body: it may end while a condition holds that has made it pause, or
    /// run a reaction.
    fn leave_body(&mut self, id: StepId, whens: &'a [When]) {
        self.erode();
        for when in whens {
            if when.reaction.goes_on() {
                self.doubt(&when.condition, Cause::step(id));
            }
        }
    }

    /// Records the watched facts that the world may change without a reaction as volatile: those of one
    /// part of a conjunction, and those of a condition that has to hold for a time.
    fn free(&mut self, id: StepId, whens: &'a [When]) {
        let mut free = Vec::new();
        for when in whens {
            self.free_facts(&when.condition, (false, when.hold_secs == 0.0), &mut free);
        }
        let value = TruthSet::open(Cause::step(id));
        let row = |(fluent, key)| Volatile { fluent, key, value, when: None, restored: false };
        let rows = self.atoms_of(free).into_iter().map(row);
        self.state.volatile.extend(rows);
        // A step on a name may set the monitor off. Then the body goes on when the world has undone that.
        let mut restored = Vec::new();
        for when in whens.iter().filter(|when| when.reaction.goes_on() && when.hold_secs == 0.0) {
            settled_facts(&when.condition, false, &mut restored);
        }
        for (fact, truth) in restored {
            let (fluent, key) = (fact.fluent, self.widest_key(fact, CallFrame::default()));
            let value = TruthSet::of(truth, Cause::step(id));
            self.state.volatile.push(Volatile { fluent, key, value, when: None, restored: true });
        }
    }

    /// Records the facts that `resume` reactions change from any of these states as volatile in the body;
    /// returns whether that adds to the rows from `first` on, which belong to this monitor.
    fn rehearse(&mut self, id: StepId, whens: &'a [When], states: &Delta, mark: usize, first: usize) -> bool {
        let mut grown = false;
        let mut left = whens;
        while let Some((when, later)) = left.split_first() {
            left = later;
            let Reaction::Resume { body, .. } = &when.reaction else { continue };
            let (said, partitions) = (self.findings(), self.state.partitions.clone());
            self.control.live = true;
            self.state.facts.replay(states);
            self.forget_later(id, later);
            self.overtake(id, &when.condition);
            let seen = self.state.facts.mark();
            self.control.rehearsals += 1;
            self.block(body);
            for (fluent, key) in self.state.facts.touched(seen) {
                let value = match key.is_pattern() {
                    true => self.state.facts.get(fluent, key),
                    // What was forgotten of a name is what is known of all that it may be.
                    false => self.read(fluent, key),
                };
                let mut rows = self.state.volatile.iter_mut().skip(first);
                match rows.find(|row| row.fluent == fluent && row.key == key && row.when == Some(when.span)) {
                    Some(row) => {
                        let joined = row.value.join(value);
                        grown |= !joined.lasts_as(row.value);
                        row.value = joined;
                    }
                    None => {
                        self.state.volatile.push(Volatile {
                            fluent,
                            key,
                            value,
                            when: Some(when.span),
                            restored: false,
                        });
                        grown = true;
                    }
                }
            }
            self.back_to(mark);
            self.state.partitions = partitions;
            self.drop_findings(said);
            self.control.rehearsals -= 1;
            self.control.live = true;
        }
        grown
    }

    /// Conditions that fire at once, of the monitors around a step, with their truth before its effects.
    ///
    /// One that ends the policy as done is how a policy waits for its own work.
    pub(super) fn armed(&self, id: StepId) -> Vec<ArmedWhen<'a>> {
        let program = self.program;
        let mut armed = Vec::new();
        if self.state.watched.is_empty() || self.control.rehearsals > 0 || self.is_in_reaction(id) {
            return armed;
        }
        for watched in &self.state.watched {
            let Some(StepKind::Monitor { whens, .. }) = program.step(watched.by).map(|step| &step.kind)
            else {
                continue;
            };
            let fires = |when: &&When| {
                let is_end = matches!(when.reaction, Reaction::End { kind: EndKind::Done, .. });
                when.hold_secs == 0.0 && !is_end
            };
            for when in whens.iter().filter(fires) {
                let by = watched.by;
                let held = self.is_met(when, by);
                armed.push(ArmedWhen { when, by, held });
            }
        }
        armed
    }

    /// Conditions with a time, of the monitors around a step, that an earlier step of their bodies has made
    /// certain, each with that step. The step lasts at least as long as they have to hold.
    pub(super) fn lasting(&self, id: StepId) -> Vec<LastingWhen<'a>> {
        let program = self.program;
        let least_secs = program.step(id).map_or(0.0, |step| step.bounds.0);
        if least_secs <= 0.0 || self.control.rehearsals > 0 || self.is_in_reaction(id) {
            return Vec::new();
        }
        let mut lasting = Vec::new();
        for watched in &self.state.watched {
            let Some(StepKind::Monitor { whens, .. }) = program.step(watched.by).map(|step| &step.kind)
            else {
                continue;
            };
            let fires = |when: &&When| {
                let is_exempt =
                    matches!(when.reaction, Reaction::Timeout | Reaction::End { kind: EndKind::Done, .. });
                when.hold_secs > 0.0 && when.hold_secs <= least_secs && !is_exempt
            };
            let is_in = |step: &StepId| {
                let is_call = matches!(program.step(*step).map(|step| &step.kind), Some(StepKind::Call(_)));
                is_call && program.around(*step).any(|(around, _)| around == watched.by)
            };
            let made = whens.iter().filter(fires).filter_map(|when| {
                let value = self.evaluate(&when.condition, CallFrame::default());
                let step = value.yes.as_step().filter(is_in).filter(|_| self.is_met(when, watched.by))?;
                Some(LastingWhen { when, by: watched.by, step })
            });
            lasting.extend(made.filter(|lasting| !self.is_in_reaction(lasting.step)));
        }
        lasting
    }

    /// Reports the monitors whose condition, made certain by an earlier step, stays so while this step runs.
    pub(super) fn check_lasting(&mut self, lasting: &[LastingWhen<'a>]) {
        for LastingWhen { when, by, step } in lasting {
            if self.is_met(when, *by) {
                self.body_fires(when, *step);
            }
        }
    }

    /// Returns whether a step belongs to the reaction of a monitor.
    pub(super) fn is_in_reaction(&self, id: StepId) -> bool {
        let in_reaction = |step: &Step| matches!(step.position.slot, BlockSlot::Reaction(_));
        self.program.step(id).is_some_and(in_reaction)
            || self.program.around(id).any(|(_, step)| in_reaction(step))
    }

    /// Reports the monitors whose condition the effects of a step have made certain.
    pub(super) fn check_fired(&mut self, armed: &[ArmedWhen<'a>], id: StepId) {
        for ArmedWhen { when, by, held } in armed {
            if !*held && self.is_met(when, *by) {
                self.body_fires(when, id);
            }
        }
    }

    /// Returns whether the condition of a monitor holds, unless the world changes what it watches.
    fn is_met(&self, when: &When, by: StepId) -> bool {
        let value = self.evaluate(&when.condition, CallFrame::default());
        let is_open = value.open.is_some() && value.open.as_step() != Some(by);
        value.yes.is_some() && !value.no.is_some() && !is_open
    }

    /// Reports a monitor that a step of its body fires.
    fn body_fires(&mut self, when: &When, id: StepId) {
        if self.mode == Mode::Decide {
            return self.count(BodyFires::CODE);
        }
        let step = self.cause_name(Cause::step(id));
        let holds = self.show(&when.condition, true, CallFrame::default());
        let fired = self.program.step(id).map(|step| step.span);
        let mistake = Diagnostic::from(BodyFires { span: when.span, step, holds, fired });
        self.tell_once(mistake);
    }

    /// Assumes that a monitor sees its condition to hold. What the policy itself rules out the world may have
    /// brought about: then the steps that made it otherwise are undone, and nothing is known of what they
    /// made. Returns false if the condition cannot hold in any world.
    fn overtake(&mut self, id: StepId, condition: &Condition) -> bool {
        let here = self.state.facts.mark();
        let cause = Cause::step(id);
        // The paths that have met tell nothing of what the world has changed since.
        // It also fires when the condition has been unknown for long, and the step that it interrupts may
        // change what has set it off.
        self.forget_paths(condition);
        if self.narrow(condition, Outcome::NotFalse, cause, CallFrame::default()) {
            self.doubt(condition, cause);
            return true;
        }
        if condition.is_constant() {
            return false;
        }
        self.back_to(here);
        self.undo(condition, cause);
        self.await_condition(condition, true, cause);
        self.doubt(condition, cause);
        true
    }

    /// Makes the facts of a condition that are known to hold unknown as well.
    pub(super) fn doubt(&mut self, condition: &Condition, cause: Cause) {
        self.doubt_free(condition, (false, false), cause);
    }

    /// Makes the facts of a condition unknown as well that do not follow from its truth; `known` is that
    /// truth, and whether it says anything.
    pub(super) fn doubt_free(&mut self, condition: &Condition, known: (bool, bool), cause: Cause) {
        let (mut doubtful, mut free) = (Vec::new(), Vec::new());
        self.free_facts(condition, known, &mut free);
        for fact in free {
            let is_derived = self.library.fluent(fact.fluent).is_some_and(|def| def.derived);
            if !is_derived {
                let key = self.widest_key(fact, CallFrame::default());
                doubtful.push(FactChange::perhaps(fact.fluent, key));
            }
        }
        self.unsettle(&doubtful, cause);
    }

    /// Makes unknown as well what the reactions of a monitor may change: one may have broken off.
    pub(super) fn doubt_reactions(&mut self, by: StepId) {
        let program = self.program;
        let is_in = |step: &Step| {
            step.position.parent == Some(by) && matches!(step.position.slot, BlockSlot::Reaction(_))
        };
        effort::spend(program.steps.len());
        for (index, step) in program.steps.iter().enumerate() {
            let StepKind::Call(call) = &step.kind else { continue };
            let id = StepId(u32::try_from(index).unwrap_or(u32::MAX));
            if !is_in(step) && !program.around(id).any(|(_, around)| is_in(around)) {
                continue;
            }
            let Some(def) = self.library.primitive(call.primitive) else { continue };
            for effects in [&def.makes, &def.unsettles] {
                let changed = self.changes_of(call, effects);
                let perhaps = |change: &FactChange| FactChange::perhaps(change.fluent, change.key);
                let perhaps: Vec<_> = changed.iter().map(perhaps).collect();
                self.unsettle(&perhaps, Cause::step(by));
            }
        }
    }

    /// Facts that effects of the primitive of a call have perhaps changed, with the call's arguments and its
    /// result: what they depend on may have been otherwise then.
    pub(super) fn changes_of(&self, call: &Call, effects: &[EffectDef]) -> Vec<FactChange> {
        let result = call.binds.and_then(|binding| self.symbols.of_binding(binding.index()));
        let effects: Vec<_> = effects.iter().map(|it| EffectDef { when: None, ..it.clone() }).collect();
        let mut changed = Vec::new();
        self.changes(&effects, CallFrame { args: &call.args, result, each: None }, &mut changed);
        changed
    }

    /// Makes unknown what the steps have made that decide a condition.
    pub(super) fn undo(&mut self, condition: &Condition, cause: Cause) {
        let (mut makers, mut rest) = (Vec::new(), vec![condition]);
        while let Some(part) = rest.pop() {
            rest.extend(part.parts());
            if let Condition::Fact(_) = part {
                let known = self.evaluate(part, CallFrame::default());
                makers.extend(known.yes.as_step().into_iter().chain(known.no.as_step()));
                if [known.yes, known.no].contains(&Cause::SEEN_BY_SEVERAL) {
                    makers.extend(self.state.lasting.keys());
                    makers.sort_unstable();
                }
            }
        }
        for maker in makers {
            let Some(StepKind::Call(call)) = self.program.step(maker).map(|step| &step.kind) else {
                continue;
            };
            let Some(def) = self.library.primitive(call.primitive) else { continue };
            let made = self.changes_of(call, &def.makes);
            self.unsettle(&made, cause);
        }
    }

    /// Proves a reaction from the states in which it can start, among them those in which it breaks off
    /// another one, if it can.
    fn fire(
        &mut self,
        id: StepId,
        (when, later, breaks_off): (&'a When, &'a [When], bool),
        states: &Delta,
        mark: usize,
    ) {
        let partitions = self.state.partitions.clone();
        self.follow(states);
        self.forget_later(id, later);
        self.control.live = self.overtake(id, &when.condition);
        if self.control.live {
            if breaks_off {
                self.doubt_reactions(id);
            }
            self.react(when);
        } else {
            self.diagnostics.push(NeverFires { span: when.span, what: "the monitor can never fire" }.into());
        }
        self.restore(&mark);
        self.state.partitions = partitions;
    }

    /// Collects the facts whose truth does not follow from that of the condition; `known` is the truth of the
    /// condition, and whether it says anything.
    ///
    /// If no entity has a fact, that is said of each; of some that have it, others may take the place. A fact
    /// about nobody knows whom never follows.
    fn free_facts<'c>(
        &self,
        condition: &'c Condition,
        (truth, is_known): (bool, bool),
        free: &mut Vec<&'c Fact>,
    ) {
        let is_settled = |fact: &Fact| {
            let is_named = || self.key(fact, CallFrame::default()).is_some();
            is_known && !(truth && fact.args.contains(&None)) && is_named()
        };
        match condition {
            Condition::Fact(fact) if is_settled(fact) => {}
            Condition::Fact(fact) => free.push(fact),
            Condition::Not(inner) => self.free_facts(inner, (!truth, is_known), free),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                let decides = truth == matches!(condition, Condition::All(_)) || parts.len() == 1;
                parts.iter().for_each(|part| self.free_facts(part, (truth, is_known && decides), free));
            }
            Condition::Literal(_)
            | Condition::Compare(..)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => {}
        }
    }

    /// Leaves open the facts of later conditions of a monitor, and of the monitors in its body: they may
    /// change at the same time, and then this reaction comes first.
    fn forget_later(&mut self, id: StepId, later: &'a [When]) {
        let program = self.program;
        let mut free = Vec::new();
        later.iter().for_each(|when| self.free_facts(&when.condition, (false, false), &mut free));
        let inside = (id.0 + 1..).map(StepId).map_while(|step| Some((step, program.step(step)?)));
        for (_, step) in inside.take_while(|(step, _)| program.around(*step).any(|(around, _)| around == id))
        {
            effort::spend(1);
            if let StepKind::Monitor { whens, .. } = &step.kind {
                whens.iter().for_each(|when| self.free_facts(&when.condition, (false, false), &mut free));
            }
        }
        effort::spend(effort::VISIT * free.len());
        for (fluent, key) in self.atoms_of(free) {
            self.state.facts.set(fluent, key, TruthSet::open(Cause::step(id)));
        }
    }
}

/// Collects the facts whose truth follows from that of a condition, each with its truth.
fn settled_facts<'c>(condition: &'c Condition, truth: bool, settled: &mut Vec<(&'c Fact, bool)>) {
    match condition {
        Condition::Fact(fact) => settled.push((fact, truth)),
        Condition::Not(inner) => settled_facts(inner, !truth, settled),
        Condition::All(parts) | Condition::AnyOf(parts)
            if parts.len() == 1 || truth == matches!(condition, Condition::All(_)) =>
        {
            parts.iter().for_each(|part| settled_facts(part, truth, settled));
        }
        _ => {}
    }
}

/// Condition of a monitor that fires at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArmedWhen<'a> {
    when: &'a When,
    /// Step of the monitor.
    by: StepId,
    /// True if it was certain before the step.
    held: bool,
}

/// Condition of a monitor that has to hold for a time, and that a step has made certain.
#[derive(Clone, Copy, Debug)]
pub(super) struct LastingWhen<'a> {
    when: &'a When,
    /// Step of the monitor.
    by: StepId,
    /// Step of its body that has made it certain.
    step: StepId,
}
