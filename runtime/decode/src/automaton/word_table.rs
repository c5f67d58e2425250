//! Tables of words: entities, cases and declared names, sorted by their bytes.

use motet_compiler::incremental::ArgumentValue;
use motet_compiler::signature::Signatures;
use smol_str::SmolStr;

use super::OpId;
use crate::grammar::Guard;
use crate::subset::is_text_char;

/// A list of words sorted by the bytes that spell them, the closing quote among them.
#[derive(Clone, Debug, Default)]
pub(crate) struct WordTable {
    pub(crate) entries: Vec<Word>,
}

/// A word of a table.
#[derive(Clone, Debug)]
pub(crate) struct Word {
    pub(crate) name: SmolStr,
    pub(crate) meaning: Meaning,
    /// The next operation, if it depends on the word.
    pub(crate) to: Option<OpId>,
    /// The guard of the word in a list of keywords.
    pub(crate) guard: Guard,
}

/// The meaning of a word.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Meaning {
    /// The entity with this number.
    Entity(u16),
    /// A case of an enumeration, by both numbers.
    Case(u16, u16),
    Any,
    /// The declaration with this number.
    Named(u16),
}

impl Meaning {
    /// The name of a value or of a kind of failure, as declared.
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

    /// The value of the checker; unknown if it is not a value.
    pub(crate) fn value(self) -> ArgumentValue {
        match self {
            Self::Entity(index) => ArgumentValue::entity(index),
            Self::Case(of, case) => ArgumentValue::case(of, case),
            Self::Any | Self::Named(_) => ArgumentValue::unknown(),
        }
    }
}

impl WordTable {
    /// A table of words; a name that cannot be spelled is left out.
    pub(crate) fn new(entries: impl IntoIterator<Item = Word>) -> Self {
        let spelled = |entry: &Word| {
            !entry.name.is_empty() && !entry.name.starts_with('$') && entry.name.chars().all(is_text_char)
        };
        let mut entries: Vec<Word> = entries.into_iter().filter(spelled).collect();
        entries.sort_by(|a, b| a.name.bytes().chain([b'"']).cmp(b.name.bytes().chain([b'"'])));
        entries.dedup_by(|a, b| a.name == b.name);
        Self { entries }
    }

    /// The entities of a kind and of those below it.
    pub(crate) fn of_kind(signatures: &Signatures, kind: usize) -> Self {
        Self::new(signatures.entities.iter().enumerate().filter_map(|(index, (name, of))| {
            let meaning = Meaning::Entity(u16::try_from(index).ok()?);
            (signatures.is_kind(*of, kind) && is_single(name)).then(|| Word {
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
        Self::new(cases.iter().enumerate().filter(|(_, name)| is_single(name)).filter_map(|(index, name)| {
            let meaning = Meaning::Case(u16::try_from(id).ok()?, u16::try_from(index).ok()?);
            Some(Word { name: name.clone(), meaning, to: None, guard: Guard::Open })
        }))
    }

    /// This table with `any`.
    pub(crate) fn with_any(&self) -> Self {
        let name = SmolStr::new_static("any");
        let any = Word { name, meaning: Meaning::Any, to: None, guard: Guard::Open };
        let others = self.entries.iter().filter(|entry| entry.name != "any").cloned();
        Self::new(others.chain([any]))
    }

    pub(crate) fn get(&self, index: u32) -> Option<&Word> {
        self.entries.get(index as usize)
    }
}

/// A name has no braces, which JSON would write twice.
fn is_single(name: &str) -> bool {
    !name.contains(['{', '}'])
}
