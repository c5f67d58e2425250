//! Search for the parts of a robot in a URDF: the base, behind links that stand for the room; the tip of the
//! hand and the frame of the camera, by the structure of the joints and then by words in names; and the arm
//! and the hand as an SRDF describes them.

use smol_str::SmolStr;

use crate::quaternion::{mul, rotate};
use crate::srdf::{JointGroup, Srdf};
use crate::urdf::{Joint, JointKind, Urdf};

/// Parts of a robot that the search found.
pub(super) struct RobotParts {
    pub(super) base: usize,
    pub(super) base_why: &'static str,
    /// Kind of the drive, and the reason.
    pub(super) drive: (&'static str, &'static str),
    pub(super) hand: Option<DraftHand>,
    /// Link of the camera, and the reason.
    pub(super) camera: Option<(usize, &'static str)>,
    pub(super) camera_is_on_arm: bool,
}

/// Hand at the end of the arm.
pub(super) struct DraftHand {
    pub(super) tip: usize,
    /// Reason of the choice and its source.
    pub(super) why: String,
    /// Length of the stretched arm, in m.
    pub(super) reach: f64,
    /// Height of the shoulder above the base at rest, in m; rotations in between are ignored.
    pub(super) shoulder: f64,
    /// Opening of sliding fingers, in m.
    pub(super) opening: Option<f64>,
    pub(super) points: &'static str,
    pub(super) closes: &'static str,
    /// Sliding fingers that move by themselves, with their open positions, in m.
    pub(super) open: Vec<(String, f64)>,
    /// Joints of the arm with positions within their limits.
    pub(super) arm: Vec<(String, f64)>,
}

/// Least number of joints of an arm.
pub(super) const ARM: usize = 3;

impl RobotParts {
    pub(super) fn find(urdf: &Urdf, srdf: Option<&Srdf>, tip: Option<&str>) -> Self {
        let DraftBase { link: base, why: base_why, is_planar } = DraftBase::find(urdf);
        let given = tip.and_then(|tip| urdf.links.iter().position(|link| link.name == tip));
        let hand = match given {
            Some(tip) => Some(measured(urdf, base, tip, &[], "as it was given".to_owned())),
            None => hand(urdf, srdf, base),
        };
        let camera = camera(urdf);
        let camera_is_on_arm = camera.is_some_and(|(camera, _)| {
            let first = hand.as_ref().and_then(|hand| hand.arm.first());
            first.is_some_and(|(name, _)| way(urdf, camera).iter().any(|joint| joint.name == *name))
        });
        Self { base, base_why, drive: drive(urdf, is_planar), hand, camera, camera_is_on_arm }
    }
}

/// Joints from the root to a link; see [`beyond`]. O(joints).
fn way(urdf: &Urdf, link: usize) -> Vec<&Joint> {
    let mut way = Vec::new();
    let mut at = link;
    // Backwards, each joint comes after the one that carries its parent.
    for joint in urdf.joints.iter().rev() {
        if joint.child == at {
            way.push(joint);
            at = joint.parent;
        }
    }
    way.reverse();
    way
}

/// Joints between the base and a link; all from the root if the base is not among them.
pub(super) fn beyond(urdf: &Urdf, base: usize, link: usize) -> Vec<&Joint> {
    let mut way = way(urdf, link);
    let before = way.iter().position(|joint| joint.child == base).map_or(0, |at| at + 1);
    way.drain(..before);
    way
}

/// Checks whether a link has the name of a sensor.
pub(super) fn senses(name: &str) -> bool {
    let is_imu = |word: &str| word.eq_ignore_ascii_case("imu");
    has_word(name, &["camera", "sensor", "optical"])
        || name.split(|c: char| !c.is_ascii_alphabetic()).any(is_imu)
}

fn moves(joint: &Joint) -> bool {
    joint.kind.has_one_position() && joint.mimic.is_none()
}

/// Checks whether a joint moves between limits that differ.
pub(super) fn works(joint: &Joint) -> bool {
    moves(joint) && joint.limits.is_none_or(|limits| limits.upper > limits.lower)
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

/// Words for the tip of a hand, best first.
pub(super) const TIPS: [&[&str]; 3] =
    [&["tcp", "tool0", "grasp", "ee_link", "end_effector"], &["palm"], &["hand", "gripper"]];

/// Finds the hand that the SRDF describes, else that at the end of the longest arm.
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

/// Tip of a described hand: a link rigidly attached to the mount with a name for a tip, else the first link
/// of the hand, else the mount.
fn described_tip(urdf: &Urdf, hand: &Described, length: impl Fn(usize) -> usize) -> usize {
    let mut rigid = vec![hand.mount];
    // Each joint stands after the one that carries its parent.
    for joint in urdf.joints.iter().filter(|joint| joint.kind == JointKind::Fixed) {
        if rigid.contains(&joint.parent) {
            rigid.push(joint.child);
        }
    }
    // Without an end effector the end of the group is the tip.
    let named = TIPS.iter().filter(|_| !hand.is_end).find_map(|words| {
        rigid.iter().rev().copied().find(|link| {
            let name = urdf.links.get(*link).map_or("", |link| link.name.as_str());
            has_word(name, words) && !has_word(name, &["finger"]) && !senses(name)
        })
    });
    let is_own = |link: &usize| rigid.contains(link) && length(*link) == length(hand.mount);
    named.or_else(|| hand.links.iter().copied().find(is_own)).unwrap_or(hand.mount)
}

/// Guesses the tip of the longest arm: a link with a name for it, else the link that carries fingers, else
/// the last link.
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

/// Measures the hand with a tip, whose own joints the SRDF may name.
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

/// Joints between the base and a link.
#[derive(Clone, Copy, Default)]
pub(super) struct ArmStem {
    /// Number of joints that move.
    pub(super) joints: usize,
    pub(super) is_leg: bool,
    /// For a finger the link that carries the fingers: the one nearest to the base that carries two joints
    /// which follow each other or slide.
    pub(super) palm: Option<usize>,
}

/// Stem of each link; empty for links that the base does not carry. O(links + joints).
pub(super) fn stems(urdf: &Urdf, base: usize) -> Vec<ArmStem> {
    // For each link the number of its joints, and whether one of them is a mimic joint or slides.
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

/// Pointing and closing direction of the fingers on a link or beside it, and those that slide. Joints of a
/// described hand count as fingers, whatever their names.
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

/// Open position of a sliding finger: the limit farther from 0, where it is closed.
fn opened(joint: &&Joint) -> Option<(String, f64)> {
    let limits = joint.limits?;
    let far = if limits.lower.abs() > limits.upper.abs() { limits.lower } else { limits.upper };
    Some((joint.name.to_string(), far))
}

/// Position 0, or the limit nearest to it.
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

/// Base link, with the reason of the choice.
#[derive(Clone, Copy)]
pub(super) struct DraftBase {
    pub(super) link: usize,
    pub(super) why: &'static str,
    /// True if joints before it slide it over the floor.
    pub(super) is_planar: bool,
}

impl DraftBase {
    /// Finds the base: the root, or the first link after links that stand for the room. O(joints²) of the
    /// links before the base.
    pub(super) fn find(urdf: &Urdf) -> Self {
        let mut base = Self { link: urdf.root, why: "the root", is_planar: false };
        while let Some(joint) = only(urdf, base.link) {
            let name = urdf.links.get(base.link).map_or("", |link| link.name.as_str());
            if let Some(link) = slid(urdf, base.link) {
                return Self { link, why: "moved by joints along x and y", is_planar: true };
            }
            base = match joint.kind {
                JointKind::Planar => {
                    return Self { link: joint.child, why: "moved by a planar joint", is_planar: true };
                }
                JointKind::Floating => Self { link: joint.child, why: "moved by a floating joint", ..base },
                JointKind::Fixed if has_word(name, &["world", "map", "odom"]) => {
                    Self { link: joint.child, why: "carried by the root", ..base }
                }
                // A revolute joint on the root is part of an arm, whatever the name of the root.
                JointKind::Fixed | JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic => {
                    return base;
                }
            };
        }
        base
    }
}

/// The only joint on a link.
fn only(urdf: &Urdf, link: usize) -> Option<&Joint> {
    let mut hanging = urdf.joints.iter().filter(|joint| joint.parent == link);
    hanging.next().filter(|_| hanging.next().is_none())
}

/// Link at the end of a chain of joints along x and along y, and maybe about z, without shapes before it: a
/// machine that slides has beams.
fn slid(urdf: &Urdf, from: usize) -> Option<usize> {
    let (mut at, mut turn) = (from, [0.0, 0.0, 0.0, 1.0]);
    // Joints seen along x, along y and about z.
    let mut has = [false; 3];
    while let Some(joint) = only(urdf, at).filter(|joint| joint.mimic.is_none()) {
        if urdf.links.get(at).is_none_or(|link| !link.collisions.is_empty() || !link.visuals.is_empty()) {
            break;
        }
        turn = mul(turn, joint.parent_from_joint.quaternion_xyzw);
        let along = rotate(turn, joint.axis).map(|part| part.abs() > 0.999);
        let which = match (joint.kind, along) {
            (JointKind::Prismatic, [true, _, _]) => 0,
            (JointKind::Prismatic, [_, true, _]) => 1,
            (JointKind::Revolute | JointKind::Continuous, [_, _, true]) => 2,
            _ => break,
        };
        match has.get_mut(which) {
            Some(is_known) if !*is_known => *is_known = true,
            Some(_) | None => break,
        }
        at = joint.child;
    }
    matches!(has, [true, true, _]).then_some(at)
}

/// Checks whether a name contains one of some words, ignoring case.
pub(super) fn has_word(name: &str, words: &[&str]) -> bool {
    let name = name.to_ascii_lowercase();
    words.iter().any(|word| name.contains(word))
}

/// Hand as described.
pub(super) struct Described {
    /// Link on which the hand is mounted, or with which the arm ends.
    pub(super) mount: usize,
    /// Links of the hand.
    pub(super) links: Vec<usize>,
    /// Joints of the hand.
    pub(super) joints: Vec<usize>,
    /// True if only the end of the arm is described, and no hand.
    pub(super) is_end: bool,
    /// Source of the description.
    pub(super) why: String,
}

impl Described {
    /// Finds the end effector on the longest arm, or the end of the longest chain of a group; `length` counts
    /// the joints between the base and a link.
    pub(super) fn find(urdf: &Urdf, srdf: &Srdf, length: impl Fn(usize) -> usize) -> Option<Self> {
        let hands = srdf.end_effectors.iter().rev().max_by_key(|(_, hand)| length(hand.parent));
        if let Some((name, hand)) = hands {
            let (links, joints) = members(urdf, srdf, &hand.group);
            let why = format!("the end effector `{}`", name.escape_debug());
            return Some(Self { mount: hand.parent, links, joints, is_end: false, why });
        }
        let ends = srdf.groups.iter().flat_map(|(name, group)| ends(urdf, group).map(move |end| (name, end)));
        // Of several with the same length the first.
        let (name, mount) = ends.collect::<Vec<_>>().into_iter().rev().max_by_key(|(_, end)| length(*end))?;
        let why = format!("the end of the group `{}`", name.escape_debug());
        Some(Self { mount, links: vec![], joints: vec![], is_end: true, why })
    }
}

/// Tips of the chains of a group, and the child of its last joint.
fn ends<'a>(urdf: &'a Urdf, group: &'a JointGroup) -> impl Iterator<Item = usize> + 'a {
    // Each joint comes after the one that carries its parent.
    let last = group.joints.iter().max().and_then(|joint| urdf.joints.get(*joint)).map(|joint| joint.child);
    group.chains.iter().map(|[_, tip]| *tip).chain(last)
}

/// Links and joints of a group and of its subgroups, with the children of its joints.
fn members(urdf: &Urdf, srdf: &Srdf, group: &str) -> (Vec<usize>, Vec<usize>) {
    let (mut links, mut joints): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut open = vec![SmolStr::new(group)];
    let mut next = 0;
    while let Some(group) = open.get(next).and_then(|name| srdf.groups.get(name)) {
        links.extend(&group.links);
        joints.extend(&group.joints);
        for inner in &group.groups {
            if !open.contains(inner) {
                open.push(inner.clone());
            }
        }
        next += 1;
    }
    links.extend(joints.iter().filter_map(|joint| urdf.joints.get(*joint)).map(|joint| joint.child));
    // Some tools list fixed joints.
    joints.retain(|joint| urdf.joints.get(*joint).is_some_and(|joint| joint.kind != JointKind::Fixed));
    (links, joints)
}
