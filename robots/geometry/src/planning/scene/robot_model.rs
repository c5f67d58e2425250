//! Robot model for motion queries: card, kinematics, body, and the solver of its arm: in closed form where
//! the chain has one, else in steps.

use std::sync::OnceLock;

use motet_robots::card::{CameraMount, Drive, HandSpec, Robot};
use motet_robots::urdf::Urdf;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use smol_str::SmolStr;

use super::closing::{Closing, FingerContact, GRIP, HoldDepths, SHORT, STAGES};
use super::configuration::Configuration;
use super::obstacle::above_floor;
use crate::collision::{CollisionModel, Shape, Solid};
use crate::inverse::{LiftArm, ParallelArm, SevenArm, Tolerance, numeric};
use crate::kinematics::{AncestorJoint, KinematicChain, KinematicTree, planar};

/// Greatest change of a joint between two points of a hand path, in rad or m.
const JUMP: f64 = 0.5;

/// Gap between the palm and a held object, in m.
const PALM_GAP: f64 = 0.005;

/// Robot model: all that depends on the robot alone. Built once and shared by all scenes.
#[derive(Clone, Debug)]
pub struct RobotModel {
    card: Robot,
    tree: KinematicTree,
    body: CollisionModel,
    floor_from_root: Isometry3<f64>,
    /// Joints that move each link.
    ancestors: Vec<Vec<AncestorJoint>>,
    hand: Option<HandModel>,
    rest: Vec<f64>,
    /// Greatest distance of a point from the vertical axis of the base, in m.
    extent: f64,
    /// Flag of each variable: set where it turns some part.
    turning: Vec<bool>,
    /// Camera of the card, once it was asked for.
    pub(crate) camera_mount: OnceLock<Option<CameraMount>>,
}

/// Hand with the arm that carries it.
#[derive(Clone, Debug)]
pub struct HandModel {
    /// Name in the robot card.
    pub name: SmolStr,
    /// Entry in the robot card.
    pub card: HandSpec,
    /// Index of the tip's link.
    pub tip: usize,
    /// Inverse kinematics of the arm.
    pub solver: IkSolver,
    /// Reach of the palm from the tip's origin along the pointing direction, in m; may be negative.
    pub palm: f64,
    /// Reach of the open fingers, likewise.
    pub fingers: f64,
    /// Set where the tip is on a jaw that does not move: a held object rests against that jaw, else it is
    /// centred.
    pub has_fixed_jaw: bool,
    /// Variables of the hand's own joints, with their values in the open hand.
    pub open: Vec<(usize, f64)>,
    /// Flag of each link: set for links of the hand.
    pub members: Vec<bool>,
    /// Flag of each link: set where a joint of the arm moves it.
    pub carried: Vec<bool>,
    /// Fingers from open to closed.
    pub(crate) closing: Closing,
}

impl RobotModel {
    /// Builds the model from a card and its URDF; O(parts²).
    ///
    /// Fingers of one hand may touch each other, since they close on each other.
    #[must_use]
    pub fn new(card: &Robot, urdf: &Urdf) -> Self {
        let tree = KinematicTree::new(urdf);
        let model = card.model.as_ref();
        let link = |name: Option<&SmolStr>| name.and_then(|name| tree.link(name).ok());
        let base = link(model.and_then(|model| model.base.as_ref())).unwrap_or(tree.root());
        let mut rest = tree.neutral();
        let positions = model
            .into_iter()
            .flat_map(|model| &model.rest)
            .chain(card.postures.get("home").into_iter().flatten());
        for (joint, position) in positions {
            set(&tree, &mut rest, joint, *position);
        }
        let height = model.map_or(0.0, |model| model.height_m);
        let floor_from_root = Translation3::new(0.0, 0.0, height) * tree.pose(&rest, base, tree.root());
        let ancestors: Vec<Vec<AncestorJoint>> =
            (0..tree.links().len()).map(|link| tree.ancestor_joints(link)).collect();
        let mut allowed = urdf.may_touch.clone();
        for tip in card.hands.values().filter_map(|hand| link(hand.tip.as_ref())) {
            let fingers: Vec<usize> =
                (0..ancestors.len()).filter(|at| is_carried_by(&tree, &ancestors, tip, *at)).collect();
            allowed.extend(fingers.iter().flat_map(|one| fingers.iter().map(|other| [*one, *other])));
        }
        let body = CollisionModel::new(urdf, &tree, &allowed);
        let mut model = Self {
            card: card.clone(),
            tree,
            body,
            floor_from_root,
            ancestors,
            hand: None,
            rest,
            extent: 0.0,
            turning: vec![],
            camera_mount: OnceLock::new(),
        };
        let turns = |at: usize| {
            let mut ancestors = model.ancestors.iter().flatten();
            ancestors.any(|ancestor| ancestor.coupling.dof == at && !ancestor.is_prismatic)
        };
        model.turning = (0..model.tree.dofs().len()).map(turns).collect();
        model.extent = model.extent_about(base);
        model.hand = card.hands.iter().find_map(|(name, hand)| model.hand_of(name, hand, base, height));
        model
    }

