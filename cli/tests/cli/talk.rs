//! `motet talk` and `motet do` on any driver: requests, questions, and words while the robot moves.

use crate::driver::{Echo, has_python};
use crate::support::{Place, Ran};
use serde_json::Value;

/// Robot and room, in which no motion is searched.
const ROOM: &str = "--robot hsr --scene kitchen --no-geometry";
/// Flags of the simulated world, in which nothing goes wrong by itself.
const IDEAL: &str = "--profile ideal";

/// A conversation of piped lines.
fn talk(place: &Place, flags: &str, lines: &[&str]) -> Ran {
    let world = if flags.contains("--driver") { "" } else { IDEAL };
    place.run_with(&format!("talk {ROOM} {world} {flags}"), lines.join("\n").as_bytes(), &[])
}

/// A request with further words of the command line.
fn request(place: &Place, request: &str, flags: &[&str]) -> Ran {
    let mut args: Vec<String> = ["do", request].map(str::to_owned).into();
    let world = if flags.contains(&"--driver") { "" } else { IDEAL };
    args.extend(ROOM.split(' ').chain(world.split_whitespace()).map(str::to_owned));
    args.extend(flags.iter().map(|flag| (*flag).to_owned()));
    place.run_args(&args)
}

/// A conversation remembers the place of a thing that was put into a container, and opens the drawer again
/// with the thing that moved along in it.
#[test]
fn conversation_remembers_what_was_put_into_something() {
    let place = Place::new("talk_inside");
    let lines = ["put the coke in the fridge", "where is the coke?", "what is in the fridge?"];
    let told = "out:The coke can is in the refrigerator.";
    talk(&place, "--speed max", &lines).check(0, &[told, told]);
    let lines = "put the apple in the drawer\nopen the drawer\nbring me the apple";
    let flags = format!("talk --robot hsr --scene kitchen {IDEAL} --speed max");
    place.run_with(&flags, lines.as_bytes(), &[]).check(0, &["out:✓ open_drawer_1", "out:✓ bring_apple"]);
}

#[test]
fn conversation_remembers_what_was_done_and_answers_questions() {
    let place = Place::new("talk_memory");
    let lines = [
        "What do you hold?",
        "where is the coke?",
        "what did you do?",
        "pick up the coke",
        "what do you hold?",
        "is the coke on the counter?",
        "what did you do?",
        "the apple is on the counter",
        "where is the apple?",
        "wait",
    ];
    let ran = talk(&place, "--speed max", &lines);
    ran.check(
        0,
        &[
            "err:> where is the coke?",
            "out:I hold nothing.",
            "out:The coke can is on the kitchen counter.",
            "out:I have done nothing yet.",
            "out:✓ pick(coke)",
            "out:I hold the coke can.",
            "out:No. I hold the coke can.",
            "out:I looked for the coke can, and then picked up the coke can.",
            "out:I take note of that.",
            "out:The green apple is on the kitchen counter.",
            "out:I am not moving.",
        ],
    );
}

#[test]
fn conversation_ends_with_its_input_and_says_what_was_not_done() {
    let place = Place::new("talk_codes").file("lines.txt", "where is the coke?\n");
    talk(&place, "--speed max", &[]).check(0, &[]);
    for (line, texts) in [
        ("where is the teddy?", &["err:not done (not_found): I know of no teddy here."][..]),
        ("juggle with the coke", &["err:not done (ambiguous_task)"]),
    ] {
        talk(&place, "--speed max", &[line]).check(3, texts);
    }
    // One failure is enough, whatever follows.
    talk(&place, "--speed max", &["where is the teddy?", "", "where is the coke?"])
        .check(3, &["out:The coke can is on the kitchen counter."]);
    place
        .run(&format!("talk {ROOM} {IDEAL} --ask script lines.txt --format json"))
        .check(0, &["out:\"answer\":\"The coke can is on the kitchen counter.\""]);
    request(&place, "is the fridge closed?", &[]).check(0, &["out:Yes, the refrigerator is closed."]);
    request(&place, "where is the teddy?", &["--ask", "never"]).check(3, &[]);
}

