//! The text form of the model subset as a grammar. WordList and the spaces between them are literals of their own, so that a
//! reader that takes the longest word is never misled by two that begin alike.

use motet_syntax::print::identifier;
use motet_syntax::unit::Unit;
use smol_str::SmolStr;

use super::class;
use super::grammar::{Expr, Grammar, RuleId};
use super::number;
use super::offer::{Atom, CallOffer, Offer, SECONDS, is_ordered};
use super::value_set::ValueSet;
use crate::subset::{
    MAX_CONDITION_DEPTH, MAX_COUNT, MAX_ITEMS, MAX_MEMBERS, MAX_RETRIES, MAX_STEPS, Modifiers, NumberRange,
    Relation,
};

/// The grammar of an offer.
pub(super) fn grammar(offer: &Offer) -> Grammar {
    let mut grammar = Grammar::default();
    let root = grammar.add("root", Expr::Seq(Vec::new()), false);
    let name = grammar.add("name", class::name_but(offer.excluded.iter().map(SmolStr::as_str)), true);
    let quoted = Expr::seq(vec![Expr::literal("\""), class::text(), Expr::literal("\"")]);
    let text = grammar.add("text", quoted, true);
    let mut builder = Builder { offer, grammar, name, text, slots: Vec::new(), numbers: Vec::new() };
    for slot in &offer.slots {
        let value = builder.value(slot);
        let rule = builder.grammar.add(&slot.name, value, false);
        builder.slots.push(rule);
    }
    let body = builder.document();
    if let Some(rule) = builder.grammar.rules.get_mut(root.0) {
        rule.body = body;
    }
    builder.grammar
}

pub(super) struct Builder<'o> {
    offer: &'o Offer,
    grammar: Grammar,
    name: RuleId,
    text: RuleId,
    slots: Vec<RuleId>,
    numbers: Vec<(NumberRange, RuleId)>,
}

/// WordList with single spaces between them.
fn words(text: &str) -> Vec<Expr> {
    let mut parts = Vec::new();
    for (index, word) in text.split(' ').enumerate() {
        if index > 0 {
            parts.push(space());
        }
        if !word.is_empty() {
            parts.push(Expr::literal(word));
        }
    }
    parts
}

fn space() -> Expr {
    Expr::literal(" ")
}

/// One after the other, literals kept apart.
fn line(parts: Vec<Vec<Expr>>) -> Expr {
    Expr::Seq(parts.into_iter().flatten().collect())
}

