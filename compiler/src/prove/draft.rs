//! A proof that goes on step by step: what it holds between two steps, and the states in which a place of a policy is
//! reached. Fed by [`crate::draft`].

use std::hash::Hasher;

use motet_syntax::{Code, Diagnostic, Severity, Span};
use rustc_hash::FxHashMap;

use super::apply::Lasting;
use super::eval::Frame;
use super::facts::{ANY, Facts, Key, Split};
use super::symbols::Symbols;
use super::value::Value;
use super::{Mood, Proof, Prover, Volatile, Watched};
use crate::ir::{Condition, Fluent, Program, StepId, Term};
use crate::library::{Library, PrimitiveDef};
use crate::world::World;

/// What is known in one state.
#[derive(Clone, Debug)]
pub(crate) struct Stand {
    facts: Facts<'static>,
    lasting: FxHashMap<StepId, Lasting>,
    watched: Vec<Watched>,
    volatile: Vec<Volatile>,
    splits: Vec<Split>,
    /// Where the round began of the innermost loop around, as a mark of the facts.
    head: Option<usize>,
    /// The facts before what reactions may have done just now.
    calm: usize,
}

/// A proof between two steps of a policy's body.
#[derive(Clone, Debug)]
pub(crate) struct Parts {
    stand: Stand,
    pub(crate) symbols: Symbols,
    fresh: Fluent,
    aliased: Vec<bool>,
    pub(crate) live: bool,
}

/// A place in a proof to go back to.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    trail: usize,
    splits: Vec<Split>,
    symbols: (usize, usize),
    steps: usize,
    live: bool,
}

impl Mark {
    /// Whether the steps since then have written anything that a fact may speak of.
    pub(crate) fn touches(&self, stand: &Stand, condition: &Condition) -> bool {
        let fact = match condition {
            Condition::Fact(fact) => fact,
            Condition::Not(inner) => return self.touches(stand, inner),
            _ => return true,
        };
        let mut key = Key(0);
        for (index, term) in fact.args.iter().enumerate() {
            let arg = match term {
                None => ANY,
                Some(Term::Entity(entity)) => entity.0,
                Some(Term::Case(_, case)) => *case,
                // A name may be one of several.
                Some(_) => return true,
            };
            key = key.with(index, arg);
        }
        let is_same = |other: Key| key.covers(other) || other.covers(key);
        let mut writes = stand.facts.writes(self.trail);
        writes.any(|(fluent, other, _)| fluent == fact.fluent && is_same(other))
            || stand.splits.iter().any(|split| split.differs(|fluent| fluent == fact.fluent))
    }
}

/// What is special in a step that is proved.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Place {
    /// The state is remembered before this step.
    pub(crate) hole: Option<StepId>,
    /// This sequence stands for any one of its steps.
    pub(crate) choice: Option<StepId>,
    /// Whether nothing is known of it that is not known in every later round: no branches run at once, of which one takes as
    /// unknown what another may change.
    pub(crate) grows: bool,
}

/// What proving a step gave.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    /// Whether something is refuted.
    pub(crate) refuted: bool,
    /// The states in which control reached the hole.
    pub(crate) stands: Vec<Stand>,
}

/// The program, and what it is proved from.
pub(crate) type Given<'p> = (&'p Program, &'p Library, &'p World);

impl Parts {
    /// The proof before the first step.
    pub(crate) fn new(program: &Program, library: &Library, world: &World) -> Self {
        let mut facts = Facts::above(&world.facts);
        let fresh = facts.add_table(Value::yes(super::value::Cause::NOTHING));
        let stand = Stand {
            facts: facts.lift(),
            lasting: FxHashMap::default(),
            watched: Vec::new(),
            volatile: Vec::new(),
            splits: Vec::new(),
            head: None,
            calm: 0,
        };
        let symbols = Symbols::new(program, library, world);
        Self { stand, symbols, fresh, aliased: vec![false; library.fluents.len()], live: true }
    }

