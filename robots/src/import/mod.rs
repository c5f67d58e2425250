//! Import of rooms that other tools describe: maps of occupied cells and SDF worlds become scenes.
//!
//! ```
//! use motet_robots::import::{self, MapOptions};
//! use motet_syntax::{FileId, Source};
//!
//! let yaml = "image: room.pgm\nresolution: 0.5\norigin: [-1, 0, 0]\nnegate: 0\n\
//!             occupied_thresh: 0.65\nfree_thresh: 0.25\n";
//! let (map, diagnostics) = import::read_map(&Source::new("room.yaml", yaml), FileId(0));
//! assert_eq!(diagnostics, []);
//! let scene = map.unwrap().scene(b"P2 3 1 255 0 0 254", &MapOptions::default()).unwrap();
//! // The two dark cells are one wall.
//! assert_eq!(scene.entities["wall_1"].pose.unwrap().xyz, [-0.5, 0.25, 1.0]);
//! ```

mod diagnostics;
mod map;
mod raster;
mod rectangle;
mod sdf;
mod solid;

pub use diagnostics::CODES;
pub use map::{MapFile, MapMode, MapOptions, UnknownCells, read_map};
pub use raster::MAX_CELLS;
pub use sdf::read_sdf;
pub use solid::MAX_SOLIDS;
