//! Token masks: which tokens of a vocabulary may come next.

use std::sync::Arc;

use motet_compiler::incremental;
use motet_syntax::Syntax;
use toktrie::{Recognizer, SimpleVob};

use super::event_log::UNSEEN;
use super::lookahead::ByteSet;
use super::machine::Machine;
use super::{Acceptor, AcceptorFactory};
use crate::automaton::Op;
use crate::subset::{Digits, MAX_NAME_CHARS, MAX_TEXT_CHARS, NumberRange, is_brace};
use crate::vocabulary::{Node, Tokens, Tree, Vocabulary};

/// Follows a policy token by token and computes token masks. One policy, one thread at a time; clone it to
/// branch.
///
/// ```
/// use motet_decode::{AcceptorFactory, Environment, Subset, Vocabulary};
///
/// let texts = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() };
/// let session = texts.session()?;
/// let factory = AcceptorFactory::new(&session, Subset::default());
/// // A vocabulary of single bytes; the last token ends the sequence.
/// let tokens: Vec<Vec<u8>> = (0..=255).map(|byte| vec![byte]).chain([Vec::new()]).collect();
/// let vocabulary = Vocabulary::new(&tokens, 256);
/// let mut decoder = factory.decoder(&vocabulary, 4000).expect("a policy fits 4000 bytes");
/// let is_allowed = |mask: &[u32], token: usize| mask[token / 32] >> (token % 32) & 1 == 1;
/// assert!(is_allowed(decoder.mask(), usize::from(b'{')));
/// assert!(decoder.accept(u32::from(b'{')));
/// assert!(!is_allowed(decoder.mask(), usize::from(b'x')));
/// # Ok::<(), motet_decode::EnvironmentError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Decoder {
    vocabulary: Vocabulary,
    acceptor: Acceptor,
    /// The number of bytes before each token.
    before: Vec<usize>,
    is_over: bool,
    set: Mask,
    /// The last mask may have tokens that cannot follow.
    is_wide: bool,
    /// Tokens that were refused since the last one was taken.
    refused: Vec<u32>,
}

#[derive(Clone)]
struct Mask(SimpleVob);

impl std::fmt::Debug for Mask {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Mask({} of {})", self.0.num_set(), self.0.len())
    }
}

impl AcceptorFactory {
    /// A decoder for a policy of at most `budget` bytes; `None` if no policy is that short.
    #[must_use]
    pub fn decoder(&self, vocabulary: &Vocabulary, budget: usize) -> Option<Decoder> {
        let set = Mask(vocabulary.tokens().trie.alloc_token_set());
        Some(Decoder {
            vocabulary: vocabulary.clone(),
            acceptor: self.acceptor(budget)?,
            before: Vec::new(),
            is_over: false,
            set,
            is_wide: false,
            refused: Vec::new(),
        })
    }
}

impl Decoder {
    /// Computes the mask of tokens that may come next: token `t` is bit `t % 32` of word `t / 32`. Empty
    /// after the end.
    pub fn mask(&mut self) -> &[u32] {
        self.is_wide = false;
        let mark = self.acceptor.machine.mark();
        self.fill();
        self.acceptor.machine.restore(mark);
        self.set.0.as_slice()
    }

    /// Computes the mask as [`mask`](Self::mask) does, with a limit of its time: `effort` is what the
    /// checker may look at, as in [`motet_compiler::incremental::within`]; 20,000 take about half a
    /// millisecond. Where that is not enough, the mask [`is_wide`](Self::is_wide). It has all tokens that
    /// may follow, and others that only names and types allow: [`accept`](Self::accept) judges the one that
    /// is chosen. After a refusal the host takes the mask again, which lacks the refused tokens, and chooses
    /// another one.
    pub fn mask_within(&mut self, effort: u64) -> &[u32] {
        let machine = &self.acceptor.machine;
        let (mark, before) = (machine.mark(), machine.findings());
        self.is_wide = incremental::within(effort, || {
            self.fill();
            incremental::is_used_up()
        });
        if self.is_wide {
            self.acceptor.machine.forget_findings(mark, before);
        } else {
            self.acceptor.machine.restore(mark);
        }
        self.set.0.as_slice()
    }

