//! A naive interpreter of policies over concrete states, and random policies to run it on.
//!
//! It knows nothing of the prover: it walks every path of a policy one state at a time, where the prover
//! joins them. A fact of a state is true, false or unobserved. Domains are small enough for the sets of
//! states to be walked whole.

mod make;
mod print;
mod run;
mod state;

pub use make::{Action, Arg, Atom, Domain, Effect, Kind, Literal, Policy, Step, domain, policy};
pub use print::{domain_text, policy_text};
pub use run::{Found, walk};
