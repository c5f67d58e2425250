//! llguidance on the exported grammar.

use llguidance::api::TopLevelGrammar;
use llguidance::toktrie::{ApproximateTokEnv, TokEnv, TokRxInfo, TokTrie};
use llguidance::{Matcher, ParserFactory};
use motet_compiler::Session;
use motet_decode::Subset;
use motet_decode::export::{Format, Header, export};

/// The tokens of a model as llguidance takes them; special ones have no bytes.
pub fn environment(tokens: &[Vec<u8>], end: u32) -> TokEnv {
    let size = u32::try_from(tokens.len()).unwrap();
    std::sync::Arc::new(ApproximateTokEnv::new(TokTrie::from(&TokRxInfo::new(size, end), tokens)))
}

/// The engine at the beginning of a policy.
pub struct Peer(Matcher);

impl Peer {
    /// The engine on the grammar in Lark, the one notation with all bounds of the surface.
    pub fn new(environment: &TokEnv, session: &Session, surface: Subset) -> Self {
        let lark = export(&session.signatures(), surface, Format::Lark, Header::Llguidance).unwrap();
        let factory = ParserFactory::new_simple(environment).unwrap();
        let matcher = Matcher::new(factory.create_parser(TopLevelGrammar::from_lark(lark)));
        assert!(!matcher.is_error(), "{:?}", matcher.get_error());
        Self(matcher)
    }

    /// A policy that nothing was written of yet.
    pub fn start(&self) -> Matcher {
        self.0.deep_clone()
    }
}
