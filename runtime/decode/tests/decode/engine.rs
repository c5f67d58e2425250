//! The acceptor beside an engine that knows the exported grammar only: the grammar allows every token that
//! the acceptor allows.

use crate::common::peer::{Peer, environment};
use crate::common::tokens::{END, tokens};
use crate::common::walks::Dice;
use crate::common::{SETTINGS, session};
use motet_decode::{AcceptorFactory, Modifiers, Subset, Vocabulary};
use motet_syntax::Syntax;

/// The number of walks for each pair of robot and scene with each subset.
const WALKS: u64 = 3;
/// The greatest number of tokens of a walk.
const LENGTH: usize = 120;

#[test]
fn decoder_mask_in_json_is_within_the_exported_grammar() {
    compare(Syntax::Json);
}

#[test]
fn decoder_mask_in_text_is_within_the_exported_grammar() {
    compare(Syntax::Text);
}

/// The item of a loop is bound in its body: a container here, which no step returns.
#[test]
fn acceptor_takes_loop_items_as_arguments() {
    let tokens = tokens();
    let environment = environment(&tokens, END);
    let session = session("hsr", "living_room");
    for (syntax, policy) in [
        (Syntax::Text, "policy p for hsr { each J in [drawer_1] at most 1 { go(J) open(J) done } done }"),
        (
            Syntax::Json,
            concat!(
                r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"#,
                r#""steps":[{"each":"J","in":["drawer_1"],"at_most":1,"steps":["#,
                r#"{"do":"go","to":"$J"},{"do":"open","what":"$J"},{"end":"done"}]},"#,
                r#"{"end":"done"}],"finally":null}"#,
            ),
        ),
    ] {
        let subset = Subset { syntax, ..Subset::default() };
        let mut matcher = Peer::new(&environment, &session, subset).start();
        for byte in policy.bytes() {
            assert!(matcher.consume_token(u32::from(byte)).is_ok(), "`{}` in {policy}", char::from(byte));
        }
        let mut acceptor = AcceptorFactory::new(&session, subset).acceptor(2000).unwrap();
        assert_eq!(acceptor.accept(policy.as_bytes()), policy.len(), "{policy}");
    }
}

fn compare(syntax: Syntax) {
    let tokens = tokens();
    let vocabulary = Vocabulary::new(&tokens, END);
    let environment = environment(&tokens, END);
    let mut masks = 0;
    for (robot, scene) in SETTINGS {
        let session = session(robot, scene);
        for modifiers in [Modifiers::Default, Modifiers::Written] {
            let subset = Subset { syntax, modifiers, ..Subset::default() };
            let factory = AcceptorFactory::new(&session, subset);
            let peer = Peer::new(&environment, &session, subset);
            for seed in 0..WALKS {
                let mut dice = Dice::new(seed);
                let mut decoder = factory.decoder(&vocabulary, 2000).unwrap();
                let mut matcher = peer.start();
                for _ in 0..LENGTH {
                    let ours = decoder.mask().to_vec();
                    let theirs = matcher.compute_mask_or_eos().unwrap();
                    let is_set =
                        |mask: &[u32], token: u32| mask[token as usize / 32] >> (token % 32) & 1 == 1;
                    let allowed: Vec<u32> = (0..=END).filter(|token| is_set(&ours, *token)).collect();
                    for token in &allowed {
                        let text = String::from_utf8_lossy(vocabulary.bytes(*token)).into_owned();
                        let after = String::from_utf8_lossy(decoder.acceptor().bytes()).into_owned();
                        let is_within = is_set(theirs.as_slice(), *token);
                        assert!(is_within, "{robot} {scene} {seed}: `{text}` ({token}) after {after}");
                    }
                    masks += 1;
                    // Long tokens lead further.
                    let long: Vec<u32> =
                        allowed.iter().copied().filter(|token| (256..END).contains(token)).collect();
                    let from = if long.is_empty() || dice.chance(30) { &allowed } else { &long };
                    let token = from[dice.below(from.len())];
                    assert!(decoder.accept(token));
                    if token == END {
                        break;
                    }
                    matcher.consume_token(token).unwrap();
                }
            }
        }
    }
    println!("{masks} masks are within those of llguidance");
}
