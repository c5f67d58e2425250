//! The standard library: kinds, fluents, measures, failures, primitives and policies, as Motet text.
//!
//! The texts are the whole of it: no crate knows a primitive by name. They are compiled once, before the
//! robot's own declarations and those of a domain, which replace declarations of the same name.

/// The files, in the order in which they are read: name and text.
pub const FILES: &[(&str, &str)] = &[
    ("stdlib/world.motet", include_str!("../motet/world.motet")),
    ("stdlib/motion.motet", include_str!("../motet/motion.motet")),
    ("stdlib/manipulation.motet", include_str!("../motet/manipulation.motet")),
    ("stdlib/perception.motet", include_str!("../motet/perception.motet")),
    ("stdlib/people.motet", include_str!("../motet/people.motet")),
    ("stdlib/policies.motet", include_str!("../motet/policies.motet")),
];
