//! Random walks through the acceptor: what a model without any sense writes.

use motet_decode::{Acceptor, AcceptorFactory, Session, Subset};
use motet_syntax::Syntax;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng as _, SeedableRng as _};

/// Random choices, the same for the same seed.
#[derive(Clone, Debug)]
pub struct Dice(SplitMix64);

impl Dice {
    /// The choices of a seed.
    pub fn new(seed: u64) -> Self {
        Self(SplitMix64::seed_from_u64(seed))
    }

    /// A number below `bound`, which is at least 1.
    pub fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.0.next_u64() >> 33).unwrap_or(0) % bound.max(1)
    }

    /// True `percent` times of a hundred.
    pub fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }
}

/// The end of a walk.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Ended {
    /// With a whole policy.
    Whole(String),
    /// Nowhere: no byte may follow.
    Stuck(String),
}

/// Walks at random until the policy is whole. Long walks are likelier than short ones: after a step another
/// one follows as a rule, until there are `steps`.
pub fn walk(factory: &AcceptorFactory, budget: usize, steps: usize, dice: &mut Dice) -> Option<Ended> {
    let mut acceptor = factory.acceptor(budget)?;
    loop {
        let next = acceptor.next_bytes();
        // The cleanup of the policy may follow.
        if acceptor.is_accepting() && (next.is_empty() || dice.chance(60)) {
            return Some(Ended::Whole(text(&acceptor)));
        }
        let byte = match next.as_slice() {
            [] => return Some(Ended::Stuck(text(&acceptor))),
            [only] => *only,
            several if acceptor.bytes().starts_with(b"{") => choose(several, acceptor.bytes(), steps, dice),
            several => choose_text(several, acceptor.bytes(), steps, dice),
        };
        acceptor.accept(&[byte]);
    }
}

/// So many policies that are written at random and fit, by walks of a session of their own, so that no
/// answer is known beforehand.
pub fn written(session: &Session, subset: Subset, count: usize, fits: impl Fn(&str) -> bool) -> Vec<String> {
    let (factory, mut dice) = (AcceptorFactory::new(session, subset), Dice::new(11));
    let mut found = Vec::new();
    // The text syntax takes fewer tokens a step.
    let (least, spread) = if subset.syntax == Syntax::Json { (12, 8) } else { (24, 20) };
    while found.len() < count {
        let steps = least + dice.below(spread);
        if let Some(Ended::Whole(policy)) = walk(&factory, 6000, steps, &mut dice)
            && fits(&policy)
        {
            found.push(policy);
        }
    }
    found
}

fn text(acceptor: &Acceptor) -> String {
    String::from_utf8_lossy(acceptor.bytes()).into_owned()
}

/// The number of steps of a policy.
#[must_use]
pub fn steps(policy: &str) -> usize {
    KINDS.iter().map(|kind| of_kind(policy, kind)).sum()
}

/// The number of steps of a kind.
#[must_use]
pub fn of_kind(policy: &str, kind: &str) -> usize {
    if syntax(policy) == Syntax::Json {
        return policy.matches(&format!("{{\"{kind}\":")).count();
    }
    let count = |words: &[&str]| words.iter().map(|word| policy.matches(word).count()).sum();
    match kind {
        "do" => {
            let starts = ["{ ", ") ", "} ", " s ", "done ", "\" ", "= "];
            starts.iter().flat_map(|start| policy.split(start).skip(1)).filter(|rest| is_call(rest)).count()
        }
        "wait" => count(&[" wait until "]),
        "end" => count(&[" done ", " fail ", " cannot ", " replan "]),
        kind => count(&[&format!(" {kind} ")]),
    }
}

/// A name and a parenthesis come next.
fn is_call(rest: &str) -> bool {
    let name = rest.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count();
    name > 0 && rest.as_bytes().get(name) == Some(&b'(')
}

/// The syntax of a policy.
#[must_use]
pub fn syntax(policy: &str) -> Syntax {
    if policy.starts_with('{') { Syntax::Json } else { Syntax::Text }
}

/// The keys that tell what a step is.
pub const KINDS: [&str; 13] = [
    "do", "let", "sequence", "if", "wait", "monitor", "try", "repeat", "each", "parallel", "within", "keep",
    "end",
];

