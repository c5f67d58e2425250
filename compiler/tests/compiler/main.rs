//! Tests of the compiler at its public boundary.
//!
//! The prover is guarded by `tests/spec/prover.md`, lints by `tests/spec/intent.md`, fixes by
//! `tests/tests/it/fix.rs`, plans by `tests/tests/it/planning.rs`, and incremental checks by the properties
//! of `runtime/decode`.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    clippy::print_stderr,
    missing_docs,
    reason = "a test fails by panicking"
)]

mod explain;
mod feasibility;
mod session;

use motet_compiler::{Geometry, Session};
use motet_geometry::planning::SearchBudget;
use motet_robots::builtin::RobotWithBody;
use motet_robots::scene::Scene;
use motet_syntax::{FileId, Parsed, Source, Sources};

/// Reads a document in text or JSON.
fn read(text: &str) -> Parsed {
    motet_syntax::read(&Source::new("document.motet", text), FileId(99))
}

/// A session of a robot in a scene, with geometry.
fn in_scene(RobotWithBody { robot, urdf }: &RobotWithBody, scene: &Scene) -> Session {
    let session = Session::builder().robot(robot).scene(scene).build(&mut Sources::default());
    let said = session.input_diagnostics();
    assert!(said.is_empty(), "{said:?}");
    session.with_geometry(Geometry::new(robot, urdf, scene, None, SearchBudget::default()).into())
}
