//! Random derivations of a grammar.

use motet_decode::export::{EbnfExpr as Expr, EbnfGrammar as Grammar, RuleId};

/// A generator of pseudo-random numbers: SplitMix64 (Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next number.
    pub fn draw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// A number below another.
    pub fn below(&mut self, limit: usize) -> usize {
        usize::try_from(self.draw() % u64::try_from(limit.max(1)).unwrap_or(1)).unwrap_or(0)
    }
}

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
    pub fn derive(&self, random: &mut Random) -> String {
        let mut out = String::new();
        self.expr(&Expr::Rule(RuleId(0)), random, &mut out);
        out
    }

    fn expr(&self, expr: &Expr, random: &mut Random, out: &mut String) {
        let is_short = out.len() < self.budget;
        match expr {
            Expr::Literal(text) => out.push_str(text),
            Expr::Class(ranges) => {
                if let Some((from, to)) = ranges.get(random.below(ranges.len())) {
                    let width = (u32::from(*to) - u32::from(*from) + 1) as usize;
                    let step = u32::try_from(random.below(width)).unwrap_or(0);
                    out.extend(char::from_u32(u32::from(*from) + step));
                }
            }
            Expr::Seq(parts) => parts.iter().for_each(|part| self.expr(part, random, out)),
            Expr::Choice(parts) => {
                let chosen = if is_short {
                    parts.get(random.below(parts.len()))
                } else {
                    parts.iter().min_by_key(|part| self.least(part))
                };
                if let Some(part) = chosen {
                    self.expr(part, random, out);
                }
            }
            Expr::Repeat(inner, least, greatest) => {
                let free = (*greatest - *least).min(6) as usize;
                let more = if is_short { random.below(free + 1) } else { 0 };
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
