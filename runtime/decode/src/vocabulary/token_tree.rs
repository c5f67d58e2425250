//! The tokens as a tree whose siblings stand side by side: looking for the few of them that may follow reads little memory. And
//! the tokens that are digits, which depend on nothing but the number so far.

use std::sync::{Arc, Mutex, PoisonError};

use rustc_hash::FxHashMap;
use toktrie::{TokTrie, TrieNode};

use crate::acceptor::Digits;
use crate::subset::NumberRange;

/// A byte of tokens.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// Where its children begin.
    first: u32,
    count: u16,
    pub(crate) byte: u8,
    /// Whether this and all that is below it is what numbers are written with.
    pub(crate) is_number: bool,
    /// The token that ends here; none is [`NO_TOKEN`].
    token: u32,
}

/// The tokens, the root first, then level by level.
#[derive(Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    numbers: Mutex<FxHashMap<Number, Arc<[u32]>>>,
}

/// A range, by its bounds and decimals, and the digits so far.
type Number = ((i64, i64, u8), Digits);

const NO_TOKEN: u32 = u32::MAX;

/// Numbers beyond this many are forgotten, all at once.
const MOST_NUMBERS: usize = 1 << 10;

impl Node {
    pub(crate) fn token(&self) -> Option<u32> {
        (self.token != NO_TOKEN).then_some(self.token)
    }

    pub(crate) fn has_children(&self) -> bool {
        self.count > 0
    }
}

impl Tree {
    /// The tree of a trie. O(nodes).
    pub(crate) fn new(trie: &TokTrie) -> Self {
        let mut order: Vec<&TrieNode> = vec![trie.root()];
        let mut nodes: Vec<Node> = Vec::new();
        while let Some(node) = order.get(nodes.len()).copied() {
            let first = order.len();
            order.extend(trie.node_children(node));
            let count = u16::try_from(order.len() - first).unwrap_or(u16::MAX);
            let byte = node.byte();
            let is_number = byte.is_ascii_digit() || byte == b'.' || byte == b'-';
            let token = node.token_id().unwrap_or(NO_TOKEN);
            let first = u32::try_from(first).unwrap_or(u32::MAX);
            nodes.push(Node { first, count, byte, is_number, token });
        }
        for index in (1..nodes.len()).rev() {
            let Some(node) = nodes.get(index) else { continue };
            let begins = node.first as usize;
            let below = nodes.get(begins..begins + usize::from(node.count)).unwrap_or_default();
            let is_number = node.is_number && below.iter().all(|node| node.is_number);
            if let Some(node) = nodes.get_mut(index) {
                node.is_number = is_number;
            }
        }
        Self { nodes, numbers: Mutex::default() }
    }

    /// Where every token begins.
    pub(crate) fn root(&self) -> Option<&Node> {
        self.nodes.first()
    }

    pub(crate) fn children(&self, node: &Node) -> &[Node] {
        let first = node.first as usize;
        self.nodes.get(first..first + usize::from(node.count)).unwrap_or_default()
    }

    /// The tokens that are nothing but digits with which a number of a range may go on, of the children of the root that
    /// [`Node::is_number`] tells of.
    pub(crate) fn numbers(&self, range: &NumberRange, digits: Digits) -> Arc<[u32]> {
        let key = ((range.least, range.greatest, range.decimals), digits);
        let lock = || self.numbers.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = lock().get(&key) {
            return Arc::clone(found);
        }
        let mut found = Vec::new();
        let mut open: Vec<(&Node, Digits)> = Vec::new();
        open.extend(self.root().map(|root| (root, digits)));
        while let Some((node, digits)) = open.pop() {
            for child in self.children(node).iter().filter(|child| child.is_number) {
                if let Some(next) = digits.push(child.byte, range) {
                    found.extend(child.token());
                    open.push((child, next));
                }
            }
        }
        let found: Arc<[u32]> = found.into();
        let mut numbers = lock();
        if numbers.len() >= MOST_NUMBERS {
            numbers.clear();
        }
        numbers.insert(key, Arc::clone(&found));
        found
    }
}
