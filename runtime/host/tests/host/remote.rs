//! A driver on a port that says what a test wants it to say.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use motet_arbitrary::graph::{StepSketch, graph};
use motet_host::remote::protocol::{CalledPrimitive, Hello};
use motet_host::remote::{DriverAddress, DriverLog, DriverTimeouts, LineFrom, LinkError, RemoteDriver};
use motet_runtime::journal::{OpenGoal, OpenGoals};
use motet_runtime::{
    Answer, Command, Detection, Driver, DriverClock, DriverEvent, Engine, Event, Fault, GoalId, Heard, Moved,
    Observer, Outcome, Query, RunEnd, StartState, Time, ToldThing, run,
};
use serde_json::{Value, json};
use std::cell::RefCell;
use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;
use std::rc::Rc;
use std::thread;

const GOAL: GoalId = GoalId::from_number(1 << 24);

/// Lines that a driver says upon a call, the answer among them; with none it hangs up.
type Script = Box<dyn FnMut(&Value) -> Vec<Value> + Send>;

/// Serves one connection after the other.
fn driver(mut script: Script) -> DriverAddress {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("tcp://{}", listener.local_addr().unwrap());
    thread::spawn(move || {
        for stream in listener.incoming() {
            let mut stream = stream.unwrap();
            let lines = BufReader::new(stream.try_clone().unwrap()).lines();
            for (number, line) in lines.map_while(Result::ok).enumerate() {
                let call: Value = serde_json::from_str(&line).unwrap();
                // The sign of life behind the greeting.
                let is_first = number == 1 && call["method"] == "ping";
                let said = if is_first { vec![answer(&call, json!({}))] } else { script(&call) };
                let text: String = said.iter().map(|message| format!("{message}\n")).collect();
                if said.is_empty() || stream.write_all(text.as_bytes()).is_err() {
                    break;
                }
            }
        }
    });
    address.parse().unwrap()
}

fn answer(call: &Value, result: Value) -> Value {
    json!({"jsonrpc": "2.0", "id": call["id"], "result": result})
}

fn report(method: &str, params: Value) -> Value {
    json!({"jsonrpc": "2.0", "method": method, "params": params})
}

fn welcome(call: &Value, capabilities: Value) -> Value {
    let told = json!({"protocol": 2, "driver": "test", "instance": "1", "capabilities": capabilities});
    answer(call, told)
}

/// Lines that a log got.
#[derive(Clone, Default)]
struct Told {
    notes: Rc<RefCell<Vec<String>>>,
    breaches: Rc<RefCell<Vec<String>>>,
    said: Rc<RefCell<Vec<Value>>>,
}

impl DriverLog for Told {
    fn note(&mut self, text: &str) {
        self.notes.borrow_mut().push(text.to_owned());
    }
    fn breach(&mut self, text: &str) {
        self.breaches.borrow_mut().push(text.to_owned());
    }
    fn line(&mut self, from: LineFrom, line: &str) {
        if from == LineFrom::Host {
            self.said.borrow_mut().push(serde_json::from_str(line).unwrap());
        }
    }
}

fn connect(address: DriverAddress) -> Result<(RemoteDriver, Told), LinkError> {
    let go = CalledPrimitive { name: "go".into(), result: None, fails: vec!["blocked".into()] };
    let hello = Hello { run: "r1".into(), primitives: vec![go], ..Hello::default() };
    let told = Told::default();
    let log = Box::new(told.clone());
    let driver = RemoteDriver::connect(address, hello, DriverTimeouts::default(), Time::ZERO, log)?;
    Ok((driver, told))
}

fn go() -> Command {
    let (args, uses) = (Vec::new(), ["base".into()].into());
    let primitive = "go".into();
    Command { primitive, args, uses, manner: None, deadline_secs: 10.0, motions: Vec::new(), leaves: None }
}

