//! Pairs to declarations and the clauses of contracts. Steps are in [`super::step`], expressions in
//! [`super::expr`].

use std::iter::Peekable;

use smol_str::SmolStr;

use super::{Origin, Pair, Rule};
use crate::ast::{
    Clause, EntitiesDecl, EnumDecl, FailureDecl, File, FluentDecl, InitiallyDecl, Item, KindDecl,
    MeasureDecl, Name, Param, Policy, PrimitiveDecl, PrimitiveKind, Quantified, TypeExpr,
};
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};

/// Builder of the tree of one file. Mistakes that the grammar cannot see collect in `found`.
pub(super) struct Builder {
    /// Position of the text in its document.
    pub(super) origin: Origin,
    pub(super) found: Vec<Diagnostic>,
    /// Steps so far.
    pub(super) steps: usize,
    /// Offsets of steps that could not be read, ascending.
    pub(super) gaps: Vec<usize>,
}

/// Children of a pair without marks and most keywords.
pub(super) struct Children<'s>(Peekable<pest::iterators::Pairs<'s, Rule>>);

impl<'s> Children<'s> {
    pub(super) fn of(pair: Pair<'s>) -> Self {
        Self(pair.into_inner().peekable())
    }

    /// The next part, if it is of this rule.
    pub(super) fn next_of(&mut self, rule: Rule) -> Option<Pair<'s>> {
        self.skip_marks();
        self.0.next_if(|pair| pair.as_rule() == rule)
    }

    fn skip_marks(&mut self) {
        while self.0.next_if(|pair| is_mark(pair.as_rule())).is_some() {}
    }
}

impl<'s> Iterator for Children<'s> {
    type Item = Pair<'s>;

    fn next(&mut self) -> Option<Pair<'s>> {
        self.skip_marks();
        self.0.next()
    }
}

/// Checks for a token that only separates: its meaning is in its parent's rule.
fn is_mark(rule: Rule) -> bool {
    matches!(
        rule,
        Rule::lbrace
            | Rule::rbrace
            | Rule::lparen
            | Rule::rparen
            | Rule::lbracket
            | Rule::rbracket
            | Rule::comma
            | Rule::colon
            | Rule::arrow
            | Rule::assign
            | Rule::dots
            | Rule::dot
            | Rule::kw_kind
            | Rule::kw_fluent
            | Rule::kw_measure
            | Rule::kw_failure
            | Rule::kw_enum
            | Rule::kw_entity
            | Rule::kw_initially
            | Rule::kw_closed
            | Rule::kw_world
            | Rule::kw_action
            | Rule::kw_perception
            | Rule::kw_policy
            | Rule::kw_list
            | Rule::kw_needs
            | Rule::kw_makes
            | Rule::kw_unsettles
            | Rule::kw_motion
            | Rule::kw_uses
            | Rule::kw_takes
            | Rule::kw_fails
            | Rule::kw_lasts
            | Rule::kw_for
            | Rule::kw_achieves
            | Rule::kw_keep
            | Rule::kw_out
            | Rule::kw_of
            | Rule::kw_let
            | Rule::kw_within
            | Rule::kw_retry
            | Rule::kw_slowly
            | Rule::kw_gently
            | Rule::kw_sequence
            | Rule::kw_if
            | Rule::kw_else
            | Rule::kw_wait
            | Rule::kw_until
            | Rule::kw_monitor
            | Rule::kw_when
            | Rule::kw_then
            | Rule::kw_during
            | Rule::kw_pause
            | Rule::kw_restart
            | Rule::kw_resume
            | Rule::kw_at
            | Rule::kw_most
            | Rule::kw_try
            | Rule::kw_catch
            | Rule::kw_as
            | Rule::kw_finally
            | Rule::kw_repeat
            | Rule::kw_each
            | Rule::kw_in
            | Rule::kw_parallel
            | Rule::EOI
    )
}

impl Builder {
    pub(super) fn new(file: FileId) -> Self {
        Self { origin: Origin::At(file, 0), found: Vec::new(), steps: 0, gaps: Vec::new() }
    }

    /// Steps without a policy around them, as a policy.
    pub(super) fn bare_steps(&mut self, pair: Pair<'_>) -> Policy {
        let span = self.span(&pair);
        Policy {
            result: None,
            doc: SmolStr::default(),
            name: Name { text: SmolStr::new_static(super::UNNAMED), span: Span { end: span.start, ..span } },
            params: Vec::new(),
            robot: None,
            achieves: None,
            keeps: Vec::new(),
            body: self.block(pair, 0),
            cleanup: None,
            span,
        }
    }

    /// The declarations of a `file` pair.
    pub(super) fn items(&mut self, file: Pair<'_>) -> File {
        let items = Children::of(file).filter_map(|pair| self.item(pair)).collect();
        File { items }
    }

