//! Smaller policies and domains with the same mistake.

use super::contract::{Action, Domain};
use super::policy::{Called, Handler, Policy, Reaction, Rule, Step};
use super::trial::{Bench, Checked, Finding, Mistake, Needs, SeededFault};

/// Greatest number of candidates that are tried.
const MAX_CANDIDATES: usize = 1500;

/// Policy with a mistake, as small as it was made.
#[derive(Clone, Debug)]
pub(super) struct Reduced {
    pub(super) domain: Domain,
    pub(super) policy: Policy,
    pub(super) finding: Finding,
    /// Seed of a run that shows it.
    pub(super) seed: u64,
    /// What happens in it, line by line.
    pub(super) trace: Vec<String>,
}

/// Makes a policy with a mistake smaller, as long as some of the runs with these seeds still show it.
#[must_use]
pub(super) fn shrink(
    domain: &Domain,
    policy: &Policy,
    (mistake, seeds, fault): (Mistake, &[u64], Option<SeededFault>),
) -> Option<Reduced> {
    let shows = |domain: &Domain, policy: &Policy| shows(domain, policy, mistake, (seeds, fault));
    let mut best = shows(domain, policy)?;
    let mut tried = 0;
    loop {
        let smaller = policies(&best.policy)
            .into_iter()
            .map(|policy| (best.domain.clone(), policy))
            .chain(domains(&best.domain).into_iter().map(|domain| (domain, best.policy.clone())));
        let mut found = None;
        for (domain, policy) in smaller {
            tried += 1;
            if tried > MAX_CANDIDATES {
                return Some(best);
            }
            found = shows(&domain, &policy);
            if found.is_some() {
                break;
            }
        }
        match found {
            Some(smaller) => best = smaller,
            None => return Some(best),
        }
    }
}

fn shows(
    domain: &Domain,
    policy: &Policy,
    mistake: Mistake,
    (seeds, fault): (&[u64], Option<SeededFault>),
) -> Option<Reduced> {
    let bench = Bench::new(domain, true, fault).ok()?;
    let Checked::Accepted(graph) = bench.check(policy) else { return None };
    seeds.iter().find_map(|seed| {
        let mut findings = bench.run(&graph, *seed, Needs::Compiled).into_iter();
        let finding = findings.find(|finding| finding.mistake == mistake)?;
        let (domain, policy) = (domain.clone(), policy.clone());
        Some(Reduced { domain, policy, finding, seed: *seed, trace: bench.trace(&graph, *seed) })
    })
}

/// Policies that are smaller by one thing, those without most of it first.
fn policies(policy: &Policy) -> Vec<Policy> {
    let mut all: Vec<Policy> =
        blocks(&policy.body).into_iter().map(|body| Policy { body, ..policy.clone() }).collect();
    all.extend(blocks(&policy.cleanup).into_iter().map(|cleanup| Policy { cleanup, ..policy.clone() }));
    if policy.goal.is_some() {
        all.push(Policy { goal: None, ..policy.clone() });
    }
    all.extend(blocks(&policy.later).into_iter().map(|later| Policy { later, ..policy.clone() }));
    for index in 0..policy.called.len() {
        let steps = policy.called.get(index).map(|called| blocks(&called.body)).unwrap_or_default();
        for steps in steps {
            let mut smaller = policy.clone();
            if let Some(Called { body, .. }) = smaller.called.get_mut(index) {
                *body = steps;
            }
            all.push(smaller);
        }
    }
    all
}

/// Blocks that are smaller by one thing.
fn blocks(steps: &[Step]) -> Vec<Vec<Step>> {
    let mut all = Vec::new();
    for (index, step) in steps.iter().enumerate() {
        let with = |instead: Vec<Step>| {
            let (before, behind) = (steps.iter().take(index), steps.iter().skip(index + 1));
            before.cloned().chain(instead).chain(behind.cloned()).collect::<Vec<Step>>()
        };
        all.push(with(Vec::new()));
        all.extend(step.blocks().into_iter().map(|block| with(block.clone())));
        all.extend(simpler(step).into_iter().map(|step| with(vec![step])));
        for (at, block) in step.blocks().into_iter().enumerate() {
            for smaller in blocks(block) {
                let mut step = step.clone();
                if let Some(slot) = step.blocks_mut().into_iter().nth(at) {
                    *slot = smaller;
                }
                all.push(with(vec![step]));
            }
        }
    }
    all
}

