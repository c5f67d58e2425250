//! Grammars of the model subset, for servers that hold a model to one.
//!
//! All are generated from one [`Offer`]: what the signatures and the world allow at each place. The JSON form becomes a
//! tree of [`Shape`]s, of which the JSON Schema is printed; shapes and the text form become one [`Grammar`] of literals,
//! character classes and bounded repetition, of which GBNF, Lark and EBNF are printed. Nothing recurses: blocks and
//! conditions are written out to the depth of the subset, so whatever a model writes comes to an end.
//!
//! A grammar cannot know what is in scope: a binding is any name. What it generates is read without a mistake, and is right
//! in names and types but for that.

mod class;
mod compact;
mod ebnf;
mod gbnf;
mod grammar;
mod lark;
mod limits;
mod notation;
mod number;
mod offer;
mod request;
mod schema;
mod shape;
mod text;
mod value_set;

pub use grammar::{Expr, Grammar, Rule, RuleId};
pub use lark::Header;
pub use limits::{Warning, warnings};
pub use offer::Offer;
pub use request::{
    Dialect, Prompt, lark_constraint, probe_body, request_body, request_constraint, schema_of,
};
pub use shape::{Shape, Shapes};

use motet_compiler::Signatures;
use motet_syntax::Syntax;

use crate::subset::Subset;

/// A notation of a grammar.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Format {
    /// JSON Schema, in the subset that all servers take; only of the JSON form.
    JsonSchema,
    /// The notation of llama.cpp, which xgrammar takes too.
    Gbnf,
    /// Lark, as llguidance takes it.
    Lark,
    /// EBNF after ISO/IEC 14977: no character classes and no regular expressions.
    RegexFreeEbnf,
}

/// The grammar of a subset in a notation; none where the notation cannot say the form, which is a JSON Schema for text.
/// The same input gives the same bytes. O(declarations + entities) for each level of the subset's depth.
#[must_use]
pub fn export(signatures: &Signatures, subset: Subset, format: Format, header: Header) -> Option<String> {
    let offer = Offer::new(signatures, subset);
    match format {
        Format::JsonSchema => {
            let schema = schema_of(&offer)?;
            // A value of maps, lists and strings always has a JSON form.
            Some(serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n")
        }
        Format::Gbnf => Some(gbnf::print(&grammar(&offer))),
        Format::Lark => Some(lark::print(&grammar(&offer), header)),
        Format::RegexFreeEbnf => Some(ebnf::print(&grammar(&offer))),
    }
}

/// The grammar of an offer, character by character.
#[must_use]
pub fn grammar(offer: &Offer) -> Grammar {
    match offer.subset.syntax {
        Syntax::Json => compact::grammar(&Shapes::new(offer)),
        Syntax::Text => text::grammar(offer),
    }
}
