//! `motet run --driver`: the example driver in another process, and drivers that misbehave.

use crate::support::{GOOD, Place, eventually};
use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A policy that goes once.
pub(crate) const AWAY: &str = "policy away for hsr {\n    go(kitchen_table)\n}\n";
const ECHO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/drivers/echo.py");

/// Checks that Python is installed, which runs the drivers.
pub(crate) fn has_python() -> bool {
    let found = Command::new("python3").arg("--version").output().is_ok_and(|output| output.status.success());
    if !found {
        println!("skipped: there is no python3");
    }
    found
}

/// The command line that has a driver do a policy.
pub(crate) fn driven(policy: &str, driver: &str) -> Vec<String> {
    ["run", policy, "--robot", "hsr", "--scene", "kitchen", "--driver", driver].map(str::to_owned).to_vec()
}

/// The same, with a journal in the folder `run`.
pub(crate) fn recorded(policy: &str, driver: &str) -> Vec<String> {
    [driven(policy, driver), vec!["--record".to_owned(), "run".to_owned()]].concat()
}

/// A driver that greets, and then does what stands in `then` at each further message `m`.
pub(crate) fn odd(then: &str) -> String {
    format!(
        "import sys,json,time\n\
         live = False\n\
         def say(x): print(json.dumps(dict(x, jsonrpc='2.0')), flush=True)\n\
         for line in sys.stdin:\n\
         \x20   m = json.loads(line)\n\
         \x20   if m['method'] == 'hello':\n\
         \x20       say({{'id': m['id'], 'result': {{'protocol': 2, 'driver': 'odd', 'instance': 'x',\n\
         \x20           'capabilities': {{'hold': 'all', 'update': {{'only': []}}}}}}}})\n\
         \x20       continue\n\
         \x20   if m['method'] == 'ping' and not live:\n\
         \x20       live = True\n\
         \x20       say({{'id': m['id'], 'result': {{}}}})\n\
         \x20       continue\n\
         {then}"
    )
}

#[test]
fn run_refuses_simulator_flags_with_another_driver() {
    let place = Place::new("driver_flags").file("good.motet", GOOD).file("none.json", "{}");
    place.run("drive good.motet --driver tcp://127.0.0.1:4711").check(
        2,
        &["err:there is no `motet drive` any more", "err:`motet run FILE --driver COMMAND|ADDRESS`"],
    );
    for flag in ["--faults none.json", "--answers none.json", "--profile harsh", "--world lab", "--seed 3"] {
        let name = flag.split(' ').next().unwrap();
        let refused =
            format!("err:`{name}` is for the simulators, `kinematic` and `mujoco`, not for another driver");
        place.run(&format!("run good.motet --scene kitchen --driver cat {flag}")).check(2, &[&refused]);
        let physics = place.run(&format!("run good.motet --driver mujoco {flag}"));
        assert!(!physics.stderr.contains(&refused[4..]), "{physics:#?}");
    }
    let line = "run good.motet --scene kitchen --driver kinematic --seed 3 --profile ideal --speed max";
    place.run(line).check(0, &["out:✓ tidy: done"]);
    place.run("run --check").check(2, &["err:`--check` leads a driver in another process"]);
    place.run("run").check(2, &["err:<FILE"]);
}

