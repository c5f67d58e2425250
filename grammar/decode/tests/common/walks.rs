//! Random walks through the acceptor: what a model without any sense writes.

use motet_decode::{Acceptor, Prepared};

use super::dice::Dice;

/// Where a walk ended.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Ended {
    /// With a whole policy.
    Whole(String),
    /// Nowhere: no byte may follow.
    Stuck(String),
}

/// Walks at random until the policy is whole. Long walks are likelier than short ones: after a step another one follows as
/// a rule, until there are `steps`.
pub fn walk(prepared: &Prepared, budget: usize, steps: usize, dice: &mut Dice) -> Option<Ended> {
    let mut acceptor = prepared.acceptor(budget)?;
    loop {
        if acceptor.is_accepting() {
            return Some(Ended::Whole(text(&acceptor)));
        }
        let next = acceptor.next_bytes();
        let byte = match next.as_slice() {
            [] => return Some(Ended::Stuck(text(&acceptor))),
            [only] => *only,
            several => choose(several, acceptor.bytes(), steps, dice),
        };
        acceptor.accept(&[byte]);
    }
}

fn text(acceptor: &Acceptor) -> String {
    String::from_utf8_lossy(acceptor.bytes()).into_owned()
}

/// How many steps a policy has.
#[must_use]
pub fn steps(policy: &str) -> usize {
    KINDS.iter().map(|kind| policy.matches(&format!("{{\"{kind}\":")).count()).sum()
}

/// The keys that tell what a step is.
pub const KINDS: [&str; 10] =
    ["do", "sequence", "if", "wait", "monitor", "try", "repeat", "each", "parallel", "end"];

fn choose(bytes: &[u8], before: &[u8], steps: usize, dice: &mut Dice) -> u8 {
    let has = |byte: u8| bytes.contains(&byte);
    let any = |dice: &mut Dice| bytes.get(dice.below(bytes.len())).copied().unwrap_or(b'"');
    if bytes.len() > 40 {
        // A text or a name: short ones will do.
        return if has(b'"') && dice.chance(30) { b'"' } else { any(dice) };
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
                let is_likely = |byte: &u8| *byte != b'e' && !(rare && *byte == b'p');
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
