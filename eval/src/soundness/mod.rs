//! Differential fuzzer of proofs and guards: random domains and policies, and worlds that keep to the
//! contracts.
//!
//! Policies that the check accepts are run by the real engine through the driver trait in virtual time. When
//! a step begins, the needs of its contract are judged by the true state of the world, with a reading of the
//! language that shares nothing with the compiler and the engine. A policy that the check refuses is run with
//! the needs taken out of the domain, to see if any run breaks one.

mod contract;
mod make;
mod policy;
mod read;
mod shrink;
mod steps;
mod trial;
mod wire;
mod world;

use std::collections::BTreeMap;

use motet_syntax::{FileId, Severity, Source};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng as _;
use serde::Serialize;

use self::contract::Domain;
use self::policy::{Policy, domain_text, policy_text};
use self::shrink::{Reduced, shrink};
pub use self::trial::SeededFault;
use self::trial::{Bench, Checked, Finding, Graphs, Mistake, Needs, REFUTED};
use crate::Workers;

/// Number of policies over one domain.
const PER_DOMAIN: usize = 20;
/// Number of runs of a policy.
const RUNS: u64 = 24;
/// Number of runs of a policy of a document.
const PLAYED: u64 = 2000;
/// Number of findings of each sort that are made small and shown.
const SHOWN: usize = 4;

/// Most lines of a run that are shown.
const MAX_TRACE: usize = 80;

/// Sums over policies.
#[derive(Clone, Default, PartialEq, Eq, Debug, Serialize)]
pub struct Sums {
    /// Policies that were made.
    pub policies: usize,
    /// Of these, policies that the check accepts.
    pub accepted: usize,
    /// Of these, policies with a goal.
    pub goals: usize,
    /// Of these, policies of which the check calls the goal proven.
    pub goals_proven: usize,
    /// Policies with a refuted need or goal.
    pub refuted: usize,
    /// Of these, policies of which no run breaks a need or misses the goal.
    pub refuted_in_vain: usize,
    /// Policies with another error, by its codes.
    pub other: BTreeMap<String, usize>,
    pub runs: usize,
    /// Accepted policies with a mistake, by its sort.
    pub findings: BTreeMap<String, usize>,
}

/// Result of fuzzing.
#[derive(Clone, Default, Debug)]
pub struct Fuzzed {
    pub sums: Sums,
    /// Findings, made small, as text.
    pub findings: Vec<String>,
    /// Refused policies of which no run breaks a need, as text.
    pub refused_in_vain: Vec<String>,
}

/// Policy with a mistake, before it is made small.
struct Found {
    domain: Domain,
    policy: Policy,
    mistake: Mistake,
    seeds: Vec<u64>,
}

/// Fuzzes so many policies from a seed.
///
/// # Errors
///
/// A domain that was made has diagnostics.
pub fn fuzz(workers: Workers, count: usize, seed: u64) -> Result<Fuzzed, String> {
    fuzz_with(workers, count, seed, None)
}

/// Fuzzes so many policies from a seed, perhaps with a fault in every graph.
///
/// # Errors
///
/// A domain that was made has diagnostics.
pub fn fuzz_with(
    workers: Workers,
    count: usize,
    seed: u64,
    fault: Option<SeededFault>,
) -> Result<Fuzzed, String> {
    let domains: Vec<(u64, usize)> = (0..count.div_ceil(PER_DOMAIN))
        .map(|index| (index as u64, PER_DOMAIN.min(count - index * PER_DOMAIN)))
        .collect();
    let parts = workers.spread(domains, |(index, policies)| fuzz_domain((seed, index), policies, fault));
    let (mut fuzzed, mut found) = (Fuzzed::default(), Vec::new());
    for part in parts {
        let (sums, more, in_vain) = part?;
        fuzzed.refused_in_vain.extend(in_vain);
        fuzzed.sums.add(&sums);
        found.extend(more);
    }
    let mut shown: BTreeMap<Mistake, usize> = BTreeMap::new();
    found.retain(|found| {
        let count = shown.entry(found.mistake).or_default();
        *count += 1;
        *count <= SHOWN
    });
    let reduce = |found: Found| shrink(&found.domain, &found.policy, (found.mistake, &found.seeds, fault));
    // Each part of a shared run shows what it has found.
    let reduced = Workers { shard: Workers::default().shard, ..workers }.spread(found, reduce);
    fuzzed.findings = reduced.iter().flatten().map(Reduced::text).collect();
    Ok(fuzzed)
}

