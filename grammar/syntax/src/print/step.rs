//! Policies' steps in the text syntax.

use super::expr;
use super::writer::{Blank, Writer};
use crate::ast::{
    Block, CatchOn, Do, End, EndKind, Expr, Keep, KeepKind, Manner, Reaction, Step, StepKind, When,
};

/// Length of `monitor` and about that of `parallel`: the brace behind them has no place in the tree.
const KEYWORD: u32 = 7;

impl Writer<'_> {
    /// A block from its opening to its closing brace; the line is left open.
    pub(super) fn block(&mut self, block: &Block) {
        let closing = block.span.end.saturating_sub(1);
        if block.steps.is_empty() && !self.has_comment_before(closing) {
            self.text.push_str("{}");
            return;
        }
        self.open(block.span.start + 1);
        for step in &block.steps {
            self.step(step);
        }
        self.close(closing);
    }

    fn step(&mut self, step: &Step) {
        self.begin(step.span.start, Blank::AsWritten);
        self.inner(step);
        self.end(step.span.end);
    }

    /// The cleanup of a step or a policy.
    pub(super) fn finally(&mut self, cleanup: &Block) {
        self.text.push_str(" finally ");
        self.block(cleanup);
    }

    fn inner(&mut self, step: &Step) {
        match &step.kind {
            StepKind::Do(step) => self.call_step(step),
            StepKind::Let { name, value } => {
                self.text.push_str("let ");
                expr::name(&mut self.text, &name.text);
                self.word_and(" = ", value);
            }
            StepKind::Sequence { name, body } => {
                self.text.push_str("sequence ");
                expr::name(&mut self.text, &name.text);
                self.text.push(' ');
                self.block(body);
            }
            StepKind::If { condition, then, otherwise } => self.if_else(condition, then, otherwise.as_ref()),
            StepKind::Wait { condition, within } => {
                self.word_and("wait until ", condition);
                self.optional(" within ", within.as_ref());
            }
            StepKind::Monitor { whens, body } => {
                self.text.push_str("monitor ");
                match whens.as_slice() {
                    [only] => self.when(only),
                    _ => {
                        self.open(step.span.start + KEYWORD);
                        for when in whens {
                            self.begin(when.span.start, Blank::AsWritten);
                            self.when(when);
                            self.end(when.span.end);
                        }
                        self.close(body.span.start);
                    }
                }
                self.text.push_str(" during ");
                self.block(body);
            }
            StepKind::Try { body, catches } => {
                self.text.push_str("try ");
                self.block(body);
                for catch in catches {
                    self.text.push_str(" catch ");
                    match &catch.on {
                        CatchOn::Any(_) => self.text.push_str("any"),
                        CatchOn::Kinds(kinds) => expr::names(&mut self.text, kinds),
                    }
                    if let Some(bind) = &catch.bind {
                        self.text.push_str(" as ");
                        expr::name(&mut self.text, &bind.text);
                    }
                    self.text.push(' ');
                    self.block(&catch.body);
                }
            }
            StepKind::Repeat { times, body, until } => {
                self.word_and("repeat ", times);
                self.text.push(' ');
                self.block(body);
                self.optional(" until ", until.as_ref());
            }
            StepKind::Each { item, list, at_most, body } => {
                self.text.push_str("each ");
                expr::name(&mut self.text, &item.text);
                self.word_and(" in ", list);
                self.word_and(" at most ", at_most);
                self.text.push(' ');
                self.block(body);
            }
            StepKind::Parallel { branches } => {
                self.text.push_str("parallel ");
                self.open(step.span.start + KEYWORD);
                for branch in branches {
                    self.begin(branch.span.start, Blank::AsWritten);
                    self.block(branch);
                    self.end(branch.span.end);
                }
                self.close(step.span.end.saturating_sub(1));
            }
            StepKind::Keep { keeps, body } => {
                self.keeps(keeps);
                self.text.push(' ');
                self.block(body);
            }
            StepKind::Delay { time } => self.word_and("wait ", time),
            StepKind::Within { time, body } => {
                self.word_and("within ", time);
                self.text.push(' ');
                self.block(body);
            }
            StepKind::Finally { step, cleanup } => {
                self.inner(step);
                self.finally(cleanup);
            }
            StepKind::End(end) => self.ending(end),
        }
    }

    /// The rules of a `keep`, without its block.
    pub(super) fn keeps(&mut self, keeps: &[Keep]) {
        self.text.push_str("keep ");
        for (index, keep) in keeps.iter().enumerate() {
            if index > 0 {
                self.text.push_str(", ");
            }
            match &keep.kind {
                KeepKind::OutOf(zone) => self.word_and("out of ", zone),
                KeepKind::Distance { to, at_least } => {
                    self.word_and("distance(", to);
                    self.word_and(") >= ", at_least);
                }
            }
        }
    }

    fn call_step(&mut self, step: &Do) {
        if let Some(bind) = &step.bind {
            self.text.push_str("let ");
            expr::name(&mut self.text, &bind.text);
            self.text.push_str(" = ");
        }
        expr::call(&mut self.text, &step.call);
        match &step.manner {
            Some(Manner::Slowly(_)) => self.text.push_str(" slowly"),
            Some(Manner::Gently(_)) => self.text.push_str(" gently"),
            Some(Manner::At(ratio, _)) => self.word_and(" at ", ratio),
            None => {}
        }
        self.optional(" within ", step.within.as_ref());
        self.optional(" retry ", step.retry.as_ref());
    }

    /// An `if` alone in the block of an `else` is written behind it.
    fn if_else(&mut self, condition: &Expr, then: &Block, otherwise: Option<&Block>) {
        self.word_and("if ", condition);
        self.text.push(' ');
        self.block(then);
        let Some(otherwise) = otherwise else { return };
        self.text.push_str(" else ");
        match otherwise.steps.as_slice() {
            [Step { kind: StepKind::If { condition, then, otherwise }, .. }] => {
                self.if_else(condition, then, otherwise.as_ref());
            }
            _ => self.block(otherwise),
        }
    }

    fn when(&mut self, when: &When) {
        self.word_and("when ", &when.condition);
        self.optional(" for ", when.hold.as_ref());
        self.text.push_str(" then ");
        match &when.reaction {
            Reaction::Pause { within, .. } => {
                self.text.push_str("pause");
                self.optional(" within ", within.as_ref());
            }
            Reaction::Restart { at_most, .. } => self.word_and("restart at most ", at_most),
            Reaction::Resume { at_most, body, .. } => {
                self.word_and("resume at most ", at_most);
                self.text.push(' ');
                self.block(body);
            }
            Reaction::End(end) => self.ending(end),
        }
    }

    fn ending(&mut self, end: &End) {
        self.text.push_str(match end.kind {
            EndKind::Done => "done",
            EndKind::Fail => "fail",
            EndKind::Cannot => "cannot",
            EndKind::Replan => "replan",
        });
        if let Some(said) = end.result.as_ref().or(end.why.as_ref()) {
            let text = super::expression(said);
            // A call here would be read as the next step.
            let begins_with_call = text.split_once('(').is_some_and(|(name, _)| {
                !name.is_empty()
                    && (crate::words::is_bare_name(name) || name.starts_with('`') && name.ends_with('`'))
            });
            self.text.push(' ');
            self.text.push_str(&if begins_with_call { format!("({text})") } else { text });
        }
    }

    fn word_and(&mut self, word: &str, expr: &Expr) {
        self.text.push_str(word);
        expr::write(&mut self.text, expr);
    }

    fn optional(&mut self, word: &str, expr: Option<&Expr>) {
        if let Some(expr) = expr {
            self.word_and(word, expr);
        }
    }
}
