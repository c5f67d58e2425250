//! Xacro: the macros in which robot descriptions of ROS are written, expanded to a URDF.
//!
//! Properties, macros with defaults and blocks, includes, conditions, arguments, and expressions of the part
//! of Python that descriptions use, with `load_yaml`. Nothing is executed and no environment is read; sizes
//! and depths are bounded. This module opens no file: it asks its caller for the text of each.

mod expand;
mod expression;
mod parameter;
mod value;
mod yaml;

pub use expand::expand;

/// Source of the files of a description.
pub trait XacroFiles {
    /// Text of a file.
    ///
    /// # Errors
    ///
    /// Why it cannot be read.
    fn read(&mut self, path: &str) -> Result<String, String>;

    /// Folder of a ROS package, for `$(find NAME)`; `None` if it is nowhere.
    fn package(&mut self, name: &str) -> Option<String>;
}
