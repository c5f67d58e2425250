//! Elaboration of terms: value and type together, since the type that is expected decides how a plain string
//! of the JSON syntax is read.

use motet_syntax::ast::{Expr, ExprKind, Name};
use motet_syntax::effort::ErrorCount;
use motet_syntax::unit::{Dimension, Unit};
use motet_syntax::{About, Diagnostic, Span, Syntax};
use rustc_hash::{FxHashMap, FxHashSet};
use smol_str::{SmolStr, format_smolstr};

use super::diagnostics::{
    MisplacedAny, MissingUnit, NotACondition, OutOfRange, UnknownField, UnknownFluent, WrongType,
};
use super::list_term::{COUNT, FIRST, IS_EMPTY};
use super::name::{Scope, article, list, near};
use crate::declare::Library;
use crate::ir::{Base, Binding, Entities, ROBOT, Term, Ty};

/// Elaborates expressions in one scope.
pub(crate) struct Elaborator<'a> {
    pub(crate) library: &'a Library,
    pub(crate) entities: &'a Entities,
    /// True if there is a scene; without one an unknown name may be an entity of it.
    pub(crate) has_scene: bool,
    /// Syntax of the document: in text a quantity needs its unit.
    pub(crate) form: Syntax,
    pub(crate) scope: Scope,
    pub(crate) bindings: Vec<Binding>,
    /// Names of which a use was reported that nothing binds, with the places of the reports.
    pub(crate) unbound: FxHashMap<SmolStr, usize>,
    /// Bindings of which a use without a value was reported, by the span where they are bound.
    pub(crate) unbound_told: FxHashSet<Span>,
    /// True behind a step that could not be read, which may have bound any name.
    pub(crate) is_behind_gap: bool,
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) errors: ErrorCount,
}

/// Expectation at the place of a value: its type and, for messages, its role.
#[derive(Clone, Copy)]
pub(crate) struct Expected<'a> {
    pub(crate) ty: Ty,
    pub(crate) place: ValueRole<'a>,
}

/// Role of a value in its step, for messages.
#[derive(Clone, Copy)]
pub(crate) enum ValueRole<'a> {
    /// Parameter and callee.
    Param(&'a str, &'a str),
    /// A role with a name of its own: "a deadline".
    Named(&'static str),
}

impl ValueRole<'_> {
    pub(super) fn about(self) -> Option<About> {
        match self {
            Self::Param(param, callee) => Some(About::parameter(callee, param)),
            Self::Named(_) => None,
        }
    }
}

impl std::fmt::Display for ValueRole<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Param(param, callee) => write!(f, "`{param}` of `{callee}`"),
            Self::Named(name) => f.write_str(name),
        }
    }
}

impl<'a> Elaborator<'a> {
    /// Elaborator outside of any policy, without bindings.
    pub(crate) fn new(library: &'a Library, entities: &'a Entities, has_scene: bool, form: Syntax) -> Self {
        let (scope, bindings, diagnostics) = (Scope::default(), Vec::new(), Vec::new());
        let (unbound, unbound_told) = (FxHashMap::default(), FxHashSet::default());
        let is_behind_gap = false;
        Self {
            library,
            entities,
            has_scene,
            form,
            scope,
            bindings,
            unbound,
            unbound_told,
            is_behind_gap,
            diagnostics,
            errors: ErrorCount::default(),
        }
    }

    /// Returns whether there are more errors than are told.
    pub(crate) fn has_too_many_errors(&mut self) -> bool {
        self.errors.is_too_many(self.diagnostics.iter())
    }

    pub(crate) fn report(&mut self, mistake: impl Into<Diagnostic>) {
        self.diagnostics.push(mistake.into());
    }

