//! Derivation of a grammar in EBNF: actions and guards are left out, and the recursion of blocks and
//! conditions is written out to the depth of the subset.
//!
//! In text, words and the spaces between them become literals of their own, so that a lexer that takes the
//! longest literal is never misled by two that begin alike. In JSON neighbouring literals become one,
//! except for `[`.

use motet_syntax::Syntax;
use motet_syntax::print::identifier;
use motet_syntax::unit::Unit;
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use super::ebnf::{EbnfExpr as Expr, EbnfGrammar, RuleId};
use super::terminal;
use crate::grammar::{
    Alternative, Atom, AtomSort, BlockRole, CleanupOf, ConditionUse, Grammar, NodeKind, Part, Relation,
    Repeat, ValueSet,
};
use crate::subset::{MAX_CONDITION_DEPTH, MAX_ITEMS, MAX_MEMBERS, MAX_STEPS, NumberRange};

/// Derives the EBNF of a grammar.
pub(super) fn ebnf(grammar: &Grammar) -> EbnfGrammar {
    let mut out = EbnfGrammar::default();
    // The root stands first, and is known last.
    let root = out.add("root", Expr::Seq(Vec::new()), false);
    let is_json = grammar.subset.syntax == Syntax::Json;
    let quoted = |open: &str, inner| Expr::seq(vec![Expr::literal(open), inner, Expr::literal("\"")]);
    let [name, binding] = if is_json {
        let name = out.add("name", quoted("\"", terminal::name()), true);
        [name, out.add("binding", quoted("\"$", terminal::name()), true)]
    } else {
        let words = grammar.excluded_names();
        [out.add("name", terminal::name_but(words.iter().map(SmolStr::as_str)), true); 2]
    };
    let terms: Vec<&str> = terminal::TEXT_TERMS.into_iter().filter(|term| grammar.has_term(term)).collect();
    let fields: &[&str] = if grammar.has_caught() { &terminal::TEXT_FIELDS } else { &[] };
    let text = out.add("text", quoted("\"", terminal::text(&terms, fields, grammar.subset.syntax)), true);
    let mut deriver = Deriver {
        grammar,
        is_json,
        out,
        name: Expr::Rule(name),
        binding: Expr::Rule(binding),
        text: Expr::Rule(text),
        numbers: Vec::new(),
        values: Vec::new(),
        rules: FxHashMap::default(),
    };
    let body = deriver.parts("", &grammar.document, Level::of_policy(grammar));
    if let Some(rule) = deriver.out.rules.get_mut(root.0) {
        rule.body = body;
    }
    deriver.out
}

/// Position of a part in the nesting of blocks.
#[derive(Clone, Copy)]
pub(super) struct Level {
    /// Number of block levels that may still nest in the steps here.
    pub(super) depth: usize,
    pub(super) in_goal: bool,
    pub(super) in_cleanup: bool,
}

impl Level {
    pub(super) fn of_policy(grammar: &Grammar) -> Self {
        Self { depth: grammar.subset.depth, in_goal: false, in_cleanup: false }
    }

    /// The level of a cleanup of what stands at this one.
    pub(super) fn of_cleanup(self) -> Option<Self> {
        let depth = self.depth.checked_sub(1).filter(|_| !self.in_cleanup)?;
        Some(Self { depth, in_cleanup: true, ..self })
    }
}

struct Deriver<'g> {
    grammar: &'g Grammar,
    is_json: bool,
    out: EbnfGrammar,
    name: Expr,
    binding: Expr,
    text: Expr,
    numbers: Vec<(NumberRange, RuleId)>,
    values: Vec<(ValueSet, Expr)>,
    /// Rules that were derived, by name.
    rules: FxHashMap<String, Expr>,
}