#[test]
fn words_stop_and_hold_a_robot_at_every_speed() {
    let place = Place::new("talk_words");
    let bring = |flags: &[&str]| request(&place, "bring me the coke", &[&["--ask", "never"], flags].concat());
    for speed in ["max", "40"] {
        let ran = bring(&["--speed", speed, "--say", "2s: stop"]);
        ran.check(3, &["out:interrupted", "err:given up", "err:> stop"]);
        if speed == "max" {
            ran.check(3, &["out:\n  2.0 s of simulated time"]);
        }
    }
    let ended = |ran: &Ran| -> f64 {
        let mut end =
            ran.check(0, &[]).stdout.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
        end.next_back().unwrap()["at"].as_f64().unwrap()
    };
    let flags = ["--speed", "max", "--format", "json"];
    let plain = ended(&bring(&flags));
    let held = bring(&[&flags[..], &["--say", "2s: wait", "--say", "12s: go on"]].concat());
    held.check(0, &["err:keeps still", "err:goes on"]);
    let late = ended(&held) - plain;
    assert!((9.5..10.6).contains(&late), "{late} s");
    bring(&["--speed", "max", "--say", "2s: wait"])
        .check(3, &["err:stopped: nobody is there to let it go on"]);
    bring(&["--speed", "max", "--say", "2s: where is the apple?"])
        .check(0, &["out:The green apple is on the", "out:handover(coke"]);
    // What was asked for first is not done.
    bring(&["--speed", "max", "--say", "4s: bring me the apple"])
        .check(3, &["out:✓ handover(apple, user)", "err:not done", "err:Shall I go on with"]);
    for pause in ["go-on", "pause"] {
        let flags = ["--speed", "max", "--say", "4s: bring me the apple instead", "--on-instruction", pause];
        let ran = bring(&flags);
        ran.check(0, &["out:✓ handover(apple, user)"]);
        assert_eq!(ran.stderr.contains("keeps still"), pause == "pause", "{ran:#?}");
    }
    // The run waits for a policy whose motions are searched, although nobody could let it go on.
    let words = ["--say", "12s: bring me the apple instead", "--on-instruction", "pause"];
    let flags = ["do", "bring me the coke", "--robot", "hsr", "--scene", "kitchen", "--profile", "ideal"];
    let searched = [&flags[..], &["--speed", "max"], &words].concat();
    let ran = place.run_args(&searched.iter().map(|flag| (*flag).to_owned()).collect::<Vec<_>>());
    ran.check(0, &["err:keeps still", "out:✓ handover(apple, user)"]);
}

#[test]
fn words_stop_and_hold_a_run_of_one_policy() {
    let policy = "policy round for hsr {\n    go(counter)\n    go(kitchen_table)\n}\n";
    let place = Place::new("run_words").file("round.motet", policy);
    let run = |words: &[&str]| {
        let line = format!("run round.motet {ROOM} {IDEAL} --speed max");
        let said = words.iter().flat_map(|word| ["--say", word]);
        place.run_args(&line.split(' ').chain(said).map(str::to_owned).collect::<Vec<_>>())
    };
    run(&["2s: stop"]).check(3, &["err:> stop", "out:interrupted", "out:\n  2.0 s of simulated time"]);
    run(&["2s: wait", "12s: go on"]).check(0, &["err:keeps still", "err:goes on"]);
    run(&["2s: wait"]).check(3, &["err:stopped: nobody is there to let it go on"]);
    run(&["2s: bring me the apple"]).check(0, &["err:`motet do` takes other words"]);
}

