//! Completion of values, by the types that are asked for, and of conditions.

use motet_compiler::signature::{Signatures, Type};
use motet_syntax::ast::{Call, Expr, ExprKind, TextPart};
use motet_syntax::print::identifier;
use motet_syntax::text::MAX_TEXT_VALUES;
use motet_syntax::unit::Dimension;
use motet_syntax::{Span, Syntax};
use rustc_hash::FxHashSet;
use smol_str::{SmolStr, format_smolstr};

use super::OutsideSubset;
use super::print::{Item, Node, Value};
use crate::grammar::{Grammar, NodeKind, Relation};
use crate::subset::{self, Decimal, NumberRange, Subset};

/// The state of completing one policy.
pub(super) struct Completer<'a> {
    pub(super) grammar: &'a Grammar,
    pub(super) signatures: &'a Signatures,
    pub(super) subset: Subset,
    /// The names bound so far, in order.
    pub(super) bound: Vec<SmolStr>,
    /// Those that are bound to a list.
    pub(super) lists: FxHashSet<SmolStr>,
    /// Every name that is bound anywhere in the policy.
    pub(super) names: FxHashSet<SmolStr>,
    pub(super) fresh: usize,
    /// The steps of a cleanup are being completed.
    pub(super) in_cleanup: bool,
}