    fn hand_of(&self, name: &SmolStr, card: &HandSpec, base: usize, height: f64) -> Option<HandModel> {
        let tip = self.tree.link(card.tip.as_deref()?).ok()?;
        let chain = KinematicChain::new(&self.tree, base, tip)?;
        let solver = IkSolver::of(&chain, self.card.base.drive, height);
        let in_arm = |ancestor: &AncestorJoint| chain.in_tree.contains(&ancestor.coupling.dof);
        let carried = self.ancestors.iter().map(|ancestors| ancestors.iter().any(in_arm)).collect();
        let links = 0..self.ancestors.len();
        let members = links.map(|at| {
            self.body.is_rigidly_attached(tip, at) || is_carried_by(&self.tree, &self.ancestors, tip, at)
        });
        let members: Vec<bool> = members.collect();
        let points = Vector3::from(card.points);
        let open = card.open.iter().filter_map(|(joint, at)| Some((self.tree.dof(joint).ok()?, *at)));
        let open: Vec<(usize, f64)> = open.collect();
        let poses = self.tree.root_from_links(&opened(&self.rest, &open));
        let tip_from_root = poses.get(tip)?.inverse();
        let parts = self.body.parts().iter().filter(|part| members.get(part.link) == Some(&true));
        let placed = parts.filter_map(|part| {
            Some((
                self.body.is_rigidly_attached(tip, part.link),
                part.solid.moved(&(tip_from_root * poses.get(part.link)?)),
            ))
        });
        let (mut palm, mut fingers) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        let (mut has_fixed_jaw, mut jaws, mut palms) = (false, vec![], vec![]);
        for (is_palm, solid) in placed {
            let is_jaw = is_palm && is_jaw(&solid, &Vector3::from(card.closes));
            has_fixed_jaw |= is_jaw;
            let end = solid.centre.dot(&points) + solid.extent(&points);
            if is_jaw {
                fingers = fingers.max(end);
                jaws.push(solid);
            } else if is_palm {
                palm = palm.max(front(&solid, &points));
                palms.push(solid);
            } else {
                fingers = fingers.max(end);
            }
        }
        let palm = if palm.is_finite() { palm + PALM_GAP } else { 0.0 };
        let fingers = if fingers.is_finite() { fingers } else { 0.02 };
        let stage = |at: usize| {
            let share = 1.0 - at as f64 / (STAGES - 1) as f64;
            let poses = self.tree.root_from_links(&between(&self.rest, &self.rest, &open, share));
            let moving = self.body.parts().iter().filter(|part| {
                members.get(part.link) == Some(&true) && !self.body.is_rigidly_attached(tip, part.link)
            });
            let tip_from_root = poses.get(tip).map(Isometry3::inverse).unwrap_or_default();
            let moving =
                moving.filter_map(|part| Some(part.solid.moved(&(tip_from_root * poses.get(part.link)?))));
            jaws.iter().copied().chain(moving).collect()
        };
        let stages = (0..STAGES).map(stage).collect();
        let closing =
            Closing::new([points, Vector3::from(card.closes)], (palms, stages), palm, has_fixed_jaw);
        Some(HandModel {
            name: name.clone(),
            card: card.clone(),
            tip,
            solver,
            palm,
            fingers,
            has_fixed_jaw,
            open,
            members,
            carried,
            closing,
        })
    }

