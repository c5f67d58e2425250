//! Spans of the names and bounds of a card that the compiler checks against the library.

use indexmap::IndexMap;
use motet_syntax::unit::Dimension;
use motet_syntax::{FileId, Span};
use smol_str::SmolStr;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// CardSpans in a card. They are no part of what the robot is, so any two are equal.
#[derive(Clone, Debug, Default)]
pub struct CardSpans {
    /// Name of `primitives.motet` in diagnostics.
    pub declarations: SmolStr,
    /// Names under `observes`.
    pub observes: IndexMap<SmolStr, Span>,
    /// Keys under `[primitives]`.
    pub primitives: IndexMap<SmolStr, Span>,
    /// Bounds of each parameter, by primitive and parameter.
    pub bounds: IndexMap<(SmolStr, SmolStr), BoundSpan>,
    /// Facts under `initially`, in order.
    pub initially: Vec<Span>,
}

/// Bounds of a parameter as written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct BoundSpan {
    pub span: Span,
    /// Dimension of their unit; `None` for bare numbers.
    pub dimension: Option<Dimension>,
}

impl PartialEq for CardSpans {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Keys under `[primitives]`, each with its parameters.
pub(super) fn primitives(
    document: &Spanned<DeTable<'_>>,
    file: FileId,
) -> IndexMap<SmolStr, (Span, IndexMap<SmolStr, Span>)> {
    let listed = keys(document.get_ref().get("primitives").map(Spanned::get_ref), file);
    listed.into_iter().map(|(name, span, value)| (name, (span, params(value, file)))).collect()
}

fn params(bounds: &DeValue<'_>, file: FileId) -> IndexMap<SmolStr, Span> {
    keys(Some(bounds), file).into_iter().map(|(name, span, _)| (name, span)).collect()
}

fn keys<'d, 'i>(section: Option<&'d DeValue<'i>>, file: FileId) -> Vec<(SmolStr, Span, &'d DeValue<'i>)> {
    let Some(DeValue::Table(table)) = section else { return Vec::new() };
    let key = |(key, value): (&'d Spanned<std::borrow::Cow<'i, str>>, &'d Spanned<DeValue<'i>>)| {
        let range = key.span();
        (SmolStr::new(key.get_ref()), Span::new(file, range.start, range.end), value.get_ref())
    };
    table.iter().map(key).collect()
}

/// Name of the declarations file beside a card.
pub(super) fn beside(card: &str, robot: &str) -> SmolStr {
    match card.strip_suffix("robot.toml") {
        Some(folder) if !folder.is_empty() => SmolStr::new(format!("{folder}primitives.motet")),
        Some(_) | None => SmolStr::new(format!("{robot}/primitives.motet")),
    }
}
