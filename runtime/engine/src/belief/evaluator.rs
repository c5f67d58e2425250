//! Conditions and terms, judged against what is believed.

use super::cells::{Beliefs, CellId};
use super::facts::{BeliefChange, overlaps};
use crate::query::{Answer, Pattern, Query, Truth};
use crate::time::Time;
use crate::verifier::derived;
use motet_graph::{Arithmetic, Comparison, Condition, Fact, FactArg, Graph, Term, TextPart, Value, spoken};

/// Required freshness of a belief.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Freshness {
    /// Facts last; a reading counts if it is watched or was taken at or after this time.
    Readings(Time),
    /// Also a fact that can be observed counts only if it was seen after the observation of this number.
    Facts(Time, u64),
    /// As [`Self::Readings`], and that a hand holds something counts only if it was seen after the
    /// observation of this number: it may have dropped.
    Hands(Time, u64),
    /// As [`Self::Readings`], and no fact counts that was seen or changed after the observation or the effect
    /// of this number.
    Before(Time, u64),
}

/// The fluent that is derived from a motion. No effect says when it changes, so what was seen of it does not
/// last.
const DERIVED: &str = motet_stdlib::lang::fluents::REACHABLE;

/// Maximal size of a value that is worked out: the bytes of its text, or its parts and the bytes of their
/// texts. Names stand for values, so a few steps could ask for any number.
const MAX_SIZE: usize = 1 << 16;

/// Judges conditions. Cheap to make.
pub(crate) struct Evaluator<'a> {
    pub(crate) graph: &'a Graph,
    pub(crate) beliefs: &'a mut Beliefs,
    pub(crate) bindings: &'a [Option<Value>],
    /// Current value of [`Term::Each`].
    pub(crate) each: Option<Value>,
    pub(crate) fresh: Freshness,
    /// Changes that other calls may make at any moment: what they are about is not known.
    pub(crate) busy: &'a [BeliefChange],
    /// True if a text says of an unknown value that it is unknown; otherwise the whole text is.
    pub(crate) vague: bool,
    /// Collects the queries that are unknown and can be observed.
    pub(crate) missing: Option<&'a mut Vec<CellId>>,
}

