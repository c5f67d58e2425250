//! Contracts of the actions of a made-up domain, and states of its world, in which every fact is true or
//! false.
//!
//! This is a reading of the language of its own: it shares nothing with the compiler and the engine.

use std::fmt;
use std::ops::Range;

use super::make::LIBRARY;

/// Kind of the standard library.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    /// The root of all kinds.
    Entity,
    Object,
    Container,
    /// Kind of the entity `user`.
    Person,
    /// Kind of the entity `start`.
    Place,
    /// An enumeration: its cases stand among the entities, and are none.
    Mode,
}

impl Kind {
    /// Returns whether each entity of this kind is one of another.
    #[must_use]
    pub(super) fn is(self, other: Self) -> bool {
        self == other || other == Self::Entity && self != Self::Mode
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

/// Argument of a fluent or of a comparison.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Arg {
    /// An entity of the domain, by its index.
    Entity(usize),
    /// A parameter of the action.
    Param(usize),
    /// Subject of a quantified clause.
    Each,
    /// The result of the perception.
    Result,
    /// A name of the policy.
    Name(usize),
    /// The first of a list of the policy.
    First(usize),
    /// Every entity in an effect, some entity in a condition.
    Any,
}

/// A fluent with its arguments.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Atom {
    /// Index of the fluent.
    pub(super) fluent: usize,
    pub(super) args: Vec<Arg>,
}

/// A condition.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Condition {
    Is(Atom),
    Same(Arg, Arg),
    Not(Box<Self>),
    All(Vec<Self>),
    AnyOf(Vec<Self>),
    /// A failure that a handler has named is of a kind. Only tests of policies ask for it, and of those only
    /// the outcome in the run is known.
    Kind(usize, &'static str),
    /// A list of the policy is empty; as with [`Self::Kind`].
    Empty(usize),
    /// A length compares with a number; as with [`Self::Kind`].
    Length(Length, &'static str, u32),
}

/// Length of a list of the policy.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Length {
    Of(usize),
    /// Of a list whose length has a name.
    Named(usize),
}

/// A need, perhaps of each entity of a kind, perhaps under a condition.
#[derive(Clone, Debug)]
pub(super) struct Need {
    pub(super) condition: Condition,
    pub(super) each: Option<Kind>,
    pub(super) when: Option<Condition>,
}

/// An entry of `makes` or `unsettles`; there `truth` says nothing.
#[derive(Clone, Debug)]
pub(super) struct Change {
    pub(super) atom: Atom,
    pub(super) truth: bool,
    pub(super) each: Option<Kind>,
    pub(super) when: Option<Condition>,
}

/// An action or a perception.
#[derive(Clone, Debug, Default)]
pub(super) struct Action {
    pub(super) name: String,
    pub(super) params: Vec<Kind>,
    pub(super) needs: Vec<Need>,
    pub(super) makes: Vec<Change>,
    pub(super) unsettles: Vec<Change>,
    pub(super) fails: Vec<&'static str>,
    /// Resource that it holds.
    pub(super) uses: Option<&'static str>,
    /// True if what it makes may be otherwise once a later step uses the base.
    pub(super) is_stale_by_base: bool,
    /// Entities: what it makes may be otherwise once a later step moves one of them.
    pub(super) is_stale_by: Vec<Arg>,
    /// Kind of the entity or the case that a perception finds.
    pub(super) finds: Option<Kind>,
    /// True for a perception that finds a list of objects instead.
    pub(super) finds_all: bool,
}

/// Entities, fluents, actions and a start.
#[derive(Clone, Debug, Default)]
pub(super) struct Domain {
    /// The declared ones first, then those of which the domain says nothing, then those of the standard
    /// library.
    pub(super) entities: Vec<(String, Kind)>,
    /// Number of entities that the domain declares.
    pub(super) declared: usize,
    /// Name of each fluent.
    pub(super) names: Vec<String>,
    /// Kinds of the parameters of each fluent.
    pub(super) fluents: Vec<Vec<Kind>>,
    /// Fluent that stands for the measure `distance`: it holds where the reading is less than a metre.
    pub(super) measure: Option<usize>,
    pub(super) actions: Vec<Action>,
    pub(super) start: Vec<(Atom, bool)>,
    /// True if everything else is false at the start.
    pub(super) is_closed: bool,
}

