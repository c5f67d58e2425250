//! Random domains and policies, the same for the same seed. Domains are small, so that policies often meet
//! what they have changed.

use motet_stdlib::lang::fluents::HOLDING;
use rand::RngExt as _;
use rand_xoshiro::SplitMix64;

use super::contract::{Action, Arg, Atom, Change, Condition, Domain, Kind, Need};
use super::policy::{Among, ENDS, Policy, Reaction, Step, Watch};

/// Failures that actions declare.
pub(super) const FAILURES: [&str; 2] = ["slipped", "blocked"];
/// Resources of actions; one contains the other or they are apart, as the standard library says.
const RESOURCES: [&str; 3] = ["base", "voice", "camera"];

/// True `percent` times of a hundred.
pub(super) fn chance(dice: &mut SplitMix64, percent: u32) -> bool {
    dice.random_range(0..100) < percent
}

/// One of several, where there are any.
pub(super) fn one_of<T: Copy>(dice: &mut SplitMix64, from: &[T]) -> Option<T> {
    (!from.is_empty()).then(|| from.get(dice.random_range(0..from.len())).copied()).flatten()
}

/// A domain.
#[must_use]
pub(super) fn domain(dice: &mut SplitMix64) -> Domain {
    let mut domain = Domain { is_closed: chance(dice, 35), ..Domain::default() };
    for index in 0..2 + dice.random_range(0..2) {
        domain.entities.push((format!("e{index}"), Kind::Object));
    }
    for index in 0..dice.random_range(0..2) {
        domain.entities.push((format!("c{index}"), Kind::Container));
    }
    domain.declared = domain.entities.len();
    for (name, kind) in [("robot", Kind::Entity), ("user", Kind::Person), ("start", Kind::Place)] {
        domain.entities.push((name.to_owned(), kind));
    }
    domain.fluents = vec![vec![], vec![Kind::Object], vec![Kind::Object], vec![Kind::Entity]];
    domain.fluents.push(vec![Kind::Object, if chance(dice, 50) { Kind::Object } else { Kind::Entity }]);
    domain.names = (0..domain.fluents.len()).map(|index| format!("f{index}")).collect();
    if let Some(name) = domain.names.get_mut(2).filter(|_| chance(dice, 50)) {
        // What is held may drop.
        HOLDING.clone_into(name);
    }
    if chance(dice, 50) {
        domain.measure = Some(domain.fluents.len());
        domain.fluents.push(vec![Kind::Entity]);
        domain.names.push("distance".to_owned());
    }
    for index in 0..4 + dice.random_range(0..3) {
        let finds = index == 0 || chance(dice, 20);
        let action = Action { name: format!("a{index}"), ..action(dice, &domain, finds) };
        domain.actions.push(action);
    }
    let known = [100, 60, 25].get(dice.random_range(0..3)).copied().unwrap_or(60);
    for (fluent, params) in domain.fluents.clone().iter().enumerate() {
        if domain.measure == Some(fluent) {
            continue;
        }
        let mut all: Vec<Vec<Arg>> = vec![Vec::new()];
        for kind in params {
            let choices: Vec<usize> = domain.of_kind(*kind).filter(|one| *one < domain.declared).collect();
            let with = |args: &Vec<Arg>| {
                let args = args.clone();
                choices.clone().into_iter().map(move |one| [args.clone(), vec![Arg::Entity(one)]].concat())
            };
            all = all.iter().flat_map(with).collect();
        }
        for args in all {
            if chance(dice, known) {
                domain.start.push((Atom { fluent, args }, chance(dice, 50)));
            }
        }
    }
    domain
}

/// Arguments that may stand in some place.
#[derive(Clone, Default)]
struct Terms {
    /// Arguments with their kinds.
    known: Vec<(Arg, Kind)>,
    /// Percentage of `any`.
    any: u32,
}

impl Terms {
    fn with(&self, arg: Arg, kind: Kind) -> Self {
        let mut terms = self.clone();
        // Twice, so that it is often taken.
        terms.known.extend([(arg, kind), (arg, kind)]);
        terms
    }

