//! The pages behind `motet explain`: one a code, with a failing example and the mended one, both run as tests.

use motet_syntax::Code;

/// A code's page.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// The code.
    pub code: &'static str,
    /// Markdown: what it means, an example that raises it, and one that does not.
    pub text: &'static str,
}

macro_rules! pages {
    ($($code:literal)*) => {
        &[$(Page { code: $code, text: include_str!(concat!("../codes/", $code, ".md")) }),*]
    };
}

/// All pages, in the order of their codes.
pub const PAGES: &[Page] = pages! {};

/// The page of a code; letter case does not matter.
#[must_use]
pub fn page(code: &str) -> Option<&'static Page> {
    PAGES.iter().find(|page| page.code.eq_ignore_ascii_case(code))
}

/// Every code that the front end, the cards, the scenes and the compiler can raise.
#[must_use]
pub fn all() -> Vec<Code> {
    let stages = [
        motet_syntax::errors::CODES,
        crate::resolve::errors::CODES,
        crate::world::CODES,
        crate::check::errors::CODES,
        crate::prove::errors::CODES,
    ];
    let mut codes: Vec<_> = stages.into_iter().flatten().copied().collect();
    codes.sort_unstable();
    codes
}
