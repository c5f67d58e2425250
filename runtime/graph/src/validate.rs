//! tmp
use crate::Graph;
/// tmp
pub type Invalid = String;
/// tmp
/// # Errors
/// tmp
pub fn validate(_: &Graph) -> Result<(), Vec<Invalid>> { Ok(()) }
