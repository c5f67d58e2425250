//! Questions of a dialogue to a driver: what it observes by itself.

use motet_graph::Value;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{Answer, Driver, DriverEvent, Pattern, Query, Time, Truth};
use motet_stdlib::lang::{entities, fluents, kinds};
use smol_str::SmolStr;

/// Asks a driver for all facts about the robot itself that its card lists as observable. Returns the answers
/// in order, and the time after them, at most the card's `observe_within` later.
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
        ask(fluents::FREE, vec![is(Value::Case(hand.clone()))]);
    }
    for one in scene.entities.values() {
        if one.kind == kinds::OBJECT {
            ask(fluents::HOLDING, vec![entity(&one.id)]);
        } else {
            ask(fluents::AT, vec![is(Value::Entity(SmolStr::new_static(entities::ROBOT))), entity(&one.id)]);
        }
    }
    self::ask(driver, queries, robot, now)
}

/// Asks a driver questions. Returns the answers in order, and the time after them, at most the card's
/// `observe_within` later.
pub(super) fn ask(
    driver: &mut dyn Driver,
    queries: Vec<Query>,
    robot: &Robot,
    now: Time,
) -> (Vec<(Query, Truth)>, Time) {
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
