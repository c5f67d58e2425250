//! World of a made-up domain, as a driver: it keeps to the contracts, and is otherwise as bad as its mood.

use std::collections::{BTreeMap, VecDeque};

use motet_graph::Value;
use motet_runtime::{
    Answer, Capabilities, Command, Driver, DriverEvent, GoalId, Outcome, Pattern, PrimitiveSet, Query, Time,
};
use motet_stdlib::lang::fluents::HOLDING;
use rand::RngExt as _;
use rand_xoshiro::SplitMix64;

use super::contract::{Action, Domain, Frame, Kind, Need, State};
use super::make::{BASE, chance, one_of};

/// Behaviour of a world.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Mood {
    /// Every question is answered at once, and effects come at the end of their step.
    Honest,
    /// Answers are late, effects come at any time of their step, what is watched changes by itself.
    Adversarial,
    /// Some facts can never be observed, and others not always.
    Veiled,
}

/// Longest time that an answer, an end or a change takes beyond its step, in s.
const LATE_SECS: f64 = 0.2;

/// Goal that runs.
struct Running {
    id: GoalId,
    /// Cells that it may change.
    touches: Vec<usize>,
    /// Cells that it may change without a result: a fact of a result begins with it.
    unfinished: Vec<usize>,
    /// Cells that it makes, if it succeeds.
    makes: Vec<usize>,
    /// Cells that are as it made them only for a time.
    lasting: Vec<Lasting>,
    /// Use of the base by it, and the entities that it moves.
    stirs: Lifetime,
    /// Changes that are still to come, each at its time.
    flips: Vec<(Time, usize, bool)>,
    ends: Time,
    outcome: Outcome,
    /// Time at which it was held.
    held: Option<Time>,
}

/// Use of the base, and moved entities; a lifetime ends with either.
#[derive(Clone, Default)]
struct Lifetime {
    of_base: bool,
    of: Vec<usize>,
}

impl Lifetime {
    fn meets(&self, other: &Self) -> bool {
        self.of_base && other.of_base || self.of.iter().any(|one| other.of.contains(one))
    }
}

/// A cell that is as it was made until its lifetime ends.
struct Lasting {
    cell: usize,
    lifetime: Lifetime,
}

/// The world, at a moment.
pub(super) struct World<'d> {
    domain: &'d Domain,
    mood: Mood,
    dice: SplitMix64,
    now: Time,
    /// Truth of every fact.
    pub(super) state: State,
    veiled: Vec<bool>,
    /// Of a cell that a step has made, all that it made.
    made_with: BTreeMap<usize, Vec<usize>>,
    /// Cells that are as they were made only for a time.
    lasting: Vec<Lasting>,
    /// True while a test looks at the hands: then something may have dropped.
    pub(super) is_tested: bool,
    running: Vec<Running>,
    /// Cells that a goal has touched whose end the host has not heard of.
    unheard: Vec<(GoalId, Vec<usize>)>,
    watches: Vec<(Query, Answer)>,
    /// Entities of which the domain says nothing and that no perception has found.
    unheard_of: Vec<usize>,
    /// Reports, each at its time.
    outbox: VecDeque<(Time, DriverEvent)>,
    holds: bool,
    /// True where an answer is never late: over the driver protocol the host waits for it.
    pub(super) answers_at_once: bool,
    /// Number of changes that nobody made, so far.
    whims: u32,
    next_whim: Time,
    /// Changes of facts that nobody has read yet, in words, if somebody reads them.
    pub(super) changes: Option<Vec<(Time, String)>>,
}

impl<'d> World<'d> {
    /// A world that agrees with what a domain states of the start.
    pub(super) fn new(domain: &'d Domain, mood: Mood, mut dice: SplitMix64) -> Self {
        let mut state: State =
            (0..domain.size()).map(|_| !domain.is_closed && chance(&mut dice, 50)).collect();
        // A hand is empty where nothing is said of it.
        if let Some(holding) = domain.fluent(HOLDING) {
            let cells = domain.cells(holding, &[None]);
            cells.into_iter().for_each(|cell| put(&mut state, cell, false));
        }
        for (atom, truth) in &domain.start {
            for cell in domain.cells_in(atom, &Frame::default()) {
                put(&mut state, cell, *truth);
            }
        }
        // What a closed world says needs no observation.
        let is_veiled = mood == Mood::Veiled && !domain.is_closed;
        let veiled = (0..state.len()).map(|_| is_veiled && chance(&mut dice, 35)).collect();
        let holds = chance(&mut dice, 50);
        let mut world = Self {
            domain,
            mood,
            dice,
            now: Time::ZERO,
            state,
            veiled,
            made_with: BTreeMap::new(),
            lasting: Vec::new(),
            is_tested: false,
            running: Vec::new(),
            unheard: Vec::new(),
            watches: Vec::new(),
            unheard_of: domain.undeclared().collect(),
            outbox: VecDeque::new(),
            holds,
            answers_at_once: false,
            whims: 0,
            next_whim: Time::NEVER,
            changes: None,
        };
        if mood == Mood::Adversarial {
            world.next_whim = world.later(4.0);
        }
        world
    }

