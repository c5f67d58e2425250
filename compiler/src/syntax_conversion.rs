//! Makes a policy explicit: writes out what it leaves to the types, so that both syntaxes can express the
//! same policy.
//!
//! A plain string of the JSON syntax becomes a name, a text or a quantity; a bare number becomes a quantity
//! in the SI unit; arguments get names in JSON and positions in text. Where a name is unknown or a value does
//! not fit, the policy stays as it is. A place without a type is read as in [`crate::declare::elaborator`].

use motet_syntax::Syntax;
use motet_syntax::ast::{
    Arg, ArithOp, Block, Call, Do, End, Expr, ExprKind, Keep, KeepKind, Manner, Name, POSE, Policy, Reaction,
    StepKind, TextPart,
};
use motet_syntax::unit::{Dimension, Unit};
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use crate::declare::Library;
use crate::declare::arithmetic::dimension;
use crate::declare::condition::needs_context;
use crate::declare::elaborator::{TEXT, parse_quantity, percent};
use crate::declare::list_term::{COUNT, FIRST, IS_EMPTY, OF};
use crate::ir::{Base, Ty};

/// Makes a policy explicit, for printing it in a syntax.
///
/// ```
/// use motet_compiler::{Session, make_explicit};
/// use motet_syntax::ast::StepKind;
/// use motet_syntax::{FileId, Source, Sources, Syntax};
///
/// let session = Session::builder().build(&mut Sources::default());
/// let source = Source::new("greet.motet", "policy greet { say(\"hello\") }");
/// let mut policy = motet_syntax::read(&source, FileId(99)).file.policies().next().cloned().expect("one");
/// make_explicit(&mut policy, session.library(), Syntax::Json);
/// let StepKind::Do(call) = &policy.body.steps[0].kind else { panic!("a call") };
/// assert_eq!(call.call.args[0].name.as_ref().map(|name| name.text.as_str()), Some("text"));
/// ```
pub fn make_explicit(policy: &mut Policy, library: &Library, form: Syntax) {
    let params = policy.params.iter();
    let types = params.map(|param| (param.name.text.clone(), library.written_type(&param.ty))).collect();
    let result = policy.result.as_ref().map(|ty| library.written_type(ty));
    let mut writer = Writer { library, form, result, types };
    if let Some(goal) = &mut policy.achieves {
        writer.condition(goal);
    }
    writer.keeps(&mut policy.keeps);
    writer.block(&mut policy.body);
    policy.cleanup.iter_mut().for_each(|cleanup| writer.block(cleanup));
}

struct Writer<'a> {
    library: &'a Library,
    form: Syntax,
    /// Type of the policy's result.
    result: Option<Ty>,
    /// Types of the names bound so far, where they are known. A name has one type wherever it is visible.
    types: FxHashMap<SmolStr, Ty>,
}

