//! The tree of a policy in the canonical subset, and its spelling by the productions of the grammar.
//!
//! A node holds what stands at the places of its production, in order. The printer goes through the
//! production, writes its literals, and takes an item at each place; of several alternatives it takes the one
//! that opens the node.

use motet_syntax::print::identifier;
use motet_syntax::unit::Unit;
use motet_syntax::{Span, Syntax};
use smol_str::SmolStr;

use super::OutsideSubset;
use crate::grammar::{Alternative, CleanupOf, Grammar, NodeKind, Part, Relation};
use crate::subset::{Decimal, NumberRange};

/// A step, a condition or another node of a policy; the policy itself is a block with a name.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Node {
    pub(super) kind: NodeKind,
    pub(super) span: Span,
    /// The name that the policy gives: its own, of a sequence, of an item, of a result.
    pub(super) name: Option<SmolStr>,
    pub(super) items: Vec<Item>,
}

/// A part of a node.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Item {
    /// The default of a number, or a condition that is left out.
    Nothing,
    Value(Value),
    Number(Decimal),
    /// A word for a manner.
    Manner(&'static str),
    /// A part of the robot's speed as its manner.
    Part(Decimal),
    Relation(Relation),
    /// The name of a failure, or of the type of the policy's result.
    Name(SmolStr),
    /// The kinds of failure of a handler; empty for `any`.
    Failures(Vec<SmolStr>),
    /// A condition or a reaction.
    Node(Node),
    Block(Vec<Node>),
    /// The members of a repetition.
    Members(Vec<Node>),
}

#[derive(Clone, PartialEq, Debug)]
pub(super) enum Value {
    /// The name of a result or an item.
    Binding(SmolStr),
    /// An entity or a case.
    Name(SmolStr),
    /// A number in SI units, with its unit in the text syntax.
    Number(Decimal, Option<Unit>),
    Text(SmolStr),
    Bool(bool),
    /// `any`, of a fluent.
    Any,
    List(Vec<Value>),
    /// The first element of the list with this name.
    First(SmolStr),
    /// A pose by its coordinates and its turn.
    Pose([Decimal; 4]),
}

/// Prints a policy.
///
/// # Errors
///
/// The first node for which the grammar has no production.
pub(super) fn print(policy: &Node, grammar: &Grammar) -> Result<String, OutsideSubset> {
    let is_json = grammar.subset.syntax == Syntax::Json;
    let mut printer = Printer { grammar, is_json, out: String::new() };
    printer.parts(&grammar.document, policy, &mut policy.items.iter())?;
    Ok(printer.out)
}

type Items<'n> = std::slice::Iter<'n, Item>;

struct Printer<'g> {
    grammar: &'g Grammar,
    is_json: bool,
    out: String,
}

fn no_production(node: &Node) -> OutsideSubset {
    OutsideSubset { span: node.span, why: "the canonical subset has no place for it".into() }
}