/// The same step with less of its own.
fn simpler(step: &Step) -> Vec<Step> {
    match step {
        Step::Call { retry, manner, is_bounded, .. } => {
            let with = |less: (u32, &'static str, bool)| {
                let mut call = step.clone();
                if let Step::Call { retry, manner, is_bounded, .. } = &mut call {
                    (*retry, *manner, *is_bounded) = less;
                }
                call
            };
            let all = [
                (*retry > 0).then(|| with((retry - 1, *manner, *is_bounded))),
                (!manner.is_empty()).then(|| with((*retry, "", *is_bounded))),
                is_bounded.then(|| with((*retry, *manner, false))),
            ];
            all.into_iter().flatten().collect()
        }
        Step::If(test, then, otherwise) if !otherwise.is_empty() => {
            vec![Step::If(test.clone(), then.clone(), Vec::new())]
        }
        Step::Try(body, handlers) => {
            let without = |index: usize| {
                let others = handlers.iter().enumerate().filter(|(at, _)| *at != index);
                Step::Try(body.clone(), others.map(|(_, handler)| handler.clone()).collect())
            };
            let nameless = |index: usize| {
                let mut handlers = handlers.clone();
                handlers.get_mut(index).into_iter().for_each(|handler| handler.name = None);
                Step::Try(body.clone(), handlers)
            };
            let named = handlers.iter().zip(0..).filter(|(Handler { name, .. }, _)| name.is_some());
            let named = named.map(|(_, index)| nameless(index));
            (0..handlers.len()).filter(|_| handlers.len() > 1).map(without).chain(named).collect()
        }
        Step::Repeat(times, body, until) => {
            let mut all = Vec::new();
            if *times > 1 {
                all.push(Step::Repeat(times - 1, body.clone(), until.clone()));
            }
            if until.is_some() {
                all.push(Step::Repeat(*times, body.clone(), None));
            }
            all
        }
        Step::Monitor(rules, body) => {
            let mut all = Vec::new();
            for (index, rule) in rules.iter().enumerate() {
                let with = |instead: Option<Rule>| {
                    let (before, behind) = (rules.iter().take(index), rules.iter().skip(index + 1));
                    let rules = before.cloned().chain(instead).chain(behind.cloned());
                    Step::Monitor(rules.collect(), body.clone())
                };
                if rules.len() > 1 {
                    all.push(with(None));
                }
                if rule.for_secs > 0 {
                    all.push(with(Some(Rule { for_secs: 0, ..rule.clone() })));
                }
                if let Reaction::Resume(count, steps) = &rule.reaction
                    && *count > 1
                {
                    let reaction = Reaction::Resume(count - 1, steps.clone());
                    all.push(with(Some(Rule { reaction, ..rule.clone() })));
                }
            }
            all
        }
        _ => Vec::new(),
    }
}

/// Domains that are smaller by one thing; what a policy names stays.
fn domains(domain: &Domain) -> Vec<Domain> {
    let mut all = Vec::new();
    for index in 0..domain.start.len() {
        let mut smaller = domain.clone();
        smaller.start.remove(index);
        all.push(smaller);
    }
    if domain.is_closed {
        all.push(Domain { is_closed: false, ..domain.clone() });
    }
    let mut with = |index: usize, change: &dyn Fn(&mut Action)| {
        let mut smaller = domain.clone();
        if let Some(action) = smaller.actions.get_mut(index) {
            change(action);
            all.push(smaller);
        }
    };
    for (index, action) in domain.actions.iter().enumerate() {
        for at in 0..action.needs.len() {
            with(index, &|action| drop(action.needs.remove(at)));
            with(index, &|action| action.needs.get_mut(at).into_iter().for_each(|need| need.when = None));
        }
        for at in 0..action.makes.len() {
            with(index, &|action| drop(action.makes.remove(at)));
        }
        for at in 0..action.unsettles.len() {
            with(index, &|action| drop(action.unsettles.remove(at)));
        }
        if !action.fails.is_empty() {
            with(index, &|action| action.fails.clear());
        }
        if !action.is_stale_by.is_empty() {
            with(index, &|action| action.is_stale_by.clear());
        }
        if action.uses.is_some() {
            with(index, &|action| action.uses = None);
        }
        for (at, change) in action.makes.iter().enumerate() {
            if change.when.is_some() {
                with(index, &|action| action.makes.get_mut(at).into_iter().for_each(|it| it.when = None));
            }
        }
    }
    all
}