    /// The domain of the world.
    #[must_use]
    pub(super) fn domain(&self) -> &'d Domain {
        self.domain
    }

    /// The mood of the world.
    #[must_use]
    pub(super) fn mood(&self) -> Mood {
        self.mood
    }

    /// The action of a name.
    #[must_use]
    pub(super) fn action(&self, name: &str) -> Option<&'d Action> {
        self.domain.actions.iter().find(|action| action.name == name)
    }

    /// The frame of the arguments of a call.
    pub(super) fn frame(&self, args: impl Iterator<Item = Value>) -> Frame {
        let params = args.filter_map(|value| match value {
            Value::Entity(id) | Value::Case(id) => self.domain.entity(&id),
            _ => None,
        });
        Frame { params: params.collect(), ..Frame::default() }
    }

    /// The action of a command, with its arguments.
    #[must_use]
    pub(super) fn called(&self, command: &Command) -> Option<(&'d Action, Frame)> {
        let action = self.action(&command.primitive)?;
        Some((action, self.frame(command.args.iter().map(|(_, value)| value.clone()))))
    }

    /// Returns whether a step that runs may change one of these facts.
    #[must_use]
    pub(super) fn is_moving(&self, cells: &[usize]) -> bool {
        let running = self.running.iter().map(|goal| &goal.touches);
        let mut touched = running.chain(self.unheard.iter().map(|(_, touches)| touches)).flatten();
        touched.any(|cell| cells.contains(cell))
    }

    /// Returns whether a need holds, of all of which somebody has heard.
    #[must_use]
    pub(super) fn meets(&self, need: &Need, frame: &Frame) -> bool {
        self.domain.meets(need, frame, (&self.state, &self.unheard_of))
    }

    /// Returns whether a fact is never observed.
    #[must_use]
    pub(super) fn is_hidden(&self, cells: &[usize]) -> bool {
        cells.iter().any(|cell| self.veiled.get(*cell).copied().unwrap_or(false))
    }

    /// Present time.
    #[must_use]
    pub(super) fn now(&self) -> Time {
        self.now
    }

    /// True if something is to be reported now.
    #[must_use]
    pub(super) fn is_due(&self) -> bool {
        self.outbox.front().is_some_and(|(at, _)| *at <= self.now)
    }

    /// What is to be reported now, the oldest first.
    pub(super) fn due(&mut self) -> Option<DriverEvent> {
        self.is_due().then(|| self.outbox.pop_front()).flatten().map(|(_, event)| event)
    }

    /// The host has heard of something.
    pub(super) fn heard(&mut self, event: &DriverEvent) {
        if let DriverEvent::Ended { goal, .. } | DriverEvent::Stopped { goal } = event {
            self.unheard.retain(|(ended, _)| ended != goal);
        }
    }

    /// From now on nothing changes by itself.
    pub(super) fn calm(&mut self) {
        self.next_whim = Time::NEVER;
        self.whims = u32::MAX;
    }

    fn later(&mut self, within_secs: f64) -> Time {
        self.now.after(Time::from_secs(within_secs * self.dice.random::<f64>()))
    }

    /// Some time from now on until another.
    fn between(&mut self, end: Time) -> Time {
        let span = if end == Time::NEVER { 4.0 } else { end.since(self.now).secs() };
        self.later(span)
    }

    fn say(&mut self, at: Time, event: DriverEvent) {
        let place = self.outbox.iter().rposition(|(before, _)| *before <= at).map_or(0, |index| index + 1);
        self.outbox.insert(place, (at, event));
    }

    fn late(&mut self) -> Time {
        let is_late = self.mood == Mood::Adversarial && chance(&mut self.dice, 30);
        if is_late { self.later(LATE_SECS) } else { self.now }
    }

    /// Cells that a query asks for; none where nobody can tell.
    fn asked(&self, query: &Query) -> Option<Vec<usize>> {
        let entity = |value: &Value| match value {
            Value::Entity(id) | Value::Case(id) => self.domain.entity(id),
            _ => None,
        };
        let (fluent, args): (_, Option<Vec<_>>) = match query {
            Query::Fact { fluent, args } => {
                let args = args.iter().map(|arg| match arg {
                    Pattern::Any => Some(None),
                    Pattern::Is(value) => entity(value).map(Some),
                });
                (self.domain.fluent(fluent), args.collect())
            }
            Query::Measure { args, .. } => {
                (self.domain.measure, args.iter().map(|value| entity(value).map(Some)).collect())
            }
            Query::Field { .. } => (None, None),
        };
        Some(self.domain.cells(fluent?, &args?))
    }

    fn answer(&self, query: &Query) -> Answer {
        let Some(cells) = self.asked(query) else { return Answer::Unknown };
        let told = |truth: bool| match query {
            Query::Measure { .. } => Answer::Value(Value::Number(if truth { 0.5 } else { 2.0 })),
            Query::Fact { .. } | Query::Field { .. } => Answer::Truth(truth),
        };
        let (hidden, seen): (Vec<usize>, Vec<usize>) =
            cells.into_iter().partition(|cell| self.is_hidden(&[*cell]));
        if seen.iter().any(|cell| self.state.get(*cell) == Some(&true)) {
            return told(true);
        }
        if hidden.is_empty() { told(false) } else { Answer::Unknown }
    }

    /// Ends the lifetimes of facts that an answer has told: they are so until something changes them. That
    /// some are true tells those that are.
    fn observed(&mut self, query: &Query, answer: &Answer) {
        let is_some = matches!(answer, Answer::Truth(true) | Answer::Value(_));
        let mut told = self.asked(query).unwrap_or_default();
        if *answer == Answer::Unknown {
            return;
        }
        if is_some && told.len() > 1 {
            told.retain(|cell| self.state.get(*cell) == Some(&true));
        }
        self.lasting.retain(|lasting| !told.contains(&lasting.cell));
    }

    fn is_watched(&self, query: &Query) -> bool {
        let name = |query: &Query| match query {
            Query::Fact { fluent: name, .. } | Query::Measure { measure: name, .. } => Some(name.clone()),
            Query::Field { .. } => None,
        };
        self.watches.iter().any(|(watched, _)| name(watched) == name(query))
    }

    /// Changes a fact, and reports what is watched of it.
    fn flip(&mut self, cell: usize, truth: bool) {
        if self.state.get(cell) == Some(&truth) {
            return;
        }
        put(&mut self.state, cell, truth);
        if let Some(changes) = &mut self.changes {
            changes.push((self.now, self.domain.said(cell, truth)));
        }
        for (query, known) in std::mem::take(&mut self.watches) {
            let answer = self.answer(&query);
            if answer != known {
                self.say(self.now, DriverEvent::Observed { query: query.clone(), answer: answer.clone() });
            }
            self.watches.push((query, answer));
        }
    }

    /// Something that is watched changes, and nobody did it.
    fn whim(&mut self) {
        self.next_whim = if self.whims < 4 { self.later(6.0) } else { Time::NEVER };
        self.whims += 1;
        if self.outbox.iter().any(|(_, event)| matches!(event, DriverEvent::Observed { .. })) {
            return;
        }
        let place = self.dice.random_range(0..self.watches.len().max(1));
        let Some((query, known)) = self.watches.get(place).cloned() else { return };
        let Some(cells) = self.asked(&query) else { return };
        if let Some(cell) = one_of(&mut self.dice, &cells).filter(|cell| !self.is_moving(&[*cell])) {
            let truth = self.state.get(cell) == Some(&true);
            put(&mut self.state, cell, !truth);
            let is_seen = self.answer(&query) != known;
            put(&mut self.state, cell, truth);
            // What a watch does not show, nobody was told to expect.
            if is_seen {
                self.flip(cell, !truth);
            }
        }
    }

    /// Plans a goal whose action succeeds or does not: its changes and its end.
    fn plan(&mut self, id: GoalId, action: &Action, frame: &Frame, outcome: Outcome) -> Running {
        let succeeds = matches!(outcome, Outcome::Success(_));
        let made = self.domain.changed(&action.makes, frame, &self.state);
        let unsettled = self.domain.changed(&action.unsettles, frame, &self.state);
        let span = if self.mood == Mood::Honest { 1.0 } else { 0.2 + 3.6 * self.dice.random::<f64>() };
        let ends = self.now.after(Time::from_secs(span));
        let mut finally: Vec<(usize, bool)> =
            unsettled.iter().map(|(cell, _)| (*cell, chance(&mut self.dice, 50))).collect();
        // What is made wins over what is unmade, and both over what is unsettled.
        for truth in [false, true] {
            for (cell, made) in made.iter().filter(|(_, made)| *made == truth) {
                let truth = if succeeds { *made } else { chance(&mut self.dice, 50) };
                finally.retain(|(other, _)| other != cell);
                if succeeds || chance(&mut self.dice, 60) {
                    finally.push((*cell, truth));
                }
            }
        }
        let without = &Frame { result: None, ..frame.clone() };
        let [made_without, unsettled_without] =
            [&action.makes, &action.unsettles].map(|all| self.domain.changed(all, without, &self.state));
        let touches: Vec<usize> = made.iter().chain(&unsettled).map(|(cell, _)| *cell).collect();
        let begun = made_without.iter().chain(&unsettled_without).map(|(cell, _)| *cell);
        let unfinished: Vec<usize> = begun.filter(|cell| touches.contains(cell)).collect();
        let mut flips = Vec::new();
        if self.mood != Mood::Honest && chance(&mut self.dice, 40) {
            // Meanwhile anything may be so of what it changes.
            for cell in &unfinished {
                let (at, truth) = (self.between(ends), chance(&mut self.dice, 50));
                flips.push((at, *cell, truth));
            }
            flips.sort_by_key(|(at, ..)| *at);
        }
        flips.extend(finally.into_iter().map(|(cell, truth)| (ends, cell, truth)));
        let makes: Vec<usize> = made.iter().filter(|_| succeeds).map(|(cell, _)| *cell).collect();
        let of = action.is_stale_by.iter().filter_map(|arg| frame.value(*arg)).collect();
        let lifetime = Lifetime { of_base: action.is_stale_by_base, of };
        let is_lasting = lifetime.of_base || !lifetime.of.is_empty();
        let lasting = makes.iter().filter(|_| is_lasting);
        let lasting = lasting.map(|cell| Lasting { cell: *cell, lifetime: lifetime.clone() }).collect();
        let stirs = self.stirs(action, without);
        Running { id, touches, unfinished, makes, lasting, stirs, flips, ends, outcome, held: None }
    }

    /// Use of the base by an action, and the entities that it moves.
    fn stirs(&self, action: &Action, frame: &Frame) -> Lifetime {
        let is_action = action.finds.is_none() && !action.finds_all;
        let entries = [&action.makes, &action.unsettles].into_iter().filter(|_| is_action);
        let of = entries.flat_map(|entries| self.domain.moved(entries, frame, &self.state)).collect();
        Lifetime { of_base: action.uses == Some(BASE), of }
    }

    /// Takes a goal off those that run. Nothing is known any more of what it touched.
    fn stop(&mut self, place: usize) -> Running {
        let goal = self.running.remove(place);
        self.made_with.retain(|cell, _| !goal.touches.contains(cell));
        self.lasting.retain(|lasting| !goal.touches.contains(&lasting.cell));
        self.outdate(&goal.stirs);
        goal
    }

    /// Lets anything be so of what lasts only until what stirs now.
    fn outdate(&mut self, stirs: &Lifetime) {
        let over = |lasting: &mut Lasting| lasting.lifetime.meets(stirs);
        for Lasting { cell, .. } in self.lasting.extract_if(.., over).collect::<Vec<_>>() {
            if chance(&mut self.dice, 50) {
                let truth = chance(&mut self.dice, 50);
                self.flip(cell, truth);
            }
        }
    }

    /// Lets what a hand holds drop: nothing that the step which took it has made need be so any more.
    fn drop_held(&mut self, query: &Query) {
        let Query::Fact { fluent, .. } = query else { return };
        let is_open = self.mood == Mood::Adversarial && self.is_tested && self.running.is_empty();
        if !is_open || fluent != HOLDING || !chance(&mut self.dice, 50) {
            return;
        }
        let holding = self.domain.fluent(HOLDING);
        let held = holding.map_or_else(Vec::new, |holding| self.domain.cells(holding, &[None]));
        for cell in self.asked(query).unwrap_or_default() {
            if self.state.get(cell) == Some(&true) && chance(&mut self.dice, 70) {
                for other in self.made_with.remove(&cell).unwrap_or_default() {
                    // Nothing is taken up by itself.
                    let truth = !held.contains(&other) && chance(&mut self.dice, 50);
                    self.flip(other, truth);
                }
                self.flip(cell, false);
            }
        }
    }

    /// Interrupts a goal: what it would have changed may have changed.
    fn interrupt(&mut self, id: GoalId, event: DriverEvent) {
        let Some(place) = self.running.iter().position(|goal| goal.id == id) else { return };
        let at = self.late();
        let now = self.now;
        let Some(goal) = self.running.get_mut(place) else { return };
        goal.held = None;
        if goal.ends <= now {
            // It is done, and only its end is not told yet.
            return;
        }
        if self.mood != Mood::Honest && goal.ends != Time::NEVER && chance(&mut self.dice, 20) {
            // It was done already.
            let shift = at;
            goal.flips.iter_mut().for_each(|(time, ..)| *time = shift);
            goal.ends = shift;
            return;
        }
        let goal = self.stop(place);
        self.unheard.push((id, goal.touches));
        for cell in goal.unfinished {
            if chance(&mut self.dice, 50) {
                let truth = chance(&mut self.dice, 50);
                self.flip(cell, truth);
            }
        }
        self.say(at, event);
    }

    /// Time of what happens next in the world.
    fn next(&self) -> Time {
        let goals = self.running.iter().filter(|goal| goal.held.is_none());
        let goals = goals.map(|goal| goal.flips.first().map_or(goal.ends, |(at, ..)| (*at).min(goal.ends)));
        goals.chain([self.next_whim]).min().unwrap_or(Time::NEVER)
    }

    /// Lets happen what happens next.
    fn happen(&mut self) {
        if self.next_whim <= self.now {
            return self.whim();
        }
        let now = self.now;
        let is_due = |goal: &Running| {
            goal.held.is_none() && (goal.ends <= now || goal.flips.first().is_some_and(|(at, ..)| *at <= now))
        };
        let Some(place) = self.running.iter().position(is_due) else { return };
        let Some(goal) = self.running.get_mut(place) else { return };
        if let Some((at, cell, truth)) = goal.flips.first().copied()
            && at <= now
        {
            goal.flips.remove(0);
            return self.flip(cell, truth);
        }
        let goal = self.stop(place);
        if let Outcome::Success(Some(found)) = &goal.outcome {
            let found = if let Value::List(items) = found { items } else { std::slice::from_ref(found) };
            let found = self.frame(found.iter().cloned()).params;
            self.unheard_of.retain(|one| !found.contains(one));
        }
        self.lasting.extend(goal.lasting);
        let beside: Vec<Lifetime> = self.running.iter().map(|other| other.stirs.clone()).collect();
        beside.iter().for_each(|stirs| self.outdate(stirs));
        self.made_with.extend(goal.makes.iter().map(|cell| (*cell, goal.makes.clone())));
        self.unheard.push((goal.id, goal.touches));
        self.say(now, DriverEvent::Ended { goal: goal.id, outcome: goal.outcome });
    }

    /// The end that an action will have.
    fn outcome(&mut self, action: &Action, frame: &mut Frame) -> Outcome {
        if !action.fails.is_empty() && chance(&mut self.dice, 30) {
            let kind = one_of(&mut self.dice, &action.fails).unwrap_or("failed");
            return Outcome::Failure(kind.into());
        }
        let choices: Vec<usize> = self.domain.of_kind(action.finds.unwrap_or(Kind::Object)).collect();
        let domain = self.domain;
        let value = |one: usize| {
            domain.entities.get(one).map(|(name, kind)| match kind {
                Kind::Mode => Value::Case(name.as_str().into()),
                _ => Value::Entity(name.as_str().into()),
            })
        };
        if action.finds_all {
            let count = self.dice.random_range(0..3);
            let found = (0..count).filter_map(|_| one_of(&mut self.dice, &choices).and_then(value));
            return Outcome::Success(Some(Value::List(found.collect())));
        }
        frame.result = one_of(&mut self.dice, &choices).filter(|_| action.finds.is_some());
        Outcome::Success(frame.result.and_then(value))
    }
}