    fn of_kind(&self, kind: Kind) -> Vec<Arg> {
        self.known.iter().filter(|(_, own)| own.is(kind)).map(|(arg, _)| *arg).collect()
    }
}

fn entities(domain: &Domain) -> Terms {
    let declared = (0..).zip(&domain.entities).take(domain.declared);
    Terms { known: declared.map(|(index, (_, kind))| (Arg::Entity(index), *kind)).collect(), any: 12 }
}

/// A fact, or a reading of the measure.
fn atom(dice: &mut SplitMix64, domain: &Domain, terms: &Terms) -> Atom {
    let fluent = dice.random_range(0..domain.fluents.len());
    let mut read = terms.clone();
    if domain.measure == Some(fluent) {
        read.any = 0;
    }
    atom_of(dice, domain, &read, fluent)
}

fn atom_of(dice: &mut SplitMix64, domain: &Domain, terms: &Terms, fluent: usize) -> Atom {
    let params = domain.fluents.get(fluent).cloned().unwrap_or_default();
    let args = params.iter().map(|kind| {
        let fitting = terms.of_kind(*kind);
        match one_of(dice, &fitting) {
            Some(arg) if !chance(dice, terms.any) => arg,
            _ => Arg::Any,
        }
    });
    Atom { fluent, args: args.collect() }
}

fn condition(dice: &mut SplitMix64, domain: &Domain, terms: &Terms, depth: u32) -> Condition {
    let choice = dice.random_range(0..100);
    if depth > 0 && choice < 12 {
        let parts = (0..2).map(|_| condition(dice, domain, terms, depth - 1)).collect();
        return if choice < 6 { Condition::All(parts) } else { Condition::AnyOf(parts) };
    }
    let is = Condition::Is(atom(dice, domain, terms));
    if chance(dice, 40) { Condition::Not(Box::new(is)) } else { is }
}

/// The kind of a quantifier, its terms, and a condition for it.
fn clause(dice: &mut SplitMix64, domain: &Domain, terms: &Terms) -> (Option<Kind>, Terms, Option<Condition>) {
    let each = chance(dice, 25)
        .then(|| one_of(dice, &[Kind::Object, Kind::Object, Kind::Container, Kind::Entity]))
        .flatten();
    let terms = each.map_or_else(|| terms.clone(), |kind| terms.with(Arg::Each, kind));
    let when = chance(dice, if each.is_some() { 60 } else { 20 }).then(|| {
        let same = |kind: Kind| each.is_some_and(|each| each.is(kind) || kind.is(each));
        let params = terms.known.iter().filter(|(arg, kind)| matches!(arg, Arg::Param(_)) && same(*kind));
        match (each, one_of(dice, &params.map(|(arg, _)| *arg).collect::<Vec<_>>())) {
            (Some(_), Some(param)) if chance(dice, 25) => {
                let same = Condition::Same(Arg::Each, param);
                if chance(dice, 30) { Condition::Not(Box::new(same)) } else { same }
            }
            _ => condition(dice, domain, &terms, 1),
        }
    });
    (each, terms, when)
}

/// The domain without its measure, which stands last: effects neither make a reading nor depend on one.
fn unmeasured(domain: &Domain) -> Domain {
    let mut domain = domain.clone();
    domain.fluents.truncate(domain.measure.take().unwrap_or(usize::MAX));
    domain
}

fn change(dice: &mut SplitMix64, domain: &Domain, terms: &Terms) -> Change {
    let (each, terms, when) = clause(dice, &unmeasured(domain), terms);
    let fluent = dice.random_range(0..domain.measure.unwrap_or(domain.fluents.len()));
    Change { atom: atom_of(dice, domain, &terms, fluent), truth: chance(dice, 55), each, when }
}

