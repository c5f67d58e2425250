//! Where a card says what the compiler compares with the library: the names and the bounds that mean something only
//! beside declarations.

use indexmap::IndexMap;
use motet_syntax::unit::Dimension;
use motet_syntax::{FileId, Span};
use smol_str::SmolStr;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// CardSpans in a card. They are no part of what the robot is, so any two are equal.
#[derive(Clone, Debug, Default)]
pub struct CardSpans {
    /// The name of the card's `primitives.motet`, as diagnostics call it.
    pub declarations: SmolStr,
    /// Each name under `observes`.
    pub observes: IndexMap<SmolStr, Span>,
    /// Each key under `[primitives]`.
    pub primitives: IndexMap<SmolStr, Span>,
    /// The bounds of each parameter, by primitive and parameter.
    pub bounds: IndexMap<(SmolStr, SmolStr), BoundSpan>,
    /// Each fact under `initially`, in their order.
    pub initially: Vec<Span>,
}

/// The bounds of a parameter as they are written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct BoundSpan {
    /// Their key.
    pub span: Span,
    /// The dimension of their unit; none where both are bare numbers.
    pub dimension: Option<Dimension>,
}

impl PartialEq for CardSpans {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// The keys under `[primitives]`, and below each its parameters.
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

/// The name of the file of declarations beside a card.
pub(super) fn beside(card: &str, robot: &str) -> SmolStr {
    match card.strip_suffix("robot.toml") {
        Some(folder) if !folder.is_empty() => SmolStr::new(format!("{folder}primitives.motet")),
        Some(_) | None => SmolStr::new(format!("{robot}/primitives.motet")),
    }
}
