//! Readings that were wrong once: each ends in the right goals or in a question.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use motet_requests::{RequestContext, RequestError, choose, named, understand};
use motet_robots::builtin;
use motet_robots::scene::{Scene, read};
use motet_syntax::{Source, Sources, print};

/// An embedded scene, with further entities before its own.
fn scene(name: &str, entities: &str) -> Scene {
    let json = builtin::scene_text(name).unwrap().json;
    let json = json.replacen("\"entities\": [", &format!("\"entities\": [{entities}"), 1);
    let mut sources = Sources::default();
    let source = Source::new(name, json.as_str());
    let id = sources.add(source.clone());
    let (scene, diagnostics) = read(&source, id);
    scene.unwrap_or_else(|| panic!("{diagnostics:?}"))
}

fn goals(scene: &Scene, request: &str) -> Result<Vec<String>, RequestError> {
    let intent = understand(request, &RequestContext::new(scene))?;
    Ok(intent.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect())
}

const MICROSCOPE: &str = r#"{"id": "microscope", "kind": "Object", "class": "microscope",
    "pose": {"xyz": [1.98, 0.1, 0.77], "rpy": [0, 0, 0]},
    "shape": {"cylinder": {"radius": 0.04, "height": 0.1}},
    "mass": 0.3, "on": "kitchen_table", "visible": true},
    {"id": "book", "kind": "Object", "class": "book",
    "pose": {"xyz": [1.98, -0.2, 0.77], "rpy": [0, 0, 0]},
    "shape": {"cylinder": {"radius": 0.04, "height": 0.1}},
    "mass": 0.3, "on": "kitchen_table", "visible": true},"#;

#[test]
fn look_is_no_misspelt_book() {
    let scene = scene("kitchen", MICROSCOPE);
    assert_eq!(goals(&scene, "go and look at the microscope").unwrap(), ["at(robot, microscope)"]);
    assert!(goals(&scene, "Have a look in the cupboard.").is_err());
}

#[test]
fn misspelling_is_noted() {
    let scene = scene("kitchen", "");
    let intent = understand("put the spunge in the sink", &RequestContext::new(&scene)).unwrap();
    assert_eq!(intent.notes, ["I read `spunge` as `sponge`"]);
}

#[test]
fn pronoun_means_the_thing_at_the_place_that_was_told() {
    let scene = scene("kitchen", "");
    assert_eq!(
        goals(&scene, "there is a mug on the table, put it in the sink").unwrap(),
        ["on(mug_1, sink)"]
    );
}

#[test]
fn answer_by_category_is_no_other_thing() {
    let scene = scene("kitchen", "");
    let context = RequestContext::new(&scene);
    let Err(RequestError::AmbiguousReference { options, .. }) = understand("give me the drink", &context)
    else {
        panic!("which drink is a question");
    };
    assert!(choose("the healthy one", &options, &context).is_empty());
    assert!(understand("the healthy one", &context).is_err());
}

#[test]
fn modal_can_is_no_coke_can() {
    let scene = scene("kitchen", "");
    let context = RequestContext::new(&scene);
    for request in ["it fell behind the sofa, can you get it", "it fell behind the fridge, can you get it"] {
        assert!(understand(request, &context).is_err(), "{request}");
        assert!(!named(request, &context).iter().any(|id| id == "coke"), "{request}");
    }
    assert!(named("how many mugs are there, as far as you can see", &context).iter().all(|id| id != "coke"));
    assert_eq!(named("give me the can", &context), ["coke"]);
}

#[test]
fn thing_taken_out_of_what_was_opened_has_to_be_in_it() {
    let kitchen = scene("kitchen", "");
    let request = "open the fridge, take the bottle out and close it";
    let error = goals(&kitchen, request).unwrap_err();
    assert!(matches!(&error, RequestError::Elsewhere { thing, .. } if thing == "bottle"), "{error}");
    let mut context = RequestContext::new(&kitchen);
    context.supports.push(("bottle".into(), Some("fridge_1".into())));
    let intent = understand(request, &context).unwrap();
    let goals: Vec<_> = intent.aims.iter().map(|aim| print::expression(&aim.goal.condition)).collect();
    assert_eq!(
        goals,
        ["open(fridge_1)", "holding(bottle)", "not in(bottle, fridge_1)", "not open(fridge_1)"]
    );
}
