//! Readers of what comes from outside, each as a function of bytes that must neither panic nor hang, nor
//! break a promise of its own.

mod model_server;
mod targets;

pub use targets::TARGETS;

/// A name and the function that reads bytes.
pub type Target = (&'static str, fn(&[u8]));

/// Target with a name.
///
/// # Panics
///
/// If there is none.
#[must_use]
pub fn target(name: &str) -> fn(&[u8]) {
    let names = || TARGETS.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let found = TARGETS.iter().find(|(known, _)| *known == name);
    found.unwrap_or_else(|| panic!("there is no target `{name}`, only {}", names())).1
}
