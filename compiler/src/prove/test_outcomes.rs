//! Tests of what cannot change: comparisons of bindings and of the lengths of lists. A later test of the same
//! value has the outcome that an earlier one implies, until a step binds the name again.
//!
//! Outcomes are facts of a table of their own, so they are joined, rolled back and kept apart by paths as
//! all others are.

use motet_syntax::ast::CompareOp;
use smallvec::SmallVec;

use super::Prover;
use crate::declare::Library;
use crate::facts::{Cause, FactKey, TruthSet, effort};
use crate::ir::{BindingId, Condition, Fluent, Program, StepKind, Term, Ty};

/// Maximal number of different tests of a policy that are remembered.
const MAX_TESTS: usize = 1000;
/// Maximal number of tests of one value that are taken together.
const MAX_BESIDE: usize = 16;

/// Table of the outcomes of tests, with the tests in the order of their keys.
#[derive(Clone, Debug)]
pub(crate) struct TestTable {
    pub(super) fluent: Fluent,
    tests: Vec<Test>,
}

/// Comparison of a value that cannot change with another one.
#[derive(Clone, PartialEq, Debug)]
struct Test {
    op: CompareOp,
    of: Term,
    with: Term,
}

impl TestTable {
    pub(super) fn new(fluent: Fluent) -> Self {
        Self { fluent, tests: Vec::new() }
    }

    /// Key of a test, which becomes known if it is new; `None` if there are too many.
    fn key(&mut self, test: Test) -> Option<FactKey> {
        let known = self.tests.iter().position(|known| *known == test);
        let index = known.or_else(|| {
            let is_new = self.tests.len() < MAX_TESTS;
            is_new.then(|| self.tests.push(test)).map(|()| self.tests.len() - 1)
        });
        key(index?)
    }
}

fn key(index: usize) -> Option<FactKey> {
    Some(FactKey::new([u16::try_from(index).ok()?].into_iter()))
}

/// Test with its outcome and the cause of it.
type KnownTest<'t> = (&'t Test, bool, Cause);

impl Test {
    /// A comparison, if nothing but another binding of a name can change its outcome.
    fn new(op: CompareOp, left: &Term, right: &Term, program: &Program) -> Option<Self> {
        let is_fixed = |term: &Term| term.is_constant() || names(term);
        if !is_fixed(left) || !is_fixed(right) {
            return None;
        }
        let (op, of, with) = if left.is_constant() { (turned(op), right, left) } else { (op, left, right) };
        let length = || length(of, program).cloned().unwrap_or_else(|| of.clone());
        (!of.is_constant()).then(|| Self { op, of: length(), with: with.clone() })
    }

    /// Returns whether another test says something about the outcome of this one.
    fn is_beside(&self, other: &Self) -> bool {
        let is_number = || number(&self.with).is_some() && number(&other.with).is_some();
        self.of == other.of && (self.with == other.with || is_number() || is_other(&self.with, &other.with))
    }

    /// Outcome that follows from the outcomes of tests beside this one.
    fn implied_by(&self, known: &[KnownTest<'_>], (program, library): (&Program, &Library)) -> Option<bool> {
        let mut constants: Vec<&Term> = vec![&self.with];
        constants.extend(known.iter().map(|(test, ..)| &test.with));
        let position = |with: &Term| match with {
            Term::Bool(value) => f64::from(u8::from(*value)),
            Term::Case(_, case) => f64::from(*case),
            with => number(with)
                .unwrap_or_else(|| constants.iter().position(|one| *one == with).unwrap_or(0) as f64),
        };
        let whole = is_whole(&self.of, program);
        let is_value = |value: f64| match &self.with {
            Term::Bool(_) => value == 0.0 || value == 1.0,
            Term::Case(of, _) => {
                let count = library.enums.get(of.index()).map_or(0, |of| of.cases.len());
                value.fract() == 0.0 && (0.0..count as f64).contains(&value)
            }
            Term::Int(_) | Term::Number(_) => {
                (!whole || value.fract() == 0.0) && (value >= 0.0 || !matches!(self.of, Term::Count(_)))
            }
            _ => true,
        };
        // All tests are constant between their bounds: one value of each part stands for all.
        let mut bounds: Vec<f64> = constants.iter().map(|with| position(with)).collect();
        bounds.sort_unstable_by(f64::total_cmp);
        let near = |value: &f64| {
            let (down, up) =
                ((value.floor() - 1.0).min(value.next_down()), (value.ceil() + 1.0).max(value.next_up()));
            [down, value.floor(), *value, value.ceil(), up].into_iter()
        };
        let between = bounds.iter().zip(bounds.iter().skip(1)).map(|(one, next)| f64::midpoint(*one, *next));
        let values = bounds.iter().flat_map(near).chain(between).filter(|value| is_value(*value));
        let (own, mut found) = (position(&self.with), None);
        effort::spend(bounds.len() * bounds.len());
        for value in values {
            if known.iter().all(|(test, outcome, _)| holds(test.op, value, position(&test.with)) == *outcome)
            {
                let is_so = holds(self.op, value, own);
                if *found.get_or_insert(is_so) != is_so {
                    return None;
                }
            }
        }
        found
    }
}

/// The length of a list that a binding is a name for. Where a loop binds the list again, it also binds this
/// name again before any use of it.
fn length<'p>(term: &Term, program: &'p Program) -> Option<&'p Term> {
    let binder = |term: &Term| match term {
        Term::Binding(id) => match *program.bindings.get(id.index())?.binders.as_slice() {
            [binder] => program.step(binder),
            _ => None,
        },
        _ => None,
    };
    let StepKind::Let { value, .. } = &binder(term)?.kind else { return None };
    match value {
        Term::Count(list) => binder(list).map(|_| value),
        Term::Binding(_) => length(value, program),
        _ => None,
    }
}

