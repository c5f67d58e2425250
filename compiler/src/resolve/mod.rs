//! Stage 1: names and types. An AST becomes a [`Program`]: every name an index, every argument in its place, every
//! sub-policy inlined. Names and types are one stage, because a plain string of the JSON form is an entity, a case, a
//! quantity or a text as the type where it stands says.

mod arith;
mod call;
mod condition;
pub(crate) mod errors;
pub(crate) mod expr;
pub(crate) mod motion;
mod name;
pub(crate) mod near;
pub(crate) mod scope;
mod step;

use motet_syntax::ast::{Expr, ExprKind, Policy};
use motet_syntax::unit::Unit;
use motet_syntax::{Diagnostic, Syntax};

use self::expr::{Place, Resolver, Wanted};
use self::step::Steps;
use crate::ir::{BindingId, Program, Term, Ty};
use crate::library::Library;
use crate::world::World;

/// The most steps of a policy with its sub-policies inlined.
pub const MAX_NODES: usize = 100_000;
/// The largest count of a loop, a retry or a reaction.
pub const MAX_COUNT: u32 = 1_000_000;
/// The longest deadline, in seconds: a week.
pub const MAX_SECONDS: f64 = 604_800.0;

/// Resolves one policy.
pub(crate) fn resolve(
    policy: &Policy,
    form: Syntax,
    library: &Library,
    world: &World,
) -> (Program, Vec<Diagnostic>) {
    let resolver = Resolver::new(library, world.entities(), world.has_scene(), form);
    let mut steps = Steps::new(resolver);
    let program = steps.policy(policy);
    (program, steps.finish())
}

/// Resolves one more step of the body of a policy whose name is `name`: appends to `program` what it makes, and leaves
/// in `scope` what it binds.
pub(crate) fn resolve_step(
    step: &motet_syntax::ast::Step,
    (form, name): (Syntax, &smol_str::SmolStr),
    (library, world): (&Library, &World),
    program: &mut Program,
    scope: &mut scope::Scope,
) -> (Option<crate::ir::StepId>, Vec<Diagnostic>) {
    let resolver = Resolver {
        scope: std::mem::take(scope),
        bindings: std::mem::take(&mut program.bindings),
        ..Resolver::new(library, world.entities(), world.has_scene(), form)
    };
    let mut steps = Steps::new(resolver);
    steps.program = std::mem::take(program);
    steps.calls.push(name.clone());
    let index = u32::try_from(steps.program.body.len()).unwrap_or(u32::MAX);
    let place = crate::ir::Place { parent: None, slot: crate::ir::Slot::Steps, index };
    let id = steps.step(step, place);
    *program = std::mem::take(&mut steps.program);
    program.bindings = std::mem::take(&mut steps.resolver.bindings);
    *scope = std::mem::take(&mut steps.resolver.scope);
    (id, steps.finish())
}

/// Appends to a program a call of a policy with these arguments; its first step.
pub(crate) fn resolve_inlined(
    policy: &Policy,
    args: Vec<Term>,
    (library, world): (&Library, &World),
    program: &mut Program,
) -> (Option<crate::ir::StepId>, Vec<Diagnostic>) {
    let resolver = Resolver {
        bindings: std::mem::take(&mut program.bindings),
        ..Resolver::new(library, world.entities(), world.has_scene(), Syntax::Text)
    };
    let mut steps = Steps::new(resolver);
    steps.program = std::mem::take(program);
    steps.calls.push(steps.program.name.clone());
    let id = steps.write_out(policy, args);
    *program = std::mem::take(&mut steps.program);
    program.bindings = std::mem::take(&mut steps.resolver.bindings);
    (id, steps.finish())
}

impl Resolver<'_> {
    /// A duration that is known beforehand, in seconds.
    pub(crate) fn seconds(&mut self, expr: &Expr, place: &'static str) -> Option<f64> {
        let wanted = Wanted { ty: Ty::DURATION, place: Place::Named(place) };
        match self.term_of(expr, wanted) {
            Term::Number(value) if value.is_finite() && (0.0..=MAX_SECONDS).contains(&value) => Some(value),
            Term::Number(value) => {
                // In the unit in which it is written.
                let unit = expr.unit().unwrap_or(Unit::Second);
                let (least, greatest) = (unit.show(0.0), unit.show(MAX_SECONDS));
                let actual = unit.show(value);
                self.say(errors::OutOfRange {
                    span: expr.span,
                    place: place.to_owned(),
                    least,
                    greatest,
                    actual,
                    meant: None,
                });
                None
            }
            Term::Unknown => None,
            Term::Binding(id) if self.is_param(id) => None,
            _ => {
                self.say(errors::NotConstant { span: expr.span, place });
                None
            }
        }
    }

    /// Whether a binding is a parameter, of which the value is known only where the policy is called.
    fn is_param(&self, id: BindingId) -> bool {
        self.bindings.get(id.index()).is_some_and(|binding| binding.is_param)
    }

    /// A count that is known beforehand.
    pub(crate) fn count(&mut self, expr: &Expr, place: &'static str, least: u32) -> Option<u32> {
        let wanted = Wanted { ty: Ty::INT, place: Place::Named(place) };
        let beyond = |actual: String| errors::OutOfRange {
            span: expr.span,
            place: place.to_owned(),
            least: least.to_string(),
            greatest: MAX_COUNT.to_string(),
            actual,
            meant: None,
        };
        // A whole number that no integer holds.
        if let ExprKind::Number(value) = expr.kind
            && value.fract() == 0.0
            && value.abs() > f64::from(MAX_COUNT)
        {
            self.say(beyond(value.to_string()));
            return None;
        }
        match self.term_of(expr, wanted) {
            Term::Int(value) => {
                let count = u32::try_from(value).ok().filter(|count| (least..=MAX_COUNT).contains(count));
                if count.is_none() {
                    self.say(beyond(value.to_string()));
                }
                count
            }
            Term::Unknown => None,
            Term::Binding(id) if self.is_param(id) => None,
            _ => {
                self.say(errors::NotConstant { span: expr.span, place });
                None
            }
        }
    }
}
