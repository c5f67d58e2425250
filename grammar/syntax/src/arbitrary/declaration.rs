//! Generators of declarations.

use smol_str::SmolStr;

use super::TreeGenerator;
use crate::ast::{
    Clause, EntitiesDecl, EnumDecl, FailureDecl, File, FluentDecl, InitiallyDecl, Item, KindDecl,
    MeasureDecl, Param, PrimitiveDecl, PrimitiveKind, Quantified, TypeExpr,
};

impl TreeGenerator<'_> {
    pub(super) fn file(&mut self) -> File {
        File { items: self.some(1, Self::item) }
    }

    fn item(&mut self) -> Item {
        self.scope.clear();
        let span = self.span();
        match self.choice.below(12) {
            0 => Item::ClosedWorld(span),
            1 => Item::Kind(KindDecl {
                doc: self.doc(),
                name: self.choice.name(),
                parent: self.maybe(|it| it.choice.name()),
                fields: self.some(0, |it| Param {
                    name: it.choice.word(),
                    ty: it.type_expr(2),
                    default: None,
                }),
                span,
            }),
            2 => Item::Fluent(FluentDecl {
                doc: self.doc(),
                name: self.choice.name(),
                params: self.params(),
                span,
            }),
            3 => Item::Measure(MeasureDecl {
                doc: self.doc(),
                name: self.choice.name(),
                params: self.params(),
                result: self.type_expr(2),
                span,
            }),
            4 => Item::Failure(FailureDecl { doc: self.doc(), name: self.choice.name(), span }),
            5 => Item::Enum(EnumDecl {
                doc: self.doc(),
                name: self.choice.name(),
                cases: self.some(1, |it| it.choice.name()),
                span,
            }),
            6 => Item::Entities(EntitiesDecl {
                doc: self.doc(),
                names: self.some(1, |it| it.choice.name()),
                kind: self.choice.name(),
                span,
            }),
            7 => Item::Initially(InitiallyDecl { facts: self.some(1, |it| it.condition(2)), span }),
            8 | 9 => Item::Primitive(self.primitive()),
            _ => Item::Policy(self.policy()),
        }
    }

    /// Documentation of no, one or several lines.
    pub(super) fn doc(&mut self) -> SmolStr {
        const LINES: &[&str] = &["", "Says what it is.", "  indented `code`", "/ slash", "é"];
        let lines: Vec<&str> = self.some(0, |it| it.choice.of(LINES, ""));
        SmolStr::from(lines.join("\n"))
    }

    pub(super) fn params(&mut self) -> Vec<Param> {
        self.some(0, |it| Param {
            name: it.choice.bound(),
            ty: it.type_expr(2),
            default: it.maybe(|it| it.term(1)),
        })
    }

    fn type_expr(&mut self, depth: usize) -> TypeExpr {
        if depth > 0 && self.choice.is_heads() {
            TypeExpr::List(Box::new(self.type_expr(depth - 1)), self.span())
        } else {
            TypeExpr::Named(self.choice.name())
        }
    }

    fn primitive(&mut self) -> PrimitiveDecl {
        let is_action = self.choice.is_heads();
        PrimitiveDecl {
            doc: self.doc(),
            kind: if is_action { PrimitiveKind::Action } else { PrimitiveKind::Perception },
            name: self.choice.name(),
            params: self.params(),
            result: self.maybe(|it| it.type_expr(1)),
            clauses: self.some(0, Self::clause),
            span: self.span(),
        }
    }

    fn clause(&mut self) -> Clause {
        match self.choice.below(8) {
            0 => Clause::Uses(self.some(1, |it| it.choice.name())),
            1 => Clause::Needs(self.some(1, Self::quantified)),
            2 => Clause::Makes(self.some(1, Self::quantified)),
            3 => Clause::Unsettles(self.some(1, Self::quantified)),
            4 => Clause::Motion(self.call(1)),
            5 => Clause::Takes { least: self.term(1), greatest: self.term(1) },
            6 => Clause::Fails(self.some(1, |it| it.choice.name())),
            _ => Clause::Lasts(self.some(1, |it| it.choice.name())),
        }
    }

    fn quantified(&mut self) -> Quantified {
        Quantified {
            expr: self.condition(3),
            each: self.maybe(|it| (it.choice.name(), it.type_expr(1))),
            when: self.maybe(|it| it.condition(2)),
        }
    }
}