    /// Card of the robot.
    #[must_use]
    pub fn card(&self) -> &Robot {
        &self.card
    }

    /// Kinematic tree of the robot.
    #[must_use]
    pub fn tree(&self) -> &KinematicTree {
        &self.tree
    }

    /// Collision body at rest.
    #[must_use]
    pub fn body(&self) -> &CollisionModel {
        &self.body
    }

    /// Hand that queries use: the first of the card whose arm starts at the base's link.
    #[must_use]
    pub fn hand(&self) -> Option<&HandModel> {
        self.hand.as_ref()
    }

    /// Joint values at rest: the posture `home`.
    #[must_use]
    pub fn rest(&self) -> &[f64] {
        &self.rest
    }

    /// Joint values of a posture; joints that it does not name stay as in `from`. `None` for an unknown name.
    ///
    /// ```
    /// use motet_geometry::planning::RobotModel;
    /// use motet_robots::builtin::{self, RobotWithBody};
    ///
    /// let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    /// let model = RobotModel::new(&robot, &urdf);
    /// let joints = model.posture("start", model.rest()).unwrap();
    /// for (name, position) in &robot.postures["start"] {
    ///     assert_eq!(joints[model.tree().dof(name).unwrap()], *position);
    /// }
    /// assert_eq!(model.posture("handstand", model.rest()), None);
    /// ```
    #[must_use]
    pub fn posture(&self, name: &str, from: &[f64]) -> Option<Vec<f64>> {
        let mut joints = from.to_vec();
        for (joint, position) in self.card.postures.get(name)? {
            set(&self.tree, &mut joints, joint, *position);
        }
        Some(joints)
    }

    /// Lowest point of the links that `counts` selects: the link and its height above the floor, in m.
    /// `None` where no shape of them is known.
    #[must_use]
    pub fn lowest(
        &self,
        configuration: &Configuration,
        counts: impl Fn(usize) -> bool,
    ) -> Option<(SmolStr, f64)> {
        let poses = self.map_from_links(configuration);
        let parts = self.body.parts().iter().filter(|part| counts(part.link));
        let heights =
            parts.filter_map(|part| Some((part.link, above_floor(&part.solid.moved(poses.get(part.link)?)))));
        let (link, height) = heights.min_by(|one, other| one.1.total_cmp(&other.1))?;
        Some((self.tree.links().get(link)?.clone(), height))
    }

    /// Checks whether the base drives.
    #[must_use]
    pub fn drives(&self) -> bool {
        self.card.base.drive != Drive::Fixed
    }

    /// Poses of all links in the map.
    #[must_use]
    pub fn map_from_links(&self, configuration: &Configuration) -> Vec<Isometry3<f64>> {
        let map_from_root = self.map_from_root(configuration.base);
        let mut poses = self.tree.root_from_links(&configuration.joints);
        for pose in &mut poses {
            *pose = map_from_root * *pose;
        }
        poses
    }

    /// Pose of the root link with the base at a pose on the floor.
    pub(crate) fn map_from_root(&self, [x, y, yaw]: [f64; 3]) -> Isometry3<f64> {
        planar(x, y, yaw) * self.floor_from_root
    }

    /// Flag of each variable: set where it turns some part.
    pub(crate) fn turning(&self) -> &[bool] {
        &self.turning
    }

    /// Greatest distance of a point of the robot from the vertical axis of its base, in m, over all joint
    /// values.
    pub(crate) fn extent(&self) -> f64 {
        self.extent
    }

