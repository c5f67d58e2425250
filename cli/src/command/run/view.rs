//! What a run looks like: a trait for its three shapes, and what they say alike.

use motet_graph::Graph;
use motet_graph::draw::Names;
use motet_runtime::{Effect, Event, RunEnd, Time};

use super::tree::{Status, Tree};
use crate::out::plain;

/// By which clock a run goes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Clock {
    /// The simulated world's, which may be fast.
    Simulated,
    /// The wall clock.
    Wall,
}

/// Shows a run.
pub(super) trait View {
    /// An event is about to be handled.
    fn event(&mut self, _event: &Event) {}
    /// An effect is about to be carried out.
    fn effect(&mut self, now: Time, effect: &Effect);
    /// An effect was carried out before the process began; a view that shows a state takes it in without a word.
    fn past(&mut self, now: Time, effect: &Effect);
    /// Another policy takes over, which another view will show.
    fn leave(&mut self, _now: Time) {}
    /// An effect came of a policy that was replaced: of this view's, beside which another one shows already.
    fn late(&mut self, now: Time, effect: &Effect) {
        self.effect(now, effect);
    }
    /// Time has passed.
    fn reached(&mut self, now: Time);
    /// Whether nobody reads what is shown any more.
    fn is_closed(&self) -> bool;
    /// The run is over.
    fn finish(&mut self, now: Time, end: &RunEnd);
}

/// The mark of a status.
pub(super) fn mark(status: Status) -> &'static str {
    match status {
        Status::Pending => "·",
        Status::Running => "▶",
        Status::Done => "✓",
        Status::Failed => "✗",
        Status::Interrupted => "■",
    }
}

/// A text in the colour of a status.
pub(super) fn paint(text: &str, status: Status, is_colored: bool) -> String {
    let color = match status {
        Status::Pending => "2",
        Status::Running => "1;36",
        Status::Done => "32",
        Status::Failed => "1;31",
        Status::Interrupted => "33",
    };
    if is_colored { format!("\u{1b}[{color}m{text}\u{1b}[0m") } else { text.to_owned() }
}

/// `12.3 s`, `2 min 5.0 s`.
pub(super) fn duration(span: Time) -> String {
    let secs = span.secs();
    if secs < 60.0 {
        return format!("{secs:.1} s");
    }
    let minutes = (secs / 60.0).floor();
    format!("{minutes:.0} min {:.1} s", secs - minutes * 60.0)
}

/// The last words: outcome, reason, duration, steps.
pub(super) fn summary(
    graph: &Graph,
    tree: &Tree,
    (now, clock): (Time, Clock),
    end: &RunEnd,
    is_colored: bool,
) -> String {
    let (status, what, why) = match end {
        RunEnd::Done { why } => (Status::Done, "done".to_owned(), why.clone()),
        RunEnd::Failed { kind, why, node } => {
            let place = graph.nodes.get(node.index());
            let at = place.map_or_else(String::new, |node| {
                format!(" in `{}` ({})", plain(&Names(graph).brief(&node.kind)), node.path)
            });
            (Status::Failed, format!("failed with `{}`{at}", plain(kind)), why.clone())
        }
        RunEnd::Replan { why } => (Status::Failed, "asks for a new plan".to_owned(), why.clone()),
        RunEnd::Interrupted => (Status::Interrupted, "interrupted".to_owned(), None),
        RunEnd::Fault(fault) => (Status::Failed, "could not go on".to_owned(), Some(fault.to_string())),
    };
    let mut text = paint(&format!("{} {}: {what}", mark(status), graph.policy), status, is_colored);
    if let Some(why) = why {
        text.push_str(&format!("\n  why: {}", plain(&why)));
    }
    let steps = crate::out::count(tree.done, "step");
    let clock = match clock {
        Clock::Simulated => " of simulated time",
        Clock::Wall => "",
    };
    text.push_str(&format!("\n  {}{clock}, {steps} done, {} failed", duration(now), tree.failed));
    text
}