/// The term is a binding, or the length of a bound list.
fn names(term: &Term) -> bool {
    match term {
        Term::Binding(_) => true,
        Term::Count(list) => matches!(**list, Term::Binding(_)),
        _ => false,
    }
}

fn is_about(term: &Term, binding: BindingId) -> bool {
    match term {
        Term::Binding(id) => *id == binding,
        Term::Count(list) => is_about(list, binding),
        _ => false,
    }
}

/// Two constants are certainly not equal.
fn is_other(one: &Term, other: &Term) -> bool {
    match (one, other) {
        (Term::Text(one), Term::Text(other)) => one != other,
        (Term::Bool(one), Term::Bool(other)) => one != other,
        (Term::Entity(one), Term::Entity(other)) => one != other,
        (Term::Case(..), Term::Case(..)) => one != other,
        _ => false,
    }
}

fn is_whole(term: &Term, program: &Program) -> bool {
    match term {
        Term::Binding(id) => program.bindings.get(id.index()).is_some_and(|binding| binding.ty == Ty::INT),
        Term::Count(_) => true,
        _ => false,
    }
}

fn number(term: &Term) -> Option<f64> {
    match term {
        Term::Int(value) => Some(*value as f64),
        Term::Number(value) => Some(*value),
        _ => None,
    }
}

fn holds(op: CompareOp, value: f64, bound: f64) -> bool {
    match op {
        CompareOp::Equal => value == bound,
        CompareOp::Unequal => value != bound,
        CompareOp::Less => value < bound,
        CompareOp::AtMost => value <= bound,
        CompareOp::More => value > bound,
        CompareOp::AtLeast => value >= bound,
    }
}

/// The comparison with its sides exchanged.
fn turned(op: CompareOp) -> CompareOp {
    match op {
        CompareOp::Equal | CompareOp::Unequal => op,
        CompareOp::Less => CompareOp::More,
        CompareOp::AtMost => CompareOp::AtLeast,
        CompareOp::More => CompareOp::Less,
        CompareOp::AtLeast => CompareOp::AtMost,
    }
}

impl Prover<'_> {
    /// Outcome of a comparison, as far as earlier tests show it. O(tests).
    pub(super) fn recall(&self, op: CompareOp, left: &Term, right: &Term) -> TruthSet {
        let Some(test) = Test::new(op, left, right, self.program) else { return TruthSet::NOTHING_KNOWN };
        effort::spend(self.tested.tests.len());
        let (input, mut known) = ((self.program, self.library), SmallVec::<[KnownTest<'_>; 4]>::new());
        for (index, other) in self.tested.tests.iter().enumerate().filter(|(_, other)| test.is_beside(other))
        {
            let Some(key) = key(index) else { break };
            let value = self.state.facts.get(self.tested.fluent, key);
            if value.is_true() || value.is_false() {
                let outcome = value.is_true();
                let cause = if outcome { value.yes } else { value.no };
                known.push((other, outcome, cause));
                // The cause is the test that shows it alone, or the last one.
                let implied = test.implied_by(&[(other, outcome, cause)], input);
                let implied = implied.or_else(|| {
                    let shows = known.len() > 1 && known.len() <= MAX_BESIDE;
                    shows.then(|| test.implied_by(&known, input)).flatten()
                });
                if let Some(implied) = implied {
                    return TruthSet::of(implied, cause);
                }
            }
        }
        TruthSet::NOTHING_KNOWN
    }

    /// Remembers the outcome of a comparison.
    pub(super) fn note(&mut self, (op, left, right): (CompareOp, &Term, &Term), truth: bool, cause: Cause) {
        let known = self.recall(op, left, right);
        if known.is_true() || known.is_false() {
            return;
        }
        let test = Test::new(op, left, right, self.program);
        if let Some(key) = test.and_then(|test| self.tested.key(test)) {
            self.state.facts.set(self.tested.fluent, key, TruthSet::of(truth, cause));
        }
    }

    /// Forgets the tests of a name, which a step binds anew.
    pub(super) fn forget_tests(&mut self, binding: BindingId) {
        for (index, test) in self.tested.tests.iter().enumerate() {
            if let Some(key) =
                key(index).filter(|_| is_about(&test.of, binding) || is_about(&test.with, binding))
            {
                self.state.facts.forget(self.tested.fluent, key);
            }
        }
    }

    /// Returns whether the outcome of a condition may follow from a test.
    pub(super) fn is_tested(&self, condition: &Condition, fluent: Fluent) -> bool {
        fluent == self.tested.fluent && condition.any(&|part| matches!(part, Condition::Compare(..)))
    }
}
