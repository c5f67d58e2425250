//! Random steps of a policy over a made-up domain, the same for the same seed.

use rand::RngExt as _;
use rand_xoshiro::SplitMix64;

use super::contract::{Arg, Change, Condition, Domain, Kind, Length};
use super::make::{BASE, FAILURES, Terms, chance, condition, entities, one_of};
use super::policy::{Among, Called, ENDS, Handler, MANNERS, Policy, Reaction, Rule, Step};

/// Kinds of failure that handlers name; none stands for any.
const CAUGHT: [&[&str]; 5] =
    [&["slipped"], &["blocked", "timeout"], &["failed", "slipped"], &["exhausted"], &[]];

/// Names in scope.
#[derive(Clone, Default)]
struct Names {
    /// Names of entities and cases, with their kinds.
    things: Vec<(usize, Kind)>,
    /// Names of lists of objects.
    lists: Vec<usize>,
    /// Names of lengths of lists.
    lengths: Vec<usize>,
    /// Names of failures.
    failures: Vec<usize>,
}

/// Maker of a policy.
struct Maker<'a> {
    dice: &'a mut SplitMix64,
    domain: &'a Domain,
    names: Names,
    made: usize,
    /// By policy that may be called, whether it gives an object.
    called: Vec<bool>,
    /// True in a policy that gives an object.
    gives: bool,
    /// True in a cleanup, which no ending leaves.
    cleans_up: bool,
}

/// A policy of few steps over a domain.
#[must_use]
pub(super) fn policy(dice: &mut SplitMix64, domain: &Domain) -> Policy {
    let names = Names::default();
    let called = Vec::new();
    let mut maker = Maker { dice, domain, names, made: 0, called, gives: false, cleans_up: false };
    let mut called = Vec::new();
    for percent in [20, 30] {
        if !chance(maker.dice, percent) {
            break;
        }
        called.push(maker.called());
    }
    let length = 1 + maker.dice.random_range(0..5);
    let body = maker.block(length, 3);
    let cleanup = if chance(maker.dice, 8) { maker.cleanup() } else { Vec::new() };
    let goal = chance(maker.dice, 40).then(|| maker.goal(&body));
    let later = if chance(maker.dice, 12) { maker.block(2, 2) } else { Vec::new() };
    Policy { body, cleanup, goal, called, later }
}

