//! Policies made to measure.

use serde_json::{Value, json};

/// A policy of the JSON form for the robot `hsr` in the scene `kitchen` with so many steps: it carries the
/// red mug to the
/// person and back again, with a handler, a monitor and a condition on the way, over and over.
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
                        {"do": "say", "text": "I cannot reach it."}, {"end": "replan", "why": "cannot reach"}]}]}),
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
