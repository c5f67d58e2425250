//! Pairs to steps. `depth` is how many blocks a step is in, counted as braces: a branch of `parallel` and the
//! block of a `resume` are in two.

use super::builder::{Builder, Children};
use super::{Pair, Rule};
use crate::ast::{
    Block, Catch, CatchOn, Do, End, EndKind, Expr, ExprKind, Keep, KeepKind, MAX_NESTING, MAX_STEPS, Manner,
    Reaction, Step, StepKind, When,
};
use crate::diagnostics::{TextSyntax, TooDeep, TooManySteps};
use crate::source::Span;

impl Builder {
    pub(super) fn block(&mut self, pair: Pair<'_>, depth: usize) -> Block {
        let span = self.span(&pair);
        let mut steps: Vec<Step> = Vec::new();
        let mut is_whole = false;
        for part in Children::of(pair) {
            if part.as_rule() != Rule::finally {
                let step = self.step(part, depth);
                is_whole = step.is_some();
                steps.extend(step);
                continue;
            }
            let cleanup = self.finally(part, depth + 1);
            let of = if is_whole { steps.pop() } else { None };
            steps.extend(of.zip(cleanup).map(|(of, cleanup)| {
                let span = Span { end: cleanup.span.end, ..of.span };
                Step { kind: StepKind::Finally { step: Box::new(of), cleanup }, span }
            }));
        }
        let gaps = self.gaps_in(span, &steps);
        Block { steps, gaps, span }
    }

    /// Positions among the steps of a block at which others could not be read.
    fn gaps_in(&self, block: Span, steps: &[Step]) -> Vec<u32> {
        let is_here = |gap: &&usize| {
            let contains = |span: Span| span.range().contains(*gap);
            contains(block) && !steps.iter().any(|step| contains(step.span))
        };
        let before = |gap: &usize| steps.iter().filter(|step| step.span.range().end <= *gap).count();
        let gaps = self.gaps.iter().filter(is_here).enumerate();
        gaps.filter_map(|(earlier, gap)| u32::try_from(earlier + before(gap)).ok()).collect()
    }

    /// The block of a `finally`.
    pub(super) fn finally(&mut self, pair: Pair<'_>, depth: usize) -> Option<Block> {
        Children::of(pair).next().map(|block| self.block(block, depth))
    }

    fn step(&mut self, pair: Pair<'_>, depth: usize) -> Option<Step> {
        let span = self.span(&pair);
        self.steps += 1;
        if self.steps > MAX_STEPS {
            if self.steps == MAX_STEPS + 1 {
                self.found.push(TooManySteps { span }.into());
            }
            return None;
        }
        let rule = pair.as_rule();
        let mut parts = Children::of(pair);
        let kind = match rule {
            Rule::do_step => self.do_step(parts, depth)?,
            Rule::let_step => self.let_step(parts, depth)?,
            Rule::sequence => StepKind::Sequence {
                name: self.name(parts.next()?),
                body: self.block(parts.next()?, depth + 1),
            },
            Rule::if_else => self.if_else(parts, depth, span)?,
            Rule::wait => match parts.next_of(Rule::delay) {
                Some(time) => StepKind::Delay { time: self.expr_in(Some(time), depth)? },
                None => StepKind::Wait {
                    condition: self.expr(parts.next()?, depth),
                    within: self.expr_in(parts.next_of(Rule::within), depth),
                },
            },
            Rule::monitor => {
                let mut whens = Vec::with_capacity(2);
                while let Some(when) = parts.next_of(Rule::when) {
                    whens.extend(self.when(when, depth));
                }
                StepKind::Monitor { whens, body: self.block(parts.next()?, depth + 1) }
            }
            Rule::try_catch => {
                let body = self.block(parts.next()?, depth + 1);
                let catches = parts.filter_map(|catch| self.catch(catch, depth)).collect();
                StepKind::Try { body, catches }
            }
            Rule::repeat => StepKind::Repeat {
                times: self.expr(parts.next()?, depth),
                body: self.block(parts.next()?, depth + 1),
                until: self.expr_in(parts.next_of(Rule::until), depth),
            },
            Rule::each => StepKind::Each {
                item: self.name(parts.next()?),
                list: self.expr(parts.next()?, depth),
                at_most: self.expr_in(parts.next_of(Rule::at_most), depth)?,
                body: self.block(parts.next()?, depth + 1),
            },
            Rule::parallel => {
                StepKind::Parallel { branches: parts.map(|branch| self.block(branch, depth + 2)).collect() }
            }
            Rule::timed => StepKind::Within {
                time: self.expr(parts.next()?, depth),
                body: self.block(parts.next()?, depth + 1),
            },
            Rule::keep => StepKind::Keep {
                keeps: parts.next_of(Rule::keeps).map(|keeps| self.keeps(keeps, depth))?,
                body: self.block(parts.next()?, depth + 1),
            },
            Rule::end => StepKind::End(self.end(parts, span, depth)?),
            _ => return None,
        };
        Some(Step { kind, span })
    }

    /// The rules of a `keep`.
    pub(super) fn keeps(&mut self, pair: Pair<'_>, depth: usize) -> Vec<Keep> {
        Children::of(pair).filter_map(|kept| self.kept(kept, depth)).collect()
    }

    fn kept(&mut self, pair: Pair<'_>, depth: usize) -> Option<Keep> {
        let span = self.span(&pair);
        let mut parts = Children::of(pair);
        let is_distance = parts.next_of(Rule::kw_distance).is_some();
        let first = self.expr(parts.next()?, depth);
        let kind = if is_distance {
            let at_least = parts.find(|part| part.as_rule() == Rule::expr)?;
            KeepKind::Distance { to: first, at_least: self.expr(at_least, depth) }
        } else {
            KeepKind::OutOf(first)
        };
        Some(Keep { kind, span })
    }

