//! Tests of what cannot change: comparisons of bindings and of the lengths of lists. A later test of the same
//! value has the outcome that an earlier one implies, until a step binds the name again.
//!
//! Outcomes are facts of a table of their own, so they are joined, rolled back and kept apart by paths as
//! all others are.

use motet_syntax::ast::CompareOp;

use super::Prover;
use crate::facts::{Cause, FactKey, TruthSet, effort};
use crate::ir::{BindingId, Condition, Fluent, Program, Term, Ty};

/// Maximal number of different tests of a policy that are remembered.
const MAX_TESTS: usize = 1000;

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

impl Test {
    /// A comparison, if nothing but another binding of a name can change its outcome.
    fn new(op: CompareOp, left: &Term, right: &Term) -> Option<Self> {
        let is_fixed = |term: &Term| term.is_constant() || names(term);
        if !is_fixed(left) || !is_fixed(right) {
            return None;
        }
        let (op, of, with) = if left.is_constant() { (turned(op), right, left) } else { (op, left, right) };
        (!of.is_constant()).then(|| Self { op, of: of.clone(), with: with.clone() })
    }

    /// Outcome of another test that follows from the outcome of this one.
    fn implies(&self, outcome: bool, other: &Self, program: &Program) -> Option<bool> {
        if self.of != other.of {
            return None;
        }
        let (a, b) = match (number(&self.with), number(&other.with)) {
            (Some(a), Some(b)) => (a, b),
            _ if self.with == other.with => (0.0, 0.0),
            _ if is_other(&self.with, &other.with) => (0.0, 1.0),
            _ => return None,
        };
        // Both tests are constant between their bounds: one value of each part stands for all.
        let near = |value: f64| [value.floor() - 1.0, value.floor(), value, value.ceil(), value.ceil() + 1.0];
        let whole = is_whole(&self.of, program) && number(&self.with).is_some();
        let is_value = |value: &f64| {
            (!whole || value.fract() == 0.0) && (*value >= 0.0 || !matches!(self.of, Term::Count(_)))
        };
        let values = near(a).into_iter().chain(near(b)).chain([f64::midpoint(a, b)]).filter(is_value);
        let mut found = None;
        for value in values.filter(|value| holds(self.op, *value, a) == outcome) {
            let is_so = holds(other.op, value, b);
            if *found.get_or_insert(is_so) != is_so {
                return None;
            }
        }
        found
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
        let Some(test) = Test::new(op, left, right) else { return TruthSet::NOTHING_KNOWN };
        effort::spend(self.tested.tests.len());
        for (index, known) in self.tested.tests.iter().enumerate() {
            let Some(key) = key(index) else { break };
            let value = self.state.facts.get(self.tested.fluent, key);
            let outcome = value.is_true();
            if (outcome || value.is_false())
                && let Some(implied) = known.implies(outcome, &test, self.program)
            {
                return TruthSet::of(implied, if outcome { value.yes } else { value.no });
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
        if let Some(key) = Test::new(op, left, right).and_then(|test| self.tested.key(test)) {
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