/// Values of what a contract speaks of, as entities.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    pub(super) params: Vec<usize>,
    pub(super) each: Option<usize>,
    pub(super) result: Option<usize>,
}

/// A state of the world: the truth of every fact, by its cell.
pub(super) type State = Vec<bool>;

impl Domain {
    /// Number of facts.
    #[must_use]
    pub(super) fn size(&self) -> usize {
        self.fluents.iter().map(|params| self.cells_of(params.len())).sum()
    }

    fn cells_of(&self, arity: usize) -> usize {
        (0..arity).fold(1, |count, _| count * self.entities.len())
    }

    /// The entities of a kind.
    pub(super) fn of_kind(&self, kind: Kind) -> impl Iterator<Item = usize> + '_ {
        (0..).zip(&self.entities).filter(move |(_, (_, own))| own.is(kind)).map(|(index, _)| index)
    }

    /// Returns whether the domain declares anything of a kind.
    #[must_use]
    pub(super) fn has(&self, kind: Kind) -> bool {
        self.of_kind(kind).any(|one| one < self.declared)
    }

    /// Entities of which the domain says nothing.
    #[must_use]
    pub(super) fn undeclared(&self) -> Range<usize> {
        self.declared..self.entities.len() - LIBRARY.len()
    }

    /// Index of an entity.
    #[must_use]
    pub(super) fn entity(&self, name: &str) -> Option<usize> {
        self.entities.iter().position(|(known, _)| known == name)
    }

    /// Index of a fluent.
    #[must_use]
    pub(super) fn fluent(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Cells of the facts of a fluent whose arguments are these entities, or any.
    #[must_use]
    pub(super) fn cells(&self, fluent: usize, args: &[Option<usize>]) -> Vec<usize> {
        let Some(params) = self.fluents.get(fluent) else { return Vec::new() };
        let mut cells: Vec<usize> =
            vec![self.fluents.iter().take(fluent).map(|params| self.cells_of(params.len())).sum()];
        for ((index, arg), kind) in args.iter().enumerate().zip(params) {
            let weight = self.cells_of(index);
            let choices: Vec<usize> = arg.map_or_else(|| self.of_kind(*kind).collect(), |one| vec![one]);
            cells =
                choices.iter().flat_map(|one| cells.iter().map(move |cell| cell + one * weight)).collect();
        }
        cells
    }

    /// The fact of a cell, with its truth, in words.
    #[must_use]
    pub(super) fn said(&self, cell: usize, truth: bool) -> String {
        let mut first = 0;
        for (fluent, params) in self.names.iter().zip(&self.fluents) {
            let count = self.cells_of(params.len());
            if cell < first + count {
                let mut rest = cell - first;
                let args = params.iter().map(|_| {
                    let name = self.entities.get(rest % self.entities.len()).map_or("", |(name, _)| name);
                    rest /= self.entities.len();
                    name
                });
                let args: Vec<&str> = args.collect();
                return format!("{fluent}({}) becomes {truth}", args.join(", "));
            }
            first += count;
        }
        String::new()
    }

    /// Cells of an atom; none where an argument has no value.
    #[must_use]
    pub(super) fn cells_in(&self, atom: &Atom, frame: &Frame) -> Vec<usize> {
        let args: Option<Vec<Option<usize>>> = atom
            .args
            .iter()
            .map(|arg| if *arg == Arg::Any { Some(None) } else { frame.value(*arg).map(Some) })
            .collect();
        args.map_or_else(Vec::new, |args| self.cells(atom.fluent, &args))
    }

    /// Truth of a condition in a state.
    #[must_use]
    pub(super) fn holds(&self, condition: &Condition, frame: &Frame, state: &State) -> bool {
        match condition {
            Condition::Is(atom) => {
                self.cells_in(atom, frame).iter().any(|cell| state.get(*cell).copied().unwrap_or(false))
            }
            Condition::Same(one, other) => frame.value(*one) == frame.value(*other),
            Condition::Not(inner) => !self.holds(inner, frame, state),
            Condition::All(parts) => parts.iter().all(|part| self.holds(part, frame, state)),
            Condition::AnyOf(parts) => parts.iter().any(|part| self.holds(part, frame, state)),
            Condition::Kind(..) | Condition::Empty(_) | Condition::Length(..) => false,
        }
    }

    /// Truth of a need in a state, for all but the entities of which nobody has heard.
    #[must_use]
    pub(super) fn meets(&self, need: &Need, frame: &Frame, (state, unheard): (&State, &[usize])) -> bool {
        let frames = self.frames(need.each, frame).into_iter();
        let mut heard = frames.filter(|frame| frame.each.is_none_or(|each| !unheard.contains(&each)));
        heard.all(|frame| {
            need.when.as_ref().is_some_and(|when| !self.holds(when, &frame, state))
                || self.holds(&need.condition, &frame, state)
        })
    }

    /// Cells on which a need depends.
    #[must_use]
    pub(super) fn asked(&self, need: &Need, frame: &Frame) -> Vec<usize> {
        let mut cells = Vec::new();
        for frame in self.frames(need.each, frame) {
            for condition in std::iter::once(&need.condition).chain(&need.when) {
                self.mentioned(condition, &frame, &mut cells);
            }
        }
        cells
    }

    fn mentioned(&self, condition: &Condition, frame: &Frame, cells: &mut Vec<usize>) {
        match condition {
            Condition::Is(atom) => cells.extend(self.cells_in(atom, frame)),
            Condition::Same(..) | Condition::Kind(..) | Condition::Empty(_) | Condition::Length(..) => {}
            Condition::Not(inner) => self.mentioned(inner, frame, cells),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                parts.iter().for_each(|part| self.mentioned(part, frame, cells));
            }
        }
    }

    /// Cells that changes may touch in a state, each with its truth afterwards.
    #[must_use]
    pub(super) fn changed(&self, changes: &[Change], frame: &Frame, state: &State) -> Vec<(usize, bool)> {
        let mut cells = Vec::new();
        // What depends on a result begins with it.
        let begins = |change: &&Change| frame.result.is_some() || !change.is_about_result();
        for change in changes.iter().filter(begins) {
            for frame in self.frames(change.each, frame) {
                if change.when.as_ref().is_none_or(|when| self.holds(when, &frame, state)) {
                    cells.extend(
                        self.cells_in(&change.atom, &frame).into_iter().map(|cell| (cell, change.truth)),
                    );
                }
            }
        }
        cells
    }

    /// Entities that changes move: the first of what they change, where it is named.
    #[must_use]
    pub(super) fn moved(&self, changes: &[Change], frame: &Frame, state: &State) -> Vec<usize> {
        let mut moved = Vec::new();
        for change in changes {
            let frames = self.frames(change.each, frame).into_iter();
            let begun =
                frames.filter(|frame| change.when.as_ref().is_none_or(|when| self.holds(when, frame, state)));
            moved.extend(begun.filter_map(|frame| frame.value(*change.atom.args.first()?)));
        }
        moved
    }

    /// The frames of a clause: one for each entity of its kind.
    fn frames(&self, each: Option<Kind>, frame: &Frame) -> Vec<Frame> {
        match each {
            None => vec![frame.clone()],
            Some(kind) => self.of_kind(kind).map(|one| Frame { each: Some(one), ..frame.clone() }).collect(),
        }
    }
}

impl Change {
    /// True if the change, or its condition, is about a result.
    fn is_about_result(&self) -> bool {
        self.atom.args.contains(&Arg::Result) || self.when.as_ref().is_some_and(is_about_result)
    }
}

fn is_about_result(condition: &Condition) -> bool {
    match condition {
        Condition::Is(atom) => atom.args.contains(&Arg::Result),
        Condition::Same(one, other) => [one, other].contains(&&Arg::Result),
        Condition::Not(inner) => is_about_result(inner),
        Condition::All(parts) | Condition::AnyOf(parts) => parts.iter().any(is_about_result),
        Condition::Kind(..) | Condition::Empty(_) | Condition::Length(..) => false,
    }
}

impl Frame {
    pub(super) fn value(&self, arg: Arg) -> Option<usize> {
        match arg {
            Arg::Entity(one) => Some(one),
            Arg::Param(index) => self.params.get(index).copied(),
            Arg::Each => self.each,
            Arg::Result => self.result,
            Arg::Name(_) | Arg::First(_) | Arg::Any => None,
        }
    }
}
