//! The command `motet-ros2`.

use std::process::ExitCode;

fn main() -> ExitCode {
    motet_ros2::run()
}
