//! llguidance takes the exports: it accepts the examples in canonical form, byte by byte, and refuses what
//! is nearly right.

use llguidance::api::TopLevelGrammar;
use llguidance::toktrie::ApproximateTokEnv;
use llguidance::{Matcher, ParserFactory};
use motet_decode::export::{Format, Header, export};
use motet_decode::{Grammar, Modifiers, Subset, canonical};
use motet_syntax::{FileId, Source, Sources, Syntax};
use motet_tests::examples::{examples, read};
use motet_tests::{misses, setup};

/// How many bytes of a line an engine takes, and whether it may end there.
fn taken(engine: &Matcher, line: &str) -> (usize, bool) {
    let mut engine = engine.deep_clone();
    let bytes: Vec<u32> = line.bytes().map(u32::from).collect();
    let count = engine.try_consume_tokens(&bytes).unwrap_or(0);
    (count, engine.is_accepting().unwrap_or(false))
}

fn engine(factory: &ParserFactory, grammar: TopLevelGrammar) -> Matcher {
    let engine = Matcher::new(factory.create_parser(grammar));
    assert!(!engine.is_error(), "{:?}", engine.get_error());
    engine
}

#[test]
fn llguidance_takes_the_examples_and_refuses_near_misses() {
    let factory = ParserFactory::new_simple(&ApproximateTokEnv::single_byte_env()).unwrap();
    let mut refused = 0;
    for (path, robot, scene) in examples() {
        let (robot, scene) = (setup::robot(&robot), setup::scene(&scene));
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
        let signatures = session.signatures();
        let parsed = motet_syntax::read(&Source::new("example", read(&path)), FileId(0));
        let policy = parsed.file.runnable().next().unwrap();
        for form in [Syntax::Json, Syntax::Text] {
            let surface = Subset { syntax: form, modifiers: Modifiers::Written, ..Subset::default() };
            let grammar = Grammar::new(&signatures, surface);
            let line = canonical(policy, &grammar).unwrap();
            let lark = export(&grammar, Format::Lark, Header::Llguidance).unwrap();
            let mut engines = vec![engine(&factory, TopLevelGrammar::from_lark(lark))];
            if let Some(schema) = export(&grammar, Format::JsonSchema, Header::None) {
                let schema = serde_json::from_str(&schema).unwrap();
                engines.push(engine(&factory, TopLevelGrammar::from_json_schema(schema)));
            }
            for (index, engine) in engines.iter().enumerate() {
                let (count, ends) = taken(engine, &line);
                assert_eq!(
                    (count, ends),
                    (line.len(), true),
                    "{path:?} {index}: stops before {}",
                    &line[count..]
                );
                if form == Syntax::Json {
                    for (what, miss) in misses::near_misses(&line) {
                        let verdict = taken(engine, &miss);
                        assert_ne!(verdict, (miss.len(), true), "{what} is taken: {miss}");
                        refused += 1;
                    }
                }
            }
        }
    }
    assert!(refused > 200, "{refused}");
}