fn bound(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

impl Deriver<'_> {
    fn rule(&mut self, name: String, body: Expr) -> Expr {
        let rule = Expr::Rule(self.out.add(&name, body, false));
        self.rules.insert(name, rule.clone());
        rule
    }

    /// Literals as the syntax keeps them apart.
    fn literal(&self, text: &str, found: &mut Vec<Expr>) {
        if self.is_json {
            found.extend((!text.is_empty()).then(|| Expr::literal(text)));
            return;
        }
        let is_word = |character: char| character.is_alphanumeric() || character == '_';
        let mut rest = text;
        while let Some(first) = rest.chars().next() {
            let end = match first {
                ' ' => 1,
                '`' => {
                    rest.char_indices().skip(1).find(|(_, c)| *c == '`').map_or(rest.len(), |(at, _)| at + 1)
                }
                first if is_word(first) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
                _ => rest.find(|c| is_word(c) || c == ' ' || c == '`').unwrap_or(rest.len()),
            };
            let (word, behind) = rest.split_at_checked(end).unwrap_or((rest, ""));
            found.push(Expr::literal(word));
            rest = behind;
        }
    }

    fn literals(&self, text: &str) -> Expr {
        let mut found = Vec::new();
        self.literal(text, &mut found);
        self.seq(found)
    }

    fn seq(&self, found: Vec<Expr>) -> Expr {
        if self.is_json { Expr::seq(found) } else { Expr::Seq(found) }
    }

    /// Parts in a row, behind a literal.
    fn parts(&mut self, lead: &str, parts: &[Part], level: Level) -> Expr {
        let mut found = Vec::new();
        self.literal(lead, &mut found);
        for part in parts {
            self.part(part, level, &mut found);
        }
        self.seq(found)
    }

    fn part(&mut self, part: &Part, level: Level, found: &mut Vec<Expr>) {
        match part {
            Part::Literal(text) => self.literal(text, found),
            Part::Action(_) => {}
            Part::Name(_) => {
                found.push(self.name.clone());
                found.extend((!self.is_json).then(|| Expr::literal(" ")));
            }
            Part::Value { ty, range, place } => {
                let set = ValueSet::of(ty, *range, *place, level.in_goal, self.grammar);
                found.push(self.value(set));
            }
            Part::Number(range) => found.push(self.number(*range)),
            Part::OptionalNumber { lead, range } => {
                let number = self.number(*range);
                let mut some = Vec::new();
                self.literal(lead, &mut some);
                if self.is_json {
                    found.append(&mut some);
                    found.push(Expr::choice(vec![number, Expr::literal("null")]));
                } else {
                    some.push(number);
                    found.push(Expr::Seq(some).optional());
                }
            }
            Part::Manner => {
                let words = ["slowly", "gently"];
                let lead = self.grammar.manner_lead();
                let part = self.number(NumberRange::PART);
                if self.is_json {
                    self.literal(lead, found);
                    let words = words.map(|word| Expr::literal(format!("\"{word}\"")));
                    found
                        .push(Expr::choice(words.into_iter().chain([part, Expr::literal("null")]).collect()));
                } else {
                    let mut some = Vec::new();
                    self.literal(lead, &mut some);
                    let part = Expr::Seq(vec![self.literals("at "), part]);
                    some.push(Expr::choice(words.map(Expr::literal).into_iter().chain([part]).collect()));
                    found.push(Expr::Seq(some).optional());
                }
            }
            Part::Relation(ty) => {
                let relations: &[Relation] =
                    if ValueSet::is_ordered(ty) { &Relation::ALL } else { &Relation::EQUALITY };
                let spelled = |relation: &Relation| match self.is_json {
                    true => Expr::literal(format!("\"{}\"", relation.word())),
                    false => Expr::literal(relation.symbol()),
                };
                found.push(Expr::choice(relations.iter().map(spelled).collect()));
                found.extend((!self.is_json).then(|| Expr::literal(" ")));
            }
            Part::Failures => {
                found.push(self.failures());
                found.extend((!self.is_json).then(|| Expr::literal(" ")));
            }
            Part::EntityList => found.push(self.entity_list()),
            Part::ListName | Part::Caught => found.push(self.binding.clone()),
            Part::FailureKind => found.push(self.failure()),
            Part::CaughtName => self.optional([",\"as\":", "as "], self.name.clone(), found),
            Part::ResultType => {
                let types = self.grammar.result_types();
                let spelled = |name: &SmolStr| match self.is_json {
                    true => Expr::literal(format!("\"{name}\"")),
                    false => self.literals(name),
                };
                let types = Expr::choice(types.iter().map(|(_, name)| spelled(name)).collect());
                self.optional([",\"result\":", "-> "], types, found);
            }
            Part::Given { .. } => {
                let lead = if self.is_json { ",\"result\":" } else { " " };
                found.push(Expr::Seq(vec![Expr::literal(lead), self.binding.clone()]).optional());
            }
            Part::Cleanup(of) => self.cleanup(*of, level, found),
            Part::Condition(asked) => found.push(self.condition(*asked == ConditionUse::Goal)),
            Part::Block(role, least) => {
                let depth =
                    if *role == BlockRole::Body { level.depth } else { level.depth.saturating_sub(1) };
                found.push(self.block(Level { depth, ..level }, *least));
            }
            Part::Choice(_, alternatives) => {
                let alternatives = Alternative::flattened(alternatives, "");
                let alternatives = alternatives
                    .iter()
                    .map(|alternative| self.parts(&alternative.literal, &alternative.parts, level))
                    .collect();
                found.push(Expr::choice(alternatives));
            }
            Part::Optional { present, .. } => {
                let some = self.parts(&present.literal, &present.parts, level);
                found.push(some.optional());
            }
            Part::Repeat(repeat) => {
                let Repeat { open, item, separator, end, least, most } = &**repeat;
                let first = self.parts("", item, level);
                let more = self.parts(separator, item, level);
                let more = more.repeat(u32::from(*least) - 1, u32::from(*most) - 1);
                found.push(self.bracketed([open, end], Expr::seq(vec![first, more])));
            }
        }
    }

    /// A word, or in JSON `null` and in text nothing, behind what leads to it.
    fn optional(&self, [json, text]: [&str; 2], word: Expr, found: &mut Vec<Expr>) {
        if self.is_json {
            self.literal(json, found);
            found.push(Expr::choice(vec![word, Expr::literal("null")]));
        } else {
            let mut some = Vec::new();
            self.literal(text, &mut some);
            some.extend([word, Expr::literal(" ")]);
            found.push(Expr::Seq(some).optional());
        }
    }

    /// A kind of failure.
    fn failure(&mut self) -> Expr {
        if let Some(known) = self.rules.get("failure") {
            return known.clone();
        }
        let failures = self.grammar.signatures.failures.iter().map(|name| self.word(name)).collect();
        self.rule("failure".into(), Expr::choice(failures))
    }

    /// The cleanup of a step or of the policy, or none.
    fn cleanup(&mut self, of: CleanupOf, level: Level, found: &mut Vec<Expr>) {
        let block = level.of_cleanup().map(|level| self.block(level, 1));
        match (of, self.is_json) {
            (CleanupOf::Policy, true) => {
                self.literal(",\"finally\":", found);
                let null = Expr::literal("null");
                found.push(Expr::choice(block.into_iter().chain([null]).collect()));
            }
            (CleanupOf::Step, true) => {
                let lead = Expr::literal(",\"finally\":");
                found.extend(block.map(|block| Expr::Seq(vec![lead, block]).optional()));
            }
            (CleanupOf::Step | CleanupOf::Policy, false) => found.extend(block.map(|block| {
                let mut some = Vec::new();
                self.literal(" finally ", &mut some);
                some.push(block);
                Expr::Seq(some).optional()
            })),
        }
    }

    /// Brackets are literals of their own.
    fn bracketed(&self, [open, end]: [&str; 2], inner: Expr) -> Expr {
        let mut found = Vec::new();
        self.literal(open, &mut found);
        found.push(inner);
        self.literal(end, &mut found);
        Expr::Seq(found)
    }

    fn list(&self, item: Expr, [least, most]: [usize; 2]) -> Expr {
        let mut more = Vec::new();
        self.literal(if self.is_json { "," } else { ", " }, &mut more);
        more.push(item.clone());
        let more = Expr::seq(more).repeat(bound(least.saturating_sub(1)), bound(most - 1));
        Expr::seq(vec![item, more])
    }

    fn number(&mut self, range: NumberRange) -> Expr {
        let digits = if self.is_json { NumberRange { unit: None, ..range } } else { range.spelled_in_text() };
        let digits = NumberRange { unit: None, ..digits };
        let known = self.numbers.iter().find(|(known, _)| *known == digits).map(|(_, rule)| *rule);
        let rule = known.unwrap_or_else(|| {
            let rule = self.out.add("number", terminal::number(&digits), true);
            self.numbers.push((digits, rule));
            rule
        });
        match range.unit.filter(|_| !self.is_json) {
            Some(unit) => {
                Expr::Seq(vec![Expr::Rule(rule), Expr::literal(" "), Expr::literal(Unit::symbol(unit))])
            }
            None => Expr::Rule(rule),
        }
    }

    fn word(&self, name: &str) -> Expr {
        // A string always has a JSON syntax.
        let quoted = || serde_json::to_string(name).unwrap_or_default();
        Expr::literal(if self.is_json { quoted() } else { identifier(name) })
    }

    fn value(&mut self, set: ValueSet) -> Expr {
        if let Some((_, known)) = self.values.iter().find(|(known, _)| *known == set) {
            return known.clone();
        }
        let mut values: Vec<Expr> = set.names.iter().map(|name| self.word(name)).collect();
        values.extend(set.any.then(|| Expr::literal(if self.is_json { "\"any\"" } else { "any" })));
        values.extend(set.number.map(|range| self.number(range)));
        if set.bool {
            values.extend([Expr::literal("true"), Expr::literal("false")]);
        }
        values.extend(set.text.then(|| self.text.clone()));
        values.extend(set.binding.then(|| self.binding.clone()));
        if set.first {
            let [open, end] =
                if self.is_json { ["{\"get\":\"first\",\"of\":", "}"] } else { ["first(", ")"] };
            values.push(self.bracketed([open, end], self.binding.clone()));
        }
        if set.pose {
            let [open, end] = if self.is_json { ["{\"pose\":[", "]}"] } else { ["pose(", ")"] };
            let mut numbers = Vec::new();
            for (index, range) in NumberRange::of_pose().into_iter().enumerate() {
                if index > 0 {
                    self.literal(if self.is_json { "," } else { ", " }, &mut numbers);
                }
                numbers.push(self.number(range));
            }
            let numbers = self.seq(numbers);
            values.push(self.bracketed([open, end], numbers));
        }
        if let Some(items) = &set.items {
            let item = self.value((**items).clone());
            values.push(self.bracketed(["[", "]"], self.list(item, [1, MAX_ITEMS])));
        }
        let value = match Expr::choice(values) {
            // A rule needs no second name.
            rule @ Expr::Rule(_) => rule,
            value => Expr::Rule(self.out.add(&set.name, value, false)),
        };
        self.values.push((set, value.clone()));
        value
    }

    fn failures(&mut self) -> Expr {
        if let Some(known) = self.rules.get("failures") {
            return known.clone();
        }
        let failure = self.failure();
        let several = self.list(failure, [1, MAX_MEMBERS]);
        let brackets = if self.is_json { ["[", "]"] } else { ["", ""] };
        // As a keyword, which is no name.
        let any = Expr::literal(if self.is_json { "\"any\"" } else { "any" });
        let any = self.bracketed(brackets, any);
        let several = self.bracketed(brackets, several);
        self.rule("failures".into(), Expr::choice(vec![any, several]))
    }

    /// A binding of a list, or the entities of one kind.
    fn entity_list(&mut self) -> Expr {
        if let Some(known) = self.rules.get("list") {
            return known.clone();
        }
        let binds = self.grammar.binds_lists();
        let mut lists: Vec<Expr> = binds.then(|| self.binding.clone()).into_iter().collect();
        for names in self.grammar.entities_by_kind() {
            let entity = Expr::choice(names.iter().map(|name| self.word(name)).collect());
            lists.push(self.bracketed(["[", "]"], self.list(entity, [1, MAX_ITEMS])));
        }
        self.rule("list".into(), Expr::choice(lists))
    }

    /// A block whose steps nest blocks to a depth.
    fn block(&mut self, level: Level, least: u32) -> Expr {
        let mark = if level.in_cleanup { "cleanup_" } else { "" };
        let of = if least == 0 { "block_or_none" } else { "block" };
        let name = format!("{mark}{of}_{}", level.depth);
        if let Some(known) = self.rules.get(&name) {
            return known.clone();
        }
        let step = self.step(level);
        let steps = if self.is_json {
            let steps = self.list(step, [1, MAX_STEPS]);
            let steps = if least == 0 { steps.optional() } else { steps };
            self.bracketed(["[", "]"], steps)
        } else {
            let more = Expr::Seq(vec![Expr::literal(" "), step]).repeat(least, bound(MAX_STEPS));
            self.bracketed(["{", " }"], more)
        };
        self.rule(name, steps)
    }

    fn step(&mut self, level: Level) -> Expr {
        let (depth, mark) = (level.depth, if level.in_cleanup { "cleanup_" } else { "" });
        let name = format!("{mark}step_{depth}");
        if let Some(known) = self.rules.get(&name) {
            return known.clone();
        }
        let grammar = self.grammar;
        let steps = grammar.steps.iter().filter(|step| step.cleans || !level.in_cleanup);
        let steps: Vec<Alternative> = steps.cloned().collect();
        let mut alternatives = Vec::new();
        for step in Alternative::flattened(&steps, if self.is_json { "{\"" } else { "" }) {
            let is_composite = step.is_composite();
            if is_composite && depth == 0 {
                continue;
            }
            let name = match is_composite {
                true => format!("{mark}{}_{depth}", step.name),
                false => step.name.to_string(),
            };
            let known = self.rules.get(&name).cloned();
            let alternative = known.unwrap_or_else(|| {
                let body = self.parts(&step.literal, &step.parts, level);
                self.rule(name, body)
            });
            alternatives.push(alternative);
        }
        self.rule(name, Expr::choice(alternatives))
    }

    /// Conditions nested as deep as the subset allows.
    fn condition(&mut self, in_goal: bool) -> Expr {
        let prefix = if in_goal { "goal" } else { "condition" };
        if let Some(known) = self.rules.get(prefix) {
            return known.clone();
        }
        let grammar = self.grammar;
        let level = Level { depth: 0, in_goal, in_cleanup: false };
        let asked: Vec<&Atom> = grammar.asked_atoms(in_goal).collect();
        let (mut fluents, mut comparisons) = (Vec::new(), Vec::new());
        for atom in asked {
            let lead = if self.is_json { format!("{{\"{}", atom.sort.lead()) } else { String::new() };
            let body = self.parts(&format!("{lead}{}", atom.spelled.literal), &atom.spelled.parts, level);
            let atoms = if atom.sort == AtomSort::Fluent { &mut fluents } else { &mut comparisons };
            atoms.push(body);
        }
        let mut family = |name: &str, atoms: Vec<Expr>| {
            (!atoms.is_empty()).then(|| self.rule(format!("{prefix}_{name}"), Expr::choice(atoms)))
        };
        let (fluent, comparison) = (family("fluent", fluents), family("comparison", comparisons));
        let condition = if self.is_json {
            self.prefix_condition(prefix, fluent.into_iter().chain(comparison).collect())
        } else {
            self.infix_condition(prefix, fluent, comparison)
        };
        self.rule(prefix.to_owned(), condition)
    }

    fn prefix_condition(&mut self, prefix: &str, atoms: Vec<Expr>) -> Expr {
        let mut level = Expr::choice(atoms.clone());
        for depth in 1..=MAX_CONDITION_DEPTH {
            let several = self.bracketed(["[", "]"], self.list(level.clone(), [2, MAX_MEMBERS]));
            let several = self.rule(format!("{prefix}s_{depth}"), several);
            let nested = [(NodeKind::Not, level), (NodeKind::All, several.clone()), (NodeKind::Any, several)];
            // The brackets belong to the rule of several conditions.
            let nested = nested.map(|(kind, inner)| {
                let [open, _, end] = self.grammar.connective(kind).unwrap_or_default();
                let [open, end] = [open.trim_end_matches('['), end.trim_start_matches(']')];
                Expr::seq(vec![Expr::literal(open), inner, Expr::literal(end)])
            });
            level = Expr::choice(atoms.iter().cloned().chain(nested).collect());
            if depth < MAX_CONDITION_DEPTH {
                level = self.rule(format!("{prefix}_{depth}"), level);
            }
        }
        level
    }

    fn infix_condition(&mut self, prefix: &str, fluent: Option<Expr>, comparison: Option<Expr>) -> Expr {
        let enclosed = |inner: Expr| Expr::Seq(vec![Expr::literal("("), inner, Expr::literal(")")]);
        let atoms: Vec<Expr> = fluent.iter().chain(&comparison).cloned().collect();
        // A member stands beside `and` and `or`, an operand behind `not`.
        let mut member = Expr::choice(atoms.clone());
        let mut operand = Expr::choice(fluent.into_iter().chain(comparison.map(enclosed)).collect());
        let mut condition = member.clone();
        for depth in 1..=MAX_CONDITION_DEPTH {
            let below = self.rule(format!("{prefix}_member_{depth}"), member);
            let joined = |kind: NodeKind| {
                let [_, separator, _] = self.grammar.connective(kind).unwrap_or_default();
                let mut more = Vec::new();
                self.literal(separator, &mut more);
                more.push(below.clone());
                Expr::Seq(vec![below.clone(), Expr::Seq(more).repeat(1, bound(MAX_MEMBERS - 1))])
            };
            let groups = Expr::choice(vec![joined(NodeKind::All), joined(NodeKind::Any)]);
            let group = self.rule(format!("{prefix}_group_{depth}"), groups);
            let [not, ..] = self.grammar.connective(NodeKind::Not).unwrap_or_default();
            let negated = Expr::Seq(vec![self.literals(not), operand.clone()]);
            let negated = self.rule(format!("{prefix}_not_{depth}"), negated);
            let with = |more: Vec<Expr>| Expr::choice(atoms.iter().cloned().chain(more).collect());
            condition = with(vec![negated.clone(), group.clone()]);
            member = with(vec![negated.clone(), enclosed(group.clone())]);
            operand = Expr::choice(vec![operand, negated, enclosed(group)]);
        }
        condition
    }
}