    /// Elaborates a value that must have the expected type.
    /// One value stands for a list of it.
    pub(crate) fn term_of(&mut self, expr: &Expr, wanted: Expected<'_>) -> Term {
        if let Some(only) = self.only_value(expr, wanted.ty) {
            return self.term_of(only, wanted);
        }
        let element = wanted.ty.element().filter(|_| !matches!(expr.kind, ExprKind::List(_)));
        let (mut term, mut ty) =
            self.term(expr, Some(element.map_or(wanted, |ty| Expected { ty, ..wanted })));
        if element.is_some_and(|element| ty.base != Base::Unknown && self.library.fits(element, ty)) {
            (term, ty) = (Term::List(vec![term]), ty.list());
        }
        if self.library.fits(wanted.ty, ty) {
            return match (term, wanted.ty) {
                // A whole number where a number is asked for.
                (Term::Int(value), Ty { base: Base::Number, .. }) => Term::Number(value as f64),
                (Term::Number(value), ty) if ty == Ty::RATIO => {
                    self.ratio(value, expr, &wanted.place.to_string())
                }
                (term, _) => term,
            };
        }
        self.report_type(expr, (&term, ty), wanted);
        Term::Unknown
    }

    /// Reports a value that does not have the expected type.
    fn report_type(&mut self, expr: &Expr, (term, ty): (&Term, Ty), wanted: Expected<'_>) {
        let actual = self.describe(term, ty);
        let expected = article(&self.library.type_name(wanted.ty));
        let example = self.example(wanted.ty);
        let instead = self.instead(term, expr, wanted.ty);
        let place = wanted.place.to_string();
        self.report(WrongType { span: expr.span, expected, actual, place, example, instead });
    }

    /// Elaborates a value of any type; the expectation resolves ambiguous notation.
    pub(crate) fn term(&mut self, expr: &Expr, wanted: Option<Expected<'_>>) -> (Term, Ty) {
        match &expr.kind {
            ExprKind::Bool(value) => (Term::Bool(*value), Ty::BOOL),
            ExprKind::Number(value) => self.number(*value, expr.span, wanted),
            ExprKind::Quantity(value, unit) => {
                (Term::Number(unit.to_si(*value)), Ty::plain(Base::Quantity(unit.dimension())))
            }
            ExprKind::Text(text) => (Term::Text(text.clone()), Ty::TEXT),
            ExprKind::Template(parts) => self.template(parts),
            ExprKind::Name(name) => self.name(name, expr.span, wanted),
            ExprKind::Binding(name) => self.binding(name, expr.span, wanted),
            ExprKind::Plain(text) => match self.value_in_string(text, expr.span, wanted) {
                Some(found) => found,
                None => self.plain(text, expr.span, wanted),
            },
            ExprKind::Wrong(_) => (Term::Unknown, Ty::UNKNOWN),
            ExprKind::Any => {
                self.report(MisplacedAny { span: expr.span });
                (Term::Unknown, Ty::UNKNOWN)
            }
            ExprKind::List(items) if wanted.is_some_and(|wanted| wanted.ty == Ty::plain(Base::Pose)) => {
                self.pose(&items.iter().collect::<Vec<_>>(), expr.span)
            }
            ExprKind::List(items) => self.list(items, wanted),
            ExprKind::Call(call) => self.measure(call),
            ExprKind::Field(of, name) => self.field(of, name),
            ExprKind::Arith(op, left, right) => self.arith(*op, left, right, expr.span),
            ExprKind::Not(_) | ExprKind::All(_) | ExprKind::AnyOf(_) | ExprKind::Compare(..) => {
                self.report(NotACondition { span: expr.span, found: "a condition", wanted: "a value" });
                (Term::Unknown, Ty::UNKNOWN)
            }
        }
    }

    /// Checks a literal ratio, which must lie in 0..=1.
    pub(super) fn ratio(&mut self, value: f64, expr: &Expr, place: &str) -> Term {
        if (0.0..=1.0).contains(&value) {
            return Term::Number(value);
        }
        let written = |part: f64| match &expr.kind {
            ExprKind::Number(_) => part.to_string(),
            _ => format!("{} %", percent(part)),
        };
        // A bare number of more than all was meant in percent.
        let is_percent = matches!(expr.kind, ExprKind::Number(_)) && (2.0..=100.0).contains(&value);
        let meant = is_percent.then(|| ((value / 100.0).to_string(), format!("{value} %")));
        self.report(OutOfRange {
            span: expr.span,
            place: place.to_owned(),
            least: written(0.0),
            greatest: written(1.0),
            actual: written(value),
            meant,
        });
        Term::Unknown
    }

