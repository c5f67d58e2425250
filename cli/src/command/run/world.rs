//! The world that a run moves in.

use motet_runtime::Driver;

use crate::args::RunArgs;
use crate::exit::Trouble;
use crate::workbench::Setting;

/// The simulated world of a setting.
pub(super) fn driver(_args: &RunArgs, _setting: &Setting) -> Result<Box<dyn Driver>, Trouble> {
    Err(Trouble::Other("this build has no simulator".to_owned()))
}
