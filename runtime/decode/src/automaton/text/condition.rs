//! Conditions: fluents, comparisons, and what joins them. `and` and `or` stand between what they join, so the first of
//! several is a condition of its own until one of them follows.

use motet_compiler::signature::Type;
use motet_syntax::print::identifier;
use smol_str::{SmolStr, format_smolstr};

use super::Speller;
use crate::automaton::{Action, Guard, NodeKind, Op, OpId, WordEnd, WordRole};
use crate::subset::MAX_MEMBERS;

/// A word that begins a condition, the rule behind it, and when it is open.
type Ways = Vec<(SmolStr, OpId, Guard)>;

impl Speller<'_> {
    /// A condition where nothing binds around it.
    pub(super) fn condition(&mut self) -> OpId {
        let (fluents, comparisons) = (self.fluents(), self.comparisons());
        self.of.measures = !comparisons.is_empty();
        let atoms: Ways = fluents.iter().chain(&comparisons).cloned().collect();
        // Rules that call each other: their places come first.
        let (negated, group) = (self.of.asm.later(), self.of.asm.later());
        let member = self.primary(&atoms, [("not ", negated, Guard::Not), ("(", group, Guard::Paren(1))]);

        let parts = self.act(Action::Deeper);
        self.act(Action::Loosen);
        self.of.asm.put(Op::Call(member));
        let first = self.of.asm.later();
        let (and, or) = (self.joined(NodeKind::All, member), self.joined(NodeKind::Any, member));
        self.of.asm.choose(first, &[(" and ", and, Guard::Several), (" or ", or, Guard::Several)]);
        let group_at = self.rule(&[Action::Open(NodeKind::Group)], parts, ")");
        self.of.asm.set(group, Op::Jump(group_at));

        let inner = self.primary(&atoms, [("not ", negated, Guard::Not), ("(", group, Guard::Paren(1))]);
        let parts = self.act(Action::Deeper);
        self.act(Action::Loosen);
        self.of.asm.put(Op::Call(inner));
        let first = self.of.asm.later();
        let alone = self.of.asm.put(Op::Return);
        let (and, or) = (self.closed(and), self.closed(or));
        self.of.asm.choose(
            first,
            &[(")", alone, Guard::Compared), (" and ", and, Guard::Several), (" or ", or, Guard::Several)],
        );
        let enclosed = self.rule(&[Action::Open(NodeKind::Group)], parts, "");
        let operand =
            self.primary(&fluents, [("not ", negated, Guard::Not), ("(", enclosed, Guard::NotParen)]);
        let negated_at =
            self.rule(&[Action::Open(NodeKind::Not), Action::Negate, Action::Deeper], operand, "");
        self.of.asm.set(negated, Op::Jump(negated_at));

        let (and, or) = (self.joined_anew(NodeKind::All, member), self.joined_anew(NodeKind::Any, member));
        // Parentheses around a whole condition would say nothing: another one follows, and both are in what joins them.
        let first = self.act(Action::Deeper);
        self.of.asm.put(Op::Call(group));
        let choice = self.of.asm.later();
        // Behind `Action::Deeper`, which is done.
        self.of.asm.choose(choice, &[(" and ", and + 1, Guard::All), (" or ", or + 1, Guard::Any)]);
        let whole = self.primary(&atoms, [("not ", negated, Guard::Not), ("(", first, Guard::Paren(2))]);
        let start = self.of.asm.put(Op::Call(whole));
        let join = self.of.asm.later();
        let other = self.of.asm.later();
        let done = self.of.asm.put(Op::Return);
        self.of.asm.maybe(join, (" and ", and, Guard::And), (other, Guard::Open));
        self.of.asm.maybe(other, (" or ", or, Guard::Or), (done, Guard::Open));
        start
    }

    /// A rule: what is meant at its beginning, a rule within, and what ends it.
    fn rule(&mut self, acts: &[Action], within: OpId, end: &str) -> OpId {
        let start = self.of.asm.here();
        for act in acts {
            self.act(*act);
        }
        self.of.asm.put(Op::Call(within));
        if !end.is_empty() {
            self.of.asm.literal(end);
        }
        self.act(Action::Close);
        self.of.asm.put(Op::Return);
        start
    }

    /// A condition without `and` or `or` around it: one of some words, each with a rule behind it.
    fn primary(&mut self, atoms: &Ways, more: [(&'static str, OpId, Guard); 2]) -> OpId {
        let more = more.map(|(word, rule, guard)| (SmolStr::new_static(word), rule, guard));
        let start = self.of.asm.later();
        self.keywords(start, atoms.iter().cloned().chain(more).collect());
        start
    }

    /// The rest of a rule behind the first ` and ` or ` or `.
    fn joined(&mut self, kind: NodeKind, member: OpId) -> OpId {
        let start = self.act(Action::Join(kind));
        self.of.asm.put(Op::Call(member));
        let after = self.of.asm.later();
        let done = self.of.asm.put(Op::Return);
        let word = if kind == NodeKind::All { " and " } else { " or " };
        let below = u8::try_from(MAX_MEMBERS - 1).unwrap_or(0);
        self.of.asm.maybe(after, (word, start, Guard::Below(below)), (done, Guard::Open));
        start
    }

    /// The same where the first stands in nothing.
    fn joined_anew(&mut self, kind: NodeKind, member: OpId) -> OpId {
        let start = self.act(Action::Deeper);
        self.act(Action::Loosen);
        self.joined(kind, member);
        start
    }

    /// The rest of a rule with the parenthesis behind it.
    fn closed(&mut self, joined: OpId) -> OpId {
        // The count of members goes on in the rule that is called, which begins with that of this one.
        let start = self.of.asm.put(Op::Call(joined));
        self.of.asm.literal(")");
        self.of.asm.put(Op::Return);
        start
    }

    /// The fluents, each a rule behind its parenthesis.
    fn fluents(&mut self) -> Ways {
        let mut ways = Ways::new();
        for (index, fluent) in self.of.signatures.fluents.iter().enumerate() {
            let Ok(number) = u16::try_from(index) else { break };
            let at = self.act(Action::Open(NodeKind::Is(number)));
            let args = self.arguments(&fluent.params, WordRole::Of);
            self.of.fluents.push(args);
            self.of.asm.literal(")");
            self.act(Action::Close);
            self.of.asm.put(Op::Return);
            if fluent.name != "monitored" {
                ways.push((format_smolstr!("{}(", identifier(&fluent.name)), at, Guard::Fluent(number)));
            }
        }
        ways
    }

    fn arguments(&mut self, params: &[(SmolStr, Type)], role: WordRole) -> Vec<OpId> {
        let mut args = Vec::new();
        for (index, (_, ty)) in params.iter().enumerate() {
            if index > 0 {
                self.of.asm.literal(", ");
            }
            args.extend(self.value(ty, None, role).0);
        }
        args
    }

    /// Measures with what they are compared with, each a rule behind its parenthesis.
    fn comparisons(&mut self) -> Ways {
        let mut ways = Ways::new();
        for (index, measure) in self.of.signatures.measures.iter().enumerate() {
            let Ok(number) = u16::try_from(index) else { break };
            let has_values = measure.params.iter().all(|(_, ty)| !self.of.table(ty).0.entries.is_empty());
            if !measure.is_observable || !has_values {
                continue;
            }
            let at = self.act(Action::Open(NodeKind::Get(number)));
            self.arguments(&measure.params, WordRole::Free);
            self.of.asm.literal(") ");
            if self.comparison(&measure.result) {
                ways.push((format_smolstr!("{}(", identifier(&measure.name)), at, Guard::Loose));
            }
        }
        ways
    }

    /// `< 0.5 m`; false where nothing can be compared with.
    fn comparison(&mut self, ty: &Type) -> bool {
        self.of.relation(ty, WordEnd::Whole, |relation| format_smolstr!("{} ", relation.symbol()));
        let can = self.of.operand(ty, WordEnd::Bare).unwrap_or_else(|| {
            self.value(ty, None, WordRole::Free);
            true
        });
        self.act(Action::Close);
        self.of.asm.put(Op::Return);
        can
    }
}