impl Evaluator<'_> {
    /// True if a condition holds.
    pub(crate) fn condition(&mut self, condition: &Condition) -> Truth {
        match condition {
            Condition::Literal(value) => Truth::from(*value),
            Condition::Fact(fact) => self.fact(fact),
            Condition::Compare(comparison, left, right) => self.compare(*comparison, left, right),
            Condition::Not(inner) => self.condition(inner).negated(),
            Condition::All(parts) => {
                let mut truth = Truth::True;
                for part in parts {
                    truth = truth.and(self.condition(part));
                    if truth == Truth::False {
                        return truth;
                    }
                }
                truth
            }
            Condition::AnyOf(parts) => {
                let mut truth = Truth::False;
                for part in parts {
                    truth = truth.or(self.condition(part));
                    if truth == Truth::True {
                        return truth;
                    }
                }
                truth
            }
        }
    }

    /// A term's value; none where it is not known.
    pub(crate) fn term(&mut self, term: &Term) -> Option<Value> {
        match term {
            Term::Literal(value) => Some(value.clone()),
            Term::Binding(binding) => self.bindings.get(binding.index())?.clone(),
            Term::Each => self.each.clone(),
            Term::Field(..) | Term::Measure(..) => {
                let query = self.query_of(term)?;
                self.reading(query)
            }
            Term::List(items) => {
                let items: Option<Vec<_>> = items.iter().map(|item| self.term(item)).collect();
                items.map(Value::List).filter(|list| size(list) <= MAX_SIZE)
            }
            Term::Arith(operation, left, right) => {
                let (left, right) = (self.term(left), self.term(right));
                arithmetic(*operation, &left?, &right?)
            }
            Term::Count(list) => match self.term(list)? {
                Value::List(items) => i64::try_from(items.len()).ok().map(Value::Int),
                Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) => None,
                Value::Entity(_) | Value::Case(_) | Value::Pose(_) => None,
            },
            Term::First(list) => match self.term(list)? {
                Value::List(items) => items.into_iter().next(),
                Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) => None,
                Value::Entity(_) | Value::Case(_) | Value::Pose(_) => None,
            },
            Term::Template(parts) => self.template(parts),
        }
    }

    /// A text with its values; `None` if it is too long. All are looked at, so that everything that is
    /// missing is asked for together.
    fn template(&mut self, parts: &[TextPart]) -> Option<Value> {
        let mut text = Some(String::new());
        for part in parts {
            let said = match part {
                TextPart::Literal(literal) => Some(literal.to_string()),
                TextPart::Value(value, ty) => match self.term(value) {
                    Some(value) => Some(spoken(self.graph, &value, ty)),
                    None => self.vague.then(|| "unknown".to_owned()),
                },
            };
            text = text.zip(said).map(|(text, said)| text + &said).filter(|text| text.len() <= MAX_SIZE);
        }
        text.map(|text| Value::Text(text.into()))
    }

    /// The arguments of a fact; none where one is not known.
    pub(crate) fn patterns(&mut self, fact: &Fact) -> Option<Vec<Pattern>> {
        let args = fact.args.iter().map(|arg| match arg {
            FactArg::Term(term) => self.term(term).map(Pattern::Is),
            FactArg::Any => Some(Pattern::Any),
        });
        args.collect()
    }

    /// Calls `found` with each query that a condition depends on.
    pub(crate) fn queries(&mut self, condition: &Condition, found: &mut Vec<CellId>) {
        match condition {
            Condition::Literal(_) => {}
            Condition::Fact(fact) => {
                if let (Some(args), Some(fluent)) =
                    (self.patterns(fact), self.graph.fluents.get(fact.fluent.index()))
                {
                    found.push(self.beliefs.intern(Query::Fact { fluent: fluent.name.clone(), args }));
                }
            }
            Condition::Compare(_, left, right) => {
                self.term_queries(left, found);
                self.term_queries(right, found);
            }
            Condition::Not(inner) => self.queries(inner, found),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                parts.iter().for_each(|part| self.queries(part, found));
            }
        }
    }

    fn term_queries(&mut self, term: &Term, found: &mut Vec<CellId>) {
        match term {
            Term::Literal(_) | Term::Binding(_) | Term::Each => {}
            Term::Field(..) | Term::Measure(..) => {
                if let Some(query) = self.query_of(term) {
                    found.push(self.beliefs.intern(query));
                }
            }
            Term::List(items) => items.iter().for_each(|item| self.term_queries(item, found)),
            Term::Count(list) | Term::First(list) => self.term_queries(list, found),
            Term::Template(parts) => {
                for part in parts {
                    if let TextPart::Value(value, _) = part {
                        self.term_queries(value, found);
                    }
                }
            }
            Term::Arith(_, left, right) => {
                self.term_queries(left, found);
                self.term_queries(right, found);
            }
        }
    }

    fn fact(&mut self, fact: &Fact) -> Truth {
        let Some(fluent) = self.graph.fluents.get(fact.fluent.index()) else { return Truth::Unknown };
        let Some(args) = self.patterns(fact) else { return Truth::Unknown };
        let (mut truth, (seen, changed)) = self.beliefs.fact(&fluent.name, &args);
        if fluent.name == DERIVED && !self.is_current(&fluent.name, &args) {
            truth = Truth::Unknown;
        }
        let last = match self.fresh {
            Freshness::Facts(_, last) => Some(last),
            Freshness::Hands(_, last) if hand(&fluent.name, truth) == Some(Truth::True) => Some(last),
            Freshness::Hands(..) | Freshness::Readings(_) | Freshness::Before(..) => None,
        };
        if last.is_some_and(|last| seen <= last) && fluent.observable && !self.is_live(&fluent.name, &args) {
            truth = Truth::Unknown;
        }
        let is_busy = |change: &BeliefChange| change.fluent == fluent.name && overlaps(&change.args, &args);
        if matches!(self.fresh, Freshness::Before(_, last) if changed > last) || self.busy.iter().any(is_busy)
        {
            truth = Truth::Unknown;
        }
        if self.missing.is_some() && self.beliefs.is_tainted(&fluent.name, &args) {
            truth = Truth::Unknown;
        }
        if truth != Truth::Unknown {
            return truth;
        }
        let query = Query::Fact { fluent: fluent.name.clone(), args };
        if fluent.observable {
            self.miss(query);
            return Truth::Unknown;
        }
        derived(&query)
    }

    /// Time from which on readings count.
    fn since(&self) -> Time {
        match self.fresh {
            Freshness::Readings(since) | Freshness::Facts(since, _) => since,
            Freshness::Hands(since, _) | Freshness::Before(since, _) => since,
        }
    }

    /// True if a fact is watched, so that what is known of it is current.
    fn is_live(&self, fluent: &str, args: &[Pattern]) -> bool {
        let cell = self.beliefs.find_fact(fluent, args).and_then(|id| self.beliefs.cell(id));
        cell.is_some_and(|cell| cell.live)
    }

    /// True if a fact was seen since what counts began, or is watched.
    fn is_current(&self, fluent: &str, args: &[Pattern]) -> bool {
        let since = self.since();
        let cell = self.beliefs.find_fact(fluent, args).and_then(|id| self.beliefs.cell(id));
        cell.is_some_and(|cell| cell.live || cell.at >= since)
    }

    fn reading(&mut self, query: Query) -> Option<Value> {
        let lasting = matches!(query, Query::Field { .. });
        let since = self.since();
        let cell = self.beliefs.find_query(&query).and_then(|id| self.beliefs.cell(id));
        let value = cell.filter(|cell| lasting || cell.live || cell.at >= since).and_then(|cell| match &cell
            .answer
        {
            Answer::Value(value) if is_finite(value) => Some(value.clone()),
            Answer::Value(_) | Answer::Unknown | Answer::Truth(_) => None,
        });
        if value.is_none() {
            self.miss(query);
        }
        value
    }

    fn miss(&mut self, query: Query) {
        if self.missing.is_none() {
            return;
        }
        let id = self.beliefs.intern(query);
        if let Some(missing) = &mut self.missing
            && !missing.contains(&id)
        {
            missing.push(id);
        }
    }

    fn query_of(&mut self, term: &Term) -> Option<Query> {
        match term {
            Term::Field(of, field) => match self.term(of)? {
                Value::Entity(entity) => Some(Query::Field { entity, field: field.clone() }),
                Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) => None,
                Value::Case(_) | Value::Pose(_) | Value::List(_) => None,
            },
            Term::Measure(measure, args) => {
                let measure = self.graph.measures.get(measure.index())?.name.clone();
                let args = args.iter().map(|arg| self.term(arg)).collect::<Option<_>>()?;
                Some(Query::Measure { measure, args })
            }
            Term::Literal(_) | Term::Binding(_) | Term::Each | Term::List(_) | Term::Arith(..) => None,
            Term::Count(_) | Term::First(_) | Term::Template(_) => None,
        }
    }

    fn compare(&mut self, comparison: Comparison, left: &Term, right: &Term) -> Truth {
        let (left, right) = (self.term(left), self.term(right));
        let (Some(left), Some(right)) = (left, right) else { return Truth::Unknown };
        let order = match (number(&left), number(&right)) {
            (Some(left), Some(right)) => left.partial_cmp(&right),
            (None | Some(_), None | Some(_)) => None,
        };
        let equal = order.map_or_else(|| left == right, std::cmp::Ordering::is_eq);
        let truth = match comparison {
            Comparison::Equal => Some(equal),
            Comparison::Unequal => Some(!equal),
            Comparison::Less => order.map(std::cmp::Ordering::is_lt),
            Comparison::AtMost => order.map(std::cmp::Ordering::is_le),
            Comparison::More => order.map(std::cmp::Ordering::is_gt),
            Comparison::AtLeast => order.map(std::cmp::Ordering::is_ge),
        };
        truth.map_or(Truth::Unknown, Truth::from)
    }
}

