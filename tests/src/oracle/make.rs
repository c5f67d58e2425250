//! Domains and policies of the oracle, and random ones, the same for the same seed.

use rand::RngExt as _;
use rand_xoshiro::SplitMix64;

/// A domain of few fluents, so that policies often meet what they changed.
pub fn domain(dice: &mut SplitMix64) -> Domain {
    let entities = 2 + dice.random_range(0..2);
    let arities = vec![0, 0, 1, 1, 2];
    let mut domain =
        Domain { entities, arities, actions: Vec::new(), start: Vec::new(), is_closed: chance(dice, 40) };
    domain.actions = (0..4 + dice.random_range(0..3)).map(|_| action(dice, &domain)).collect();
    let known = if chance(dice, 60) { 100 } else { 60 };
    for fluent in 0..domain.arities.len() {
        for index in 0..entities.pow(u32::try_from(arity(&domain, fluent)).unwrap_or(0)) {
            let args = [index % entities, index / entities].into_iter().take(arity(&domain, fluent));
            let atom = Atom { fluent, args: args.map(Arg::Entity).collect() };
            if chance(dice, known) {
                domain.start.push((atom, chance(dice, 50)));
            }
        }
    }
    domain
}

/// True `percent` times of a hundred.
fn chance(dice: &mut SplitMix64, percent: u32) -> bool {
    dice.random_range(0..100) < percent
}

fn arity(domain: &Domain, fluent: usize) -> usize {
    domain.arities.get(fluent).copied().unwrap_or(0)
}

fn atom(dice: &mut SplitMix64, domain: &Domain, param: bool, any: u32) -> Atom {
    let fluent = dice.random_range(0..domain.arities.len());
    let args = (0..arity(domain, fluent)).map(|_| {
        if chance(dice, any) {
            Arg::Any
        } else if param && chance(dice, 75) {
            Arg::Param
        } else {
            Arg::Entity(dice.random_range(0..domain.entities))
        }
    });
    Atom { fluent, args: args.collect() }
}

fn literal(dice: &mut SplitMix64, domain: &Domain, param: bool, any: u32) -> Literal {
    Literal { atom: atom(dice, domain, param, any), truth: chance(dice, 60) }
}

fn action(dice: &mut SplitMix64, domain: &Domain) -> Action {
    let has_param = chance(dice, 70);
    let needs = (0..dice.random_range(0..3)).map(|_| literal(dice, domain, has_param, 10)).collect();
    let makes = (0..1 + dice.random_range(0..3)).map(|_| {
        let literal = literal(dice, domain, has_param, 15);
        let when = chance(dice, 20).then(|| self::literal(dice, domain, has_param, 0));
        Effect { literal, when }
    });
    let makes = makes.collect();
    let unsettles = (0..usize::from(chance(dice, 15))).map(|_| atom(dice, domain, has_param, 20)).collect();
    let fails = [Kind::Slipped, Kind::Blocked].into_iter().filter(|_| chance(dice, 40)).collect();
    Action { has_param, needs, makes, unsettles, fails }
}

/// A policy of few steps.
pub fn policy(dice: &mut SplitMix64, domain: &Domain) -> Policy {
    let length = 1 + dice.random_range(0..4);
    block(dice, domain, length, 3)
}

fn block(dice: &mut SplitMix64, domain: &Domain, length: usize, depth: usize) -> Vec<Step> {
    (0..length).map(|_| step(dice, domain, depth)).collect()
}

fn call(dice: &mut SplitMix64, domain: &Domain) -> (usize, usize) {
    (dice.random_range(0..domain.actions.len()), dice.random_range(0..domain.entities))
}

fn step(dice: &mut SplitMix64, domain: &Domain, depth: usize) -> Step {
    let inner = |dice: &mut SplitMix64| {
        let length = 1 + dice.random_range(0..2);
        block(dice, domain, length, depth.saturating_sub(1))
    };
    let choice = if depth == 0 { 0 } else { dice.random_range(0..100) };
    match choice {
        57..60 => {
            let body = inner(dice);
            let mut cleanup = vec![step(dice, domain, 0)];
            if chance(dice, 50) {
                cleanup = vec![Step::If(literal(dice, domain, false, 10), cleanup, Vec::new())];
            }
            Step::Finally(body, cleanup)
        }
        60..70 => {
            let test = literal(dice, domain, false, 10);
            let then = inner(dice);
            let otherwise = if chance(dice, 60) { inner(dice) } else { Vec::new() };
            Step::If(test, then, otherwise)
        }
        70..80 => {
            let body = inner(dice);
            let on = [Some(vec![Kind::Slipped]), Some(vec![Kind::Blocked, Kind::Timeout]), None];
            let chosen = on.into_iter().filter(|_| chance(dice, 50)).collect::<Vec<_>>();
            let mut handlers: Vec<_> = chosen.into_iter().map(|on| (on, inner(dice))).collect();
            if handlers.is_empty() {
                handlers.push((None, inner(dice)));
            }
            Step::Try(body, handlers)
        }
        80..88 => {
            let body = inner(dice);
            Step::Repeat(
                1 + dice.random_range(0..3),
                body,
                chance(dice, 60).then(|| literal(dice, domain, false, 0)),
            )
        }
        88..92 => Step::Resume(inner(dice), 1 + dice.random_range(0..2), vec![step(dice, domain, 0)]),
        92..95 => {
            let mut branch =
                || (0..1 + dice.random_range(0..2)).map(|_| call(dice, domain)).collect::<Vec<_>>();
            Step::Parallel(vec![branch(), branch()])
        }
        95..97 => Step::Sequence(inner(dice)),
        97..100 => Step::End(chance(dice, 50)),
        _ => {
            let (action, entity) = call(dice, domain);
            Step::Call { action, entity, retry: usize::from(chance(dice, 10)) }
        }
    }
}