#[test]
fn remote_driver_has_capabilities_by_default() {
    for capabilities in [json!({}), json!({"teleports": [1], "moved": false})] {
        let address = driver(Box::new(move |call| vec![welcome(call, capabilities.clone())]));
        let (driver, _) = connect(address).unwrap();
        assert_eq!(driver.capabilities(), motet_runtime::Capabilities::default());
    }
    let told = json!({"protocol": 2, "driver": "test", "instance": "1"});
    let address = driver(Box::new(move |call| vec![answer(call, told.clone())]));
    assert_eq!(connect(address).unwrap().0.capabilities().clock, DriverClock::Wall);
    let old = json!({"protocol": 1, "driver": "test", "instance": "1", "capabilities": {}});
    let address = driver(Box::new(move |call| vec![answer(call, old.clone())]));
    let error = connect(address).err().unwrap().to_string();
    assert!(error.contains("it speaks version 1 of the protocol, this program speaks 2"), "{error}");
}

#[test]
fn remote_driver_hears_what_is_said_before_the_greeting() {
    let address = driver(Box::new(|call| {
        let words = report("heard", json!({"text": "  hello ", "from": "user"}));
        vec![words, welcome(call, json!({}))]
    }));
    let (mut driver, _) = connect(address).unwrap();
    assert_eq!(driver.heard(), Some(Heard { text: "hello".into(), from: Some("user".into()) }));
    assert_eq!(driver.heard(), None);
}

#[test]
fn remote_driver_greets_again_with_the_same_run() {
    let address = driver(Box::new(|call| match call["method"].as_str().unwrap() {
        "hello" => vec![welcome(call, json!({}))],
        "safe_stop" => {
            let stopped = report("stopped", json!({"goal": call["params"]["goal"]}));
            vec![answer(call, json!({})), stopped]
        }
        _ => vec![],
    }));
    let (mut driver, told) = connect(address).unwrap();
    driver.start(Time::ZERO, GOAL, &go());
    let within = Time::from_secs(5.0);
    assert_eq!(driver.advance(within).unwrap().1, DriverEvent::DriverLost);
    driver.safe_stop(Time::ZERO, GOAL);
    assert_eq!(driver.advance(within).unwrap().1, DriverEvent::Stopped { goal: GOAL });
    let said = told.said.borrow();
    let hellos: Vec<&Value> = said.iter().filter(|call| call["method"] == "hello").collect();
    let of = |field: &str| hellos.iter().map(|call| call["params"][field].clone()).collect::<Vec<_>>();
    assert_eq!(of("run"), ["r1", "r1"]);
    assert_eq!(of("resumed"), [false, true]);
}

#[test]
fn remote_driver_that_is_gone_for_good_is_not_waited_for() {
    // The port is closed once it has greeted; it is called again with a pause each time.
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("tcp://{}", listener.local_addr().unwrap());
    let greeting = thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        let mut reader = BufReader::new(stream.try_clone().unwrap());
        for _ in ["hello", "ping"] {
            let mut line = String::new();
            reader.read_line(&mut line).unwrap();
            let call = serde_json::from_str(&line).unwrap();
            stream.write_all(format!("{}\n", welcome(&call, json!({}))).as_bytes()).unwrap();
        }
    });
    let (mut driver, told) = connect(address.parse().unwrap()).unwrap();
    greeting.join().unwrap();
    let mut engine = Engine::new(graph(&[StepSketch::go("table")]), &StartState::default()).unwrap();
    let begun = std::time::Instant::now();
    let end = run(&mut engine, &mut driver, &mut (), Time::ZERO);
    assert!(matches!(end, RunEnd::Fault(Fault::NotStopped { .. })), "{end:?}");
    // Two pauses of 2 s, and not the 5 s within which a safe stop has to be acknowledged.
    assert!((3.5..4.9).contains(&begun.elapsed().as_secs_f64()), "{:?}", begun.elapsed());
    let calls = told.notes.borrow().iter().filter(|note| note.contains("calling the driver again")).count();
    assert_eq!(calls, 3, "{:?}", told.notes);
}