    /// Returns whether the last mask may have tokens that cannot follow.
    #[must_use]
    pub fn is_wide(&self) -> bool {
        self.is_wide
    }

    fn fill(&mut self) {
        let Self { vocabulary, acceptor, set, is_over, refused, .. } = self;
        let set = &mut set.0;
        set.set_all(false);
        if *is_over {
            return;
        }
        let tokens = vocabulary.tokens();
        let machine = &mut acceptor.machine;
        match machine.free_text(tokens.longest) {
            Some(Free::Text { pos }) => {
                machine.mask_text(tokens, pos, set);
                machine.exclude_long(tokens, pos, set);
            }
            Some(Free::Name { pos, most }) => {
                let names = if pos == 0 { &tokens.first_names } else { &tokens.names };
                if let Some(names) = names.get(most) {
                    set.or(names);
                }
                machine.exclude_taken(tokens, set, b"");
                let ends = match machine.context.automaton.subset.syntax {
                    Syntax::Json => &tokens.name_ends,
                    Syntax::Text => &tokens.bare_name_ends,
                };
                ends.add_bias(&mut Stepper(machine), set, &[]);
            }
            None => machine.mask_few(tokens, set),
        }
        for (twin, first) in &tokens.twins {
            if set.is_allowed(*first) {
                set.allow_token(*twin);
            }
        }
        if acceptor.is_accepting() {
            set.allow_token(tokens.end);
        }
        refused.iter().for_each(|token| set.disallow_token(*token));
    }

    /// Takes a token if it may come next; otherwise nothing changes.
    pub fn accept(&mut self, token: u32) -> bool {
        let before = self.acceptor.bytes().len();
        let tokens = self.vocabulary.tokens();
        if self.is_over {
            return false;
        }
        if token == tokens.end {
            self.is_over = self.acceptor.is_accepting();
            if self.is_over {
                self.take(before);
            }
            return self.is_over;
        }
        let bytes = self.vocabulary.bytes(token);
        let taken = self.acceptor.accept(bytes);
        if bytes.is_empty() || taken < bytes.len() {
            self.acceptor.forget(taken);
            if self.is_wide {
                self.refused.push(token);
            }
            return false;
        }
        self.take(before);
        true
    }

    /// Records that a token was taken behind this number of bytes.
    fn take(&mut self, before: usize) {
        self.before.push(before);
        self.refused.clear();
        self.is_wide = false;
    }

    /// Takes back the last tokens, or all if there are fewer.
    pub fn rollback(&mut self, tokens: usize) {
        self.refused.clear();
        self.is_wide = false;
        for _ in 0..tokens {
            let Some(before) = self.before.pop() else { return };
            let bytes = self.acceptor.bytes().len().saturating_sub(before);
            self.acceptor.forget(bytes);
            self.is_over = false;
        }
    }

    /// The acceptor of the bytes below the tokens.
    pub fn acceptor(&mut self) -> &mut Acceptor {
        &mut self.acceptor
    }
}

/// A place where nearly all tokens may follow.
#[derive(Clone, Copy, Debug)]
enum Free {
    Text {
        pos: usize,
    },
    /// `most`: the number of bytes that fit the name.
    Name {
        pos: usize,
        most: usize,
    },
}