#[test]
fn physics_gets_the_robot_the_scene_and_the_seed_of_the_run() {
    if !has_python() {
        return;
    }
    // A package of the same name, which does what the example does.
    let stand_in = format!(
        "import runpy, sys\nprint(sys.argv[1:], file=sys.stderr)\n\
         sys.argv = ['echo', '--clock', 'driver']\nrunpy.run_path({ECHO:?}, run_name='__main__')\n"
    );
    let place = Place::new("driver_physics")
        .file("good.motet", GOOD)
        .file("say.motet", "policy hello for hsr {\n    say(\"Hello!\")\n}\n")
        .file("mujoco.py", "")
        .file("numpy.py", "")
        .file("motet_mujoco/__init__.py", "")
        .file("motet_mujoco/__main__.py", stand_in);
    place.run("run good.motet --scene kitchen --driver mujoco --seed 7 --speed max --record run").check(
        0,
        &[
            "out:✓ tidy: done",
            "err:['--robot', 'hsr', '--scene', 'kitchen', '--seed', '7', '--profile', 'typical', '--motet', ",
        ],
    );
    place.run("replay run").check(0, &["out:identical"]);
    // What is real, what people answer and what goes wrong goes on to it; the names in it are checked before.
    let place = place
        .file("yes.json", "[\"yes\", null]")
        .file("faults.json", r#"{"calls": [{"primitive": "say", "then": {"slower": 2}}]}"#)
        .file("odd.json", r#"{"calls": [{"primitive": "fly", "then": "hangs"}]}"#);
    let line =
        "run good.motet --scene kitchen --driver mujoco --speed max --world lab --answers yes.json --faults";
    place.run(&format!("{line} faults.json")).check(
        0,
        &["err:'--scene', 'lab', '--seed', '0', '--told', 'kitchen', '--profile', 'typical', '--faults', \
             'faults.json', '--answers-file', 'yes.json'"],
    );
    place.run(&format!("{line} odd.json")).check(2, &["err:fly"]);
    // How the hand holds a thing at the start is told, too.
    let state = r#"{"holding(mug_1)": true, "grip(mug_1)": {"xyz": [0, 0, 0.1]}}"#;
    let words = "run say.motet --robot hsr --scene kitchen --speed max --driver mujoco --state";
    let mut words: Vec<String> = words.split(' ').map(str::to_owned).collect();
    words.push(state.to_owned());
    place.run_args(&words).check(0, &[]);
    place
        .run("run say.motet --driver mujoco")
        .check(2, &["err:`--driver mujoco` needs a scene: give --scene"]);
}

#[cfg(unix)]
#[test]
fn physics_that_is_not_installed_is_explained() {
    let place = Place::new("driver_no_physics").file("good.motet", GOOD);
    let line = "run good.motet --scene kitchen --driver mujoco";
    let script = "mkdir bin none && cd bin && printf '#!/bin/sh\\necho motet_mujoco mujoco\\n' >python3 \
                  && chmod +x python3";
    place.shell(script).check(0, &[]);
    let with =
        |folder: &str| place.run_with(line, b"", &[("PATH", &place.path(folder).display().to_string())]);
    with("bin").check(
        2,
        &[
            "err:modules that `python3` does not find: `motet_mujoco`, `mujoco`",
            "err:`pip install runtime/mujoco`",
        ],
    );
    with("none")
        .check(2, &["err:`--driver mujoco` cannot start `python3`", "err:install Python 3.11 or later"]);
}

#[test]
fn drives_the_example() {
    if !has_python() {
        return;
    }
    let place = Place::new("drive").file("good.motet", GOOD);
    let echo = format!("python3 {ECHO} --seconds 0.05");
    let args = |driver: &str| driven("good.motet", driver);
    place.run_args(&args(&echo)).check(0, &["out:✓ tidy: done", "out:5 steps done, 0 failed"]);
    let refusing = format!("{echo} --refuse pick");
    place.run_args(&args(&refusing)).check(3, &["out:failed with `unreachable`"]);
    place.run_args(&args("no/such/driver")).check(2, &["err:the driver cannot be reached"]);
    place.run_args(&args("tcp://192.0.2.1:1")).check(2, &["err:is not on this machine"]);
    place.run_args(&args("echo hello")).check(2, &["err:the driver said `hello", "err:is no message"]);
}

#[test]
fn policy_with_a_primitive_that_the_driver_lacks_is_refused_before_anything_moves() {
    if !has_python() {
        return;
    }
    // It has `go` and `say`, and writes down what it does.
    let package = concat!(env!("CARGO_MANIFEST_DIR"), "/../python");
    let driver = format!(
        "import sys\nsys.path.append({package:?})\nimport motet\n\
         class Cart(motet.Driver):\n\
         \x20   async def go(self, goal, to):\n\
         \x20       print('moves', file=sys.stderr)\n\
         \x20       await goal.sleep(0.3)\n\
         \x20   async def say(self, goal, text): pass\n\
         motet.serve(Cart())\n"
    );
    let place =
        Place::new("drive_lacks").file("good.motet", GOOD).file("away.motet", AWAY).file("cart.py", driver);
    let cart = format!("python3 '{}'", place.path("cart.py").display());
    place.run_args(&driven("away.motet", &cart)).check(0, &["out:✓ away: done", "err:moves"]);
    let refused = place.run_args(&driven("good.motet", &cart));
    let text = "err:refused: the driver does not have `detect` (good.motet:3), `pick` (good.motet:4), \
                `place` (good.motet:6); nothing has moved";
    refused.check(1, &[text]);
    assert!(!refused.stderr.contains("moves"), "{refused:#?}");
    let json = [driven("good.motet", &cart), vec!["--format".to_owned(), "json".to_owned()]].concat();
    let event =
        "out:{\"event\":\"refused\",\"missing\":[{\"primitive\":\"detect\",\"path\":\"/steps/1\",\"line\":3}";
    place.run_args(&json).check(1, &[event]);
    let check = ["run", "good.motet", "--scene", "kitchen", "--check", "--driver", &cart];
    place
        .run_args(&check.map(str::to_owned))
        .check(0, &["out:✓ a primitive that it lacks", "out:Cart keeps the laws"]);
    let request = ["do", "bring me the red mug", "--robot", "hsr", "--scene", "kitchen", "--driver", &cart];
    let undone = place.run_args(&request.map(str::to_owned));
    undone.check(3, &["err:The driver of the robot does not have `search`, `pick` and `handover`"]);
    assert!(!undone.stderr.contains("moves"), "{undone:#?}");
}

#[test]
fn driver_that_misbehaves_is_named_and_stopped_safely() {
    if !has_python() {
        return;
    }
    let place = Place::new("drive_odd").file("away.motet", AWAY);
    let stop = "    if m['method'] == 'safe_stop':\n        say({'id': m['id'], 'result': {}})\n        \
                say({'method': 'stopped', 'params': m['params']})\n";
    for (name, then, message) in [
        ("dies", format!("{stop}    if m['method'] == 'start': sys.exit(1)\n"), "the driver ended"),
        (
            "nonsense",
            format!("{stop}    if m['method'] == 'start': print('ouch', flush=True)\n"),
            "the driver said `ouch`, which is no message",
        ),
        (
            "floods",
            format!("{stop}    if m['method'] == 'start': print('x' * 2000000, flush=True)\n"),
            "the driver said a line of more than 1048576 bytes",
        ),
        (
            "lies",
            format!(
                "{stop}    while m['method'] == 'start': say({{'method': 'ended', 'params': {{'goal': 99, \
                 'outcome': 'interrupted'}}}})\n"
            ),
            "the driver broke its promises more than 1000 times",
        ),
        (
            "chatters",
            format!(
                "{stop}    if m['method'] == 'start': say({{'id': m['id'], 'result': {{}}}})\n    \
                 while m['method'] == 'start': time.sleep(0.0005); say({{'method': 'feedback', \
                 'params': {{'goal': m['params']['goal'], 'text': 'x'}}}})\n"
            ),
            "the driver broke its promises more than 1000 times",
        ),
        (
            "reports",
            format!(
                "{stop}    while m['method'] == 'start': say({{'method': 'observed', 'params': {{'query': \
                 {{'fact': {{'fluent': 'visible', 'args': [{{'is': {{'entity': 'mug_1'}}}}]}}}}, 'answer': \
                 {{'truth': True}}}}}})\n"
            ),
            "the driver said more than 2000 `observed` that are not watched in a second",
        ),
        (
            "detects",
            format!(
                "{stop}    at = {{'quaternion': [0, 0, 0, 1]}}\n    seen = [{{'label': 'cup', \
                 'pose': dict(at, xyz=[i, 0, 1]), 'extent': [0.1, 0.1, 0.1], \
                 'confidence': 1}} for i in range(500)]\n    while m['method'] == \
                 'start': say({{'method': 'detected', 'params': {{'detections': seen}}}})\n"
            ),
            "the driver said more than 5000 things `detected` in a second",
        ),
        (
            "keeps silent",
            format!("{stop}    if m['method'] == 'ping': say({{'id': m['id'], 'result': {{}}}})\n"),
            "does not say whether goal #1 runs",
        ),
        ("stalls", format!("{stop}    if m['method'] == 'start': time.sleep(60)\n"), "gave no sign of life"),
    ] {
        println!("{name}");
        let driver = place.path(name);
        std::fs::write(&driver, odd(&then)).unwrap();
        let ran = place.run_args(&driven("away.motet", &format!("python3 '{}'", driver.display())));
        ran.check(3, &[&format!("err:{message}"), "out:failed with"]);
    }
}

#[test]
fn driver_that_dies_or_says_nothing_more_ends_the_run_soon() {
    if !has_python() {
        return;
    }
    let waits = "policy waits for hsr {\n    wait until near(user) within 300 s\n}\n";
    let place = Place::new("drive_dies").file("away.motet", AWAY).file("waits.motet", waits);
    let ends = |name: &str, policy: &str, driver: String| {
        let path = place.path(name);
        std::fs::write(&path, driver).unwrap();
        let begun = Instant::now();
        let ran = place.run_args(&driven(policy, &format!("python3 '{}'", path.display())));
        (ran, begun.elapsed().as_secs_f64())
    };
    let mute = odd("").replace("if m['method'] == 'ping' and not live", "if False");
    // At its greeting, at what it hears next, deaf or dumb from then on.
    for (name, driver, why) in [
        (
            "dies",
            odd("").replacen("continue", "sys.exit(0)", 1),
            "the driver ended, or closed the connection",
        ),
        ("mute", mute.clone(), "and then nothing for 2.0 s; it was told to do nothing"),
        ("deaf", mute.replacen("continue", "time.sleep(60)", 1), "and then nothing for 2.0 s"),
    ] {
        let (ran, secs) = ends(name, "away.motet", driver);
        ran.check(2, &[&format!("err:{why}")]);
        assert!(!ran.stdout.contains('▶') && secs < 5.0, "{name}: {secs} s: {ran:#?}");
    }
    // Once it was told to move, what it does is not known.
    let (ran, secs) = ends("goes", "away.motet", odd("    sys.exit(0)\n"));
    ran.check(3, &["out:confirmed neither a cancel nor a safe stop; the robot may still move"]);
    ran.check(3, &["out:it was at `go(kitchen_table)`"]);
    assert!(secs < 12.0, "{secs}");
    // One that greets well each time, and dies as soon as it is asked to watch.
    let dies = odd(
        "    if m['method'] == 'watch': sys.exit(0)\n    if 'id' in m: say({'id': m['id'], 'result': {}})\n",
    );
    let (ran, secs) = ends("watch", "waits.motet", dies);
    ran.check(3, &["out:failed with `timeout`"]);
    assert!(secs < 8.0, "{secs} s: {ran:#?}");
    // Nothing moves while it is waited for: it is called again, and is as silent. It falls silent where it
    // was asked for what is watched, or has answered that.
    for (name, answers, secs_in) in [("falls", 1, 5.0..10.0), ("rests", 2, 3.0..7.5)] {
        let begin = format!("import os\nlive = {answers} if os.path.exists('{name}ed') else 0");
        let once = odd("").replace("live = False", &begin);
        let once = once.replace("live = True", &format!("open('{name}ed', 'w')\n        live += 1"));
        let once =
            once.replace("m['method'] == 'ping' and not live", &format!("live < {answers} and 'id' in m"));
        let once = once.replace("'result': {}", "'result': {'answer': {'truth': False}}");
        let (ran, secs) = ends(name, "waits.motet", once);
        ran.check(
            3,
            &["err:gave no sign of life", "err:it was told to do nothing", "out:failed with `timeout`"],
        );
        assert!(secs_in.contains(&secs), "{name}: {secs} s: {ran:#?}");
    }
}

#[test]
fn driver_texts_neither_steer_the_terminal_nor_fill_it() {
    if !has_python() {
        return;
    }
    let place = Place::new("drive_rude").file("away.motet", AWAY);
    let start = "    if m['method'] == 'start':\n        say({'id': m['id'], 'result': {}})\n";
    let ends = |kind: &str| {
        format!(
            "{start}        print('b\\x1b[31mc', file=sys.stderr)\n        \
             say({{'method': 'feedback', 'params': {{'goal': m['params']['goal'], 'text': \
                'a\\x1b[2Jb', 'own_motion': True}}}})\n        \
             say({{'method': 'ended', 'params': {{'goal': m['params']['goal'], 'outcome': {{'failure': \
                 {kind}}}}}}})\n"
        )
    };
    for (name, kind, texts) in [
        (
            "own",
            "'too_hot'",
            &["out:▶ go(kitchen_table)", "out:go(kitchen_table)  too_hot", "out:failed with `too_hot`"][..],
        ),
        ("long", "'x' * 900000", &["out:failed with `failed`", "err:is no name, so it is `failed`: xxx"]),
        (
            "steers",
            "'a\\x1b]0;b'",
            &["out:failed with `failed`", "err:is no name, so it is `failed`: a\\u{1b}]0;b"],
        ),
    ] {
        println!("{name}");
        let driver = place.path(name);
        std::fs::write(&driver, odd(&ends(kind))).unwrap();
        let ran = place.run_args(&driven("away.motet", &format!("python3 '{}'", driver.display())));
        ran.check(3, texts).check(3, &["err:a motion of its own: a\\u{1b}[2Jb", "err:b\\u{1b}[31mc"]);
        let shown = format!("{}{}", ran.stdout, ran.stderr);
        assert!(!shown.contains('\u{1b}') && shown.len() < 10_000, "{ran:#?}");
        assert!(!ran.stdout.contains("simulated"), "{ran:#?}");
    }
}

#[test]
fn driver_errors_come_whole_and_a_flood_of_them_is_cut() {
    if !has_python() {
        return;
    }
    let place = Place::new("drive_errors").file("away.motet", AWAY);
    let dies = "    if m['method'] == 'start':\n        raise SystemExit('no motor')\n";
    let floods = dies.replace("raise", "sys.stderr.write('x' * 9000 + 'y\\n' * 200000)\n        raise");
    for (name, script) in [("dies", dies), ("floods", floods.as_str())] {
        let driver = place.path(name);
        std::fs::write(&driver, odd(script)).unwrap();
        let ran = place.run_args(&driven("away.motet", &format!("python3 '{}'", driver.display())));
        let lines = ran.stderr.lines().count();
        assert!(ran.stderr.contains("no motor"), "{name}: {lines}");
        assert!(ran.stderr.contains("\n…\n") == (name == "floods") && lines < 20_000, "{name}: {lines}");
    }
}

#[test]
fn killed_and_resumed_the_driver_in_another_process_does_nothing_twice() {
    if !has_python() {
        return;
    }
    let place = Place::new("drive_crash").file("good.motet", GOOD);
    let mut echo = Echo::start();
    let driver = echo.address();
    let mut first = Command::new(env!("CARGO_BIN_EXE_motet"))
        .args(recorded("good.motet", &driver))
        .current_dir(place.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let journal = place.path("run/000000000000.journal");
    let starts =
        || std::fs::read_to_string(&journal).unwrap_or_default().matches("\"start\":{\"goal\":").count();
    // In the midst of it, however slow the machine is.
    eventually(|| starts() >= 1 || first.try_wait().unwrap().is_some());
    first.kill().unwrap();
    first.wait().unwrap();
    // A journal calls nobody by itself.
    let refused = format!("err:give it again, if you trust it: --driver {driver}");
    place.run("run --resume run").check(2, &["err:a journal starts none by itself", &refused]);
    let line = format!("run --resume run --driver {driver}");
    place.run(&line).check(0, &["out:✓ tidy: done", "err:resumed at"]);
    place.run("replay run").check(0, &["out:identical"]);
    assert_eq!(starts(), 5, "five steps, five starts");
    let text = std::fs::read_to_string(&journal).unwrap();
    assert_eq!(text.matches("{\"ended\":{\"goal\":").count(), 5, "five ends");
}

#[test]
fn check_tells_the_laws_that_a_driver_breaks() {
    if !has_python() {
        return;
    }
    let check = |place: &Place, driver: &str, more: &[&str]| {
        let args = [&["run", "--check", "--driver", driver], more].concat();
        place.run_args(&args.iter().map(|arg| (*arg).to_owned()).collect::<Vec<_>>())
    };
    let place = Place::new("drive_check").file("away.motet", AWAY);
    let echo = format!("python3 {ECHO} --clock driver");
    check(&place, &echo, &[]).check(0, &["out:✓ to the end", "out:echo 2.0 keeps the laws, with say("]);
    let policy = ["away.motet", "--scene", "kitchen"];
    check(&place, &echo, &policy).check(0, &["out:✓ held", "out:keeps the laws, with go(to: kitchen_table)"]);
    check(&place, "no/such/driver", &[]).check(2, &["err:the driver cannot be reached"]);
    // It says twice, and with its own word, that every goal has failed, and takes no notice of a safe stop.
    let then = "\x20   say({'id': m['id'], 'result': {'now': 0, 'answer': 'unknown'}})\n\
                \x20   if m['method'] == 'start':\n\
                \x20       for _ in 'ab': say({'method': 'ended', 'params': {'goal': m['params']['goal'],\n\
                \x20           'outcome': {'failure': 'melted'}}})\n";
    let driver = place.path("double");
    std::fs::write(&driver, odd(then)).unwrap();
    let double = format!("python3 '{}'", driver.display());
    check(&place, &double, &["--patience", "0.3"]).check(
        1,
        &[
            "out:✗ stopped safely: a safe stop is always answered",
            "out:`say` failed with `melted`, which it does not declare",
            "out:has ended, it says, but it does not run",
            "out:    > {\"jsonrpc\":\"2.0\",\"id\":2,\"method\":\"start\"",
            "out:✓ observed",
        ],
    );
    check(&place, &double, &["--patience", "0.3", "--format", "json"])
        .check(1, &["out:{\"scene\":\"to the end\",\"broken\":[{\"law\":"]);
    check(&place, &echo, &["--patience", "0"]).check(2, &["err:`--patience` is a number of seconds above 0"]);
}

#[test]
fn driver_that_owns_the_clock_runs_at_any_speed() {
    if !has_python() {
        return;
    }
    let place = Place::new("drive_clock").file("good.motet", GOOD);
    let with = |driver: String, more: &[&str]| {
        let more: Vec<String> = more.iter().map(|arg| (*arg).to_owned()).collect();
        place.run_args(&[driven("good.motet", &driver), more].concat())
    };
    let slow = format!("python3 {ECHO} --seconds 1.5 --clock driver");
    with(slow, &["--speed", "max", "--record", "run"]).check(0, &["out:✓ tidy: done"]);
    place.run("replay run").check(0, &["out:identical"]);
    let wall = format!("python3 {ECHO} --seconds 0.05");
    with(wall, &["--speed", "max"]).check(2, &["err:this driver goes by the clock on the wall"]);
}

/// A driver on a port outlives its host, but what it does not for long.
#[test]
fn driver_that_lost_its_host_stops_by_itself() {
    if !has_python() {
        return;
    }
    let mut echo = Echo::start_with(&["--seconds", "600", "--grace", "0.2"]);
    let address = echo.address();
    let port = address.strip_prefix("tcp://").unwrap();
    let say = |calls: &[&str]| {
        let mut stream = TcpStream::connect(port).unwrap();
        for (id, call) in calls.iter().enumerate() {
            writeln!(stream, "{{\"jsonrpc\": \"2.0\", \"id\": {id}, {call}}}").unwrap();
        }
        let lines = BufReader::new(stream).lines().take(calls.len());
        lines.map(Result::unwrap).collect::<Vec<String>>()
    };
    let hello = r#""method": "hello", "params": {"protocol": 2, "run": "r", "resumed": false, "robot": "hsr",
        "policy": "p", "primitives": []}"#;
    let hello = &hello.replace('\n', " ");
    let start =
        r#""method": "start", "params": {"goal": 7, "command": {"primitive": "go", "args": [], "uses": []}}"#;
    let status = r#""method": "status", "params": {"goals": [7]}"#;
    let said = say(&[hello, start, status]);
    assert!(said.iter().any(|line| line.contains("\"running\"")), "{said:?}");
    // Nobody says goodbye, and nobody comes back in time.
    sleep(Duration::from_secs(1));
    let said = say(&[hello, status]);
    assert!(said.iter().any(|line| line.contains("\"stopped\"")), "{said:?}");
}

/// The example driver on a port of its own.
pub(crate) struct Echo(Child);

impl Echo {
    fn start() -> Self {
        Self::start_with(&["--seconds", "0.4"])
    }

    pub(crate) fn start_with(args: &[&str]) -> Self {
        let child = Command::new("python3")
            .args([ECHO, "--port", "0"])
            .args(args)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        Self(child)
    }

    pub(crate) fn address(&mut self) -> String {
        let mut line = String::new();
        BufReader::new(self.0.stdout.take().unwrap()).read_line(&mut line).unwrap();
        line.trim().strip_prefix("listening on ").unwrap().to_owned()
    }
}

impl Drop for Echo {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