impl Writer<'_> {
    fn block(&mut self, block: &mut Block) {
        for step in &mut block.steps {
            self.step(&mut step.kind);
        }
    }

    fn step(&mut self, step: &mut StepKind) {
        // Whether a call has a value or is a step only the library knows.
        if let StepKind::Do(Do { call, bind: Some(name), manner: None, within: None, retry: None }) = step
            && self.called(&call.name.text).is_none()
            && self.observed(&call.name.text).is_some()
        {
            let value = Expr { kind: ExprKind::Call(call.clone()), span: call.span };
            *step = StepKind::Let { name: name.clone(), value };
        }
        match step {
            StepKind::Let { name, value } => {
                self.term(value, None);
                let ty = self.type_of(value);
                self.bind(name, ty);
            }
            StepKind::Do(call) => {
                let params = self.called(&call.call.name.text);
                self.call(&mut call.call, params);
                if let Some(Manner::At(ratio, _)) = &mut call.manner {
                    self.term(ratio, Some(Ty::RATIO));
                }
                self.optional(call.within.as_mut(), Ty::DURATION);
                self.optional(call.retry.as_mut(), Ty::INT);
                if let Some(name) = &call.bind {
                    let def = self.library.names.primitives.get(&call.call.name.text);
                    let def = def.and_then(|id| self.library.primitive(*id));
                    self.bind(name, def.and_then(|def| def.result));
                }
            }
            StepKind::Sequence { body, .. } => self.block(body),
            StepKind::If { condition, then, otherwise } => {
                self.condition(condition);
                self.block(then);
                otherwise.iter_mut().for_each(|block| self.block(block));
            }
            StepKind::Wait { condition, within } => {
                self.condition(condition);
                self.optional(within.as_mut(), Ty::DURATION);
            }
            StepKind::Delay { time } => self.term(time, Some(Ty::DURATION)),
            StepKind::Within { time, body } => {
                self.term(time, Some(Ty::DURATION));
                self.block(body);
            }
            StepKind::Finally { step, cleanup } => {
                self.step(&mut step.kind);
                self.block(cleanup);
            }
            StepKind::Monitor { whens, body } => {
                for when in whens {
                    self.condition(&mut when.condition);
                    self.optional(when.hold.as_mut(), Ty::DURATION);
                    self.reaction(&mut when.reaction);
                }
                self.block(body);
            }
            StepKind::Try { body, catches } => {
                self.block(body);
                catches.iter_mut().for_each(|catch| self.block(&mut catch.body));
            }
            StepKind::Repeat { times, body, until } => {
                self.term(times, Some(Ty::INT));
                self.block(body);
                until.iter_mut().for_each(|until| self.condition(until));
            }
            StepKind::Each { item, list, at_most, body } => {
                self.term(list, None);
                let ty = self.type_of(list).and_then(Ty::element);
                self.bind(item, ty);
                self.term(at_most, Some(Ty::INT));
                self.block(body);
            }
            StepKind::Keep { keeps, body } => {
                self.keeps(keeps);
                self.block(body);
            }
            StepKind::Parallel { branches } => branches.iter_mut().for_each(|branch| self.block(branch)),
            StepKind::End(end) => self.end(end),
        }
    }

    fn keeps(&self, keeps: &mut [Keep]) {
        for keep in keeps {
            match &mut keep.kind {
                KeepKind::OutOf(zone) => self.term(zone, None),
                KeepKind::Distance { to, at_least } => {
                    self.term(to, None);
                    self.term(at_least, Some(Ty::LENGTH));
                }
            }
        }
    }

    fn reaction(&mut self, reaction: &mut Reaction) {
        match reaction {
            Reaction::Pause { within, .. } => self.optional(within.as_mut(), Ty::DURATION),
            Reaction::Restart { at_most, .. } => self.term(at_most, Some(Ty::INT)),
            Reaction::Resume { at_most, body, .. } => {
                self.term(at_most, Some(Ty::INT));
                self.block(body);
            }
            Reaction::End(end) => self.end(end),
        }
    }

    /// Notes the type of a name.
    fn bind(&mut self, name: &Name, ty: Option<Ty>) {
        match ty {
            Some(ty) => self.types.insert(name.text.clone(), ty),
            None => self.types.remove(&name.text),
        };
    }

    fn end(&self, end: &mut End) {
        if let Some(result) = &mut end.result {
            self.term(result, self.result);
        }
        self.optional(end.why.as_mut(), Ty::TEXT);
    }

    fn optional(&self, expr: Option<&mut Expr>, ty: Ty) {
        if let Some(expr) = expr {
            self.term(expr, Some(ty));
        }
    }

    /// Parameters of the primitive or policy with a name.
    fn called(&self, name: &str) -> Option<Vec<(SmolStr, Ty)>> {
        let names = &self.library.names;
        if let Some(def) = names.primitives.get(name).and_then(|id| self.library.primitive(*id)) {
            return Some(def.params.iter().map(|param| (param.name.clone(), param.ty)).collect());
        }
        if let Some(policy) = names.policies.get(name).and_then(|index| self.library.policies.get(*index)) {
            let params = policy.params.iter();
            return Some(
                params.map(|param| (param.name.text.clone(), self.library.written_type(&param.ty))).collect(),
            );
        }
        None
    }

    /// Parameters of the fluent or measure with a name.
    fn observed(&self, name: &str) -> Option<Vec<(SmolStr, Ty)>> {
        let names = &self.library.names;
        let own = || {
            let of_list = [COUNT, FIRST, IS_EMPTY].iter().any(|own| own == name);
            of_list.then(|| vec![(OF, Ty::UNKNOWN)]).or_else(|| (name == POSE).then(Vec::new))
        };
        let fluent =
            names.fluents.get(name).and_then(|id| self.library.fluent(*id)).map(|def| def.params.clone());
        let measure = || {
            names.measures.get(name).and_then(|id| self.library.measure(*id)).map(|def| def.params.clone())
        };
        fluent.or_else(measure).or_else(own)
    }

    /// Rewrites the arguments of a call. `open` is both a primitive and a fluent, so the caller gives the
    /// parameters.
    fn call(&self, call: &mut Call, params: Option<Vec<(SmolStr, Ty)>>) {
        match params {
            Some(params) => self.arguments(&mut call.args, &params),
            None => call.args.iter_mut().for_each(|arg| self.term(&mut arg.value, None)),
        }
    }

    /// Returns whether a call is a pose, and not the measure of a declaration.
    fn is_pose(&self, call: &Call) -> bool {
        call.is_pose() && !self.library.names.measures.contains_key(&call.name.text)
    }

    /// Rewrites the numbers of a pose: lengths, and an angle at the end.
    fn pose(&self, call: &mut Call) {
        let last = call.args.len().saturating_sub(1);
        for (index, arg) in call.args.iter_mut().enumerate() {
            self.term(&mut arg.value, Some(if index == last { Ty::ANGLE } else { Ty::LENGTH }));
        }
    }

    fn arguments(&self, args: &mut [Arg], params: &[(SmolStr, Ty)]) {
        for (position, arg) in args.iter_mut().enumerate() {
            let param = match &arg.name {
                Some(name) => params.iter().find(|(param, _)| *param == name.text),
                None => params.get(position),
            };
            let ty = param.map(|(_, ty)| *ty).filter(|ty| ty.base != Base::Unknown);
            self.term(&mut arg.value, ty);
            if let (Syntax::Json, None, Some((param, _))) = (self.form, &arg.name, param) {
                arg.name = Some(Name { text: param.clone(), span: arg.span });
            }
        }
        if self.form == Syntax::Text {
            // As long as the names only say what the places say, the places are enough.
            for (arg, (param, _)) in args.iter_mut().zip(params) {
                if arg.name.as_ref().is_some_and(|name| name.text != *param) {
                    break;
                }
                arg.name = None;
            }
        }
    }

    fn condition(&self, expr: &mut Expr) {
        match &mut expr.kind {
            ExprKind::Not(inner) => self.condition(inner),
            ExprKind::All(parts) | ExprKind::AnyOf(parts) => {
                parts.iter_mut().for_each(|part| self.condition(part))
            }
            ExprKind::Compare(_, left, right) => {
                // The side that shows its own type is read first.
                if needs_context(left, |name| self.types.contains_key(name)) {
                    self.term(right, None);
                    self.term(left, self.type_of(right));
                } else {
                    self.term(left, None);
                    self.term(right, self.type_of(left));
                }
            }
            ExprKind::Call(call) if call.name.text == "monitored" => {
                for arg in &mut call.args {
                    if let ExprKind::Plain(text) = &arg.value.kind {
                        arg.value.kind = ExprKind::Name(text.clone());
                    }
                }
            }
            ExprKind::Call(call) => self.call(call, self.observed(&call.name.text)),
            ExprKind::Binding(name) => expr.kind = ExprKind::Name(name.clone()),
            _ => {}
        }
    }

    fn term(&self, expr: &mut Expr, ty: Option<Ty>) {
        match &mut expr.kind {
            ExprKind::Binding(name) => expr.kind = ExprKind::Name(name.clone()),
            ExprKind::Plain(text) => expr.kind = plain(text, ty),
            ExprKind::Number(value) => {
                if let Some(Ty { base: Base::Quantity(dimension), lists: 0 }) = ty {
                    expr.kind = quantity(*value, dimension);
                }
            }
            ExprKind::List(items) if ty == Some(Ty::plain(Base::Pose)) => {
                let (span, name) = (expr.span, Name { text: POSE.into(), span: expr.span });
                let values = std::mem::take(items).into_iter();
                let args = values.map(|value| Arg { name: None, span: value.span, value }).collect();
                let mut call = Call { name, args, span };
                self.pose(&mut call);
                expr.kind = ExprKind::Call(call);
            }
            ExprKind::Call(call) if self.is_pose(call) => self.pose(call),
            ExprKind::List(items) => {
                let element = ty.and_then(Ty::element);
                items.iter_mut().for_each(|item| self.term(item, element));
            }
            ExprKind::Call(call) => self.call(call, self.observed(&call.name.text)),
            ExprKind::Field(of, _) => self.term(of, None),
            ExprKind::Arith(_, left, right) => {
                self.term(left, None);
                self.term(right, None);
            }
            ExprKind::Template(parts) => {
                // In braces stands the text syntax, in either syntax.
                let inner = Writer { form: Syntax::Text, types: self.types.clone(), ..*self };
                for part in parts {
                    if let TextPart::Value(value) = part {
                        inner.term(value, None);
                    }
                }
            }
            ExprKind::Bool(_)
            | ExprKind::Quantity(..)
            | ExprKind::Text(_)
            | ExprKind::Name(_)
            | ExprKind::Wrong(_)
            | ExprKind::Any => {}
            ExprKind::Not(_) | ExprKind::All(_) | ExprKind::AnyOf(_) | ExprKind::Compare(..) => {
                self.condition(expr)
            }
        }
    }

    /// Type of an expression in a place without a type; `None` where it is not known.
    fn type_of(&self, expr: &Expr) -> Option<Ty> {
        match &expr.kind {
            ExprKind::Call(call) => {
                let id = self.library.names.measures.get(&call.name.text);
                if let Some(def) = id.and_then(|id| self.library.measure(*id)) {
                    return Some(def.result);
                }
                if call.name.text == COUNT {
                    return Some(Ty::INT);
                }
                let list = call.args.first().filter(|_| call.name.text == FIRST)?;
                self.type_of(&list.value)?.element()
            }
            ExprKind::Bool(_) => Some(Ty::BOOL),
            ExprKind::Number(value) if value.fract() == 0.0 => Some(Ty::INT),
            ExprKind::Number(_) => Some(Ty::plain(Base::Number)),
            ExprKind::Text(_) | ExprKind::Template(_) => Some(Ty::TEXT),
            ExprKind::Name(name) | ExprKind::Binding(name) => self.types.get(name).copied(),
            ExprKind::List(items) => self.type_of(items.first()?).map(Ty::list),
            ExprKind::Arith(op, left, right) => {
                let (left_ty, right_ty) = (self.type_of(left)?, self.type_of(right)?);
                let (left, right) = (dimension(left_ty)?, dimension(right_ty)?);
                let result = match op {
                    ArithOp::Add | ArithOp::Subtract => left,
                    ArithOp::Multiply => left.times(right),
                    ArithOp::Divide => left.over(right),
                };
                let plain = Ty::plain(Base::Number);
                Some(if result == Dimension::NONE { plain } else { Ty::plain(Base::Quantity(result)) })
            }
            ExprKind::Field(_, name) => {
                let own = self.library.kinds.iter().find_map(|def| def.fields.get(&name.text));
                let number = || self.library.numbers.get(&name.text).map(|(_, ty)| *ty);
                own.copied().or_else(number).or((name.text == TEXT).then_some(Ty::TEXT))
            }
            ExprKind::Quantity(_, unit) => Some(Ty::plain(Base::Quantity(unit.dimension()))),
            ExprKind::Plain(_) | ExprKind::Wrong(_) | ExprKind::Any => None,
            ExprKind::Not(_) | ExprKind::All(_) | ExprKind::AnyOf(_) | ExprKind::Compare(..) => {
                Some(Ty::BOOL)
            }
        }
    }
}

