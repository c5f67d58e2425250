//! The prover beside an interpreter that walks every path: what it accepts without a guard never breaks a
//! need, what it refutes does break one, and what it defers is unobserved on some path.

use motet_compiler::Session;
use motet_syntax::{Severity, Source, Sources};
use motet_tests::oracle::{self, Domain, Policy, Step};
use proptest::prelude::*;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng as _;

/// What the prover says of a policy.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum ProverVerdict {
    Accepted,
    Deferred,
    Refuted,
    /// An error that is not about state: branches that conflict, say.
    Other,
}

struct Lab {
    domain: Domain,
    session: Session,
    sources: Sources,
}

impl Lab {
    fn new(dice: &mut SplitMix64) -> Self {
        let domain = oracle::domain(dice);
        let mut sources = Sources::default();
        let source = Source::new("domain.motet", oracle::domain_text(&domain));
        let id = sources.add(source.clone());
        let parsed = motet_syntax::read(&source, id);
        assert!(parsed.diagnostics.is_empty(), "{:?}\n{}", parsed.diagnostics, source.text);
        let session = Session::builder().domains(&[parsed.file]).build(&mut sources);
        let said = session.input_diagnostics().to_vec();
        assert!(said.is_empty(), "{said:?}\n{}", source.text);
        Self { domain, session, sources }
    }

    fn ask(&mut self, policy: &Policy) -> ProverVerdict {
        let source = Source::new("policy.motet", oracle::policy_text(&self.domain, policy));
        let id = self.sources.add(source.clone());
        let check = self.session.check_document(&motet_syntax::read(&source, id));
        let mut errors = check.diagnostics.iter().filter(|said| said.severity == Severity::Error).peekable();
        let is_refuted = errors.peek().is_some();
        if errors.any(|said| said.code.0 != "M0501") {
            ProverVerdict::Other
        } else if is_refuted {
            ProverVerdict::Refuted
        } else if check.deferred_notes.is_empty() {
            ProverVerdict::Accepted
        } else {
            ProverVerdict::Deferred
        }
    }

    fn show(&self, policy: &Policy) -> String {
        format!("{}\n{}", oracle::domain_text(&self.domain), oracle::policy_text(&self.domain, policy))
    }
}

#[derive(Default, Debug)]
struct Count {
    total: usize,
    accepted: usize,
    deferred: usize,
    refuted: usize,
    /// Of the refuted: no path breaks a need.
    refuted_in_vain: usize,
    /// Of the deferred: no path leaves a need unobserved.
    deferred_in_vain: usize,
}

fn judge(lab: &mut Lab, policy: &Policy, count: &mut Count) -> Result<(), String> {
    let found = oracle::walk(&lab.domain, policy);
    let said = lab.ask(policy);
    if found.gave_up || said == ProverVerdict::Other {
        return Ok(());
    }
    count.total += 1;
    match said {
        ProverVerdict::Accepted => {
            count.accepted += 1;
            if found.violated || found.contended || found.unobserved {
                return Err(format!("accepted, but {found:?}:\n{}", lab.show(policy)));
            }
        }
        ProverVerdict::Deferred => {
            count.deferred += 1;
            // What another branch may change is unknown by the word of the language.
            let contended = policy.iter().any(Step::is_parallel);
            if found.violated && !contended {
                return Err(format!("deferred, but a path breaks a need:\n{}", lab.show(policy)));
            }
            count.deferred_in_vain += usize::from(!found.unobserved && !contended);
        }
        ProverVerdict::Refuted => {
            count.refuted += 1;
            count.refuted_in_vain += usize::from(!found.violated && !found.contended);
        }
        ProverVerdict::Other => {}
    }
    Ok(())
}

/// Of many policies, always the same: the shares of the verdicts, and of those that are stricter than they
/// need be.
#[test]
fn prover_verdicts_are_those_of_the_paths() {
    let mut count = Count::default();
    let mut wrong = Vec::new();
    for seed in 0..150 {
        let mut dice = SplitMix64::seed_from_u64(seed);
        let mut lab = Lab::new(&mut dice);
        for _ in 0..20 {
            let policy = oracle::policy(&mut dice, &lab.domain);
            wrong.extend(judge(&mut lab, &policy, &mut count).err());
        }
    }
    println!("{count:?}");
    let first: Vec<_> = wrong.iter().take(3).map(String::as_str).collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), count.total, first.join("\n"));
    assert!(count.accepted * 5 >= count.total, "{count:?}");
    assert!(count.refuted * 10 >= count.total * 3, "{count:?}");
    assert!(count.refuted_in_vain * 100 <= count.refuted * 2, "{count:?}");
    assert!(count.deferred_in_vain * 100 <= count.deferred * 3, "{count:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, max_shrink_iters: 0, ..ProptestConfig::default() })]

    #[test]
    fn prover_no_accepted_policy_breaks_a_need(seed: u64) {
        let mut dice = SplitMix64::seed_from_u64(seed);
        let mut lab = Lab::new(&mut dice);
        for _ in 0..10 {
            let policy = oracle::policy(&mut dice, &lab.domain);
            if let Err(wrong) = judge(&mut lab, &policy, &mut Count::default()) {
                prop_assert!(false, "{wrong}");
            }
        }
    }
}