    pub(crate) fn mark(&self, steps: usize) -> Mark {
        let Stand { facts, splits, .. } = &self.stand;
        let symbols = self.symbols.len();
        Mark { trail: facts.mark(), splits: splits.clone(), symbols, steps, live: self.live }
    }

    pub(crate) fn back_to(&mut self, mark: &Mark) {
        self.stand.facts.back_to(mark.trail);
        self.stand.splits.clone_from(&mark.splits);
        self.stand.lasting.retain(|step, _| step.index() < mark.steps);
        self.symbols.truncate(mark.symbols);
        self.live = mark.live;
    }

    /// Proves one step of the body, and looks on the way at the hole in it.
    pub(crate) fn step(&mut self, step: StepId, place: Place, given: Given<'_>) -> Outcome {
        let (program, library, world) = given;
        self.symbols.extend(program, library, world);
        if !self.live {
            return Outcome::default();
        }
        self.with(given, |prover| {
            prover.place = place;
            prover.step(step);
            Outcome { refuted: prover.is_refuted(), stands: std::mem::take(&mut prover.stands) }
        })
    }

    /// Asks something of the state as it is; the answer changes nothing.
    pub(crate) fn here<T>(&mut self, given: Given<'_>, ask: impl FnOnce(&mut Prover<'_>) -> T) -> T {
        self.with(given, ask)
    }

    /// Whether nothing is refuted where the loop around the hole, which is at the end of its body, comes round from this state.
    pub(crate) fn comes_round(
        &mut self,
        stand: &Stand,
        (hole, until): (StepId, Option<&Condition>),
        given: Given<'_>,
        seen: &mut impl Hasher,
    ) -> bool {
        let Some(head) = stand.head else { return true };
        let (mut stand, calm) = (stand.clone(), stand.calm);
        self.at(&mut stand, given, |prover| {
            prover.back_to(calm);
            prover.comes_round(hole, head, until, seen)
        })
    }

    /// Asks something of another state than this proof's own.
    pub(crate) fn at<T>(
        &mut self,
        stand: &mut Stand,
        given: Given<'_>,
        ask: impl FnOnce(&mut Prover<'_>) -> T,
    ) -> T {
        let live = std::mem::replace(&mut self.live, true);
        std::mem::swap(&mut self.stand, stand);
        let answer = self.with(given, ask);
        std::mem::swap(&mut self.stand, stand);
        self.live = live;
        answer
    }

    fn with<T>(&mut self, (program, library, world): Given<'_>, run: impl FnOnce(&mut Prover<'_>) -> T) -> T {
        let Stand { facts, lasting, watched, volatile, splits, head, calm } = &mut self.stand;
        let (head, calm) = (*head, *calm);
        let mut prover = Prover {
            library,
            world,
            program,
            symbols: std::mem::take(&mut self.symbols),
            facts: std::mem::take(facts).over(&world.facts),
            fresh: self.fresh,
            lasting: std::mem::take(lasting),
            watched: std::mem::take(watched),
            volatile: std::mem::take(volatile),
            enclosing: Vec::new(),
            here: None,
            splits: std::mem::take(splits),
            live: self.live,
            fixpoints: 0,
            rehearsals: 0,
            head,
            aliased: std::mem::take(&mut self.aliased),
            buffers: Default::default(),
            diagnostics: Vec::new(),
            proof: Proof::default(),
            offers: Vec::new(),
            mood: Mood::Judge,
            place: Place::default(),
            stands: Vec::new(),
        };
        let answer = run(&mut prover);
        let Prover { symbols, facts, lasting, watched, volatile, splits, aliased, live, .. } = prover;
        self.stand = Stand { facts: facts.lift(), lasting, watched, volatile, splits, head, calm };
        self.symbols = symbols;
        self.aliased = aliased;
        self.live = live;
        answer
    }
}

