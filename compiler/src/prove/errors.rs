//! What the prover refutes (M05xx), and what else it sees on the way (M07xx, M08xx, M09xx).

use motet_syntax::{About, Related, Span};
use smol_str::SmolStr;

fn culprit(span: Option<Span>) -> Option<Related> {
    span.map(|span| Related::new("changed here", span))
}

fn about(subject: Option<&(SmolStr, bool)>) -> About {
    let (subject, wanted) = subject.cloned().unzip();
    About { subject, wanted, ..About::default() }
}

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// A step needs what some path makes false.
    Refuted("M0501", Error) {
        callee: SmolStr, needs: String, story: String, culprit: Option<Span>, declared: Span, remedy: Option<String>,
        subject: Option<(SmolStr, bool)>,
    }
    message(m) { format!("`{}` needs {}, {}", m.callee, m.needs, m.story) }
    help(m) { m.remedy.clone().or_else(|| Some("change the steps before, or leave this one out".to_owned())) }
    related(m) {
        culprit(m.culprit).into_iter().chain([Related::new("asked for here", m.declared)]).collect()
    }
    about(m) { Some(About { primitive: Some(m.callee.clone()), ..about(m.subject.as_ref()) }) }

    /// A step uses a pose that is no longer right.
    Stale("M0502", Error) {
        name: SmolStr, callee: SmolStr, found: Span, moved: Option<Span>, mover: SmolStr,
    }
    message(m) { format!("`{}` is stale: `{}` came after it was perceived", m.name, m.mover) }
    help(m) { Some(format!("perceive it again just before `{}`", m.callee)) }
    related(m) {
        let moved = m.moved.map(|span| Related::new("moved here", span));
        [Related::new("perceived here", m.found)].into_iter().chain(moved).collect()
    }

    /// Where the policy is done its goal is false.
    GoalRefuted("M0503", Error) {
        wanted: String, story: String, culprit: Option<Span>, remedy: Option<String>, subject: Option<(SmolStr, bool)>,
    }
    message(m) { format!("the policy is done without {}, {}", m.wanted, m.story) }
    help(m) { m.remedy.as_ref().map(|remedy| remedy.replace(": call it before", "")) }
    related(m) { culprit(m.culprit).into_iter().collect() }
    about(m) { Some(about(m.subject.as_ref())) }

    /// A handler for a failure that cannot happen.
    NeverCaught("M0504", Warning) { name: SmolStr }
    message(m) { format!("nothing in this `try` can fail with `{}`", m.name) }
    help(m) { Some(format!("leave `{}` out of the `catch`", m.name)) }

    /// Branches that leave one fact with different values.
    Conflict("M0702", Error) { fact: String, first: Option<Span>, second: Option<Span> }
    message(m) { format!("two branches leave {} with different values", m.fact) }
    help(_m) { Some("do these steps one after the other".to_owned()) }
    related(m) {
        let first = m.first.map(|span| Related::new("one value here", span));
        let second = m.second.map(|span| Related::new("the other here", span));
        first.into_iter().chain(second).collect()
    }

    /// A monitor with a condition that is always false.
    NeverFires("M0803", Warning) { }
    message(_m) { "this condition is always false: the monitor can never fire".to_owned() }
    help(_m) { Some("leave it out, or watch something that can change".to_owned()) }

    /// Loops, monitors and parallel branches nested too deep.
    TooDeep("M0804", Error) { limit: usize }
    message(m) { format!("loops, monitors and parallel branches are nested more than {} deep", m.limit) }
    help(_m) { Some("make it flatter".to_owned()) }

    /// A step that no way leads to.
    Unreached("M0902", Warning) { }
    message(_m) { "this step is never reached".to_owned() }
    help(_m) { Some("leave it out, or change what comes before".to_owned()) }
}
