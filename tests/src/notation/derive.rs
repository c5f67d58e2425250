//! Random derivations of a grammar.

use motet_decode::export::{EbnfExpr as Expr, EbnfGrammar as Grammar, RuleId};
use rand::RngExt as _;
use rand_xoshiro::SplitMix64;

/// Derives texts of a grammar, longer ones rarely: above the budget it takes the shortest way.
#[derive(Debug)]
pub struct Deriver<'g> {
    grammar: &'g Grammar,
    /// The least bytes of each rule.
    least: Vec<usize>,
    budget: usize,
}

impl<'g> Deriver<'g> {
    /// Derives texts of about so many bytes at most.
    #[must_use]
    pub fn new(grammar: &'g Grammar, budget: usize) -> Self {
        let mut deriver = Self { grammar, least: vec![usize::MAX; grammar.rules.len()], budget };
        // No rule leads back to itself, so as many rounds as rules are enough; most need few.
        loop {
            let least: Vec<usize> = grammar.rules.iter().map(|rule| deriver.least(&rule.body)).collect();
            if least == deriver.least {
                return deriver;
            }
            deriver.least = least;
        }
    }

    fn least(&self, expr: &Expr) -> usize {
        match expr {
            Expr::Literal(text) => text.len(),
            Expr::Class(_) => 1,
            Expr::Seq(parts) => parts.iter().fold(0, |sum, part| sum.saturating_add(self.least(part))),
            Expr::Choice(parts) => parts.iter().map(|part| self.least(part)).min().unwrap_or(0),
            Expr::Repeat(inner, least, _) => self.least(inner).saturating_mul(*least as usize),
            Expr::Rule(id) => self.least.get(id.0).copied().unwrap_or(usize::MAX),
        }
    }

    /// One text.
    #[must_use]
    pub fn derive(&self, random: &mut SplitMix64) -> String {
        let mut out = String::new();
        self.expr(&Expr::Rule(RuleId(0)), random, &mut out);
        out
    }

    fn expr(&self, expr: &Expr, random: &mut SplitMix64, out: &mut String) {
        let is_short = out.len() < self.budget;
        match expr {
            Expr::Literal(text) => out.push_str(text),
            Expr::Class(ranges) => {
                if let Some((from, to)) = ranges.get(random.random_range(0..ranges.len())) {
                    let width = (u32::from(*to) - u32::from(*from) + 1) as usize;
                    let step = u32::try_from(random.random_range(0..width)).unwrap_or(0);
                    out.extend(char::from_u32(u32::from(*from) + step));
                }
            }
            Expr::Seq(parts) => parts.iter().for_each(|part| self.expr(part, random, out)),
            Expr::Choice(parts) => {
                let chosen = if is_short {
                    parts.get(random.random_range(0..parts.len()))
                } else {
                    parts.iter().min_by_key(|part| self.least(part))
                };
                if let Some(part) = chosen {
                    self.expr(part, random, out);
                }
            }
            Expr::Repeat(inner, least, greatest) => {
                let free = (*greatest - *least).min(6) as usize;
                let more = if is_short { random.random_range(0..free + 1) } else { 0 };
                for _ in 0..*least as usize + more {
                    self.expr(inner, random, out);
                }
            }
            Expr::Rule(id) => {
                if let Some(rule) = self.grammar.rule(*id) {
                    self.expr(&rule.body, random, out);
                }
            }
        }
    }
}
