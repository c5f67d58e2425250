//! Vocabularies: the tokens of a language model as bytes, in a trie, with the sets of tokens that can be
//! precomputed for texts and names.

mod huggingface;
mod plain_list;
#[cfg(feature = "tiktoken")]
mod tiktoken;
mod token_list;
mod token_tree;

use std::sync::Arc;

use rustc_hash::FxHashMap;
use toktrie::{SimpleVob, TokRxInfo, TokTrie};

#[cfg(feature = "tiktoken")]
pub use self::tiktoken::Encoding;
pub use self::token_list::{
    EndToken, LONGEST_TOKEN, MAX_FILE_BYTES, MAX_TOKEN_BYTES, MAX_TOKENS, VocabularyError,
};
pub(crate) use self::token_tree::{Node, Tree};
use crate::subset::{MAX_NAME_CHARS, is_brace, is_text_char};

/// The tokens of a language model. Cloning is cheap, and threads may share it.
///
/// ```
/// use motet_decode::{EndToken, Vocabulary};
///
/// let vocabulary = Vocabulary::from_json_list(br#"["a", "ab", [255], null]"#, EndToken::Number(3))?;
/// assert_eq!((vocabulary.len(), vocabulary.end(), vocabulary.bytes(1)), (4, 3, &b"ab"[..]));
/// assert_eq!(vocabulary.tokenize(b"aba"), [1, 0]);
/// # Ok::<(), motet_decode::VocabularyError>(())
/// ```
#[derive(Clone)]
pub struct Vocabulary(Arc<Tokens>);

pub(crate) struct Tokens {
    pub(crate) trie: TokTrie,
    /// The same as a tree that is fast to search for few tokens.
    pub(crate) tree: Tree,
    /// Tokens that can stand anywhere inside a text.
    pub(crate) text: SimpleVob,
    /// Tokens that end a text, or whose position in it matters.
    pub(crate) text_ends: TokTrie,
    /// Tokens of a text with each of their braces twice, but for one at the end.
    pub(crate) doubled: SimpleVob,
    /// Other tokens with a brace in a text: the names in scope tell if they can stand there.
    pub(crate) braces: TokTrie,
    /// Tokens that begin with `$` and can stand inside a text, but not begin it.
    pub(crate) dollars: SimpleVob,
    /// Tokens that begin with `$` and reach into a text.
    pub(crate) dollar_ends: TokTrie,
    /// Tokens that end a text, by the bytes behind it.
    pub(crate) text_tails: Tails,
    /// Tokens that can stand inside a name, by greatest length.
    pub(crate) names: Vec<SimpleVob>,
    /// Tokens that can begin a name, by greatest length.
    pub(crate) first_names: Vec<SimpleVob>,
    /// Tokens that end a name with a quote.
    pub(crate) name_ends: TokTrie,
    /// Tokens that end a name with a space.
    pub(crate) bare_name_ends: TokTrie,
    /// Tokens of a space and the beginning of a name, by greatest length.
    pub(crate) spaced_names: Vec<SimpleVob>,
    /// Tokens of a space, a name, and the space that ends it.
    pub(crate) spaced_name_ends: TokTrie,
    pub(crate) longest: usize,
    /// The tokens that have bytes, the longest first.
    pub(crate) by_length: Vec<u32>,
    pub(crate) end: u32,
    /// Tokens with the bytes of an earlier one, which stands for them in the tries, sorted by number.
    pub(crate) twins: Vec<(u32, u32)>,
}

impl std::fmt::Debug for Vocabulary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Vocabulary({} tokens)", self.0.trie.vocab_size())
    }
}

/// The token can stand anywhere inside a text, whatever names are bound: it has braces, each of them twice,
/// but for one at the end.
fn is_doubled(bytes: &[u8]) -> bool {
    let (mut rest, mut has_braces) = (bytes, false);
    while let Some((first, behind)) = rest.split_first() {
        rest = match behind.split_first() {
            Some((second, behind)) if is_brace(*first) && first == second => behind,
            Some(_) if is_brace(*first) => return false,
            _ => behind,
        };
        has_braces |= is_brace(*first);
    }
    has_braces && bytes.first() != Some(&b'$') && bytes.iter().all(|byte| is_text_char(char::from(*byte)))
}

