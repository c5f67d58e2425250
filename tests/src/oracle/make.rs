//! Random domains and policies, the same for the same seed.

use super::model::{Action, Arg, Atom, Domain, Effect, Kind, Literal, Policy, Step};

/// A source of choices (xorshift64*).
#[derive(Clone, Debug)]
pub struct Dice(u64);

impl Dice {
    /// Dice that always fall in the same way.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// A number below `bound`, which is at least 1.
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let high = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33;
        usize::try_from(high).unwrap_or(0) % bound.max(1)
    }

    /// True `percent` times of a hundred.
    pub fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }
}

/// A domain of few fluents, so that policies often meet what they changed.
pub fn domain(dice: &mut Dice) -> Domain {
    let entities = 2 + dice.below(2);
    let arities = vec![0, 0, 1, 1, 2];
    let mut domain =
        Domain { entities, arities, actions: Vec::new(), start: Vec::new(), is_closed: dice.chance(40) };
    domain.actions = (0..4 + dice.below(3)).map(|_| action(dice, &domain)).collect();
    let known = if dice.chance(60) { 100 } else { 60 };
    for fluent in 0..domain.arities.len() {
        for index in 0..entities.pow(u32::try_from(arity(&domain, fluent)).unwrap_or(0)) {
            let args = [index % entities, index / entities].into_iter().take(arity(&domain, fluent));
            let atom = Atom { fluent, args: args.map(Arg::Entity).collect() };
            if dice.chance(known) {
                domain.start.push((atom, dice.chance(50)));
            }
        }
    }
    domain
}

fn arity(domain: &Domain, fluent: usize) -> usize {
    domain.arities.get(fluent).copied().unwrap_or(0)
}

fn atom(dice: &mut Dice, domain: &Domain, param: bool, any: usize) -> Atom {
    let fluent = dice.below(domain.arities.len());
    let args = (0..arity(domain, fluent)).map(|_| {
        if dice.chance(any) {
            Arg::Any
        } else if param && dice.chance(75) {
            Arg::Param
        } else {
            Arg::Entity(dice.below(domain.entities))
        }
    });
    Atom { fluent, args: args.collect() }
}

fn literal(dice: &mut Dice, domain: &Domain, param: bool, any: usize) -> Literal {
    Literal { atom: atom(dice, domain, param, any), truth: dice.chance(60) }
}

fn action(dice: &mut Dice, domain: &Domain) -> Action {
    let has_param = dice.chance(70);
    let needs = (0..dice.below(3)).map(|_| literal(dice, domain, has_param, 10)).collect();
    let makes = (0..1 + dice.below(3)).map(|_| {
        let literal = literal(dice, domain, has_param, 15);
        let when = dice.chance(20).then(|| self::literal(dice, domain, has_param, 0));
        Effect { literal, when }
    });
    let makes = makes.collect();
    let unsettles = (0..usize::from(dice.chance(15))).map(|_| atom(dice, domain, has_param, 20)).collect();
    let fails = [Kind::Slipped, Kind::Blocked].into_iter().filter(|_| dice.chance(40)).collect();
    Action { has_param, needs, makes, unsettles, fails }
}

/// A policy of few steps.
pub fn policy(dice: &mut Dice, domain: &Domain) -> Policy {
    let length = 1 + dice.below(4);
    block(dice, domain, length, 3)
}

fn block(dice: &mut Dice, domain: &Domain, length: usize, depth: usize) -> Vec<Step> {
    (0..length).map(|_| step(dice, domain, depth)).collect()
}

fn call(dice: &mut Dice, domain: &Domain) -> (usize, usize) {
    (dice.below(domain.actions.len()), dice.below(domain.entities))
}

fn step(dice: &mut Dice, domain: &Domain, depth: usize) -> Step {
    let inner = |dice: &mut Dice| {
        let length = 1 + dice.below(2);
        block(dice, domain, length, depth.saturating_sub(1))
    };
    let choice = if depth == 0 { 0 } else { dice.below(100) };
    match choice {
        60..70 => {
            let test = literal(dice, domain, false, 10);
            let then = inner(dice);
            let otherwise = if dice.chance(60) { inner(dice) } else { Vec::new() };
            Step::If(test, then, otherwise)
        }
        70..80 => {
            let body = inner(dice);
            let on = [Some(vec![Kind::Slipped]), Some(vec![Kind::Blocked, Kind::Timeout]), None];
            let chosen = on.into_iter().filter(|_| dice.chance(50)).collect::<Vec<_>>();
            let mut handlers: Vec<_> = chosen.into_iter().map(|on| (on, inner(dice))).collect();
            if handlers.is_empty() {
                handlers.push((None, inner(dice)));
            }
            Step::Try(body, handlers)
        }
        80..88 => {
            let body = inner(dice);
            Step::Repeat(1 + dice.below(3), body, dice.chance(60).then(|| literal(dice, domain, false, 0)))
        }
        88..92 => Step::Resume(inner(dice), 1 + dice.below(2), vec![step(dice, domain, 0)]),
        92..95 => {
            let mut branch = || (0..1 + dice.below(2)).map(|_| call(dice, domain)).collect::<Vec<_>>();
            Step::Parallel(vec![branch(), branch()])
        }
        95..97 => Step::Sequence(inner(dice)),
        97..100 => Step::End(dice.chance(50)),
        _ => {
            let (action, entity) = call(dice, domain);
            Step::Call { action, entity, retry: usize::from(dice.chance(10)) }
        }
    }
}
