//! The names that the acceptor offers are those that the checker sees: made policies of every kind of block,
//! in which names are bound and used here and there, are accepted exactly if they have no error.

use crate::common::walks::Dice;
use crate::common::{errors, session};
use motet_decode::{AcceptorFactory, Grammar, Modifiers, Subset, canonical};
use motet_syntax::{FileId, Source, Syntax};
use serde_json::{Value, json};

const NAMES: [&str; 2] = ["one", "two"];
const WHAT: [&str; 3] = ["red mug", "mug", "old hat"];

fn pick<'t>(list: &[&'t str], dice: &mut Dice) -> &'t str {
    list[dice.below(list.len())]
}

fn block(dice: &mut Dice, depth: usize) -> Vec<Value> {
    (0..1 + dice.below(3)).map(|_| step(dice, depth)).collect()
}

fn condition(dice: &mut Dice) -> Value {
    if dice.chance(80) {
        return json!({"get": "distance", "to": "user", "is": "less", "than": 0.5});
    }
    json!({"is": "visible", "object": format!("${}", pick(&NAMES, dice))})
}

/// A step, and at times its cleanup.
fn step(dice: &mut Dice, depth: usize) -> Value {
    let mut step = bare_step(dice, depth);
    let has_blocks = ["steps", "then", "during", "try", "parallel"].iter().any(|key| step.get(key).is_some());
    if has_blocks && dice.chance(25) {
        step["finally"] = json!(cleanup(dice));
    }
    step
}

fn cleanup(dice: &mut Dice) -> Vec<Value> {
    (0..1 + dice.below(2)).map(|_| calm_step(dice)).collect()
}

/// A step that may stand in a cleanup.
fn calm_step(dice: &mut Dice) -> Value {
    let [name, other] = [pick(&NAMES, dice), pick(&NAMES, dice)];
    match dice.below(16) {
        0..6 => json!({"do": "detect", "what": pick(&WHAT, dice), "as": name}),
        6 | 7 => json!({"do": "inspect", "what": format!("${name}")}),
        8 => json!({"let": name, "be": {"get": pick(&["first", "count"], dice), "of": format!("${other}")}}),
        9 => json!({"do": "say", "text": format!("{{{name}}} {{count({other})}}")}),
        10..12 => json!({"if": condition(dice), "then": [calm_step(dice)], "else": [calm_step(dice)]}),
        _ => json!({"wait": 1}),
    }
}

fn bare_step(dice: &mut Dice, depth: usize) -> Value {
    let name = pick(&NAMES, dice);
    match dice.below(if depth == 0 { 12 } else { 26 }) {
        0..4 => json!({"do": "detect", "what": pick(&WHAT, dice), "as": name}),
        4 => json!({"do": "detect_all", "what": "cup", "as": name}),
        5..7 => json!({"do": "inspect", "what": format!("${name}")}),
        7 => json!({"do": "say", "text": "hello"}),
        8 => json!({"end": "done"}),
        9 => json!({"end": pick(&["fail", "replan"], dice), "why": "no"}),
        10 => json!({"do": "detect_all", "what": "cup", "as": name}),
        11 => calm_step(dice),
        12 | 13 => json!({"sequence": "group", "steps": block(dice, depth - 1)}),
        14 => json!({"within": 30, "steps": block(dice, depth - 1)}),
        15 => {
            let to = if dice.chance(30) { format!("${name}") } else { "user".to_owned() };
            json!({"keep": [{"distance": to, "at_least": 1}], "steps": block(dice, depth - 1)})
        }
        16..19 => {
            let otherwise = if dice.chance(70) { block(dice, depth - 1) } else { Vec::new() };
            json!({"if": condition(dice), "then": block(dice, depth - 1), "else": otherwise})
        }
        19..22 => {
            let catches: Vec<Value> = ["not_found", "any"][..1 + dice.below(2)]
                .iter()
                .map(|on| json!({"on": [on], "steps": block(dice, depth - 1)}))
                .collect();
            json!({"try": block(dice, depth - 1), "catch": catches})
        }
        22 => json!({"repeat": 2, "steps": block(dice, depth - 1)}),
        23 => json!({"each": name, "in": ["mug_1"], "at_most": 2, "steps": block(dice, depth - 1)}),
        24 => json!({"parallel": [block(dice, depth - 1), [{"do": "say", "text": "oh"}]]}),
        _ => {
            let reaction = if dice.chance(50) {
                json!({"react": "pause"})
            } else {
                json!({"react": "resume", "at_most": 2, "steps": block(dice, depth - 1)})
            };
            let when = json!({"when": condition(dice), "then": reaction});
            json!({"monitor": [when], "during": block(dice, depth - 1)})
        }
    }
}

fn accept_what_checks(syntax: Syntax) {
    let session = session("hsr", "kitchen");
    let subset = Subset { syntax, modifiers: Modifiers::Written, ..Subset::default() };
    let (factory, grammar) =
        (AcceptorFactory::new(&session, subset), Grammar::new(&session.signatures(), subset));
    let mut dice = Dice::new(3);
    let (mut right, mut wrong) = (0, 0);
    for round in 0..1200 {
        let depth = 1 + dice.below(3);
        // The base stands somewhere, and a name is used at the end.
        let mut steps = vec![json!({"do": "go", "to": "kitchen_table"})];
        steps.extend(block(&mut dice, depth));
        steps.push(json!({"do": "inspect", "what": format!("${}", pick(&NAMES, &mut dice))}));
        let mut policy = json!({"motet": 1, "policy": "p", "robot": "hsr", "steps": steps});
        if dice.chance(30) {
            policy["finally"] = json!(cleanup(&mut dice));
        }
        let text = policy.to_string();
        let parsed = motet_syntax::read(&Source::new("policy.json", text.as_str()), FileId(7));
        assert!(parsed.diagnostics.is_empty(), "{text}\n{:?}", parsed.diagnostics);
        let policy = parsed.file.policies().next().unwrap();
        let Ok(spelled) = canonical(policy, &grammar) else { continue };
        let said = errors(&session, &spelled);
        let mut acceptor = factory.acceptor(20_000).unwrap();
        let taken = acceptor.accept(spelled.as_bytes());
        let is_open = taken == spelled.len() && acceptor.is_accepting();
        assert_eq!(is_open, said.is_empty(), "{round}: {said:#?}\n{spelled}\ntaken: {}", &spelled[..taken]);
        *if is_open { &mut right } else { &mut wrong } += 1;
    }
    println!("{right} right, {wrong} wrong");
    assert!(right > 50 && wrong > 50, "{right} right, {wrong} wrong");
}

#[test]
fn acceptor_offers_the_names_that_the_checker_sees_in_json() {
    accept_what_checks(Syntax::Json);
}

#[test]
fn acceptor_offers_the_names_that_the_checker_sees_in_text() {
    accept_what_checks(Syntax::Text);
}