    fn number(&mut self, value: f64, span: Span, wanted: Option<Expected<'_>>) -> (Term, Ty) {
        if let Some(Expected { ty: Ty { base: Base::Quantity(dimension), lists: 0 }, .. }) = wanted {
            if self.form == Syntax::Text {
                // A number beyond a full turn is meant in degrees.
                let unit = match dimension {
                    Dimension::NONE => "%",
                    Dimension::ANGLE if value.abs() > std::f64::consts::TAU => "deg",
                    _ => dimension.si_symbol(),
                };
                if !unit.is_empty() {
                    // As a ratio where it can be one, else it was meant in percent.
                    let is_ratio = dimension == Dimension::NONE && (0.0..=1.0).contains(&value);
                    let (written, value) = (value.to_string(), if is_ratio { percent(value) } else { value });
                    let others = list(Unit::symbols_of(dimension).map(SmolStr::new));
                    let ty = dimension.type_name().unwrap_or("quantity").to_owned();
                    self.report(MissingUnit { span, written, value: value.to_string(), unit, ty, others });
                    return (Term::Unknown, Ty::UNKNOWN);
                }
            }
            return (Term::Number(value), Ty::plain(Base::Quantity(dimension)));
        }
        // A whole number, unless a number is asked for; beyond 2^53 a double is no longer exact.
        if value.fract() == 0.0 && value.abs() <= 9_007_199_254_740_992.0 {
            return (Term::Int(value as i64), Ty::INT);
        }
        (Term::Number(value), Ty::plain(Base::Number))
    }

    fn list(&mut self, items: &[Expr], wanted: Option<Expected<'_>>) -> (Term, Ty) {
        let element =
            wanted.and_then(|wanted| Some(Expected { ty: wanted.ty.element()?, place: wanted.place }));
        let Some(element) = element else { return self.list_of_any(items) };
        let mut size = 0;
        let terms = items.iter().map(|item| {
            let term = self.term_of(item, element);
            self.bounded(term, item.span, &mut size)
        });
        (Term::List(terms.collect()), element.ty.list())
    }

    /// Elaborates a list whose elements may have any type: it is a list of the nearest type that all of them
    /// have.
    fn list_of_any(&mut self, items: &[Expr]) -> (Term, Ty) {
        let (mut ty, mut size) = (Ty::UNKNOWN, 0);
        let mut terms = Vec::with_capacity(items.len());
        for (index, item) in items.iter().enumerate() {
            let before = Expected { ty, place: ValueRole::Named("an element of this list") };
            let (mut term, actual) = self.term(item, (index > 0).then_some(before));
            match self.library.common(ty, actual) {
                _ if index == 0 => ty = actual,
                Some(common) => ty = common,
                None => {
                    self.report_type(item, (&term, actual), before);
                    term = Term::Unknown;
                }
            }
            terms.push(self.bounded(term, item.span, &mut size));
        }
        if ty == Ty::plain(Base::Number) {
            for term in &mut terms {
                if let Term::Int(value) = *term {
                    *term = Term::Number(value as f64);
                }
            }
        }
        (Term::List(terms), ty.list())
    }

    fn measure(&mut self, call: &motet_syntax::ast::Call) -> (Term, Ty) {
        let library = self.library;
        let Some(id) = library.names.measures.get(&call.name.text).copied() else {
            if let Some(found) = self.of_list(call).or_else(|| self.of_pose(call)) {
                return found;
            }
            if library.names.fluents.contains_key(&call.name.text) || call.name.text == IS_EMPTY {
                self.report(NotACondition { span: call.span, found: "a condition", wanted: "a value" });
            } else {
                let own = [COUNT, FIRST];
                let known = library.measures.iter().map(|def| &def.name).chain(&own);
                self.report(UnknownFluent::new(&call.name, "measure", known));
            }
            return (Term::Unknown, Ty::UNKNOWN);
        };
        let Some(def) = library.measure(id) else { return (Term::Unknown, Ty::UNKNOWN) };
        let args = self.arguments(call, &def.params);
        (Term::Measure(id, args.into_iter().map(|arg| arg.unwrap_or(Term::Unknown)).collect()), def.result)
    }