    fn item(&mut self, item: Pair<'_>) -> Option<Item> {
        let mut parts = Children::of(item);
        let mut lines: Vec<&str> = Vec::new();
        while let Some(line) = parts.next_of(Rule::doc) {
            let line = line.as_str().trim_start_matches("///");
            lines.push(line.strip_prefix(' ').unwrap_or(line).trim_end());
        }
        let doc = SmolStr::from(lines.join("\n"));
        let pair = parts.next()?;
        let span = self.span(&pair);
        let rule = pair.as_rule();
        let mut parts = Children::of(pair);
        Some(match rule {
            Rule::kind => Item::Kind(KindDecl {
                doc,
                name: self.name(parts.next()?),
                parent: parts.next_of(Rule::name).map(|name| self.name(name)),
                fields: parts.next_of(Rule::fields).map(|fields| self.params(fields)).unwrap_or_default(),
                span,
            }),
            Rule::fluent => Item::Fluent(FluentDecl {
                doc,
                name: self.name(parts.next()?),
                params: self.params(parts.next()?),
                span,
            }),
            Rule::measure => Item::Measure(MeasureDecl {
                doc,
                name: self.name(parts.next()?),
                params: self.params(parts.next()?),
                result: self.type_name(parts.next()?)?,
                span,
            }),
            Rule::failure => Item::Failure(FailureDecl { doc, name: self.name(parts.next()?), span }),
            Rule::enumeration => Item::Enum(EnumDecl {
                doc,
                name: self.name(parts.next()?),
                cases: self.names(parts.next()?),
                span,
            }),
            Rule::entities => Item::Entities(EntitiesDecl {
                doc,
                names: self.names(parts.next()?),
                kind: self.name(parts.next()?),
                span,
            }),
            Rule::initially => {
                Item::Initially(InitiallyDecl { facts: parts.map(|fact| self.expr(fact, 1)).collect(), span })
            }
            Rule::closed_world => Item::ClosedWorld(span),
            Rule::action => Item::Primitive(self.primitive(doc, PrimitiveKind::Action, parts, span)?),
            Rule::perception => {
                Item::Primitive(self.primitive(doc, PrimitiveKind::Perception, parts, span)?)
            }
            Rule::policy => Item::Policy(self.policy(doc, parts, span)?),
            _ => return None,
        })
    }

    fn primitive(
        &mut self,
        doc: SmolStr,
        kind: PrimitiveKind,
        mut parts: Children<'_>,
        span: Span,
    ) -> Option<PrimitiveDecl> {
        let name = self.name(parts.next()?);
        let params = self.params(parts.next()?);
        let result = match parts.next_of(Rule::result) {
            Some(result) => self.type_name(Children::of(result).next()?),
            None => None,
        };
        let clauses = parts.filter_map(|clause| self.clause(clause)).collect();
        Some(PrimitiveDecl { doc, kind, name, params, result, clauses, span })
    }

    fn policy(&mut self, doc: SmolStr, mut parts: Children<'_>, span: Span) -> Option<Policy> {
        let name = self.name(parts.next()?);
        let params = parts.next_of(Rule::params).map(|params| self.params(params)).unwrap_or_default();
        let result = match parts.next_of(Rule::result) {
            Some(result) => self.type_name(Children::of(result).next()?),
            None => None,
        };
        let robot = parts
            .next_of(Rule::for_robot)
            .and_then(|pair| Children::of(pair).next())
            .map(|name| self.name(name));
        let achieves = self.expr_in(parts.next_of(Rule::achieves), 1);
        let keeps = parts.next_of(Rule::keeps).map(|keeps| self.keeps(keeps, 1)).unwrap_or_default();
        let body = self.block(parts.next()?, 1);
        let cleanup = parts.next_of(Rule::finally).and_then(|pair| self.finally(pair, 1));
        Some(Policy { doc, name, params, result, robot, achieves, keeps, body, cleanup, span })
    }

    /// The parameters or fields between brackets.
    fn params(&mut self, pair: Pair<'_>) -> Vec<Param> {
        Children::of(pair).filter_map(|param| self.param(param)).collect()
    }

    fn param(&mut self, pair: Pair<'_>) -> Option<Param> {
        let mut parts = Children::of(pair);
        Some(Param {
            name: self.name(parts.next()?),
            ty: self.type_name(parts.next()?)?,
            default: parts.next().map(|value| self.expr(value, 1)),
        })
    }

    /// A type; at most as deep as brackets may nest.
    pub(super) fn type_name(&self, pair: Pair<'_>) -> Option<TypeExpr> {
        let inner = Children::of(pair).next()?;
        if inner.as_rule() == Rule::name {
            return Some(TypeExpr::Named(self.name(inner)));
        }
        let span = self.span(&inner);
        let element = Children::of(inner).find(|part| part.as_rule() == Rule::type_name)?;
        Some(TypeExpr::List(Box::new(self.type_name(element)?), span))
    }

    /// Names between commas, in brackets or not.
    pub(super) fn names(&self, pair: Pair<'_>) -> Vec<Name> {
        Children::of(pair).map(|name| self.name(name)).collect()
    }

    pub(super) fn name(&self, pair: Pair<'_>) -> Name {
        Name { text: self.name_text(&pair), span: self.span(&pair) }
    }

    pub(super) fn name_text(&self, pair: &Pair<'_>) -> SmolStr {
        SmolStr::new(pair.as_str().trim_matches('`'))
    }

    /// From the first token to the last: what a rule takes of the space behind it is left out.
    pub(super) fn span(&self, pair: &Pair<'_>) -> Span {
        let mut last = pair.clone();
        // A text ends with a quote that is no token of its own.
        while last.as_rule() != Rule::text {
            let Some(inner) = last.clone().into_inner().next_back() else { break };
            last = inner;
        }
        self.origin.place(pair.as_span().start(), last.as_span().end())
    }
}

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
