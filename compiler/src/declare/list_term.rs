//! Terms on lists, which the language itself has: `count(cans)`, `first(cans)`, `is_empty(cans)`. A
//! declaration of the same name replaces one. And texts with values.

use motet_syntax::Span;
use motet_syntax::ast::{Call, CompareOp, Expr, ExprKind, POSE, TextPart};
use smol_str::SmolStr;

use super::diagnostics::{LimitExceeded, MissingArgument, TooManyArguments, UnknownParameter, WrongType};
use super::elaborator::{Elaborator, ValueRole};
use crate::facts::effort;
use crate::ir::{Base, Condition, Term, Ty};

/// The number of elements.
pub(crate) const COUNT: SmolStr = SmolStr::new_static("count");
/// The first element.
pub(crate) const FIRST: SmolStr = SmolStr::new_static("first");
/// The condition that there is no element.
pub(crate) const IS_EMPTY: SmolStr = SmolStr::new_static("is_empty");
/// The parameter of all three.
pub(crate) const OF: SmolStr = SmolStr::new_static("of");

/// Maximal size of a value: its parts, and the bytes of its texts.
const MAX_SIZE: usize = 1 << 16;

impl Elaborator<'_> {
    /// Returns whether a call has a value: of a measure, of a list, or a pose.
    pub(crate) fn has_value(&self, name: &str) -> bool {
        self.library.names.measures.contains_key(name)
            || name == POSE
            || [COUNT, FIRST].iter().any(|known| known == name)
    }

    /// Elaborates `count` or `first`; `None` for another name.
    pub(super) fn of_list(&mut self, call: &Call) -> Option<(Term, Ty)> {
        let is_count = call.name.text == COUNT;
        if !is_count && call.name.text != FIRST {
            return None;
        }
        let Some((list, element)) = self.list_in(call) else { return Some((Term::Unknown, Ty::UNKNOWN)) };
        Some(match list {
            Term::List(items) if is_count => {
                (Term::Int(i64::try_from(items.len()).unwrap_or(i64::MAX)), Ty::INT)
            }
            Term::List(items) if !items.is_empty() => {
                (items.into_iter().next().unwrap_or(Term::Unknown), element)
            }
            list if is_count => (Term::Count(Box::new(list)), Ty::INT),
            list => (Term::First(Box::new(list)), element),
        })
    }

    /// Elaborates `is_empty`; `None` for another name.
    pub(super) fn is_empty_list(&mut self, call: &Call) -> Option<Condition> {
        if call.name.text != IS_EMPTY {
            return None;
        }
        Some(match self.list_in(call) {
            Some((Term::List(items), _)) => Condition::Literal(items.is_empty()),
            Some((list, _)) => {
                Condition::Compare(CompareOp::Equal, Term::Count(Box::new(list)), Term::Int(0))
            }
            None => Condition::Unknown,
        })
    }

    /// The list in a call, with the type of its elements; `None` after an error.
    fn list_in(&mut self, call: &Call) -> Option<(Term, Ty)> {
        let callee = &call.name.text;
        let Some(arg) = call.args.first() else {
            let (callee, ty) = (callee.clone(), "a list".to_owned());
            self.report(MissingArgument { span: call.span, callee, param: OF, ty });
            return None;
        };
        if let Some(other) = call.args.get(1) {
            self.report(TooManyArguments { span: other.span, callee: callee.clone(), most: 1, twice: None });
        }
        if let Some(name) = arg.name.as_ref().filter(|name| name.text != OF) {
            let (span, known) = (name.span, format!("`{OF}`"));
            let (name, callee) = (name.text.clone(), callee.clone());
            self.report(UnknownParameter { span, name, callee, near: Some(OF), known });
        }
        let place = ValueRole::Param("of", callee).to_string();
        self.list_of(&arg.value, &place)
    }

    /// Elaborates a list, and the type of its elements; `None` after an error.
    pub(crate) fn list_of(&mut self, list: &Expr, place: &str) -> Option<(Term, Ty)> {
        // In JSON the `$` may be missing.
        let bound = match &list.kind {
            ExprKind::Plain(name) => self.scope.find(name).map(|entry| entry.name.clone()),
            _ => None,
        };
        let (term, ty) = match &bound {
            Some(name) => (Term::Text(name.clone()), Ty::TEXT),
            None => self.term(list, None),
        };
        if ty.base == Base::Unknown && ty.lists == 0 {
            return None;
        }
        if let Some(element) = ty.element() {
            return Some((term, element));
        }
        let instead = bound.map(|name| format!("`\"${name}\"`"));
        self.report(WrongType {
            span: list.span,
            expected: "a list".to_owned(),
            actual: self.describe(&term, ty),
            place: place.to_owned(),
            example: None,
            instead,
        });
        None
    }

    /// Elaborates a text with values. Any value but a pose can be said.
    pub(super) fn template(&mut self, parts: &[TextPart]) -> (Term, Ty) {
        let mut said = Vec::with_capacity(parts.len());
        let mut size = 0;
        for part in parts {
            said.push(match part {
                TextPart::Literal(text) => (Term::Text(text.clone()), Ty::TEXT),
                TextPart::Value(value) => {
                    let (term, ty) = self.said(value);
                    (self.bounded(term, value.span, &mut size), ty)
                }
            });
        }
        if said.iter().any(|(term, _)| *term == Term::Unknown) {
            return (Term::Unknown, Ty::TEXT);
        }
        (Term::Template(said), Ty::TEXT)
    }

    /// The part of a value whose other parts have a size. A name stands for its value, so a few lines could
    /// ask for any number of parts.
    pub(super) fn bounded(&mut self, part: Term, span: Span, size: &mut usize) -> Term {
        if *size > MAX_SIZE {
            // It was reported.
            return Term::Unknown;
        }
        let added = part.size();
        effort::spend(added / 16);
        *size = size.saturating_add(added);
        if *size <= MAX_SIZE {
            return part;
        }
        self.report(LimitExceeded { span, what: "parts and bytes of text in a value", limit: MAX_SIZE });
        Term::Unknown
    }

    fn said(&mut self, value: &Expr) -> (Term, Ty) {
        let (term, ty) = self.term(value, None);
        if ty.base == Base::Pose {
            self.unsayable(value.span, &term, ty);
            return (Term::Unknown, Ty::UNKNOWN);
        }
        (term, ty)
    }

    fn unsayable(&mut self, span: Span, term: &Term, ty: Ty) {
        self.report(WrongType {
            span,
            expected: "a value that can be said".to_owned(),
            actual: self.describe(term, ty),
            place: "a text".to_owned(),
            example: None,
            instead: None,
        });
    }
}