#[test]
fn remote_driver_drops_and_tells_reports_about_goals_that_do_not_run() {
    let address = driver(Box::new(|call| match call["method"].as_str().unwrap() {
        "hello" => vec![welcome(call, json!({}))],
        "start" => {
            let ended =
                |goal: Value| report("ended", json!({"goal": goal, "outcome": {"failure": "melted"}}));
            let goal = call["params"]["goal"].clone();
            let unasked = report("stopped", json!({"goal": 77}));
            let fact = json!({"fact": {"fluent": "standing", "args": []}});
            let last = report("observed", json!({"query": fact, "answer": "unknown"}));
            vec![answer(call, json!({})), ended(goal.clone()), ended(goal), ended(json!(77)), unasked, last]
        }
        _ => vec![answer(call, json!({}))],
    }));
    let (mut driver, told) = connect(address).unwrap();
    driver.start(Time::ZERO, GOAL, &go());
    let mut events = Vec::new();
    while let Some((_, event)) = driver.advance(Time::from_secs(5.0)) {
        let is_last = matches!(event, DriverEvent::Observed { .. });
        events.push(event);
        if is_last {
            break;
        }
    }
    let [DriverEvent::Acknowledged { .. }, DriverEvent::Ended { outcome, .. }, DriverEvent::Observed { .. }] =
        &events[..]
    else {
        panic!("{events:?}");
    };
    assert_eq!(*outcome, Outcome::Failure("melted".into()));
    let breaches = told.breaches.borrow();
    let expected = [
        "`go` failed with `melted`, which it does not declare; it declares blocked",
        "goal #1 has ended, it says, but it does not run",
        "an unknown goal 77 has ended, it says, but it does not run",
        "an unknown goal 77 is stopped, it says, but nobody asked for it",
    ];
    assert_eq!(breaches.len(), expected.len(), "{breaches:?}");
    for (breach, expected) in breaches.iter().zip(expected) {
        assert!(breach.contains(expected), "{breach}");
    }
}

#[test]
fn remote_driver_counts_an_end_once_that_is_reported_while_the_status_is_asked() {
    // A driver may forget a goal as soon as it has reported its end.
    for state in [json!("unknown"), json!({"ended": {"success": null}}), json!("running")] {
        let address = driver(Box::new(move |call| match call["method"].as_str().unwrap() {
            "hello" => vec![welcome(call, json!({}))],
            "status" => {
                let goal = call["params"]["goals"][0].clone();
                let ended = report("ended", json!({"goal": goal, "outcome": {"failure": "blocked"}}));
                vec![ended, answer(call, json!({"goals": [{"goal": goal, "state": state}]}))]
            }
            method => panic!("{method} is called"),
        }));
        let (mut driver, told) = connect(address).unwrap();
        let open = OpenGoal { command: go().into(), updated: false, told: None };
        let ledger = OpenGoals { goals: [(GOAL, open)].into(), ..OpenGoals::default() };
        let events = driver.catch_up(&ledger, "1", Time::ZERO);
        assert_eq!(events, [], "the end is reported already");
        let (_, event) = driver.advance(Time::from_secs(5.0)).unwrap();
        assert_eq!(event, DriverEvent::Ended { goal: GOAL, outcome: Outcome::Failure("blocked".into()) });
        assert!(told.breaches.borrow().is_empty(), "{:?}", told.breaches);
    }
}

#[test]
fn remote_driver_without_a_status_has_lost_its_goals() {
    let address = driver(Box::new(|call| match call["method"].as_str().unwrap() {
        "hello" => vec![welcome(call, json!({}))],
        "bye" => vec![],
        method => {
            assert_eq!(method, "status");
            let error = json!({"code": 7, "message": "no"});
            vec![json!({"jsonrpc": "2.0", "id": call["id"], "error": error})]
        }
    }));
    let (mut driver, told) = connect(address).unwrap();
    let open = OpenGoal { command: go().into(), updated: false, told: None };
    let ledger = OpenGoals { goals: [(GOAL, open)].into(), ..OpenGoals::default() };
    let events = driver.catch_up(&ledger, "1", Time::ZERO);
    assert_eq!(events, [Event::Driver(DriverEvent::Lost { goal: GOAL })], "{:?}", told.notes);
}

