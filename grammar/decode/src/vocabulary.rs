//! The tokens of a language model, as bytes, in a trie; and what of them can be said once for all texts and names.

use std::sync::Arc;

use toktrie::{SimpleVob, TokRxInfo, TokTrie};

use crate::surface::{MAX_NAME_CHARS, is_text_char};

/// The tokens of a language model.
#[derive(Clone)]
pub struct Vocabulary(Arc<Tokens>);

pub(crate) struct Tokens {
    pub(crate) trie: TokTrie,
    /// Tokens that can stand within a text wherever it is.
    pub(crate) text: SimpleVob,
    /// Those that end a text, or whose place in it matters.
    pub(crate) text_ends: TokTrie,
    /// By length: tokens that can stand within a name and have at most so many bytes.
    pub(crate) names: Vec<SimpleVob>,
    /// Of those, the ones that can begin it.
    pub(crate) first_names: Vec<SimpleVob>,
    /// Those that end a name.
    pub(crate) name_ends: TokTrie,
    pub(crate) longest: usize,
    pub(crate) end: u32,
}

impl std::fmt::Debug for Vocabulary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Vocabulary({} tokens)", self.0.trie.vocab_size())
    }
}

impl Vocabulary {
    /// A vocabulary from the bytes of each token in the order of their numbers. A special token has none: it is never
    /// allowed, but for `end`, which ends a sequence. O(bytes of all tokens).
    #[must_use]
    pub fn new(tokens: &[Vec<u8>], end: u32) -> Self {
        let size = u32::try_from(tokens.len()).unwrap_or(u32::MAX);
        let trie = TokTrie::from(&TokRxInfo::new(size, end), tokens);
        let is_name_byte = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        let is_text_byte = |byte: &u8| is_text_char(char::from(*byte));
        let set = |picks: &dyn Fn(&[u8]) -> bool| {
            let mut set = trie.alloc_token_set();
            for (id, bytes) in (0..size).zip(tokens) {
                if !bytes.is_empty() && picks(bytes) {
                    set.allow_token(id);
                }
            }
            set
        };
        let before_quote = |bytes: &[u8]| bytes.split(|byte| *byte == b'"').next().map(<[u8]>::to_vec);
        let text = set(&|bytes| bytes.iter().all(is_text_byte) && bytes.first() != Some(&b'$'));
        let text_ends = set(&|bytes| {
            let ends = bytes.contains(&b'"');
            bytes.first() == Some(&b'$')
                || (ends && before_quote(bytes).is_some_and(|before| before.iter().all(is_text_byte)))
        });
        let name_ends = set(&|bytes| {
            let ends = bytes.contains(&b'"');
            ends && before_quote(bytes).is_some_and(|before| before.iter().all(is_name_byte))
        });
        let names = |begins: bool| {
            let lengths = 0..=MAX_NAME_CHARS;
            let of_length = lengths.map(|most| {
                set(&|bytes| {
                    bytes.len() <= most
                        && bytes.iter().all(is_name_byte)
                        && !(begins && bytes.first().is_some_and(u8::is_ascii_digit))
                })
            });
            of_length.collect()
        };
        let (text_ends, name_ends) = (trie.filter(&text_ends), trie.filter(&name_ends));
        let longest = trie.max_token_len();
        let (first_names, names) = (names(true), names(false));
        Self(Arc::new(Tokens { trie, text, text_ends, names, first_names, name_ends, longest, end }))
    }

    /// How many tokens there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.trie.vocab_size()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The bytes of a token; empty for a special one.
    #[must_use]
    pub fn bytes(&self, token: u32) -> &[u8] {
        if (token as usize) < self.len() { self.0.trie.token(token) } else { &[] }
    }

    /// The tokens of bytes, each time the longest that fits.
    #[must_use]
    pub fn tokenize(&self, bytes: &[u8]) -> Vec<u32> {
        self.0.trie.greedy_tokenize(bytes)
    }

    pub(crate) fn tokens(&self) -> &Tokens {
        &self.0
    }
}
