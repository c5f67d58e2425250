//! Diagnostics of unknown callees, of names that a step must not bind, of endings (M0201, M0206, M0207,
//! M0212, M0218, M0305, M0315, M0319, M0320, M0912), and of results of policies (M0316 to M0318).

use motet_syntax::{Edit, Fix, Related, Span};
use smol_str::SmolStr;

use crate::declare::diagnostics::{did_you_mean, replace};
use crate::declare::name::article;
use crate::declare::unbound::Unbound;

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// Call of an unknown primitive or policy.
    UnknownPrimitive("M0201", Error) {
        name: SmolStr, step: Option<StepSuggestion>, near: Option<SmolStr>, cannot: &'static str,
    }
    message(m) { format!("there is no primitive or policy `{}`", m.name) }
    help(m) {
        let lists = || format!("write a primitive of the robot, or end with `{}`", m.cannot);
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

    /// Policy that is too large after inlining, or a parallel block with too many branches: each is proved
    /// beside all others.
    TooManySteps("M0212", Error) { limit: usize, branches: Option<(usize, &'static str)> }
    message(m) {
        match m.branches {
            Some((_, "document")) => {
                "the policies of the document have too many steps, with their sub-policies inlined".to_owned()
            }
            Some((found, "parallel")) => {
                format!("the `parallel` has {found} branches, but at most {} may run at once", m.limit)
            }
            Some((found, what)) => {
                format!("the `{what}` watches {found} conditions, but at most {} may be watched", m.limit)
            }
            None => format!("the policy has more than {} steps, with its sub-policies inlined", m.limit),
        }
    }
    help(m) {
        Some(match m.branches {
            Some((_, "parallel")) => "let some of them run one after the other".to_owned(),
            Some((_, "monitor" | "keep")) => "join some of them by `or`, or leave some out".to_owned(),
            Some(_) | None => "use `repeat` or `each` instead of copies of steps".to_owned(),
        })
    }

    /// Binding of the result of a step without one.
    NoResult("M0305", Error) { callee: SmolStr, name: SmolStr }
    message(m) { format!("`{}` has no result to bind to `{}`", m.callee, m.name) }
    help(m) { Some(format!("call it without binding `{}`", m.name)) }

    /// Pose in the place of an entity, where another primitive takes one.
    PoseForEntity("M0319", Error) { callee: SmolStr, name: Span, param: SmolStr, twin: SmolStr }
    message(m) { format!("`{}` of `{}` is an entity, not a pose", m.param, m.callee) }
    help(m) { Some(format!("`{}` takes a pose", m.twin)) }
    fix(m) { replace(m.name, &m.twin) }

    /// Result of a policy that declares none.
    UnwantedResult("M0316", Error) { policy: SmolStr }
    message(m) { format!("`done` gives a result, but `{}` declares none", m.policy) }
    help(m) {
        Some(format!("declare its type, as in `policy {}() -> Object`, or write `done` alone", m.policy))
    }

    /// Path through a policy that ends without the result that the policy declares.
    MissingResult("M0317", Error) { policy: SmolStr, ty: String, path: Option<Option<Unbound>> }
    message(m) {
        let gives = format!("`{}` gives {}", m.policy, article(&m.ty));
        match &m.path {
            None => format!("{gives}, but this `done` gives nothing"),
            Some(Some(Unbound::Path { name, .. })) => format!("{gives}, but not on the path through {name}"),
            Some(Some(Unbound::NoElse(_))) => {
                format!("{gives}, but not if the condition of an `if` without `else` does not hold")
            }
            Some(Some(Unbound::Loop)) => format!("{gives}, but not if an `each` has no round"),
            Some(_) => format!("{gives}, but its last step is no `done`"),
        }
    }
    help(_m) {
        Some("end that path with `done` and a value, or with `fail`, `cannot` or `replan`".to_owned())
    }
    related(m) {
        let related = match &m.path {
            Some(Some(Unbound::Path { end, .. })) => Some(Related::new("this path goes on without it", *end)),
            Some(Some(Unbound::NoElse(condition))) => Some(Related::new("this may not hold", *condition)),
            Some(_) | None => None,
        };
        related.into_iter().collect()
    }

    /// Result of a reaction that only the run determines.
    ReactionResult("M0318", Error) { }
    message(_m) { "a reaction gives a result that is known before its monitor".to_owned() }
    help(_m) { Some("give the value a name with `let` before the monitor, and give that".to_owned()) }

    /// Key beside the arguments that only explains the step.
    IgnoredArgument("M0218", Warning) { name: SmolStr, callee: SmolStr }
    message(m) { format!("`{}` is no parameter of `{}`, and is ignored", m.name, m.callee) }
    help(_m) { Some("write what a step is for in the text of the reply, or as a `say`".to_owned()) }

    /// Ending of which nobody learns the reason.
    NoReason("M0912", Warning) { kind: &'static str, is_text: bool }
    message(m) { format!("`{}` without a reason tells the person nothing", m.kind) }
    help(m) {
        Some(if m.is_text {
            format!("write `{} \"…\"` with a sentence", m.kind)
        } else {
            format!("write `{{\"end\": \"{}\", \"why\": \"…\"}}` with a sentence", m.kind)
        })
    }

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
    EmptyList("M0320", Error) { callee: SmolStr, name: SmolStr }
    message(m) {
        format!("`{}` of `{}` is an empty list, and the step begins at its first element", m.name, m.callee)
    }
    help(m) { Some(format!("name at least one element for `{}`", m.name)) }
}

/// The step to write for a word that is no callee.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct StepSuggestion {
    pub(crate) help: String,
    /// Edits, where the word and the arguments have one reading.
    pub(crate) fix: Option<Fix>,
}