impl Printer<'_> {
    fn put(&mut self, text: &str) {
        self.out.push_str(text);
    }

    fn alternative(
        &mut self,
        alternative: &Alternative,
        node: &Node,
        items: &mut Items<'_>,
    ) -> Result<(), OutsideSubset> {
        self.put(&alternative.literal);
        self.parts(&alternative.parts, node, items)
    }

    fn parts(&mut self, parts: &[Part], node: &Node, items: &mut Items<'_>) -> Result<(), OutsideSubset> {
        parts.iter().try_for_each(|part| self.part(part, node, items))
    }

    fn part(&mut self, part: &Part, node: &Node, items: &mut Items<'_>) -> Result<(), OutsideSubset> {
        match part {
            Part::Literal(text) => self.put(text),
            Part::Action(_) => {}
            Part::Name(_) => {
                let name = node.name.as_deref().ok_or_else(|| no_production(node))?;
                self.spaced(&if self.is_json { quoted(name) } else { name.to_owned() });
            }
            Part::Choice(_, alternatives)
                if let Some(alternative) =
                    alternatives.iter().find(|alternative| alternative.opens(node.kind)) =>
            {
                self.alternative(alternative, node, items)?;
            }
            Part::Optional { present, .. } => match items.as_slice().first() {
                Some(Item::Nothing) => {
                    items.next();
                }
                Some(Item::Block(steps)) if steps.is_empty() => {
                    items.next();
                }
                _ => self.alternative(present, node, items)?,
            },
            part => {
                let item = items.next().ok_or_else(|| no_production(node))?;
                self.item(part, item, node)?;
            }
        }
        Ok(())
    }

    /// A part that is one item.
    fn item(&mut self, part: &Part, item: &Item, node: &Node) -> Result<(), OutsideSubset> {
        match (part, item) {
            (
                Part::Value { .. } | Part::EntityList | Part::ListName | Part::Caught | Part::FailureKind,
                Item::Value(value),
            ) => self.value(value),
            (Part::CaughtName, Item::Name(name)) => {
                self.put(if self.is_json { ",\"as\":" } else { "as " });
                self.spaced(&if self.is_json { quoted(name) } else { name.to_string() });
            }
            (Part::ResultType, Item::Name(name)) => {
                self.put(if self.is_json { ",\"result\":" } else { "-> " });
                self.spaced(&if self.is_json { quoted(name) } else { name.to_string() });
            }
            (Part::CaughtName, Item::Nothing) if self.is_json => self.put(",\"as\":null"),
            (Part::ResultType, Item::Nothing) if self.is_json => self.put(",\"result\":null"),
            (Part::Given { .. }, Item::Value(value)) => {
                self.put(if self.is_json { ",\"result\":" } else { " " });
                self.value(value);
            }
            (Part::CaughtName | Part::ResultType | Part::Given { .. }, Item::Nothing) => {}
            (Part::Number(range), Item::Number(number)) => self.number(*number, range.unit),
            (Part::OptionalNumber { lead, range }, Item::Number(number)) => {
                self.put(lead);
                self.number(*number, range.unit);
            }
            (Part::OptionalNumber { lead, .. }, Item::Nothing) if self.is_json => {
                self.put(lead);
                self.put("null");
            }
            (Part::OptionalNumber { .. }, Item::Nothing) => {}
            (Part::Manner, Item::Manner(word)) => {
                self.put(self.grammar.manner_lead());
                self.put(&if self.is_json { quoted(word) } else { (*word).to_owned() });
            }
            (Part::Manner, Item::Part(part)) => {
                self.put(self.grammar.manner_lead());
                self.put(if self.is_json { "" } else { "at " });
                self.number(*part, Some(Unit::Percent));
            }
            (Part::Manner, Item::Nothing) if self.is_json => {
                self.put(self.grammar.manner_lead());
                self.put("null");
            }
            (Part::Manner, Item::Nothing) => {}
            (Part::Relation(_), Item::Relation(relation)) => {
                let word = if self.is_json { quoted(relation.word()) } else { relation.symbol().to_owned() };
                self.spaced(&word);
            }
            (Part::Failures, Item::Failures(kinds)) => {
                let kinds: Vec<String> = kinds.iter().map(|kind| self.word(kind)).collect();
                let kinds =
                    if kinds.is_empty() { self.any().to_owned() } else { kinds.join(self.separator()) };
                self.spaced(&if self.is_json { format!("[{kinds}]") } else { kinds });
            }
            (Part::Condition(_), Item::Node(condition)) => self.condition(condition)?,
            (Part::Block(..), Item::Block(steps)) => self.block(steps)?,
            (Part::Cleanup(_), Item::Block(steps)) => {
                self.put(if self.is_json { ",\"finally\":" } else { " finally " });
                self.block(steps)?;
            }
            (Part::Cleanup(CleanupOf::Policy), Item::Nothing) if self.is_json => {
                self.put(",\"finally\":null");
            }
            (Part::Cleanup(_), Item::Nothing) => {}
            (Part::Choice(_, alternatives), item) => self.choice(alternatives, item, node)?,
            (Part::Repeat(repeat), Item::Members(members)) => {
                for (index, member) in members.iter().enumerate() {
                    self.put(if index == 0 { &repeat.open } else { &repeat.separator });
                    self.parts(&repeat.item, member, &mut member.items.iter())?;
                }
                self.put(&repeat.end);
            }
            _ => return Err(no_production(node)),
        }
        Ok(())
    }

    /// A choice that is not about the node around it: a reaction, or a condition or `null`.
    fn choice(
        &mut self,
        alternatives: &[Alternative],
        item: &Item,
        node: &Node,
    ) -> Result<(), OutsideSubset> {
        match item {
            Item::Node(inner) => {
                match alternatives.iter().find(|alternative| alternative.opens(inner.kind)) {
                    Some(alternative) => self.alternative(alternative, inner, &mut inner.items.iter()),
                    None => self.condition(inner),
                }
            }
            Item::Members(_) => {
                let is_list =
                    |alternative: &&Alternative| matches!(alternative.parts.as_slice(), [Part::Repeat(_)]);
                let alternative = alternatives.iter().find(is_list).ok_or_else(|| no_production(node))?;
                self.alternative(alternative, node, &mut std::slice::from_ref(item).iter())
            }
            Item::Nothing => {
                let is_empty = |alternative: &&Alternative| {
                    alternative.parts.iter().all(|part| matches!(part, Part::Action(_)))
                };
                let alternative = alternatives.iter().find(is_empty).ok_or_else(|| no_production(node))?;
                self.put(&alternative.literal);
                Ok(())
            }
            _ => Err(no_production(node)),
        }
    }

    fn block(&mut self, steps: &[Node]) -> Result<(), OutsideSubset> {
        self.put(if self.is_json { "[" } else { "{" });
        for (index, step) in steps.iter().enumerate() {
            self.put(match (self.is_json, index) {
                (true, 0) => "{\"",
                (true, _) => ",{\"",
                (false, _) => " ",
            });
            let alternative = self.grammar.steps.iter().find(|alternative| alternative.opens(step.kind));
            let alternative = alternative.ok_or_else(|| no_production(step))?;
            self.alternative(alternative, step, &mut step.items.iter())?;
        }
        self.put(if self.is_json { "]" } else { " }" });
        Ok(())
    }

    fn condition(&mut self, node: &Node) -> Result<(), OutsideSubset> {
        let Some([open, separator, end]) = self.grammar.connective(node.kind) else {
            let mut atoms = self.grammar.atoms.iter();
            let atom = atoms.find(|atom| atom.spelled.opens(node.kind)).ok_or_else(|| no_production(node))?;
            if self.is_json {
                self.put("{\"");
                self.put(atom.sort.lead());
            }
            return self.alternative(&atom.spelled, node, &mut node.items.iter());
        };
        self.put(open);
        for (index, item) in node.items.iter().enumerate() {
            let Item::Node(inner) = item else { return Err(no_production(node)) };
            if index > 0 {
                self.put(separator);
            }
            if !self.is_json && needs_group(node.kind, inner.kind) {
                self.put("(");
                self.condition(inner)?;
                self.put(")");
            } else {
                self.condition(inner)?;
            }
        }
        self.put(end);
        Ok(())
    }

    fn value(&mut self, value: &Value) {
        match value {
            Value::Binding(name) if self.is_json => self.put(&format!("\"${name}\"")),
            Value::Binding(name) => self.put(name),
            Value::Name(name) => self.put(&self.word(name)),
            Value::Number(number, unit) => self.number(*number, *unit),
            // The subset has no text that needs an escape.
            Value::Text(text) => self.put(&quoted(text)),
            Value::Bool(value) => self.put(if *value { "true" } else { "false" }),
            Value::First(list) if self.is_json => {
                self.put(&format!("{{\"get\":\"first\",\"of\":\"${list}\"}}"));
            }
            Value::First(list) => self.put(&format!("first({list})")),
            Value::Pose(numbers) => {
                self.put(if self.is_json { "{\"pose\":[" } else { "pose(" });
                for (index, (number, range)) in numbers.iter().zip(NumberRange::of_pose()).enumerate() {
                    self.put(if index > 0 { self.separator() } else { "" });
                    self.number(*number, range.unit);
                }
                self.put(if self.is_json { "]}" } else { ")" });
            }
            Value::Any => self.put(self.any()),
            Value::List(items) => {
                self.put("[");
                for (index, item) in items.iter().enumerate() {
                    if index > 0 {
                        self.put(self.separator());
                    }
                    self.value(item);
                }
                self.put("]");
            }
        }
    }

    fn number(&mut self, number: Decimal, unit: Option<Unit>) {
        match unit.filter(|_| !self.is_json) {
            None => self.put(&number.to_string()),
            Some(Unit::Percent) => self.put(&format!("{} %", number.percent())),
            Some(unit) => self.put(&format!("{number} {}", unit.symbol())),
        }
    }

    /// Writes a word, in text with the space behind it.
    fn spaced(&mut self, word: &str) {
        self.put(word);
        self.put(if self.is_json { "" } else { " " });
    }

    fn word(&self, name: &str) -> String {
        if self.is_json { quoted(name) } else { identifier(name) }
    }

    fn any(&self) -> &'static str {
        if self.is_json { "\"any\"" } else { "any" }
    }

    fn separator(&self) -> &'static str {
        if self.is_json { "," } else { ", " }
    }
}

/// A condition needs parentheses inside another one of the text syntax.
fn needs_group(outer: NodeKind, inner: NodeKind) -> bool {
    match outer {
        NodeKind::Not => !matches!(inner, NodeKind::Is(_) | NodeKind::IsEmpty | NodeKind::Not),
        _ => matches!(inner, NodeKind::All | NodeKind::Any),
    }
}

/// A string in JSON, which every string has.
fn quoted(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default()
}
