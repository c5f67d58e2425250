//! Made policies and steps.

use super::{DEPTH, Flavor, TreeGenerator};
use crate::ast::{Block, Catch, CatchOn, Do, End, EndKind, Policy, Reaction, Step, StepKind, When};

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
            robot: self.maybe(|it| it.choice.name()),
            achieves: self.maybe(|it| it.condition(2)),
            body: self.block(DEPTH),
            span: self.span(),
        }
    }

    fn block(&mut self, depth: usize) -> Block {
        let outer = self.scope.len();
        let steps = self.some(0, |it| it.step(depth));
        self.scope.truncate(outer);
        Block { steps, span: self.span() }
    }

    fn step(&mut self, depth: usize) -> Step {
        let kind = if depth == 0 { self.leaf() } else { self.inner(depth - 1) };
        Step { kind, span: self.span() }
    }

    fn leaf(&mut self) -> StepKind {
        match self.choice.below(4) {
            0 => StepKind::End(self.end()),
            1 => {
                let condition = self.condition(3);
                StepKind::Wait { condition, within: self.maybe(Self::duration) }
            }
            _ => {
                let call = self.call(2);
                let within = self.maybe(Self::duration);
                let retry = self.maybe(Self::count);
                let bind = self.maybe(|it| it.choice.bound());
                self.scope.extend(bind.as_ref().map(|bind| bind.text.clone()));
                StepKind::Do(Do { call, bind, within, retry })
            }
        }
    }

    fn inner(&mut self, depth: usize) -> StepKind {
        match self.choice.below(9) {
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
                let (list, at_most) = (self.term(2), self.count());
                let item = self.choice.bound();
                self.scope.push(item.text.clone());
                let body = self.block(depth);
                self.scope.pop();
                StepKind::Each { item, list, at_most, body }
            }
            6 => StepKind::Parallel { branches: self.some(1, |it| it.block(depth)) },
            _ => self.leaf(),
        }
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
        Catch { on, body: self.block(depth), span: self.span() }
    }

    fn end(&mut self) -> End {
        let kind = self.choice.of(&[EndKind::Done, EndKind::Fail, EndKind::Replan], EndKind::Done);
        let why = match kind {
            EndKind::Done => None,
            EndKind::Fail | EndKind::Replan => self.maybe(|it| it.term(1)),
        };
        End { kind, why, span: self.span() }
    }
}
