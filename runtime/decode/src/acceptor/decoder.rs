//! From bytes to tokens: which of a vocabulary may follow.

use motet_syntax::Syntax;
use toktrie::{Recognizer, SimpleVob};

use super::byte_set::ByteSet;
use super::digits::Digits;
use super::machine::Machine;
use super::{Acceptor, AcceptorFactory};
use crate::automaton::Op;
use crate::subset::{MAX_NAME_CHARS, MAX_TEXT_CHARS, NumberRange};
use crate::vocabulary::{Node, Tokens, Tree, Vocabulary};

/// What may follow in a policy that is being written, token by token.
#[derive(Clone, Debug)]
pub struct Decoder {
    vocabulary: Vocabulary,
    acceptor: Acceptor,
    /// How many bytes there were before each token.
    before: Vec<usize>,
    is_over: bool,
    set: Mask,
}

#[derive(Clone)]
struct Mask(SimpleVob);

impl std::fmt::Debug for Mask {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Mask({} of {})", self.0.num_set(), self.0.len())
    }
}

impl AcceptorFactory {
    /// A decoder for a policy of at most `budget` bytes; none where no policy is that short.
    #[must_use]
    pub fn decoder(&self, vocabulary: &Vocabulary, budget: usize) -> Option<Decoder> {
        let set = Mask(vocabulary.tokens().trie.alloc_token_set());
        let (vocabulary, before) = (vocabulary.clone(), Vec::new());
        Some(Decoder { vocabulary, acceptor: self.acceptor(budget)?, before, is_over: false, set })
    }
}

impl Decoder {
    /// Which tokens may follow, one a bit, the lowest first. After the end none may.
    pub fn mask(&mut self) -> &[u32] {
        let Self { vocabulary, acceptor, set, is_over, .. } = self;
        let set = &mut set.0;
        set.set_all(false);
        if *is_over {
            return set.as_slice();
        }
        let tokens = vocabulary.tokens();
        let machine = &mut acceptor.machine;
        let mark = machine.mark();
        match machine.free_text(tokens.longest) {
            Some(Free::Text { pos }) => machine.mask_text(tokens, pos, set),
            Some(Free::Name { pos, most }) => {
                let names = if pos == 0 { &tokens.first_names } else { &tokens.names };
                if let Some(names) = names.get(most) {
                    set.or(names);
                }
                let ends = match machine.context.automaton.subset.syntax {
                    Syntax::Json => &tokens.name_ends,
                    Syntax::Text => &tokens.bare_name_ends,
                };
                ends.add_bias(&mut Stepper(machine), set, &[]);
            }
            None => machine.mask_few(tokens, set),
        }
        machine.restore(mark);
        for (twin, first) in &tokens.twins {
            if set.is_allowed(*first) {
                set.allow_token(*twin);
            }
        }
        if acceptor.is_accepting() {
            set.allow_token(tokens.end);
        }
        set.as_slice()
    }

    /// Takes a token, where it may follow.
    pub fn accept(&mut self, token: u32) -> bool {
        let before = self.acceptor.bytes().len();
        let tokens = self.vocabulary.tokens();
        if self.is_over {
            return false;
        }
        if token == tokens.end {
            self.is_over = self.acceptor.is_accepting();
            if self.is_over {
                self.before.push(before);
            }
            return self.is_over;
        }
        let bytes = self.vocabulary.bytes(token);
        let taken = self.acceptor.accept(bytes);
        if bytes.is_empty() || taken < bytes.len() {
            self.acceptor.forget(taken);
            return false;
        }
        self.before.push(before);
        true
    }

    /// Takes back the last tokens.
    pub fn rollback(&mut self, tokens: usize) {
        for _ in 0..tokens {
            let Some(before) = self.before.pop() else { return };
            let bytes = self.acceptor.bytes().len().saturating_sub(before);
            self.acceptor.forget(bytes);
            self.is_over = false;
        }
    }

    /// The acceptor of the bytes.
    pub fn acceptor(&mut self) -> &mut Acceptor {
        &mut self.acceptor
    }
}

/// Where nearly all may follow.
#[derive(Clone, Copy, Debug)]
enum Free {
    /// So many bytes in.
    Text { pos: usize },
    /// So many bytes in, with room for at most so many.
    Name { pos: usize, most: usize },
}

impl Machine {
    /// Whether the machine is in a text or a name, with room for any token.
    fn free_text(&self, longest: usize) -> Option<Free> {
        let state = self.state();
        let automaton = &self.context.automaton;
        let text = |op| matches!(automaton.op(op), Op::Text { .. });
        let pos = state.pos as usize;
        let (free, op) = match automaton.op(state.op) {
            Op::Text { .. } if pos + longest <= MAX_TEXT_CHARS => (Free::Text { pos }, state.op),
            Op::Fork { byte: b'$', other, .. } if text(*other) => (Free::Text { pos }, *other),
            Op::Name(_) => {
                // Where a name of the greatest length is taken, one byte is kept to become another.
                let bound = self.arenas.in_scope(state.scope).map(|(_, name)| name.len as usize);
                let taken = automaton.taken.iter().map(|name| name.len());
                let reserved = usize::from(bound.chain(taken).any(|len| len == MAX_NAME_CHARS));
                let most = MAX_NAME_CHARS.saturating_sub(pos + reserved);
                (Free::Name { pos, most }, state.op)
            }
            _ => return None,
        };
        self.fits(longest.max(MAX_NAME_CHARS) + 4, op + 1, state.frame).then_some(free)
    }
}

impl Machine {
    /// The tokens that may follow where a text goes on.
    fn mask_text(&mut self, tokens: &Tokens, pos: usize, set: &mut SimpleVob) {
        set.or(&tokens.text);
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
        // Any character of a text: one is there where it ends.
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

    /// The tokens that may follow where most may not.
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

    /// The tokens that begin with a space, where a name follows it that has room for any of them; false where none does.
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
            tokens.spaced_name_ends.add_bias(&mut Stepper(self), set, b" ");
        }
        // Behind a prefix the trie leaves the last bytes where they are.
        self.pop(self.bytes.len().saturating_sub(before));
        names.is_some()
    }

    /// The range and the digits so far, where a number is what comes or goes on, whatever else may.
    fn number(&self) -> Option<(NumberRange, Digits)> {
        let state = self.state();
        let automaton = &self.context.automaton;
        match automaton.op(state.op) {
            Op::Number(range) if state.pos == 0 => Some((*range, Digits::default())),
            Op::Number(range) => Some((*range, Digits::unpack((state.pos, state.lo, state.hi)))),
            Op::Fork { other, .. } => match automaton.op(*other) {
                Op::Number(range) => Some((*range, Digits::default())),
                _ => None,
            },
            _ => None,
        }
    }

    /// The tokens below a node of the tree, by those of its children that are asked for.
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
            // A token has at most `LONGEST_TOKEN` bytes, and so many levels this goes down.
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

/// More children than this are worth a look at what may come.
const MANY: usize = 4;

/// Steps through a trie of tokens.
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
