//! Random policies that behaviour trees can say, in a world whose actions fail by a seed. The same rules
//! stand in `tests/peers/btcpp/runner.cpp`, where BehaviorTree.CPP runs the exported trees.

use motet_compiler::Session;
use motet_graph::Graph;
use motet_syntax::{FileId, Source, Sources};

mod make;
mod world;

pub use make::policy_text;
pub use world::{Account, run};

/// Declarations of the world: lamps, whose light is a fact that can be observed, and their level, a measure.
pub const DOMAIN: &str = "\
entity lamp_1, lamp_2, lamp_3: Entity
failure jam
failure slip
fluent lit(what: Entity)
measure level(of: Entity) -> Number
action push(what: Entity, power: Number) takes 0 s .. 5 s fails jam, slip
action light(what: Entity) makes lit(what) takes 0 s .. 5 s fails jam
action dim(what: Entity) makes not lit(what) takes 0 s .. 5 s fails jam, slip
action use(what: Entity) needs lit(what) takes 0 s .. 5 s fails slip
perception find(what: Text) -> Entity takes 0 s .. 5 s fails jam
";

/// Number that a text gives, the same in every language: FNV-1a with 64 bits.
#[must_use]
pub fn hash(text: &str) -> u64 {
    text.bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// A policy with its tree, and what happens in the world of its seed.
#[derive(Clone, Debug)]
pub struct Case {
    pub seed: u64,
    pub text: String,
    pub tree: String,
    pub account: Account,
}

/// Session over [`DOMAIN`].
///
/// # Panics
///
/// If the declarations are wrong.
#[must_use]
pub fn session() -> Session {
    let mut sources = Sources::default();
    let source = Source::new("world.motet", DOMAIN);
    let id = sources.add(source.clone());
    let parsed = motet_syntax::read(&source, id);
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    let session = Session::builder().domains(&[parsed.file]).build(&mut sources);
    assert!(session.input_diagnostics().is_empty(), "{:?}", session.input_diagnostics());
    session
}

/// Graph of the policy `main` of a text and its tree; `None` where a check or the export refuses it.
#[must_use]
pub fn tree(session: &Session, text: &str) -> Option<(Graph, String)> {
    let parsed = motet_syntax::read(&Source::new("policy.motet", text), FileId(99));
    let graph = session.compile(&parsed, Some("main")).graph?;
    let policy = parsed.file.policies().find(|policy| policy.name.text == "main")?;
    let tree = motet_btcpp::export(&graph, policy, &session.tree_vocabulary(&parsed)).ok()?;
    Some((graph, tree))
}

/// Random policies that pass the check and do at least three actions.
pub fn cases() -> impl Iterator<Item = Case> {
    let session = session();
    (0..50_000).filter_map(move |seed| {
        let text = policy_text(seed);
        let (graph, tree) = tree(&session, &text)?;
        let account = run(&graph, seed).filter(|account| account.actions.len() > 2)?;
        Some(Case { seed, text, tree, account })
    })
}
