//! Tests of the readers of cards, URDFs, SRDFs, meshes and scenes, and of the built-in robots and scenes.

#![allow(
    clippy::unwrap_used,
    clippy::string_slice,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    reason = "a test fails by panicking"
)]

mod builtin_scenes;
mod card;
mod draft;
mod mesh;
mod scene;
mod surplus;
mod urdf;
mod xacro;