    fn field(&mut self, of: &Expr, name: &Name) -> (Term, Ty) {
        let (term, ty) = self.term(of, None);
        let library = self.library;
        if ty == Ty::plain(Base::Failure) {
            return self.part_of_failure(term, name);
        }
        if term == Term::Entity(ROBOT) {
            if let Some((value, ty)) = library.numbers.get(&name.text) {
                return (Term::Number(*value), *ty);
            }
            if library.robot.is_empty() {
                return (Term::Field(Box::new(term), name.text.clone()), Ty::UNKNOWN);
            }
        }
        let Some(kind) = ty.kind() else {
            if ty.base != Base::Unknown {
                let of = library.type_name(ty);
                let (known, owners) = (String::new(), String::new());
                let (span, name) = (name.span, name.text.clone());
                self.report(UnknownField { span, name, of, near: None, known, owners });
            }
            return (Term::Unknown, Ty::UNKNOWN);
        };
        match library.field(kind, &name.text) {
            Some(ty) => (Term::Field(Box::new(term), name.text.clone()), ty),
            None => {
                let robot = (term == Term::Entity(ROBOT)).then(|| library.numbers.keys());
                let fields = library.fields_of(kind).chain(robot.into_iter().flatten());
                let near = near(&name.text, fields.map(SmolStr::as_str));
                let owners = library.kinds.iter().filter(|def| def.fields.contains_key(&name.text));
                let owners = list(owners.map(|def| def.name.clone()));
                let of = format_smolstr!("`{}`", library.type_name(ty)).to_string();
                let known = match term {
                    Term::Entity(ROBOT) => list(library.numbers.keys().cloned()),
                    _ => list(library.fields_of(kind).cloned()),
                };
                self.report(UnknownField {
                    span: name.span,
                    name: name.text.clone(),
                    of,
                    near,
                    known,
                    owners,
                });
                (Term::Unknown, Ty::UNKNOWN)
            }
        }
    }
}

impl Elaborator<'_> {
    /// The kind or the text of a failure. Only a name that a `catch` gives has the kind.
    fn part_of_failure(&mut self, failure: Term, name: &Name) -> (Term, Ty) {
        let known = match (name.text.as_str(), failure) {
            (KIND, Term::Caught(kind, _)) => {
                return (Term::Binding(kind), Ty::plain(Base::Enum(self.library.failure_kinds())));
            }
            (TEXT, Term::Caught(_, text)) => return (Term::Binding(text), Ty::TEXT),
            (TEXT, failure) => return (failure, Ty::TEXT),
            (_, Term::Caught(..)) => [KIND, TEXT].as_slice(),
            (_, _) => &[TEXT],
        };
        let near = near(&name.text, known.iter().copied());
        let (span, name, of) = (name.span, name.text.clone(), "a failure".to_owned());
        let known = list(known.iter().copied().map(SmolStr::new_static));
        self.report(UnknownField { span, name, of, near, known, owners: String::new() });
        (Term::Unknown, Ty::UNKNOWN)
    }
}

/// Fields of a failure.
pub(crate) const KIND: &str = "kind";
pub(crate) const TEXT: &str = "text";

/// Converts a ratio to percent, rounded to hide the noise of binary fractions.
pub(crate) fn percent(ratio: f64) -> f64 {
    (ratio * 1e11).round() / 1e9
}

/// Parses a quantity in a JSON string: "20 cm", "80%".
pub(crate) fn parse_quantity(text: &str) -> Option<(f64, Unit)> {
    let text = text.trim();
    let split = text.find(|c: char| !matches!(c, '0'..='9' | '.' | '-' | '+' | 'e' | 'E'))?;
    let (number, unit) = text.split_at_checked(split)?;
    let value: f64 = number.parse().ok()?;
    Some((value, Unit::parse(unit.trim())?)).filter(|_| value.is_finite())
}
