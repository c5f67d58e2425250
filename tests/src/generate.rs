//! Policies made to measure, and a symbolic domain of any size with plans in it: boxes that one carrier takes
//! from bay to bay, without robot and scene.

use std::fmt::Write as _;

use serde_json::{Value, json};

/// A policy of the JSON form for the robot `hsr` in the scene `kitchen` with so many steps: it carries the
/// red mug to the person and back again, with a handler, a monitor and a condition on the way, over and over.
#[must_use]
pub fn policy_of(steps: usize) -> String {
    let mut body: Vec<Value> = Vec::new();
    let mut left = steps;
    let mut round = 0;
    while left > 0 {
        let mug = format!("mug{round}");
        let bound = format!("${mug}");
        let (home, away) =
            if round % 2 == 0 { ("kitchen_table", "counter") } else { ("counter", "kitchen_table") };
        // Each entry with the number of steps that it counts for.
        let lap = [
            (1, json!({"do": "go", "to": home})),
            (1, json!({"do": "detect", "what": "red mug", "as": mug})),
            (
                4,
                json!({"try": [{"do": "pick", "object": bound, "within": 20, "retry": 1}],
                    "catch": [{"on": ["unreachable"], "steps": [
                        {"do": "say", "text": "I cannot reach it."}, {"end": "replan",
                            "why": "cannot reach"}]}]}),
            ),
            (
                2,
                json!({"monitor": [{"when": {"less": [{"get": "distance", "to": "user"}, 0.5]}, "for": 0.2,
                        "then": {"react": "pause"}}],
                    "during": [{"do": "go", "to": away}]}),
            ),
            (1, json!({"do": "place", "object": bound, "on": away})),
            (1, json!({"do": "go", "to": "trash"})),
        ];
        for (count, step) in lap {
            if count > left {
                left = 0;
                break;
            }
            left -= count;
            body.push(step);
        }
        round += 1;
    }
    json!({"motet": 1, "policy": "measured", "robot": "hsr", "steps": body}).to_string()
}

const BAYS: usize = 4;

/// The declarations of a depot with so many boxes, all in the first bay.
#[must_use]
pub fn depot(boxes: usize) -> String {
    let mut text = String::from(
        "kind Box: Entity {}\nkind Bay: Entity {}\n\
         fluent stands(what: Box, bay: Bay)\nfluent carried(what: Box)\nfluent idle(who: Entity)\n\
         closed world\n\
         action take(what: Box, from: Bay)\n    needs stands(what, from), idle(robot)\n    \
         makes carried(what), not stands(what, from), not idle(robot)\n\
         action leave(what: Box, to: Bay)\n    needs carried(what)\n    \
         makes stands(what, to), idle(robot), not carried(what)\n\
         initially idle(robot)\n",
    );
    for bay in 0..BAYS {
        let _ = writeln!(text, "entity bay_{bay}: Bay");
    }
    for index in 0..boxes {
        let _ = writeln!(text, "entity box_{index}: Box\ninitially stands(box_{index}, bay_0)");
    }
    text
}

/// A plan of so many steps, half of them taking and half leaving; one taking in `fault_every` is from the
/// wrong bay.
#[must_use]
pub fn depot_plan(boxes: usize, steps: usize, fault_every: Option<usize>) -> String {
    let mut bays = vec![0; boxes];
    let mut list = Vec::with_capacity(steps);
    for index in 0..steps / 2 {
        let what = index * 7 % boxes.max(1);
        let Some(bay) = bays.get_mut(what) else { continue };
        let is_wrong = fault_every.is_some_and(|every| index % every.max(1) == 0);
        list.push(take(what, if is_wrong { *bay + 2 } else { *bay }));
        *bay += 1;
        list.push(leave(what, *bay));
    }
    policy(list)
}

/// Branches within branches, so many deep.
#[must_use]
pub fn nested_branches(depth: usize) -> String {
    policy((0..depth).fold(there_and_back(0), |mut inner, level| {
        inner.extend(there_and_back(level + 1));
        vec![json!({"if": unknown(level + 1), "then": inner, "else": there_and_back(0)})]
    }))
}

/// Branches one after the other.
#[must_use]
pub fn successive_branches(count: usize) -> String {
    let branch = |level| {
        let then = vec![take(level + 1, 0), leave(level + 1, 1)];
        json!({"if": unknown(level + 1), "then": then, "else": there_and_back(0)})
    };
    policy((0..count).map(branch).collect())
}

/// Loops within loops, so many deep.
#[must_use]
pub fn nested_loops(depth: usize) -> String {
    policy((0..depth).fold(there_and_back(0), |mut inner, level| {
        inner.extend(there_and_back(level + 1));
        vec![json!({"repeat": 2, "steps": inner})]
    }))
}

fn policy(steps: Vec<Value>) -> String {
    json!({"motet": 1, "policy": "plan", "steps": steps}).to_string()
}

fn take(what: usize, bay: usize) -> Value {
    json!({"do": "take", "what": format!("box_{what}"), "from": format!("bay_{}", bay % BAYS)})
}

fn leave(what: usize, bay: usize) -> Value {
    json!({"do": "leave", "what": format!("box_{what}"), "to": format!("bay_{}", bay % BAYS)})
}

fn there_and_back(what: usize) -> Vec<Value> {
    vec![take(what, 0), leave(what, 0)]
}

fn unknown(what: usize) -> Value {
    json!({"is": "stands", "what": format!("box_{what}"), "bay": "bay_0"})
}
