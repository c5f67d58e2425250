//! Mutated seeds for a target, without coverage: `mutate TARGET SECONDS FOLDER [SEED]`. What fails is written
//! to the folder, as `crash-…` or `slow-…`.

use motet_fuzz::{TARGETS, target};
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

/// Time of one case that is too long.
const SLOW: Duration = Duration::from_secs(5);

/// Numbers that look random, from a seed (SplitMix64).
struct Dice(u64);

impl Dice {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ (mixed >> 31)) as usize % most.max(1)
    }
}

const WORDS: [&[u8]; 16] = [
    b"\"",
    b"{",
    b"}",
    b"[",
    b"]",
    b"(",
    b")",
    b"<",
    b"/>",
    b"1e308",
    b"-1",
    b"0",
    b"99999999999999999999",
    b"\xff",
    b"\n%%\n",
    b"\0",
];

fn mutated(seeds: &[Vec<u8>], dice: &mut Dice) -> Vec<u8> {
    let mut case = seeds[dice.below(seeds.len())].clone();
    for _ in 0..=dice.below(6) {
        let (at, to) = (dice.below(case.len() + 1), dice.below(case.len() + 1));
        let (at, to) = (at.min(to), at.max(to).min(at.min(to) + 64));
        match dice.below(7) {
            0 => drop(case.splice(at..at, WORDS[dice.below(WORDS.len())].iter().copied())),
            1 => drop(case.drain(at..to)),
            2 => {
                let piece = case[at..to].to_vec();
                let there = dice.below(case.len() + 1);
                drop(case.splice(there..there, piece));
            }
            3 => {
                let other = &seeds[dice.below(seeds.len())];
                let from = dice.below(other.len() + 1);
                let piece = other[from..(from + dice.below(200)).min(other.len())].to_vec();
                drop(case.splice(at..to, piece));
            }
            4 => {
                let piece = case[at..to].repeat(1 + dice.below(200));
                drop(case.splice(at..to, piece));
            }
            5 => case.truncate(to),
            _ => case.iter_mut().skip(at).take(1).for_each(|byte| *byte = dice.below(256) as u8),
        }
    }
    case
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [name, seconds, folder, rest @ ..] = &args[..] else {
        let names: Vec<_> = TARGETS.iter().map(|(name, _)| *name).collect();
        println!("{}", names.join("\n"));
        return;
    };
    let (run, folder) = (target(name), Path::new(folder));
    let entries = fs::read_dir(folder).expect("there is a folder of seeds").flatten();
    let mut paths: Vec<_> = entries.map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    paths.sort();
    let seeds: Vec<Vec<u8>> = paths.iter().flat_map(fs::read).collect();
    assert!(!seeds.is_empty(), "there are no seeds in {}", folder.display());
    let mut dice = Dice(rest.first().and_then(|seed| seed.parse().ok()).unwrap_or(1));
    let until = Instant::now() + Duration::from_secs_f64(seconds.parse().expect("a number of seconds"));
    let (mut cases, mut failed) = (0_usize, 0);
    let mut slowest = Duration::ZERO;
    while cases < seeds.len() || Instant::now() < until {
        let case = seeds.get(cases).cloned().unwrap_or_else(|| mutated(&seeds, &mut dice));
        cases += 1;
        let begun = Instant::now();
        let panics = std::panic::catch_unwind(|| run(&case)).is_err();
        let took = begun.elapsed();
        slowest = slowest.max(took);
        if panics || took > SLOW {
            failed += 1;
            let kind = if panics { "crash" } else { "slow" };
            let path = folder.join(format!("{kind}-{cases}"));
            fs::write(&path, &case).expect("the case can be written");
            println!("{}: {:.1} s", path.display(), took.as_secs_f64());
        }
    }
    println!("{name}: {cases} cases, {failed} failed, the slowest took {:.2} s", slowest.as_secs_f64());
    std::process::exit(i32::from(failed > 0));
}
