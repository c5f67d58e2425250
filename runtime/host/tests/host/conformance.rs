//! The example driver in another process keeps the laws of drivers.

use motet_graph::Value;
use motet_host::remote::protocol::{GoalStatus, Hello};
use motet_host::remote::{DriverAddress, DriverTimeouts, RemoteDriver};
use motet_runtime::conformance::{ConformanceSubject, check};
use motet_runtime::{Command, Driver, DriverEvent, GoalId, Query, Time};
use std::io::{BufRead, BufReader};

const ECHO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/drivers/echo.py");

#[allow(clippy::print_stdout, reason = "a skipped test says so")]
fn has_python() -> bool {
    let python = std::process::Command::new("python3").arg("--version").output();
    let is_there = python.is_ok_and(|output| output.status.success());
    if !is_there {
        println!("skipped: there is no python3");
    }
    is_there
}

fn connect(address: &str, hello: Hello) -> RemoteDriver {
    let address: DriverAddress = address.parse().unwrap();
    let note = |text: &str| panic!("{text}");
    RemoteDriver::connect(address, hello, DriverTimeouts::default(), Time::ZERO, Box::new(note)).unwrap()
}

fn go() -> Command {
    Command {
        primitive: "go".into(),
        args: vec![("to".into(), Value::Entity("user".into()))],
        uses: ["base".into()].into(),
        manner: None,
        deadline_secs: 10.0,
        motions: Vec::new(),
        leaves: None,
    }
}

#[test]
fn remote_driver_example_in_python_keeps_the_laws() {
    if !has_python() {
        return;
    }
    for (clock, is_virtual) in [("wall", false), ("driver", true)] {
        let address = format!("python3 {ECHO} --seconds 1 --clock {clock}");
        let mut fresh = || -> Box<dyn Driver> { Box::new(connect(&address, Hello::default())) };
        let breaches = check(&mut ConformanceSubject {
            fresh: &mut fresh,
            command: go(),
            query: Query::Measure { measure: "distance".into(), args: vec![Value::Entity("user".into())] },
            moment: Time::from_secs(1.0),
            patience: Time::from_secs(3.0),
            is_virtual,
        });
        assert_eq!(breaches, [], "{clock}");
    }
}

/// Goals of two runs have the same numbers, and a driver on a port serves both.
#[test]
fn remote_driver_on_a_port_serves_a_second_run() {
    if !has_python() {
        return;
    }
    let mut child = std::process::Command::new("python3")
        .args([ECHO, "--port", "0", "--seconds", "0.1"])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    let address = line.trim().strip_prefix("listening on ").unwrap();
    let goal = GoalId::from_number(1 << 24);
    for run in ["one", "two"] {
        let mut driver = connect(address, Hello { run: run.to_owned(), ..Hello::default() });
        let status = driver.status(vec![goal]).unwrap();
        assert_eq!(status.goals[0].state, GoalStatus::Unknown, "run {run}");
        driver.start(Time::ZERO, goal, &go());
        let mut events = std::iter::from_fn(|| driver.advance(Time::from_secs(5.0)));
        assert!(events.any(|(_, event)| matches!(event, DriverEvent::Ended { .. })), "run {run}");
    }
    let mut again = connect(address, Hello { run: "two".to_owned(), resumed: true, ..Hello::default() });
    let status = again.status(vec![goal]).unwrap();
    assert!(matches!(status.goals[0].state, GoalStatus::Ended(_)), "it goes on with the same run");
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Several runs on one connection: each has its goals for itself.
#[test]
fn remote_driver_begins_runs_on_one_connection() {
    if !has_python() {
        return;
    }
    for clock in ["wall", "driver"] {
        let mut driver = connect(&format!("python3 {ECHO} --seconds 0.2 --clock {clock}"), Hello::default());
        let instance = driver.welcome().instance.clone();
        let goal = GoalId::from_number(1 << 24);
        let mut now = Time::ZERO;
        for run in ["one", "two", "three"] {
            now = driver.begin_run(now, run, None);
            driver.start(now, goal, &go());
            let until = now.after(Time::from_secs(5.0));
            let mut events = std::iter::from_fn(|| driver.advance(until));
            let mut ends = 0;
            // The last run is left while its goal runs.
            while let Some((at, event)) = events.next().filter(|_| run != "three") {
                assert!(at >= now, "{at} is before {now}");
                now = at;
                ends += usize::from(matches!(event, DriverEvent::Ended { .. }));
                if ends > 0 {
                    break;
                }
            }
            assert_eq!(ends, usize::from(run != "three"), "run {run} on the clock of the {clock}");
        }
        now = driver.begin_run(now, "four", None);
        let until = now.after(Time::from_secs(0.5));
        assert_eq!(driver.advance(until), None, "the goal of the run before is forgotten");
        assert_eq!(driver.status(vec![goal]).unwrap().goals[0].state, GoalStatus::Unknown);
        assert_ne!(driver.welcome().instance, instance, "goals were forgotten");
    }
}

/// A driver on the wall's clock hears something also while its host is busy, and waits for the next run.
#[test]
fn remote_driver_is_kept_alive_between_runs() {
    if !has_python() {
        return;
    }
    let mut driver = connect(&format!("python3 {ECHO} --seconds 0.1"), Hello::default());
    let begun = std::time::Instant::now();
    // Longer than the driver waits for a word, and longer than the host waits for one.
    std::thread::sleep(std::time::Duration::from_secs(7));
    let now = driver.begin_run(Time::ZERO, "late", None);
    assert!((now.secs() - begun.elapsed().as_secs_f64()).abs() < 1.0, "{now}");
    driver.start(now, GoalId::from_number(1 << 24), &go());
    let until = now.after(Time::from_secs(5.0));
    let mut events = std::iter::from_fn(|| driver.advance(until));
    assert!(events.any(|(_, event)| matches!(event, DriverEvent::Ended { .. })));
}
