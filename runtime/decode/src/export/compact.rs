//! Shapes of JSON as a grammar of their one spelling without white space.

use super::class;
use super::grammar::{Expr, Grammar, RuleId};
use super::number;
use super::shape::{Shape, Shapes};

/// The grammar of shapes.
pub(super) fn grammar(shapes: &Shapes) -> Grammar {
    let mut builder = Builder { grammar: Grammar::default(), rules: Vec::new(), numbers: Vec::new() };
    // The root stands first, and is known last.
    let root = builder.grammar.add("root", Expr::Seq(Vec::new()), false);
    for (index, (name, shape)) in shapes.defs.iter().enumerate() {
        let body = builder.expr(shape);
        if index + 1 == shapes.defs.len() {
            if let Some(rule) = builder.grammar.rules.get_mut(root.0) {
                rule.body = body;
            }
        } else {
            let is_token = matches!(shape, Shape::Name | Shape::Binding | Shape::Text);
            let rule = builder.grammar.add(name, body, is_token);
            builder.rules.push(rule);
        }
    }
    builder.grammar
}

struct Builder {
    grammar: Grammar,
    /// The rule of each definition.
    rules: Vec<RuleId>,
    /// The numbers that have a rule.
    numbers: Vec<(crate::subset::NumberRange, RuleId)>,
}

impl Builder {
    fn expr(&mut self, shape: &Shape) -> Expr {
        match shape {
            Shape::Ref(def) => self.rules.get(*def).map_or(Expr::Seq(Vec::new()), |rule| Expr::Rule(*rule)),
            Shape::Object(keys) => {
                let mut parts = Vec::with_capacity(keys.len() * 2 + 1);
                for (index, (key, shape)) in keys.iter().enumerate() {
                    let before = if index == 0 { "{" } else { "," };
                    parts.push(Expr::literal(format!("{before}{}:", string(key))));
                    parts.push(self.expr(shape));
                }
                parts.push(Expr::literal("}"));
                Expr::seq(parts)
            }
            Shape::Array(item, least, greatest) => {
                let item = self.expr(item);
                let more = Expr::seq(vec![Expr::literal(","), item.clone()]);
                let (rest, most) = (bound(least.saturating_sub(1)), bound(greatest.saturating_sub(1)));
                let items = Expr::seq(vec![item, more.repeat(rest, most)]);
                let items = if *least == 0 { items.optional() } else { items };
                // Lexers of some engines take the longest literal and do not go back: `[` stays one by itself.
                Expr::Seq(vec![Expr::literal("["), items, Expr::literal("]")])
            }
            Shape::Choice(shapes) => Expr::choice(shapes.iter().map(|shape| self.expr(shape)).collect()),
            Shape::Loose(_, exact) => self.expr(exact),
            Shape::WordList(words) => {
                Expr::choice(words.iter().map(|word| Expr::literal(string(word))).collect())
            }
            Shape::Name => quoted("\"", class::name()),
            Shape::Binding => quoted("\"$", class::name()),
            Shape::Text => quoted("\"", class::text()),
            Shape::Number(range) => {
                if let Some((_, rule)) = self.numbers.iter().find(|(known, _)| known == range) {
                    return Expr::Rule(*rule);
                }
                let rule = self.grammar.add("number", number::expr(range), true);
                self.numbers.push((*range, rule));
                Expr::Rule(rule)
            }
            Shape::Bool => Expr::choice(vec![Expr::literal("true"), Expr::literal("false")]),
            Shape::Version => Expr::literal("1"),
            Shape::Null => Expr::literal("null"),
        }
    }
}

fn quoted(open: &str, inner: Expr) -> Expr {
    Expr::seq(vec![Expr::literal(open), inner, Expr::literal("\"")])
}

/// A string of JSON.
fn string(text: &str) -> String {
    // A string always has a JSON form.
    serde_json::to_string(text).unwrap_or_default()
}

fn bound(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}
