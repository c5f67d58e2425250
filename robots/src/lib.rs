//! Robots and the rooms they stand in: robot cards, their URDFs, and scenes, read from text, checked, and given as
//! plain data.
//!
//! This crate reads no file: the host hands over the text of a card's folder or of a scene. It computes no geometry:
//! `motet-geometry` does, from what is read here.

pub mod card;
pub mod mesh;
pub mod quaternion;
pub mod scene;
pub mod srdf;
pub mod urdf;
