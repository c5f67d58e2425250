//! Who answers what the compiler left to be checked just before a step starts.

use crate::query::Query;
use crate::truth::Truth;
use motet_graph::Value;
use smol_str::SmolStr;
use std::fmt::Debug;

/// Checks deferred motions, and answers for facts that are derived rather than observed.
///
/// # Laws
///
/// Pure: the same questions in the same world have the same answers, and asking changes nothing.
pub trait Verifier: Debug + Send + Sync {
    /// Whether a motion has a solution in the world as it is.
    fn motion(&self, query: &str, args: &[Value]) -> Verification;

    /// Whether a fact holds that the robot cannot observe and of which nothing is believed.
    fn fact(&self, query: &Query) -> Truth;
}

/// The verdict on a motion.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Verification {
    /// It may start; the driver will see.
    Accepted,
    /// It has no solution.
    Refuted {
        /// The failure in which the step ends, such as `unreachable`.
        failure: SmolStr,
    },
}

/// Accepts every motion: whether it can be done is left to the driver.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeaveToDriver;

impl Verifier for LeaveToDriver {
    fn motion(&self, _query: &str, _args: &[Value]) -> Verification {
        Verification::Accepted
    }

    /// `reachable` is the verdict of a motion, so it is accepted like one.
    fn fact(&self, query: &Query) -> Truth {
        match query {
            Query::Fact { fluent, .. } if fluent == "reachable" => Truth::True,
            Query::Fact { .. } | Query::Measure { .. } | Query::Field { .. } => Truth::Unknown,
        }
    }
}
