//! The cards that are built in.

/// Name, `robot.toml` and, where there is one, `primitives.motet` of each built-in robot.
#[must_use]
pub fn embedded() -> &'static [(&'static str, &'static str, Option<&'static str>)] {
    &[
        ("hsr", include_str!("../../models/hsr/robot.toml"), None),
        (
            "anymal_z1",
            include_str!("../../models/anymal_z1/robot.toml"),
            Some(include_str!("../../models/anymal_z1/primitives.motet")),
        ),
    ]
}
