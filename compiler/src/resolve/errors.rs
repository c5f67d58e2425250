//! Diagnostics of unknown callees, and of names that a step must not bind (M0201, M0206, M0207, M0212,
//! M0305, M0315, M0316).

use motet_syntax::{Edit, Fix, Related, Span};
use smol_str::SmolStr;

use crate::declare::errors::{did_you_mean, replace};

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// Call of an unknown primitive or policy.
    UnknownPrimitive("M0201", Error) { name: SmolStr, step: Option<StepToWrite>, near: Option<SmolStr> }
    message(m) { format!("there is no primitive or policy `{}`", m.name) }
    help(m) {
        let lists = || "`motet robots show` lists the primitives of the robot".to_owned();
        let step = m.step.as_ref().map(|step| step.help.clone());
        step.or_else(|| did_you_mean(m.near.as_ref())).or_else(|| Some(lists()))
    }
    fix(m) {
        match &m.step {
            Some(step) => step.fix.clone(),
            None => m.near.as_ref().and_then(|near| replace(m.span, near)),
        }
    }

    /// Binding with a name that is already bound, or that of an entity.
    Shadows("M0206", Error) { name: SmolStr, first: Option<Span> }
    message(m) {
        match m.first {
            Some(_) => format!("`{}` is already bound", m.name),
            None => format!("`{}` is an entity, which a binding must not hide", m.name),
        }
    }
    help(m) { Some(format!("choose another name than `{}`", m.name)) }
    related(m) { m.first.map(|first| Related::new("bound here", first)).into_iter().collect() }

    /// Policy that calls itself.
    Recursion("M0207", Error) { name: SmolStr }
    message(m) { format!("the policy `{}` calls itself", m.name) }
    help(_m) { Some("use `repeat` or `each` instead; recursion would not be bounded".to_owned()) }

    /// Policy that is too large after inlining.
    TooManySteps("M0212", Error) { limit: usize }
    message(m) { format!("the policy has more than {} steps, with its sub-policies inlined", m.limit) }
    help(_m) { Some("use `repeat` or `each` instead of copies of steps".to_owned()) }

    /// Binding of the result of a step without one.
    NoResult("M0305", Error) { callee: SmolStr, name: SmolStr }
    message(m) { format!("`{}` has no result to bind to `{}`", m.callee, m.name) }
    help(m) { Some(format!("call it without binding `{}`", m.name)) }

    /// Manner of a step that moves nothing.
    NoMotion("M0315", Error) { callee: SmolStr, is_text: bool }
    message(m) { format!("`{}` moves nothing, so it has no manner", m.callee) }
    help(_m) { Some("remove the manner".to_owned()) }
    fix(m) {
        let text = if m.is_text { "" } else { "null" };
        let edits = vec![Edit { span: m.span, text: text.to_owned() }];
        Some(Fix { title: "remove the manner".to_owned(), edits })
    }

    /// Empty list where a step needs at least one element.
    EmptyList("M0316", Error) { callee: SmolStr, name: SmolStr }
    message(m) {
        format!("`{}` of `{}` is an empty list, and the step begins at its first element", m.name, m.callee)
    }
    help(m) { Some(format!("name at least one element for `{}`", m.name)) }
}

/// The step to write for a word that is no callee.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct StepToWrite {
    pub(crate) help: String,
    /// Edits, where the word and the arguments have one reading.
    pub(crate) fix: Option<Fix>,
}
