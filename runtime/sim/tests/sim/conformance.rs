//! The simulator keeps the laws of drivers; one around it that breaks them is caught; and on top of that one
//! the engine keeps its promises.

use crate::{entity, sim};
use motet_runtime::conformance::{ConformanceSubject, FaultRates, FaultyDriver, Law, check};
use motet_runtime::{Command, Driver, Query, Time};
use motet_sim::{Sim, SimOptions};
use std::collections::BTreeSet;

fn kitchen() -> Sim {
    sim("hsr", "kitchen", SimOptions::default())
}

/// The laws that a driver breaks.
fn laws(fresh: &mut dyn FnMut() -> Box<dyn Driver>) -> (BTreeSet<Law>, Vec<String>) {
    let breaches = check(&mut ConformanceSubject {
        fresh,
        command: Command {
            primitive: "go".into(),
            args: vec![("to".into(), entity("kitchen_table"))],
            uses: ["base".into()].into(),
            manner: None,
            deadline_secs: 60.0,
            motions: Vec::new(),
            leaves: None,
        },
        query: Query::Measure { measure: "distance".into(), args: vec![entity("kitchen_table")] },
        moment: Time::from_secs(0.01),
        patience: Time::from_secs(120.0),
        is_virtual: true,
    });
    (breaches.iter().map(|breach| breach.law).collect(), breaches.iter().map(ToString::to_string).collect())
}

#[test]
fn sim_simulator_keeps_the_laws() {
    let (_, told) = laws(&mut || Box::new(kitchen()));
    assert_eq!(told, [""; 0]);
}

#[test]
fn sim_what_breaks_a_law_is_named() {
    let late = Time::from_secs(300.0);
    for (name, mischief, expected) in [
        (
            "loses",
            FaultRates { loses: 1_000, ..FaultRates::default() },
            &[Law::Answered, Law::EndsOnce, Law::SafeStop, Law::Observed, Law::Watched][..],
        ),
        (
            "doubles",
            FaultRates { doubles: 1_000, ..FaultRates::default() },
            &[Law::Answered, Law::EndsOnce, Law::Observed, Law::Watched],
        ),
        (
            "silent",
            FaultRates { silence: 1_000, ..FaultRates::default() },
            &[Law::Answered, Law::EndsOnce, Law::SafeStop, Law::Observed, Law::Watched],
        ),
        (
            "deaf",
            FaultRates { deaf: 1_000, ..FaultRates::default() },
            &[Law::Answered, Law::EndsOnce, Law::SafeStop, Law::Observed, Law::Watched],
        ),
        ("late", FaultRates { delays: 1_000, late, ..FaultRates::default() }, &[Law::Observed]),
        ("backwards", FaultRates { backwards: 1_000, ..FaultRates::default() }, &[Law::Time]),
        ("moves on", FaultRates { moves_on: 1_000, ..FaultRates::default() }, &[Law::Held]),
        ("forgets", FaultRates { forgets: 1_000, ..FaultRates::default() }, &[Law::Cancelled]),
        ("gives up", FaultRates { gives_up: 1_000, ..FaultRates::default() }, &[Law::Updated]),
        ("remembers", FaultRates { remembers: 1_000, ..FaultRates::default() }, &[Law::Anew]),
        // Some reports of a goal come after that of its end.
        (
            "out of order",
            FaultRates { delays: 500, late: Time::from_secs(60.0), ..FaultRates::default() },
            &[Law::SilentAfterEnd],
        ),
        // To refuse is no breach.
        ("refuses", FaultRates { refuses: 1_000, ..FaultRates::default() }, &[]),
        ("nothing", FaultRates::default(), &[]),
    ] {
        let (laws, told) = laws(&mut || Box::new(FaultyDriver::new(kitchen(), mischief, 7)));
        let missing: Vec<_> = expected.iter().filter(|law| !laws.contains(law)).collect();
        assert!(missing.is_empty(), "{name}: {missing:?} is not among {told:#?}");
        assert!(!expected.is_empty() || told.is_empty(), "{name}: {told:#?}");
    }
}

#[test]
fn sim_driver_that_is_never_the_same_is_named() {
    let mut seed = 0;
    let (laws, _) = laws(&mut || {
        seed += 1;
        let late = Time::from_secs(5.0);
        Box::new(FaultyDriver::new(
            kitchen(),
            FaultRates { delays: 1_000, late, ..FaultRates::default() },
            seed,
        ))
    });
    assert!(laws.contains(&Law::Repeatable), "{laws:?}");
}
