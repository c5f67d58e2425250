//! Terms, conditions and values in Python.

use smol_str::SmolStr;

use super::writer::Writer;
use crate::model::{Condition, Fact, FactArg, Term, TextPart, Type, Value};

/// A text as a literal of Python: JSON's escapes are among those of Python.
pub(super) fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

impl Writer<'_> {
    pub(super) fn condition(&mut self, condition: &Condition) -> String {
        match condition {
            Condition::Literal(value) => (if *value { "True" } else { "False" }).to_owned(),
            Condition::Fact(fact) => self.fact(fact),
            Condition::Compare(comparison, left, right) => {
                let (left, right) = (self.term(left, None), self.term(right, None));
                format!("compare({left}, \"{}\", {right})", comparison.symbol())
            }
            Condition::Not(inner) => format!("no({})", self.condition(inner)),
            Condition::All(parts) => format!("all_of({})", self.conditions(parts)),
            Condition::AnyOf(parts) => format!("any_of({})", self.conditions(parts)),
        }
    }

    fn conditions(&mut self, parts: &[Condition]) -> String {
        parts.iter().map(|part| self.condition(part)).collect::<Vec<_>>().join(", ")
    }

    pub(super) fn fact(&mut self, fact: &Fact) -> String {
        let graph = self.graph;
        let fluent = graph.fluents.get(fact.fluent.index());
        let mut text = format!("fact({}", quoted(fluent.map_or("", |fluent| &fluent.name)));
        for (index, arg) in fact.args.iter().enumerate() {
            let ty = fluent.and_then(|fluent| fluent.params.get(index));
            let arg = match arg {
                FactArg::Any => "ANY".to_owned(),
                FactArg::Term(term) => self.term(term, ty),
            };
            text.push_str(&format!(", {arg}"));
        }
        text + ")"
    }

    /// A term where a value of a type is wanted. The entities in it are noted.
    pub(super) fn term(&mut self, term: &Term, ty: Option<&Type>) -> String {
        match term {
            Term::Literal(value) => self.value(value, ty),
            Term::Binding(id) => self.binding(*id),
            Term::Each => "EACH".to_owned(),
            Term::Field(of, name) => format!("field({}, {})", self.term(of, None), quoted(name)),
            Term::Measure(id, args) => {
                let graph = self.graph;
                let measure = graph.measures.get(id.index());
                let mut text = format!("measure({}", quoted(measure.map_or("", |measure| &measure.name)));
                for (index, arg) in args.iter().enumerate() {
                    let ty = measure.and_then(|measure| measure.params.get(index));
                    text.push_str(&format!(", {}", self.term(arg, ty)));
                }
                text + ")"
            }
            Term::List(items) => {
                let inner = inner(ty).cloned();
                let items: String =
                    items.iter().map(|item| format!("{}, ", self.term(item, inner.as_ref()))).collect();
                format!("({items})")
            }
            Term::Arith(operation, left, right) => {
                let (left, right) = (self.term(left, None), self.term(right, None));
                format!("arith({left}, \"{}\", {right})", operation.symbol())
            }
            Term::Count(list) => format!("count({})", self.term(list, None)),
            Term::First(list) => {
                let list_type = ty.map(|ty| Type::List(Box::new(ty.clone())));
                format!("first({})", self.term(list, list_type.as_ref()))
            }
            Term::Template(parts) => {
                let parts: Vec<String> = parts
                    .iter()
                    .map(|part| match part {
                        TextPart::Literal(text) => quoted(text),
                        TextPart::Value(value, ty) => {
                            let kind = quoted(&self.graph.type_name(ty));
                            format!("({}, {kind})", self.term(value, Some(ty)))
                        }
                    })
                    .collect();
                format!("said({})", parts.join(", "))
            }
        }
    }

    fn value(&mut self, value: &Value, ty: Option<&Type>) -> String {
        match value {
            Value::Bool(true) => "True".to_owned(),
            Value::Bool(false) => "False".to_owned(),
            Value::Int(value) => value.to_string(),
            Value::Number(value) => format!("{value:?}"),
            Value::Text(text) => format!("Text({})", quoted(text)),
            Value::Entity(id) => {
                if let Some(Type::Entity(kind)) = ty {
                    self.hear(id, *kind);
                } else {
                    self.hear_unsorted(id);
                }
                format!("Entity({})", quoted(id))
            }
            Value::Case(case) => format!("Case({})", quoted(case)),
            Value::Pose(pose) => {
                let list = |numbers: &[f64]| {
                    let numbers: Vec<String> = numbers.iter().map(|number| format!("{number:?}")).collect();
                    format!("({})", numbers.join(", "))
                };
                format!("Pose({}, {})", list(&pose.xyz), list(&pose.quaternion))
            }
            Value::List(items) => {
                let inner = inner(ty).cloned();
                let items: String =
                    items.iter().map(|item| format!("{}, ", self.value(item, inner.as_ref()))).collect();
                format!("({items})")
            }
        }
    }

    /// Notes an entity of which no kind is said: it may be of any.
    fn hear_unsorted(&mut self, id: &SmolStr) {
        if !self.entities.iter().any(|(known, _)| known == id)
            && let Some(root) = self.graph.kinds.iter().position(|kind| kind.parent.is_none())
            && let Ok(root) = u32::try_from(root)
        {
            self.hear(id, crate::model::KindId(root));
        }
    }
}

fn inner(ty: Option<&Type>) -> Option<&Type> {
    if let Some(Type::List(inner)) = ty { Some(inner) } else { None }
}
