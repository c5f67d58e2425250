//! Which link of a URDF is the base, the tip of the hand, the frame of the camera: told by what moves what, then by
//! the words that names are made of.

use super::base::DraftBase;
use super::described::Described;
use crate::srdf::Srdf;
use crate::urdf::{Joint, JointKind, Urdf};

/// What was found.
pub(super) struct RobotParts {
    pub(super) base: usize,
    pub(super) base_why: &'static str,
    /// The kind of drive, and why.
    pub(super) drive: (&'static str, &'static str),
    pub(super) hand: Option<DraftHand>,
    /// The camera's link, and why.
    pub(super) camera: Option<(usize, &'static str)>,
    pub(super) camera_is_on_arm: bool,
}

/// The hand at the end of the arm.
pub(super) struct DraftHand {
    pub(super) tip: usize,
    /// Why it is the tip, and who says so.
    pub(super) why: String,
    /// Length of the stretched arm, in m.
    pub(super) reach: f64,
    /// Height of the shoulder above the base at rest, in m; turns on the way are left out.
    pub(super) shoulder: f64,
    /// What the fingers open to, in m, where they slide.
    pub(super) opening: Option<f64>,
    pub(super) points: &'static str,
    pub(super) closes: &'static str,
    /// Its sliding fingers that move by themselves, with where they are when it is open, in m.
    pub(super) open: Vec<(String, f64)>,
    /// The joints of the arm with positions within their limits.
    pub(super) arm: Vec<(String, f64)>,
}

/// Fewest joints of an arm.
const ARM: usize = 3;

impl RobotParts {
    pub(super) fn find(urdf: &Urdf, srdf: Option<&Srdf>) -> Self {
        let DraftBase { link: base, why: base_why, is_planar } = DraftBase::find(urdf);
        let hand = hand(urdf, srdf, base);
        let camera = camera(urdf);
        let camera_is_on_arm = camera.is_some_and(|(camera, _)| {
            let first = hand.as_ref().and_then(|hand| hand.arm.first());
            first.is_some_and(|(name, _)| way(urdf, camera).iter().any(|joint| joint.name == *name))
        });
        Self { base, base_why, drive: drive(urdf, is_planar), hand, camera, camera_is_on_arm }
    }
}

/// The joints from the root to a link; see [`beyond`]. O(joints).
fn way(urdf: &Urdf, link: usize) -> Vec<&Joint> {
    let mut way = Vec::new();
    let mut at = link;
    // From the tips on, each joint stands after the one that carries its parent.
    for joint in urdf.joints.iter().rev() {
        if joint.child == at {
            way.push(joint);
            at = joint.parent;
        }
    }
    way.reverse();
    way
}

/// Those of them after the base. All of them where it is not on the way.
fn beyond(urdf: &Urdf, base: usize, link: usize) -> Vec<&Joint> {
    let mut way = way(urdf, link);
    let before = way.iter().position(|joint| joint.child == base).map_or(0, |at| at + 1);
    way.drain(..before);
    way
}

/// Whether a link is called after something that feels, and is no part of a hand.
fn senses(name: &str) -> bool {
    let is_imu = |word: &str| word.eq_ignore_ascii_case("imu");
    has_word(name, &["camera", "sensor", "optical"])
        || name.split(|c: char| !c.is_ascii_alphabetic()).any(is_imu)
}

fn moves(joint: &Joint) -> bool {
    joint.kind.has_one_position() && joint.mimic.is_none()
}

/// A joint that moves between limits that differ.
fn works(joint: &Joint) -> bool {
    moves(joint) && joint.limits.is_none_or(|limits| limits.upper > limits.lower)
}

/// Whether a name has one of these in it, in whatever case.
pub(super) fn has_word(name: &str, words: &[&str]) -> bool {
    let name = name.to_ascii_lowercase();
    words.iter().any(|word| name.contains(word))
}

fn drive(urdf: &Urdf, is_planar: bool) -> (&'static str, &'static str) {
    let wheels: Vec<&Joint> = urdf
        .joints
        .iter()
        .filter(|joint| joint.kind == JointKind::Continuous && has_word(&joint.name, &["wheel"]))
        .collect();
    let feet = urdf.links.iter().filter(|link| has_word(&link.name, &["foot"])).count();
    let legs = urdf.joints.iter().filter(|joint| has_word(&joint.name, &["hfe", "knee", "thigh"])).count();
    if is_planar || wheels.iter().any(|joint| has_word(&joint.name, &["mecanum", "omni"])) {
        ("omnidirectional", "it moves in a plane")
    } else if !wheels.is_empty() {
        ("differential", "it has wheels")
    } else if feet >= 2 && legs >= 2 {
        ("legged", "it has feet")
    } else {
        ("fixed", "it has neither wheels nor feet")
    }
}

/// Words for the tip of a hand, the best first.
const TIPS: [&[&str]; 3] =
    [&["tcp", "tool0", "grasp", "ee_link", "end_effector"], &["palm"], &["hand", "gripper"]];

/// The hand that the SRDF describes, else that at the end of the longest arm.
fn hand(urdf: &Urdf, srdf: Option<&Srdf>, base: usize) -> Option<DraftHand> {
    let stems = stems(urdf, base);
    let length = |link: usize| stems.get(link).filter(|stem| !stem.is_leg).map_or(0, |stem| stem.joints);
    let described = srdf.and_then(|srdf| Described::find(urdf, srdf, length));
    match described.filter(|hand| length(hand.mount) >= ARM) {
        Some(hand) => {
            let tip = described_tip(urdf, &hand, length);
            Some(measured(urdf, base, tip, &hand.joints, format!("from the SRDF: {}", hand.why)))
        }
        None => {
            let (tip, why) = guessed_tip(urdf, base, &stems)?;
            Some(measured(urdf, base, tip, &[], format!("guessed: {why}")))
        }
    }
}

/// Of what is rigid with the link that a hand is mounted on, what is named for a tip, else the hand's first link, else that link.
fn described_tip(urdf: &Urdf, hand: &Described, length: impl Fn(usize) -> usize) -> usize {
    let mut rigid = vec![hand.mount];
    // Each joint stands after the one that carries its parent.
    for joint in urdf.joints.iter().filter(|joint| joint.kind == JointKind::Fixed) {
        if rigid.contains(&joint.parent) {
            rigid.push(joint.child);
        }
    }
    // Where there is no end effector, the group's end is the tip.
    let named = TIPS.iter().filter(|_| !hand.is_end).find_map(|words| {
        rigid.iter().rev().copied().find(|link| {
            let name = urdf.links.get(*link).map_or("", |link| link.name.as_str());
            has_word(name, words) && !has_word(name, &["finger"]) && !senses(name)
        })
    });
    let is_own = |link: &usize| rigid.contains(link) && length(*link) == length(hand.mount);
    named.or_else(|| hand.links.iter().copied().find(is_own)).unwrap_or(hand.mount)
}

/// The tip of the longest arm: a link named for it, else the link that carries fingers, else the last link.
fn guessed_tip(urdf: &Urdf, base: usize, stems: &[ArmStem]) -> Option<(usize, &'static str)> {
    let is_leg = |link: usize| stems.get(link).is_some_and(|stem| stem.is_leg);
    let arms = |link: usize| stems.get(link).map_or(0, |stem| stem.joints);
    let palm = |link: usize| stems.get(link).and_then(|stem| stem.palm).unwrap_or(link);
    let longest = (0..urdf.links.len())
        .filter(|link| !is_leg(*link))
        .map(palm)
        .max_by_key(|link| (arms(*link), *link))?;
    let joints = arms(longest);
    if joints < ARM {
        return None;
    }
    let words = TIPS.iter().map(|words| (*words, "its name"));
    words.chain([(&[""][..], "the end of the longest arm")]).find_map(|(words, why)| {
        let found = (0..urdf.links.len()).rev().find(|link| {
            let name = urdf.links.get(*link).map_or("", |link| link.name.as_str());
            *link != base
                && !is_leg(*link)
                && has_word(name, words)
                && !has_word(name, &["finger"])
                && !senses(name)
                && palm(*link) == *link
                && arms(*link) == joints
        });
        found.map(|tip| (tip, why))
    })
}

/// The hand with this tip, whose own joints the SRDF may name.
fn measured(urdf: &Urdf, base: usize, tip: usize, own: &[usize], why: String) -> DraftHand {
    let steps = beyond(urdf, base, tip);
    let arm: Vec<&Joint> = steps.iter().copied().filter(|joint| works(joint)).collect();
    let first =
        steps.iter().position(|joint| works(joint) && joint.kind != JointKind::Prismatic).unwrap_or(0);
    let length = |joint: &&Joint| joint.parent_from_joint.xyz.iter().map(|v| v * v).sum::<f64>().sqrt();
    let slides =
        |joint: &&Joint| joint.limits.filter(|_| joint.kind == JointKind::Prismatic).map_or(0.0, |l| l.upper);
    let (points, closes, sliding) = fingers(urdf, tip, own);
    let travel: f64 =
        sliding.iter().filter_map(|joint| joint.limits).map(|limits| limits.upper - limits.lower).sum();
    DraftHand {
        tip,
        why,
        reach: steps.iter().skip(first + 1).map(|joint| length(joint) + slides(joint)).sum::<f64>().max(0.05),
        shoulder: steps.iter().take(first + 1).map(|joint| joint.parent_from_joint.xyz[2]).sum(),
        opening: (travel > 0.001).then_some(travel),
        points,
        closes,
        open: sliding.iter().filter(|joint| works(joint)).filter_map(opened).collect(),
        arm: arm.iter().map(|joint| (joint.name.to_string(), at_rest(joint))).collect(),
    }
}

/// What lies between the base and a link.
#[derive(Clone, Copy, Default)]
struct ArmStem {
    /// How many joints work.
    joints: usize,
    is_leg: bool,
    /// Of a part of a finger the link that carries the fingers: nearest to the base of those that carry two joints which
    /// follow each other or slide.
    palm: Option<usize>,
}

/// That of each link; nothing for what the base does not carry. O(links + joints).
fn stems(urdf: &Urdf, base: usize) -> Vec<ArmStem> {
    // Whether a link carries two joints, and whether one of them follows another or slides.
    let mut carried = vec![(0_usize, false); urdf.links.len()];
    for joint in urdf.joints.iter().filter(|joint| joint.kind.has_one_position()) {
        if let Some((count, is_finger)) = carried.get_mut(joint.parent) {
            *count += 1;
            *is_finger |= joint.mimic.is_some() || joint.kind == JointKind::Prismatic;
        }
    }
    let mut stems = vec![ArmStem::default(); urdf.links.len()];
    let mut is_carried = vec![false; urdf.links.len()];
    if let Some(base) = is_carried.get_mut(base) {
        *base = true;
    }
    // Each joint stands after the one that carries its parent.
    for joint in &urdf.joints {
        let on_base = is_carried.get(joint.parent) == Some(&true);
        let Some(slot) = is_carried.get_mut(joint.child).filter(|_| on_base) else { continue };
        *slot = true;
        let before = stems.get(joint.parent).copied().unwrap_or_default();
        let carries = carried.get(joint.parent).is_some_and(|(count, is_finger)| *count >= 2 && *is_finger);
        let is_finger = before.joints >= ARM
            && joint.kind.has_one_position()
            && (carries || has_word(&joint.name, &["finger", "gripper"]));
        if let Some(stem) = stems.get_mut(joint.child) {
            *stem = ArmStem {
                joints: before.joints + usize::from(works(joint)),
                is_leg: before.is_leg || has_word(&joint.name, &["hfe", "knee", "wheel"]),
                palm: before.palm.or(is_finger.then_some(joint.parent)),
            };
        }
    }
    stems
}

/// Where fingers on a link, or beside it, point, along what they close, and those that slide. Joints that the hand is said to
/// have are fingers whatever they are called.
fn fingers<'u>(urdf: &'u Urdf, tip: usize, own: &[usize]) -> (&'static str, &'static str, Vec<&'u Joint>) {
    let hosts: Vec<usize> =
        way(urdf, tip).iter().rev().take(2).map(|joint| joint.parent).chain([tip]).collect();
    let is_finger = |joint: &Joint| {
        let words = ["finger", "grip", "jaw"];
        let moved = urdf.links.get(joint.child).map_or("", |link| link.name.as_str());
        hosts.contains(&joint.parent) && (has_word(&joint.name, &words) || has_word(moved, &words))
    };
    let sliding: Vec<&Joint> = urdf
        .joints
        .iter()
        .zip(0..)
        .filter(|(joint, at)| joint.kind == JointKind::Prismatic && (own.contains(at) || is_finger(joint)))
        .map(|(joint, _)| joint)
        .collect();
    let offset = sliding.first().map_or([0.0, 0.0, 1.0], |joint| joint.parent_from_joint.xyz);
    let names = ["x", "y", "z"];
    let largest = |vector: [f64; 3]| {
        let sizes = vector.into_iter().zip(names);
        sizes
            .fold(
                (0.0, "z"),
                |best, (size, name)| if size.abs() > best.0 { (size.abs(), name) } else { best },
            )
            .1
    };
    let points = largest(offset);
    let closes = sliding.first().map_or("y", |joint| largest(joint.axis));
    let closes = if closes == points { if points == "y" { "z" } else { "y" } } else { closes };
    (points, closes, sliding)
}

/// Where a finger that slides is open: at the limit farther from 0, where it is shut.
fn opened(joint: &&Joint) -> Option<(String, f64)> {
    let limits = joint.limits?;
    let far = if limits.lower.abs() > limits.upper.abs() { limits.lower } else { limits.upper };
    Some((joint.name.to_string(), far))
}

/// 0, or the limit nearest to it.
fn at_rest(joint: &Joint) -> f64 {
    joint.limits.map_or(0.0, |limits| 0.0_f64.clamp(limits.lower, limits.upper))
}

fn camera(urdf: &Urdf) -> Option<(usize, &'static str)> {
    const NAMES: [(&[&str], &str); 3] = [
        (&["rgbd", "color_optical", "rgb_optical", "camera_optical"], "its name"),
        (&["optical"], "its name"),
        (
            &["camera", "realsense", "xtion", "kinect"],
            "its name; whether it looks along z with y down is to be checked",
        ),
    ];
    NAMES.iter().find_map(|(words, why)| {
        let found = urdf.links.iter().position(|link| {
            has_word(&link.name, words) && !has_word(&link.name, &["gazebo", "imu", "infra"])
        });
        found.map(|camera| (camera, *why))
    })
}