/// Plays each policy of documents that declare a domain, given by name and text, from a seed, perhaps with a
/// fault in every graph.
///
/// # Errors
///
/// A document has errors of syntax or a declaration that the worlds cannot play; with its name.
pub fn play(documents: &[(String, String)], seed: u64, fault: Option<SeededFault>) -> Result<Fuzzed, String> {
    let mut fuzzed = Fuzzed::default();
    for (name, text) in documents {
        let parsed = motet_syntax::read(&Source::new(name.as_str(), text.as_str()), FileId(0));
        if let Some(wrong) = parsed.diagnostics.iter().find(|found| found.severity == Severity::Error) {
            return Err(format!("{name}: {}: {}", wrong.code.0, wrong.message));
        }
        let domain = read::domain(&parsed.file).map_err(|why| format!("{name}: {why}"))?;
        let bench = Bench::bare(&domain, fault);
        for policy in parsed.file.runnable() {
            let (policy, sums) = (&policy.name.text, &mut fuzzed.sums);
            sums.policies += 1;
            let goal = read::goal(&parsed.file, policy, &domain).map_err(|why| format!("{name}: {why}"))?;
            match bench.check_document(&parsed, policy, goal.as_ref()) {
                Checked::Accepted(graphs) => {
                    for (mistake, (seed, place)) in mistakes(&bench, &graphs, seed..seed + PLAYED, sums) {
                        let (what, trace) = (mistake.text(), lines(&bench.trace(&graphs, seed)));
                        let told = format!("{name}, `{policy}`: {place} {what} (run {seed})\n{trace}");
                        fuzzed.findings.push(told);
                    }
                }
                Checked::Refuted(_) => sums.refuted += 1,
                Checked::Other(codes) => *sums.other.entry(codes.join(" ")).or_default() += 1,
            }
        }
    }
    Ok(fuzzed)
}

/// Runs an accepted policy with seeds. Returns the mistakes, each with the first seed that shows it and its
/// place there.
fn mistakes(
    bench: &Bench<'_>,
    graphs: &Graphs,
    seeds: impl Iterator<Item = u64>,
    sums: &mut Sums,
) -> BTreeMap<Mistake, (u64, String)> {
    sums.accepted += 1;
    if let Some(goal) = graphs.goal() {
        sums.goals += 1;
        sums.goals_proven += usize::from(goal.is_proven);
    }
    let mut mistakes = BTreeMap::new();
    for seed in seeds {
        sums.runs += 1;
        for Finding { mistake, place } in bench.run(graphs, seed, Needs::Compiled) {
            mistakes.entry(mistake).or_insert((seed, place));
        }
    }
    for mistake in mistakes.keys() {
        *sums.findings.entry(format!("{mistake:?}").to_lowercase()).or_default() += 1;
    }
    mistakes
}

/// A run, as comments.
fn lines(trace: &[String]) -> String {
    trace.iter().take(MAX_TRACE).map(|line| format!("// {line}\n")).collect()
}

/// Fuzzes the policies of one domain.
fn fuzz_domain(
    (seed, index): (u64, u64),
    count: usize,
    fault: Option<SeededFault>,
) -> Result<(Sums, Vec<Found>, Vec<String>), String> {
    let first = seed.wrapping_mul(1_000_003).wrapping_add(index);
    let mut dice = SplitMix64::seed_from_u64(first);
    let domain = make::domain(&mut dice);
    let (bench, bare) = (Bench::new(&domain, true, fault)?, Bench::new(&domain, false, None)?);
    let (mut sums, mut found) = (Sums { policies: count, ..Sums::default() }, Vec::new());
    let mut in_vain = Vec::new();
    for number in 0..count as u64 {
        let policy = steps::policy(&mut dice, &domain);
        let base = first.wrapping_mul(997).wrapping_add(number * RUNS) & !3;
        let seeds: Vec<u64> = (0..RUNS).map(|run| base.wrapping_add(run)).collect();
        match bench.check(&policy) {
            Checked::Accepted(graphs) => {
                for mistake in mistakes(&bench, &graphs, seeds.iter().copied(), &mut sums).into_keys() {
                    let (domain, policy, seeds) = (domain.clone(), policy.clone(), seeds.clone());
                    found.push(Found { domain, policy, mistake, seeds });
                }
            }
            Checked::Refuted(codes) => {
                sums.refuted += 1;
                if let Checked::Accepted(graphs) = bare.check(&policy) {
                    let [need, goal] = REFUTED.map(|code| codes.contains(&code));
                    let breaks = |seed: &u64| {
                        let findings = bare.run(&graphs, *seed, Needs::Dropped);
                        findings.iter().any(|found| match found.mistake {
                            Mistake::Proven => need,
                            Mistake::Goal => goal,
                            _ => false,
                        })
                    };
                    if !seeds.iter().any(breaks) {
                        sums.refuted_in_vain += 1;
                        in_vain.push(domain_text(&domain, true) + &policy_text(&domain, &policy, true));
                    }
                }
            }
            Checked::Other(codes) => *sums.other.entry(codes.join(" ")).or_default() += 1,
        }
    }
    Ok((sums, found, in_vain))
}

impl Sums {
    fn add(&mut self, other: &Self) {
        self.policies += other.policies;
        self.accepted += other.accepted;
        self.goals += other.goals;
        self.goals_proven += other.goals_proven;
        self.refuted += other.refuted;
        self.refuted_in_vain += other.refuted_in_vain;
        self.runs += other.runs;
        for (code, count) in &other.other {
            *self.other.entry(code.clone()).or_default() += count;
        }
        for (mistake, count) in &other.findings {
            *self.findings.entry(mistake.clone()).or_default() += count;
        }
    }
}

impl Reduced {
    fn text(&self) -> String {
        let what = self.finding.mistake.text();
        let (domain, policy) =
            (domain_text(&self.domain, true), policy_text(&self.domain, &self.policy, true));
        let trace = lines(&self.trace);
        format!("// {} {what} (run {})\n{domain}{policy}{trace}", self.finding.place, self.seed)
    }
}
