//! Manners, from the document to the time that the robot takes.

use motet_compiler::make_explicit;
use motet_graph::{Manner, NodeKind};
use motet_runtime::{Effect, Engine, Observer, RunEnd, StartState, Time, run};
use motet_sim::{Sim, SimOptions};
use motet_syntax::ast::Item;
use motet_syntax::{FileId, Source, Sources, Syntax, print, read};
use motet_tests::setup;

/// A drive to the table, with modifiers.
fn text(modifiers: &str) -> String {
    format!("policy p {{\n    go(kitchen_table){modifiers}\n}}\n")
}

/// Time at which the drive ends, and the longest one of the graph.
#[derive(Default)]
struct Drive {
    commands: Vec<String>,
    end: Time,
}

impl Observer for Drive {
    fn effect(&mut self, now: Time, effect: &Effect) {
        match effect {
            Effect::Start { command, .. } => self.commands.push(command.to_string()),
            Effect::Finished(_) => self.end = now,
            _ => {}
        }
    }
}

#[test]
fn manners_make_a_drive_longer_and_its_deadline() {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let parts = |speed, acceleration| Some(Manner { speed, acceleration });
    let mut full = None;
    for (modifiers, manner, stretch, deadline, shown) in [
        ("", None, 1.0, 120.0, ""),
        (" slowly", parts(0.5, 0.5), 2.0, 240.0, " at 50 %"),
        (" slowly within 90 s", parts(0.5, 0.5), 2.0, 90.0, " at 50 %"),
        (" gently", parts(0.3, 0.25), 1.0 / 0.3, 400.0, " at 30 % of the speed and 25 % of the acceleration"),
        (" at 40 %", parts(0.4, 0.4), 2.5, 300.0, " at 40 %"),
    ] {
        let document = text(modifiers);
        let parsed = read(&Source::new("p.motet", document.as_str()), FileId(0));
        let mut policy = parsed.file.policies().next().unwrap().clone();
        make_explicit(&mut policy, session.library(), Syntax::Json);
        let json = print::policy_json(&policy);
        let from_json = read(&Source::new("p.json", json.as_str()), FileId(0));
        let mut file = from_json.file.clone();
        for item in &mut file.items {
            if let Item::Policy(policy) = item {
                make_explicit(policy, session.library(), Syntax::Text);
            }
        }
        assert_eq!(print::text(&file), document);
        let graph = session.compile(&parsed, None).graph.unwrap();
        assert_eq!(session.compile(&from_json, None).graph.as_ref(), Some(&graph));
        let NodeKind::Call(call) = &graph.nodes[0].kind else { panic!("{graph:?}") };
        assert_eq!(call.manner, manner);
        assert!((call.deadline_secs - deadline).abs() < 1e-9, "{}", call.deadline_secs);
        assert!(graph.nodes[0].duration.greatest_secs >= call.deadline_secs);
        let mut sim = Sim::new(&robot, &scene, SimOptions::default());
        let mut engine = Engine::new(graph, &StartState::default()).unwrap();
        let mut drive = Drive::default();
        let end = run(&mut engine, &mut sim, &mut drive, Time::ZERO);
        assert!(matches!(end, RunEnd::Done { .. }), "{end}");
        assert_eq!(drive.commands, [format!("go(to: kitchen_table){shown}")]);
        let secs = drive.end.secs();
        let full = *full.get_or_insert(secs);
        assert!((secs / full - stretch).abs() < 0.01, "{modifiers}: {secs} s, {full} s at full speed");
    }
}

/// The fix of M0315 takes the manner away in both syntaxes.
#[test]
fn manners_of_what_moves_nothing_are_removed() {
    let session = motet_compiler::Session::builder().build(&mut Sources::default());
    for document in [
        "policy p {\n    say(\"a\") slowly\n}\n",
        r#"{"motet": 1, "policy": "p", "steps": [{"do": "say", "text": "a", "manner": "30 %"}]}"#,
    ] {
        let source = Source::new("p", document);
        let said = session.check(&read(&source, FileId(0)));
        let [found] = said.as_slice() else { panic!("{said:#?}") };
        let fix = found.fix.as_ref().unwrap();
        let mut text = document.to_owned();
        for edit in &fix.edits {
            text.replace_range(edit.span.start as usize..edit.span.end as usize, &edit.text);
        }
        let mended = Source::new("p", text);
        assert_eq!(session.check(&read(&mended, FileId(0))), []);
        assert!(!motet_syntax::format(&mended).unwrap().contains("manner"));
    }
}
