#![doc = include_str!("../README.md")]

pub mod batch;
pub mod conformance;
pub mod document;
pub mod driver_camera;
mod error;
mod facade;
pub mod feasible;
pub mod line_file;
pub mod page;
pub mod plan;
pub mod printable;
pub mod replay;
pub mod run;
pub mod workbench;

pub use error::Error;
pub use facade::{CheckedPolicy, Motet, Plan};
pub use motet_compiler::{Compiled, Session};
pub use motet_graph::Graph;
pub use motet_project::{DiagnosticSink, Project, ProjectBuilder, ProjectError, ProjectSession};
pub use motet_robots::card::Robot;
pub use motet_robots::scene::Scene;
pub use motet_runtime::{Driver, Engine, Observer, RunEnd};
pub use motet_sim::Sim;
pub use motet_syntax::{Diagnostic, Severity, Sources};

// The crates beneath, for what this one does not cover.
pub use {
    motet_compiler as compiler, motet_graph as graph, motet_host as host, motet_planner as planner,
    motet_project as project, motet_robots as robots, motet_runtime as runtime, motet_sim as sim,
    motet_syntax as syntax,
};

// The Rust of the book compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../../docs/embedding.md")]
mod embedding_page {}
#[cfg(doctest)]
#[doc = include_str!("../../docs/first-driver.md")]
mod first_driver_page {}
#[cfg(doctest)]
#[doc = include_str!("../../docs/runtime.md")]
mod runtime_page {}