fn plain(text: &SmolStr, ty: Option<Ty>) -> ExprKind {
    match ty.map(|ty| ty.base) {
        Some(Base::Entity(_) | Base::Enum(_)) => ExprKind::Name(text.clone()),
        Some(Base::Quantity(_)) => parse_quantity(text)
            .map_or_else(|| ExprKind::Text(text.clone()), |(value, unit)| ExprKind::Quantity(value, unit)),
        Some(Base::Bool | Base::Int | Base::Number | Base::Text | Base::Pose | Base::Failure) => {
            ExprKind::Text(text.clone())
        }
        Some(Base::Unknown) => ExprKind::Text(text.clone()),
        None => {
            if let Some((value, unit)) = parse_quantity(text) {
                return ExprKind::Quantity(value, unit);
            }
            let mut letters = text.chars();
            let head = letters.next().is_some_and(|first| first.is_alphabetic() || first == '_');
            if head && letters.all(|letter| letter.is_alphanumeric() || letter == '_') {
                ExprKind::Name(text.clone())
            } else {
                ExprKind::Text(text.clone())
            }
        }
    }
}

fn quantity(value: f64, dimension: Dimension) -> ExprKind {
    if dimension == Dimension::NONE {
        // The shorter of two spellings, if it is the same number.
        let short = percent(value);
        let is_same = Unit::Percent.to_si(short) == value;
        return ExprKind::Quantity(if is_same { short } else { value * 100.0 }, Unit::Percent);
    }
    Unit::si(dimension).map_or(ExprKind::Number(value), |unit| ExprKind::Quantity(value, unit))
}
