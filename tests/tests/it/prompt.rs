//! What a model is shown: examples that pass the check themselves, and a room as it is believed to be.
use std::time::Duration;

use motet_compiler::Session;
use motet_planner::prompt::{Prompt, StaticPrompt, TOKENS, WrittenPrompt};
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_runtime::memory::{Memory, MemoryLimits};
use motet_syntax::{FileId, Severity, Source, Sources};
use motet_tests::setup;

fn write(session: &Session, robot: &Robot, situation: &RequestContext<'_>) -> WrittenPrompt {
    let scene = situation.scene;
    let prompt = Prompt {
        session,
        robot,
        scene,
        situation,
        memory: &Memory::new(MemoryLimits::default()),
        bound: &[],
        lasting: &StaticPrompt::new(session, robot, scene),
        tokens: TOKENS,
        time: Duration::ZERO,
    };
    prompt.write("go home")
}

#[test]
fn prompt_examples_pass_the_check() {
    let mut shown = 0;
    for robot in ["hsr", "anymal_z1", "panda"] {
        for scene in ["kitchen", "living_room", "lab"] {
            let (robot, scene) = (setup::robot(robot), setup::scene(scene));
            let session = setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0;
            let situation = RequestContext::new(&scene);
            let written = write(&session, &robot, &situation);
            let mut lines = written.system.lines();
            while let Some(line) = lines.next() {
                let Some(request) = line.strip_prefix("# Example: ") else { continue };
                let example = lines.next().unwrap();
                // A thing that the room does not list is looked for, and may not be there.
                for word in [r#""what": "blue cup""#, r#""on": ["not_found"]"#, r#""finally""#, "cannot"] {
                    assert!(example.contains(word), "{}: {request}: no {word}", robot.name);
                }
                let source = Source::new("example.json", example);
                let said = session.check(&motet_syntax::read(&source, FileId(9)));
                let errors: Vec<_> = said.iter().filter(|said| said.severity == Severity::Error).collect();
                assert!(errors.is_empty(), "{}: {request}: {errors:?}", robot.name);
                shown += 1;
            }
        }
    }
    assert_eq!(shown, 9);
}

/// Lists every kind of step, every fact, measure and primitive, and stays short, for each robot in each room.
#[test]
fn prompt_lists_the_language_within_2600_tokens() {
    let lines = include_str!("../../../runtime/planner/prompt/language.txt").lines();
    let steps: Vec<&str> = lines.filter(|line| line.starts_with('{')).collect();
    assert!(steps.len() > 10, "{steps:?}");
    for robot in ["hsr", "anymal_z1"] {
        for scene in ["kitchen", "living_room", "lab"] {
            let (robot, scene) = (setup::robot(robot), setup::scene(scene));
            let session = setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0;
            let written = write(&session, &robot, &RequestContext::new(&scene));
            for step in &steps {
                assert!(written.system.contains(step), "{} is not shown: {step}", robot.name);
            }
            let signatures = session.signatures();
            let facts = signatures.fluents.iter().map(|fact| &fact.name);
            let measures = signatures.measures.iter().filter(|measure| measure.is_observable);
            let primitives = signatures.callables.iter().filter(|callable| !callable.is_policy);
            let names = facts
                .chain(measures.map(|measure| &measure.name))
                .chain(primitives.map(|callable| &callable.name));
            for name in names {
                assert!(written.system.contains(&format!("{name}(")), "{} is not listed: {name}", robot.name);
            }
            assert!(written.left_out.is_empty(), "{:?}", written.left_out);
            assert!(
                written.tokens <= 2600,
                "{} in {:?}: {} tokens\n{}",
                robot.name,
                scene.robot,
                written.tokens,
                written.system
            );
        }
    }
}

#[test]
fn prompt_room_is_told_as_it_is_believed_to_be() {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let session = setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0;
    let moved = [("mug_1", Some("cupboard_1")), ("apple", None), ("user", None), ("plate", Some("shelf"))];
    let supports = moved.iter().map(|(id, place)| ((*id).into(), place.map(Into::into))).collect();
    let situation = RequestContext { supports, ..RequestContext::new(&scene) };
    let room = write(&session, &robot, &situation).user;
    let line = |id: &str| room.lines().find(|line| line.starts_with(&format!("- {id} "))).unwrap();
    assert!(line("mug_1").contains("; in cupboard_1"), "{room}");
    assert!(line("plate").contains("; on shelf"), "{room}");
    assert!(line("apple").contains("; it is not known where"), "{room}");
    assert!(!line("user").contains("not known where"), "{room}");
}

#[test]
fn prompt_now_agrees_with_what_is_known() {
    let (robot, mut scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    scene.robot.holding = None;
    scene.robot.joints = robot.postures["home"].clone();
    let session = setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0;
    let now = write(&session, &robot, &RequestContext::new(&scene)).user;
    assert!(now.contains("holds nothing, its arm in the posture `home`."), "{now}");
    assert!(!now.contains("may hold something"), "{now}");
}

#[test]
fn prompt_keeps_out_of_zones_where_there_are_some() {
    let (robot, mut scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let system = |scene: &motet_robots::scene::Scene| {
        let session = setup::session(Some(&robot), Some(scene), &mut Sources::default()).0;
        write(&session, &robot, &RequestContext::new(scene)).system
    };
    assert!(!system(&scene).contains("out_of"));
    let mut stairs = scene.entities["door"].clone();
    (stairs.id, stairs.kind) = ("stairs".into(), "Zone".into());
    stairs.shape = Some(motet_robots::scene::EntityShape::Box([1.0, 1.0, 0.1]));
    scene.entities.insert("stairs".into(), stairs);
    assert!(system(&scene).contains(r#"; or {"out_of": "stairs"}"#));
}