impl Vocabulary {
    /// As [`new`](Self::new), with limits for tokens that come from outside. A token of more than
    /// [`LONGEST_TOKEN`] bytes is never allowed.
    ///
    /// # Errors
    ///
    /// There are more than [`MAX_TOKENS`] tokens or [`MAX_TOKEN_BYTES`] bytes, no bytes at all, or no token
    /// `end`.
    pub fn from_tokens(tokens: Vec<Vec<u8>>, end: u32) -> Result<Self, VocabularyError> {
        token_list::held(tokens, end).map(|tokens| Self::new(&tokens, end))
    }

    /// Builds a vocabulary from the bytes of each token in the order of their numbers. A special token has
    /// no bytes: it is never allowed, except for `end`, which ends a sequence. O(bytes of all tokens).
    #[must_use]
    pub fn new(tokens: &[Vec<u8>], end: u32) -> Self {
        let size = u32::try_from(tokens.len()).unwrap_or(u32::MAX);
        let (tokens, twins) = apart(tokens);
        let tokens = tokens.as_slice();
        let trie = TokTrie::from(&TokRxInfo::new(size, end), tokens);
        let is_name_byte = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        let is_text_byte = |byte: &u8| is_text_char(char::from(*byte)) && !is_brace(*byte);
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
        let doubled = set(&|bytes| is_doubled(bytes));
        let braces = trie.filter(&set(&|bytes| {
            let before = bytes.split(|byte| *byte == b'"').next().unwrap_or_default();
            before.iter().all(|byte| is_text_char(char::from(*byte)))
                && before.iter().any(|byte| is_brace(*byte))
                && !is_doubled(bytes)
        }));
        let dollars = set(&|bytes| bytes.iter().all(is_text_byte) && bytes.first() == Some(&b'$'));
        let dollar_ends = trie.filter(&set(&|bytes| bytes.first() == Some(&b'$')));
        let ends = (0..size).zip(tokens).filter_map(|(id, bytes)| {
            let quote = bytes.iter().position(|byte| *byte == b'"')?;
            bytes.get(..quote)?.iter().all(is_text_byte).then_some((id, bytes.split_at_checked(quote)?))
        });
        let text_tails = Tails::new(ends);
        let ends_name = |bytes: &[u8], end: u8| {
            let before = bytes.iter().take_while(|byte| is_name_byte(byte)).count();
            bytes.get(before) == Some(&end)
        };
        let name_ends = |end: u8| trie.filter(&set(&|bytes| ends_name(bytes, end)));
        // The sets by length are nested.
        let names = |length: &dyn Fn(&[u8]) -> Option<usize>| {
            let mut sets: Vec<SimpleVob> = (0..=MAX_NAME_CHARS).map(|_| trie.alloc_token_set()).collect();
            for (id, bytes) in (0..size).zip(tokens).filter(|(_, bytes)| !bytes.is_empty()) {
                if let Some(set) = length(bytes).and_then(|length| sets.get_mut(length)) {
                    set.allow_token(id);
                }
            }
            for length in 1..sets.len() {
                let (shorter, longer) = sets.split_at_mut(length);
                if let (Some(shorter), Some(set)) = (shorter.last(), longer.first_mut()) {
                    set.or(shorter);
                }
            }
            sets
        };
        let name = |bytes: &[u8]| bytes.iter().all(is_name_byte).then_some(bytes.len());
        let first_name =
            |bytes: &[u8]| name(bytes).filter(|_| !bytes.first().is_some_and(u8::is_ascii_digit));
        let spaced_names = names(&|bytes| bytes.strip_prefix(b" ").and_then(first_name));
        let spaced_name_ends =
            trie.filter(&set(&|bytes| bytes.strip_prefix(b" ").is_some_and(|rest| ends_name(rest, b' '))));
        let text_ends = trie.filter(&text_ends);
        let (name_ends, bare_name_ends) = (name_ends(b'"'), name_ends(b' '));
        let longest = trie.max_token_len();
        let mut by_length: Vec<u32> = (0..size).collect();
        by_length.retain(|id| !trie.token(*id).is_empty());
        by_length.sort_by_key(|id| std::cmp::Reverse(trie.token_len(*id)));
        let (first_names, names) = (names(&first_name), names(&name));
        let tree = Tree::new(&trie);
        Self(Arc::new(Tokens {
            trie,
            tree,
            text,
            text_ends,
            doubled,
            braces,
            dollars,
            dollar_ends,
            text_tails,
            names,
            first_names,
            name_ends,
            bare_name_ends,
            spaced_names,
            spaced_name_ends,
            longest,
            by_length,
            end,
            twins,
        }))
    }

