//! Words that may come next, found by trying bytes.

use motet_compiler::Signatures;
use motet_decode::Acceptor;
use motet_syntax::Syntax;

use super::place::{PrefixEnd, describe, describe_text};
use super::quoted;

/// Number of possible bytes above which the next word is free.
const FREE: usize = 40;
/// Maximum number of tried bytes; a scene with thousands of entities has more words.
const MAX_TRIES: usize = 4000;

/// Continuations of a prefix.
#[derive(Debug)]
pub(super) struct Next {
    /// Words in the order of their bytes, with the brackets and quotes before them.
    pub(super) words: Vec<String>,
    /// Kinds of values without a list: `a text`, `a name`, `a number`.
    free: Vec<&'static str>,
    /// Is `true` if some words are missing.
    is_cut: bool,
    syntax: Syntax,
}

/// Continuations of the bytes of an acceptor, which stays as it is.
pub(super) fn next(acceptor: &mut Acceptor, syntax: Syntax) -> Next {
    let first = acceptor.next_bytes();
    let mut next = Next { words: Vec::new(), free: Vec::new(), is_cut: false, syntax };
    if first.len() > FREE {
        let is_text =
            acceptor.bytes().iter().filter(|byte| **byte == b'"').count() % 2 == 1 && syntax == Syntax::Text;
        let is_text = is_text || (syntax == Syntax::Json && first.contains(&b' '));
        next.free.push(if is_text { "a text" } else { "a name" });
        next.words.extend(first.contains(&b'"').then(|| "\"".to_owned()));
        return next;
    }
    let in_string = acceptor.bytes().iter().filter(|byte| **byte == b'"').count() % 2 == 1;
    let (mut word, mut tries) = (Vec::new(), MAX_TRIES);
    for byte in first {
        if !in_string && (byte.is_ascii_digit() || matches!(byte, b'-' | b'.')) {
            if next.free.is_empty() {
                next.free.push("a number");
            }
        } else {
            grow(acceptor, byte, &mut word, &mut next, &mut tries);
        }
    }
    next
}

/// Follows a possible byte to the end of each word that starts with it.
fn grow(acceptor: &mut Acceptor, byte: u8, word: &mut Vec<u8>, next: &mut Next, tries: &mut usize) {
    if *tries == 0 {
        next.is_cut = true;
        return;
    }
    *tries -= 1;
    if acceptor.accept(&[byte]) == 0 {
        return;
    }
    word.push(byte);
    let opens = word.iter().all(|byte| b"{[\"".contains(byte));
    if byte == b'"'
        && word.len() == 1
        && acceptor.bytes().iter().filter(|byte| **byte == b'"').count() % 2 == 0
    {
        // The quote closes the string before it.
        next.words.push(text(word));
    } else if is_mark(byte, next.syntax) && !opens {
        next.words.push(text(word));
    } else {
        let follow = acceptor.next_bytes();
        if follow.len() > FREE {
            next.words.push(text(word) + "…");
        } else {
            let (marks, rest): (Vec<u8>, Vec<u8>) = follow
                .into_iter()
                .partition(|byte| is_mark(*byte, next.syntax) && !(opens && b"{[\"".contains(byte)));
            if !marks.is_empty() {
                next.words.push(text(word));
            }
            for byte in rest {
                grow(acceptor, byte, word, next, tries);
            }
        }
    }
    word.pop();
    acceptor.forget(1);
}

/// Is `true` for bytes between words.
fn is_mark(byte: u8, syntax: Syntax) -> bool {
    match syntax {
        Syntax::Json => b"{}[],:\"".contains(&byte),
        Syntax::Text => b"{}[](), \"".contains(&byte),
    }
}

fn text(word: &[u8]) -> String {
    String::from_utf8_lossy(word).into_owned()
}

impl Next {
    /// Describes the continuations, one per line.
    pub(super) fn describe(&self, signatures: &Signatures, acceptor: &Acceptor) -> String {
        let place = PrefixEnd::of(acceptor.bytes());
        let mut text = "may follow:\n".to_owned();
        for free in &self.free {
            text.push_str(&format!("  {free}\n"));
        }
        let width = self.words.iter().map(|word| word.chars().count()).max().unwrap_or_default().min(24);
        for word in &self.words {
            let description = match self.syntax {
                Syntax::Json => describe(signatures, &place, word),
                Syntax::Text => describe_text(signatures, word),
            };
            let line = format!("  {word:width$}  {description}");
            text.push_str(line.trim_end());
            text.push('\n');
        }
        if self.is_cut {
            text.push_str("  … and more\n");
        }
        if self.words.is_empty() && self.free.is_empty() {
            text.push_str(&format!("  nothing after {}\n", quoted(acceptor.bytes())));
        }
        text
    }
}
