//! Handlers, monitors and loops.

use motet_graph::{BindingId, Condition, Handler, NodeId, Reaction, RegionId, Term, Value, Watch};
use motet_stdlib::lang::{builtin_failures, failures};

use super::{Context, Exporter, sequence};
use crate::element::Element;
use crate::names::{ENDED, FAILURE, failure_of, met_of};

impl Exporter<'_> {
    /// A body with its handlers. Where the first of them catches every failure of the body, a fallback
    /// says so; else the kind of the failure decides.
    pub(super) fn handled(&mut self, body: RegionId, handlers: &[Handler], context: Context) -> Element {
        let mut left = self.failures(body);
        let mut chosen = Vec::new();
        let mut needs_kind = false;
        for handler in handlers {
            let kinds = handler.on.as_ref().map(|on| {
                let kinds = on.iter().map(|kind| self.kind(*kind));
                kinds.filter(|kind| left.contains(kind)).collect::<Vec<_>>()
            });
            if let Some(kinds) = &kinds {
                kinds.iter().for_each(|kind| {
                    left.remove(kind);
                });
            }
            let is_whole = kinds.is_none() || left.is_empty();
            if kinds.as_ref().is_some_and(Vec::is_empty) && !is_whole {
                continue;
            }
            needs_kind |= !is_whole || !chosen.is_empty();
            chosen.push((kinds, handler));
            if is_whole {
                break;
            }
        }
        let needs_kind = needs_kind || chosen.is_empty() && context.needs_kind;
        let inner = Context { needs_kind: needs_kind || context.needs_kind, ..context };
        let before = self.endings.len();
        let element = self.region(body, inner);
        let has_ending = self.endings.len() > before;
        let mut rest: Option<Element> = None;
        for (index, (kinds, handler)) in chosen.iter().enumerate().rev() {
            let steps = self.region(handler.body, context);
            let is_last = index + 1 == chosen.len();
            let is_whole = is_last && (kinds.is_none() || left.is_empty());
            rest = Some(match kinds.as_ref().filter(|_| !is_whole) {
                None => steps,
                Some(kinds) => {
                    self.has_kinds = true;
                    let tests: Vec<_> = kinds.iter().map(|kind| format!("{FAILURE} == '{kind}'")).collect();
                    let test = Element::new("ScriptCondition").with("code", tests.join(" || "));
                    let uncaught = rest.take().unwrap_or_else(|| Element::new("AlwaysFailure"));
                    Element::new("IfThenElse").around([test, steps, uncaught])
                }
            });
        }
        let Some(mut handling) = rest else { return element };
        if has_ending {
            let goes_on = Element::new("ScriptCondition").with("code", format!("{ENDED} == ''"));
            handling = Element::new("Sequence").around([goes_on, handling]);
        }
        Element::new("Fallback").around([element, handling])
    }

    pub(super) fn monitor(
        &mut self,
        id: NodeId,
        path: &str,
        watches: &[Watch],
        body: RegionId,
        context: Context,
        deadline_secs: Option<f64>,
    ) -> Element {
        if let Some(secs) = deadline_secs {
            return self.within(id, path, secs, body, context);
        }
        let mut guards = Vec::new();
        for watch in watches {
            let shown = self.names.condition(&watch.condition);
            let (part, reason) = match &watch.reaction {
                Reaction::End { .. } if watch.hold_secs > 0.0 => {
                    (format!("`when {shown} for {} s`", watch.hold_secs), "a node keeps no time of its child")
                }
                Reaction::End { how, of, why } => {
                    let holds_not = self.condition(path, &watch.condition, false);
                    let ending = self.ending(path, *how, *of, why.as_ref());
                    guards.push(Element::new("Fallback").around([holds_not, ending]));
                    continue;
                }
                Reaction::Pause { .. } => (
                    format!("a pause when `{shown}`"),
                    "what a node interrupts starts again from its beginning",
                ),
                Reaction::Restart { .. } => (
                    format!("`restart` when `{shown}`"),
                    "no node tells a restart from a failure of its child",
                ),
                Reaction::Resume { .. } => (
                    format!("`resume` when `{shown}`"),
                    "what a node interrupts starts again from its beginning",
                ),
            };
            self.refuse(path, part, reason);
        }
        let body = self.region(body, context);
        Element::new("ReactiveSequence").around(guards).around([body])
    }

    /// A body with a deadline.
    fn within(&mut self, id: NodeId, path: &str, secs: f64, body: RegionId, context: Context) -> Element {
        let timeout = Element::new("Timeout").with("msec", self.msec(path, secs));
        let steps = self.region(body, context);
        if !context.needs_kind {
            return timeout.around([steps]);
        }
        self.has_kinds = true;
        let own = failure_of(id.0);
        let start = Element::new("Script").with("code", format!("{own} := '{}'", builtin_failures::TIMEOUT));
        let body = Element::new("Sequence").with("_onFailure", format!("{own} := {FAILURE}")).around([steps]);
        let timeout = timeout.with("_onFailure", format!("{FAILURE} := {own}")).around([body]);
        sequence(vec![start, timeout])
    }

    /// A loop. One with a test runs on without a step once the test was met.
    pub(super) fn repeat(
        &mut self,
        id: NodeId,
        path: &str,
        times: u32,
        body: RegionId,
        until: Option<&Condition>,
        context: Context,
    ) -> Element {
        if i32::try_from(times).is_err() {
            self.refuse(path, format!("`repeat {times}`"), "a node counts to 2147483647");
        }
        let cycles = Element::new("Repeat").with("num_cycles", times.to_string());
        let steps = self.region(body, context);
        let Some(until) = until else { return cycles.around([steps]) };
        let met = met_of(id.0);
        let script = |value: &str| Element::new("Script").with("code", format!("{met} := {value}"));
        let is_met = || Element::new("ScriptCondition").with("code", format!("{met} == true"));
        let nothing = || Element::new("AlwaysSuccess");
        let test = self.condition(path, until, true);
        let test = Element::new("IfThenElse").around([test, script("true"), nothing()]);
        let round = Element::new("Sequence").around([steps, test]);
        let round = Element::new("IfThenElse").around([is_met(), nothing(), round]);
        let ending = self.failing(is_met(), failures::EXHAUSTED, context);
        sequence(vec![script("false"), cycles.around([round]), ending])
    }

    /// A loop over a list that is known when the policy is compiled.
    pub(super) fn each(
        &mut self,
        path: &str,
        item: BindingId,
        list: &Term,
        at_most: u32,
        body: RegionId,
        context: Context,
    ) -> Element {
        let Term::Literal(Value::List(items)) = list else {
            let shown = self.names.term(list);
            let reason = "a loop of BehaviorTree.CPP takes the elements of its list away";
            return self.refuse(path, format!("a loop over `{shown}`"), reason);
        };
        let steps = self.region(body, context);
        if items.is_empty() {
            return Element::new("AlwaysSuccess");
        }
        if items.len() > at_most as usize {
            return self.failing(Element::new("AlwaysFailure"), failures::EXHAUSTED, context);
        }
        let queue = self.port(path, list).unwrap_or_default();
        let value = format!("{{{}}}", self.entry(item));
        Element::new("LoopString").with("queue", queue).with("value", value).around([steps])
    }
}
