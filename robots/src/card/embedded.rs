//! The cards that are built in, as texts.

use crate::builtin::ROBOTS;

/// Name, `robot.toml` and, where there is one, `primitives.motet` of each built-in robot.
#[must_use]
pub fn embedded() -> &'static [(&'static str, &'static str, Option<&'static str>)] {
    const CARDS: [(&str, &str, Option<&str>); 3] = {
        let [one, two, three] = ROBOTS;
        [
            (one.name, one.card, one.declarations),
            (two.name, two.card, two.declarations),
            (three.name, three.card, three.declarations),
        ]
    };
    &CARDS
}

/// The `robot.urdf` of a built-in robot.
#[must_use]
pub fn embedded_urdf(name: &str) -> Option<&'static str> {
    ROBOTS.iter().find(|robot| robot.name == name).map(|robot| robot.urdf)
}
