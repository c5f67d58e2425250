//! Random domains, the same for the same seed. They are small, so that policies often meet what they have
//! changed.

use motet_stdlib::lang::fluents::HOLDING;
use rand::RngExt as _;
use rand_xoshiro::SplitMix64;

use super::contract::{Action, Arg, Atom, Change, Condition, Domain, Kind, Need};

/// Failures that actions declare.
pub(super) const FAILURES: [&str; 2] = ["slipped", "blocked"];
/// Resources of actions; one contains the other or they are apart, as the standard library says.
const RESOURCES: [&str; 3] = [BASE, "voice", "camera"];
/// Entities of the standard library.
pub(super) const LIBRARY: [(&str, Kind); 3] =
    [("robot", Kind::Entity), ("user", Kind::Person), ("start", Kind::Place)];
/// The resource that moves the robot.
pub(super) const BASE: &str = "base";

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
    let modes = if chance(dice, 40) { 2 + dice.random_range(0..2) } else { 0 };
    domain.entities.extend((0..modes).map(|index| (format!("s{index}"), Kind::Mode)));
    domain.declared = domain.entities.len();
    if chance(dice, 30) {
        domain.entities.push(("u0".to_owned(), Kind::Object));
    }
    for (name, kind) in LIBRARY {
        domain.entities.push((name.to_owned(), kind));
    }
    domain.fluents = vec![vec![], vec![Kind::Object], vec![Kind::Object], vec![Kind::Entity]];
    domain.fluents.push(vec![Kind::Object, if chance(dice, 50) { Kind::Object } else { Kind::Entity }]);
    if modes > 0 {
        let with = if chance(dice, 50) { vec![Kind::Mode] } else { vec![Kind::Object, Kind::Mode] };
        domain.fluents.push(with);
    }
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
pub(super) struct Terms {
    /// Arguments with their kinds.
    known: Vec<(Arg, Kind)>,
    /// Percentage of `any`.
    any: u32,
}

impl Terms {
    pub(super) fn with(&self, arg: Arg, kind: Kind) -> Self {
        let mut terms = self.clone();
        // Twice, so that it is often taken.
        terms.known.extend([(arg, kind), (arg, kind)]);
        terms
    }

    pub(super) fn of_kind(&self, kind: Kind) -> Vec<Arg> {
        self.known.iter().filter(|(_, own)| own.is(kind)).map(|(arg, _)| *arg).collect()
    }
}

pub(super) fn entities(domain: &Domain) -> Terms {
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

pub(super) fn condition(dice: &mut SplitMix64, domain: &Domain, terms: &Terms, depth: u32) -> Condition {
    let choice = dice.random_range(0..100);
    if depth > 0 && choice < 12 {
        let parts = (0..2).map(|_| condition(dice, domain, terms, depth - 1)).collect();
        let parts = if choice < 6 { Condition::All(parts) } else { Condition::AnyOf(parts) };
        return if chance(dice, 20) { Condition::Not(Box::new(parts)) } else { parts };
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
        let mut kinds = vec![Kind::Object, Kind::Object, Kind::Entity];
        kinds.extend(domain.has(Kind::Mode).then_some(Kind::Mode));
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
    let mut kinds = vec![Kind::Object, Kind::Object, Kind::Object, Kind::Entity];
    kinds.extend([Kind::Mode, Kind::Container].into_iter().filter(|kind| domain.has(*kind)));
    let finds = one_of(dice, &kinds).filter(|_| finds && !finds_all);
    if let Some(kind) = finds {
        terms = terms.with(Arg::Result, kind).with(Arg::Result, kind);
    }
    let least = usize::from(finds.is_none() && !finds_all);
    let makes: Vec<Change> =
        (0..least + dice.random_range(0..3)).map(|_| change(dice, domain, &terms)).collect();
    let unsettles = (0..usize::from(chance(dice, 20))).map(|_| change(dice, domain, &terms)).collect();
    let fails = FAILURES.into_iter().filter(|_| chance(dice, 40)).collect();
    let uses = chance(dice, 75).then(|| one_of(dice, &RESOURCES)).flatten();
    let is_stale_by_base = (finds.is_some() || finds_all) && chance(dice, 50);
    let is_own = |arg: &Arg| matches!(arg, Arg::Param(_) | Arg::Result);
    let whose = terms.known.iter().filter(|(arg, kind)| is_own(arg) && kind.is(Kind::Entity));
    let whose: Vec<Arg> = whose.map(|(arg, _)| *arg).collect();
    let is_stale_by = one_of(dice, &whose).filter(|_| chance(dice, 15)).into_iter().collect();
    Action {
        params,
        needs,
        makes,
        unsettles,
        fails,
        uses,
        finds,
        finds_all,
        is_stale_by_base,
        is_stale_by,
        ..Action::default()
    }
}
