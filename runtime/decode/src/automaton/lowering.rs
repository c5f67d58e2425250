//! Lowering of a grammar to operations.
//!
//! Most parts become one operation or a few in a row. Three things need more: a repetition is a rule of its
//! own, whose call frame counts its members; the steps of a block are one rule that all blocks call; and
//! conditions are rules that call each other ([`super::conditions`]).

use std::sync::Arc;

use motet_compiler::Session;
use motet_compiler::incremental::IncrementalChecker;
use motet_compiler::signature::{Signatures, Type};
use motet_syntax::Syntax;
use motet_syntax::print::identifier;
use motet_syntax::words::RESERVED;
use rustc_hash::{FxHashMap, FxHashSet};
use smol_str::{SmolStr, format_smolstr};

use super::assembler::Transition;
use super::{
    Assembler, Automaton, BoundNames, Callable, CaughtField, Meaning, Op, OpId, Word, WordEnd, WordList,
    WordTable,
};
use crate::grammar::{
    Action, Alternative, AtomSort, BlockRole, ChoiceStyle, CleanupOf, ConditionUse, Constant, Grammar, Guard,
    NodeKind, Part, Repeat, Split, WordRole,
};
use crate::subset::{MAX_MEMBERS, MAX_STEPS, Subset};

/// The state of lowering one grammar.
pub(super) struct Lowering<'g> {
    pub(super) grammar: &'g Grammar,
    pub(super) signatures: &'g Signatures,
    pub(super) asm: Assembler,
    pub(super) types: Vec<Type>,
    tables: FxHashMap<Type, (Arc<WordTable>, Arc<WordTable>)>,
    pub(super) callables: Vec<Callable>,
    pub(super) fluents: Vec<Vec<OpId>>,
    /// The call or fluent whose arguments are being lowered.
    pub(super) owner: Option<NodeKind>,
    /// The rule of a condition; in JSON behind its `{"`.
    condition: OpId,
    /// The rule of the steps of a block, behind what opens it.
    steps: OpId,
    /// The same of a cleanup.
    cleanup: OpId,
    /// The steps of a cleanup are being lowered.
    pub(super) in_cleanup: bool,
    /// The step or reaction that was begun last.
    begun: Option<NodeKind>,
    /// Jumps from the ends of blocks whose deadlines could have been those of the steps before them.
    splits: Vec<OpId>,
}

impl Automaton {
    /// Lowers the grammar of a session. O(declarations × entities).
    pub(crate) fn new(session: &Session, grammar: &Grammar) -> Self {
        let signatures = &grammar.signatures;
        let callables = signatures.callables.iter().map(|callable| Callable::new(session, callable));
        let mut lowering = Lowering {
            grammar,
            signatures,
            asm: Assembler::default(),
            types: grammar.bindable.clone(),
            tables: FxHashMap::default(),
            callables: callables.collect(),
            fluents: vec![Vec::new(); signatures.fluents.len()],
            owner: None,
            condition: 0,
            steps: 0,
            cleanup: 0,
            in_cleanup: false,
            begun: None,
            splits: Vec::new(),
        };
        lowering.condition = lowering.conditions();
        // The rule of a block's steps is called from within itself: its place comes first.
        (lowering.steps, lowering.cleanup) = (lowering.asm.later(), lowering.asm.later());
        let steps = lowering.block_steps();
        lowering.land(lowering.steps, steps);
        lowering.in_cleanup = true;
        let cleanup = lowering.block_steps();
        lowering.land(lowering.cleanup, cleanup);
        lowering.in_cleanup = false;
        let start = lowering.asm.here();
        lowering.parts(&grammar.document);
        lowering.asm.put(Op::Accept);
        let Lowering { asm, types, callables, fluents, .. } = lowering;
        let is_comparison = |sort| matches!(sort, AtomSort::Measure);
        Self {
            rest: asm.rests(),
            ops: asm.ops,
            start,
            types,
            callables,
            fluents,
            fluent_bits: signatures
                .fluents
                .iter()
                .map(|fluent| IncrementalChecker::fluent(session, &fluent.name))
                .collect(),
            measures: grammar.atoms.iter().any(|atom| atom.is_decoded && is_comparison(atom.sort)),
            names_values: grammar.names_values(),
            counts: grammar.has_term("count"),
            firsts: grammar.has_term("first"),
            catches: grammar.has_caught(),
            subset: grammar.subset,
            taken: taken(signatures, grammar.subset),
            signatures: Arc::clone(signatures),
        }
    }
}

