//! Walks that people take by themselves: a few steps in some direction, where nothing stands.

use crate::chance::Chance;
use crate::sim::Sim;
use smol_str::SmolStr;

/// Greatest distance in m of a walk, and the distance that it keeps from everything.
const STROLL_M: f64 = 1.0;
const KEEPS_M: f64 = 0.15;
/// Speed of a walk in m/s.
const STROLL_SPEED: f64 = 0.6;

impl Sim {
    /// A person walks off in some direction, unless something stands there. Returns whether they do.
    pub(crate) fn stroll(&mut self, person: &SmolStr) -> bool {
        let Some(thing) = self.world.thing(person).filter(|thing| thing.walk.is_none()) else { return false };
        let body = thing.body;
        let [dx, dy] = Chance::new(self.seed, self.world.now.nanos()).error(STROLL_M / 2.0, "stroll", person);
        let clear = |x: f64, y: f64| {
            let keeps = body.radius() + KEEPS_M;
            let robot = self.world.base.distance_to(x, y) - self.world.base_extent();
            let mut others = self.world.floor_things().filter(|(id, _)| *id != person);
            robot >= keeps && others.all(|(_, other)| other.body.gap(x, y) >= keeps)
        };
        let is_free = (1..=10).all(|step| {
            let done = f64::from(step) / 10.0;
            clear(body.x() + done * dx, body.y() + done * dy)
        });
        if is_free {
            self.world.start_walk(person, None, [body.x() + dx, body.y() + dy], STROLL_SPEED);
        }
        is_free
    }
}
