//! Pairs to the clauses of a contract.

use super::builder::{Builder, Children};
use super::{Pair, Rule};
use crate::ast::{Clause, Quantified};

impl Builder {
    pub(super) fn clause(&mut self, pair: Pair<'_>) -> Option<Clause> {
        let rule = pair.as_rule();
        let mut parts = Children::of(pair);
        Some(match rule {
            Rule::needs => Clause::Needs(self.entries(parts)),
            Rule::makes => Clause::Makes(self.entries(parts)),
            Rule::unsettles => Clause::Unsettles(self.entries(parts)),
            Rule::motion => Clause::Motion(self.call(parts.next()?, 1)?),
            Rule::uses => Clause::Uses(self.names(parts.next()?)),
            Rule::takes => {
                Clause::Takes { least: self.expr(parts.next()?, 1), greatest: self.expr(parts.next()?, 1) }
            }
            Rule::fails => Clause::Fails(self.names(parts.next()?)),
            Rule::lasts => Clause::Lasts(self.names(parts.next()?)),
            _ => return None,
        })
    }

    fn entries(&mut self, parts: Children<'_>) -> Vec<Quantified> {
        parts.filter_map(|entry| self.quantified(entry)).collect()
    }

    fn quantified(&mut self, pair: Pair<'_>) -> Option<Quantified> {
        let mut parts = Children::of(pair);
        let expr = self.expr(parts.next()?, 1);
        let each = match parts.next_of(Rule::for_each) {
            Some(pair) => {
                let mut parts = Children::of(pair);
                Some((self.name(parts.next()?), self.type_name(parts.next()?)?))
            }
            None => None,
        };
        let when = self.expr_in(parts.next_of(Rule::given), 1);
        Some(Quantified { expr, each, when })
    }
}