#[test]
fn remote_driver_that_stops_a_goal_unasked_has_lost_it() {
    let address = driver(Box::new(|call| match call["method"].as_str().unwrap() {
        "hello" => vec![welcome(call, json!({}))],
        "start" | "safe_stop" => {
            let stopped = report("stopped", json!({"goal": call["params"]["goal"]}));
            vec![answer(call, json!({})), stopped]
        }
        "bye" => vec![],
        method => panic!("{method} is called"),
    }));
    let (mut driver, told) = connect(address).unwrap();
    let mut engine = Engine::new(graph(&[StepSketch::say("one")]), &StartState::default()).unwrap();
    let end = run(&mut engine, &mut driver, &mut (), Time::ZERO);
    assert!(matches!(&end, RunEnd::Failed { kind, .. } if kind == "timeout"), "{end:?}");
    let breaches = told.breaches.borrow();
    assert!(breaches[0].contains("is stopped, it says, but nobody asked for it"), "{breaches:?}");
}

/// A picture with a depth of 2 m everywhere, and a file of so many bytes.
fn picture(bytes: usize, [width, height]: [u32; 2]) -> Value {
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
    png.extend(width.to_be_bytes());
    png.extend(height.to_be_bytes());
    png.resize(bytes, 0);
    let depth: Vec<u8> = (0..800 * 600).flat_map(|_| 2_000_u16.to_le_bytes()).collect();
    let pose = json!({"xyz": [0.0, 0.0, 1.0], "quaternion": [0.0, 0.0, 0.0, 2.0]});
    json!({
        "image": {"width": width, "height": height, "png": STANDARD.encode(png)},
        "depth": {"width": 800, "height": 600, "mm": STANDARD.encode(depth)},
        "camera": {"name": "head", "pose": pose, "fx": 500.0, "fy": 500.0, "cx": 400.0, "cy": 300.0},
    })
}

#[test]
fn remote_driver_knows_the_truth_or_not() {
    let address = driver(Box::new(|call| match call["method"].as_str().unwrap() {
        "hello" => vec![welcome(call, json!({}))],
        "truth" if call["params"]["query"]["fact"]["fluent"] == "holding" => {
            vec![answer(call, json!({"answer": {"truth": false}}))]
        }
        _ => {
            let why = json!({"code": -32601, "message": "there is no method `truth`"});
            vec![json!({"jsonrpc": "2.0", "id": call["id"], "error": why})]
        }
    }));
    let (mut driver, told) = connect(address).unwrap();
    let query = |fluent: &str| Query::Fact { fluent: fluent.into(), args: vec![] };
    assert_eq!(driver.truth(&query("holding")), Answer::Truth(false));
    assert_eq!(driver.truth(&query("open")), Answer::Unknown);
    assert!(told.notes.borrow().last().unwrap().contains("there is no method `truth`"));
}

#[test]
fn remote_driver_takes_a_large_picture_when_it_asked_for_one() {
    let address = driver(Box::new(|call| match call["method"].as_str().unwrap() {
        "hello" => vec![welcome(call, json!({"look": true}))],
        "look" => match call["params"]["camera"].as_str() {
            Some("head") => vec![answer(call, picture(1_500_000, [800, 600]))],
            Some("small") => vec![answer(call, picture(100, [80, 60]))],
            _ => {
                let why = json!({"code": -32602, "message": "there is no such camera"});
                vec![json!({"jsonrpc": "2.0", "id": call["id"], "error": why})]
            }
        },
        _ => vec![answer(call, json!({"too": "x".repeat(1_500_000)}))],
    }));
    let (mut driver, told) = connect(address).unwrap();
    let view = driver.look(Time::ZERO, Some("head")).unwrap();
    assert_eq!((view.image.bytes.len(), view.image.camera.as_str()), (1_500_000, "head"));
    assert_eq!(view.depth.millimetres, vec![2_000; 800 * 600]);
    assert_eq!(view.camera.pose.quaternion, [0.0, 0.0, 0.0, 1.0]);
    for (camera, why) in [
        (Some("small"), "its depth has not one 16 bit number for each pixel"),
        (None, "there is no such camera"),
    ] {
        assert_eq!(driver.look(Time::ZERO, camera), None);
        assert!(told.notes.borrow().last().unwrap().contains(why), "{:?}", told.notes);
    }
    assert_eq!(driver.detections(Time::ZERO), [], "it does not say that it can");
    // Any other line has to be short.
    driver.cancel(Time::ZERO, GOAL);
    assert_eq!(driver.advance(Time::from_secs(10.0)).unwrap().1, DriverEvent::DriverLost);
    assert!(told.notes.borrow().last().unwrap().contains("a line of more than 1048576 bytes"));
}

