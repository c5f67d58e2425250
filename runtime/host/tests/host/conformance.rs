//! The example driver in another process keeps the laws of drivers.

use motet_graph::Value;
use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverAddress, DriverTimeouts, RemoteDriver};
use motet_runtime::conformance::{ConformanceSubject, check};
use motet_runtime::{Command, Driver, Query, Time};

const ECHO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/drivers/echo.py");

#[test]
fn remote_driver_example_in_python_keeps_the_laws() {
    let python = std::process::Command::new("python3").arg("--version").output();
    if !python.is_ok_and(|output| output.status.success()) {
        println!("skipped: there is no python3");
        return;
    }
    let mut fresh = || -> Box<dyn Driver> {
        let address: DriverAddress = format!("python3 {ECHO} --seconds 1").parse().unwrap();
        let note = |text: &str| panic!("{text}");
        let driver = RemoteDriver::connect(
            address,
            Hello::default(),
            DriverTimeouts::default(),
            Time::ZERO,
            Box::new(note),
        );
        Box::new(driver.unwrap())
    };
    let user = || Value::Entity("user".into());
    let breaches = check(&mut ConformanceSubject {
        fresh: &mut fresh,
        command: Command {
            primitive: "go".into(),
            args: vec![("to".into(), user())],
            uses: ["base".into()].into(),
            manner: None,
            deadline_secs: 10.0,
            motion: None,
        },
        query: Query::Measure { measure: "distance".into(), args: vec![user()] },
        moment: Time::from_secs(1.0),
        patience: Time::from_secs(3.0),
        is_virtual: false,
    });
    assert_eq!(breaches, []);
}
