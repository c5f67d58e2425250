//! WordList: names of the library and of the world with what they mean, in the order of their bytes.

use motet_compiler::draft::Value;
use motet_compiler::signature::Signatures;
use smol_str::SmolStr;

use super::{Guard, OpId};
use crate::subset::is_text_char;

/// A list of words in the order of the bytes that spell them, the closing quote among them.
#[derive(Clone, Debug, Default)]
pub(crate) struct WordTable {
    pub(crate) entries: Vec<Entry>,
}

/// A word.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) name: SmolStr,
    pub(crate) meaning: Meaning,
    /// Where to go on; none where the choice says so.
    pub(crate) to: Option<OpId>,
    /// When it is open, where the list is one of keywords.
    pub(crate) guard: Guard,
}

/// What a word means.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Meaning {
    /// An entity of the world, by its number.
    Entity(u16),
    /// A case of an enumeration.
    Case(u16, u16),
    /// `any`
    Any,
    /// What its name says, and which of them.
    Named(u16),
}

impl Meaning {
    /// What a value, or a kind of failure, is called, however it is spelled.
    pub(crate) fn name(self, signatures: &Signatures) -> Option<SmolStr> {
        match self {
            Self::Entity(index) => signatures.entities.get(usize::from(index)).map(|row| row.0.clone()),
            Self::Case(of, case) => {
                signatures.enums.get(usize::from(of))?.cases.get(usize::from(case)).cloned()
            }
            Self::Named(index) => signatures.failures.get(usize::from(index)).cloned(),
            Self::Any => None,
        }
    }

    /// As an argument; none of what is no value.
    pub(crate) fn value(self) -> Value {
        match self {
            Self::Entity(index) => Value::entity(index),
            Self::Case(of, case) => Value::case(of, case),
            Self::Any | Self::Named(_) => Value::unknown(),
        }
    }
}

impl WordTable {
    /// A table of such entries; a name that cannot be spelled is left out.
    pub(crate) fn new(entries: impl IntoIterator<Item = Entry>) -> Self {
        let spelled = |entry: &Entry| {
            !entry.name.is_empty() && !entry.name.starts_with('$') && entry.name.chars().all(is_text_char)
        };
        let mut entries: Vec<Entry> = entries.into_iter().filter(spelled).collect();
        entries.sort_by(|a, b| a.name.bytes().chain([b'"']).cmp(b.name.bytes().chain([b'"'])));
        entries.dedup_by(|a, b| a.name == b.name);
        Self { entries }
    }

    /// The entities of a kind and of those below it.
    pub(crate) fn of_kind(signatures: &Signatures, kind: usize) -> Self {
        Self::new(signatures.entities.iter().enumerate().filter_map(|(index, (name, of))| {
            let meaning = Meaning::Entity(u16::try_from(index).ok()?);
            signatures.is_kind(*of, kind).then(|| Entry {
                name: name.clone(),
                meaning,
                to: None,
                guard: Guard::Open,
            })
        }))
    }

    /// The cases of an enumeration.
    pub(crate) fn of_cases(signatures: &Signatures, id: usize) -> Self {
        let cases = signatures.enums.get(id).map(|def| def.cases.as_slice()).unwrap_or_default();
        Self::new(cases.iter().enumerate().filter_map(|(index, name)| {
            let meaning = Meaning::Case(u16::try_from(id).ok()?, u16::try_from(index).ok()?);
            Some(Entry { name: name.clone(), meaning, to: None, guard: Guard::Open })
        }))
    }

    /// The same and `any`.
    pub(crate) fn with_any(&self) -> Self {
        let name = SmolStr::new_static("any");
        let any = Entry { name, meaning: Meaning::Any, to: None, guard: Guard::Open };
        let others = self.entries.iter().filter(|entry| entry.name != "any").cloned();
        Self::new(others.chain([any]))
    }

    pub(crate) fn get(&self, index: u32) -> Option<&Entry> {
        self.entries.get(index as usize)
    }
}
