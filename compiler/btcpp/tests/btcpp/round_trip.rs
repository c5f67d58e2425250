//! Trees that are imported and exported again are the same.

use motet_arbitrary::graph::graph;
use motet_btcpp::{export, import};
use motet_compiler::Session;
use motet_graph::Graph;
use motet_syntax::{FileId, Parsed, Severity, Source, Sources, Syntax, print};
use proptest::strategy::{Strategy as _, ValueTree as _};
use proptest::test_runner::TestRunner;

use super::sketch::{Use, sayable};

/// The vocabulary of the random policies as declarations, without contracts.
pub(crate) const DOMAIN: &str = "
    fluent holding(object: Object)
    fluent at(what: Entity, where: Entity)
    measure distance(to: Entity) -> Length
    entity mug, cup, bowl: Object
    entity table, shelf: Surface
    action go(to: Entity) fails unreachable
    action pick(object: Object) fails unreachable, not_found
    action place(object: Object, on: Entity) fails unreachable
    perception detect(what: Text) -> Object fails not_found
    perception detect_all(what: Text) -> List<Object>
    action say(text: Text)
";

/// A session in which the declarations are a domain.
pub(crate) fn session() -> Session {
    let mut sources = Sources::default();
    let source = Source::new("domain.motet", DOMAIN);
    let file = sources.add(source.clone());
    let parsed = motet_syntax::read(&source, file);
    assert_eq!(parsed.diagnostics, []);
    let domains = [parsed.file];
    let session = Session::builder().domains(&domains).build(&mut sources);
    assert_eq!(session.input_diagnostics(), []);
    session
}

/// Imports a tree and compiles it. The policy as text is read again, so that it is what a file has.
/// True beside the graph if the compiler has cut what is never reached.
pub(crate) fn compiled(session: &Session, tree: &str) -> Result<(Graph, bool), String> {
    let leaves = session.signatures().leaves();
    let (file, diagnostics) = import(&Source::new("tree.xml", tree), FileId(9), &leaves);
    let Some(file) = file else { return Err(format!("not imported: {diagnostics:#?}")) };
    let text = print::text(&file);
    let parsed: Parsed = motet_syntax::read(&Source::new("tree.motet", text.as_str()), FileId(9));
    assert_eq!(parsed.syntax, Syntax::Text);
    let main = file.policies().last().map(|policy| policy.name.text.clone()).unwrap();
    let compiled = session.compile(&parsed, Some(main.as_str()));
    let errors: Vec<String> = compiled
        .diagnostics
        .iter()
        .filter(|found| found.severity == Severity::Error)
        .map(|found| format!("{}: {}", found.code.0, found.message))
        .collect();
    let is_cut = compiled.diagnostics.iter().any(|found| ["M0504", "M0902"].contains(&found.code.0));
    let graph = compiled.graph.ok_or_else(|| format!("{}\n{text}", errors.join("\n")))?;
    Ok((graph, is_cut))
}

#[test]
fn imported_tree_is_exported_as_it_was() {
    let session = session();
    let leaves = session.signatures().leaves();
    let mut dice = TestRunner::deterministic();
    let sketches = sayable(Use::RoundTrip).no_shrink();
    let (mut same, mut refused) = (0, Vec::new());
    for case in 0..600 {
        let graph = graph(&sketches.new_tree(&mut dice).unwrap().current());
        let mut graph = graph;
        graph.initial.clear();
        for node in &mut graph.nodes {
            if let motet_graph::NodeKind::Call(call) = &mut node.kind {
                call.needs.clear();
            }
        }
        let Ok(tree) = export(&graph, &leaves) else { continue };
        match compiled(&session, &tree) {
            Ok((again, is_cut)) => {
                let again = match export(&again, &leaves) {
                    Ok(again) => again,
                    // A wait for what is never so leaves a `fail` in its place, which no tree can say there.
                    Err(why) if is_cut && why.iter().all(|part| part.what.contains("`fail` in a `try`")) => {
                        continue;
                    }
                    Err(why) => panic!("case {case}: {why:?}: {tree}"),
                };
                let bare = |text: &str| text.replace("main_tree_to_execute=\"sketch\" ", "");
                // The list of leaves also has those of steps that are never reached.
                // Nodes that do nothing, and sequences of one step, may come back as another number of them.
                let steps = |text: &str| {
                    let text = bare(text);
                    let lines = text.lines().take_while(|line| !line.contains("<TreeNodesModel"));
                    let is_step =
                        |line: &&str| !["<AlwaysSuccess/>", "<Sequence>", "</Sequence>"].contains(line);
                    lines.map(str::trim).filter(is_step).map(unnumbered).collect::<Vec<_>>()
                };
                if !is_cut {
                    assert_eq!(steps(&again), steps(&tree), "case {case}");
                    same += 1;
                }
            }
            Err(why) => refused.push(why),
        }
    }
    assert!(
        same > 100,
        "{same} round trips; refused:\n{}",
        refused.iter().take(5).cloned().collect::<Vec<_>>().join("\n\n")
    );
    assert!(refused.is_empty(), "{} refused, as {}", refused.len(), refused[0]);
}

/// Line without the numbers of entries of the blackboard, which count the steps before them.
fn unnumbered(line: &str) -> String {
    let digit = |letter: char| letter.is_ascii_digit();
    ["broken_", "failure_"].into_iter().fold(line.to_owned(), |line, entry| {
        let parts = line.split(entry).enumerate();
        parts.map(|(index, part)| if index == 0 { part } else { part.trim_start_matches(digit) }).collect()
    })
}
