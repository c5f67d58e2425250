//! What the exported grammars generate is read without a mistake, and is right in names and types but for
//! what is in scope:
//! random derivations of every notation, over robots, scenes and both forms.

use std::collections::BTreeMap;

use motet_compiler::{Session, Signatures};
use motet_decode::export::{EbnfGrammar, Format, Header, ebnf, export};
use motet_decode::{Grammar, Modifiers, Subset, canonical};
use motet_syntax::{Parsed, Severity, Source, Sources, Syntax};
use motet_tests::notation::{Deriver, Notation, derive_schema, read};
use motet_tests::setup;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng as _;

/// Derivations of each combination of a robot and a subset.
const DERIVATIONS: usize = 1_500;
/// Derivations of each notation of the same grammar, which only its spelling could tell apart.
const OF_NOTATION: usize = 300;
/// About how many bytes a derivation has at most.
const BUDGET: usize = 250;
/// One of so many is followed through its state too.
const PROVEN: usize = 64;

/// What a grammar cannot know: what is bound where, and with which type. Such an error must stand where
/// a binding stands, or is a second name or a field of one.
const OF_SCOPE: &[&str] = &["M0202", "M0203", "M0206", "M0211", "M0216", "M0217", "M0301"];
/// What only state can tell, and what runs at once; that a fluent is not decided yet where a goal is stated.
const OF_STATE: &[&str] =
    &["M0316", "M0317", "M0318", "M0501", "M0502", "M0503", "M0506", "M0701", "M0702", "M0804", "M0805"];

fn settings() -> Vec<(Session, std::sync::Arc<Signatures>)> {
    let known = [("hsr", Some("kitchen")), ("anymal_z1", Some("lab")), ("panda", Some("lab")), ("hsr", None)];
    known
        .into_iter()
        .map(|(robot, scene)| {
            let (robot, scene) = (setup::robot(robot), scene.map(setup::scene));
            let (session, _) = setup::session(Some(&robot), scene.as_ref(), &mut Sources::default());
            let signatures = session.signatures();
            (session, signatures)
        })
        .collect()
}

fn surfaces() -> Vec<Subset> {
    let of = |form, modifiers| Subset { syntax: form, modifiers, ..Subset::default() };
    vec![
        of(Syntax::Json, Modifiers::Default),
        of(Syntax::Json, Modifiers::Written),
        of(Syntax::Text, Modifiers::Default),
        of(Syntax::Text, Modifiers::Written),
    ]
}

/// Checks a derivation; counts the codes of its errors.
fn check(session: &Session, text: &str, is_proven: bool, found: &mut BTreeMap<String, usize>) -> Parsed {
    let mut sources = Sources::default();
    let source = Source::new("derived", text);
    let id = sources.add(source.clone());
    let parsed = motet_syntax::read(&source, id);
    assert!(parsed.diagnostics.is_empty(), "{text}\n{:#?}", parsed.diagnostics);
    let said = if is_proven { session.check(&parsed) } else { session.check_names(&parsed) };
    for said in said.into_iter().filter(|said| said.severity == Severity::Error) {
        let code = said.code.to_string();
        // What two branches do at once may lie within the policies that they call.
        let own = said.span.file == id;
        let at = if own { &text[said.span.start as usize..said.span.end as usize] } else { "" };
        let name = at.trim_matches('"');
        let before = if own { &text[..said.span.start as usize] } else { "" };
        let in_braces = ["{", "{count(", "{first("].iter().any(|open| before.ends_with(open));
        let is_binding =
            name.trim_start_matches('$').bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
                && (name.starts_with('$')
                    || in_braces
                    || parsed.syntax == Syntax::Text
                    || ["M0206", "M0211"].contains(&code.as_str()));
        // It replaces what bears its name, and calls that.
        let policy = parsed.file.runnable().next().map(|policy| policy.name.text.as_str());
        let calls_itself =
            code == "M0207" && policy.is_some_and(|name| session.signatures().callable(name).is_some());
        assert!(
            OF_STATE.contains(&code.as_str())
                || (OF_SCOPE.contains(&code.as_str()) && is_binding)
                || calls_itself,
            "{code} {} `{at}`\n{text}",
            said.message
        );
        *found.entry(code).or_default() += 1;
    }
    parsed
}

fn walk(
    session: &Session,
    canon: &Grammar,
    (grammar, count): (&EbnfGrammar, usize),
    seed: u64,
) -> BTreeMap<String, usize> {
    let mut found = BTreeMap::new();
    let deriver = Deriver::new(grammar, BUDGET);
    let mut random = SplitMix64::seed_from_u64(seed);
    for index in 0..count {
        let text = deriver.derive(&mut random);
        let parsed = check(session, &text, index % PROVEN == 0, &mut found);
        let policy = parsed.file.runnable().next().unwrap();
        let again = match canonical(policy, canon) {
            Ok(again) => again,
            // A grammar counts a value in a text as one character.
            Err(outside) if outside.to_string().starts_with("a text has") && text.contains('{') => continue,
            Err(outside) => panic!("{outside}\n{text}"),
        };
        // A grammar does not know the types of names: one value in the place of a list is a list of it.
        let without_brackets = |line: &str| line.replace(['[', ']'], "");
        assert_eq!(without_brackets(&again), without_brackets(&text));
        let whole = check(session, &again, false, &mut BTreeMap::new());
        let whole = whole.file.runnable().next().unwrap();
        assert_eq!(canonical(whole, canon).unwrap(), again);
    }
    found
}

#[test]
fn grammar_texts_are_read_and_typed() {
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    let mut count = 0;
    for (at, (session, signatures)) in settings().iter().enumerate() {
        for surface in surfaces() {
            let grammar = Grammar::new(signatures, surface);
            let export = |format| export(&grammar, format, Header::default());
            let own = ebnf(&grammar);
            let mut grammars = vec![own];
            for (format, notation) in [
                (Format::Gbnf, Notation::Gbnf),
                (Format::Lark, Notation::Lark),
                (Format::RegexFreeEbnf, Notation::Ebnf),
            ] {
                grammars.push(read(&export(format).unwrap(), notation));
            }
            for (index, derived) in grammars.iter().enumerate() {
                let derivations = if index == 0 { DERIVATIONS } else { OF_NOTATION };
                let seed = (at * 10 + index) as u64;
                for (code, times) in walk(session, &grammar, (derived, derivations), seed) {
                    *found.entry(code).or_default() += times;
                }
                count += derivations;
            }
            let Some(schema) = export(Format::JsonSchema) else { continue };
            let schema = serde_json::from_str(&schema).unwrap();
            let mut random = SplitMix64::seed_from_u64(at as u64);
            for index in 0..DERIVATIONS {
                let text = derive_schema(&schema, BUDGET, &mut random);
                check(session, &text, index % PROVEN == 0, &mut found);
            }
            count += DERIVATIONS;
        }
    }
    println!("{count} derivations: {found:?}");
    assert!(count >= 50_000, "{count}");
}