    fn do_step(&mut self, mut parts: Children<'_>, depth: usize) -> Option<StepKind> {
        let call = self.call(parts.next()?, depth)?;
        let step = Do { call, bind: None, manner: None, within: None, retry: None };
        Some(StepKind::Do(self.modified(step, parts, depth)))
    }

    /// A name for a value, or for the result of a call.
    fn let_step(&mut self, mut parts: Children<'_>, depth: usize) -> Option<StepKind> {
        let name = self.name(parts.next()?);
        let value = self.expr(parts.next()?, depth);
        if let ExprKind::Call(call) = value.kind {
            let step = Do { call, bind: Some(name), manner: None, within: None, retry: None };
            return Some(StepKind::Do(self.modified(step, parts, depth)));
        }
        if let Some(part) = parts.next() {
            let message = "a value takes neither `within` nor `retry`, and does not move".into();
            let help = "only a call of a primitive takes time, and can fail";
            self.found.push(TextSyntax::new(self.span(&part), message, help).into());
        }
        Some(StepKind::Let { name, value })
    }

    /// A call with its manner, its deadline and its retries.
    fn modified(&mut self, mut step: Do, parts: Children<'_>, depth: usize) -> Do {
        for part in parts {
            match part.as_rule() {
                Rule::manner => step.manner = self.manner(part, depth),
                Rule::within => step.within = self.expr_in(Some(part), depth),
                _ => step.retry = self.expr_in(Some(part), depth),
            }
        }
        step
    }

    fn manner(&mut self, pair: Pair<'_>, depth: usize) -> Option<Manner> {
        let part = Children::of(pair.clone()).next();
        match part {
            Some(ratio) => Some(Manner::At(self.expr(ratio, depth), self.span(&pair))),
            None if pair.as_str().starts_with("slowly") => Some(Manner::Slowly(self.span(&pair))),
            None => Some(Manner::Gently(self.span(&pair))),
        }
    }

    /// `if a { } else if b { } else { }`: each `else if` is an `if` alone in a block of its own. The braces
    /// of that block are not written; its span is that of the inner `if`.
    fn if_else(&mut self, parts: Children<'_>, depth: usize, whole: Span) -> Option<StepKind> {
        let mut arms: Vec<(Expr, Block, Span)> = Vec::with_capacity(1);
        let mut otherwise = None;
        let mut parts = parts.peekable();
        while let Some(part) = parts.next() {
            let inner = depth + arms.len();
            if inner > MAX_NESTING {
                self.found.push(TooDeep { span: self.span(&part), limit: MAX_NESTING }.into());
                return None;
            }
            if part.as_rule() == Rule::block {
                // Without a condition before it, it is the `else` of the last arm.
                otherwise = Some(self.block(part, inner));
            } else {
                let start = if arms.is_empty() { whole } else { self.span(&part) };
                let condition = self.expr(part, inner);
                arms.push((condition, self.block(parts.next()?, inner + 1), start));
            }
        }
        let (mut condition, mut then, mut start) = arms.pop()?;
        while let Some(outer) = arms.pop() {
            let span = Span { end: whole.end, ..start };
            let steps = vec![Step { kind: StepKind::If { condition, then, otherwise }, span }];
            otherwise = Some(Block::new(steps, span));
            self.steps += 1;
            (condition, then, start) = outer;
        }
        Some(StepKind::If { condition, then, otherwise })
    }

    fn when(&mut self, pair: Pair<'_>, depth: usize) -> Option<When> {
        let span = self.span(&pair);
        let mut parts = Children::of(pair);
        let condition = self.expr(parts.next()?, depth);
        let hold = self.expr_in(parts.next_of(Rule::hold), depth);
        let reaction = self.reaction(parts.next()?, depth)?;
        Some(When { condition, hold, reaction, span })
    }

    fn reaction(&mut self, pair: Pair<'_>, depth: usize) -> Option<Reaction> {
        let span = self.span(&pair);
        let rule = pair.as_rule();
        let mut parts = Children::of(pair);
        Some(match rule {
            Rule::pause => Reaction::Pause { within: self.expr_in(parts.next_of(Rule::within), depth), span },
            Rule::restart => Reaction::Restart { at_most: self.expr_in(parts.next(), depth)?, span },
            Rule::resume => Reaction::Resume {
                at_most: self.expr_in(parts.next(), depth)?,
                body: self.block(parts.next()?, depth + 2),
                span,
            },
            Rule::end => Reaction::End(self.end(parts, span, depth)?),
            _ => return None,
        })
    }

    fn catch(&mut self, pair: Pair<'_>, depth: usize) -> Option<Catch> {
        let span = self.span(&pair);
        let mut parts = Children::of(pair);
        let on = parts.next()?;
        let on = match on.as_rule() {
            Rule::kw_any => CatchOn::Any(self.span(&on)),
            _ => CatchOn::Kinds(self.names(on)),
        };
        let bind = parts.next_of(Rule::caught_as).and_then(|pair| Children::of(pair).next());
        let bind = bind.map(|name| self.name(name));
        Some(Catch { on, bind, body: self.block(parts.next()?, depth + 1), span })
    }

    fn end(&mut self, mut parts: Children<'_>, span: Span, depth: usize) -> Option<End> {
        let kind = match parts.next()?.as_rule() {
            Rule::kw_done => EndKind::Done,
            Rule::kw_fail => EndKind::Fail,
            Rule::kw_cannot => EndKind::Cannot,
            _ => EndKind::Replan,
        };
        let said = self.expr_in(parts.next(), depth);
        let (result, why) = if kind == EndKind::Done { (said, None) } else { (None, said) };
        Some(End { kind, result, why, span })
    }
}