    /// Sum over the joints of each chain. Before the first joint with a tilted axis, heights do not count.
    fn extent_about(&self, base: usize) -> f64 {
        let parts = self.body.parts().iter().map(|part| {
            let Some(chain) = KinematicChain::new(&self.tree, base, part.link) else { return f64::INFINITY };
            let (mut turned, mut is_upright, mut far) = (UnitQuaternion::identity(), true, 0.0);
            let mut add = |turned: &UnitQuaternion<f64>, shift: Vector3<f64>, is_upright: bool| {
                let shift = turned * shift;
                far += if is_upright { libm::hypot(shift.x, shift.y) } else { shift.norm() };
            };
            for joint in &chain.joints {
                add(&turned, joint.before.translation.vector, is_upright);
                turned *= joint.before.rotation;
                let axis = turned * joint.axis.into_inner();
                if joint.is_prismatic {
                    let limits = chain.dofs.get(joint.coupling.dof).and_then(|known| known.limits);
                    let ends = limits.map(|(lower, upper)| {
                        let place =
                            |value: f64| (joint.coupling.multiplier * value + joint.coupling.offset).abs();
                        place(lower).max(place(upper))
                    });
                    add(&turned, joint.axis.into_inner() * ends.unwrap_or(f64::INFINITY), is_upright);
                } else {
                    is_upright = is_upright && axis.z.abs() > 1.0 - 1e-9;
                }
            }
            add(&turned, chain.last_from_tip.translation.vector, is_upright);
            let solid = part.solid;
            add(&(turned * chain.last_from_tip.rotation), solid.centre, is_upright);
            let far = far + solid.reach();
            // Zero times infinity: a joint without limits that moves nothing.
            if far.is_nan() { f64::INFINITY } else { far }
        });
        parts.fold(0.0, f64::max)
    }

    pub(crate) fn ancestor_joints(&self, link: usize) -> &[AncestorJoint] {
        self.ancestors.get(link).map_or(&[], Vec::as_slice)
    }
}

impl HandModel {
    /// Offset of the centre of an object of a width from the tip along the closing direction, in m.
    #[must_use]
    pub fn middle(&self, width: f64) -> f64 {
        if self.has_fixed_jaw { width / 2.0 } else { 0.0 }
    }

    /// Width in m between the fingers of an object with a pose in the frame of the tip.
    pub(crate) fn width(&self, shape: Shape, tip_from_object: &Isometry3<f64>) -> f64 {
        let closes = tip_from_object.rotation.inverse() * Vector3::from(self.card.closes);
        2.0 * Solid::new(&Isometry3::identity(), shape).extent(&closes)
    }

    /// Joint values with the hand open.
    #[must_use]
    pub fn opened(&self, joints: &[f64]) -> Vec<f64> {
        opened(joints, &self.open)
    }

    /// Joint values with the fingers around an object of a width: open in proportion to the width.
    #[must_use]
    pub fn around(&self, joints: &[f64], rest: &[f64], width: f64) -> Vec<f64> {
        let share = (width / self.card.opening_m.max(1e-6)).clamp(0.0, 1.0);
        between(joints, rest, &self.open, share)
    }

    /// Greatest distance of a finger from the tip along their direction, open or closed, in m.
    pub(crate) fn farthest(&self) -> f64 {
        self.fingers.abs().max(self.closing.end().map_or(0.0, f64::abs))
    }

    /// Depths of an object's centre along the fingers at which they hold it, from `from` m on; `None` where
    /// there are none. Where the shapes of the fingers are unknown, they hold as deep as they reach.
    pub(crate) fn depths(&self, width: f64, contact: FingerContact, from: f64) -> Option<HoldDepths> {
        if self.closing.is_known() {
            return self.closing.depths(width, contact, from);
        }
        let most = self.fingers
            + match contact {
                FingerContact::Round => SHORT * width / 2.0,
                FingerContact::Flat(half) => half - GRIP.min(half),
            };
        (from <= most).then_some(HoldDepths { least: from, best: from, most })
    }

    /// Rotation of the tip in the map with the fingers pointing along `approach` and closing along `along`;
    /// the two are unit vectors and square to each other.
    #[must_use]
    pub fn turned(&self, approach: &Vector3<f64>, along: &Vector3<f64>) -> UnitQuaternion<f64> {
        let (points, closes) = (Vector3::from(self.card.points), Vector3::from(self.card.closes));
        let own = Matrix3::from_columns(&[points, closes, points.cross(&closes)]);
        let wanted = Matrix3::from_columns(&[*approach, *along, approach.cross(along)]);
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(wanted * own.transpose()))
    }
}

