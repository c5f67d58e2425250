//! The example of a driver on a thread of its own runs a compiled policy to its end.

use motet_runtime::RunEnd;
use std::time::Duration;

#[path = "../../examples/robot_thread.rs"]
mod example;

#[test]
fn robot_thread_example_reaches_the_end_of_the_policy() {
    let end = example::bring_mug(Duration::from_millis(1)).unwrap();
    assert_eq!(end, RunEnd::Done { why: None, result: None });
}
