//! A robot's kinematics and shapes, a second time: poses straight from the URDF's joints, shapes as parry3d
//! has them.

use std::collections::BTreeSet;

use glamx::{DPose3, DVec3};
use motet_geometry::planning::{Configuration, RobotModel};
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::urdf::{JointKind, Pose, Urdf, UrdfShape};
use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use parry3d_f64::{query, shape};

/// A shape somewhere.
pub(crate) struct Solid {
    pub(crate) pose: Isometry3<f64>,
    pub(crate) shape: Box<dyn shape::Shape>,
    /// Of the ball around it.
    pub(crate) centre: Vector3<f64>,
    pub(crate) radius: f64,
}

impl Solid {
    pub(crate) fn new(pose: Isometry3<f64>, shape: Box<dyn shape::Shape>) -> Self {
        let ball = shape.compute_bounding_sphere(&DPose3::from(pose));
        let centre = Vector3::new(ball.center.x, ball.center.y, ball.center.z);
        Self { pose, shape, centre, radius: ball.radius }
    }

    pub(crate) fn cuboid(pose: Isometry3<f64>, [x, y, z]: [f64; 3]) -> Self {
        Self::new(pose, Box::new(shape::Cuboid::new(DVec3::new(x, y, z) / 2.0)))
    }

    pub(crate) fn cylinder(pose: Isometry3<f64>, radius: f64, length: f64) -> Self {
        // parry's cylinder lies along y.
        let upright = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
        Self::new(pose * upright, Box::new(shape::Cylinder::new(length / 2.0, radius)))
    }

    pub(crate) fn capsule(pose: Isometry3<f64>, radius: f64, length: f64) -> Self {
        Self::new(pose, Box::new(shape::Capsule::new_z(length / 2.0, radius)))
    }

    pub(crate) fn ball(pose: Isometry3<f64>, radius: f64) -> Self {
        Self::new(pose, Box::new(shape::Ball::new(radius)))
    }

    pub(crate) fn floor() -> Self {
        Self {
            pose: Isometry3::identity(),
            shape: Box::new(shape::HalfSpace::new(DVec3::Z)),
            centre: Vector3::zeros(),
            radius: f64::INFINITY,
        }
    }

    /// True if another is no farther than `gap`, with this one moved.
    pub(crate) fn touches(
        &self,
        at: &Isometry3<f64>,
        other: &Solid,
        beyond: &Isometry3<f64>,
        gap: f64,
    ) -> bool {
        let reach = self.radius + other.radius + gap;
        if reach.is_finite() {
            let between = (at.rotation * self.centre + at.translation.vector)
                - (beyond.rotation * other.centre + beyond.translation.vector);
            if between.norm_squared() > reach * reach {
                return false;
            }
        }
        let (one, two) = (DPose3::from(at * self.pose), DPose3::from(beyond * other.pose));
        query::distance(&one, self.shape.as_ref(), &two, other.shape.as_ref())
            .map_or(true, |found| found.distance <= gap)
    }
}

/// A joint: the link it moves, and how.
struct Joint {
    parent: usize,
    child: usize,
    fixed: Isometry3<f64>,
    axis: Unit<Vector3<f64>>,
    slides: bool,
    /// Variable, multiplier and offset; none where it is fixed.
    driver: Option<(usize, f64, f64)>,
}

/// The tip's pose, and how it moves with the base's x, y and yaw and with each dof: velocity, angular
/// velocity.
pub(crate) struct Tip {
    pub(crate) pose: Isometry3<f64>,
    pub(crate) bases: [[f64; 6]; 3],
    pub(crate) columns: Vec<(usize, [f64; 6])>,
}

/// A robot.
pub struct Model {
    /// The robot as the query has it, for its card and which links may touch.
    pub machine: RobotModel,
    /// Its links and joints as read.
    pub urdf: Urdf,
    joints: Vec<Joint>,
    pub(crate) parts: Vec<(usize, Solid)>,
    /// Pairs of parts that may not touch.
    pub(crate) pairs: Vec<[usize; 2]>,
    base: usize,
    height: f64,
    /// Joints between the base and the tip, in order.
    chain: Vec<usize>,
}

fn isometry(pose: &Pose) -> Isometry3<f64> {
    let [x, y, z] = pose.xyz;
    let [i, j, k, w] = pose.quaternion_xyzw;
    Isometry3::from_parts(
        Translation3::new(x, y, z),
        UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k)),
    )
}

/// One of the robots that come with Motet; `None` where there is none of this name.
#[must_use]
pub fn robot(name: &str) -> Option<Model> {
    let RobotWithBody { robot, urdf } = builtin::robot(name)?;
    Model::new(RobotModel::new(&robot, &urdf), urdf)
}

