#![doc = include_str!("../README.md")]

pub mod lang;

/// Files of the library in reading order: name and text of each.
pub const FILES: &[(&str, &str)] = &[
    ("stdlib/world.motet", include_str!("../motet/world.motet")),
    ("stdlib/motion.motet", include_str!("../motet/motion.motet")),
    ("stdlib/manipulation.motet", include_str!("../motet/manipulation.motet")),
    ("stdlib/perception.motet", include_str!("../motet/perception.motet")),
    ("stdlib/people.motet", include_str!("../motet/people.motet")),
    ("stdlib/policies.motet", include_str!("../motet/policies.motet")),
];

/// Words that models write where the library has another, one row a meaning. The file describes its rows.
pub const WORDS: &str = include_str!("../words.txt");