/// Names that a policy may not give: entities, and in text words of the language and cases, which they
/// would hide.
fn taken(signatures: &Signatures, subset: Subset) -> FxHashSet<SmolStr> {
    let entities = signatures.entities.iter().map(|row| row.0.clone());
    if subset.syntax == Syntax::Json {
        return entities.collect();
    }
    let words = RESERVED.iter().map(|word| SmolStr::new_static(word));
    let cases = signatures.enums.iter().flat_map(|def| def.cases.iter().cloned());
    words.chain(entities).chain(cases).collect()
}

/// The parts of an alternative behind the field of a caught failure with which it begins in text.
pub(super) fn behind_caught(alternative: &Alternative) -> Option<&[Part]> {
    match alternative.parts.as_slice() {
        [Part::Action(Action::Open(_)), Part::Caught, Part::Literal(field), behind @ ..]
            if field.starts_with('.') =>
        {
            Some(behind)
        }
        _ => None,
    }
}

impl Lowering<'_> {
    pub(super) fn is_json(&self) -> bool {
        self.grammar.subset.syntax == Syntax::Json
    }

    pub(super) fn act(&mut self, action: Action) -> OpId {
        self.asm.act(action)
    }

    /// A jump, or a call, whose goal is known later.
    pub(super) fn later(&mut self) -> OpId {
        self.asm.later()
    }

    pub(super) fn land(&mut self, jump: OpId, at: OpId) {
        self.asm.set(jump, Op::Jump(at));
    }

    pub(super) fn land_here(&mut self, jump: OpId) {
        let here = self.asm.here();
        self.land(jump, here);
    }

    /// Lowers parts in a row; the last goes on behind them.
    pub(super) fn parts(&mut self, parts: &[Part]) {
        parts.iter().for_each(|part| self.part(part));
    }

    fn part(&mut self, part: &Part) {
        match part {
            Part::Literal(text) => {
                self.asm.literal(text);
            }
            Part::Action(action) => {
                if let Action::Open(kind @ (NodeKind::Do(_) | NodeKind::Is(_))) = action {
                    self.owner = Some(*kind);
                }
                if let Action::Open(kind @ (NodeKind::Do(_) | NodeKind::Wait | NodeKind::Pause)) = action {
                    self.begun = Some(*kind);
                }
                self.act(*action);
            }
            Part::Name(usage) => {
                if self.is_json() {
                    self.asm.literal("\"");
                }
                self.asm.put(Op::Name(*usage));
            }
            Part::Value { ty, range, place } => self.placed_value(ty, *range, *place),
            Part::Number(range) => self.number(*range),
            Part::OptionalNumber { lead, range } => {
                self.optional_number(lead, *range, lead.trim() == "within");
            }
            Part::Manner => self.manner(),
            Part::Relation(ty) => self.relation(ty),
            Part::Failures => self.failures(),
            Part::EntityList => self.entity_list(),
            Part::ListName => self.bound_name(BoundNames::List),
            Part::Caught => self.bound_name(BoundNames::Caught),
            Part::FailureKind => self.failure_kind(),
            Part::CaughtName => self.caught_name(),
            Part::ResultType => self.result_type(),
            Part::Given { lead, end } => self.given([lead, end]),
            Part::Cleanup(of) => self.optional_cleanup(*of),
            Part::Condition(asked) => {
                if self.is_json() {
                    self.asm.literal("{\"");
                }
                self.begun_condition(*asked);
            }
            Part::Block(role, least) => self.block(*role, *least),
            Part::Choice(style, alternatives) => self.choice(*style, alternatives),
            Part::Optional { present, absent, absent_guard } => {
                let choice = self.later();
                let then = self.asm.here();
                self.parts(&present.parts);
                let over = self.later();
                let none = self.asm.here();
                self.parts(absent);
                self.land_here(over);
                self.asm.optional(choice, (&present.literal, then, present.guard), (none, *absent_guard));
            }
            Part::Repeat(repeat) => self.repeat(repeat),
        }
    }

    /// A condition; in JSON behind its `{"`.
    fn begun_condition(&mut self, asked: ConditionUse) {
        self.act(Action::Condition(asked));
        self.asm.put(Op::Call(self.condition));
    }

    fn choice(&mut self, style: ChoiceStyle, alternatives: &[Alternative]) {
        let at = self.later();
        let (mut transitions, mut jumps, mut caught) = (Vec::new(), Vec::new(), None);
        for alternative in alternatives {
            let to = self.asm.here();
            if style == ChoiceStyle::Keywords
                && let Some(behind) = behind_caught(alternative)
            {
                self.parts(behind);
                jumps.push(self.later());
                caught = Some((CaughtField::Text, to));
                continue;
            }
            let literal = match alternative.parts.as_slice() {
                // The brace of a condition is what tells it from `null`.
                [Part::Condition(asked)] if alternative.literal.is_empty() => {
                    self.begun_condition(*asked);
                    SmolStr::new_static("{\"")
                }
                parts => {
                    self.parts(parts);
                    alternative.literal.clone()
                }
            };
            jumps.push(self.later());
            transitions.push((literal, to, alternative.guard));
        }
        jumps.into_iter().for_each(|jump| self.land_here(jump));
        match style {
            ChoiceStyle::Literals => self.asm.choose(at, &transitions),
            ChoiceStyle::Keywords => self.keywords_or_caught(at, transitions, caught),
            ChoiceStyle::Names(role) => {
                let numbers = alternatives.iter().map(|alternative| alternative.number);
                self.names(at, role, transitions.into_iter().zip(numbers));
            }
        }
    }

    /// One of several names of declarations, behind its opening quote.
    pub(super) fn names(
        &mut self,
        at: OpId,
        role: WordRole,
        transitions: impl Iterator<Item = (Transition, u16)>,
    ) {
        let words = transitions.map(|((literal, to, guard), number)| Word {
            name: literal.trim_end_matches('"').into(),
            meaning: Meaning::Named(number),
            to: Some(to),
            guard,
        });
        let table = Arc::new(WordTable::new(words));
        self.asm.set(
            at,
            Op::Word(WordList { table, bound: BoundNames::None, role, ends: WordEnd::Tail, next: at }),
        );
    }

    /// One of several words, each with a guard of its own.
    pub(super) fn keywords(&mut self, at: OpId, transitions: Vec<Transition>) {
        self.keywords_or_caught(at, transitions, None);
    }

    /// The same, or a field of a caught failure, behind which another operation follows.
    pub(super) fn keywords_or_caught(
        &mut self,
        at: OpId,
        transitions: Vec<Transition>,
        caught: Option<(CaughtField, OpId)>,
    ) {
        let words = transitions.into_iter().map(|(name, to, guard)| Word {
            name,
            meaning: Meaning::Any,
            to: Some(to),
            guard,
        });
        let table = Arc::new(WordTable::new(words));
        let (bound, next) =
            caught.map_or((BoundNames::None, at), |(field, next)| (BoundNames::CaughtField(field), next));
        let (role, ends) = (WordRole::Keyword, WordEnd::Whole);
        self.asm.set(at, Op::Word(WordList { table, bound, role, ends, next }));
    }

    fn repeat(&mut self, repeat: &Repeat) {
        let Repeat { open, item, separator, end, least, most } = repeat;
        if !open.is_empty() {
            self.asm.literal(open);
        }
        let (call, over) = (self.later(), self.later());
        let rule = self.asm.here();
        for _ in 1..*least {
            self.parts(item);
            self.asm.literal(separator);
        }
        let start = self.asm.here();
        self.parts(item);
        self.act(Action::Count);
        // In text the separator of blocks begins what ends them: the brace behind it tells them apart.
        let is_block = matches!(item.as_slice(), [Part::Block(..)]) && !self.is_json();
        let (separator, start) = if is_block {
            (format_smolstr!("{separator}{{ "), start + 1)
        } else {
            (separator.clone(), start)
        };
        self.next_member([separator.as_str(), end.as_str()], start, most - least + 1);
        self.asm.set(call, Op::Call(rule));
        self.land_here(over);
    }

    /// Another member from `start` on while there are fewer than `most`, or the end of the rule.
    pub(super) fn next_member(&mut self, [separator, end]: [&str; 2], start: OpId, most: u8) {
        let after = self.later();
        let more = self.asm.put(Op::Jump(start));
        let done = self.asm.put(Op::Return);
        let below = Guard::Below(most);
        if end.is_empty() {
            self.asm.optional(after, (separator, more, below), (done, Guard::Open));
        } else {
            self.asm.choose(after, &[(separator.into(), more, below), (end.into(), done, Guard::Open)]);
        }
    }

    fn block(&mut self, role: BlockRole, least: u32) {
        if self.is_json() {
            self.asm.literal("[");
            let choice = self.later();
            let enter = self.enter(role);
            let over = self.later();
            let empty = self.empty_block();
            self.land_here(over);
            let (some, none) =
                ((SmolStr::new_static("{\""), enter, Guard::Open), ("]".into(), empty, Guard::Empty));
            let transitions = if least == 0 { vec![some, none] } else { vec![some] };
            self.asm.choose(choice, &transitions);
        } else if least > 0 {
            self.asm.literal("{ ");
            self.enter(role);
        } else {
            let choice = self.later();
            let block = self.asm.literal("{ ");
            self.enter(role);
            let over = self.later();
            let empty = self.empty_block();
            self.land_here(over);
            self.asm.optional(choice, ("{ }", empty, Guard::Empty), (block, Guard::Open));
        }
    }

    fn empty_block(&mut self) -> OpId {
        let at = self.act(Action::Open(NodeKind::Block));
        self.act(Action::Close);
        at
    }

    /// The steps of a block. One rule serves all blocks; the role is handed over on entry.
    fn enter(&mut self, role: BlockRole) -> OpId {
        let (call, over) = (self.later(), self.later());
        let rule = self.act(Action::Enter(role));
        let is_cleanup = self.in_cleanup || role == BlockRole::Cleanup;
        self.asm.put(Op::Jump(if is_cleanup { self.cleanup } else { self.steps }));
        self.asm.set(call, Op::Call(rule));
        self.land_here(over);
        call
    }

    /// The block behind a deadline in text, if the deadline is not that of the step before: a brace decides.
    pub(super) fn split(&mut self) {
        let split = match self.begun {
            Some(NodeKind::Do(number)) => {
                let callable = self.signatures.callables.get(usize::from(number));
                let result = callable.and_then(|callable| callable.result.as_ref());
                Split { modifiers: 2, bind: result.map(|ty| self.grammar.type_number(ty)) }
            }
            Some(NodeKind::Wait) => Split { modifiers: 1, bind: None },
            _ => return,
        };
        if self.is_json() || self.in_cleanup {
            return;
        }
        let choice = self.later();
        let some = self.act(Action::Split(split));
        self.enter(BlockRole::During);
        self.act(Action::Close);
        self.optional_cleanup(CleanupOf::Step);
        self.act(Action::StepDone);
        let end = self.later();
        self.splits.push(end);
        let none = self.asm.here();
        self.asm.optional(choice, (" { ", some, Guard::Split(split)), (none, Guard::Open));
    }

    /// The cleanup of a step or of the policy, if there is one. A cleanup has none itself.
    fn optional_cleanup(&mut self, of: CleanupOf) {
        if self.in_cleanup || self.grammar.subset.depth == 0 && of == CleanupOf::Step {
            return;
        }
        if of == CleanupOf::Policy && self.is_json() {
            self.asm.literal(",\"finally\":");
        }
        let choice = self.later();
        let some = self.enter(BlockRole::Cleanup);
        let none = self.asm.here();
        match (of, self.is_json()) {
            (CleanupOf::Policy, true) => self
                .asm
                .choose(choice, &[("null".into(), none, Guard::Open), ("[{\"".into(), some, Guard::Cleanup)]),
            (CleanupOf::Step, true) => {
                self.asm.optional(choice, (",\"finally\":[{\"", some, Guard::Cleanup), (none, Guard::Open));
            }
            (CleanupOf::Step | CleanupOf::Policy, false) => {
                self.asm.optional(choice, (" finally { ", some, Guard::Cleanup), (none, Guard::Open));
            }
        }
    }

    /// The steps of a block behind what opens it, with what ends it.
    ///
    /// No step behind an ending is ever reached, so nothing that follows from the end of the block can be
    /// refuted there: the block may always end.
    fn block_steps(&mut self) -> OpId {
        let is_json = self.is_json();
        let start = self.later();
        let after = if is_json { self.asm.here() } else { self.asm.literal(" ") };
        let more = self.later();
        let after_ending = if is_json { self.asm.here() } else { self.asm.literal(" ") };
        let over = self.later();
        let mut transitions: Vec<Transition> = Vec::new();
        let grammar = self.grammar;
        let in_cleanup = self.in_cleanup;
        for step in grammar.steps.iter().filter(|step| step.cleans || !in_cleanup) {
            let at = self.asm.here();
            self.parts(&step.parts);
            self.act(Action::StepDone);
            let is_bare = !is_json
                && step.parts.iter().all(|part| matches!(part, Part::Action(_) | Part::Given { .. }));
            if is_bare {
                // A keyword may not begin another one: the space behind it belongs to it.
                transitions.push((format_smolstr!("{} ", step.literal), at, step.guard));
                self.asm.put(Op::Jump(over));
            } else {
                transitions.push((step.literal.clone(), at, step.guard));
                self.asm.put(Op::Jump(if step.is_ending { after_ending } else { after }));
            }
        }
        for end in std::mem::take(&mut self.splits) {
            self.land(end, after);
        }
        let transitions = self.forked(transitions);
        let again = self.asm.put(Op::Jump(start));
        let leave = self.act(Action::Leave);
        self.asm.put(Op::Return);
        let room = Guard::Below(u8::try_from(MAX_STEPS).unwrap_or(u8::MAX));
        let close = if self.in_cleanup { Guard::Cleaned } else { Guard::Close };
        for (at, guard) in [(more, close), (over, Guard::Open)] {
            if is_json {
                self.asm.choose(at, &[(",{\"".into(), again, room), ("]".into(), leave, guard)]);
            } else {
                let end = (SmolStr::new_static("}"), leave, guard);
                self.keywords(at, transitions.iter().cloned().chain([end]).collect());
            }
        }
        if is_json {
            self.asm.choose(start, &transitions);
        } else {
            self.keywords(start, transitions);
        }
        start
    }

    /// Alternatives of which none begins another: where one does, the byte behind it tells them apart.
    fn forked(&mut self, transitions: Vec<Transition>) -> Vec<Transition> {
        let mut found: Vec<Transition> = Vec::with_capacity(transitions.len());
        let mut longer: Vec<Transition> = Vec::new();
        for (index, transition) in transitions.iter().enumerate() {
            let begins = |(other, short): (usize, &Transition)| {
                other != index
                    && transition.0.starts_with(short.0.as_str())
                    && !short.0.is_empty()
                    && (short.0 != transition.0 || short.2 == Guard::Room)
            };
            let is_longer = transition.2 != Guard::Room && transitions.iter().enumerate().any(begins);
            if is_longer { &mut longer } else { &mut found }.push(transition.clone());
        }
        for (literal, at, guard) in longer {
            let Some(short) = found.iter_mut().find(|transition| literal.starts_with(transition.0.as_str()))
            else {
                continue;
            };
            let rest = literal.get(short.0.len()..).unwrap_or_default();
            // In JSON a condition begins with its brace.
            let byte = rest.bytes().next().unwrap_or(b'{');
            let then = if rest.is_empty() { at } else { self.asm.literal(rest) };
            if !rest.is_empty() {
                self.asm.put(Op::Jump(at));
            }
            short.1 = self.asm.put(Op::Fork { byte, then, guard, other: short.1 });
        }
        found
    }

    /// `any` alone, or kinds of failure.
    fn failures(&mut self) {
        let is_json = self.is_json();
        let (separator, end, ends) =
            if is_json { (",\"", "]", WordEnd::Tail) } else { (", ", " ", WordEnd::Bare) };
        if is_json {
            self.asm.literal("[\"");
        }
        self.act(Action::Open(NodeKind::List));
        let call = self.later();
        self.act(Action::Close);
        let over = self.later();
        let (start, kinds, after) = (self.later(), self.later(), self.later());
        let any = self.asm.literal(end);
        self.asm.put(Op::Return);
        let more = self.act(Action::Count);
        self.asm.put(Op::Jump(kinds));
        let done = self.asm.put(Op::Return);
        let below = Guard::Below(u8::try_from(MAX_MEMBERS - 1).unwrap_or(0));
        self.asm.choose(after, &[(separator.into(), more, below), (end.into(), done, Guard::Open)]);
        let failures = self.signatures.failures.iter().zip(0u16..).filter(|(name, _)| *name != "any");
        let words: Vec<Word> = failures
            .map(|(name, number)| Word {
                name: if is_json { name.clone() } else { identifier(name).into() },
                meaning: Meaning::Named(number),
                to: Some(after),
                guard: Guard::Open,
            })
            .collect();
        let any = Word { name: "any".into(), meaning: Meaning::Any, to: Some(any), guard: Guard::Open };
        let word = |words: Vec<Word>| {
            let table = Arc::new(WordTable::new(words));
            Op::Word(WordList { table, bound: BoundNames::None, role: WordRole::Free, ends, next: after })
        };
        self.asm.set(kinds, word(words.clone()));
        self.asm.set(start, word(words.into_iter().chain([any]).collect()));
        self.asm.set(call, Op::Call(start));
        self.land_here(over);
    }

    /// The words of a type, without and with `any`.
    pub(super) fn table(&mut self, ty: &Type) -> (Arc<WordTable>, Arc<WordTable>) {
        let (signatures, form) = (self.signatures, self.grammar.subset.syntax);
        let made = self.tables.entry(ty.clone()).or_insert_with(|| {
            let table = match ty {
                Type::Entity(kind) => WordTable::of_kind(signatures, *kind),
                Type::Enum(id) => WordTable::of_cases(signatures, *id),
                _ => WordTable::default(),
            };
            let table = match form {
                Syntax::Json => table,
                Syntax::Text => {
                    let spelled = |word: Word| Word { name: identifier(&word.name).into(), ..word };
                    WordTable::new(table.entries.into_iter().map(spelled))
                }
            };
            let any = table.with_any();
            (Arc::new(table), Arc::new(any))
        });
        (Arc::clone(&made.0), Arc::clone(&made.1))
    }

    pub(super) fn constant(&mut self, constant: Constant) -> OpId {
        self.act(Action::Constant(constant))
    }
}