fn choose(bytes: &[u8], before: &[u8], steps: usize, dice: &mut Dice) -> u8 {
    let has = |byte: u8| bytes.contains(&byte);
    let any = |dice: &mut Dice| bytes.get(dice.below(bytes.len())).copied().unwrap_or(b'"');
    if bytes.len() > 40 {
        // A text or a name: short ones will do.
        let value = has(b'{') && dice.chance(20);
        return if value {
            b'{'
        } else if has(b'"') && dice.chance(30) {
            b'"'
        } else {
            any(dice)
        };
    }
    if has(b'd') && before.ends_with(b"{\"do\":\"") && dice.chance(40) {
        return if has(b'g') && dice.chance(40) { b'g' } else { b'd' };
    }
    if has(b'{') && before.ends_with(b"\"to\":") && dice.chance(50) {
        return b'{';
    }
    if has(b'_') && before.ends_with(b"\"detect") && dice.chance(80) {
        return b'_';
    }
    // A cleanup behind a step.
    if has(b',') && has(b'}') && before.ends_with(b"]") {
        return if dice.chance(25) { b',' } else { b'}' };
    }
    let written = || self::steps(&String::from_utf8_lossy(before));
    if has(b',') && has(b']') && before.ends_with(b"}") {
        let goes_on = if written() < steps { 95 } else { 10 };
        return if dice.chance(goes_on) { b',' } else { b']' };
    }
    if before.ends_with(b"{\"") && has(b'e') && has(b'd') {
        let ends = written() >= steps;
        return match dice.below(100) {
            _ if ends => b'e',
            0..65 => b'd',
            _ => {
                // Branches are proved most often: they are rare.
                let rare = dice.chance(80);
                let is_likely = |byte: &u8| !(rare && (*byte == b'p' || *byte == b'e'));
                let others: Vec<u8> = bytes.iter().copied().filter(is_likely).collect();
                others.get(dice.below(others.len())).copied().unwrap_or(b'd')
            }
        };
    }
    if before.ends_with(b"{\"end\":\"") && has(b'd') && dice.chance(80) {
        return b'd';
    }
    any(dice)
}

/// The same of the text syntax.
fn choose_text(bytes: &[u8], before: &[u8], steps: usize, dice: &mut Dice) -> u8 {
    let has = |byte: u8| bytes.contains(&byte);
    let any = |dice: &mut Dice| bytes.get(dice.below(bytes.len())).copied().unwrap_or(b' ');
    let in_text = before.iter().filter(|byte| **byte == b'"').count() % 2 == 1;
    // A failure has a name that begins as no fluent does, so that conditions are found that are about it.
    let is_asked = [&b" if "[..], b" when ", b" = "].iter().any(|word| before.ends_with(word));
    if has(b'z') && (before.ends_with(b" as ") || is_asked && dice.chance(70)) {
        return b'z';
    }
    if has(b'i') && before.ends_with(b" if ") && dice.chance(40) {
        return b'i';
    }
    if has(b's') && before.ends_with(b" i") && dice.chance(70) {
        return b's';
    }
    if bytes.len() > 40 {
        // A text or a name: short ones will do.
        let end = if in_text { b'"' } else { b' ' };
        let value = in_text && has(b'{') && dice.chance(20);
        return if value {
            b'{'
        } else if has(end) && dice.chance(30) {
            end
        } else {
            any(dice)
        };
    }
    if has(b'e') && before.ends_with(b" = d") && dice.chance(80) {
        return b'e';
    }
    if has(b'_') && before.ends_with(b" detect") && dice.chance(80) {
        return b'_';
    }
    if has(b'f') && (before.ends_with(b" go(") || before.ends_with(b" inspect(")) && dice.chance(60) {
        return b'f';
    }
    if before.ends_with(b" = ") && dice.chance(70) {
        // What finds lists, and what is about them.
        let wanted = if has(b'f') && dice.chance(60) { b"cf" } else { b"dd" };
        return if has(wanted[0]) { wanted[dice.below(2)] } else { any(dice) };
    }
    if in_text || !before.ends_with(b" ") {
        return any(dice);
    }
    let ends = self::steps(&String::from_utf8_lossy(before)) >= steps;
    if has(b'}') && !before.ends_with(b"{ ") {
        let closes = if ends { 90 } else { 5 };
        if dice.chance(closes) {
            return b'}';
        }
    }
    if has(b'f') && has(b'd') && has(b'r') {
        // Where a step begins. Branches are proved most often: they are rare.
        let rare = dice.chance(80);
        let from = |wanted: &[u8]| bytes.iter().copied().filter(|byte| wanted.contains(byte)).collect();
        let others: Vec<u8> = match dice.below(100) {
            _ if ends => from(b"df"),
            0..25 => from(b"l"),
            25..40 => from(b"g"),
            40..65 => bytes.iter().copied().filter(|byte| !b"efimrstw".contains(byte)).collect(),
            _ if dice.chance(80) => from(b"eimrstwp"),
            _ => from(b"k"),
        };
        let others: Vec<u8> = others.into_iter().filter(|byte| !(rare && *byte == b'p')).collect();
        return others.get(dice.below(others.len().max(1))).copied().unwrap_or_else(|| any(dice));
    }
    any(dice)
}
