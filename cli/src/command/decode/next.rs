//! The words that may come next, found by trying bytes.

use motet_compiler::Signatures;
use motet_decode::Acceptor;
use motet_syntax::Syntax;

use super::place::{Place, describe, describe_text};
use super::quoted;

/// Where so many bytes may follow, one is free in what to write.
const FREE: usize = 40;
/// So many bytes are tried at most; in a scene with thousands of entities some are left out.
const MOST: usize = 4000;

/// What may come next.
#[derive(Debug)]
pub(super) struct Next {
    /// Words, in the order of their bytes, with the brackets and quotes before them.
    pub(super) words: Vec<String>,
    /// `a text`, `a name`, `a number`: what has no list.
    free: Vec<&'static str>,
    /// Whether some words were left out.
    is_cut: bool,
    form: Syntax,
}

/// What may come next after the bytes of an acceptor, which are left as they are.
pub(super) fn next(acceptor: &mut Acceptor, form: Syntax) -> Next {
    let first = acceptor.next_bytes();
    let mut next = Next { words: Vec::new(), free: Vec::new(), is_cut: false, form };
    if first.len() > FREE {
        let is_text =
            acceptor.bytes().iter().filter(|byte| **byte == b'"').count() % 2 == 1 && form == Syntax::Text;
        let is_text = is_text || (form == Syntax::Json && first.contains(&b' '));
        next.free.push(if is_text { "a text" } else { "a name" });
        next.words.extend(first.contains(&b'"').then(|| "\"".to_owned()));
        return next;
    }
    let in_string = acceptor.bytes().iter().filter(|byte| **byte == b'"').count() % 2 == 1;
    let (mut word, mut tries) = (Vec::new(), MOST);
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

/// Goes on with a byte that may follow, to the end of each word that begins like that.
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
        // It closes what stands before.
        next.words.push(text(word));
    } else if is_mark(byte, next.form) && !opens {
        next.words.push(text(word));
    } else {
        let follow = acceptor.next_bytes();
        if follow.len() > FREE {
            next.words.push(text(word) + "…");
        } else {
            let (marks, rest): (Vec<u8>, Vec<u8>) = follow
                .into_iter()
                .partition(|byte| is_mark(*byte, next.form) && !(opens && b"{[\"".contains(byte)));
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

/// What stands between words.
fn is_mark(byte: u8, form: Syntax) -> bool {
    match form {
        Syntax::Json => b"{}[],:\"".contains(&byte),
        Syntax::Text => b"{}[](), \"".contains(&byte),
    }
}

fn text(word: &[u8]) -> String {
    String::from_utf8_lossy(word).into_owned()
}

impl Next {
    /// In words, a line each.
    pub(super) fn told(&self, signatures: &Signatures, acceptor: &Acceptor) -> String {
        let place = Place::of(acceptor.bytes());
        let mut text = "may follow:\n".to_owned();
        for free in &self.free {
            text.push_str(&format!("  {free}\n"));
        }
        let width = self.words.iter().map(|word| word.chars().count()).max().unwrap_or_default().min(24);
        for word in &self.words {
            let said = match self.form {
                Syntax::Json => describe(signatures, &place, word),
                Syntax::Text => describe_text(signatures, word),
            };
            let line = format!("  {word:width$}  {said}");
            text.push_str(line.trim_end());
            text.push('\n');
        }
        if self.is_cut {
            text.push_str("  and more\n");
        }
        if self.words.is_empty() && self.free.is_empty() {
            text.push_str(&format!("  nothing after {}\n", quoted(acceptor.bytes())));
        }
        text
    }
}