/// An argument of an atom.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Arg {
    /// The parameter of the action.
    Param,
    /// An entity.
    Entity(usize),
    /// Every entity, in an effect; some entity, in a condition.
    Any,
}

/// A fluent with its arguments.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Atom {
    /// Index of the fluent.
    pub fluent: usize,
    /// As many as the fluent has parameters.
    pub args: Vec<Arg>,
}

/// An atom or its negation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Literal {
    /// The atom.
    pub atom: Atom,
    /// True if it is meant to hold.
    pub truth: bool,
}

/// An effect, under a condition where there is one.
#[derive(Clone, Debug)]
pub struct Effect {
    /// Literal that holds afterwards.
    pub literal: Literal,
    /// Condition under which it happens.
    pub when: Option<Literal>,
}

/// Failure of a step.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// `slipped`
    Slipped,
    /// `blocked`
    Blocked,
    /// `timeout`
    Timeout,
    /// `exhausted`
    Exhausted,
}

/// An action with its contract.
#[derive(Clone, Debug)]
pub struct Action {
    /// True if it has a parameter.
    pub has_param: bool,
    /// Its preconditions.
    pub needs: Vec<Literal>,
    /// Its effects.
    pub makes: Vec<Effect>,
    /// Atoms that are not known after it.
    pub unsettles: Vec<Atom>,
    /// Failures besides the timeout.
    pub fails: Vec<Kind>,
}

/// Fluents, entities, actions and a start.
#[derive(Clone, Debug)]
pub struct Domain {
    /// Number of entities.
    pub entities: usize,
    /// By fluent: how many parameters it has, at most two.
    pub arities: Vec<usize>,
    /// The actions.
    pub actions: Vec<Action>,
    /// Literals that are known at the start.
    pub start: Vec<(Atom, bool)>,
    /// True if everything else is false.
    pub is_closed: bool,
}

/// A step.
#[derive(Clone, Debug)]
pub enum Step {
    /// Runs an action.
    Call {
        /// Index of the action.
        action: usize,
        /// Index of the entity.
        entity: usize,
        /// Number of further attempts.
        retry: usize,
    },
    /// A named group.
    Sequence(Vec<Step>),
    /// A named group and its cleanup.
    Finally(Vec<Step>, Vec<Step>),
    /// A branch.
    If(Literal, Vec<Step>, Vec<Step>),
    /// Handlers by kind; none for any.
    Try(Vec<Step>, Vec<(Option<Vec<Kind>>, Vec<Step>)>),
    /// A bounded loop.
    Repeat(usize, Vec<Step>, Option<Literal>),
    /// A body, and a block that may run before any of its steps, at most so often.
    Resume(Vec<Step>, usize, Vec<Step>),
    /// Calls at once, as pairs of action and entity.
    Parallel(Vec<Vec<(usize, usize)>>),
    /// Ends the policy: done, or failed.
    End(bool),
}

/// A policy.
pub type Policy = Vec<Step>;

impl Step {
    /// True if branches run at once somewhere in it.
    #[must_use]
    pub fn is_parallel(&self) -> bool {
        let any = |steps: &[Self]| steps.iter().any(Self::is_parallel);
        match self {
            Self::Parallel(_) => true,
            Self::Call { .. } | Self::End(_) => false,
            Self::Sequence(body) | Self::Repeat(_, body, _) => any(body),
            Self::If(_, then, otherwise) => any(then) || any(otherwise),
            Self::Finally(body, cleanup) => any(body) || any(cleanup),
            Self::Try(body, handlers) => any(body) || handlers.iter().any(|(_, handler)| any(handler)),
            Self::Resume(body, _, reaction) => any(body) || any(reaction),
        }
    }
}
