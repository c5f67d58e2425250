//! Values by the types that are asked for, and conditions.

use motet_compiler::signature::Type;
use motet_syntax::Syntax;
use motet_syntax::ast::{Call, Expr, ExprKind};
use motet_syntax::unit::Dimension;
use smol_str::SmolStr;

use super::Outside;
use super::complete::Completer;
use crate::subset::{self, Condition, Decimal, NumberRange, Relation, Subject, Value};

impl Completer<'_> {
    /// A value of a type; `card` bounds a number.
    pub(super) fn value(&self, expr: &Expr, ty: &Type, card: Option<(f64, f64)>) -> Result<Value, Outside> {
        match (&expr.kind, ty) {
            (ExprKind::Binding(name), _) => self.binding(name, expr),
            (ExprKind::Name(name), _) => self.named(name, expr, ty),
            (ExprKind::Plain(text) | ExprKind::Text(text), Type::Text) => self.text(text, expr),
            (ExprKind::Plain(name), Type::Entity(_) | Type::Enum(_)) => {
                let known = self.is_known(name, ty);
                known.then(|| Value::Name(name.clone())).ok_or_else(|| {
                    outside(expr, format!("`{name}` is no `{}`", self.signatures.type_name(ty)))
                })
            }
            (ExprKind::Plain(text), Type::Quantity(dimension)) => {
                let quantity = motet_syntax::unit::parse_quantity(text);
                let quantity = quantity.filter(|(_, unit)| unit.dimension() == *dimension);
                let (value, unit) =
                    quantity.ok_or_else(|| outside(expr, format!("`{text}` is no quantity of that type")))?;
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
                    return Err(outside(expr, format!("a list has 1 to {} values", subset::MAX_ITEMS)));
                }
                items
                    .iter()
                    .map(|item| self.value(item, element, None))
                    .collect::<Result<_, _>>()
                    .map(Value::List)
            }
            (ExprKind::Call(_) | ExprKind::Field(..) | ExprKind::Arith(..), _) => {
                Err(outside(expr, "a value that is calculated has no place on the model subset".into()))
            }
            _ => {
                let ty = self.signatures.type_name(ty);
                Err(outside(expr, format!("this is no value of the type `{ty}` on the model subset")))
            }
        }
    }

    fn number(&self, value: f64, expr: &Expr, ty: &Type, card: Option<(f64, f64)>) -> Result<Value, Outside> {
        let range = NumberRange::of(ty, card);
        let number = range.and_then(|range| Some(Value::Number(range.nearest(value)?, range.unit)));
        number.ok_or_else(|| outside(expr, format!("{value} is beyond the numbers of the model subset")))
    }

    fn text(&self, text: &SmolStr, expr: &Expr) -> Result<Value, Outside> {
        if subset::is_text(text) {
            return Ok(Value::Text(text.clone()));
        }
        let most = subset::MAX_TEXT_CHARS;
        Err(outside(
            expr,
            format!("a text has 1 to {most} characters of ASCII, no `\"` and no `\\`, no `$` first"),
        ))
    }

    fn named(&self, name: &SmolStr, expr: &Expr, ty: &Type) -> Result<Value, Outside> {
        if self.is_bound(name) {
            return self.binding(name, expr);
        }
        if self.is_known(name, ty) {
            return Ok(Value::Name(name.clone()));
        }
        // Whether it is bound is not for the printer to say.
        self.binding(name, expr)
    }

    /// Whether a name is an entity or a case of the type that is asked for.
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

    pub(super) fn binding(&self, name: &SmolStr, expr: &Expr) -> Result<Value, Outside> {
        self.new_name(name, expr.span).map(Value::Binding)
    }

    /// The list of an `each`: a name, or entities of one kind, since the first decides what the others may be.
    pub(super) fn each_list(&self, expr: &Expr) -> Result<Value, Outside> {
        const ROOT: usize = 0;
        let list = self.value(expr, &Type::List(Box::new(Type::Entity(ROOT))), None)?;
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
            Value::Name(_) | Value::Number(..) | Value::Text(_) | Value::Bool(_) | Value::Any => false,
        };
        let why = "the list of an `each` is a name, or entities of one kind, on the model subset";
        if is_alike { Ok(list) } else { Err(outside(expr, why.into())) }
    }

    /// A number of seconds.
    pub(super) fn seconds(&self, expr: &Expr) -> Result<Decimal, Outside> {
        match self.value(expr, &Type::Quantity(Dimension::DURATION), None)? {
            Value::Number(number, _) if NumberRange::DURATION.contains(number) => Ok(number),
            _ => Err(outside(expr, "a time is a number of seconds on the model subset".into())),
        }
    }

    /// A whole number.
    pub(super) fn count(&self, expr: &Expr, least: u32, greatest: u32) -> Result<u32, Outside> {
        let whole = match &expr.kind {
            ExprKind::Number(value) => NumberRange::whole(least, greatest).nearest(*value),
            _ => None,
        };
        let exact = whole.and_then(|whole| u32::try_from(whole.units).ok());
        exact.ok_or_else(|| {
            outside(expr, format!("a count is from {least} to {greatest} on the model subset"))
        })
    }

    /// A condition, `depth` of which may still stand in one another.
    pub(super) fn condition(&self, expr: &Expr, depth: usize) -> Result<Condition, Outside> {
        let within = || {
            depth.checked_sub(1).ok_or_else(|| {
                let most = subset::MAX_CONDITION_DEPTH;
                outside(
                    expr,
                    format!("conditions stand at most {most} deep in one another on the model subset"),
                )
            })
        };
        match &expr.kind {
            ExprKind::Call(call) => {
                let fluent = self
                    .signatures
                    .fluent(&call.name.text)
                    .ok_or_else(|| outside(expr, format!("there is no fluent `{}`", call.name.text)))?;
                Ok(Condition::Is(fluent.name.clone(), self.observed(call, &fluent.params, true)?))
            }
            ExprKind::Not(inner) => Ok(Condition::Not(Box::new(self.condition(inner, within()?)?))),
            ExprKind::All(parts) | ExprKind::AnyOf(parts) => {
                if let [only] = parts.as_slice() {
                    return self.condition(only, depth);
                }
                if parts.is_empty() || parts.len() > subset::MAX_MEMBERS {
                    let most = subset::MAX_MEMBERS;
                    return Err(outside(expr, format!("2 to {most} conditions stand beside one another")));
                }
                let depth = within()?;
                let parts = parts.iter().map(|part| self.condition(part, depth)).collect::<Result<_, _>>()?;
                Ok(match &expr.kind {
                    ExprKind::All(_) => Condition::All(parts),
                    _ => Condition::Any(parts),
                })
            }
            ExprKind::Compare(op, left, right) => {
                let relation = Relation(*op);
                match (&left.kind, &right.kind) {
                    (ExprKind::Call(_) | ExprKind::Field(..), _) => self.comparison(left, relation, right),
                    (_, ExprKind::Call(_) | ExprKind::Field(..)) => {
                        self.comparison(right, relation.turned(), left)
                    }
                    _ => Err(outside(expr, "a comparison is of a measure or a field with a value".into())),
                }
            }
            _ => Err(outside(expr, "a condition is a fluent or a comparison on the model subset".into())),
        }
    }

    fn comparison(&self, of: &Expr, relation: Relation, with: &Expr) -> Result<Condition, Outside> {
        let (subject, ty) = match &of.kind {
            ExprKind::Call(call) => {
                let measure = self
                    .signatures
                    .measure(&call.name.text)
                    .ok_or_else(|| outside(of, format!("there is no measure `{}`", call.name.text)))?;
                let args = self.observed(call, &measure.params, false)?;
                (Subject::Measure(measure.name.clone(), args), &measure.result)
            }
            ExprKind::Field(entity, name) => {
                let field = self.signatures.fields.iter().find(|field| field.name == name.text);
                let field = field.ok_or_else(|| outside(of, format!("there is no field `{}`", name.text)))?;
                let entity = self.value(entity, &Type::Entity(field.kind), None)?;
                (Subject::Field(field.name.clone(), entity), &field.ty)
            }
            _ => return Err(outside(of, "a comparison is of a measure or a field with a value".into())),
        };
        let is_number = NumberRange::of(ty, None).is_some();
        if !is_number && !Relation::EQUALITY.contains(&relation) {
            return Err(outside(of, "only numbers can be more or less".into()));
        }
        match self.value(with, ty, None)? {
            Value::Binding(_) => {
                Err(outside(with, "a comparison is with a value that is written out".into()))
            }
            value => Ok(Condition::Compare(subject, relation, value)),
        }
    }

    /// The arguments of a fluent or a measure.
    fn observed(
        &self,
        call: &Call,
        params: &[(SmolStr, Type)],
        takes_any: bool,
    ) -> Result<Vec<(SmolStr, Value)>, Outside> {
        let value = |(index, (name, ty)): (usize, &(SmolStr, Type))| {
            let arg = super::complete::argument(call, index, name);
            let arg = arg.ok_or_else(|| Outside {
                span: call.span,
                why: format!("`{}` lacks `{name}`", call.name.text),
            })?;
            let value = match &arg.kind {
                ExprKind::Any if takes_any => Value::Any,
                _ => self.value(arg, ty, None)?,
            };
            Ok((name.clone(), value))
        };
        if call.args.len() > params.len() {
            return Err(Outside {
                span: call.span,
                why: format!("`{}` has too many arguments", call.name.text),
            });
        }
        params.iter().enumerate().map(value).collect()
    }

    /// A name that the policy gives to something, or uses.
    pub(super) fn new_name(&self, name: &SmolStr, span: motet_syntax::Span) -> Result<SmolStr, Outside> {
        if !subset::is_name(name) {
            let most = subset::MAX_NAME_CHARS;
            return Err(Outside {
                span,
                why: format!("`{name}` is no name of at most {most} ASCII letters, digits and `_`"),
            });
        }
        if self.signatures.entities.iter().any(|(entity, _)| entity == name) {
            return Err(Outside { span, why: format!("`{name}` is an entity, which no name may hide") });
        }
        if self.subset.syntax == Syntax::Text && self.is_taken(name) {
            return Err(Outside { span, why: format!("`{name}` means something else in the text form") });
        }
        Ok(name.clone())
    }

    /// Whether a name is a word of the language or a case.
    fn is_taken(&self, name: &str) -> bool {
        motet_syntax::print::identifier(name) != name
            || self.signatures.enums.iter().any(|def| def.cases.iter().any(|case| case == name))
    }
}

pub(super) fn outside(expr: &Expr, why: String) -> Outside {
    Outside { span: expr.span, why }
}