fn bound(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

impl Builder<'_> {
    fn rule(&mut self, name: &str, body: Expr) -> Expr {
        Expr::Rule(self.grammar.add(name, body, false))
    }

    fn named(&self) -> Expr {
        Expr::Rule(self.name)
    }

    fn document(&mut self) -> Expr {
        let goal = self.conditions("goal", &self.offer.goals);
        let asked = self.conditions("condition", &self.offer.asked);
        let block = self.blocks(asked);
        let mut parts = vec![words("policy "), vec![self.named()]];
        if let Some(robot) = &self.offer.robot {
            parts.push(words(&format!(" for {}", identifier(robot))));
        }
        if let Some(goal) = goal {
            let stated = line(vec![words(" achieves "), vec![goal]]);
            parts.push(vec![stated.optional()]);
        }
        parts.push(vec![space(), block]);
        line(parts)
    }

    fn value(&mut self, slot: &ValueSet) -> Expr {
        let mut values: Vec<Expr> = slot.names.iter().map(|name| Expr::literal(identifier(name))).collect();
        values.extend(slot.any.then(|| Expr::literal("any")));
        values.extend(slot.number.map(|range| self.number(range)));
        if slot.bool {
            values.extend([Expr::literal("true"), Expr::literal("false")]);
        }
        values.extend(slot.text.then_some(Expr::Rule(self.text)));
        values.extend(slot.binding.then(|| self.named()));
        if let Some(items) = slot.items.and_then(|items| self.slots.get(items)) {
            values.push(list(Expr::Rule(*items)));
        }
        Expr::choice(values)
    }

    fn number(&mut self, range: NumberRange) -> Expr {
        let digits = match range.unit {
            Some(Unit::Percent) => NumberRange { decimals: range.decimals.saturating_sub(2), ..range },
            Some(_) | None => range,
        };
        let known = self.numbers.iter().find(|(known, _)| *known == digits).map(|(_, rule)| *rule);
        let rule = known.unwrap_or_else(|| {
            let rule = self.grammar.add("number", number::expr(&digits), true);
            self.numbers.push((digits, rule));
            rule
        });
        match range.unit {
            Some(unit) => Expr::Seq(vec![Expr::Rule(rule), space(), Expr::literal(unit.symbol())]),
            None => Expr::Rule(rule),
        }
    }

    fn slot(&self, id: usize) -> Expr {
        self.slots.get(id).map_or(Expr::Seq(Vec::new()), |rule| Expr::Rule(*rule))
    }

    fn applied(&self, name: &str, args: &[(SmolStr, usize)]) -> Vec<Expr> {
        let mut parts = vec![Expr::literal(identifier(name)), Expr::literal("(")];
        for (index, (_, slot)) in args.iter().enumerate() {
            if index > 0 {
                parts.extend([Expr::literal(","), space()]);
            }
            parts.push(self.slot(*slot));
        }
        parts.push(Expr::literal(")"));
        parts
    }

    /// Conditions that stand in one another as deep as the subset allows; none where there is nothing to ask for.
    fn conditions(&mut self, name: &str, atoms: &[Atom]) -> Option<Expr> {
        let (mut fluents, mut comparisons) = (Vec::new(), Vec::new());
        for atom in atoms {
            match atom {
                Atom::Fluent(fluent, args) => fluents.push(Expr::Seq(self.applied(fluent, args))),
                Atom::Measure(measure, args, than) => {
                    let subject = self.applied(measure, args);
                    comparisons.push(self.compared(subject, *than));
                }
                Atom::Field(field, of, than) => {
                    let subject = vec![self.slot(*of), Expr::literal("."), Expr::literal(identifier(field))];
                    comparisons.push(self.compared(subject, *than));
                }
            }
        }
        if fluents.is_empty() && comparisons.is_empty() {
            return None;
        }
        let fluent =
            (!fluents.is_empty()).then(|| self.rule(&format!("{name}_fluent"), Expr::choice(fluents)));
        let comparison = (!comparisons.is_empty())
            .then(|| self.rule(&format!("{name}_comparison"), Expr::choice(comparisons)));
        let enclosed = |inner: Expr| Expr::Seq(vec![Expr::literal("("), inner, Expr::literal(")")]);
        let atoms: Vec<Expr> = fluent.iter().chain(&comparison).cloned().collect();
        // What may stand beside `and`, and behind `not`, one level below.
        let mut member = Expr::choice(atoms.clone());
        let mut operand = Expr::choice(fluent.into_iter().chain(comparison.map(enclosed)).collect());
        let mut condition = member.clone();
        for depth in 1..=MAX_CONDITION_DEPTH {
            let below = self.rule(&format!("{name}_member_{depth}"), member);
            let joined = |word: &str| {
                let more = line(vec![vec![space()], words(word), vec![space(), below.clone()]]);
                Expr::Seq(vec![below.clone(), more.repeat(1, bound(MAX_MEMBERS - 1))])
            };
            let groups = Expr::choice(vec![joined("and"), joined("or")]);
            let group = self.rule(&format!("{name}_group_{depth}"), groups);
            let negated = line(vec![words("not "), vec![operand.clone()]]);
            let negated = self.rule(&format!("{name}_not_{depth}"), negated);
            let with = |more: Vec<Expr>| Expr::choice(atoms.iter().cloned().chain(more).collect());
            condition = with(vec![negated.clone(), group.clone()]);
            member = with(vec![negated.clone(), enclosed(group.clone())]);
            operand = Expr::choice(vec![operand, negated, enclosed(group)]);
        }
        Some(self.rule(name, condition))
    }

    fn compared(&self, mut subject: Vec<Expr>, than: usize) -> Expr {
        let relations: &[Relation] =
            if is_ordered(self.offer.slot(than)) { &Relation::ALL } else { &Relation::EQUALITY };
        let symbols = relations.iter().map(|relation| Expr::literal(relation.symbol())).collect();
        subject.extend([space(), Expr::choice(symbols), space(), self.slot(than)]);
        Expr::Seq(subject)
    }

    /// The block of a policy.
    fn blocks(&mut self, asked: Option<Expr>) -> Expr {
        let written = self.offer.subset.modifiers == Modifiers::Written;
        let seconds = self.number(SECONDS);
        let deadline = |word: &str| line(vec![words(word), vec![seconds.clone()]]);
        let within = written.then(|| deadline(" within ").optional());
        let count = self.number(NumberRange::whole(1, MAX_COUNT));
        let mut leaves = Vec::new();
        for call in &self.offer.calls {
            let call = self.call(call, within.as_ref());
            leaves.push(call);
        }
        if let Some(asked) = &asked {
            let waiting =
                line(vec![words("wait until "), vec![asked.clone()], within.iter().cloned().collect()]);
            leaves.push(self.rule("wait", waiting));
        }
        let why = self.slot(self.offer.why);
        let ending = |word: &str| line(vec![words(word), vec![why.clone()]]);
        let end = Expr::choice(vec![Expr::literal("done"), ending("fail "), ending("replan ")]);
        let end = self.rule("end", end);
        leaves.push(end.clone());
        let failures = self.offer.failures.iter().map(|failure| Expr::literal(identifier(failure))).collect();
        let failure = self.rule("failure", Expr::choice(failures));
        let list = self.lists();
        let parts = Parts { asked, within, count, seconds: deadline(" for ").optional(), end, failure, list };
        let step = self.rule("step_0", Expr::choice(leaves.clone()));
        let mut block = self.block(0, step);
        for depth in 1..=self.offer.subset.depth {
            let mut steps = leaves.clone();
            steps.extend(self.composites(depth, &block, &parts));
            let step = self.rule(&format!("step_{depth}"), Expr::choice(steps));
            block = self.block(depth, step);
        }
        block.of_one
    }

    fn call(&mut self, call: &CallOffer, within: Option<&Expr>) -> Expr {
        let mut parts = Vec::new();
        if call.binds {
            parts.push(words("let "));
            parts.push(vec![self.named()]);
            parts.push(words(" = "));
        }
        parts.push(self.applied(&call.name, &call.args));
        if let Some(within) = within.filter(|_| call.modifiers) {
            let retries = self.number(NumberRange::whole(0, MAX_RETRIES));
            parts.push(vec![within.clone()]);
            parts.push(vec![line(vec![words(" retry "), vec![retries]]).optional()]);
        }
        self.rule(&format!("do_{}", call.name), line(parts))
    }

    fn lists(&mut self) -> Option<Expr> {
        let mut lists: Vec<Expr> = self.offer.binds_lists.then(|| self.named()).into_iter().collect();
        for names in &self.offer.lists {
            let names = names.iter().filter(|name| *name != "any");
            lists.push(list(Expr::choice(names.map(|name| Expr::literal(identifier(name))).collect())));
        }
        if lists.is_empty() { None } else { Some(self.rule("list", Expr::choice(lists))) }
    }

    /// A block of steps: of one at least, and of any number.
    fn block(&mut self, depth: usize, step: Expr) -> Block {
        let more = Expr::Seq(vec![space(), step]);
        let braced = |least: u32| {
            let steps = more.clone().repeat(least, bound(MAX_STEPS));
            Expr::Seq(vec![Expr::literal("{"), steps, space(), Expr::literal("}")])
        };
        let (of_one, of_any) = (braced(1), braced(0));
        Block {
            of_one: self.rule(&format!("block_{depth}"), of_one),
            of_any: self.rule(&format!("block_or_none_{depth}"), of_any),
        }
    }

    fn composites(&mut self, depth: usize, block: &Block, parts: &Parts) -> Vec<Expr> {
        let Block { of_one, of_any } = block;
        let mut found = Vec::new();
        let mut add = |builder: &mut Self, name: &str, sections: Vec<Vec<Expr>>| {
            let rule = builder.rule(&format!("{name}_{depth}"), line(sections));
            found.push(rule);
        };
        let named = self.named();
        add(self, "sequence", vec![words("sequence "), vec![named.clone(), space(), of_one.clone()]]);
        if let Some(asked) = &parts.asked {
            let otherwise = line(vec![words(" else "), vec![of_one.clone()]]).optional();
            let sections = vec![words("if "), vec![asked.clone(), space(), of_one.clone(), otherwise]];
            add(self, "if", sections);
            let restart = line(vec![words("restart at most "), vec![parts.count.clone()]]);
            let resume =
                line(vec![words("resume at most "), vec![parts.count.clone(), space(), of_one.clone()]]);
            let pause = line(vec![words("pause"), parts.within.iter().cloned().collect()]);
            let reaction = Expr::choice(vec![pause, restart, resume, parts.end.clone()]);
            let when = line(vec![
                words(" when "),
                vec![asked.clone(), parts.seconds.clone()],
                words(" then "),
                vec![reaction],
            ]);
            let sections = vec![
                words("monitor {"),
                vec![when.repeat(1, bound(MAX_MEMBERS))],
                words(" } during "),
                vec![of_one.clone()],
            ];
            add(self, "monitor", sections);
        }
        let more = Expr::Seq(vec![Expr::literal(","), space(), parts.failure.clone()]);
        let kinds = Expr::Seq(vec![parts.failure.clone(), more.repeat(0, bound(MAX_MEMBERS - 1))]);
        let on = Expr::choice(vec![Expr::literal("any"), kinds]);
        let handler = line(vec![words(" catch "), vec![on, space(), of_any.clone()]]);
        add(self, "try", vec![words("try "), vec![of_one.clone(), handler.repeat(1, bound(MAX_MEMBERS))]]);
        let until =
            parts.asked.iter().map(|asked| line(vec![words(" until "), vec![asked.clone()]]).optional());
        let until = until.collect();
        let repeated = vec![parts.count.clone(), space(), of_one.clone()];
        add(self, "repeat", vec![words("repeat "), repeated, until]);
        if let Some(list) = &parts.list {
            let sections = vec![
                words("each "),
                vec![named],
                words(" in "),
                vec![list.clone()],
                words(" at most "),
                vec![parts.count.clone(), space(), of_one.clone()],
            ];
            add(self, "each", sections);
        }
        let branch = Expr::Seq(vec![space(), of_one.clone()]);
        let branches = branch.repeat(2, bound(MAX_MEMBERS));
        add(self, "parallel", vec![words("parallel {"), vec![branches], words(" }")]);
        found
    }
}

/// Values in brackets.
fn list(item: Expr) -> Expr {
    let more = Expr::Seq(vec![Expr::literal(","), space(), item.clone()]);
    Expr::Seq(vec![Expr::literal("["), item, more.repeat(0, bound(MAX_ITEMS - 1)), Expr::literal("]")])
}

/// A block, with steps and perhaps without.
struct Block {
    of_one: Expr,
    of_any: Expr,
}

/// What the steps with steps are made of.
struct Parts {
    asked: Option<Expr>,
    within: Option<Expr>,
    count: Expr,
    seconds: Expr,
    end: Expr,
    failure: Expr,
    list: Option<Expr>,
}
