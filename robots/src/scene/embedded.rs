//! The scenes that come with Motet.

/// Scenes by name, with their JSON text.
#[must_use]
pub fn embedded() -> &'static [(&'static str, &'static str)] {
    &[
        ("kitchen", include_str!("../../scenes/kitchen.json")),
        ("living_room", include_str!("../../scenes/living_room.json")),
        ("lab", include_str!("../../scenes/lab.json")),
    ]
}