/// State of a hand by a fact with this truth: true if it holds something; `None` for other facts.
pub(crate) fn hand(fluent: &str, truth: Truth) -> Option<Truth> {
    match fluent {
        motet_stdlib::lang::fluents::HOLDING => Some(truth),
        motet_stdlib::lang::fluents::FREE => Some(truth.negated()),
        _ => None,
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Int(value) => Some(*value as f64),
        Value::Number(value) => Some(*value),
        Value::Bool(_)
        | Value::Text(_)
        | Value::Entity(_)
        | Value::Case(_)
        | Value::Pose(_)
        | Value::List(_) => None,
    }
}

/// Number of the parts of a value and of the bytes of its texts.
fn size(value: &Value) -> usize {
    match value {
        Value::List(items) => items.iter().fold(1, |sum, item| sum + size(item)),
        Value::Text(text) => 1 + text.len(),
        Value::Bool(_) | Value::Int(_) | Value::Number(_) => 1,
        Value::Entity(_) | Value::Case(_) | Value::Pose(_) => 1,
    }
}

fn is_finite(value: &Value) -> bool {
    number(value).is_none_or(f64::is_finite)
}

fn arithmetic(operation: Arithmetic, left: &Value, right: &Value) -> Option<Value> {
    if let (Value::Int(left), Value::Int(right)) = (left, right) {
        let whole = match operation {
            Arithmetic::Add => left.checked_add(*right),
            Arithmetic::Subtract => left.checked_sub(*right),
            Arithmetic::Multiply => left.checked_mul(*right),
            // A quotient is a number, also of whole numbers.
            Arithmetic::Divide => return finite(*left as f64 / *right as f64),
        };
        return whole.map(Value::Int);
    }
    let (left, right) = (number(left)?, number(right)?);
    finite(match operation {
        Arithmetic::Add => left + right,
        Arithmetic::Subtract => left - right,
        Arithmetic::Multiply => left * right,
        Arithmetic::Divide => left / right,
    })
}

fn finite(value: f64) -> Option<Value> {
    value.is_finite().then_some(Value::Number(value))
}