/// Shift of `far` m against the pointing direction of the hand, in the map.
pub(crate) fn away(map_from_tip: &Isometry3<f64>, hand: &HandModel, far: f64) -> Vector3<f64> {
    map_from_tip.rotation * -Vector3::from(hand.card.points) * far
}

/// Joint values with the hand open by a share, from closed at rest.
fn between(joints: &[f64], rest: &[f64], open: &[(usize, f64)], share: f64) -> Vec<f64> {
    let closed = |at: usize| rest.get(at).copied().unwrap_or(0.0);
    let fingers = open.iter().map(|(at, open)| (*at, closed(*at) + (open - closed(*at)) * share));
    opened(joints, &fingers.collect::<Vec<_>>())
}

fn opened(joints: &[f64], open: &[(usize, f64)]) -> Vec<f64> {
    let mut joints = joints.to_vec();
    for (at, value) in open {
        if let Some(slot) = joints.get_mut(*at) {
            *slot = *value;
        }
    }
    joints
}

fn set(tree: &KinematicTree, joints: &mut [f64], joint: &str, position: f64) {
    if let Some(slot) = tree.dof(joint).ok().and_then(|at| joints.get_mut(at)) {
        *slot = position;
    }
}

/// Checks whether a moving joint connects two links.
fn is_carried_by(tree: &KinematicTree, ancestors: &[Vec<AncestorJoint>], tip: usize, link: usize) -> bool {
    let own = ancestors.get(tip).map_or(0, Vec::len);
    ancestors.get(link).is_some_and(|ancestors| ancestors.len() > own)
        && KinematicChain::new(tree, tip_group(tree, ancestors, tip), link)
            .is_some_and(|chain| !chain.joints.is_empty())
}

/// Last moving link of the chain to the tip: everything on it is rigid with the tip.
fn tip_group(tree: &KinematicTree, ancestors: &[Vec<AncestorJoint>], tip: usize) -> usize {
    ancestors.get(tip).and_then(|ancestors| ancestors.last()).map_or(tree.root(), |last| last.frame)
}

/// Checks whether a solid in the tip's frame is a jaw whose inner face carries the tip.
fn is_jaw(solid: &Solid, closes: &Vector3<f64>) -> bool {
    const NEAR: f64 = 0.003;
    let point = Solid {
        shape: Shape::Capsule { radius: 0.0, half: 0.0 },
        centre: Vector3::zeros(),
        axes: solid.axes,
    };
    let face = solid.centre.dot(closes) + solid.extent(closes);
    (-NEAR..=0.0).contains(&face) && solid.distance(&point) <= NEAR
}