impl Machine {
    /// The free text or name that the machine is in, if any token fits it.
    fn free_text(&self, longest: usize) -> Option<Free> {
        let state = self.state();
        let automaton = &self.context.automaton;
        let text = |op| matches!(automaton.op(op), Op::Text { .. });
        let pos = state.pos as usize;
        let (free, op) = match automaton.op(state.op) {
            Op::Text { .. } if state.lo != UNSEEN || state.hi != UNSEEN => return None,
            Op::Text { .. } => (Free::Text { pos }, state.op),
            Op::Fork { byte: b'$', other, .. } if text(*other) => (Free::Text { pos }, *other),
            Op::Name(_) => (Free::Name { pos, most: MAX_NAME_CHARS.saturating_sub(pos) }, state.op),
            _ => return None,
        };
        self.fits(longest.max(MAX_NAME_CHARS) + 4, op + 1, state.frame).then_some(free)
    }
}

impl Machine {
    /// Adds the tokens that continue or end a text.
    fn mask_text(&mut self, tokens: &Tokens, pos: usize, set: &mut SimpleVob) {
        set.or(&tokens.text);
        set.or(&tokens.doubled);
        tokens.braces.add_bias(&mut Stepper(self), set, &[]);
        if self.text_matters() {
            tokens.text_ends.add_bias(&mut Stepper(self), set, &[]);
            return;
        }
        if pos > 0 {
            set.or(&tokens.dollars);
        } else {
            tokens.dollar_ends.add_bias(&mut Stepper(self), set, &[]);
        }
        let tails = &tokens.text_tails;
        let mut open = tails.trie.alloc_token_set();
        // A text must have a character before it can end: take any.
        let before = self.bytes.len();
        if pos > 0 || self.push(b'a') {
            tails.trie.add_bias(&mut Stepper(self), &mut open, &[]);
        }
        self.pop(self.bytes.len().saturating_sub(before));
        for (_, row) in (0..).zip(&tails.tokens).filter(|(tail, _)| open.is_allowed(*tail)) {
            row.within.iter().for_each(|token| set.allow_token(*token));
            if pos > 0 {
                row.bare.iter().chain(&row.dollars).for_each(|token| set.allow_token(*token));
            }
        }
    }

    /// Removes the tokens with which the text, of `pos` bytes so far, would be too long.
    fn exclude_long(&mut self, tokens: &Tokens, pos: usize, set: &mut SimpleVob) {
        let left = MAX_TEXT_CHARS.saturating_sub(pos);
        let long = tokens.by_length.iter().take_while(|token| tokens.trie.token_len(**token) >= left);
        for token in long.filter(|token| set.is_allowed(**token)).copied().collect::<Vec<_>>() {
            let (bytes, before) = (tokens.trie.token(token), self.bytes.len());
            // It may end the text earlier; a single brace at its end asks for one more.
            let is_open = bytes.iter().any(|byte| *byte == b'"' || is_brace(*byte));
            let is_plain = bytes.len() == left && !is_open;
            let fits = is_plain || is_open && bytes.iter().all(|byte| self.push(*byte));
            self.pop(self.bytes.len().saturating_sub(before));
            if !fits {
                set.disallow_token(token);
            }
        }
    }

    /// Removes the tokens that make the name so far, behind `lead`, a taken name of the greatest length. Such
    /// a name could not become another one.
    fn exclude_taken(&self, tokens: &Tokens, set: &mut SimpleVob, lead: &[u8]) {
        let state = self.state();
        let Op::Name(naming) = self.context.automaton.op(state.op) else { return };
        let begun = self.bytes.get(self.bytes.len().saturating_sub(state.pos as usize)..).unwrap_or_default();
        let bytes = |start: u32, len: u32| self.bytes.get(start as usize..(start + len) as usize);
        let bound = self
            .arenas
            .in_scope(naming.scope(state.scope))
            .filter(|(_, name)| !name.is_free)
            .filter_map(|(_, name)| bytes(name.start, name.len));
        let taken = self.context.automaton.taken.iter().map(|name| name.as_bytes());
        for name in bound.chain(taken).filter(|name| name.len() == MAX_NAME_CHARS) {
            let rest = name.strip_prefix(begun).and_then(|rest| tokens.trie.token_id(&[lead, rest].concat()));
            rest.into_iter().for_each(|token| set.disallow_token(token));
        }
    }

