//! A driver that asks a model for points keeps the laws of drivers: for the goals that it answers itself, and
//! for those that it leaves to the driver within.

use std::time::Duration;

use crate::kitchen::setting;
use motet_graph::Value;
use motet_planner::vision::{GroundingDriver, Pointer};
use motet_runtime::conformance::{ConformanceSubject, Law, check};
use motet_runtime::{CameraImage, Command, Driver, Query, Time};
use motet_sim::{Sim, SimOptions};

/// Points at the middle of the picture after a while.
struct Slow(Duration);

impl Pointer for Slow {
    fn ask(&mut self, _image: &CameraImage, _question: &str) -> Result<String, String> {
        std::thread::sleep(self.0);
        Ok("{\"point\": [320, 240]}".to_owned())
    }
}

/// A fresh driver in the kitchen that lives as long as the test.
fn pointing(after: Duration) -> GroundingDriver<'static> {
    let setting = Box::leak(Box::new(setting()));
    let sim = || Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let (driver, eyes) = (Box::leak(Box::new(sim())), Box::leak(Box::new(sim())));
    GroundingDriver::new(driver, eyes, &setting.scene, Box::new(Slow(after)))
}

/// The laws that it breaks, by a command that is started.
fn broken(command: Command, after: Duration, is_virtual: bool) -> Vec<String> {
    let mut fresh = || -> Box<dyn Driver> { Box::new(pointing(after)) };
    let breaches = check(&mut ConformanceSubject {
        fresh: &mut fresh,
        command,
        query: Query::Measure { measure: "distance".into(), args: vec![entity("kitchen_table")] },
        moment: Time::from_secs(0.01),
        patience: Time::from_secs(20.0),
        is_virtual,
    });
    assert!(breaches.iter().all(|breach| breach.law != Law::Answered), "{breaches:?}");
    breaches.iter().map(ToString::to_string).collect()
}

fn entity(id: &str) -> Value {
    Value::Entity(id.into())
}

fn command(primitive: &str, args: Vec<(&str, Value)>, uses: &str) -> Command {
    let args = args.into_iter().map(|(name, value)| (name.into(), value)).collect();
    Command {
        primitive: primitive.into(),
        args,
        uses: [uses.into()].into(),
        manner: None,
        deadline_secs: 10.0,
        motions: Vec::new(),
        leaves: None,
    }
}

#[test]
fn grounding_driver_questions_keep_the_laws_however_late_the_answer() {
    for after in [Duration::ZERO, Duration::from_millis(40)] {
        let ground = command(
            "ground",
            vec![("object", entity("mug_1")), ("use", Value::Text("the handle".into()))],
            "camera",
        );
        assert_eq!(broken(ground, after, false), [""; 0], "{after:?}");
    }
}

#[test]
fn grounding_driver_question_about_what_is_not_seen_keeps_them_too() {
    for args in [vec![("object", entity("teddy")), ("use", Value::Text("it".into()))], vec![]] {
        assert_eq!(broken(command("ground", args, "camera"), Duration::ZERO, true), [""; 0]);
    }
}

#[test]
fn grounding_driver_what_it_leaves_to_the_driver_stays_as_it_was() {
    let go = command("go", vec![("to", entity("kitchen_table"))], "base");
    assert_eq!(broken(go, Duration::ZERO, true), [""; 0]);
}
