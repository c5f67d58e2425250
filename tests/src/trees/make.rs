//! Policies as text, made from a generator of random numbers.

use std::fmt::Write as _;

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{RngCore as _, SeedableRng as _};

/// Text of a policy with the sub-policies that it calls. Not every one of them passes the check.
#[must_use]
pub fn policy_text(seed: u64) -> String {
    let mut maker = Maker { dice: SplitMix64::seed_from_u64(seed), names: 0, parts: Vec::new(), left: 14 };
    let mut body = String::new();
    maker.block(1, Place { has_loops: true, has_effects: true, is_part: false }, &mut body);
    let mut text = maker.parts.concat();
    let _ = write!(text, "policy main {{\n{body}}}\n");
    text
}

/// Steps that a block may have.
#[derive(Clone, Copy)]
struct Place {
    /// Loops and waits take ticks of their own in a tree, which beside another branch would show.
    has_loops: bool,
    has_effects: bool,
    is_part: bool,
}

struct Maker {
    dice: SplitMix64,
    names: usize,
    /// Sub-policies.
    parts: Vec<String>,
    /// Number of steps that may still be made.
    left: usize,
}

impl Maker {
    fn roll(&mut self, sides: u64) -> u64 {
        self.dice.next_u64() % sides.max(1)
    }

    fn lamp(&mut self) -> String {
        format!("lamp_{}", 1 + self.roll(3))
    }

    fn block(&mut self, depth: usize, place: Place, out: &mut String) {
        for _ in 0..=self.roll(3) {
            self.step(depth, place, out);
        }
    }

    fn braces(&mut self, depth: usize, place: Place, out: &mut String) {
        out.push_str("{\n");
        self.block(depth + 1, place, out);
        let _ = write!(out, "{:1$}}}", "", 4 * depth);
    }

    fn step(&mut self, depth: usize, place: Place, out: &mut String) {
        let _ = write!(out, "{:1$}", "", 4 * depth);
        let is_leaf = self.left == 0 || depth > 5;
        self.left = self.left.saturating_sub(1);
        match if is_leaf { self.roll(8) } else { self.roll(24) } {
            0..=2 => self.push(out),
            3 if place.has_effects => {
                let _ = write!(out, "light({})", self.lamp());
            }
            4 if place.has_effects => {
                let _ = write!(out, "dim({}) retry {}", self.lamp(), 1 + self.roll(3));
            }
            5 if place.has_loops => {
                let _ = write!(out, "use({})", self.lamp());
                if self.roll(2) == 0 {
                    out.push_str(" retry 2");
                }
            }
            6 if place.has_loops => {
                let _ = write!(out, "wait until {} within 20 ms", self.condition(1));
            }
            7 => {
                self.names += 1;
                let name = self.names;
                let power = self.roll(4);
                let _ = write!(
                    out,
                    "let found{name} = find(\"lamp\")\n{:1$}push(found{name}, {power})",
                    "",
                    4 * depth
                );
            }
            8..=10 => {
                let _ = write!(out, "if {} ", self.condition(2));
                self.braces(depth, place, out);
                if self.roll(2) == 0 {
                    out.push_str(" else ");
                    self.braces(depth, place, out);
                }
            }
            11..=14 => self.handled(depth, place, out),
            15 if place.has_loops => {
                let _ = write!(out, "repeat {} ", 1 + self.roll(3));
                self.braces(depth, place, out);
                if self.roll(2) == 0 {
                    let _ = write!(out, " until {}", self.condition(1));
                }
            }
            16 if place.has_loops => {
                self.names += 1;
                let name = self.names;
                let (first, second) = (self.lamp(), self.lamp());
                let _ = writeln!(out, "each item{name} in [{first}, {second}] at most 2 {{");
                let _ = writeln!(out, "{:1$}push(item{name}, 7)", "", 4 * depth + 4);
                self.block(depth + 1, place, out);
                let _ = write!(out, "{:1$}}}", "", 4 * depth);
            }
            17..=18 if place.has_loops => {
                let inner = Place { has_loops: false, has_effects: false, ..place };
                out.push_str("parallel {\n");
                for _ in 0..2 + self.roll(2) {
                    let _ = write!(out, "{:1$}", "", 4 * depth + 4);
                    self.braces(depth + 1, inner, out);
                    out.push('\n');
                }
                let _ = write!(out, "{:1$}}}", "", 4 * depth);
            }
            19 => {
                let _ = write!(out, "sequence group_{} ", self.roll(9));
                self.braces(depth, place, out);
            }
            20 if place.has_loops => {
                out.push_str("within 1 min ");
                self.braces(depth, place, out);
            }
            21 if !place.is_part && place.has_loops => {
                self.names += 1;
                let name = format!("part_{}", self.names);
                let mut body = String::new();
                self.block(1, Place { is_part: true, ..place }, &mut body);
                self.parts.push(format!("policy {name} {{\n{body}}}\n"));
                let _ = write!(out, "{name}()");
            }
            22 if place.has_loops => {
                let ending = self.ending(false);
                let _ = write!(out, "monitor when {} then {ending} during ", self.condition(1));
                self.braces(depth, place, out);
            }
            23 => {
                let ending = self.ending(true);
                let _ = write!(out, "if {} {{ {ending} }}", self.condition(1));
            }
            _ => self.push(out),
        }
        out.push('\n');
    }

    fn push(&mut self, out: &mut String) {
        let _ = write!(out, "push({}, {})", self.lamp(), self.roll(4));
        if self.roll(3) == 0 {
            let _ = write!(out, " within 4 s retry {}", 1 + self.roll(2));
        }
    }

    fn handled(&mut self, depth: usize, place: Place, out: &mut String) {
        out.push_str("try ");
        self.braces(depth, place, out);
        for kinds in ["jam", "slip", "timeout, failed"].iter().filter(|_| self.dice.next_u64() % 3 == 0) {
            let _ = write!(out, " catch {kinds} ");
            let mut handler = String::new();
            self.block(depth + 1, place, &mut handler);
            let _ = write!(out, "{{\n{handler}{:1$}}}", "", 4 * depth);
        }
        if self.roll(2) == 0 {
            out.push_str(" catch any ");
            self.braces(depth, place, out);
        } else {
            out.push_str(" catch exhausted { push(lamp_1, 9) }");
        }
    }

    fn ending(&mut self, may_be_done: bool) -> &'static str {
        match self.roll(if may_be_done { 6 } else { 4 }) {
            0 => "fail \"it is over\"",
            1 => "cannot \"no <way> & 'none'\"",
            2 => "replan \"again\"",
            3 => "fail \"broken\"",
            _ => "done",
        }
    }

    fn condition(&mut self, depth: usize) -> String {
        match self.roll(if depth == 0 { 5 } else { 8 }) {
            0 | 1 => format!("lit({})", self.lamp()),
            2 => format!("not lit({})", self.lamp()),
            3 => format!("level({}) < 0.{}", self.lamp(), 1 + self.roll(9)),
            4 => format!("level({}) >= 0.{}", self.lamp(), 1 + self.roll(9)),
            5 => format!("({} and {})", self.condition(depth - 1), self.condition(depth - 1)),
            6 => format!("({} or {})", self.condition(depth - 1), self.condition(depth - 1)),
            _ => format!("not ({} and {})", self.condition(depth - 1), self.condition(depth - 1)),
        }
    }
}
