//! Every path of a policy, one state at a time.

use std::collections::{BTreeMap, BTreeSet};

use super::make::{Domain, Kind, Literal, Policy, Step};
use super::state::State;

/// Findings on the paths of a policy.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Found {
    /// On some path a need was false where its step started.
    pub violated: bool,
    /// On some path a need was unobserved where its step started.
    pub unobserved: bool,
    /// On some path a need was false where its step started, beside another branch: whether that branch made
    /// it so is left to a guard.
    pub contended: bool,
    /// There were too many states to walk them all.
    pub gave_up: bool,
}

type States = BTreeSet<State>;

/// Largest number of states of a block.
const MAX_STATES: usize = 4000;

/// Walks all paths of a policy from the start of its domain.
#[must_use]
pub fn walk(domain: &Domain, policy: &Policy) -> Found {
    let (reactions, escaped, ended) = (Vec::new(), Vec::new(), Vec::new());
    let mut walker = Walker { domain, found: Found::default(), reactions, escaped, ended };
    walker.block(policy, States::from([State::start(domain)]), &mut BTreeMap::new());
    walker.found
}

/// Meaning of a need that is false.
#[derive(Clone, Copy)]
enum Refusal {
    /// The policy is wrong, and the path ends there.
    Violation,
    /// The step was tried before: its guard refuses.
    Guard,
    /// Another branch may have made it so: the guard refuses.
    Contention,
}

struct Walker<'a> {
    domain: &'a Domain,
    found: Found,
    /// Blocks that may run before any step.
    reactions: Vec<&'a [Step]>,
    /// Failures in each of them.
    escaped: Vec<Failed>,
    /// For each group with a cleanup around here, the states in which the policy ends inside it.
    ended: Vec<States>,
}

/// States in which a block fails, by kind.
type Failed = BTreeMap<Kind, States>;

fn merge(failed: &mut Failed, more: Failed) {
    for (kind, states) in more {
        failed.entry(kind).or_default().extend(states);
    }
}

impl<'a> Walker<'a> {
    /// The states in which a block comes to its end.
    fn block(&mut self, block: &'a [Step], mut states: States, failed: &mut Failed) -> States {
        for step in block {
            states = self.disturbed(states);
            states = self.step(step, states, failed);
            if states.len() > MAX_STATES {
                self.found.gave_up = true;
                return States::new();
            }
        }
        self.disturbed(states)
    }

    /// With what the reactions of enclosing monitors may have done meanwhile, each as often as it still may.
    fn disturbed(&mut self, mut states: States) -> States {
        let reactions = std::mem::take(&mut self.reactions);
        for (level, reaction) in reactions.iter().enumerate() {
            // While it runs only the monitors around its own watch.
            self.reactions = reactions.get(..level).unwrap_or_default().to_vec();
            let mut fired = states.clone();
            while !fired.is_empty() && states.len() <= MAX_STATES {
                let able = fired.into_iter().filter_map(|mut state| {
                    let left = state.left.get_mut(level).filter(|left| **left > 0)?;
                    *left -= 1;
                    Some(state)
                });
                let able = able.collect();
                let mut failed = Failed::new();
                fired = self.block(reaction, able, &mut failed);
                // What fails in a reaction fails outside of its body.
                if let Some(escaped) = self.escaped.get_mut(level) {
                    merge(escaped, failed);
                }
                fired.retain(|state| !states.contains(state));
                states.extend(fired.iter().cloned());
            }
        }
        self.reactions = reactions;
        states
    }

    fn resume(
        &mut self,
        body: &'a [Step],
        at_most: usize,
        reaction: &'a [Step],
        states: States,
        failed: &mut Failed,
    ) -> States {
        let entered = states.into_iter().map(|mut state| {
            state.left.push(at_most);
            state
        });
        let entered = entered.collect();
        let mut inside = Failed::new();
        let level = self.reactions.len();
        self.reactions.push(reaction);
        self.escaped.push(Failed::new());
        let states = self.block(body, entered, &mut inside);
        self.reactions.pop();
        merge(&mut inside, self.escaped.pop().unwrap_or_default());
        let left = |states: States| -> States {
            let states = states.into_iter().map(|mut state| {
                state.left.truncate(level);
                state
            });
            states.collect()
        };
        merge(failed, inside.into_iter().map(|(kind, states)| (kind, left(states))).collect());
        left(states)
    }

    fn step(&mut self, step: &'a Step, states: States, failed: &mut Failed) -> States {
        match step {
            Step::Call { action, entity, retry } => self.call(*action, *entity, *retry, states, failed),
            Step::Sequence(body) => self.block(body, states, failed),
            Step::Finally(body, cleanup) => self.finally(body, cleanup, states, failed),
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
            Step::Resume(body, at_most, reaction) => self.resume(body, *at_most, reaction, states, failed),
            Step::Parallel(branches) => self.parallel(branches, states, failed),
            Step::End(_) => {
                self.ended.last_mut().into_iter().for_each(|ended| ended.extend(states.iter().cloned()));
                States::new()
            }
        }
    }

    /// A body, and its cleanup by whichever way control leaves the body.
    fn finally(
        &mut self,
        body: &'a [Step],
        cleanup: &'a [Step],
        states: States,
        failed: &mut Failed,
    ) -> States {
        self.ended.push(States::new());
        let mut inside = Failed::new();
        let after = self.block(body, states, &mut inside);
        let ended = self.ended.pop().unwrap_or_default();
        let ended = self.clean(cleanup, ended);
        self.ended.last_mut().into_iter().for_each(|outer| outer.extend(ended.iter().cloned()));
        for (kind, states) in inside {
            let cleaned = self.clean(cleanup, states);
            failed.entry(kind).or_default().extend(cleaned);
        }
        self.clean(cleanup, after)
    }

    /// The states behind a cleanup, whose failures change nothing.
    fn clean(&mut self, cleanup: &'a [Step], states: States) -> States {
        let mut failures = Failed::new();
        let mut after = self.block(cleanup, states, &mut failures);
        after.extend(failures.into_values().flatten());
        after
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
                let first = if attempt > 0 { Refusal::Guard } else { Refusal::Violation };
                after.extend(self.attempt(action, entity, first, state, &mut failures));
            }
            states = failures.values().flatten().cloned().collect();
            if attempt == retry {
                merge(failed, failures);
            }
        }
        after
    }

    /// One attempt at an action in one state.
    fn attempt(
        &mut self,
        action: usize,
        entity: usize,
        refusal: Refusal,
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
                Some(false) => match refusal {
                    Refusal::Guard => refused = true,
                    Refusal::Contention => {
                        self.found.contended = true;
                        refused = true;
                    }
                    Refusal::Violation => {
                        self.found.violated = true;
                        return None;
                    }
                },
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
                if let Some(next) = self.attempt(*action, *entity, Refusal::Contention, &state, failed) {
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
