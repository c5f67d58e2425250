//! Narrowing: what is known once a condition was seen to hold, or not to.

use super::Prover;
use super::eval::Frame;
use super::value::{Cause, Value};
use crate::ir::Condition;

impl Prover<'_> {
    /// Narrows the facts to those in which `condition` is `truth`; false where there are none, so that the way is dead.
    pub(crate) fn assume(
        &mut self,
        condition: &Condition,
        truth: bool,
        cause: Cause,
        frame: Frame<'_>,
    ) -> bool {
        match condition {
            Condition::Literal(value) => *value == truth,
            Condition::Unknown | Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) => true,
            Condition::Not(inner) => self.assume(inner, !truth, cause, frame),
            Condition::Compare(..) => possible(self.evaluate(condition, frame), truth),
            Condition::Fact(fact) => {
                let known = self.evaluate(condition, frame);
                if !possible(known, truth) {
                    return false;
                }
                let derived = self.library.fluent(fact.fluent).is_some_and(|def| def.derived);
                let Some(key) = self.key(fact, frame).filter(|_| !derived) else { return true };
                if key.is_pattern() {
                    // Some entity has it, but which is not known; none has it, and that is known of all.
                    if !truth && !known.is_false() {
                        self.facts.set(fact.fluent, key, Value::no(cause));
                    }
                    return true;
                }
                match known.narrow(truth, cause) {
                    Some(narrowed) => {
                        if narrowed != known {
                            self.facts.set(fact.fluent, key, narrowed);
                        }
                        true
                    }
                    None => false,
                }
            }
            Condition::All(parts) => self.assume_all(parts, truth, cause, frame),
            Condition::AnyOf(parts) => self.assume_any(parts, truth, cause, frame),
        }
    }

    fn assume_all(&mut self, parts: &[Condition], truth: bool, cause: Cause, frame: Frame<'_>) -> bool {
        if truth {
            return parts.iter().all(|part| self.assume(part, true, cause, frame));
        }
        // Not all hold: if all but one certainly do, it is that one.
        let mut doubtful = parts.iter().filter(|part| !self.evaluate(part, frame).is_true());
        match (doubtful.next(), doubtful.next()) {
            (None, _) => false,
            (Some(only), None) => self.assume(only, false, cause, frame),
            (Some(_), Some(_)) => true,
        }
    }

    fn assume_any(&mut self, parts: &[Condition], truth: bool, cause: Cause, frame: Frame<'_>) -> bool {
        if !truth {
            return parts.iter().all(|part| self.assume(part, false, cause, frame));
        }
        let mut doubtful = parts.iter().filter(|part| !self.evaluate(part, frame).is_false());
        match (doubtful.next(), doubtful.next()) {
            (None, _) => false,
            (Some(only), None) => self.assume(only, true, cause, frame),
            (Some(_), Some(_)) => true,
        }
    }
}

/// Whether a condition with these values can be `truth`.
fn possible(value: Value, truth: bool) -> bool {
    let known = if truth { value.yes } else { value.no };
    known.is_some() || value.open.is_some()
}
