//! Arms of a robot that the first card leaves out: a card has one hand, and nobody is to lose an arm
//! silently.

use smol_str::SmolStr;

use super::draft_parts::{ARM, ArmStem, DraftBase, TIPS, beyond, has_word, senses, stems, works};
use crate::urdf::Urdf;

/// Tips of arms that the card of a draft leaves out, longest first, with the number of their own joints:
/// chains of at least three joints that the arm to `tip`, the link of the hand of the card, does not share,
/// and shorter ones that carry a gripper or a tool. O(arms × links × joints).
///
/// ```
/// use motet_robots::{builtin, card};
///
/// let urdf = builtin::robot("panda").unwrap().urdf;
/// assert!(card::other_arms(&urdf, "panda_hand").is_empty());
/// ```
#[must_use]
pub fn other_arms(urdf: &Urdf, tip: &str) -> Vec<(SmolStr, usize)> {
    let base = DraftBase::find(urdf).link;
    let chains = OtherChains { urdf, base, stems: stems(urdf, base) };
    let mut taken = TakenJoints::default();
    if let Some(tip) = urdf.links.iter().position(|link| link.name == tip) {
        taken.add(chains.joints(tip));
    }
    let mut arms = Vec::new();
    while let Some((joints, link)) = chains.longest(&taken) {
        let own = joints.iter().filter(|joint| !taken.joints.contains(joint)).count();
        let name = urdf.links.get(link).map_or_else(SmolStr::default, |link| link.name.clone());
        arms.push((name, own));
        taken.add(joints);
    }
    arms
}

/// Joints of arms that are known, and the last one of each, beyond which its hand is.
#[derive(Default)]
struct TakenJoints {
    joints: Vec<SmolStr>,
    last: Vec<SmolStr>,
}

impl TakenJoints {
    fn add(&mut self, joints: Vec<SmolStr>) {
        self.last.extend(joints.last().cloned());
        self.joints.extend(joints);
    }
}

/// Chains of a robot beside the arm of its card.
struct OtherChains<'u> {
    urdf: &'u Urdf,
    base: usize,
    stems: Vec<ArmStem>,
}

impl OtherChains<'_> {
    /// Names of the joints that move a link.
    fn joints(&self, link: usize) -> Vec<SmolStr> {
        let steps = beyond(self.urdf, self.base, link);
        steps.iter().filter(|joint| works(joint)).map(|joint| joint.name.clone()).collect()
    }

    /// All joints of the longest chain beyond those that are taken, and its tip.
    fn longest(&self, taken: &TakenJoints) -> Option<(Vec<SmolStr>, usize)> {
        let ends = (0..self.urdf.links.len()).filter_map(|link| {
            let stem = self.stems.get(link).filter(|stem| !stem.is_leg && stem.palm.is_none())?;
            let joints = self.joints(link);
            let own = joints.iter().filter(|joint| !taken.joints.contains(joint)).count();
            let is_long = stem.joints >= ARM && own >= ARM;
            let is_hand = joints.iter().any(|joint| taken.last.contains(joint));
            let is_arm = is_long || own > 0 && !is_hand && self.is_tool(link);
            (is_arm && !self.is_finger(link)).then_some((own, joints, link))
        });
        let (_, joints, link) = ends.max_by_key(|(own, _, link)| (*own, *link))?;
        Some((joints, link))
    }

    /// Checks whether a link is a gripper or a tool, by its name.
    fn is_tool(&self, link: usize) -> bool {
        let name = self.urdf.links.get(link).map_or("", |link| link.name.as_str());
        let is_named = TIPS.iter().any(|words| has_word(name, words)) || has_word(name, &TOOLS);
        is_named && !has_word(name, &["handle"]) && !senses(name)
    }

    /// Checks whether a link is a part of a gripper, by the names of the joints and links on the way to it.
    fn is_finger(&self, link: usize) -> bool {
        beyond(self.urdf, self.base, link).iter().any(|joint| {
            let moved = self.urdf.links.get(joint.child).map_or("", |link| link.name.as_str());
            has_word(&joint.name, &FINGERS) || has_word(moved, &FINGERS)
        })
    }
}

/// Words for tools, and for the parts of a gripper.
const TOOLS: [&str; 4] = ["tool", "suction", "vacuum", "claw"];
const FINGERS: [&str; 4] = ["finger", "jaw", "knuckle", "thumb"];