#[test]
fn robot_on_a_port_is_talked_with() {
    if !has_python() {
        return;
    }
    let place = Place::new("talk_port");
    for clock in ["wall", "driver"] {
        let mut echo = Echo::start_with(&["--seconds", "0.05", "--clock", clock]);
        let driver = format!("--driver {}", echo.address());
        // Several runs on one connection, then others on connections of their own.
        let ran =
            talk(&place, &driver, &["go to the counter", "go to the kitchen table", "what did you do?"]);
        ran.check(0, &["out:✓ go(counter)", "out:✓ go(kitchen_table)", "out:I went to"]);
        request(&place, "go to the counter", &driver.split(' ').collect::<Vec<_>>())
            .check(0, &["out:✓ go(counter)"]);
        let state =
            [&driver.split(' ').collect::<Vec<_>>()[..], &["--state", "{\"on(coke, counter)\": false}"]];
        request(&place, "go to the counter", &state.concat())
            .check(0, &["err:the driver does not take `--state`"]);
    }
    request(&place, "go to the counter", &["--driver", "tcp://127.0.0.1:1"])
        .check(2, &["err:the driver cannot be reached"]);
    request(&place, "go to the counter", &["--driver", "cat", "--profile", "harsh"])
        .check(2, &["err:`--profile`"]);
}

#[test]
fn state_reaches_plans_and_worlds() {
    let place = Place::new("talk_state").file(
        "good.motet",
        "policy put for hsr {\n    go(counter)\n    \
        place(coke, counter)\n}\n",
    );
    let state = r#"{"holding(coke)": true, "free(hand)": false, "on(coke, counter)": false}"#;
    let place = place.file("held.json", state);
    let ran =
        request(&place, "put the coke on the kitchen table", &["--speed", "max", "--state", "held.json"]);
    ran.check(0, &["out:✓ place(coke, kitchen_table)"]);
    assert!(!ran.stdout.contains("pick("), "{ran:#?}");
    talk(&place, "--speed max --state held.json", &["what do you hold?"])
        .check(0, &["out:I hold the coke can."]);
    place.run(&format!("check good.motet {ROOM} --state held.json")).check(0, &[]);
    place
        .run(&format!("run good.motet {ROOM} {IDEAL} --speed max --state held.json"))
        .check(0, &["out:✓ place(coke"]);
    let plan = place.run_args(&[
        "plan".to_owned(),
        "put it on the kitchen table".to_owned(),
        "--robot=hsr".to_owned(),
        "--scene=kitchen".to_owned(),
        "--no-geometry".to_owned(),
        "--state=held.json".to_owned(),
    ]);
    plan.check(0, &["out:place(coke, kitchen_table)"]);
}

/// A terminal: what is typed while the robot moves is shown, and the terminal is left as it was.
const TERMINAL: &str = r#"
import os, pty, select, subprocess, sys, termios, time

main, side = pty.openpty()
before = termios.tcgetattr(side)
talk = subprocess.Popen(sys.argv[1:], stdin=side, stdout=side, stderr=side)
seen = ""


def wait(text):
    global seen
    due = time.time() + 60
    while text not in seen:
        if time.time() > due or not select.select([main], [], [], 60)[0]:
            sys.exit("no %r in %r" % (text, seen))
        seen += os.read(main, 65536).decode("utf-8", "replace")
    seen = seen[seen.index(text) + len(text):]


def type(text):
    os.write(main, text.encode())


wait("> ")
type("go to the counter\n")
wait("\u25b6 go(counter)")
type("stx\x7fo")
wait("> sto")
type("p\n")
wait("interrupted")
wait("> ")
type("what do you hold?\n")
wait("I hold nothing.")
type("\x04")
code = talk.wait(60)
same = termios.tcgetattr(side)[3] == before[3]
print("code", code, "restored" if same else "not restored")
"#;

#[cfg(unix)]
#[test]
fn typed_letters_are_seen_while_the_robot_moves() {
    if !has_python() {
        return;
    }
    let place = Place::new("talk_terminal").file("terminal.py", TERMINAL);
    let line = format!("python3 terminal.py {} talk {ROOM} {IDEAL} --speed 0.5", env!("CARGO_BIN_EXE_motet"));
    place.shell(&line).check(0, &["out:code 3 restored"]);
}
