//! Lowering of conditions: fluents, comparisons, and what joins them.
//!
//! In JSON an operator stands first, so a condition is one rule. In text `and` and `or` stand between what
//! they join, so the first of several is a condition of its own until one of them follows.

use smol_str::{SmolStr, format_smolstr};

use super::assembler::Transition;
use super::lowering::{Lowering, behind_caught};
use super::{CaughtField, Op, OpId};
use crate::grammar::{Action, Atom, AtomSort, Guard, NodeKind, WordRole};
use crate::subset::MAX_MEMBERS;

const MEMBERS: u8 = MAX_MEMBERS as u8;

impl Lowering<'_> {
    /// The rule of a condition; in JSON behind its `{"`.
    pub(super) fn conditions(&mut self) -> OpId {
        if self.is_json() { self.prefix_conditions() } else { self.infix_conditions() }
    }

    fn connective(&self, kind: NodeKind) -> [&'static str; 3] {
        self.grammar.connective(kind).unwrap_or_default()
    }

    /// The rules of atoms of one sort, each behind its name, with the numbers of their declarations.
    fn atoms(&mut self, sort: AtomSort) -> Vec<(Transition, u16)> {
        let mut transitions = Vec::new();
        let grammar = self.grammar;
        for atom in grammar.atoms.iter().filter(|atom| atom.sort == sort && atom.is_decoded) {
            let at = self.asm.here();
            self.parts(&atom.spelled.parts);
            self.asm.put(Op::Return);
            transitions.push(((atom.spelled.literal.clone(), at, atom.spelled.guard), atom.spelled.number));
        }
        transitions
    }

    /// The rule of a condition on the kind of a failure in text, behind the name and the field.
    fn caught(&mut self) -> Option<OpId> {
        let grammar = self.grammar;
        let parts = grammar.atoms.iter().find_map(|atom| behind_caught(&atom.spelled))?;
        let rule = self.asm.here();
        self.parts(parts);
        self.asm.put(Op::Return);
        Some(rule)
    }

    fn prefix_conditions(&mut self) -> OpId {
        let start = self.later();
        let end = self.asm.literal("}");
        self.act(Action::Close);
        self.asm.put(Op::Return);
        let mut transitions: Vec<Transition> = Vec::new();
        // Without measures only the length of a list can be compared.
        let is_measure = |atom: &Atom| {
            atom.is_decoded && atom.sort == AtomSort::Measure && atom.spelled.guard == Guard::Loose
        };
        let get = if self.grammar.atoms.iter().any(is_measure) { Guard::Loose } else { Guard::OfList };
        let is_field = |atom: &Atom| {
            atom.is_decoded && atom.sort == AtomSort::Field && atom.spelled.guard == Guard::Loose
        };
        let field = if self.grammar.atoms.iter().any(is_field) { Guard::Loose } else { Guard::OfCaught };
        for (word, sort, role, guard) in [
            ("is\":\"", AtomSort::Fluent, WordRole::Fluent, Guard::Is),
            ("get\":\"", AtomSort::Measure, WordRole::Head, get),
            ("field\":\"", AtomSort::Field, WordRole::Head, field),
        ] {
            let atoms = self.atoms(sort);
            if !atoms.is_empty() || sort == AtomSort::Fluent {
                let at = self.later();
                self.names(at, role, atoms.into_iter());
                transitions.push((word.into(), at, guard));
            }
        }
        let not = self.act(Action::Open(NodeKind::Not));
        self.act(Action::Negate);
        self.act(Action::Deeper);
        self.asm.put(Op::Call(start));
        self.asm.put(Op::Jump(end));
        // The `{"` before a condition is read already, and that of the first one in it is read with the word.
        let word = |open: &str| format_smolstr!("{}{{\"", open.trim_start_matches("{\""));
        transitions.push((word(self.connective(NodeKind::Not)[0]), not, Guard::Not));
        for (kind, guard) in [(NodeKind::All, Guard::All), (NodeKind::Any, Guard::Any)] {
            let [open, separator, _] = self.connective(kind);
            let separator = format!("{separator}{{\"");
            let at = self.act(Action::Open(kind));
            self.act(Action::Deeper);
            self.act(Action::Loosen);
            let rule = self.asm.here() + 2;
            self.asm.put(Op::Call(rule));
            self.asm.put(Op::Jump(end));
            self.asm.put(Op::Call(start));
            self.asm.literal(&separator);
            let second = self.asm.put(Op::Call(start));
            self.act(Action::Count);
            self.next_member([&separator, "]"], second, MEMBERS - 1);
            transitions.push((word(open), at, guard));
        }
        self.asm.choose(start, &transitions);
        start
    }

    fn infix_conditions(&mut self) -> OpId {
        let bare = |transitions: Vec<(Transition, u16)>| {
            transitions.into_iter().map(|(transition, _)| transition).collect::<Vec<Transition>>()
        };
        let fluents = bare(self.atoms(AtomSort::Fluent));
        let [not, and_word, or_word] = [
            self.connective(NodeKind::Not)[0],
            self.connective(NodeKind::All)[1],
            self.connective(NodeKind::Any)[1],
        ];
        let comparisons = bare(self.atoms(AtomSort::Measure));
        let atoms = [fluents.clone(), comparisons].concat();
        // Rules that call each other: their places come first.
        let (negated, group) = (self.later(), self.later());
        let caught = self.caught();
        let member =
            self.primary((&atoms, caught), [(not, negated, Guard::Not), ("(", group, Guard::Paren(1))]);

        let parts = self.act(Action::Deeper);
        self.act(Action::Loosen);
        self.asm.put(Op::Call(member));
        let first = self.later();
        let (and, or) = (self.joined(NodeKind::All, member), self.joined(NodeKind::Any, member));
        self.asm
            .choose(first, &[(and_word.into(), and, Guard::Several), (or_word.into(), or, Guard::Several)]);
        let group_at = self.rule(&[Action::Open(NodeKind::Group)], parts, ")");
        self.land(group, group_at);

        let inner =
            self.primary((&atoms, caught), [(not, negated, Guard::Not), ("(", group, Guard::Paren(1))]);
        let parts = self.act(Action::Deeper);
        self.act(Action::Loosen);
        self.asm.put(Op::Call(inner));
        let first = self.later();
        let alone = self.asm.put(Op::Return);
        let (and, or) = (self.closed(and), self.closed(or));
        self.asm.choose(
            first,
            &[
                (")".into(), alone, Guard::Compared),
                (and_word.into(), and, Guard::Several),
                (or_word.into(), or, Guard::Several),
            ],
        );
        let enclosed = self.rule(&[Action::Open(NodeKind::Group)], parts, "");
        let operand =
            self.primary((&fluents, None), [(not, negated, Guard::Not), ("(", enclosed, Guard::NotParen)]);
        let negated_at =
            self.rule(&[Action::Open(NodeKind::Not), Action::Negate, Action::Deeper], operand, "");
        self.land(negated, negated_at);

        let (and, or) = (self.joined_anew(NodeKind::All, member), self.joined_anew(NodeKind::Any, member));
        // Parentheses around a whole condition would say nothing: another one follows, and both are in
        // what joins them.
        let first = self.act(Action::Deeper);
        self.asm.put(Op::Call(group));
        let choice = self.later();
        // Behind `Action::Deeper`, which is done.
        self.asm
            .choose(choice, &[(and_word.into(), and + 1, Guard::All), (or_word.into(), or + 1, Guard::Any)]);
        let whole =
            self.primary((&atoms, caught), [(not, negated, Guard::Not), ("(", first, Guard::Paren(2))]);
        let start = self.asm.put(Op::Call(whole));
        let (join, other) = (self.later(), self.later());
        let done = self.asm.put(Op::Return);
        self.asm.optional(join, (and_word, and, Guard::And), (other, Guard::Open));
        self.asm.optional(other, (or_word, or, Guard::Or), (done, Guard::Open));
        start
    }

    /// A rule: the actions at its beginning, a rule inside, and its end.
    fn rule(&mut self, actions: &[Action], inside: OpId, end: &str) -> OpId {
        let start = self.asm.here();
        for action in actions {
            self.act(*action);
        }
        self.asm.put(Op::Call(inside));
        if !end.is_empty() {
            self.asm.literal(end);
        }
        self.act(Action::Close);
        self.asm.put(Op::Return);
        start
    }

    /// A condition without `and` or `or` around it: one of some words, each with a rule behind it.
    fn primary(
        &mut self,
        (atoms, caught): (&[Transition], Option<OpId>),
        more: [(&'static str, OpId, Guard); 2],
    ) -> OpId {
        let more = more.map(|(word, rule, guard)| (SmolStr::new_static(word), rule, guard));
        let start = self.later();
        let caught = caught.map(|rule| (CaughtField::Kind, rule));
        self.keywords_or_caught(start, atoms.iter().cloned().chain(more).collect(), caught);
        start
    }

    /// The rest of a rule behind the first ` and ` or ` or `.
    fn joined(&mut self, kind: NodeKind, member: OpId) -> OpId {
        let start = self.act(Action::Join(kind));
        self.asm.put(Op::Call(member));
        self.next_member([self.connective(kind)[1], ""], start, MEMBERS - 1);
        start
    }

    /// The same where the first condition is not nested.
    fn joined_anew(&mut self, kind: NodeKind, member: OpId) -> OpId {
        let start = self.act(Action::Deeper);
        self.act(Action::Loosen);
        self.joined(kind, member);
        start
    }

    /// The rest of a rule with the parenthesis behind it.
    fn closed(&mut self, joined: OpId) -> OpId {
        // The count of members goes on in the rule that is called, which begins with that of this one.
        let start = self.asm.put(Op::Call(joined));
        self.asm.literal(")");
        self.asm.put(Op::Return);
        start
    }
}
