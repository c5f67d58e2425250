//! Grammars of the canonical subset for servers that constrain a model.
//!
//! All are derived from one [`Grammar`](crate::Grammar): [`json_schema`] and [`ebnf`] leave out the actions
//! and guards of the automaton and write recursion out to the depth of the subset, so that whatever a model
//! writes comes to an end. GBNF, Lark and ISO EBNF are notations of the latter.
//!
//! A grammar cannot know what is in scope: a binding is any name. A policy that it generates parses, and is
//! right in names and types but for that.

mod derive;
mod ebnf;
mod notation;
mod schema;
mod terminal;

pub use ebnf::{EbnfExpr, EbnfGrammar, EbnfRule, RuleId};
pub use notation::Header;

use motet_syntax::Syntax;
use serde_json::Value;

use crate::Grammar;

/// A notation of a grammar.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Format {
    /// JSON Schema, in the subset that all servers take; for the JSON syntax only.
    JsonSchema,
    /// The notation of llama.cpp, which xgrammar takes too.
    Gbnf,
    /// Lark, as llguidance takes it.
    Lark,
    /// EBNF after ISO/IEC 14977: no character classes and no regular expressions.
    RegexFreeEbnf,
}

/// Writes a grammar in a notation; `None` for a JSON Schema of the text syntax. `header` is used by Lark
/// only.
///
/// The same grammar gives the same bytes. O(declarations + entities) for each level of the subset's depth.
///
/// ```
/// use motet_decode::export::{Format, Header, export};
/// use motet_decode::{Environment, Grammar, Subset};
///
/// let texts = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() };
/// let session = texts.session()?;
/// let grammar = Grammar::new(&session.signatures(), Subset::default());
/// let gbnf = export(&grammar, Format::Gbnf, Header::None).expect("GBNF takes both syntaxes");
/// assert!(gbnf.starts_with("root ::= "));
/// # Ok::<(), motet_decode::EnvironmentError>(())
/// ```
#[must_use]
pub fn export(grammar: &Grammar, format: Format, header: Header) -> Option<String> {
    Some(match format {
        // A value of maps, lists and strings always has a JSON syntax.
        Format::JsonSchema => serde_json::to_string_pretty(&json_schema(grammar)?).unwrap_or_default() + "\n",
        Format::Gbnf => notation::gbnf(&ebnf(grammar)),
        Format::Lark => notation::lark(&ebnf(grammar), header),
        Format::RegexFreeEbnf => notation::iso_ebnf(&ebnf(grammar)),
    })
}

/// Derives the JSON Schema of a grammar; `None` for the text syntax.
#[must_use]
pub fn json_schema(grammar: &Grammar) -> Option<Value> {
    (grammar.subset.syntax == Syntax::Json).then(|| schema::schema(grammar))
}

/// Derives the context-free grammar without recursion, character by character.
#[must_use]
pub fn ebnf(grammar: &Grammar) -> EbnfGrammar {
    derive::ebnf(grammar)
}
