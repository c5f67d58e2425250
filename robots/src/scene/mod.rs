//! Scenes: the room, the things and people in it, and the robot at the start.
//!
//! ```
//! use motet_robots::scene;
//! use motet_syntax::{FileId, Source};
//!
//! let text = r#"{"motet_scene": 1, "entities": [{"id": "mug_1", "kind": "Object", "names": ["red mug"]}]}"#;
//! let (scene, diagnostics) = scene::read(&Source::new("room.json", text), FileId(0));
//! assert_eq!(diagnostics, []);
//! assert_eq!(scene.unwrap().matches("the red mug")[0].id, "mug_1");
//! ```

mod check;
mod colour;
mod diagnostics;
pub mod model;
mod outline;
mod quantity;
mod read;
mod recognition;
mod serving;
mod wire;
mod write;

pub use check::fit;
pub use colour::{Colour, PERSON_COLOUR, Palette, colour};
pub use diagnostics::CODES;
pub use model::{normal, *};
pub use outline::{Outline, PLACED_BESIDE_M, PLACED_NEAR_M, PLACED_TOLERANCE_M, PlacedOutline};
pub use read::read;
pub use recognition::{
    MOST_LABEL, MOST_NEW, RECOGNISED_M, SURE, clean_label, distance, numbered_id, recognise,
};
pub use serving::{NEAR_M, ServedKind, ServingReach, person_gap, serving_gap};
pub use wire::{StateEntry, schema};
pub use write::write;
