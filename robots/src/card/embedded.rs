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
        (
            "panda",
            include_str!("../../models/panda/robot.toml"),
            Some(include_str!("../../models/panda/primitives.motet")),
        ),
    ]
}

/// The `robot.urdf` of a built-in robot.
#[must_use]
pub fn embedded_urdf(name: &str) -> Option<&'static str> {
    match name {
        "hsr" => Some(include_str!("../../models/hsr/robot.urdf")),
        "anymal_z1" => Some(include_str!("../../models/anymal_z1/robot.urdf")),
        "panda" => Some(include_str!("../../models/panda/robot.urdf")),
        _ => None,
    }
}
