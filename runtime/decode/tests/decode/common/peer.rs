//! llguidance on the exported grammar.

use llguidance::api::TopLevelGrammar;
use llguidance::toktrie::{ApproximateTokEnv, TokEnv, TokRxInfo, TokTrie};
use llguidance::{Matcher, ParserFactory};
use motet_compiler::Session;
use motet_decode::export::{Format, Header, export, json_schema};
use motet_decode::{Grammar, Subset};

/// The tokens of a model as llguidance takes them; special ones have no bytes.
pub fn environment(tokens: &[Vec<u8>], end: u32) -> TokEnv {
    let size = u32::try_from(tokens.len()).unwrap();
    std::sync::Arc::new(ApproximateTokEnv::new(TokTrie::from(&TokRxInfo::new(size, end), tokens)))
}

/// The engine at the beginning of a policy.
pub struct Peer(Matcher);

impl Peer {
    /// The engine on the grammar in Lark, the one notation with all bounds of the subset.
    pub fn new(environment: &TokEnv, session: &Session, subset: Subset) -> Self {
        let lark =
            export(&Grammar::new(&session.signatures(), subset), Format::Lark, Header::Llguidance).unwrap();
        let factory = ParserFactory::new_simple(environment).unwrap();
        let matcher = Matcher::new(factory.create_parser(TopLevelGrammar::from_lark(lark)));
        assert!(!matcher.is_error(), "{:?}", matcher.get_error());
        Self(matcher)
    }

    /// The engine on the JSON Schema; none for the text syntax.
    pub fn of_schema(environment: &TokEnv, session: &Session, subset: Subset) -> Option<Self> {
        let schema = json_schema(&Grammar::new(&session.signatures(), subset))?;
        let factory = ParserFactory::new_simple(environment).unwrap();
        let matcher = Matcher::new(factory.create_parser(TopLevelGrammar::from_json_schema(schema)));
        assert!(!matcher.is_error(), "{:?}", matcher.get_error());
        Some(Self(matcher))
    }

    /// A policy that nothing was written of yet.
    pub fn start(&self) -> Matcher {
        self.0.deep_clone()
    }
}
