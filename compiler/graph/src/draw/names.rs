//! Conditions, terms and steps in words, with the names that a graph's tables give.

use crate::model::{
    BindingId, CallEffect, CallNode, Condition, Ending, Fact, FactArg, FailureId, Graph, Handler, KindId,
    Lifetime, Manner, Motion, Need, NodeKind, Param, ParamDefault, Reaction, ResourceId, Term, TextPart,
    Type, Unsettled, Value, Watch,
};
use crate::spoken::in_unit;

/// Names things by a graph's tables, any graph's: an id that names nothing is `?`.
#[derive(Clone, Copy, Debug)]
pub struct Names<'a>(pub &'a Graph);

/// Placeholder for an id without an entry in its table.
const NOBODY: &str = "?";

impl<'a> Names<'a> {
    /// A step in one line with all that it says itself, arguments by name.
    #[must_use]
    pub fn step(&self, kind: &NodeKind) -> String {
        match kind {
            NodeKind::Call(call) => self.call(call),
            NodeKind::Let { binding, value } => {
                let ty = self.0.bindings.get(binding.index()).map(|binding| &binding.ty);
                let value = literal(value, ty).unwrap_or_else(|| self.term(value));
                format!("let {} = {value}", self.binding(*binding))
            }
            NodeKind::Sequence { name, .. } => format!("sequence {name}"),
            NodeKind::Inline { policy, .. } => format!("policy {policy}"),
            NodeKind::If { condition, .. } => format!("if {}", self.condition(condition)),
            NodeKind::Wait { condition, within_secs } => {
                format!("wait until {} within {within_secs} s", self.condition(condition))
            }
            NodeKind::Delay { secs } => format!("wait {secs} s"),
            NodeKind::Finally { .. } => "with cleanup".to_owned(),
            NodeKind::Monitor { .. } => {
                kind.deadline_secs().map_or_else(|| "monitor".to_owned(), |secs| format!("within {secs} s"))
            }
            NodeKind::Try { .. } => "try".to_owned(),
            NodeKind::Repeat { times, until: None, .. } => format!("repeat {times}"),
            NodeKind::Repeat { times, until: Some(until), .. } => {
                format!("repeat {times} until {}", self.condition(until))
            }
            NodeKind::Each { item, list, at_most, .. } => {
                format!("each {} in {} at most {at_most}", self.binding(*item), self.term(list))
            }
            NodeKind::Parallel { .. } => "parallel".to_owned(),
            NodeKind::End { how, of, why } => self.ending(*how, of.is_some(), why.as_ref()),
        }
    }

    /// A step in one line as a person would write it: arguments by position, neither deadline nor retries.
    #[must_use]
    pub fn brief(&self, kind: &NodeKind) -> String {
        match kind {
            NodeKind::Call(call) => {
                let primitive = self.0.primitives.get(call.primitive.index());
                let name = primitive.map_or(NOBODY, |primitive| &primitive.name);
                let binds = call.binds.map(|id| self.binding(id)).filter(|name| *name != "_");
                let binds = binds.map_or_else(String::new, |name| format!("let {name} = "));
                let params = primitive.map_or(&[][..], |primitive| &primitive.params);
                format!("{binds}{name}({}){}", self.arguments(params, &call.args), manner(call))
            }
            NodeKind::Monitor { .. } if kind.deadline_secs().is_some() => self.step(kind),
            NodeKind::Monitor { watches, .. } => {
                let watched: Vec<_> = watches.iter().map(|watch| self.condition(&watch.condition)).collect();
                format!("monitor {}", watched.join("; "))
            }
            NodeKind::End { how, why, .. } => self.ending(*how, false, why.as_ref()),
            _ => self.step(kind),
        }
    }

