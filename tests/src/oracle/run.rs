//! Every path of a policy, one state at a time.

use std::collections::{BTreeMap, BTreeSet};

use super::model::{Domain, Kind, Literal, Policy, Step};
use super::state::State;

/// What the paths of a policy met.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Found {
    /// On some path a need was false where its step started.
    pub violated: bool,
    /// On some path a need was unobserved where its step started.
    pub unobserved: bool,
    /// There were too many states to walk them all.
    pub gave_up: bool,
}

type States = BTreeSet<State>;

/// How many states a block may have.
const MAX_STATES: usize = 4000;

/// Walks all paths of a policy from the start of its domain.
#[must_use]
pub fn walk(domain: &Domain, policy: &Policy) -> Found {
    let mut walker = Walker { domain, found: Found::default(), reactions: Vec::new() };
    walker.block(policy, States::from([State::start(domain)]), &mut BTreeMap::new());
    walker.found
}

struct Walker<'a> {
    domain: &'a Domain,
    found: Found,
    /// Blocks that may run before any step, with how often they still may.
    reactions: Vec<&'a [Step]>,
}

/// States in which a block fails, by kind.
type Failed = BTreeMap<Kind, States>;

impl<'a> Walker<'a> {
    /// The states in which a block comes to its end.
    fn block(&mut self, block: &'a [Step], mut states: States, failed: &mut Failed) -> States {
        for step in block {
            states = self.disturbed(states, failed);
            states = self.step(step, states, failed);
            if states.len() > MAX_STATES {
                self.found.gave_up = true;
                return States::new();
            }
        }
        self.disturbed(states, failed)
    }

    /// With what the reactions of enclosing monitors may have done meanwhile.
    fn disturbed(&mut self, mut states: States, failed: &mut Failed) -> States {
        let reactions = std::mem::take(&mut self.reactions);
        for reaction in &reactions {
            let after = self.block(reaction, states.clone(), failed);
            states.extend(after);
        }
        self.reactions = reactions;
        states
    }

    fn step(&mut self, step: &'a Step, states: States, failed: &mut Failed) -> States {
        match step {
            Step::Call { action, entity, retry } => self.call(*action, *entity, *retry, states, failed),
            Step::Sequence(body) => self.block(body, states, failed),
            Step::If(test, then, otherwise) => {
                let (yes, no) = self.tested(test, &states);
                let mut after = self.block(then, yes, failed);
                after.extend(self.block(otherwise, no, failed));
                after
            }
            Step::Try(body, handlers) => {
                let mut caught = Failed::new();
                let mut after = self.block(body, states, &mut caught);
                for (kind, states) in caught {
                    let takes =
                        |on: &Option<Vec<Kind>>| on.as_ref().is_none_or(|kinds| kinds.contains(&kind));
                    match handlers.iter().find(|(on, _)| takes(on)) {
                        Some((_, handler)) => after.extend(self.block(handler, states, failed)),
                        None => failed.entry(kind).or_default().extend(states),
                    }
                }
                after
            }
            Step::Repeat(times, body, until) => self.repeat(*times, body, until.as_ref(), states, failed),
            Step::Resume(body, reaction) => {
                self.reactions.push(reaction);
                let states = self.block(body, states, failed);
                self.reactions.pop();
                states
            }
            Step::Parallel(branches) => self.parallel(branches, states, failed),
            Step::End(_) => States::new(),
        }
    }

    /// The states in which a test holds, and those in which it does not; what was unobserved is seen.
    fn tested(&self, test: &Literal, states: &States) -> (States, States) {
        let (mut yes, mut no) = (States::new(), States::new());
        for state in states {
            let value = state.value(self.domain, test, 0);
            if value != Some(false) {
                yes.insert(state.seen(self.domain, test, 0, true));
            }
            if value != Some(true) {
                no.insert(state.seen(self.domain, test, 0, false));
            }
        }
        (yes, no)
    }

    fn repeat(
        &mut self,
        times: usize,
        body: &'a [Step],
        until: Option<&Literal>,
        mut states: States,
        failed: &mut Failed,
    ) -> States {
        let mut after = States::new();
        for _ in 0..times {
            states = self.block(body, states, failed);
            if let Some(until) = until {
                let (yes, no) = self.tested(until, &states);
                after.extend(yes);
                states = no;
            }
        }
        if until.is_none() {
            return states;
        }
        failed.entry(Kind::Exhausted).or_default().extend(states);
        after
    }

    fn call(
        &mut self,
        action: usize,
        entity: usize,
        retry: usize,
        mut states: States,
        failed: &mut Failed,
    ) -> States {
        let mut after = States::new();
        for attempt in 0..=retry {
            let mut failures = Failed::new();
            for state in &states {
                after.extend(self.attempt(action, entity, attempt > 0, state, &mut failures));
            }
            states = failures.values().flatten().cloned().collect();
            if attempt == retry {
                for (kind, states) in failures {
                    failed.entry(kind).or_default().extend(states);
                }
            }
        }
        after
    }

    /// One attempt at an action in one state. A need that is false at the first attempt is a violation, and the path ends
    /// there; at a later one the guard refuses.
    fn attempt(
        &mut self,
        action: usize,
        entity: usize,
        again: bool,
        state: &State,
        failed: &mut Failed,
    ) -> Option<State> {
        let domain = self.domain;
        let action = domain.actions.get(action)?;
        let mut ready = state.clone();
        let (mut guarded, mut refused) = (false, false);
        for need in &action.needs {
            match ready.value(domain, need, entity) {
                Some(true) => {}
                Some(false) if again => refused = true,
                Some(false) => {
                    self.found.violated = true;
                    return None;
                }
                None => {
                    self.found.unobserved = true;
                    guarded = true;
                    ready = ready.seen(domain, need, entity, true);
                }
            }
        }
        let kinds = || action.fails.iter().copied().chain([Kind::Timeout]);
        if guarded || refused {
            for kind in kinds() {
                failed.entry(kind).or_default().insert(state.clone());
            }
        }
        if refused {
            self.found.unobserved = true;
            return None;
        }
        let unsettled = |mut state: State| {
            for atom in &action.unsettles {
                state.set(domain, atom, entity, None);
            }
            state
        };
        let broken = unsettled(ready.shaken(domain, &action.makes, entity));
        for kind in kinds() {
            failed.entry(kind).or_default().insert(broken.clone());
        }
        // What is made wins over what is unsettled; the conditions are those of the state before.
        Some(unsettled(ready.clone()).with_effects(domain, &ready, &action.makes, entity))
    }

    /// All interleavings of the calls of branches.
    fn parallel(&mut self, branches: &[Vec<(usize, usize)>], states: States, failed: &mut Failed) -> States {
        let mut after = States::new();
        let mut seen = BTreeSet::new();
        let mut open: Vec<(Vec<usize>, State)> =
            states.into_iter().map(|state| (vec![0; branches.len()], state)).collect();
        while let Some((at, state)) = open.pop() {
            if !seen.insert((at.clone(), state.clone())) {
                continue;
            }
            if seen.len() > MAX_STATES {
                self.found.gave_up = true;
                break;
            }
            let mut is_done = true;
            for (index, branch) in branches.iter().enumerate() {
                let Some((action, entity)) = at.get(index).and_then(|at| branch.get(*at)) else { continue };
                is_done = false;
                if let Some(next) = self.attempt(*action, *entity, false, &state, failed) {
                    let mut at = at.clone();
                    if let Some(place) = at.get_mut(index) {
                        *place += 1;
                    }
                    open.push((at, next));
                }
            }
            if is_done {
                after.insert(state);
            }
        }
        after
    }
}
