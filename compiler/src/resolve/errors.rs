//! Calls of something that does not exist, and names that a step may not bind (M0201, M0206, M0207, M0212, M0305).

use motet_syntax::{Related, Span};
use smol_str::SmolStr;

use crate::declare::errors::{did_you_mean, replace};

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// A step calls what is neither a primitive nor a policy.
    UnknownPrimitive("M0201", Error) { name: SmolStr, near: Option<SmolStr> }
    message(m) { format!("there is no primitive or policy `{}`", m.name) }
    help(m) {
        did_you_mean(m.near.as_ref()).or_else(|| Some("`motet robots show` lists what the robot can do".to_owned()))
    }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// A binding takes a name that is already bound, or that of an entity.
    Shadows("M0206", Error) { name: SmolStr, first: Option<Span> }
    message(m) {
        match m.first {
            Some(_) => format!("`{}` is already bound", m.name),
            None => format!("`{}` is an entity, which a binding may not hide", m.name),
        }
    }
    help(m) { Some(format!("a name means one thing: choose another than `{}`", m.name)) }
    related(m) { m.first.map(|first| Related::new("bound here", first)).into_iter().collect() }

    /// A policy that calls itself.
    Recursion("M0207", Error) { name: SmolStr }
    message(m) { format!("the policy `{}` calls itself", m.name) }
    help(_m) { Some("use `repeat` or `each`: every loop is bounded".to_owned()) }

    /// Inlining makes the policy too large.
    TooManySteps("M0212", Error) { limit: usize }
    message(m) { format!("with its sub-policies the policy has more than {} steps", m.limit) }
    help(_m) { Some("use `repeat` or `each` instead of writing steps out".to_owned()) }

    /// A binding of a step that gives nothing.
    NoResult("M0305", Error) { callee: SmolStr, name: SmolStr }
    message(m) { format!("`{}` gives no result to bind to `{}`", m.callee, m.name) }
    help(m) { Some(format!("call it without binding `{}`", m.name)) }
}
