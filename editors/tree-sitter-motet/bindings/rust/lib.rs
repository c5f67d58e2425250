#![doc = include_str!("../../README.md")]

use tree_sitter_language::LanguageFn;

// SAFETY: the generated parser defines this function with this signature.
unsafe extern "C" {
    fn tree_sitter_motet() -> *const ();
}

/// The language, for a parser of the crate `tree-sitter`.
// SAFETY: the function returns the language that the generated parser defines.
pub const LANGUAGE: LanguageFn = unsafe { LanguageFn::from_raw(tree_sitter_motet) };

/// Query for highlighting.
pub const HIGHLIGHTS_QUERY: &str = include_str!("../../queries/highlights.scm");

/// Query for folds.
pub const FOLDS_QUERY: &str = include_str!("../../queries/folds.scm");

/// Query for indentation, with the captures of nvim-treesitter.
pub const INDENTS_QUERY: &str = include_str!("../../queries/indents.scm");