#[derive(Default)]
struct Looker {
    moved: Vec<Moved>,
    seen: Vec<(Time, Vec<Detection>)>,
    heard: Vec<(Time, Heard)>,
    events: Vec<(Time, String)>,
    to_tell: Vec<ToldThing>,
}

impl Observer for Looker {
    fn event(&mut self, now: Time, event: &Event) {
        match event {
            Event::Driver(event) => self.events.push((now, event.to_string())),
            Event::Noticed { query, .. } => self.events.push((now, format!("noticed {query}"))),
            _ => {}
        }
    }
    fn wants_telemetry(&self) -> bool {
        true
    }
    fn moved(&mut self, moved: &Moved) {
        self.moved.push(moved.clone());
    }
    fn detected(&mut self, now: Time, seen: &[Detection], _engine: &Engine) -> Vec<(Query, Answer)> {
        self.seen.push((now, seen.to_vec()));
        let query = Query::Fact { fluent: "seen".into(), args: Vec::new() };
        vec![(query, Answer::Truth(true))]
    }
    fn tell(&mut self) -> Option<ToldThing> {
        self.to_tell.pop()
    }
    fn heard(&mut self, now: Time, heard: &Heard) {
        self.heard.push((now, heard.clone()));
    }
}

/// A world in which every goal takes 0.7 s, with its own clock and a report every 0.1 s.
fn world() -> Script {
    let (mut now, mut goal, mut next) = (0.0_f64, None, 0.1);
    Box::new(move |call| {
        let params = &call["params"];
        match call["method"].as_str().unwrap() {
            "hello" => vec![welcome(call, json!({"clock": "driver", "moved": true, "told": true}))],
            "told" => {
                vec![report("heard", json!({"text": params["thing"]["id"]})), answer(call, json!({}))]
            }
            "start" => {
                assert!((params["at"].as_f64().unwrap() - now).abs() < 1e-9, "{call}");
                goal = Some((params["goal"].clone(), now + 0.7));
                vec![answer(call, json!({}))]
            }
            "advance" => {
                let until = params["until"].as_f64().unwrap();
                assert!(until - now <= 0.5 + 1e-9, "{call}");
                let mut said = Vec::new();
                let end = goal.as_ref().map(|(_, end)| *end).filter(|end| *end <= until);
                now = end.unwrap_or(until);
                while next <= now {
                    said.push(report("moved", json!({"at": next, "base": [next, 0.0, 0.0]})));
                    next += 0.1;
                }
                if let Some((goal, _)) = goal.take_if(|_| end.is_some()) {
                    let pose = json!({"xyz": [1.0, 2.0, 3.0], "quaternion": [0.0, 0.0, 0.0, 1.0]});
                    let rabbit = json!({"label": "rabbit", "pose": pose, "confidence": 0.5});
                    let odd = json!({"label": "odd", "confidence": 2.0});
                    said.push(report("detected", json!({"detections": [odd, rabbit]})));
                    said.push(report("heard", json!({"text": "stop it"})));
                    said.push(report("ended", json!({"goal": goal, "outcome": {"success": null}})));
                }
                said.push(answer(call, json!({"now": now})));
                said
            }
            "bye" => vec![],
            _ => vec![answer(call, json!({"answer": "unknown"}))],
        }
    })
}

