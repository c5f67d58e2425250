//! Writes the input of the tests of other engines as JSON on standard output: for each robot and scene of
//! the examples the exported grammars, the examples as canonical lines, and lines that are nearly right.

use std::collections::BTreeMap;

use motet_decode::export::{Format, Header, export};
use motet_decode::{Grammar, Modifiers, Subset, canonical};
use motet_syntax::{FileId, Source, Sources, Syntax};
use motet_tests::examples::{examples, read};
use motet_tests::{examples, setup};
use serde_json::{Value, json};

/// The names of a robot and a scene.
type Setting = (String, String);
/// The name of a policy, its line in JSON and its line in text.
type Lines = (String, [String; 2]);

fn main() {
    let mut worlds: BTreeMap<Setting, Vec<Lines>> = BTreeMap::new();
    let mut grammars: BTreeMap<Setting, Value> = BTreeMap::new();
    for (path, robot, scene) in examples() {
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let (card, room) = (setup::robot(&robot), setup::scene(&scene));
        let (session, _) = setup::session(Some(&card), Some(&room), &mut Sources::default());
        let signatures = session.signatures();
        let subset = |form| Subset { syntax: form, modifiers: Modifiers::Written, ..Subset::default() };
        let parsed = motet_syntax::read(&Source::new(name.as_str(), read(&path)), FileId(0));
        let lines = parsed.file.runnable().next().map(|policy| {
            [Syntax::Json, Syntax::Text]
                .map(|form| canonical(policy, &Grammar::new(&signatures, subset(form))).unwrap_or_default())
        });
        let key = (robot, scene);
        worlds.entry(key.clone()).or_default().extend(lines.map(|lines| (name, lines)));
        grammars.entry(key).or_insert_with(|| {
            let of = |form, format| export(&Grammar::new(&signatures, subset(form)), format, Header::None);
            json!({
                "schema": of(Syntax::Json, Format::JsonSchema),
                "json_gbnf": of(Syntax::Json, Format::Gbnf),
                "text_gbnf": of(Syntax::Text, Format::Gbnf),
                "json_lark": of(Syntax::Json, Format::Lark),
                "text_lark": of(Syntax::Text, Format::Lark),
            })
        });
    }
    let all: Vec<Value> = worlds
        .into_iter()
        .map(|(key, policies)| {
            let misses: Vec<Value> = policies
                .iter()
                .flat_map(|(_, [json, _])| examples::near_misses(json))
                .map(|(what, line)| json!({"what": what, "line": line}))
                .collect();
            let policies: Vec<Value> = policies
                .into_iter()
                .map(|(name, [json, text])| json!({"name": name, "json": json, "text": text}))
                .collect();
            let grammars = grammars.remove(&key);
            json!({
                "robot": key.0, "scene": key.1, "grammars": grammars, "policies": policies,
                "misses": misses,
            })
        })
        .collect();
    print(&json!(all));
}

#[expect(clippy::print_stdout, reason = "this program writes to standard output")]
fn print(value: &Value) {
    println!("{value}");
}