fn put(state: &mut State, cell: usize, truth: bool) {
    if let Some(slot) = state.get_mut(cell) {
        *slot = truth;
    }
}

impl Driver for World<'_> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.now = now;
        let Some((action, mut frame)) = self.called(command) else {
            // A primitive of the standard library that changes nothing.
            let chosen = match command.arg("among") {
                Some(Value::List(items)) => items.get(self.dice.random_range(0..items.len().max(1))).cloned(),
                Some(_) | None => None,
            };
            self.say(now, DriverEvent::Acknowledged { goal });
            let ends = now.after(Time::from_secs(0.5));
            let outcome = Outcome::Success(chosen);
            let [touches, unfinished, makes] = [const { Vec::new() }; 3];
            self.running.push(Running {
                id: goal,
                touches,
                unfinished,
                makes,
                lasting: Vec::new(),
                stirs: Lifetime::default(),
                flips: Vec::new(),
                ends,
                outcome,
                held: None,
            });
            return;
        };
        if self.mood != Mood::Honest && chance(&mut self.dice, 3) {
            return self.say(now, DriverEvent::Refused { goal, failure: "blocked".into() });
        }
        self.say(now, DriverEvent::Acknowledged { goal });
        // The conditions of effects are those before the step.
        let outcome = self.outcome(action, &mut frame);
        let mut running = self.plan(goal, action, &frame, outcome);
        self.outdate(&running.stirs);
        if self.mood != Mood::Honest && chance(&mut self.dice, 4) {
            running.ends = Time::NEVER;
            let until = now.after(Time::from_secs(3.0));
            running.flips.retain(|(at, cell, _)| *at < until && running.unfinished.contains(cell));
        }
        self.running.push(running);
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.now = now;
        self.interrupt(goal, DriverEvent::Ended { goal, outcome: Outcome::Interrupted });
    }

    fn capabilities(&self) -> Capabilities {
        let none = PrimitiveSet::Only(std::collections::BTreeSet::new());
        Capabilities { hold: if self.holds { PrimitiveSet::All } else { none }, ..Capabilities::default() }
    }

    fn update(&mut self, now: Time, _goal: GoalId, _command: &Command) {
        self.now = now;
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        self.now = now;
        if let Some(goal) = self.running.iter_mut().find(|running| running.id == goal) {
            goal.held = Some(now);
        }
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        self.now = now;
        let goal = self.running.iter_mut().find(|running| running.id == goal);
        if let Some((goal, since)) = goal.and_then(|goal| goal.held.take().map(|since| (goal, since))) {
            let by = now.since(since);
            goal.flips.iter_mut().for_each(|(at, ..)| *at = at.after(by));
            goal.ends = goal.ends.after(by);
        }
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.now = now;
        self.interrupt(goal, DriverEvent::Stopped { goal });
    }

    fn observe(&mut self, now: Time, query: &Query) {
        self.now = now;
        self.drop_held(query);
        let mut answer = self.answer(query);
        if self.mood == Mood::Veiled && !self.domain.is_closed && chance(&mut self.dice, 10) {
            answer = Answer::Unknown;
        }
        // No answer is overtaken by a report of what is watched, or by a later answer to the same question.
        self.observed(query, &answer);
        let is_prompt = self.answers_at_once || self.is_watched(query);
        let at = if is_prompt { now } else { self.late() };
        let is_same =
            |event: &DriverEvent| matches!(event, DriverEvent::Observed { query: of, .. } if of == query);
        let before = self.outbox.iter().rfind(|(_, event)| is_same(event)).map_or(at, |(at, _)| *at);
        let at = at.max(before);
        self.say(at, DriverEvent::Observed { query: query.clone(), answer });
    }

    fn watch(&mut self, now: Time, query: &Query) {
        self.now = now;
        let answer = self.answer(query);
        self.observed(query, &answer);
        self.watches.push((query.clone(), answer.clone()));
        self.say(now, DriverEvent::Observed { query: query.clone(), answer });
    }

    fn unwatch(&mut self, now: Time, query: &Query) {
        self.now = now;
        self.watches.retain(|(watched, _)| watched != query);
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        loop {
            let (said, next) = (self.outbox.front().map_or(Time::NEVER, |(at, _)| *at), self.next());
            if said <= next && said <= until && said != Time::NEVER {
                self.now = self.now.max(said);
                return self.outbox.pop_front();
            }
            if next > until || next == Time::NEVER {
                self.now = if until == Time::NEVER { self.now } else { self.now.max(until) };
                return None;
            }
            self.now = self.now.max(next);
            self.happen();
        }
    }
}
