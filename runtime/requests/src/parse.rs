//! A request as its commands and the remarks beside them, in order.

use crate::command::{Command, command, words};
use crate::engine::asking::{contrasts, skip_leads, thanks};
use crate::engine::english::{DENIES_REQUEST, OF_IT, SPOKEN_I_MEAN};
use crate::engine::noun::{Noun, noun};
use crate::engine::rewrite::{asks_for_it, remark_end};
use crate::engine::rule::Rules;
use crate::engine::token::{Token, stands};
use crate::engine::verb::{begins, is_want, verb};
use crate::remark::{When, beside, caution, forbidden, is_question, is_remark};

/// A clause beside the commands of a request.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Statement {
    pub(super) tokens: Vec<Token>,
}

/// The commands and statements of a request.
#[derive(Clone, Debug, Default)]
pub(super) struct Spoken {
    pub(super) commands: Vec<Command>,
    pub(super) statements: Vec<Statement>,
}

/// Reads a request. An error is the part that is not understood.
pub(super) fn parse(tokens: &[Token]) -> Result<Spoken, String> {
    let mut spoken = Spoken::default();
    let mut asked_whether = false;
    let mut at = 0;
    while at < tokens.len() {
        if matches!(tokens.get(at), Some(Token::Stop | Token::Comma)) {
            at += 1;
            continue;
        }
        let begin = skip_leads(tokens, at);
        if begin >= tokens.len() || matches!(tokens.get(begin), Some(Token::Stop)) {
            // `go to the sink? No.`
            let is_apart = at.checked_sub(1).is_some_and(|at| tokens.get(at) == Some(&Token::Stop));
            let led = tokens.get(at..begin).unwrap_or_default();
            if is_apart
                && !spoken.commands.is_empty()
                && led.iter().all(|token| token.word() == "no")
                && !led.is_empty()
            {
                return Err(words(tokens, at, begin));
            }
            at = begin + 1;
            continue;
        }
        let is_apart = at.checked_sub(1).is_some_and(|at| tokens.get(at) == Some(&Token::Stop));
        let more = spoken
            .commands
            .last_mut()
            .filter(|_| is_apart)
            .and_then(|last| last.goes_on_at(tokens, begin).or_else(|| last.is_about(tokens, begin)));
        if let Some(end) = more {
            at = end;
            continue;
        }
        // `…, while I think about it`
        if let Some(last) = spoken.commands.last()
            && let Some(end) = beside(tokens, begin, last.act())
        {
            at = end;
            continue;
        }
        // `I shall need it within reach, so put it on the table`: what shall be done is said behind it.
        if let Some(end) = only_needs(tokens, begin) {
            spoken.statements.extend(tokens.get(begin..end).map(|said| Statement { tokens: said.to_vec() }));
            at = end;
            continue;
        }
        if let Some(count) = thanks(tokens, begin) {
            at = begin + count;
            continue;
        }
        if let Some(end) = caution(tokens, begin, spoken.commands.last().map(Command::act)) {
            at = end;
            continue;
        }
        if let Some((end, when)) = forbidden(tokens, begin, &spoken.commands) {
            // What it is about is spoken of.
            let said = tokens.get(begin..end).filter(|_| when == When::Before);
            spoken.statements.extend(said.map(|said| Statement { tokens: said.to_vec() }));
            at = end;
            continue;
        }
        // Who asked whether something is so, and goes on with `then`, means: if it is.
        if asked_whether && stands(tokens, at, "then").is_some() {
            return Err(words(tokens, at, tokens.len()));
        }
        if DENIES_REQUEST.longest(tokens, begin).is_some() || contrasts(tokens, begin) {
            return Err(words(tokens, begin, tokens.len()));
        }
        // `the sponge should go in the drawer, can you do that for me?`
        if let (Some(end), false) = (asks_for_it(tokens, begin), spoken.commands.is_empty()) {
            at = end;
            continue;
        }
        let before = spoken.commands.last().map(Command::act);
        if before.is_some()
            && let Some(found) = Rules("stays_put").behind(tokens, begin, before)
        {
            at = found.end;
            continue;
        }
        asked_whether = false;
        if verb(tokens, begin).is_some() {
            let before = spoken.commands.len();
            at = command(tokens, begin, &mut spoken.commands)?;
            // `it is rubbish, put in the bin please`: what was spoken of.
            if !spoken.statements.is_empty()
                && let Some(first) = spoken.commands.get_mut(before)
            {
                first.is_of_what_was_said();
            }
            continue;
        }
        let end = remark_end(tokens, begin);
        // `bring me the mug. No, the cup`: what was asked for is taken back.
        let is_no = tokens.get(at..begin).is_some_and(|led| led.iter().any(|token| token.word() == "no"));
        if is_no && !spoken.commands.is_empty() && noun(tokens, begin).is_some_and(|(_, after)| after == end)
        {
            return Err(words(tokens, at, end));
        }
        // `the coke, I mean the sponge`: so is what is put right.
        let corrects = SPOKEN_I_MEAN.longest(tokens, begin).filter(|count| {
            noun(tokens, begin + count).is_some_and(|(noun, _)| matches!(noun, Noun::Phrase(_)))
        });
        if corrects.is_some() && !spoken.commands.is_empty() {
            return Err(words(tokens, at, end));
        }
        if !is_remark(tokens, begin, end) {
            return Err(words(tokens, begin, end));
        }
        asked_whether = is_question(tokens, begin);
        let said = tokens.get(begin..end).unwrap_or_default().to_vec();
        spoken.statements.push(Statement { tokens: said });
        at = end;
    }
    Ok(spoken)
}

/// Reads what somebody needs who then says, behind a `so`, what shall be done with it; where that begins.
fn only_needs(tokens: &[Token], begin: usize) -> Option<usize> {
    if !is_want(tokens, begin) {
        return None;
    }
    let end = remark_end(tokens, begin);
    let so = end + usize::from(tokens.get(end) == Some(&Token::Comma));
    let then = so + stands(tokens, so, "so")?;
    let next = skip_leads(tokens, then);
    let until = (next..tokens.len())
        .find(|at| matches!(tokens.get(*at), Some(Token::Comma | Token::Stop)))
        .unwrap_or(tokens.len());
    let is_of_it = tokens.get(next..until)?.iter().any(|token| OF_IT.has(token.word()));
    (begins(tokens, next) && is_of_it).then_some(end)
}
