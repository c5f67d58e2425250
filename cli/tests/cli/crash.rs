//! Drivers in another process and a host that end at bad moments.

use crate::driver::{AWAY, has_python, odd, recorded};
use crate::support::{Place, eventually};
use std::process::{Child, Command, Stdio};

/// Replies of a simple driver: it accepts each start and ends it at once.
const AT_ONCE: &str = "    if m['method'] == 'start':\n        say({'id': m['id'], 'result': {}})\n        \
    say({'method': 'ended', \
     'params': {'goal': m['params']['goal'], 'outcome': {'success': None}}})\n";

/// A policy and a driver in a folder, which runs there.
fn place(name: &str, then: &str) -> Place {
    Place::new(name).file("away.motet", AWAY).file("driver.py", odd(then))
}

fn line() -> Vec<String> {
    recorded("away.motet", "python3 driver.py")
}

fn drive(place: &Place) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motet"));
    command.args(line()).current_dir(place.path("")).stdout(Stdio::piped()).stderr(Stdio::piped());
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command.spawn().unwrap()
}

/// Starts a command line with the driver of a place.
fn start(place: &Place, line: &str) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motet"));
    command.args(line.split(' ')).args(["--driver", "python3 driver.py"]).current_dir(place.path(""));
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

const JOURNAL: &str = "run/000000000000.journal";

#[test]
fn safe_stop_is_asked_for_again_after_a_crash() {
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
    assert!(eventually(|| place.says(JOURNAL, "{\"safe_stop\":")));
    // Other entries come after it.
    let known = place.read(JOURNAL).lines().count();
    assert!(eventually(|| place.read(JOURNAL).lines().count() >= known + 3));
    first.kill().unwrap();
    first.wait().unwrap();
    let place = place.file("good", "");
    let again = ["run", "--resume", "run", "--driver", "python3 driver.py"].map(str::to_owned);
    place.run_args(&again).check(3, &["out:failed with `timeout`"]);
    place.run("replay run").check(0, &["out:identical"]);
}

#[test]
fn driver_has_time_to_stop_when_the_host_goes() {
    if !has_python() {
        return;
    }
    let bye = "    if m['method'] == 'bye':\n        time.sleep(1)\n        open('stands', 'w').close()\n";
    let place = place("crash_bye", &format!("{AT_ONCE}{bye}"));
    place.run_args(&line()).check(0, &[]);
    assert!(place.path("stands").exists(), "it was killed while it braked");
}

#[cfg(unix)]
#[test]
fn interrupt_at_the_terminal_leaves_the_driver_alive() {
    if !has_python() {
        return;
    }
    let place = place(
        "crash_interrupt",
        "    if 'id' in m: say({'id': m['id'], 'result': {}})\n    if m['method'] == 'cancel': \
            say({'method': 'ended', \
         'params': {'goal': m['params']['goal'], 'outcome': 'interrupted'}})\n",
    );
    let host = drive(&place);
    assert!(eventually(|| place.says(JOURNAL, "\"acknowledged\"")));
    // A terminal says it to all that runs in the foreground.
    let killed = Command::new("kill").args(["-INT", "--", &format!("-{}", host.id())]).status().unwrap();
    assert!(killed.success());
    let output = host.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(!said.contains("calling the driver again"), "{said}");
}

#[cfg(unix)]
#[test]
fn signals_to_end_stop_the_robot_first() {
    if !has_python() {
        return;
    }
    let place = place(
        "crash_signals",
        "    if 'id' in m: say({'id': m['id'], 'result': {}})\n    if m['method'] == 'cancel':\n        \
         time.sleep(1.5)\n        open('stands', 'w').close()\n        say({'method': 'ended', \
         'params': {'goal': m['params']['goal'], 'outcome': 'interrupted'}})\n",
    );
    let host = drive(&place);
    assert!(eventually(|| place.says(JOURNAL, "\"acknowledged\"")));
    for (signal, pause) in [("-TERM", 500), ("-HUP", 300), ("-INT", 0)] {
        assert!(Command::new("kill").args([signal, &host.id().to_string()]).status().unwrap().success());
        std::thread::sleep(std::time::Duration::from_millis(pause));
    }
    let output = host.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(place.path("stands").exists(), "it left while the robot moved");
    assert_eq!(said.matches("may still move the robot: go(to: kitchen_table)").count(), 2, "{said}");
}

#[cfg(unix)]
#[test]
fn signals_to_end_name_what_still_runs_in_a_conversation() {
    if !has_python() {
        return;
    }
    // The first command ends at once, the second only some time after it is cancelled.
    let place = place(
        "crash_conversation",
        "    goal = {'goal': m['params'].get('goal')}\n    \
         if m['method'] in ('observe', 'watch'):\n        \
         say({'id': m['id'], 'result': {'answer': 'unknown'}})\n    \
         elif 'id' in m: say({'id': m['id'], 'result': {}})\n    \
         if m['method'] == 'start' and 'kitchen_table' in line: \
         say({'method': 'ended', 'params': dict(goal, outcome={'success': None})})\n    \
         elif m['method'] == 'start': open('moves', 'w').close()\n    \
         if m['method'] == 'cancel':\n        time.sleep(1.5)\n        \
         say({'method': 'ended', 'params': dict(goal, outcome='interrupted')})\n",
    );
    let request = "go_to_the_kitchen_table_and_then_go_to_the_counter";
    let host = start(&place, &format!("do {request} --robot hsr --scene kitchen"));
    assert!(eventually(|| place.path("moves").exists()));
    for pause in [500, 0] {
        assert!(Command::new("kill").args(["-TERM", &host.id().to_string()]).status().unwrap().success());
        std::thread::sleep(std::time::Duration::from_millis(pause));
    }
    let output = host.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(said.contains("may still move the robot: go(to: counter)\nthe run ends"), "{said}");
}

