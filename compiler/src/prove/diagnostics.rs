//! Diagnostics of refuted needs and goals (M05xx), and of other findings of the prover (M07xx, M08xx, M09xx).

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

    /// Step with a need that some path makes false.
    Refuted("M0501", Error) {
        callee: SmolStr, needs: String, story: String, culprit: Option<Span>, declared: Span,
        remedy: Option<String>,
        subject: Option<(SmolStr, bool)>,
    }
    message(m) { format!("`{}` needs {}, {}", m.callee, m.needs, m.story) }
    help(m) { m.remedy.clone().or_else(|| Some("change the steps before, or remove this one".to_owned())) }
    related(m) {
        culprit(m.culprit).into_iter().chain([Related::new("required here", m.declared)]).collect()
    }
    about(m) { Some(About { primitive: Some(m.callee.clone()), ..about(m.subject.as_ref()) }) }

    /// Step that uses a stale pose.
    Stale("M0502", Error) {
        name: SmolStr, callee: SmolStr, found: Span, moved: Option<Span>, mover: SmolStr,
    }
    message(m) { format!("`{}` is stale: `{}` ran after it was perceived", m.name, m.mover) }
    help(m) { Some(format!("perceive it again just before `{}`", m.callee)) }
    related(m) {
        let moved = m.moved.map(|span| Related::new("moved here", span));
        [Related::new("perceived here", m.found)].into_iter().chain(moved).collect()
    }

    /// Policy that ends while its goal is false.
    GoalRefuted("M0503", Error) {
        wanted: String, story: String, culprit: Option<Span>, remedy: Option<String>,
        subject: Option<(SmolStr, bool)>,
    }
    message(m) { format!("the policy ends without {}, {}", m.wanted, m.story) }
    help(m) { m.remedy.as_ref().map(|remedy| remedy.replace(" first", " before the policy ends")) }
    related(m) { culprit(m.culprit).into_iter().collect() }
    about(m) { Some(about(m.subject.as_ref())) }

    /// Handler of a failure that cannot happen.
    NeverCaught("M0504", Warning) { name: SmolStr }
    message(m) { format!("no step in this `try` can fail with `{}`", m.name) }
    help(m) { Some(format!("remove `{}` from the `catch`", m.name)) }

    /// Needs that stay unknown, which the engine checks just before the step.
    DeferredToRun("M0505", Note) { callee: SmolStr, what: String, step: String }
    message(m) { format!("left to the run: {}, checked before `{}` (step {})", m.what, m.callee, m.step) }
    help(m) {
        Some(format!("let a step before `{}` make it certain, or handle the failure with `try`", m.callee))
    }
    about(m) { Some(About { primitive: Some(m.callee.clone()), ..About::default() }) }

    /// Monitor that a step of its own body fires.
    BodyFires("M0506", Error) { step: SmolStr, holds: String, fired: Option<Span> }
    message(m) {
        format!("`{}` in the body of this monitor makes {} certain, so the monitor fires", m.step, m.holds)
    }
    help(m) {
        Some(format!("end `during` before `{}`, or watch a condition that the body leaves alone", m.step))
    }
    related(m) { m.fired.map(|span| Related::new("fired here", span)).into_iter().collect() }

    /// Branches that leave a fact with different values.
    Conflict("M0702", Error) { fact: String, first: Option<Span>, second: Option<Span> }
    message(m) { format!("two branches leave {} with different values", m.fact) }
    help(_m) { Some("run these steps one after the other".to_owned()) }
    related(m) {
        let first = m.first.map(|span| Related::new("one value here", span));
        let second = m.second.map(|span| Related::new("the other here", span));
        first.into_iter().chain(second).collect()
    }

    /// Monitor whose condition is always false.
    NeverFires("M0803", Warning) { what: &'static str }
    message(m) { format!("this condition is always false: {}", m.what) }
    help(_m) { Some("remove it, or watch a condition that can change".to_owned()) }

    /// Loops, monitors and parallel branches that are nested deeper than a limit; without one, so many nested
    /// ones that the proof was given up.
    TooDeep("M0804", Error) { limit: Option<usize> }
    message(m) {
        match m.limit {
            Some(limit) => format!("loops, monitors and parallel branches are nested more than {limit} deep"),
            None => "the proof takes too long, and is given up at this step".to_owned(),
        }
    }
    help(m) {
        Some(match m.limit {
            Some(_) => "reduce the nesting".to_owned(),
            None => "reduce the nesting, the reactions that go on with `resume`, or the steps".to_owned(),
        })
    }

    /// No path reaches a step.
    Unreached("M0902", Warning) { is_in_monitor: bool }
    message(_m) { "this step is never reached".to_owned() }
    help(m) {
        Some(if m.is_in_monitor {
            "the monitor around it fires as soon as it begins, because a condition already holds".to_owned()
        } else {
            "remove it, or change the steps before".to_owned()
        })
    }

    /// Motion of the base to a person without a monitor of the distance.
    Unwatched("M0905", Warning) { callee: SmolStr, person: SmolStr }
    message(m) { format!("`{}` moves to `{}` while no monitor watches the distance", m.callee, m.person) }
    help(m) {
        let near = format!("distance({}) < 0.5 m", m.person);
        let watch = format!("monitor when {near} for 200 ms then pause during {{ … }}");
        Some(format!("put `{watch}` around it"))
    }

    /// Policy that ends with a thing in the hand.
    EndsHolding("M0906", Warning) { object: SmolStr, since: Option<Span> }
    message(m) { format!("the policy ends while the hand holds `{}`", m.object) }
    help(m) {
        let intent = format!("achieves holding({})", m.object);
        Some(format!("put it down or hand it over first, or declare the intent: `{intent}`"))
    }
    related(m) { m.since.map(|span| Related::new("taken here", span)).into_iter().collect() }

    /// Policy that leaves a container open that it opened.
    LeftOpen("M0907", Warning) { container: SmolStr, since: Option<Span> }
    message(m) { format!("the policy ends and leaves `{}` open", m.container) }
    help(m) { Some(format!("close it first, or declare the intent: `achieves open({})`", m.container)) }
    related(m) { m.since.map(|span| Related::new("opened here", span)).into_iter().collect() }

    /// Handler of all failures that continues after `unsafe`.
    HidesUnsafe("M0908", Warning) { }
    message(_m) { "this `catch any` also catches `unsafe`, and the policy continues".to_owned() }
    help(_m) { Some("list the failures to catch, or end the policy with `fail` or `replan`".to_owned()) }

    /// Retry that cannot succeed.
    HopelessRetry("M0909", Warning) { callee: SmolStr, why: String }
    message(m) { format!("retrying `{}` cannot succeed: {}", m.callee, m.why) }
    help(m) {
        let together = format!("repeat `{}` together with the steps that it needs", m.callee);
        Some(format!("remove `retry`, and {together}: `repeat 2 {{ … }}`"))
    }

    /// Reaction that may undo a need of the body.
    ReactionBreaks("M0910", Warning) { callee: SmolStr, needs: String, maker: SmolStr, step: Span }
    message(m) {
        format!("when this fires, `{}` may undo {}, which `{}` needs afterwards", m.maker, m.needs, m.callee)
    }
    help(m) { Some(format!("restore {} at the end of the reaction, or `restart` the body", m.needs)) }
    related(m) { vec![Related::new("needed here", m.step)] }

    /// Action without an effect.
    Redundant("M0911", Warning) { callee: SmolStr, fact: String, since: Option<Span> }
    message(m) { format!("`{}` has no effect: {} already holds", m.callee, m.fact) }
    help(_m) { Some("remove this step".to_owned()) }
    related(m) { m.since.map(|span| Related::new("since here", span)).into_iter().collect() }
}