impl Completer<'_> {
    pub(super) fn is_bound(&self, name: &str) -> bool {
        self.bound.iter().any(|bound| bound == name)
    }

    /// A value of a type; `card` bounds a number, in SI units.
    pub(super) fn value(
        &self,
        expr: &Expr,
        ty: &Type,
        card: Option<(f64, f64)>,
    ) -> Result<Value, OutsideSubset> {
        match (&expr.kind, ty) {
            // One value stands for a list of it.
            (ExprKind::Name(name) | ExprKind::Binding(name), Type::List(element))
                if (self.is_bound(name) && !self.lists.contains(name))
                    || matches!(expr.kind, ExprKind::Name(_)) && self.is_known(name, element) =>
            {
                Ok(Value::List(vec![self.value(expr, element, None)?]))
            }
            (ExprKind::Plain(_) | ExprKind::Text(_), Type::List(element)) => {
                Ok(Value::List(vec![self.value(expr, element, None)?]))
            }
            (ExprKind::Call(call), Type::Entity(_)) if self.is_term(call, "first") => {
                self.list_name(call).map(Value::First)
            }
            (ExprKind::Call(call), Type::Pose) if call.is_pose() && self.grammar.has_poses() => {
                self.pose(call.args.iter().map(|arg| &arg.value), expr)
            }
            (ExprKind::List(numbers), Type::Pose) => self.pose(numbers.iter(), expr),
            (ExprKind::Field(of, name), Type::Text) if name.text == "text" => {
                let of = self.caught_name(of).ok_or_else(|| {
                    outside(expr.span, "a value that is calculated has no place in the canonical subset")
                })?;
                self.written(format_smolstr!("{{{of}.text}}"), expr)
            }
            (ExprKind::Binding(name), _) => self.binding(name, expr),
            (ExprKind::Name(name), _) => self.named(name, expr, ty),
            (ExprKind::Plain(text) | ExprKind::Text(text), Type::Text) => self.text(text, expr),
            (ExprKind::Template(parts), Type::Text) => self.template(parts, expr),
            (ExprKind::Plain(name), Type::Entity(_) | Type::Enum(_)) => {
                let known = self.is_known(name, ty);
                known.then(|| Value::Name(name.clone())).ok_or_else(|| {
                    outside(expr.span, format!("`{name}` is no `{}`", self.signatures.type_name(ty)))
                })
            }
            (ExprKind::Plain(text), Type::Quantity(dimension)) => {
                let quantity = motet_syntax::unit::parse_quantity(text);
                let quantity = quantity.filter(|(_, unit)| unit.dimension() == *dimension);
                let (value, unit) = quantity
                    .ok_or_else(|| outside(expr.span, format!("`{text}` is no quantity of that type")))?;
                self.number(unit.to_si(value), expr, ty, card)
            }
            (ExprKind::Quantity(value, unit), Type::Quantity(dimension))
                if unit.dimension() == *dimension =>
            {
                self.number(unit.to_si(*value), expr, ty, card)
            }
            (ExprKind::Number(value), Type::Int | Type::Number | Type::Quantity(_)) => {
                self.number(*value, expr, ty, card)
            }
            (ExprKind::Bool(value), Type::Bool) => Ok(Value::Bool(*value)),
            (ExprKind::List(items), Type::List(element)) => {
                if items.is_empty() || items.len() > subset::MAX_ITEMS {
                    return Err(outside(expr.span, format!("a list has 1 to {} values", subset::MAX_ITEMS)));
                }
                items
                    .iter()
                    .map(|item| self.value(item, element, None))
                    .collect::<Result<_, _>>()
                    .map(Value::List)
            }
            (ExprKind::Call(_) | ExprKind::Field(..) | ExprKind::Arith(..), _) => {
                Err(outside(expr.span, "a value that is calculated has no place in the canonical subset"))
            }
            _ => {
                let ty = self.signatures.type_name(ty);
                Err(outside(
                    expr.span,
                    format!("this is no value of the type `{ty}` in the canonical subset"),
                ))
            }
        }
    }

    /// A pose by its numbers, of which the height may be left out.
    fn pose<'e>(&self, numbers: impl Iterator<Item = &'e Expr>, expr: &Expr) -> Result<Value, OutsideSubset> {
        let why = "a pose has three coordinates and an angle, each a number, in the canonical subset";
        let numbers: Vec<&Expr> = numbers.collect();
        let [length, angle] = [Dimension::LENGTH, Dimension::ANGLE].map(Type::Quantity);
        let number = |number: &Expr, ty: &Type| match self.value(number, ty, None)? {
            Value::Number(number, _) => Ok(number),
            _ => Err(outside(number.span, why)),
        };
        let ([x, y, yaw], z) = match numbers.as_slice() {
            [x, y, yaw] => ([*x, *y, *yaw], Decimal { units: 0, decimals: 3 }),
            [x, y, z, yaw] => ([*x, *y, *yaw], number(z, &length)?),
            _ => return Err(outside(expr.span, why)),
        };
        Ok(Value::Pose([number(x, &length)?, number(y, &length)?, z, number(yaw, &angle)?]))
    }

    /// A name that a text says: in both syntaxes no word of the language.
    fn said_name(&self, name: &SmolStr, span: Span) -> Result<SmolStr, OutsideSubset> {
        if identifier(name) != *name {
            return Err(outside(span, format!("`{name}` is a word of the language, which no text says")));
        }
        self.new_name(name, span)
    }

    /// The name before a field of a failure. Whether it is that of one is the checker's business.
    pub(super) fn caught_name(&self, expr: &Expr) -> Option<SmolStr> {
        match &expr.kind {
            ExprKind::Name(name) | ExprKind::Binding(name) if self.grammar.has_caught() => {
                self.new_name(name, expr.span).ok()
            }
            _ => None,
        }
    }

    fn number(
        &self,
        value: f64,
        expr: &Expr,
        ty: &Type,
        card: Option<(f64, f64)>,
    ) -> Result<Value, OutsideSubset> {
        let range = NumberRange::of(ty, card);
        let number = range.and_then(|range| Some(Value::Number(range.nearest(value)?, range.unit)));
        number.ok_or_else(|| {
            outside(expr.span, format!("{value} is beyond the numbers of the canonical subset"))
        })
    }

    /// The call is a term of the language on a list.
    pub(super) fn is_term(&self, call: &Call, term: &str) -> bool {
        call.name.text == term && self.grammar.has_term(term)
    }

    /// The name of the list of a term on one.
    pub(super) fn list_name(&self, call: &Call) -> Result<SmolStr, OutsideSubset> {
        let name = match call.args.as_slice() {
            [list] => match &list.value.kind {
                ExprKind::Name(name) | ExprKind::Binding(name) => Some(name),
                _ => None,
            },
            _ => None,
        };
        let why = "a term on a list is about a bound name in the canonical subset";
        name.ok_or_else(|| outside(call.span, why)).and_then(|name| self.new_name(name, call.span))
    }

    /// A text with values, each of them a bound name, or the length or the first element of a list.
    fn template(&self, parts: &[TextPart], expr: &Expr) -> Result<Value, OutsideSubset> {
        let values = parts.iter().filter(|part| matches!(part, TextPart::Value(_))).count();
        if values > MAX_TEXT_VALUES {
            return Err(outside(expr.span, format!("a text has at most {MAX_TEXT_VALUES} values")));
        }
        let mut written = String::new();
        for part in parts {
            match part {
                TextPart::Literal(text) => written.push_str(&doubled(text)),
                TextPart::Value(value) => match &value.kind {
                    // An unknown name is the checker's business.
                    ExprKind::Name(name) | ExprKind::Binding(name) => {
                        let name = self.said_name(name, value.span)?;
                        written.push_str(&format!("{{{name}}}"));
                    }
                    ExprKind::Call(call) if self.is_term(call, "count") || self.is_term(call, "first") => {
                        let list = self.list_name(call)?;
                        let mark = if self.subset.syntax == Syntax::Json { "$" } else { "" };
                        written.push_str(&format!("{{{}({mark}{list})}}", call.name.text));
                    }
                    ExprKind::Field(of, field)
                        if let (Some(of), "kind" | "text") = (self.caught_name(of), field.text.as_str()) =>
                    {
                        let of = self.said_name(&of, value.span)?;
                        written.push_str(&format!("{{{of}.{}}}", field.text));
                    }
                    _ => {
                        let why = "a value in a text is a bound name, `count` or `first` of one, or `kind` \
                                   or `text` of a failure, in the canonical subset";
                        return Err(outside(value.span, why));
                    }
                },
            }
        }
        self.written(written.into(), expr)
    }

    fn text(&self, text: &SmolStr, expr: &Expr) -> Result<Value, OutsideSubset> {
        self.written(doubled(text), expr)
    }

    fn written(&self, text: SmolStr, expr: &Expr) -> Result<Value, OutsideSubset> {
        if subset::is_text(&text) {
            return Ok(Value::Text(text));
        }
        let most = subset::MAX_TEXT_CHARS;
        Err(outside(
            expr.span,
            format!("a text has 1 to {most} characters of ASCII, no `\"` and no `\\`, no `$` first"),
        ))
    }

    fn named(&self, name: &SmolStr, expr: &Expr, ty: &Type) -> Result<Value, OutsideSubset> {
        if self.is_bound(name) {
            return self.binding(name, expr);
        }
        if self.is_known(name, ty) {
            return Ok(Value::Name(name.clone()));
        }
        // An unknown name is the checker's business.
        self.binding(name, expr)
    }

    /// The name is an entity or a case of the type.
    fn is_known(&self, name: &str, ty: &Type) -> bool {
        match ty {
            Type::Entity(kind) => self
                .signatures
                .entities
                .iter()
                .any(|(entity, of)| entity == name && self.signatures.is_kind(*of, *kind)),
            Type::Enum(id) => {
                self.signatures.enums.get(*id).is_some_and(|def| def.cases.iter().any(|case| case == name))
            }
            _ => false,
        }
    }

    pub(super) fn binding(&self, name: &SmolStr, expr: &Expr) -> Result<Value, OutsideSubset> {
        self.new_name(name, expr.span).map(Value::Binding)
    }

    /// The list of an `each`: a name, or entities of one kind, since the first decides what the others may
    /// be.
    pub(super) fn each_list(&self, expr: &Expr) -> Result<Value, OutsideSubset> {
        const ROOT: usize = 0;
        let ty = Type::List(Box::new(Type::Entity(ROOT)));
        let list = match &expr.kind {
            ExprKind::Name(name) => self.named(name, expr, &ty)?,
            ExprKind::Binding(name) => self.binding(name, expr)?,
            _ => self.value(expr, &ty, None)?,
        };
        let kind = |value: &Value| match value {
            Value::Name(name) => {
                self.signatures.entities.iter().find(|(entity, _)| entity == name).map(|row| row.1)
            }
            _ => None,
        };
        let is_alike = match &list {
            Value::List(items) => {
                let first = items.first().and_then(kind);
                first.is_some() && items.iter().all(|item| kind(item) == first)
            }
            Value::Binding(_) => true,
            Value::Name(_) | Value::Number(..) | Value::Text(_) | Value::Bool(_) => false,
            Value::Any | Value::First(_) | Value::Pose(_) => false,
        };
        let why = "the list of an `each` is a name, or entities of one kind, in the canonical subset";
        if is_alike { Ok(list) } else { Err(outside(expr.span, why)) }
    }

    /// A time in seconds, within a range.
    pub(super) fn seconds(&self, expr: &Expr, range: NumberRange) -> Result<Item, OutsideSubset> {
        match self.value(expr, &Type::Quantity(Dimension::DURATION), None)? {
            Value::Number(number, _) if range.contains(number) => Ok(Item::Number(number)),
            _ => Err(outside(expr.span, "a time is a number of seconds in the canonical subset")),
        }
    }

    /// A whole number from `least` to `greatest`.
    pub(super) fn count(&self, expr: &Expr, least: u32, greatest: u32) -> Result<Item, OutsideSubset> {
        let whole = match &expr.kind {
            ExprKind::Number(value) => NumberRange::whole(least, greatest).nearest(*value),
            _ => None,
        };
        whole.map(Item::Number).ok_or_else(|| {
            outside(expr.span, format!("a count is from {least} to {greatest} in the canonical subset"))
        })
    }

    /// A condition; `depth` more may be nested in it.
    pub(super) fn condition(&self, expr: &Expr, depth: usize) -> Result<Node, OutsideSubset> {
        let node = |kind, items| Node { kind, span: expr.span, name: None, items };
        let within = || {
            depth.checked_sub(1).ok_or_else(|| {
                let most = subset::MAX_CONDITION_DEPTH;
                outside(
                    expr.span,
                    format!("conditions stand at most {most} deep in one another in the canonical subset"),
                )
            })
        };
        match &expr.kind {
            ExprKind::Call(call) if self.is_term(call, "is_empty") => {
                let list = Value::Binding(self.list_name(call)?);
                Ok(node(NodeKind::IsEmpty, vec![Item::Value(list)]))
            }
            ExprKind::Call(call) => {
                let (number, fluent) = numbered(&self.signatures.fluents, |row| row.name == call.name.text)
                    .ok_or_else(|| {
                    outside(expr.span, format!("there is no fluent `{}`", call.name.text))
                })?;
                Ok(node(NodeKind::Is(number), self.observed(call, &fluent.params, true)?))
            }
            ExprKind::Not(inner) => {
                Ok(node(NodeKind::Not, vec![Item::Node(self.condition(inner, within()?)?)]))
            }
            ExprKind::All(parts) | ExprKind::AnyOf(parts) => {
                if let [only] = parts.as_slice() {
                    return self.condition(only, depth);
                }
                if parts.is_empty() || parts.len() > subset::MAX_MEMBERS {
                    let most = subset::MAX_MEMBERS;
                    return Err(outside(
                        expr.span,
                        format!("2 to {most} conditions stand beside one another"),
                    ));
                }
                let depth = within()?;
                let parts = parts.iter().map(|part| self.condition(part, depth).map(Item::Node));
                let kind = if matches!(expr.kind, ExprKind::All(_)) { NodeKind::All } else { NodeKind::Any };
                Ok(node(kind, parts.collect::<Result<_, _>>()?))
            }
            ExprKind::Compare(op, left, right) => {
                let relation = Relation(*op);
                match (&left.kind, &right.kind) {
                    (ExprKind::Call(_) | ExprKind::Field(..), _) => self.comparison(left, relation, right),
                    (_, ExprKind::Call(_) | ExprKind::Field(..)) => {
                        self.comparison(right, relation.turned(), left)
                    }
                    _ => Err(outside(expr.span, "a comparison is of a measure or a field with a value")),
                }
            }
            _ => Err(outside(expr.span, "a condition is a fluent or a comparison in the canonical subset")),
        }
    }

    /// A comparison of the kind of a failure.
    fn failure_kind(
        &self,
        of: (SmolStr, Span),
        relation: Relation,
        with: &Expr,
    ) -> Result<Node, OutsideSubset> {
        let kind = match &with.kind {
            ExprKind::Name(name) | ExprKind::Plain(name) if self.signatures.failures.contains(name) => name,
            _ => return Err(outside(with.span, "a kind is compared with the name of a failure")),
        };
        if !Relation::EQUALITY.contains(&relation) {
            return Err(outside(of.1, "only numbers can be more or less"));
        }
        let items = vec![
            Item::Value(Value::Binding(of.0)),
            Item::Relation(relation),
            Item::Value(Value::Name(kind.clone())),
        ];
        Ok(Node { kind: NodeKind::Caught, span: of.1, name: None, items })
    }

    fn comparison(&self, of: &Expr, relation: Relation, with: &Expr) -> Result<Node, OutsideSubset> {
        if let ExprKind::Field(caught, field) = &of.kind
            && let Some(name) = self.caught_name(caught).filter(|_| field.text == "kind")
        {
            return self.failure_kind((name, of.span), relation, with);
        }
        let (kind, mut items, ty) = match &of.kind {
            ExprKind::Call(call) if self.is_term(call, "count") => {
                (NodeKind::Count, vec![Item::Value(Value::Binding(self.list_name(call)?))], &Type::Int)
            }
            ExprKind::Call(call) => {
                let (number, measure) = numbered(&self.signatures.measures, |row| row.name == call.name.text)
                    .ok_or_else(|| outside(of.span, format!("there is no measure `{}`", call.name.text)))?;
                let args = self.observed(call, &measure.params, false)?;
                (NodeKind::Get(number), args, &measure.result)
            }
            ExprKind::Field(entity, name) => {
                let (number, field) = numbered(&self.signatures.fields, |row| row.name == name.text)
                    .ok_or_else(|| outside(of.span, format!("there is no field `{}`", name.text)))?;
                let entity = self.value(entity, &Type::Entity(field.kind), None)?;
                (NodeKind::Field(number), vec![Item::Value(entity)], &field.ty)
            }
            _ => return Err(outside(of.span, "a comparison is of a measure or a field with a value")),
        };
        let is_number = NumberRange::of(ty, None).is_some();
        if !is_number && !Relation::EQUALITY.contains(&relation) {
            return Err(outside(of.span, "only numbers can be more or less"));
        }
        match self.value(with, ty, None)? {
            Value::Binding(_) | Value::First(_) => {
                Err(outside(with.span, "a comparison is with a value that is written out"))
            }
            value => {
                items.extend([Item::Relation(relation), Item::Value(value)]);
                Ok(Node { kind, span: of.span, name: None, items })
            }
        }
    }

    /// The arguments of a fluent or a measure.
    pub(super) fn observed(
        &self,
        call: &Call,
        params: &[(SmolStr, Type)],
        takes_any: bool,
    ) -> Result<Vec<Item>, OutsideSubset> {
        let value = |(index, (name, ty)): (usize, &(SmolStr, Type))| {
            let arg = argument(call, index, name);
            let arg =
                arg.ok_or_else(|| outside(call.span, format!("`{}` lacks `{name}`", call.name.text)))?;
            Ok(Item::Value(match &arg.kind {
                ExprKind::Any if takes_any => Value::Any,
                _ => self.value(arg, ty, None)?,
            }))
        };
        if call.args.len() > params.len() {
            return Err(outside(call.span, format!("`{}` has too many arguments", call.name.text)));
        }
        params.iter().enumerate().map(value).collect()
    }

    /// A name that the policy gives or uses.
    pub(super) fn new_name(&self, name: &SmolStr, span: Span) -> Result<SmolStr, OutsideSubset> {
        if !subset::is_name(name) {
            let most = subset::MAX_NAME_CHARS;
            return Err(outside(
                span,
                format!("`{name}` is no name of at most {most} ASCII letters, digits and `_`"),
            ));
        }
        if self.signatures.entities.iter().any(|(entity, _)| entity == name) {
            return Err(outside(span, format!("`{name}` is an entity, which no name may hide")));
        }
        if self.subset.syntax == Syntax::Text && self.is_taken(name) {
            return Err(outside(span, format!("`{name}` means something else in the text syntax")));
        }
        Ok(name.clone())
    }

    /// The name is a word of the language or a case.
    fn is_taken(&self, name: &str) -> bool {
        identifier(name) != name
            || self.signatures.enums.iter().any(|def| def.cases.iter().any(|case| case == name))
    }
}

/// A text with each brace twice.
fn doubled(text: &str) -> SmolStr {
    text.replace('{', "{{").replace('}', "}}").into()
}

/// The argument for a parameter, by its name or its place.
pub(super) fn argument<'c>(call: &'c Call, index: usize, name: &str) -> Option<&'c Expr> {
    let named = call.args.iter().find(|arg| arg.name.as_ref().is_some_and(|given| given.text == name));
    let arg = named.or_else(|| call.args.get(index).filter(|arg| arg.name.is_none()));
    arg.map(|arg| &arg.value)
}

pub(super) fn outside(span: Span, why: impl Into<String>) -> OutsideSubset {
    OutsideSubset { span, why: why.into() }
}

/// The first row of which something holds, with its number.
pub(super) fn numbered<T>(rows: &[T], is_it: impl Fn(&T) -> bool) -> Option<(u16, &T)> {
    (0u16..).zip(rows).find(|(_, row)| is_it(row))
}