/// Position along a ray through the origin at which it meets a solid, coming from afar; −∞ where it misses.
fn front(solid: &Solid, direction: &Vector3<f64>) -> f64 {
    let far = 2.0;
    let mut at = far;
    while at > -far {
        let probe = Solid {
            centre: direction * at,
            axes: solid.axes,
            shape: Shape::Capsule { radius: 0.0, half: 0.0 },
        };
        let distance = solid.distance(&probe);
        if distance < 1e-6 {
            return at;
        }
        at -= distance;
    }
    f64::NEG_INFINITY
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
impl RobotModel {
    /// Model of an embedded robot.
    pub(crate) fn embedded(name: &str) -> Self {
        let motet_robots::builtin::RobotWithBody { robot, urdf } =
            motet_robots::builtin::robot(name).unwrap();
        Self::new(&robot, &urdf)
    }
}

/// Solver for the inverse kinematics of one arm, chosen by the shape of its chain.
#[derive(Clone, Debug)]
pub enum IkSolver {
    /// Lift with a spherical wrist, on a base that drives in every direction.
    Lift(LiftArm),
    /// Six joints, three of them parallel.
    Parallel(ParallelArm),
    /// Seven joints as in the Franka arms.
    Seven(SevenArm),
    /// Any other chain: damped least squares.
    Steps(KinematicChain),
}

impl IkSolver {
    /// Chooses the solver of a chain on a base with a drive, whose link is `height` m above the floor.
    ///
    /// ```
    /// use motet_geometry::planning::{IkSolver, RobotModel};
    /// use motet_robots::builtin::{self, RobotWithBody};
    ///
    /// let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    /// let model = RobotModel::new(&robot, &urdf);
    /// assert!(matches!(model.hand().unwrap().solver, IkSolver::Lift(_)));
    /// ```
    #[must_use]
    pub fn of(chain: &KinematicChain, drive: Drive, height: f64) -> Self {
        let drives_anywhere = matches!(drive, Drive::Omnidirectional | Drive::Legged);
        let lift =
            LiftArm::detect(chain).filter(|_| drives_anywhere).map(|arm| Self::Lift(arm.raised(height)));
        let parallel = || ParallelArm::detect(chain).map(Self::Parallel);
        let seven = || SevenArm::detect(chain).map(Self::Seven);
        lift.or_else(parallel).or_else(seven).unwrap_or_else(|| Self::Steps(chain.clone()))
    }

    /// Kinematic chain from the base's link to the tip.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        match self {
            Self::Lift(arm) => arm.chain(),
            Self::Parallel(arm) => arm.chain(),
            Self::Seven(arm) => arm.chain(),
            Self::Steps(chain) => chain,
        }
    }

    /// Joint values for a tip pose near to the one of `values`, without a jump to another branch.
    pub(crate) fn followed(&self, base_from_tip: &Isometry3<f64>, values: &[f64]) -> Option<Vec<f64>> {
        let is_near = |next: &Vec<f64>| next.iter().zip(values).all(|(a, b)| (a - b).abs() <= JUMP);
        let closed = match self {
            // The closed form finds all solutions, so none is near where the nearest is not.
            Self::Parallel(arm) => {
                return arm.nearest(base_from_tip, values.try_into().ok()?).map(Vec::from).filter(is_near);
            }
            Self::Seven(arm) => {
                let last = values.last().copied().unwrap_or_default();
                arm.nearest(base_from_tip, &[last], values, 1).pop().map(Vec::from)
            }
            Self::Lift(_) | Self::Steps(_) => None,
        };
        let numeric = || numeric::refined(self.chain(), base_from_tip, values, 20, Tolerance::EXACT);
        // A jump to another branch leaves the straight line of the hand.
        closed.filter(is_near).or_else(|| numeric().filter(is_near))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::{FingerContact, HandModel, HoldDepths, RobotModel};

    fn depths(hand: &HandModel, width: f64, contact: FingerContact) -> Option<HoldDepths> {
        let half = match contact {
            FingerContact::Round => width / 2.0,
            FingerContact::Flat(half) => half,
        };
        hand.depths(width, contact, (hand.palm + half).max(0.0))
    }

    #[test]
    fn closing_of_the_hsr_holds_slim_things_farther_out() {
        let model = RobotModel::embedded("hsr");
        let hand = model.hand().unwrap();
        let of = |width: f64| depths(hand, width, FingerContact::Round).unwrap();
        let [thin, middle, wide] = [0.012, 0.06, 0.12].map(of);
        assert!(middle.best > wide.best, "{middle:?} {wide:?}");
        assert!(thin.most > wide.most, "{thin:?} {wide:?}");
        // Open, the fingers end nearer than they do around a pen.
        assert!(thin.most > hand.fingers, "{thin:?} {}", hand.fingers);
    }

    #[test]
    fn closing_of_the_panda_covers_a_cube() {
        let model = RobotModel::embedded("panda");
        let hand = model.hand().unwrap();
        let cube = depths(hand, 0.05, FingerContact::Flat(0.025)).unwrap();
        assert!((cube.best - (hand.palm + 0.025)).abs() < 1e-9, "{cube:?}");
        assert!(cube.most < hand.fingers + 0.025 - 0.005, "{cube:?}");
    }

    #[test]
    fn closing_of_the_anymal_holds_nothing_round_in_a_wide_wedge() {
        let model = RobotModel::embedded("anymal_z1");
        let hand = model.hand().unwrap();
        let best = |width: f64| depths(hand, width, FingerContact::Round).map(|depths| depths.best);
        assert!(best(0.03).unwrap() < best(0.08).unwrap());
        assert_eq!(best(0.4), None);
    }
}
