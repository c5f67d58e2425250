//! Readers of files and of messages from the network, for fuzz targets.

use crate::bind::Binding;
use crate::cdr;
use crate::layout::{Distribution, Kind, Layouts};
use crate::picture::{self, Picture};
use std::sync::LazyLock;

static LAYOUTS: LazyLock<Layouts> =
    LazyLock::new(|| Layouts::of(Distribution::Jazzy, None).expect("they are built in"));

/// Reads a binding.
pub fn binding(text: &str) {
    let _ = Binding::parse(text, "outside");
}

/// Reads layouts of messages.
pub fn layouts(text: &str) {
    let mut layouts = Layouts::default();
    let _ = layouts.read(text, "outside").and_then(|()| layouts.check());
}

/// Reads a message, whose type the first byte chooses, and its picture.
///
/// # Panics
///
/// If a message that was read cannot be written.
pub fn message(bytes: &[u8]) {
    let messages = LAYOUTS.interfaces().filter(|(_, kind)| *kind == Kind::Message);
    let names: Vec<&str> = messages.map(|(name, _)| name).collect();
    let Some((first, bytes)) = bytes.split_first() else { return };
    let Some(name) = names.get(usize::from(*first) % names.len().max(1)) else { return };
    let Ok(message) = cdr::decode(&LAYOUTS, name, bytes) else { return };
    if let Ok(picture) = Picture::of(&message) {
        let _ = picture.png();
    }
    if let Ok((width, height)) = picture::size(&message) {
        let _ = picture::millimetres(&message, width, height);
    }
    let value = serde_json::to_value(&message).expect("a message is a JSON value");
    let again = cdr::encode(&LAYOUTS, name, &value);
    assert!(again.is_ok() || value.to_string().contains("null"), "{name}: {again:?}");
}
