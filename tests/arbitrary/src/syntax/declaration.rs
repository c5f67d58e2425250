//! Generators of declarations, policies and steps.

use smol_str::SmolStr;

use super::{DEPTH, Flavor, TreeGenerator};
use motet_syntax::ast::{
    Block, Catch, CatchOn, Clause, Do, End, EndKind, EntitiesDecl, EnumDecl, Expr, ExprKind, FailureDecl,
    File, FluentDecl, InitiallyDecl, Item, Keep, KeepKind, KindDecl, Manner, MeasureDecl, Param, Policy,
    PrimitiveDecl, PrimitiveKind, Quantified, Reaction, Step, StepKind, TypeExpr, When,
};
use motet_syntax::unit::Unit;

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

impl TreeGenerator<'_> {
    pub(super) fn policy(&mut self) -> Policy {
        let params = match self.flavor {
            Flavor::Text => self.params(),
            Flavor::Json => Vec::new(),
        };
        self.scope = params.iter().map(|param| param.name.text.clone()).collect();
        Policy {
            doc: if self.flavor == Flavor::Text { self.doc() } else { smol_str::SmolStr::default() },
            name: self.choice.name(),
            params,
            result: self.maybe(|it| it.type_expr(2)),
            robot: self.maybe(|it| it.choice.name()),
            achieves: self.maybe(|it| it.condition(2)),
            keeps: self.maybe(Self::keeps).unwrap_or_default(),
            body: self.block(DEPTH),
            cleanup: self.maybe(|it| it.block(DEPTH - 1)),
            span: self.span(),
        }
    }

    /// A block. Its names may be used behind it, where other ways may have bound them too.
    fn block(&mut self, depth: usize) -> Block {
        let steps = self.some(0, |it| it.step(depth));
        Block::new(steps, self.span())
    }

    fn step(&mut self, depth: usize) -> Step {
        let kind = if depth == 0 { self.leaf() } else { self.inner(depth - 1) };
        Step { kind, span: self.span() }
    }

    fn leaf(&mut self) -> StepKind {
        match self.choice.below(6) {
            0 => StepKind::End(self.end()),
            2 => {
                let mut value = self.untyped(2);
                // A lone call is a step that calls.
                if matches!(value.kind, ExprKind::Call(_)) {
                    value.kind = ExprKind::Bool(true);
                }
                let name = self.choice.bound();
                self.scope.push(name.text.clone());
                StepKind::Let { name, value }
            }
            1 => {
                let condition = self.condition(3);
                StepKind::Wait { condition, within: self.maybe(Self::duration) }
            }
            3 => StepKind::Delay { time: self.time() },
            _ => {
                let call = self.call(2);
                let manner = self.maybe(Self::manner);
                let within = self.maybe(Self::duration);
                let retry = self.maybe(Self::count);
                let bind = self.maybe(|it| it.choice.bound());
                self.scope.extend(bind.as_ref().map(|bind| bind.text.clone()));
                StepKind::Do(Do { call, bind, manner, within, retry })
            }
        }
    }

    fn manner(&mut self) -> Manner {
        match self.choice.below(4) {
            0 => Manner::Slowly(self.span()),
            1 => Manner::Gently(self.span()),
            2 => Manner::At(self.number(), self.span()),
            _ => Manner::At(self.percent(), self.span()),
        }
    }

    /// A step that may have blocks, and with them a cleanup.
    fn inner(&mut self, depth: usize) -> StepKind {
        if self.choice.below(12) == 1 {
            let tried = StepKind::Try { body: self.block(depth), catches: Vec::new() };
            let step = Box::new(Step { kind: tried, span: self.span() });
            return StepKind::Finally { step, cleanup: self.block(depth) };
        }
        let kind = self.protected(depth);
        let has_blocks = match &kind {
            StepKind::Do(_) | StepKind::Let { .. } | StepKind::End(_) => false,
            StepKind::Wait { .. } | StepKind::Delay { .. } => false,
            StepKind::Sequence { .. } | StepKind::If { .. } | StepKind::Monitor { .. } => true,
            StepKind::Try { .. } | StepKind::Repeat { .. } | StepKind::Each { .. } => true,
            StepKind::Parallel { .. } | StepKind::Within { .. } | StepKind::Keep { .. } => true,
            StepKind::Finally { .. } => false,
        };
        if !has_blocks || self.choice.below(4) > 0 {
            return kind;
        }
        let cleanup = self.block(depth);
        StepKind::Finally { step: Box::new(Step { kind, span: self.span() }), cleanup }
    }

    fn protected(&mut self, depth: usize) -> StepKind {
        match self.choice.below(11) {
            0 => StepKind::Sequence { name: self.choice.name(), body: self.block(depth) },
            1 => StepKind::If {
                condition: self.condition(3),
                then: self.block(depth),
                otherwise: self.maybe(|it| it.block(depth)),
            },
            2 => StepKind::Monitor { whens: self.some(1, |it| it.when(depth)), body: self.block(depth) },
            3 => StepKind::Try { body: self.block(depth), catches: self.some(1, |it| it.catch(depth)) },
            4 => StepKind::Repeat {
                times: self.count(),
                body: self.block(depth),
                until: self.maybe(|it| it.condition(3)),
            },
            5 => {
                let (list, at_most) = (self.untyped(2), self.count());
                let item = self.choice.bound();
                self.scope.push(item.text.clone());
                let body = self.block(depth);
                StepKind::Each { item, list, at_most, body }
            }
            6 => StepKind::Parallel { branches: self.some(1, |it| it.block(depth)) },
            7 => StepKind::Within { time: self.duration(), body: self.block(depth) },
            8 => StepKind::Keep { keeps: self.keeps(), body: self.block(depth) },
            _ => self.leaf(),
        }
    }

    fn keeps(&mut self) -> Vec<Keep> {
        self.some(1, |it| {
            let kind = if it.choice.is_heads() {
                KeepKind::OutOf(it.term(1))
            } else {
                let at_least = Expr { kind: ExprKind::Quantity(0.5, Unit::Metre), span: it.span() };
                KeepKind::Distance { to: it.term(1), at_least }
            };
            Keep { kind, span: it.span() }
        })
    }

    fn when(&mut self, depth: usize) -> When {
        When {
            condition: self.condition(2),
            hold: self.maybe(Self::duration),
            reaction: match self.choice.below(4) {
                0 => Reaction::Pause { within: self.maybe(Self::duration), span: self.span() },
                1 => Reaction::Restart { at_most: self.count(), span: self.span() },
                2 => Reaction::Resume { at_most: self.count(), body: self.block(depth), span: self.span() },
                _ => Reaction::End(self.end()),
            },
            span: self.span(),
        }
    }

    fn catch(&mut self, depth: usize) -> Catch {
        let on = match self.choice.below(3) {
            0 => CatchOn::Any(self.span()),
            _ => CatchOn::Kinds(self.some(1, |it| it.choice.name())),
        };
        let bind = self.maybe(|it| it.choice.bound());
        self.scope.extend(bind.as_ref().map(|bind| bind.text.clone()));
        Catch { on, bind, body: self.block(depth), span: self.span() }
    }

    fn end(&mut self) -> End {
        let kind =
            self.choice.of(&[EndKind::Done, EndKind::Fail, EndKind::Cannot, EndKind::Replan], EndKind::Done);
        let said = self.maybe(|it| it.term(1));
        let (result, why) = if kind == EndKind::Done { (said, None) } else { (None, said) };
        End { kind, result, why, span: self.span() }
    }
}