impl Prover<'_> {
    /// Counts a mistake of which nobody reads more than that it is there.
    pub(crate) fn count(&mut self, code: Code) {
        self.diagnostics.push(Diagnostic {
            code,
            severity: Severity::Error,
            message: String::new(),
            help: None,
            span: Span::default(),
            path: String::new(),
            related: Vec::new(),
            fix: None,
            about: None,
        });
    }

    /// What was found so far, so that what a run finds that is only a rehearsal can be forgotten.
    pub(crate) fn said(&self) -> (usize, usize) {
        (self.diagnostics.len(), self.stands.len())
    }

    /// Forgets what was found since: a run that counts follows.
    pub(crate) fn unsay(&mut self, (diagnostics, stands): (usize, usize)) {
        if self.is_settled() {
            return;
        }
        self.diagnostics.truncate(diagnostics);
        self.stands.truncate(stands);
    }

    /// Whether nothing that follows changes the answer: something is refuted, and by no rehearsal. What a round of a loop refutes
    /// the rounds after it do too, since they begin in all states in which it does.
    pub(crate) fn is_settled(&self) -> bool {
        let counts = self.fixpoints == 0 || (self.place.grows && self.rehearsals == 0);
        self.mood == Mood::Judge && counts && self.place.hole.is_none() && self.is_refuted()
    }

    pub(crate) fn is_refuted(&self) -> bool {
        self.diagnostics.iter().any(|said| said.severity == Severity::Error)
    }

    /// Remembers the state in which the hole is reached, with what the reactions around it may have done just now.
    pub(crate) fn take_stand(&mut self) {
        let calm = self.facts.mark();
        self.erode();
        self.stands.push(Stand {
            facts: self.facts.clone().lift(),
            lasting: self.lasting.clone(),
            watched: self.watched.clone(),
            volatile: self.volatile.clone(),
            splits: self.splits.clone(),
            head: self.head,
            calm,
        });
    }

    /// Goes on where any of some steps leads.
    pub(crate) fn choose(&mut self, steps: &[StepId]) {
        let mark = self.facts.mark();
        let mut ways = Vec::with_capacity(steps.len());
        for step in steps {
            self.step(*step);
            if self.live {
                ways.push(self.facts.delta(mark));
            }
            self.back_to(mark);
            self.live = true;
            if self.is_settled() {
                break;
            }
        }
        self.meet(mark, &ways);
    }

    /// Whether a call is refuted here by the first `count` of its needs, taken in their order as a call takes them.
    pub(crate) fn refutes(&mut self, def: &PrimitiveDef, args: &[Term], count: usize) -> bool {
        let stale = |arg: &Term| matches!(arg, Term::Binding(id) if self.is_stale(*id));
        if args.iter().any(stale) {
            return true;
        }
        let mark = self.facts.mark();
        // No step of the program has this number: the cause of what the call grants is the call itself.
        let id = StepId(u32::try_from(self.program.steps.len()).unwrap_or(u32::MAX));
        let frame = Frame { args, result: None, each: None };
        let needs = def.needs.get(..count).unwrap_or(&def.needs);
        let is_refuted = needs.iter().enumerate().any(|(index, need)| {
            let (value, _) = self.need(need, frame);
            // What nothing is asked behind need not be taken as given.
            if !value.no.is_some() && value.open.is_some() && index + 1 < needs.len() {
                self.grant(id, need, frame);
            }
            value.no.is_some()
        });
        self.facts.back_to(mark);
        is_refuted
    }

    /// Whether nothing of a step is refuted here; it leaves no trace.
    pub(crate) fn permits(&mut self, step: StepId) -> bool {
        let (mark, splits, live) = (self.facts.mark(), self.splits.clone(), self.live);
        self.step(step);
        let permits = !self.is_refuted();
        self.diagnostics.clear();
        self.facts.back_to(mark);
        self.splits = splits;
        self.live = live;
        self.lasting.retain(|other, _| *other < step);
        permits
    }

    /// Whether a condition holds here, whatever way led here.
    pub(crate) fn proves(&self, condition: &Condition) -> bool {
        self.evaluate(condition, Frame::default()).is_true()
    }

    /// Whether a condition is refuted here.
    pub(crate) fn denies(&self, condition: &Condition) -> bool {
        self.evaluate(condition, Frame::default()).no.is_some()
    }
}
