//! A request as words: lower case, contractions opened, sentence marks kept as marks.

use crate::engine::english::{CONTRACTIONS, OFFERS, PLURALS};

/// A word or a mark.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Token {
    /// A word in lower case.
    Word(String),
    Comma,
    /// The end of a sentence: `.`, `!`, `?`, `;`, a line break.
    Stop,
}

impl Token {
    /// The word; empty for a mark.
    pub(crate) fn word(&self) -> &str {
        match self {
            Self::Word(word) => word,
            Self::Comma | Self::Stop => "",
        }
    }
}

/// Splits a request. Anything that is neither a letter, a digit nor a mark separates words; an apostrophe
/// belongs to its word. O(bytes).
pub(crate) fn tokens(text: &str) -> Vec<Token> {
    let mut tokens: Vec<Token> = Vec::new();
    let mut begin = 0;
    for (token, end) in pieces(text) {
        let is_stop = token == Token::Stop;
        // `want the coke?` offers it, `want the coke!` asks for it.
        let asks = is_stop && text.get(..end).is_some_and(|said| said.ends_with('?'));
        if asks && tokens.get(begin).is_some_and(|first| OFFERS.has(first.word())) {
            tokens.splice(begin..begin, words("do you"));
        }
        tokens.push(token);
        if is_stop {
            begin = tokens.len();
        }
    }
    tokens
}

/// The same, each with the offset in bytes behind it; what is written together ends together.
pub(crate) fn pieces(text: &str) -> Vec<(Token, usize)> {
    let mut pieces = Vec::new();
    let mut word = String::new();
    let mut was_blank = true;
    let mut letters = text.char_indices().peekable();
    while let Some((at, letter)) = letters.next() {
        // A point between digits or letters without a blank belongs to the word: `1.5`.
        let joins = letter == '.'
            && !word.is_empty()
            && letters.peek().is_some_and(|(_, next)| next.is_alphanumeric());
        if matches!(letter, '\'' | '\u{2019}' | '\u{2018}') {
            word.push('\'');
            was_blank = false;
            continue;
        }
        if letter.is_alphanumeric() || joins {
            word.extend(letter.to_lowercase());
            was_blank = false;
            continue;
        }
        push(&mut pieces, &mut word, at);
        // A dash between blanks is a pause.
        let is_pause = matches!(letter, '\u{2013}' | '\u{2014}')
            || (letter == '-'
                && was_blank
                && letters.peek().is_none_or(|(_, next)| next.is_whitespace() || *next == '-'));
        was_blank = letter.is_whitespace();
        let mark = match letter {
            _ if is_pause => Some(Token::Comma),
            ',' | ':' => Some(Token::Comma),
            '.' | '!' | '?' | ';' | '\n' => Some(Token::Stop),
            _ => None,
        };
        if let Some(mark) = mark {
            pieces.push((mark, at + letter.len_utf8()));
        }
    }
    push(&mut pieces, &mut word, text.len());
    pieces
}

fn push(pieces: &mut Vec<(Token, usize)>, word: &mut String, end: usize) {
    let taken = std::mem::take(word);
    let bare = taken.trim_matches('\'');
    if bare.is_empty() {
        return;
    }
    match CONTRACTIONS.value(bare) {
        Some(words) => pieces.extend(words.split(' ').map(|word| (Token::Word(word.to_owned()), end))),
        None => pieces.push((Token::Word(bare.to_owned()), end)),
    }
}

/// A noun in the singular, by the common rules: `cookies` → `cookie`, `glasses` → `glass`, `berries` →
/// `berry`, `knives` → `knife`. What does not look like a plural stays.
pub(crate) fn singular(word: &str) -> String {
    if let Some(one) = PLURALS.value(word) {
        return one.to_owned();
    }
    if let Some(stem) = word.strip_suffix("ies").filter(|stem| stem.len() > 2) {
        return format!("{stem}y");
    }
    for end in ["ches", "shes", "xes", "sses"] {
        if let (true, Some(stem)) = (word.ends_with(end), word.strip_suffix("es")) {
            return stem.to_owned();
        }
    }
    let keeps = ["ss", "us", "is"].iter().any(|end| word.ends_with(end)) || word.len() < 4;
    match word.strip_suffix('s').filter(|_| !keeps) {
        Some(stem) => stem.to_owned(),
        None => word.to_owned(),
    }
}

/// Words as tokens.
pub(crate) fn words(text: &str) -> Vec<Token> {
    text.split(' ').map(|word| Token::Word(word.to_owned())).collect()
}

/// Counts how many tokens words take at a place; none where they do not stand there.
pub(crate) fn stands(tokens: &[Token], at: usize, words: &str) -> Option<usize> {
    // Most of a table begins with another word.
    if !words.starts_with(tokens.get(at)?.word()) {
        return None;
    }
    let mut count = 0;
    for word in words.split(' ') {
        if tokens.get(at + count)?.word() != word {
            return None;
        }
        count += 1;
    }
    Some(count)
}

#[cfg(test)]
mod tests {
    use super::{Token, pieces, singular, tokens};

    fn said(text: &str) -> String {
        let word =
            |token: &Token| if token.word().is_empty() { "|".to_owned() } else { token.word().to_owned() };
        tokens(text).iter().map(word).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn tokens_open_contractions_and_keep_marks() {
        assert_eq!(said("I'd like the Coke, please!"), "i would like the coke | please |");
        assert_eq!(said("1.5 litres \u{2013} now"), "1.5 litres | now");
        // `want the coke?` offers it.
        assert_eq!(said("Want the coke?"), "do you want the coke |");
    }

    #[test]
    fn pieces_tell_where_each_ends() {
        let ends: Vec<usize> = pieces("can't go").iter().map(|(_, end)| *end).collect();
        assert_eq!(ends, [5, 5, 8]);
    }

    #[test]
    fn singular_by_rule_and_by_list() {
        for (many, one) in [("cookies", "cookie"), ("glasses", "glass"), ("berries", "berry"), ("bus", "bus")]
        {
            assert_eq!(singular(many), one);
        }
    }
}
