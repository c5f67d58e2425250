//! Whether a driver keeps the laws of [`crate::Driver`], and whether an engine keeps its own on top of any driver.
//!
//! [`check`] runs a driver through short scenes and tells every law that it breaks. [`Faulty`] is a driver around another
//! one that breaks laws on purpose: it loses, doubles, delays and swaps reports, refuses, and falls silent. [`Promises`] looks
//! on while an engine runs and tells where it breaks what it promises, whatever its driver does. [`perception`] checks the
//! laws of [`crate::Perception`].

mod bench;
mod faulty;
mod law;
mod perception;
mod promises;
mod scenes;

pub use faulty::{Faulty, Mischief};
pub use law::{Breach, Law};
pub use perception::perception;
pub use promises::Promises;
pub use scenes::{Subject, check};
