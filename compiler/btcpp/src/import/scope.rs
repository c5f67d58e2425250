//! Blackboards: the names of entries in one tree, and what they are called in the policy.

use std::collections::BTreeMap;
use std::rc::Rc;

use smol_str::{SmolStr, format_smolstr};

/// Blackboard of a tree.
#[derive(Clone)]
pub(super) struct Scope(Rc<Board>);

struct Board {
    /// Stem of the names of entries that are this tree's own; empty in the main tree.
    stem: SmolStr,
    /// Ports that the call of the tree maps.
    ports: BTreeMap<SmolStr, Entry>,
    /// Blackboard of the tree that calls this one, where all other names are the same there.
    shared: Option<Scope>,
}

/// Meaning of a name on a blackboard.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Entry {
    /// A binding of the policy.
    Binding(SmolStr),
    /// The text that a call of the tree has given.
    Text(SmolStr),
}

impl Scope {
    pub(super) fn main() -> Self {
        Self(Rc::new(Board { stem: SmolStr::default(), ports: BTreeMap::new(), shared: None }))
    }

    /// Blackboard of a tree that is called from this one.
    pub(super) fn called(
        &self,
        tree: &str,
        ports: BTreeMap<SmolStr, Entry>,
        shares: bool,
        number: usize,
    ) -> Self {
        let stem = format_smolstr!("{tree}_{number}_");
        Self(Rc::new(Board { stem, ports, shared: shares.then(|| self.clone()) }))
    }

    pub(super) fn entry(&self, name: &str) -> Entry {
        if let Some(mapped) = self.0.ports.get(name) {
            return mapped.clone();
        }
        match &self.0.shared {
            Some(caller) if !name.starts_with('_') => caller.entry(name),
            _ => Entry::Binding(format_smolstr!("{}{name}", self.0.stem)),
        }
    }
}

/// Name of the entry that the text of a port refers to; none for a constant.
pub(super) fn pointer<'a>(port: &'a str, text: &'a str) -> Option<&'a str> {
    let bare = text.trim_matches(' ');
    if bare == "=" || bare == "{=}" {
        return Some(port);
    }
    let inner = bare.strip_prefix('{')?.strip_suffix('}')?;
    (!inner.is_empty()).then_some(inner)
}
