//! Requests said plainly: what asks for nothing is left out, and a sentence that asks without an imperative
//! is said as one. `I need the fridge open` is `open the fridge`, `could the coke be brought to me` is `bring
//! the coke to me`.
//!
//! The rules are constructions with places for nouns, after Goldberg, Constructions (1995): a predicate of
//! place or state (`X belongs in Y`, `I want X shut`), a passive, a causative (`get X open`), a wish, and
//! what politeness puts before them. They stand in `rewrites.phrases`; this module applies them in order.

use crate::engine::asking::skip_leads;
use crate::engine::effort;
use crate::engine::english::{CLAUSE_JOINTS, NEED_NOT, PLAIN_AND};
use crate::engine::rule::Rules;
use crate::engine::token::Token;
use crate::engine::verb::{Inflection, base, begins, of_past};

/// Rules for what is said before an imperative or in the place of one: what each writes is read again. In
/// those of a series the verbs that follow stand in the same form.
const REWRITTEN: &[(Rules, Series)] = &[
    (Rules("addressed"), Series::Own),
    (Rules("in_another_form"), Series::Same),
    (Rules("unwrapped"), Series::Own),
    (Rules("favours"), Series::Same),
];

/// The form of the verbs that follow in a series.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Series {
    Own,
    Same,
}

/// A request without its courtesy.
pub(crate) fn without_courtesy(tokens: &[Token]) -> Vec<Token> {
    let mut tokens = tokens.to_vec();
    Rules("courtesy").rewrite(&mut tokens);
    tokens
}

/// A request after all rewrites.
pub(crate) fn plain(tokens: &[Token]) -> Vec<Token> {
    let mut tokens = tokens.to_vec();
    // What is left out may stand between other words that are.
    // `I cannot open it, could you?` has to be read before courtesy is left out.
    for pass in ["in_order", "possessed", "elliptic", "courtesy", "dropped", "courtesy"] {
        Rules(pass).rewrite(&mut tokens);
    }
    delegated(&mut tokens);
    let mut said = Vec::with_capacity(tokens.len());
    let (mut at, mut starts, mut begins_sentence) = (0, true, true);
    // Every rewriting takes words away or goes on behind what it wrote: the bound only guards against a slip
    // of that.
    let mut left = tokens.len() * 4 + 16;
    while at < tokens.len() && left > 0 && !effort::is_used_up() {
        left -= 1;
        if starts {
            let begin = skip_leads(&tokens, at);
            let rewritten =
                REWRITTEN.iter().find_map(|(rules, series)| Some((rules.at(&tokens, begin)?, *series)));
            if let Some((found, series)) = rewritten {
                tokens.splice(begin..found.end, found.words);
                if series == Series::Same {
                    in_series(&mut tokens, begin);
                }
                continue;
            }
            let sentence = || Rules("sentences").at(&tokens, begin).filter(|_| begins_sentence);
            if let Some(found) = Rules("clauses").at(&tokens, begin).or_else(sentence) {
                // A comma before a clause that takes the place of a statement stays one.
                said.extend(found.words);
                (at, starts, begins_sentence) = (found.end, false, false);
                continue;
            }
        }
        let Some(token) = tokens.get(at) else { break };
        let joins = matches!(token, Token::Comma | Token::Stop) || PLAIN_AND.has(token.word());
        let is_lead = skip_leads(&tokens, at) > at;
        begins_sentence = *token == Token::Stop || (begins_sentence && starts && is_lead);
        starts = joins;
        said.push(token.clone());
        at += 1;
    }
    said
}

/// `… if you took it and brought it to me`, `… picking it up and hanging on to it`: the verbs that follow the
/// first of such a clause, in the form of requests.
fn in_series(tokens: &mut [Token], begin: usize) {
    let count = tokens.iter().skip(begin).take_while(|token| **token != Token::Stop).count();
    for at in begin + 1..begin + count {
        if tokens.get(at - 1).is_some_and(|joint| joint.word() == "and")
            && let Some(token) = tokens.get_mut(at)
        {
            let doing =
                || base(token.word()).filter(|(_, form)| *form == Inflection::Gerund).map(|(verb, _)| verb);
            if let Some(verb) = of_past(token.word()).or_else(doing) {
                *token = Token::Word(verb);
            }
        }
    }
}

/// Puts what is delegated in the place of what asks for it: `I forgot to close the fridge, could you do that
/// for me?`
fn delegated(tokens: &mut Vec<Token>) {
    let mut at = 0;
    while at < tokens.len() && !effort::is_used_up() {
        if let Some((begin, end, said)) = asked_for(tokens, at) {
            tokens.splice(begin..end, said);
            at = begin;
        } else if let Some(found) = Rules("met").at(tokens, at) {
            tokens.splice(at..found.end, found.words);
        }
        at += 1;
    }
}

/// `I have to open it, but can you do it for me?`: from where to where `open it` takes their place.
fn asked_for(tokens: &[Token], at: usize) -> Option<(usize, usize, Vec<Token>)> {
    let end = Rules("asks_for_it").end(tokens, at).or_else(|| Rules("proves_it").end(tokens, at))?;
    let joint = tokens.get(at.checked_sub(1)?)?;
    if !matches!(joint.word(), "" | "but" | "so" | "and") {
        return None;
    }
    let before = tokens.get(..at - 1)?;
    let begin = before.iter().rposition(|token| *token == Token::Stop).map_or(0, |at| at + 1);
    let sentence = before.get(begin..)?;
    // `I do not have to close it`
    if (0..sentence.len()).any(|at| NEED_NOT.longest(sentence, at).is_some()) {
        return None;
    }
    Some((begin, end, Rules("task").search(sentence)?))
}

/// The end of a clause that asks for what was spoken of.
pub(crate) fn asks_for_it(tokens: &[Token], at: usize) -> Option<usize> {
    Rules("asks_for_it").end(tokens, at)
}

/// A remark goes on to the end of its sentence, or to a comma or a joint behind which something is asked for.
pub(crate) fn remark_end(tokens: &[Token], begin: usize) -> usize {
    let mut at = begin;
    while let Some(token) = tokens.get(at).filter(|_| effort::step()) {
        let is_joint = matches!(token, Token::Comma) || CLAUSE_JOINTS.has(token.word());
        let asks = || begins(tokens, at + 1) || asks_for_it(tokens, at + 1).is_some();
        if matches!(token, Token::Stop) || (at > begin && is_joint && asks()) {
            break;
        }
        at += 1;
    }
    at
}