    /// A call with the values of its arguments, as [`Self::brief`] writes a step that has them as literals.
    #[must_use]
    pub fn command<'v>(
        &self,
        primitive: &str,
        args: impl IntoIterator<Item = &'v Value>,
        manner: Option<Manner>,
    ) -> String {
        let declared = self.0.primitives.iter().find(|known| known.name == primitive);
        let params = declared.map_or(&[][..], |declared| &declared.params);
        let args: Vec<Term> = args.into_iter().cloned().map(Term::Literal).collect();
        let manner = manner.map_or_else(String::new, |manner| format!(" {manner}"));
        format!("{primitive}({}){manner}", self.arguments(params, &args))
    }

    /// Arguments as a person would write them: by position, without defaults, and by name after one that was
    /// left out.
    fn arguments(&self, params: &[Param], args: &[Term]) -> String {
        let mut is_by_name = false;
        let mut written = Vec::with_capacity(args.len());
        for (index, arg) in args.iter().enumerate() {
            let param = params.get(index);
            if param
                .and_then(|param| param.default.as_ref())
                .is_some_and(|default| is_default(default, arg, args))
            {
                is_by_name = true;
                continue;
            }
            let value = literal(arg, param.map(|param| &param.ty)).unwrap_or_else(|| self.term(arg));
            let name = param.filter(|_| is_by_name).map(|param| format!("{}: ", param.name));
            written.push(format!("{}{value}", name.unwrap_or_default()));
        }
        written.join(", ")
    }

    /// An argument of a call, a quantity with its unit.
    fn argument(&self, call: &CallNode, index: usize, arg: &Term) -> String {
        let primitive = self.0.primitives.get(call.primitive.index());
        let ty = primitive.and_then(|primitive| primitive.params.get(index)).map(|param| &param.ty);
        literal(arg, ty).unwrap_or_else(|| self.term(arg))
    }

    /// One side of a comparison; a number takes the unit of the other side.
    fn side(&self, term: &Term, other: &Term) -> String {
        literal(term, type_of(self.0, other)).unwrap_or_else(|| self.term(term))
    }

    fn call(&self, call: &CallNode) -> String {
        let primitive = self.0.primitives.get(call.primitive.index());
        let args = call.args.iter().enumerate().map(|(index, arg)| {
            let name =
                primitive.and_then(|primitive| primitive.params.get(index)).map(|param| param.name.as_str());
            format!("{}: {}", name.unwrap_or(NOBODY), self.argument(call, index, arg))
        });
        let args = args.collect::<Vec<_>>().join(", ");
        let name = primitive.map_or(NOBODY, |primitive| &primitive.name);
        let binds = call.binds.map_or_else(String::new, |id| format!("let {} = ", self.binding(id)));
        let retry = if call.retries > 0 { format!(" retry {}", call.retries) } else { String::new() };
        let manner = manner(call);
        format!("{binds}{name}({args}){manner} within {} s{retry}", call.deadline_secs)
    }

    fn ending(&self, how: Ending, part: bool, why: Option<&Term>) -> String {
        let how = match how {
            Ending::Done => "done",
            Ending::Fail => "fail",
            Ending::Cannot => "cannot",
            Ending::Replan => "replan",
        };
        let part = if part { " the sub-policy" } else { "" };
        why.map_or_else(|| format!("{how}{part}"), |why| format!("{how}{part} {}", self.term(why)))
    }

    /// A need with its quantifier and its failure.
    #[must_use]
    pub fn need(&self, need: &Need) -> String {
        format!("{}, else {}", self.needed(need), self.failure(need.failure))
    }

    /// A need with its quantifier.
    #[must_use]
    pub fn needed(&self, need: &Need) -> String {
        self.quantified(self.condition(&need.condition), need.each, need.when.as_ref())
    }

    /// A motion query with its arguments.
    #[must_use]
    pub fn motion(&self, motion: &Motion) -> String {
        format!("{}({})", motion.query, self.terms(&motion.args))
    }

    pub(super) fn effect(&self, effect: &CallEffect) -> String {
        let not = if effect.value { "" } else { "not " };
        self.quantified(format!("{not}{}", self.fact(&effect.fact)), effect.each, effect.when.as_ref())
    }

    pub(super) fn unsettled(&self, unsettled: &Unsettled) -> String {
        self.quantified(self.fact(&unsettled.fact), unsettled.each, unsettled.when.as_ref())
    }

    /// Resources and entities that end a lifetime.
    pub(super) fn lifetime(&self, lifetime: &Lifetime) -> String {
        let named =
            |id: &ResourceId| self.0.resources.get(id.index()).map_or(NOBODY, |it| &it.name).to_owned();
        let entities = lifetime.entities.iter().map(|entity| self.term(entity));
        lifetime.uses.iter().map(named).chain(entities).collect::<Vec<_>>().join(", ")
    }

    fn quantified(&self, mut text: String, each: Option<KindId>, when: Option<&Condition>) -> String {
        if let Some(kind) = each {
            let kind = self.0.kinds.get(kind.index()).map_or(NOBODY, |kind| &kind.name);
            text.push_str(&format!(" for each e: {kind}"));
        }
        if let Some(when) = when {
            text.push_str(&format!(" when {}", self.condition(when)));
        }
        text
    }

    /// A watch with its reaction.
    #[must_use]
    pub fn watch(&self, watch: &Watch) -> String {
        let hold = if watch.hold_secs > 0.0 { format!(" for {} s", watch.hold_secs) } else { String::new() };
        let reaction = match &watch.reaction {
            Reaction::Pause { within_secs: 0.0 } => "fail with timeout".to_owned(),
            Reaction::Pause { within_secs } => format!("pause within {within_secs} s"),
            Reaction::Restart { at_most } => format!("restart at most {at_most}"),
            Reaction::Resume { at_most, .. } => format!("resume at most {at_most}"),
            Reaction::End { how, of, why } => self.ending(*how, of.is_some(), why.as_ref()),
        };
        format!("when {}{hold} then {reaction}", self.condition(&watch.condition))
    }

    pub(super) fn handler(&self, handler: &Handler) -> String {
        let on = handler.on.as_ref().map_or_else(
            || "any".to_owned(),
            |on| on.iter().map(|failure| self.failure(*failure)).collect::<Vec<_>>().join(", "),
        );
        let bound = handler.binds.map(|caught| format!(" as {}", self.binding(caught.text)));
        format!("catch {on}{}", bound.unwrap_or_default())
    }

    /// A failure kind.
    #[must_use]
    pub fn failure(&self, failure: FailureId) -> &'a str {
        self.0.failures.get(failure.index()).map_or(NOBODY, |name| name)
    }

    fn binding(&self, binding: BindingId) -> &'a str {
        self.0.bindings.get(binding.index()).map_or(NOBODY, |binding| &binding.name)
    }

    fn fact(&self, fact: &Fact) -> String {
        let name = self.0.fluents.get(fact.fluent.index()).map_or(NOBODY, |fluent| &fluent.name);
        let args = fact.args.iter().map(|arg| match arg {
            FactArg::Term(term) => self.term(term),
            FactArg::Any => "any".to_owned(),
        });
        format!("{name}({})", args.collect::<Vec<_>>().join(", "))
    }

    /// A condition in the text syntax.
    #[must_use]
    pub fn condition(&self, condition: &Condition) -> String {
        match condition {
            Condition::Literal(value) => value.to_string(),
            Condition::Fact(fact) => self.fact(fact),
            Condition::Compare(comparison, left, right) => {
                let (left, right) = (self.side(left, right), self.side(right, left));
                format!("{left} {} {right}", comparison.symbol())
            }
            Condition::Not(inner) => match **inner {
                Condition::Compare(..) => format!("not ({})", self.condition(inner)),
                Condition::Literal(_)
                | Condition::Fact(_)
                | Condition::Not(_)
                | Condition::All(_)
                | Condition::AnyOf(_) => format!("not {}", self.inner(inner)),
            },
            Condition::All(parts) if parts.is_empty() => "true".to_owned(),
            Condition::AnyOf(parts) if parts.is_empty() => "false".to_owned(),
            Condition::All(parts) => self.joined(parts, " and "),
            Condition::AnyOf(parts) => self.joined(parts, " or "),
        }
    }

    fn joined(&self, parts: &[Condition], word: &str) -> String {
        parts.iter().map(|part| self.inner(part)).collect::<Vec<_>>().join(word)
    }

    /// In parentheses where it is joined of parts of its own.
    fn inner(&self, condition: &Condition) -> String {
        let text = self.condition(condition);
        match condition {
            Condition::All(parts) | Condition::AnyOf(parts) if parts.len() > 1 => format!("({text})"),
            _ => text,
        }
    }

    fn terms(&self, terms: &[Term]) -> String {
        terms.iter().map(|term| self.term(term)).collect::<Vec<_>>().join(", ")
    }

    /// A term, a text with values as its template.
    #[must_use]
    pub fn term(&self, term: &Term) -> String {
        match term {
            Term::Literal(value) => value.to_string(),
            Term::Binding(id) => self.binding(*id).to_owned(),
            Term::Each => "e".to_owned(),
            Term::Field(of, field) => format!("{}.{field}", self.term(of)),
            Term::Measure(id, args) => {
                let name = self.0.measures.get(id.index()).map_or(NOBODY, |measure| &measure.name);
                format!("{name}({})", self.terms(args))
            }
            Term::List(items) => format!("[{}]", self.terms(items)),
            Term::Arith(operation, left, right) => {
                format!("({} {} {})", self.term(left), operation.symbol(), self.term(right))
            }
            Term::Count(list) => format!("count({})", self.term(list)),
            Term::First(list) => format!("first({})", self.term(list)),
            Term::Template(parts) => {
                let parts = parts.iter().map(|part| match part {
                    TextPart::Literal(text) => text.to_string(),
                    TextPart::Value(value, ty) => {
                        format!("{{{}}}", literal(value, Some(ty)).unwrap_or_else(|| self.term(value)))
                    }
                });
                format!("{:?}", parts.collect::<String>())
            }
        }
    }
}

