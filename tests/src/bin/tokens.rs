//! Writes how many tokens the examples have in both forms of the model surface, with the vocabularies
//! cl100k and o200k:
//! `cargo run --release -p motet-tests --bin tokens`.

use motet_decode::vocabulary::Encoding;
use motet_decode::{Grammar, Modifiers, Subset, canonical};
use motet_syntax::{FileId, Source, Sources, Syntax};
use motet_tests::examples::{examples, read};
use motet_tests::setup;

fn main() {
    let mut rows = Vec::new();
    for (path, robot, scene) in examples() {
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let (robot, scene) = (setup::robot(&robot), setup::scene(&scene));
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
        let signatures = session.signatures();
        let parsed = motet_syntax::read(&Source::new(name.as_str(), read(&path)), FileId(0));
        let Some(policy) = parsed.file.runnable().next() else { continue };
        let mut row = Vec::new();
        for form in [Syntax::Json, Syntax::Text] {
            let of = |modifiers| {
                let subset = Subset { syntax: form, modifiers, ..Subset::default() };
                canonical(policy, &Grammar::new(&signatures, subset))
            };
            // Deadlines and retries have a place only where the policy has some.
            let Ok(line) = of(Modifiers::Default).or_else(|_| of(Modifiers::Written)) else { continue };
            let count = |encoding: Encoding| encoding.tokenizer().encode_ordinary(&line).len();
            row.extend([line.len(), count(Encoding::Cl100k), count(Encoding::O200k)]);
        }
        rows.push((format!("`{name}`"), row));
    }
    let columns = rows.iter().map(|(_, row)| row.len()).max().unwrap_or_default();
    let sum = |column| rows.iter().filter_map(|(_, row)| row.get(column)).sum();
    let all = (0..columns).map(sum).collect();
    rows.push(("all".to_owned(), all));
    print(&rows);
}

#[expect(clippy::print_stdout, reason = "this program writes to standard output")]
fn print(rows: &[(String, Vec<usize>)]) {
    println!("| policy | JSON, bytes | cl100k | o200k | text, bytes | cl100k | o200k |");
    println!("|---|---|---|---|---|---|---|");
    for (name, row) in rows {
        let row: Vec<String> = row.iter().map(usize::to_string).collect();
        println!("| {name} | {} |", row.join(" | "));
    }
}
