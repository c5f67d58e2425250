//! A look at oneself between two policies: what the hands hold and where the base stands. After a failure
//! or in the middle of
//! something the engine knows neither, and a robot can tell both without moving.

use motet_graph::Value;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{Answer, Driver, DriverEvent, Pattern, Query, Time, Truth};
use smol_str::SmolStr;

/// Asks a driver, where the robot's card says that it can tell. Gives what it answers, in order, and the
/// time by then, which
/// is at most the card's `observe_within` later.
pub(super) fn sense(
    driver: &mut dyn Driver,
    robot: &Robot,
    scene: &Scene,
    now: Time,
) -> (Vec<(Query, Truth)>, Time) {
    let is = |value: Value| Pattern::Is(value);
    let entity = |id: &SmolStr| is(Value::Entity(id.clone()));
    let mut queries = Vec::new();
    let mut ask = |fluent: &str, args: Vec<Pattern>| {
        if robot.observes.iter().any(|known| known == fluent) {
            queries.push(Query::Fact { fluent: fluent.into(), args });
        }
    };
    for hand in robot.hands.keys() {
        ask("free", vec![is(Value::Case(hand.clone()))]);
    }
    for one in scene.entities.values() {
        if one.kind == "Object" {
            ask("holding", vec![entity(&one.id)]);
        } else {
            ask("at", vec![is(Value::Entity(SmolStr::new_static("robot"))), entity(&one.id)]);
        }
    }
    for query in &queries {
        driver.observe(now, query);
    }
    let until = Time::from_secs(now.secs() + robot.observe_within_secs);
    let (mut seen, mut at, mut left) = (Vec::new(), now, queries.len());
    while left > 0 {
        let Some((time, event)) = driver.advance(until) else {
            at = at.max(until);
            break;
        };
        at = at.max(time);
        if let DriverEvent::Observed { query, answer } = event
            && queries.contains(&query)
        {
            left -= 1;
            if let Answer::Truth(holds) = answer {
                seen.push((query, if holds { Truth::True } else { Truth::False }));
            }
        }
    }
    (seen, at)
}