#[test]
fn remote_driver_may_own_the_clock() {
    let go_on = || {
        let (mut driver, told) = connect(driver(world())).unwrap();
        let steps = [StepSketch::say("one"), StepSketch::say("two")];
        let mut engine = Engine::new(graph(&steps), &StartState::default()).unwrap();
        let rabbit = ToldThing { id: "rabbit".into(), label: None, pose: None, support: None };
        let mut looker = Looker { to_tell: vec![rabbit], ..Looker::default() };
        let begun = std::time::Instant::now();
        let end = run(&mut engine, &mut driver, &mut looker, Time::ZERO);
        assert!(matches!(end, RunEnd::Done { .. }), "{end:?}, {:?}", told.notes);
        assert!(begun.elapsed().as_secs_f64() < 1.0, "1.4 s of the run pass faster than on the wall");
        looker
    };
    let seen = go_on();
    let ends: Vec<f64> =
        seen.events.iter().filter(|(_, event)| event.starts_with("ended")).map(|(at, _)| at.secs()).collect();
    assert_eq!(ends, [0.7, 1.4]);
    let [first, .., last] = &seen.moved[..] else { panic!("{:?}", seen.moved) };
    assert_eq!((first.at, last.base[0] > 1.25, seen.moved.len() >= 13), (Time::from_secs(0.1), true, true));
    let detected: Vec<_> = seen.seen.iter().map(|(at, all)| (at.secs(), all.len())).collect();
    assert_eq!(detected, [(0.7, 1), (1.4, 1)]);
    assert_eq!(seen.seen[0].1[0].class, "rabbit");
    let heard: Vec<_> = seen.heard.iter().map(|(at, heard)| (at.secs(), heard.text.as_str())).collect();
    assert_eq!(heard[1..], [(0.7, "stop it"), (1.4, "stop it")]);
    assert_eq!(heard[0].1, "rabbit", "the driver was told of it before the first step");
    let noticed = seen.events.iter().filter(|(_, event)| event == "noticed seen()").count();
    assert_eq!(noticed, 1, "the second one came with the end of the run: {:?}", seen.events);
    let again = go_on();
    assert_eq!((seen.events, seen.moved), (again.events, again.moved), "the same, whatever else goes on");
}

#[test]
fn remote_driver_whose_clock_is_out_of_range_is_told() {
    for (now, said) in [(-5.0, "its time is -5.0 s"), (1e300, "its time is 1e300 s")] {
        let address = driver(Box::new(move |call| match call["method"].as_str().unwrap() {
            "hello" => vec![welcome(call, json!({"clock": "driver"}))],
            "start" => vec![answer(call, json!({}))],
            _ => {
                let ended = report("ended", json!({"goal": GOAL, "outcome": {"success": null}}));
                vec![ended, answer(call, json!({"now": now}))]
            }
        }));
        let (mut driver, told) = connect(address).unwrap();
        driver.start(Time::ZERO, GOAL, &go());
        driver.advance(Time::from_secs(1.0)).unwrap();
        driver.advance(Time::from_secs(1.0)).unwrap();
        assert!(told.breaches.borrow()[0].contains(said), "{:?}", told.breaches);
    }
}

#[test]
fn remote_driver_whose_clock_does_not_get_on_is_gone() {
    for step in [0.0, 1e-9, 1e-4] {
        let mut now = 0.0;
        let address = driver(Box::new(move |call| match call["method"].as_str().unwrap() {
            "hello" => vec![welcome(call, json!({"clock": "driver"}))],
            _ => {
                now += step;
                vec![answer(call, json!({"now": now}))]
            }
        }));
        let (mut driver, told) = connect(address).unwrap();
        let (at, event) = driver.advance(Time::from_secs(1.0)).unwrap();
        assert_eq!(event, DriverEvent::DriverLost);
        assert!(at <= Time::from_secs(step * 101.0), "{at}");
        assert!(told.notes.borrow()[0].contains("s, not at 0.5"), "{:?}", told.notes);
    }
}