fn action(dice: &mut SplitMix64, domain: &Domain, finds: bool) -> Action {
    let mut terms = entities(domain);
    let mut params = Vec::new();
    if !finds && chance(dice, 75) {
        let kinds = [Kind::Object, Kind::Object, Kind::Entity];
        params.extend((0..1 + usize::from(chance(dice, 20))).filter_map(|_| one_of(dice, &kinds)));
    }
    for (index, kind) in params.iter().enumerate() {
        terms = terms.with(Arg::Param(index), *kind).with(Arg::Param(index), *kind);
    }
    let needs = (0..dice.random_range(0..3)).map(|_| {
        let (each, terms, when) = clause(dice, domain, &terms);
        Need { condition: condition(dice, domain, &terms, 1), each, when }
    });
    let needs = needs.collect();
    let finds_all = finds && chance(dice, 30);
    let finds = finds && !finds_all;
    if finds {
        terms = terms.with(Arg::Result, Kind::Object).with(Arg::Result, Kind::Object);
    }
    let least = usize::from(!finds && !finds_all);
    let makes = (0..least + dice.random_range(0..3)).map(|_| change(dice, domain, &terms)).collect();
    let unsettles = (0..usize::from(chance(dice, 20))).map(|_| change(dice, domain, &terms)).collect();
    let fails = FAILURES.into_iter().filter(|_| chance(dice, 40)).collect();
    // Without any it would hold the whole robot.
    let uses = chance(dice, 90).then(|| one_of(dice, &RESOURCES)).flatten();
    Action { name: String::new(), params, needs, makes, unsettles, fails, uses, finds, finds_all }
}

/// Maker of a policy.
struct Maker<'a> {
    dice: &'a mut SplitMix64,
    domain: &'a Domain,
    /// Names in scope; all are of objects.
    names: Vec<usize>,
    /// Names in scope of lists of objects.
    lists: Vec<usize>,
    made: usize,
    policies: usize,
}

/// A policy of few steps over a domain.
#[must_use]
pub(super) fn policy(dice: &mut SplitMix64, domain: &Domain) -> Policy {
    let mut maker = Maker { dice, domain, names: Vec::new(), lists: Vec::new(), made: 0, policies: 0 };
    let mut called = Vec::new();
    if chance(maker.dice, 20) {
        let name = maker.name();
        maker.names.push(name);
        called.push((name, maker.block(2, 1)));
        maker.names.clear();
    }
    maker.policies = called.len();
    let length = 2 + maker.dice.random_range(0..4);
    let body = maker.block(length, 3);
    let later = if chance(maker.dice, 12) { maker.block(2, 2) } else { Vec::new() };
    Policy { body, called, later }
}