impl Maker<'_> {
    fn name(&mut self) -> usize {
        self.made += 1;
        self.made - 1
    }

    /// Steps, whose names end with them.
    fn block(&mut self, length: usize, depth: u32) -> Vec<Step> {
        let names = self.names.clone();
        let steps = self.open(length, depth);
        self.names = names;
        steps
    }

    /// Steps, whose names stay.
    fn open(&mut self, length: usize, depth: u32) -> Vec<Step> {
        (0..length).map(|_| self.step(depth)).collect()
    }

    fn inner(&mut self, depth: u32) -> Vec<Step> {
        let length = 1 + self.dice.random_range(0..3);
        self.block(length, depth.saturating_sub(1))
    }

    fn inner_open(&mut self, depth: u32) -> Vec<Step> {
        let length = 1 + self.dice.random_range(0..3);
        self.open(length, depth.saturating_sub(1))
    }

    /// Steps without a cleanup, an ending or a monitor of much depth: calls, or blocks of calls.
    fn shallow(&mut self) -> Vec<Step> {
        let depth = if chance(self.dice, 40) { 2 } else { 1 };
        self.inner(depth)
    }

    fn cleanup(&mut self) -> Vec<Step> {
        let before = std::mem::replace(&mut self.cleans_up, true);
        let steps = self.shallow();
        self.cleans_up = before;
        steps
    }

    /// A policy for others to call.
    fn called(&mut self) -> Called {
        let (param, gives) = (self.name(), chance(self.dice, 40));
        let depth = if chance(self.dice, 30) { 2 } else { 1 };
        self.names.things.push((param, Kind::Object));
        self.gives = gives;
        let mut body = self.open(2, depth);
        if gives {
            body.push(Step::Give(self.object()));
        }
        self.gives = false;
        self.names = Names::default();
        self.called.push(gives);
        Called { param, body, gives }
    }

    /// What the last call makes, or anything.
    fn goal(&mut self, body: &[Step]) -> Condition {
        let domain = self.domain;
        let last = body.iter().rev().find_map(|step| match step {
            Step::Call { action, args, .. } => Some((domain.actions.get(*action)?, args)),
            _ => None,
        });
        let made = last.filter(|_| chance(self.dice, 65)).and_then(|(action, args)| {
            let made: Vec<Condition> = action.makes.iter().filter_map(|change| made(change, args)).collect();
            made.get(self.dice.random_range(0..made.len().max(1))).cloned()
        });
        let terms = entities(domain);
        match made {
            Some(made) if chance(self.dice, 30) => {
                Condition::All(vec![made, condition(self.dice, domain, &terms, 1)])
            }
            Some(made) => made,
            None => condition(self.dice, domain, &terms, 1),
        }
    }

    fn terms(&self) -> Terms {
        let terms = entities(self.domain);
        self.names.things.iter().fold(terms, |terms, (name, kind)| terms.with(Arg::Name(*name), *kind))
    }

    /// A condition that may change by itself.
    fn watched(&mut self) -> Condition {
        let terms = self.terms();
        condition(self.dice, self.domain, &terms, 1)
    }

    /// A condition that is tested once.
    fn test(&mut self) -> Condition {
        let choice = self.dice.random_range(0..100);
        let test = match choice {
            0..40 if !self.names.failures.is_empty() => {
                let kinds = [FAILURES[0], FAILURES[1], "timeout", "failed", "exhausted"];
                let failure = one_of(self.dice, &self.names.failures).unwrap_or_default();
                Condition::Kind(failure, one_of(self.dice, &kinds).unwrap_or_default())
            }
            40..50 if !self.names.lists.is_empty() => {
                Condition::Empty(one_of(self.dice, &self.names.lists).unwrap_or_default())
            }
            50..58 if !self.names.lists.is_empty() => {
                let of = Length::Of(one_of(self.dice, &self.names.lists).unwrap_or_default());
                let named = one_of(self.dice, &self.names.lengths).map(Length::Named);
                let length = named.filter(|_| chance(self.dice, 40)).unwrap_or(of);
                let op = one_of(self.dice, &["==", "!=", "<", "<=", ">", ">="]).unwrap_or_default();
                Condition::Length(length, op, self.dice.random_range(0..3))
            }
            58..72 if !self.names.things.is_empty() => {
                let (name, kind) = one_of(self.dice, &self.names.things).unwrap_or((0, Kind::Object));
                Condition::Same(Arg::Name(name), self.of_kind(kind))
            }
            _ => return self.watched(),
        };
        if chance(self.dice, 35) { Condition::Not(Box::new(test)) } else { test }
    }

    /// One of [`ENDS`]; a policy with a result is not done without it.
    fn end(&mut self) -> &'static str {
        let ends = if self.gives { &ENDS[1..] } else { &ENDS[..] };
        one_of(self.dice, ends).unwrap_or_default()
    }

    /// Some objects that the domain declares, and perhaps names.
    fn objects(&mut self) -> Vec<Arg> {
        let terms = if chance(self.dice, 30) { self.terms() } else { entities(self.domain) };
        let mut all = terms.of_kind(Kind::Object);
        all.dedup();
        let some: Vec<Arg> = all.iter().copied().filter(|_| chance(self.dice, 60)).collect();
        if some.is_empty() { all } else { some }
    }

    /// An entity, a case or a name, of a kind.
    fn of_kind(&mut self, kind: Kind) -> Arg {
        if kind == Kind::Object && chance(self.dice, 15) && !self.names.lists.is_empty() {
            return Arg::First(one_of(self.dice, &self.names.lists).unwrap_or_default());
        }
        one_of(self.dice, &self.terms().of_kind(kind)).unwrap_or(Arg::Entity(0))
    }

    /// An entity or a name, of an object.
    fn object(&mut self) -> Arg {
        self.of_kind(Kind::Object)
    }

    fn call(&mut self) -> Step {
        let action = self.dice.random_range(0..self.domain.actions.len());
        let Some(def) = self.domain.actions.get(action) else { return Step::Delay };
        let is_found = def.finds.is_some() || def.finds_all;
        let name = (is_found && chance(self.dice, 85)).then(|| self.name());
        let step = self.call_of(action, name);
        match def.finds {
            Some(kind) => self.names.things.extend(name.map(|name| (name, kind))),
            None => self.names.lists.extend(name),
        }
        step
    }

    fn call_of(&mut self, action: usize, name: Option<usize>) -> Step {
        let Some(def) = self.domain.actions.get(action) else { return Step::Delay };
        let args = def.params.iter().map(|kind| self.of_kind(*kind)).collect();
        let retry = if chance(self.dice, 12) { 1 + self.dice.random_range(0..2) } else { 0 };
        // Of the resources only this one moves the robot.
        let moves = def.uses == Some(BASE) && chance(self.dice, 15);
        let manner = one_of(self.dice, &MANNERS).filter(|_| moves).unwrap_or_default();
        Step::Call { action, args, name, retry, manner, is_bounded: chance(self.dice, 6) }
    }

    /// A step that gives a name to an object.
    fn bind(&mut self, name: usize) -> Step {
        let finders =
            (0..).zip(&self.domain.actions).filter(|(_, action)| action.finds == Some(Kind::Object));
        let finders: Vec<usize> = finders.map(|(index, _)| index).collect();
        match one_of(self.dice, &finders) {
            Some(finder) if chance(self.dice, 60) => self.call_of(finder, Some(name)),
            _ => Step::Let { name, value: self.plain(Kind::Object) },
        }
    }

    /// A name, or an entity or a case, of which the kind is this one itself.
    fn plain(&mut self, kind: Kind) -> Arg {
        let is_plain = |arg: &Arg| match arg {
            Arg::Entity(one) => self.domain.entities.get(*one).is_some_and(|(_, own)| *own == kind),
            Arg::Name(name) => self.names.things.contains(&(*name, kind)),
            _ => true,
        };
        let plain: Vec<Arg> = self.terms().of_kind(kind).into_iter().filter(is_plain).collect();
        one_of(self.dice, &plain).unwrap_or(Arg::Entity(0))
    }

    fn choice(&mut self, depth: u32) -> Step {
        let test = self.test();
        let mut then = self.inner(depth);
        let mut otherwise = if chance(self.dice, 60) { self.inner(depth) } else { Vec::new() };
        if !otherwise.is_empty() && chance(self.dice, 25) {
            let name = self.name();
            then.push(self.bind(name));
            otherwise.push(self.bind(name));
            self.names.things.push((name, Kind::Object));
        }
        Step::If(test, then, otherwise)
    }

    fn handled(&mut self, depth: u32) -> Step {
        let mut body = self.inner(depth);
        let chosen: Vec<_> = CAUGHT.into_iter().filter(|_| chance(self.dice, 30)).collect();
        let chosen = if chosen.is_empty() { vec![&[] as &[_]] } else { chosen };
        let handlers = chosen.into_iter().map(|kinds| {
            let name = chance(self.dice, 40).then(|| self.name());
            self.names.failures.extend(name);
            let mut steps = if chance(self.dice, 20) { Vec::new() } else { self.inner(depth) };
            if let Some(name) = name {
                if chance(self.dice, 20) {
                    steps.push(Step::Say(name));
                }
                self.names.failures.pop();
            }
            Handler { kinds: kinds.to_vec(), name, steps }
        });
        let mut handlers: Vec<Handler> = handlers.collect();
        if chance(self.dice, 20) {
            let name = self.name();
            body.push(self.bind(name));
            handlers.iter_mut().for_each(|handler| handler.steps.push(self.bind(name)));
            self.names.things.push((name, Kind::Object));
        }
        Step::Try(body, handlers)
    }

    fn monitor(&mut self, depth: u32) -> Step {
        let count = if chance(self.dice, 25) { 2 } else { 1 };
        let rules = (0..count).map(|_| {
            let for_secs = if chance(self.dice, 25) { 1 + self.dice.random_range(0..2) } else { 0 };
            let condition = self.watched();
            let reaction = match self.dice.random_range(0..10) {
                3..5 => Reaction::Restart(1 + self.dice.random_range(0..2)),
                5..9 => Reaction::Resume(1 + self.dice.random_range(0..2), self.shallow()),
                9 if !self.cleans_up => Reaction::End(self.end()),
                _ => Reaction::Pause,
            };
            Rule { condition, for_secs, reaction }
        });
        let rules = rules.collect();
        Step::Monitor(rules, self.inner_open(depth))
    }

    fn parallel(&mut self, depth: u32) -> Step {
        let before = self.names.clone();
        let mut after = before.clone();
        let count = if chance(self.dice, 25) { 3 } else { 2 };
        let branches = (0..count).map(|_| {
            let branch = self.inner_open(depth.min(2));
            let own = std::mem::replace(&mut self.names, before.clone());
            after.things.extend(own.things.into_iter().skip(before.things.len()));
            after.lists.extend(own.lists.into_iter().skip(before.lists.len()));
            after.lengths.extend(own.lengths.into_iter().skip(before.lengths.len()));
            branch
        });
        let branches = branches.collect();
        self.names = after;
        Step::Parallel(branches)
    }

    fn step(&mut self, depth: u32) -> Step {
        let choice = if depth == 0 { 0 } else { self.dice.random_range(0..103) };
        match choice {
            42..44 => {
                let Some(list) = one_of(self.dice, &self.names.lists) else { return self.call() };
                let name = self.name();
                if chance(self.dice, 30) {
                    self.names.lengths.push(name);
                    return Step::Count { list, name };
                }
                self.names.things.push((name, Kind::Object));
                Step::First { list, name }
            }
            44..48 => {
                let (among, name) = (self.objects(), self.name());
                if chance(self.dice, 30) {
                    self.names.lists.push(name);
                    return Step::List { of: among, name };
                }
                self.names.things.push((name, Kind::Object));
                Step::Choose { among, name }
            }
            48..58 => self.choice(depth),
            58..61 => Step::Wait(self.watched()),
            61..62 => Step::Delay,
            62..71 => self.handled(depth),
            71..75 => {
                let before = self.names.clone();
                let body = self.inner_open(depth);
                let after = std::mem::replace(&mut self.names, before);
                let cleanup = self.cleanup();
                self.names = after;
                Step::Finally(body, cleanup)
            }
            75..81 => {
                let (times, body) = (1 + self.dice.random_range(0..3), self.inner_open(depth));
                let until = chance(self.dice, 50).then(|| self.test());
                Step::Repeat(times, body, until)
            }
            81..85 => {
                let list = one_of(self.dice, &self.names.lists).filter(|_| chance(self.dice, 50));
                let among = list.map_or_else(|| Among::Written(self.objects()), Among::List);
                let name = self.name();
                self.names.things.push((name, Kind::Object));
                let body = self.inner(depth);
                self.names.things.retain(|(known, _)| *known != name);
                Step::Each { among, name, body }
            }
            85..91 => self.monitor(depth),
            91..92 => {
                let known = self.terms().of_kind(Kind::Entity);
                let of = one_of(self.dice, &known).unwrap_or(Arg::Entity(0));
                Step::Keep(of, self.inner_open(depth))
            }
            92..93 => Step::Within(self.inner_open(depth)),
            93..97 => self.parallel(depth),
            97..99 if !self.called.is_empty() && !self.cleans_up => {
                let index = self.dice.random_range(0..self.called.len());
                let arg = self.object();
                let gives = self.called.get(index).copied().unwrap_or_default();
                let name = (gives && chance(self.dice, 85)).then(|| self.name());
                self.names.things.extend(name.map(|name| (name, Kind::Object)));
                Step::Policy(index, arg, name)
            }
            99 if !self.cleans_up => {
                if self.gives && chance(self.dice, 25) {
                    return Step::Give(self.object());
                }
                Step::End(self.end())
            }
            100..103 => {
                let kinds: Vec<Kind> = self.names.things.iter().map(|(_, kind)| *kind).collect();
                let kind = one_of(self.dice, &kinds).unwrap_or(Kind::Object);
                let (value, name) = (self.plain(kind), self.name());
                self.names.things.push((name, kind));
                Step::Let { name, value }
            }
            _ => self.call(),
        }
    }
}

/// An effect of a call as a condition, where it names entities only.
fn made(change: &Change, args: &[Arg]) -> Option<Condition> {
    let mut atom = change.atom.clone();
    for arg in &mut atom.args {
        *arg = match *arg {
            Arg::Param(index) => args.get(index).copied()?,
            known => known,
        };
        if !matches!(arg, Arg::Entity(_) | Arg::Any) {
            return None;
        }
    }
    let is = Condition::Is(atom);
    change.each.is_none().then(|| if change.truth { is } else { Condition::Not(Box::new(is)) })
}
