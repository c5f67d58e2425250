//! Names of PDDL as names of Motet. Any name may stand in back-quotes, so most stay as they are; those that
//! would mean something else get a `_` at their end.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use motet_syntax::ast::{Item, Name};
use motet_syntax::words::is_json_key;
use motet_syntax::{FileId, Source, Span};
use smol_str::{SmolStr, format_smolstr};

use crate::typed::TypedName;

/// Entities that always exist, and the word for all of them.
const ENTITY_TAKEN: [&str; 6] = ["robot", "user", "start", "any", "true", "false"];

/// Name of a parameter. `on` is free in Motet, yet `result` is not.
pub(crate) fn param(text: &str, span: Span, constants: &[TypedName]) -> Name {
    if constants.iter().any(|constant| constant.name == text) {
        // In PDDL `?depot` and `depot` are two names.
        return Name { text: format_smolstr!("{text}__"), span };
    }
    let is_taken = is_json_key(text) || text == "result" || ENTITY_TAKEN.contains(&text);
    suffixed(text, is_taken, span)
}

/// Name of an object.
pub(crate) fn entity(text: &str, span: Span) -> Name {
    suffixed(text, ENTITY_TAKEN.contains(&text), span)
}

/// Name of a predicate. One of the standard library cannot be declared anew with other parameters: its
/// primitives use it.
pub(crate) fn fluent(text: &str, span: Span) -> Name {
    suffixed(text, standard_fluents().contains(text) || text == "monitored", span)
}

/// Name of a type. Kinds of the standard library begin with a capital letter, and types of PDDL with a small
/// one.
pub(crate) fn kind(text: &str, span: Span) -> Name {
    Name { text: text.into(), span }
}

fn suffixed(text: &str, is_taken: bool, span: Span) -> Name {
    // One more `_` for each that is there already, so that two names never become one.
    let is_taken = is_taken || {
        let bare = text.trim_end_matches('_');
        bare != text
            && (ENTITY_TAKEN.contains(&bare)
                || is_json_key(bare)
                || bare == "on"
                || standard_fluents().contains(bare))
    };
    let text = if is_taken { SmolStr::from(format!("{text}_")) } else { text.into() };
    Name { text, span }
}

/// Fluents and measures of the standard library.
fn standard_fluents() -> &'static BTreeSet<SmolStr> {
    static NAMES: OnceLock<BTreeSet<SmolStr>> = OnceLock::new();
    NAMES.get_or_init(|| {
        let files = motet_stdlib::FILES.iter().map(|(name, text)| Source::new(*name, *text));
        let items = files.flat_map(|source| motet_syntax::read(&source, FileId(0)).file.items);
        items
            .filter_map(|item| match item {
                Item::Fluent(decl) => Some(decl.name.text),
                Item::Measure(decl) => Some(decl.name.text),
                Item::Kind(_)
                | Item::Failure(_)
                | Item::Enum(_)
                | Item::Primitive(_)
                | Item::Policy(_)
                | Item::Entities(_)
                | Item::Initially(_)
                | Item::ClosedWorld(_) => None,
            })
            .collect()
    })
}