    /// The token that ends a sequence.
    #[must_use]
    pub fn end(&self) -> u32 {
        self.0.end
    }

    /// The number of tokens, special ones included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.trie.vocab_size()
    }

    /// The vocabulary has no tokens.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The bytes of a token; empty for a special or unknown one.
    #[must_use]
    pub fn bytes(&self, token: u32) -> &[u8] {
        let twin = self.0.twins.binary_search_by_key(&token, |(twin, _)| *twin).ok();
        let token = twin.and_then(|twin| self.0.twins.get(twin)).map_or(token, |(_, first)| *first);
        if (token as usize) < self.len() { self.0.trie.token(token) } else { &[] }
    }

    /// Splits bytes into tokens greedily, the longest first.
    #[must_use]
    pub fn tokenize(&self, bytes: &[u8]) -> Vec<u32> {
        self.0.trie.greedy_tokenize(bytes)
    }

    pub(crate) fn tokens(&self) -> &Tokens {
        &self.0
    }
}

/// Removes tokens with the bytes of an earlier one; returns them with that one. Vocabularies with byte
/// fallback have many.
fn apart(tokens: &[Vec<u8>]) -> (Vec<Vec<u8>>, Vec<(u32, u32)>) {
    let mut firsts: FxHashMap<&[u8], u32> = FxHashMap::default();
    let (mut kept, mut twins) = (Vec::with_capacity(tokens.len()), Vec::new());
    for (id, bytes) in (0..).zip(tokens) {
        let first = *firsts.entry(bytes).or_insert(id);
        let is_twin = first != id && !bytes.is_empty();
        twins.extend(is_twin.then_some((id, first)));
        kept.push(if is_twin { Vec::new() } else { bytes.clone() });
    }
    (kept, twins)
}

/// Tokens that end a text, grouped by the bytes behind it: if any text may stand, those bytes alone decide.
pub(crate) struct Tails {
    /// The tails, each as a token.
    pub(crate) trie: TokTrie,
    /// The tokens of each tail.
    pub(crate) tokens: Vec<Tail>,
}

/// The tokens that share one tail.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tail {
    /// The token that is only the tail.
    pub(crate) bare: Option<u32>,
    /// Tokens with text before the tail.
    pub(crate) within: Vec<u32>,
    /// Tokens with text before the tail that begins with `$`.
    pub(crate) dollars: Vec<u32>,
}

impl Tails {
    /// Groups tokens, each given as its text and its tail.
    fn new<'t>(tokens: impl Iterator<Item = (u32, (&'t [u8], &'t [u8]))>) -> Self {
        let mut found: std::collections::BTreeMap<&[u8], Tail> = std::collections::BTreeMap::new();
        for (id, (text, tail)) in tokens {
            let tail = found.entry(tail).or_default();
            match text.first() {
                None => tail.bare = Some(id),
                Some(b'$') => tail.dollars.push(id),
                Some(_) => tail.within.push(id),
            }
        }
        let spelled: Vec<Vec<u8>> = found.keys().map(|tail| tail.to_vec()).collect();
        let size = u32::try_from(spelled.len()).unwrap_or(u32::MAX);
        Self {
            trie: TokTrie::from(&TokRxInfo::new(size, 0), &spelled),
            tokens: found.into_values().collect(),
        }
    }
}