/// A number in SI units with the unit of its quantity; as it is where that has none.
fn with_unit(value: f64, quantity: &str) -> String {
    match in_unit(value, quantity) {
        (value, Some(unit)) => format!("{value} {unit}"),
        (value, None) => value.to_string(),
    }
}

/// A number as a literal of a type; none where it is no number, or its type no quantity.
/// Returns true if an argument is the default of its parameter.
fn is_default(default: &ParamDefault, arg: &Term, args: &[Term]) -> bool {
    match default {
        ParamDefault::Value(value) => matches!(arg, Term::Literal(given) if given == value),
        ParamDefault::Param(earlier) => args.get(*earlier as usize) == Some(arg),
    }
}

pub(super) fn literal(term: &Term, ty: Option<&Type>) -> Option<String> {
    match (term, ty) {
        #[expect(clippy::cast_precision_loss, reason = "for the eye")]
        (Term::Literal(Value::Int(value)), Some(Type::Quantity(quantity))) => {
            Some(with_unit(*value as f64, quantity))
        }
        (Term::Literal(Value::Number(value)), Some(Type::Quantity(quantity))) => {
            Some(with_unit(*value, quantity))
        }
        (_, _) => None,
    }
}

/// The type of a term as far as a graph's tables say it; that of a field does not stand there.
pub(super) fn type_of<'a>(graph: &'a Graph, term: &Term) -> Option<&'a Type> {
    match term {
        Term::Measure(id, _) => graph.measures.get(id.index()).map(|measure| &measure.result),
        Term::Binding(id) => graph.bindings.get(id.index()).map(|binding| &binding.ty),
        Term::Literal(_) | Term::Each | Term::Field(..) | Term::List(_) | Term::Arith(..) => None,
        Term::Count(_) | Term::First(_) | Term::Template(_) => None,
    }
}

/// Manner of a call, with a space before it.
fn manner(call: &CallNode) -> String {
    call.manner.map_or_else(String::new, |manner| format!(" {manner}"))
}

#[cfg(test)]
mod tests {
    use super::with_unit;

    #[test]
    fn numbers_are_written_as_people_do() {
        for (value, quantity, expected) in [
            (std::f64::consts::FRAC_PI_2, "Angle", "90 deg"),
            (0.3, "Ratio", "30 %"),
            (0.07, "Ratio", "7 %"),
            (0.5, "Length", "0.5 m"),
            (90.0, "Duration", "90 s"),
            (3.0, "", "3"),
        ] {
            assert_eq!(with_unit(value, quantity), expected);
        }
    }
}