    /// Adds the tokens that may follow where most may not.
    fn mask_few(&mut self, tokens: &Tokens, set: &mut SimpleVob) {
        let tree = &tokens.tree;
        let Some(root) = tree.root() else { return };
        let number = self.number();
        if let Some((range, digits)) = number {
            tree.numbers(&range, digits).iter().for_each(|token| set.allow_token(*token));
        }
        let is_named = self.mask_spaced_name(tokens, set);
        let is_left = |child: &Node| !(number.is_some() && child.is_number || is_named && child.byte == b' ');
        self.tokens_from(tree, root, is_left, set);
    }

    /// Adds the tokens that begin with a space before a name; `false` if no name follows.
    fn mask_spaced_name(&mut self, tokens: &Tokens, set: &mut SimpleVob) -> bool {
        let before = self.bytes.len();
        if self.context.automaton.subset.syntax == Syntax::Json || !self.push(b' ') {
            return false;
        }
        let names = match self.free_text(tokens.longest) {
            Some(Free::Name { pos: 0, most }) => tokens.spaced_names.get(most),
            _ => None,
        };
        if let Some(names) = names {
            set.or(names);
            self.exclude_taken(tokens, set, b" ");
            tokens.spaced_name_ends.add_bias(&mut Stepper(self), set, b" ");
        }
        // The trie leaves the bytes of the prefix on the machine.
        self.pop(self.bytes.len().saturating_sub(before));
        names.is_some()
    }

    /// The range and the digits so far, if a number begins or goes on here.
    fn number(&mut self) -> Option<(NumberRange, Digits)> {
        let state = self.state();
        let context = Arc::clone(&self.context);
        let automaton = &context.automaton;
        match automaton.op(state.op) {
            Op::Number(range) => Some((self.range_of(&state, *range), state.digits())),
            // The number may be that of a step that is not in the log yet.
            Op::Fork { .. } if self.least_hold(&state).is_some() => None,
            Op::Fork { other, .. } => match automaton.behind_actions(*other) {
                Op::Number(range) => Some((*range, Digits::default())),
                Op::Fork { other, .. } => match automaton.op(*other) {
                    Op::Number(range) => Some((*range, Digits::default())),
                    _ => None,
                },
                _ => None,
            },
            _ => None,
        }
    }

    /// Adds the tokens below a node of the tree, through the children that are wanted.
    fn tokens_from(&mut self, tree: &Tree, node: &Node, wanted: impl Fn(&Node) -> bool, set: &mut SimpleVob) {
        let children = tree.children(node);
        let seen = if children.len() > MANY { self.candidate_bytes() } else { ByteSet::ALL };
        for child in children {
            if !seen.has(child.byte) || !wanted(child) || !self.push(child.byte) {
                continue;
            }
            if let Some(token) = child.token() {
                set.allow_token(token);
            }
            // A token has at most `LONGEST_TOKEN` bytes, which bounds the recursion.
            if child.has_children() {
                self.below(tree, child, set);
            }
            self.pop(1);
        }
    }

    fn below(&mut self, tree: &Tree, node: &Node, set: &mut SimpleVob) {
        self.tokens_from(tree, node, |_| true, set);
    }
}

/// For more children than this the candidate bytes are computed first.
const MANY: usize = 4;

/// An adapter by which `toktrie` walks the machine through its trie.
struct Stepper<'w>(&'w mut Machine);

impl Recognizer for Stepper<'_> {
    fn pop_bytes(&mut self, num: usize) {
        self.0.pop(num);
    }

    fn collapse(&mut self) {}

    fn trie_finished(&mut self) {}

    fn try_push_byte(&mut self, byte: u8) -> bool {
        self.0.push(byte)
    }
}
