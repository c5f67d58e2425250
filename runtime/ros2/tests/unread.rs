//! Output that nobody reads.

#![cfg(target_os = "linux")]

use std::io::Write as _;
use std::process::{Command, Stdio};

#[test]
fn errors_that_nobody_reads_hold_nothing_up() {
    // A pipe that holds no byte more.
    let (reader, mut full) = std::io::pipe().unwrap();
    full.write_all(&[b'x'; 1 << 16]).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_motet-ros2"));
    command.args(["layouts", "--encode", "nothing/Nowhere"]).stdout(Stdio::null()).stderr(full);
    let ended = command.status().unwrap();
    assert_eq!(ended.code(), Some(2));
    drop(reader);
}
