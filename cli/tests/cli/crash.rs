//! Drivers in another process and a host that end at bad moments.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use crate::drive::{has_python, odd};
use crate::support::Place;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

const AWAY: &str = "policy away for hsr {\n    go(kitchen_table)\n}\n";

/// What most drivers do: a start is accepted, and is over at once.
const AT_ONCE: &str = "    if m['method'] == 'start':\n        say({'id': m['id'], 'result': {}})\n        say({'method': 'ended', \
     'params': {'goal': m['params']['goal'], 'outcome': {'success': None}}})\n";

/// A policy and a driver in a folder, which runs there.
fn place(name: &str, then: &str) -> Place {
    Place::new(name).file("away.motet", AWAY).file("driver.py", odd(then))
}

const DRIVE: [&str; 10] = [
    "drive",
    "away.motet",
    "--robot",
    "hsr",
    "--scene",
    "kitchen",
    "--record",
    "run",
    "--driver",
    "python3 driver.py",
];

fn drive(place: &Place) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motet"));
    command.args(DRIVE).current_dir(place.path("")).stdout(Stdio::piped()).stderr(Stdio::piped());
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command.spawn().unwrap()
}

/// Waits until a file says something, half a minute at most.
fn wait_for(path: PathBuf, word: &str) {
    for _ in 0..600 {
        if std::fs::read_to_string(&path).is_ok_and(|text| text.contains(word)) {
            return;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    panic!("{} does not say {word}", path.display());
}

#[test]
fn a_safe_stop_is_asked_for_again_after_a_crash() {
    if !has_python() {
        return;
    }
    // The first time it loses the goal, and stops nothing.
    let place = place(
        "crash_stop",
        "    import os\n    good = os.path.exists('good')\n    goal = {'goal': m['params'].get('goal')}\n    \
         states = [{'goal': it, 'state': 'unknown'} for it in m['params'].get('goals', [])]\n    \
         if 'id' in m: say({'id': m['id'], 'result': {'goals': states} if states else {}})\n    \
         if m['method'] == 'start': say({'method': 'lost', 'params': goal})\n    \
         if m['method'] == 'safe_stop' and good: say({'method': 'stopped', 'params': goal})\n",
    );
    let mut first = drive(&place);
    let journal = place.path("run/000000000000.journal");
    wait_for(journal.clone(), "{\"safe_stop\":");
    // Other entries come after it.
    let known = std::fs::read_to_string(&journal).unwrap().lines().count();
    while std::fs::read_to_string(&journal).unwrap().lines().count() < known + 3 {
        std::thread::sleep(Duration::from_millis(50));
    }
    first.kill().unwrap();
    first.wait().unwrap();
    let place = place.file("good", "");
    place.run("run --resume run").check(3, &["out:failed with `timeout`"]);
    place.run("replay run").check(0, &["out:the same to the byte"]);
}

#[test]
fn a_driver_has_time_to_stop_when_the_host_goes() {
    if !has_python() {
        return;
    }
    let bye = "    if m['method'] == 'bye':\n        time.sleep(1)\n        open('stands', 'w').close()\n";
    let place = place("crash_bye", &format!("{AT_ONCE}{bye}"));
    place.run_args(&DRIVE.map(str::to_owned)).check(0, &[]);
    assert!(place.path("stands").exists(), "it was killed while it braked");
}

#[cfg(unix)]
#[test]
fn an_interrupt_at_the_terminal_leaves_the_driver_alive() {
    if !has_python() {
        return;
    }
    let place = place(
        "crash_interrupt",
        "    if 'id' in m: say({'id': m['id'], 'result': {}})\n    if m['method'] == 'cancel': say({'method': 'ended', \
         'params': {'goal': m['params']['goal'], 'outcome': 'interrupted'}})\n",
    );
    let host = drive(&place);
    wait_for(place.path("run/000000000000.journal"), "\"acknowledged\"");
    // A terminal says it to all that runs in the foreground.
    let killed = Command::new("kill").args(["-INT", "--", &format!("-{}", host.id())]).status().unwrap();
    assert!(killed.success());
    let output = host.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(!said.contains("calling the driver again"), "{said}");
}

#[test]
fn what_is_nested_too_deep_for_a_journal_is_refused() {
    if !has_python() {
        return;
    }
    let place = place(
        "crash_deep",
        "    goal = {'goal': m['params'].get('goal')}\n    \
         if m['method'] == 'safe_stop': say({'method': 'stopped', 'params': goal})\n    \
         if m['method'] == 'start':\n        value = {'entity': 'mug_1'}\n        for _ in range(60): value = {'list': [value]}\n        \
         say({'method': 'ended', 'params': dict(goal, outcome={'success': value})})\n",
    );
    let ran = place.run_args(&DRIVE.map(str::to_owned));
    ran.check(3, &["err:it is nested more than 32 deep", "out:failed with"]);
    place.run("replay run").check(0, &["out:the same to the byte"]);
}