impl Maker<'_> {
    fn name(&mut self) -> usize {
        self.made += 1;
        self.made - 1
    }

    /// Steps, whose names end with them.
    fn block(&mut self, length: usize, depth: u32) -> Vec<Step> {
        let (names, lists) = (self.names.len(), self.lists.len());
        let steps = (0..length).map(|_| self.step(depth)).collect();
        self.names.truncate(names);
        self.lists.truncate(lists);
        steps
    }

    fn inner(&mut self, depth: u32) -> Vec<Step> {
        let length = 1 + self.dice.random_range(0..3);
        self.block(length, depth.saturating_sub(1))
    }

    fn terms(&self) -> Terms {
        let terms = entities(self.domain);
        self.names.iter().fold(terms, |terms, name| terms.with(Arg::Name(*name), Kind::Object))
    }

    fn test(&mut self) -> Condition {
        let terms = self.terms();
        condition(self.dice, self.domain, &terms, 1)
    }

    fn end(&mut self) -> &'static str {
        one_of(self.dice, &ENDS).unwrap_or_default()
    }

    fn objects(&mut self) -> Vec<usize> {
        let all: Vec<usize> =
            self.domain.of_kind(Kind::Object).filter(|one| *one < self.domain.declared).collect();
        let some: Vec<usize> = all.iter().copied().filter(|_| chance(self.dice, 60)).collect();
        if some.is_empty() { all } else { some }
    }

    fn call(&mut self) -> Step {
        let action = self.dice.random_range(0..self.domain.actions.len());
        let Some(def) = self.domain.actions.get(action) else { return Step::Delay };
        let terms = self.terms();
        let args = def.params.iter().filter_map(|kind| one_of(self.dice, &terms.of_kind(*kind))).collect();
        let name = ((def.finds || def.finds_all) && chance(self.dice, 85)).then(|| self.name());
        (if def.finds_all { &mut self.lists } else { &mut self.names }).extend(name);
        let retry = if chance(self.dice, 12) { 1 + self.dice.random_range(0..2) } else { 0 };
        Step::Call { action, args, name, retry }
    }

    fn step(&mut self, depth: u32) -> Step {
        let choice = if depth == 0 { 0 } else { self.dice.random_range(0..100) };
        match choice {
            42..44 => {
                let Some(list) = one_of(self.dice, &self.lists) else { return self.call() };
                let name = self.name();
                self.names.push(name);
                Step::First { list, name }
            }
            44..48 => {
                let (among, name) = (self.objects(), self.name());
                self.names.push(name);
                Step::Choose { among, name }
            }
            48..58 => {
                let test = self.test();
                let then = self.inner(depth);
                let otherwise = if chance(self.dice, 60) { self.inner(depth) } else { Vec::new() };
                Step::If(test, then, otherwise)
            }
            58..61 => Step::Wait(self.test()),
            61..62 => Step::Delay,
            62..71 => {
                let body = self.inner(depth);
                let on: [&[&'static str]; 3] = [&["slipped"], &["blocked", "timeout"], &[]];
                let chosen: Vec<_> = on.into_iter().filter(|_| chance(self.dice, 45)).collect();
                let chosen = if chosen.is_empty() { vec![&[] as &[_]] } else { chosen };
                let handlers = chosen.into_iter().map(|on| {
                    let handler = if chance(self.dice, 20) { Vec::new() } else { self.inner(depth) };
                    (on.to_vec(), handler)
                });
                Step::Try(body, handlers.collect())
            }
            71..75 => {
                let body = self.inner(depth);
                Step::Finally(body, self.inner(1))
            }
            75..81 => {
                let (times, body) = (1 + self.dice.random_range(0..3), self.inner(depth));
                let until = chance(self.dice, 50).then(|| self.test());
                Step::Repeat(times, body, until)
            }
            81..85 => {
                let list = one_of(self.dice, &self.lists).filter(|_| chance(self.dice, 50));
                let among = list.map_or_else(|| Among::Entities(self.objects()), Among::List);
                let name = self.name();
                self.names.push(name);
                let body = self.inner(depth);
                self.names.retain(|known| *known != name);
                Step::Each { among, name, body }
            }
            85..91 => {
                let for_secs = if chance(self.dice, 25) { 1 + self.dice.random_range(0..2) } else { 0 };
                let watch = Watch { condition: self.test(), for_secs };
                let reaction = match self.dice.random_range(0..10) {
                    0..3 => Reaction::Pause,
                    3..5 => Reaction::Restart(1 + self.dice.random_range(0..2)),
                    5..9 => Reaction::Resume(1 + self.dice.random_range(0..2), self.inner(1)),
                    _ => Reaction::End(self.end()),
                };
                Step::Monitor(watch, reaction, self.inner(depth))
            }
            91..92 => {
                let known = self.terms().of_kind(Kind::Entity);
                let of = one_of(self.dice, &known).unwrap_or(Arg::Entity(0));
                Step::Keep(of, self.inner(depth))
            }
            92..93 => Step::Within(self.inner(depth)),
            93..97 => Step::Parallel((0..2).map(|_| self.inner(depth.min(2))).collect()),
            97..99 if self.policies > 0 => {
                let objects = self.terms().of_kind(Kind::Object);
                let arg = one_of(self.dice, &objects).unwrap_or(Arg::Entity(0));
                Step::Policy(self.dice.random_range(0..self.policies), arg)
            }
            99 => Step::End(self.end()),
            _ => self.call(),
        }
    }
}
