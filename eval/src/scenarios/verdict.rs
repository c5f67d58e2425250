//! From the compiler's findings to the classes of the contract: one table.

use motet_syntax::{About, Diagnostic, Severity};

use super::policy::{Spot, Written};

/// Place of a finding in the plan.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Place {
    /// The step at its path.
    Step,
    /// The parallel step around that.
    Parallel,
    /// The step at its path, if another stands before it in its block.
    Behind,
    /// The final state.
    End,
    /// Nowhere: it is no error in the contract.
    Nowhere,
}

/// A row of the table: which findings, and what they are. Of several rows that fit, the first counts.
struct Entry {
    code: &'static str,
    /// Primitives, or none for all.
    primitives: &'static [&'static str],
    /// Subject of the condition, with the truth that is wanted.
    subject: Option<(&'static str, bool)>,
    /// The key at its path, or none for all.
    key: &'static str,
    class: &'static str,
    place: Place,
}

const fn row(code: &'static str, class: &'static str, place: Place) -> Entry {
    Entry { code, primitives: &[], subject: None, key: "", class, place }
}

const fn of(code: &'static str, primitives: &'static [&'static str], class: &'static str) -> Entry {
    Entry { code, primitives, subject: None, key: "", class, place: Place::Step }
}

const fn need(
    subject: &'static str,
    holds: bool,
    primitives: &'static [&'static str],
    class: &'static str,
) -> Entry {
    Entry { code: "M0501", primitives, subject: Some((subject, holds)), key: "", class, place: Place::Step }
}

const TABLE: &[Entry] = &[
    // Words: what is wrong with a step's name comes before what is wrong with its arguments.
    row("M0201", "unknown_primitive", Place::Step),
    row("M0402", "unknown_primitive", Place::Step),
    row("M0204", "arity", Place::Step),
    row("M0303", "arity", Place::Step),
    row("M0304", "arity", Place::Step),
    row("M0203", "unbound_ref", Place::Step),
    of("M0202", &["go", "place"], "unknown_location"),
    row("M0202", "unknown_object", Place::Step),
    row("M0904", "unknown_object", Place::Step),
    of("M0903", &["search"], ""),
    row("M0903", "ambiguous_ref", Place::Step),
    Entry { key: "repeat", ..row("M0106", "infinite_retry", Place::Step) },
    row("M0301", "arg_type", Place::Step),
    row("M0307", "arg_type", Place::Step),
    row("M0310", "out_of_range", Place::Step),
    row("M0404", "out_of_range", Place::Step),
    row("M0701", "resource_conflict", Place::Parallel),
    row("M0702", "resource_conflict", Place::Step),
    // State.
    need("settled", true, &[], "unsafe_swap_point"),
    need("standing", true, &[], "not_ready"),
    need("folded", true, &[], "posture"),
    need("raised", true, &[], "posture"),
    need("forbidden", false, &[], "safety_rule"),
    need("kept_from", false, &[], "safety_rule"),
    need("monitored", true, &[], "missing_monitor"),
    need("path_blocked", false, &[], "blocked_path"),
    need("free", true, &["close"], "close_while_holding"),
    need("free", true, &["open"], "open_while_holding"),
    need("free", true, &[], "pick_while_holding"),
    need("holding", true, &["handover"], "handover_without_holding"),
    need("holding", true, &["lift"], "lift_without_holding"),
    need("holding", true, &[], "place_without_holding"),
    need("stale", false, &[], "stale_perception"),
    need("fresh", true, &[], "no_perception"),
    need("serves", true, &[], "arg_type"),
    need("at", true, &[], "not_at_location"),
    need("open", true, &["close"], "redundant_state"),
    need("open", true, &[], "closed_container"),
    need("open", false, &[], "redundant_state"),
    need("locked", false, &[], "locked"),
    need("clear", true, &[], "blocked_object"),
    need("full", false, &[], "target_occupied"),
    need("mass", true, &[], "payload"),
    need("width", true, &["place"], "target_occupied"),
    need("width", true, &[], "not_graspable"),
    need("height", true, &[], "unreachable"),
    need("away", true, &[], "unreachable"),
    need("handle_height", true, &[], "unreachable"),
    need("handle_away", true, &[], "unreachable"),
    row("M0502", "stale_perception", Place::Step),
    row("M0601", "unreachable", Place::Step),
    row("M0902", "dead_code", Place::Behind),
    // The final state: a goal that is missed says more than what is left in the hand.
    Entry { subject: Some(("open", false)), ..row("M0503", "missing_close", Place::End) },
    row("M0503", "goal_not_reached", Place::End),
    row("M0906", "ends_holding", Place::End),
    // Intent that the contract does not ask for.
    row("M0504", "", Place::Nowhere),
    row("M0802", "", Place::Nowhere),
    row("M0803", "", Place::Nowhere),
    row("M0901", "", Place::Nowhere),
    row("M0905", "", Place::Nowhere),
    row("M0907", "", Place::Nowhere),
    row("M0908", "", Place::Nowhere),
    row("M0909", "", Place::Nowhere),
    row("M0910", "", Place::Nowhere),
    row("M0911", "", Place::Nowhere),
];

impl Entry {
    fn fits(&self, said: &Diagnostic) -> bool {
        let nothing = About::default();
        let about = said.about.as_ref().unwrap_or(&nothing);
        let primitive = about.primitive.as_deref().unwrap_or_default();
        self.code == said.code.0
            && (self.key.is_empty() || said.path.rsplit('/').next() == Some(self.key))
            && (self.primitives.is_empty() || self.primitives.contains(&primitive))
            && self.subject.is_none_or(|(subject, holds)| {
                about.subject.as_deref() == Some(subject) && about.wanted == Some(holds)
            })
    }
}

/// An error of a plan.
#[derive(Clone, Debug)]
pub(super) struct Found<'d> {
    pub(super) class: &'static str,
    /// Its step as a row writes it.
    pub(super) step: String,
    pub(super) said: &'d Diagnostic,
}

/// The first error of a plan.
pub(super) fn first<'d>(said: &'d [Diagnostic], written: &Written) -> Option<Found<'d>> {
    let found = said.iter().filter_map(|said| {
        let (rank, class, place) = match TABLE.iter().position(|entry| entry.fits(said)) {
            Some(rank) => TABLE.get(rank).map(|entry| (rank, entry.class, entry.place))?,
            // What the table does not know is an error if the compiler calls it one.
            None => (0, said.code.0, Place::Step),
        };
        if class.is_empty()
            || (said.severity != Severity::Error && !TABLE.iter().any(|entry| entry.fits(said)))
        {
            return None;
        }
        let end = Spot { order: usize::MAX, label: "end".to_owned() };
        let spot = written.spot(&said.path).cloned().unwrap_or(end.clone());
        let spot = match place {
            Place::Step => spot,
            Place::Parallel => written.parallel(&said.path).cloned().unwrap_or(spot),
            Place::Behind if is_first(&said.path) => return None,
            Place::Behind => spot,
            Place::End => end,
            Place::Nowhere => return None,
        };
        // Among needs of one step the order of its contract counts, so all of them rank alike.
        let rank = if said.code.0 == "M0501" { usize::MAX / 2 } else { rank };
        Some((spot, rank, Found { class, step: String::new(), said }))
    });
    let first = found.min_by(|a, b| (a.0.order, a.1).cmp(&(b.0.order, b.1)));
    first.map(|(spot, _, found)| Found { step: spot.label, ..found })
}

/// True if a pointer ends in the first step of a block: a branch that is never taken.
fn is_first(pointer: &str) -> bool {
    pointer.rsplit('/').next() == Some("0")
}
