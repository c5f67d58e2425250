//! Views of a run: redrawn in place on a terminal, line by line, or as JSON events.

mod events;
mod screen;

use std::io::{self, IsTerminal};
use std::sync::Arc;

use motet_graph::Graph;
use motet_graph::draw::Names;
use motet_runtime::{Effect, Event, Fault, RunControl, RunEnd, Time};

use crate::flags::OutputFormat;
use crate::output::{Colors, escape};
use motet::page::tree::{StepStatus, StepTree};

/// Words of a person that control a run.
pub(crate) trait SpokenControl {
    /// Takes in the next word. `None` if nothing was said.
    fn control(&mut self, now: Time) -> Option<RunControl>;

    /// Longest span of the run without a look for words.
    fn at_least_every(&self) -> Time;

    /// True once a word has stopped the run, or nobody is left to let it go on.
    fn is_stopped(&self) -> bool;
}

/// Clock of a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Clock {
    /// Clock of the simulation, at any speed.
    Simulated,
    Wall,
}

/// View of a run.
pub(crate) trait View {
    /// Takes an event before the engine handles it.
    fn event(&mut self, _event: &Event) {}
    /// Takes an effect before it is carried out.
    fn effect(&mut self, now: Time, effect: &Effect);
    /// Takes an effect from before this process began: it updates the state but prints nothing.
    fn past(&mut self, now: Time, effect: &Effect);
    /// Goes on below what something else has printed.
    fn go_below(&mut self) {}
    /// Ends the view, since another view shows the policy that takes over.
    fn leave(&mut self, _now: Time) {}
    /// Takes an effect of this view's policy after the view has ended.
    fn late(&mut self, now: Time, effect: &Effect) {
        self.effect(now, effect);
    }
    /// Notices that the run has reached a time.
    fn reached(&mut self, now: Time);
    /// Is `true` once the reader of stdout is gone.
    fn is_closed(&self) -> bool;
    /// Prints how the run ended.
    fn finish(&mut self, now: Time, end: &RunEnd);
}

/// View in a format: for people, a terminal gets a tree and a pipe gets lines.
pub(crate) fn view(format: OutputFormat, graph: &Graph, colors: Colors, clock: Clock) -> Box<dyn View> {
    let graph = Arc::new(graph.clone());
    match format {
        OutputFormat::Json => Box::new(events::Events::new(graph)),
        OutputFormat::Human if io::stdout().is_terminal() => {
            Box::new(screen::Screen::new(graph, colors.stdout, clock))
        }
        OutputFormat::Human => Box::new(screen::Lines::new(graph, colors.stdout, clock)),
    }
}

/// Sign of a status.
fn mark(status: StepStatus) -> &'static str {
    match status {
        StepStatus::Pending => "·",
        StepStatus::Running => "▶",
        StepStatus::Done => "✓",
        StepStatus::Failed => "✗",
        StepStatus::Interrupted => "■",
    }
}

/// Text in the colour of a status.
fn paint(text: &str, status: StepStatus, is_colored: bool) -> String {
    let color = match status {
        StepStatus::Pending => "2",
        StepStatus::Running => "1;36",
        StepStatus::Done => "32",
        StepStatus::Failed => "1;31",
        StepStatus::Interrupted => "33",
    };
    if is_colored { format!("\u{1b}[{color}m{text}\u{1b}[0m") } else { text.to_owned() }
}

/// Duration for people: `12.3 s`, `2 min 5.0 s`.
fn duration(span: Time) -> String {
    let secs = span.secs();
    if secs < 60.0 {
        return format!("{secs:.1} s");
    }
    let minutes = (secs / 60.0).floor();
    format!("{minutes:.0} min {:.1} s", secs - minutes * 60.0)
}

/// Summary after a run: outcome, reason, duration, number of steps.
fn summary(
    graph: &Graph,
    tree: &StepTree,
    (now, clock): (Time, Clock),
    end: &RunEnd,
    is_colored: bool,
) -> String {
    let (status, what, why) = match end {
        RunEnd::Done { why, result: None } => (StepStatus::Done, "done".to_owned(), why.clone()),
        RunEnd::Done { why, result: Some(result) } => {
            (StepStatus::Done, format!("done, gave {}", escape(&result.to_string())), why.clone())
        }
        RunEnd::Failed { kind, why, node } => {
            let place = graph.nodes.get(node.index());
            let at = place.map_or_else(String::new, |node| {
                format!(" in `{}` ({})", escape(&Names(graph).brief(&node.kind)), node.path)
            });
            let why = why.clone().or_else(|| tree.reason(*node).map(str::to_owned));
            (StepStatus::Failed, format!("failed with `{}`{at}", escape(kind)), why)
        }
        RunEnd::Declined { why } => (StepStatus::Interrupted, "declined".to_owned(), why.clone()),
        RunEnd::Replan { why } => (StepStatus::Failed, "asks for a new plan".to_owned(), why.clone()),
        RunEnd::Interrupted => (StepStatus::Interrupted, "interrupted".to_owned(), None),
        RunEnd::Fault(fault) => {
            let mut why = fault.to_string();
            // The step may be of a policy before this one.
            if let Fault::NotStopped { node, .. } = fault
                && let Some(row) = tree.row(*node).filter(|row| row.status == StepStatus::Running)
            {
                why.push_str(&format!("; it was at `{}`", row.label));
            }
            (StepStatus::Failed, "stopped by a fault of the engine".to_owned(), Some(why))
        }
    };
    let mut text = paint(&format!("{} {}: {what}", mark(status), escape(&graph.policy)), status, is_colored);
    if let Some(why) = why {
        text.push_str(&format!("\n  why: {}", escape(&why)));
    }
    let steps = crate::output::count(tree.done, "step");
    let clock = match clock {
        Clock::Simulated => " of simulated time",
        Clock::Wall => "",
    };
    text.push_str(&format!("\n  {}{clock}, {steps} done, {} failed", duration(now), tree.failed));
    text
}
