//! Which link of a URDF is the base, the tip of the hand, the frame of the camera: told by what moves what, then by
//! the words that names are made of.

use crate::urdf::{Joint, JointKind, Urdf};

/// What was found.
pub(super) struct Parts {
    pub(super) base: usize,
    pub(super) base_why: &'static str,
    /// The kind of drive, and why.
    pub(super) drive: (&'static str, &'static str),
    pub(super) hand: Option<Hand>,
    /// The camera's link, and why.
    pub(super) camera: Option<(usize, &'static str)>,
    pub(super) camera_is_on_arm: bool,
}

/// The hand at the end of the arm.
pub(super) struct Hand {
    pub(super) tip: usize,
    pub(super) why: &'static str,
    /// Length of the stretched arm, in m.
    pub(super) reach: f64,
    /// Height of the shoulder above the base at rest, in m; turns on the way are left out.
    pub(super) shoulder: f64,
    /// What the fingers open to, in m, where they slide.
    pub(super) opening: Option<f64>,
    pub(super) points: &'static str,
    pub(super) closes: &'static str,
    /// The joints of the arm with positions within their limits.
    pub(super) arm: Vec<(String, f64)>,
}

/// Fewest joints of an arm.
const ARM: usize = 3;

impl Parts {
    pub(super) fn find(urdf: &Urdf) -> Self {
        let (base, base_why, is_planar) = base(urdf);
        let hand = hand(urdf, base);
        let camera = camera(urdf);
        let camera_is_on_arm = camera.is_some_and(|(camera, _)| {
            let first = hand.as_ref().and_then(|hand| hand.arm.first());
            first.is_some_and(|(name, _)| way(urdf, camera).iter().any(|joint| joint.name == *name))
        });
        Self { base, base_why, drive: drive(urdf, is_planar), hand, camera, camera_is_on_arm }
    }
}

/// The joints from the root to a link.
fn way(urdf: &Urdf, link: usize) -> Vec<&Joint> {
    let mut way = Vec::new();
    let mut at = link;
    while let Some(joint) = urdf.carrier(at) {
        way.push(joint);
        at = joint.parent;
    }
    way.reverse();
    way
}

fn moves(joint: &Joint) -> bool {
    joint.kind.has_one_position() && joint.mimic.is_none()
}

/// A joint that moves between limits that differ.
fn works(joint: &Joint) -> bool {
    moves(joint) && joint.limits.is_none_or(|limits| limits.upper > limits.lower)
}

fn has_word(name: &str, words: &[&str]) -> bool {
    let name = name.to_ascii_lowercase();
    words.iter().any(|word| name.contains(word))
}

/// The base's link: the root, or what hangs on a root that stands for the room.
fn base(urdf: &Urdf) -> (usize, &'static str, bool) {
    let root = urdf.links.get(urdf.root).map_or("", |link| link.name.as_str());
    let mut hanging = urdf.joints.iter().filter(|joint| joint.parent == urdf.root);
    let only = hanging.next().filter(|_| hanging.next().is_none());
    match only {
        Some(joint) if joint.kind == JointKind::Planar => (joint.child, "what a planar joint moves", true),
        Some(joint) if has_word(root, &["world", "map", "odom"]) => {
            (joint.child, "what the root carries", false)
        }
        Some(_) | None => (urdf.root, "the root", false),
    }
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

/// The tip of the longest arm: a link named for it, else the link that carries fingers, else the last link.
fn hand(urdf: &Urdf, base: usize) -> Option<Hand> {
    const TIPS: [(&[&str], &str); 4] = [
        (&["tcp", "tool0", "grasp", "ee_link", "end_effector"], "its name"),
        (&["palm"], "its name"),
        (&["hand", "gripper"], "its name"),
        (&[""], "the end of the longest arm"),
    ];
    let is_leg =
        |link: usize| way(urdf, link).iter().any(|joint| has_word(&joint.name, &["hfe", "knee", "wheel"]));
    let arms = |link: usize| way(urdf, link).iter().filter(|joint| works(joint)).count();
    let longest = (0..urdf.links.len())
        .filter(|link| !is_leg(*link))
        .map(|link| palm(urdf, link))
        .max_by_key(|link| (arms(*link), *link))?;
    let joints = arms(longest);
    if joints < ARM {
        return None;
    }
    let (tip, why) = TIPS.iter().find_map(|(words, why)| {
        let found = (0..urdf.links.len()).rev().find(|link| {
            let name = urdf.links.get(*link).map_or("", |link| link.name.as_str());
            *link != base
                && !is_leg(*link)
                && has_word(name, words)
                && !has_word(name, &["camera", "finger", "sensor", "optical"])
                && palm(urdf, *link) == *link
                && arms(*link) == joints
        });
        found.map(|tip| (tip, *why))
    })?;
    let steps = way(urdf, tip);
    let arm: Vec<&Joint> = steps.iter().copied().filter(|joint| works(joint)).collect();
    let first =
        steps.iter().position(|joint| works(joint) && joint.kind != JointKind::Prismatic).unwrap_or(0);
    let length = |joint: &&Joint| joint.parent_from_joint.xyz.iter().map(|v| v * v).sum::<f64>().sqrt();
    let slides =
        |joint: &&Joint| joint.limits.filter(|_| joint.kind == JointKind::Prismatic).map_or(0.0, |l| l.upper);
    let (points, closes, opening) = fingers(urdf, tip);
    Some(Hand {
        tip,
        why,
        reach: steps.iter().skip(first + 1).map(|joint| length(joint) + slides(joint)).sum::<f64>().max(0.05),
        shoulder: steps.iter().take(first + 1).map(|joint| joint.parent_from_joint.xyz[2]).sum(),
        opening,
        points,
        closes,
        arm: arm.iter().map(|joint| (joint.name.to_string(), at_rest(joint))).collect(),
    })
}

/// The link itself, or where it is part of a finger the link that carries the fingers: nearest to the base of those
/// that carry two joints which follow each other or slide.
fn palm(urdf: &Urdf, link: usize) -> usize {
    let carries = |link: usize| {
        let on = urdf.joints.iter().filter(|joint| joint.parent == link && joint.kind.has_one_position());
        let on: Vec<&Joint> = on.collect();
        on.len() >= 2 && on.iter().any(|joint| joint.mimic.is_some() || joint.kind == JointKind::Prismatic)
    };
    let is_far = |joint: &Joint| way(urdf, joint.parent).iter().filter(|joint| works(joint)).count() >= ARM;
    way(urdf, link)
        .iter()
        .find(|joint| {
            is_far(joint)
                && joint.kind.has_one_position()
                && (carries(joint.parent) || has_word(&joint.name, &["finger", "gripper"]))
        })
        .map_or(link, |joint| joint.parent)
}

/// Where fingers on a link, or beside it, point, along what they close, and how wide they open.
fn fingers(urdf: &Urdf, tip: usize) -> (&'static str, &'static str, Option<f64>) {
    let hosts: Vec<usize> =
        way(urdf, tip).iter().rev().take(2).map(|joint| joint.parent).chain([tip]).collect();
    let sliding: Vec<&Joint> = urdf
        .joints
        .iter()
        .filter(|joint| joint.kind == JointKind::Prismatic && hosts.contains(&joint.parent))
        .filter(|joint| has_word(&joint.name, &["finger", "grip", "jaw"]))
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
    let opening: f64 =
        sliding.iter().filter_map(|joint| joint.limits).map(|limits| limits.upper - limits.lower).sum();
    (points, closes, (opening > 0.001).then_some(opening))
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