impl Model {
    /// The model of a robot; `None` where it has no hand.
    #[must_use]
    pub fn new(machine: RobotModel, urdf: Urdf) -> Option<Self> {
        let driver = |at: usize| {
            let (mut factor, mut offset, mut at) = (1.0, 0.0, at);
            while let Some(mimic) = urdf.joints[at].mimic {
                offset += factor * mimic.offset;
                factor *= mimic.multiplier;
                at = mimic.joint;
            }
            machine.tree().dof(&urdf.joints[at].name).ok().map(|dof| (dof, factor, offset))
        };
        let moves = |kind| matches!(kind, JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic);
        let joints: Vec<Joint> = (urdf.joints.iter().enumerate())
            .map(|(at, joint)| Joint {
                parent: joint.parent,
                child: joint.child,
                fixed: isometry(&joint.parent_from_joint),
                axis: Unit::new_normalize(Vector3::from(joint.axis)),
                slides: joint.kind == JointKind::Prismatic,
                driver: moves(joint.kind).then(|| driver(at)).flatten(),
            })
            .collect();
        let mut parts = Vec::new();
        for (at, link) in urdf.links.iter().enumerate() {
            for listed in &link.collisions {
                let pose = isometry(&listed.link_from_shape);
                let solid = match listed.shape {
                    UrdfShape::Box(extents) => Solid::cuboid(pose, extents),
                    UrdfShape::Cylinder { radius, length } => Solid::cylinder(pose, radius, length),
                    UrdfShape::Capsule { radius, length } => Solid::capsule(pose, radius, length),
                    UrdfShape::Sphere { radius } => Solid::ball(pose, radius),
                    UrdfShape::Mesh { .. } => return None,
                };
                parts.push((at, solid));
            }
        }
        let body = machine.body();
        let link = |part: usize| body.parts()[part].link;
        let apart: BTreeSet<[usize; 2]> = (body.pairs().iter())
            .flat_map(|[one, other]| [[link(*one), link(*other)], [link(*other), link(*one)]])
            .collect();
        let mut pairs = Vec::new();
        for one in 0..parts.len() {
            for other in one + 1..parts.len() {
                if apart.contains(&[parts[one].0, parts[other].0]) {
                    pairs.push([one, other]);
                }
            }
        }
        let card = machine.card().model.as_ref()?;
        let base = card.base.as_ref().map_or(Some(urdf.root), |base| urdf.link(base))?;
        let (height, tip) = (card.height_m, machine.hand()?.tip);
        let mut chain = Vec::new();
        let mut at = tip;
        while at != base {
            let joint = joints.iter().position(|joint| joint.child == at)?;
            chain.push(joint);
            at = joints[joint].parent;
        }
        chain.reverse();
        Some(Self { machine, urdf, joints, parts, pairs, base, height, chain })
    }

    fn position(&self, joint: usize, values: &[f64]) -> f64 {
        self.joints[joint].driver.map_or(0.0, |(at, factor, offset)| factor * values[at] + offset)
    }

    fn step(&self, joint: usize, values: &[f64]) -> Isometry3<f64> {
        let it = &self.joints[joint];
        let position = self.position(joint, values);
        match it.driver {
            None => it.fixed,
            Some(_) if it.slides => it.fixed * Translation3::from(it.axis.into_inner() * position),
            Some(_) => it.fixed * UnitQuaternion::from_axis_angle(&it.axis, position),
        }
    }

    fn map_from_base(&self, [x, y, yaw]: [f64; 3]) -> Isometry3<f64> {
        Isometry3::from_parts(
            Translation3::new(x, y, self.height),
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw),
        )
    }

    /// The poses of the links in the map.
    pub(crate) fn links(&self, state: &Configuration) -> Vec<Isometry3<f64>> {
        let mut poses = vec![Isometry3::identity(); self.urdf.links.len()];
        for (at, joint) in self.joints.iter().enumerate() {
            poses[joint.child] = poses[joint.parent] * self.step(at, &state.joints);
        }
        let map_from_root = self.map_from_base(state.base) * poses[self.base].inverse();
        poses.iter().map(|pose| map_from_root * pose).collect()
    }

    /// The dofs that move the tip: `None` for the base's three, where it drives.
    pub(crate) fn movable(&self) -> Vec<Option<usize>> {
        let mut found: Vec<Option<usize>> = if self.machine.drives() { vec![None] } else { vec![] };
        for joint in &self.chain {
            if let Some((dof, ..)) = self.joints[*joint].driver
                && !found.contains(&Some(dof))
            {
                found.push(Some(dof));
            }
        }
        found
    }

    /// The tip where the robot is in a state.
    pub(crate) fn tip(&self, state: &Configuration) -> Tip {
        let mut pose = self.map_from_base(state.base);
        let mut axes = Vec::with_capacity(self.chain.len());
        for joint in &self.chain {
            let it = &self.joints[*joint];
            let before = pose * it.fixed;
            if let Some((dof, factor, _)) = it.driver {
                axes.push((dof, factor, it.slides, before * it.axis.into_inner(), before.translation.vector));
            }
            pose *= self.step(*joint, &state.joints);
        }
        let tip = pose.translation.vector;
        let turn = |axis: Vector3<f64>, from: Vector3<f64>| {
            let v = axis.cross(&(tip - from));
            [v.x, v.y, v.z, axis.x, axis.y, axis.z]
        };
        let base = Vector3::new(state.base[0], state.base[1], 0.0);
        let bases =
            [[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0, 0.0, 0.0], turn(Vector3::z(), base)];
        let mut columns: Vec<(usize, [f64; 6])> = Vec::new();
        for (dof, factor, slides, axis, from) in axes {
            let column = if slides { [axis.x, axis.y, axis.z, 0.0, 0.0, 0.0] } else { turn(axis, from) };
            let column = column.map(|part| part * factor);
            match columns.iter_mut().find(|(known, _)| *known == dof) {
                Some((_, sum)) => sum.iter_mut().zip(column).for_each(|(sum, part)| *sum += part),
                None => columns.push((dof, column)),
            }
        }
        Tip { pose, bases, columns }
    }

    /// True if a part of the robot counts: on a base that does not drive, only what the arm moves.
    pub(crate) fn counts(&self, link: usize) -> bool {
        self.machine.drives() || self.is_carried(link)
    }

    pub(crate) fn is_carried(&self, link: usize) -> bool {
        self.machine.hand().is_some_and(|hand| hand.carried[link])
    }

    pub(crate) fn in_hand(&self, link: usize) -> bool {
        self.machine.hand().is_some_and(|hand| hand.members[link])
    }
}
