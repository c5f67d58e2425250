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

    /// A base moves to a person unwatched.
    Unwatched("M0905", Warning) { callee: SmolStr, person: SmolStr }
    message(m) { format!("`{}` moves to `{}`, and nothing watches how near it comes", m.callee, m.person) }
    help(m) {
        Some(format!("write `monitor when distance({}) < 0.5 m for 200 ms then pause during {{ … }}` around it", m.person))
    }

    /// The policy is done with something in the hand.
    EndsHolding("M0906", Warning) { object: SmolStr, since: Option<Span> }
    message(m) { format!("the policy is done while the hand holds `{}`", m.object) }
    help(m) {
        Some(format!("put it down or hand it over before, or say that it is meant: `achieves holding({})`", m.object))
    }
    related(m) { m.since.map(|span| Related::new("taken here", span)).into_iter().collect() }

    /// The policy opened a container and leaves it open.
    LeftOpen("M0907", Warning) { container: SmolStr, since: Option<Span> }
    message(m) { format!("the policy is done and leaves `{}` open", m.container) }
    help(m) { Some(format!("close it before, or say that it is meant: `achieves open({})`", m.container)) }
    related(m) { m.since.map(|span| Related::new("opened here", span)).into_iter().collect() }

    /// A handler of everything that goes on after `unsafe`.
    HidesUnsafe("M0908", Warning) { }
    message(_m) { "this `catch any` also takes `unsafe`, and goes on".to_owned() }
    help(_m) { Some("name the failures that are meant, or end the policy with `fail` or `replan`".to_owned()) }

    /// A retry that cannot succeed.
    HopelessRetry("M0909", Warning) { callee: SmolStr, why: String }
    message(m) { format!("to try `{}` again is no use: {}", m.callee, m.why) }
    help(m) { Some(format!("leave out `retry`, and repeat what `{}` needs together with it: `repeat 2 {{ … }}`", m.callee)) }

    /// A reaction that takes away what the body needs.
    ReactionBreaks("M0910", Warning) { callee: SmolStr, needs: String, maker: SmolStr, step: Span }
    message(m) {
        format!("when this fires, `{}` may take away {}, which `{}` needs afterwards", m.maker, m.needs, m.callee)
    }
    help(m) { Some(format!("bring {} about again at the end of the reaction, or `restart` the body", m.needs)) }
    related(m) { vec![Related::new("needed here", m.step)] }

    /// An action that changes nothing.
    Redundant("M0911", Warning) { callee: SmolStr, fact: String, since: Option<Span> }
    message(m) { format!("`{}` changes nothing: {} holds already", m.callee, m.fact) }
    help(_m) { Some("leave this step out".to_owned()) }
    related(m) { m.since.map(|span| Related::new("since here", span)).into_iter().collect() }
}