#[cfg(unix)]
#[test]
fn signals_to_end_give_a_failure_where_the_driver_confirms_no_stop() {
    if !has_python() {
        return;
    }
    let place = place(
        "crash_unstopped",
        "    if m['method'] in ('observe', 'watch'):\n        \
         say({'id': m['id'], 'result': {'answer': 'unknown'}})\n    \
         elif m['method'] in ('cancel', 'safe_stop'): sys.exit()\n    \
         elif 'id' in m: say({'id': m['id'], 'result': {}})\n    \
         if m['method'] == 'start': open('moves', 'w').close()\n",
    );
    for line in ["run away.motet", "do go_to_the_kitchen_table", "talk"] {
        let mut host = start(&place, &format!("{line} --robot hsr --scene kitchen"));
        std::io::Write::write_all(host.stdin.as_mut().unwrap(), b"go to the kitchen table\n").unwrap();
        assert!(eventually(|| place.path("moves").exists()), "{line}");
        Command::new("kill").args(["-HUP", &host.id().to_string()]).status().unwrap();
        let output = host.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{line}: {output:?}");
        std::fs::remove_file(place.path("moves")).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn signals_to_end_break_the_check_of_a_driver_off() {
    if !has_python() {
        return;
    }
    let place = place(
        "crash_check",
        "    if 'id' in m: say({'id': m['id'], 'result': {}})\n    \
         if m['method'] == 'start': open('moves', 'w').close()\n",
    );
    let mut host = start(&place, "run --check --patience 600");
    assert!(eventually(|| place.path("moves").exists()));
    Command::new("kill").args(["-TERM", &host.id().to_string()]).status().unwrap();
    let ends = eventually(|| host.try_wait().unwrap().is_some());
    host.kill().unwrap();
    let output = host.wait_with_output().unwrap();
    assert!(ends, "it waits for the driver");
    assert_eq!((output.status.code(), output.stdout.as_slice()), (Some(130), &b""[..]));
}

#[cfg(target_os = "linux")]
#[test]
fn robot_stops_while_nobody_reads_the_output() {
    use std::io::Write as _;
    if !has_python() {
        return;
    }
    let place = place(
        "crash_unread",
        "    goal = {'goal': m['params'].get('goal')}\n    \
         if m['method'] in ('observe', 'watch'):\n        \
         say({'id': m['id'], 'result': {'answer': 'unknown'}})\n    \
         elif 'id' in m: say({'id': m['id'], 'result': {}})\n    \
         if m['method'] == 'start': open('moves', 'w').close()\n    \
         if m['method'] == 'cancel':\n        open('stands', 'w').close()\n        \
         say({'method': 'ended', 'params': dict(goal, outcome='interrupted')})\n",
    );
    for line in ["run away.motet", "run away.motet --format json", "do", "talk"] {
        // A pipe that holds no byte more.
        let (reader, mut full) = std::io::pipe().unwrap();
        full.write_all(&[b'x'; 1 << 16]).unwrap();
        let request = (line == "do").then_some("go to the kitchen table");
        let mut host = Command::new(env!("CARGO_BIN_EXE_motet"))
            .args(line.split(' ').chain(request))
            .args(["--robot", "hsr", "--scene", "kitchen", "--driver", "python3 driver.py"])
            .current_dir(place.path(""))
            .stdin(Stdio::piped())
            .stdout(full.try_clone().unwrap())
            .stderr(full)
            .spawn()
            .unwrap();
        let mut typed = host.stdin.take().unwrap();
        typed.write_all(b"go to the kitchen table\n").unwrap();
        let moves = eventually(|| place.path("moves").exists());
        Command::new("kill").args(["-TERM", &host.id().to_string()]).status().unwrap();
        let stands = moves && eventually(|| place.path("stands").exists());
        let mut ended = None;
        eventually(|| {
            ended = host.try_wait().unwrap();
            ended.is_some()
        });
        host.kill().unwrap();
        assert!(stands, "{line}: moves: {moves}");
        assert_eq!(ended.and_then(|status| status.code()), Some(130), "{line}");
        ["moves", "stands"].iter().for_each(|name| std::fs::remove_file(place.path(name)).unwrap());
        drop((reader, typed));
    }
}

#[cfg(unix)]
#[test]
fn driver_behind_a_shell_ends_with_its_host() {
    if !has_python() {
        return;
    }
    let moves = "while True:\n    print('moves', file=open('moves', 'a'))\n    time.sleep(0.02)\n";
    let driver = format!("{}{moves}", odd(AT_ONCE));
    let place = Place::new("crash_shell").file("away.motet", AWAY).file("driver.py", driver);
    place.run_args(&recorded("away.motet", "sh -c 'python3 driver.py; true'")).check(0, &[]);
    let moved = place.read("moves").len();
    assert!(moved > 0, "the driver does not notice that its host is gone");
    std::thread::sleep(std::time::Duration::from_millis(500));
    assert_eq!(place.read("moves").len(), moved);
}

#[test]
fn journal_refuses_values_nested_too_deep() {
    if !has_python() {
        return;
    }
    let place = place(
        "crash_deep",
        "    goal = {'goal': m['params'].get('goal')}\n    \
         if m['method'] == 'safe_stop': say({'method': 'stopped', 'params': goal})\n    \
         if m['method'] == 'start':\n        value = {'entity': 'mug_1'}\n        for _ in range(60): value \
             = {'list': [value]}\n        \
         say({'method': 'ended', 'params': dict(goal, outcome={'success': value})})\n",
    );
    let ran = place.run_args(&line());
    ran.check(3, &["err:it is nested more than 32 deep", "out:failed with"]);
    place.run("replay run").check(0, &["out:identical"]);
}
