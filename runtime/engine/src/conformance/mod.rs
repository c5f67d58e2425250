//! Conformance suites: the laws of [`crate::Driver`] and the guarantees of the engine on top of any driver.
//!
//! [`check`] runs a driver through short scenes and tells every law that it breaks. [`FaultyDriver`] is a
//! driver around another one that breaks laws on purpose: it loses, doubles, delays and swaps reports,
//! refuses, and falls silent. [`EngineGuarantees`] looks on while an engine runs and tells where it breaks
//! what it promises, whatever its driver does. [`check_perception`] checks the laws of [`crate::Perception`].

mod driver_laws;
mod faulty_driver;
mod guarantees;
mod law;

pub use driver_laws::{ConformanceSubject, check, check_scenes};
pub use faulty_driver::{FaultRates, FaultyDriver};
pub use guarantees::EngineGuarantees;
pub use law::{Law, LawViolation, check_perception};
