//! Data model of a URDF: names are unique, every number is finite and in range, and the links form one tree.

use smol_str::SmolStr;

/// Links and joints of a robot. There is at least one link.
#[derive(Clone, PartialEq, Debug)]
pub struct Urdf {
    /// Name of the robot in the file; may be empty.
    pub name: SmolStr,
    /// Links, in the order of the file.
    pub links: Vec<Link>,
    /// Joints, each after the joint that carries its parent link.
    pub joints: Vec<Joint>,
    /// Index of the link that no joint moves.
    pub root: usize,
    /// Pairs of links that may touch, the lower index first: empty for the file alone; [`crate::srdf`]
    /// finds them in an SRDF.
    pub may_touch: Vec<[usize; 2]>,
}

impl Urdf {
    /// Index of the link with a name. O(links).
    #[must_use]
    pub fn link(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }

    /// Index of the joint with a name. O(joints).
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Joint that carries a link; `None` for the root. O(joints).
    ///
    /// ```
    /// use motet_robots::builtin;
    ///
    /// let urdf = builtin::robot("panda").unwrap().urdf;
    /// let hand = urdf.link("panda_hand").unwrap();
    /// assert_eq!(urdf.carrier(hand).unwrap().child, hand);
    /// assert!(urdf.carrier(urdf.root).is_none());
    /// ```
    #[must_use]
    pub fn carrier(&self, link: usize) -> Option<&Joint> {
        self.joints.iter().find(|joint| joint.child == link)
    }
}

/// Rigid link of a robot.
#[derive(Clone, PartialEq, Debug)]
pub struct Link {
    /// Name, unique among links.
    pub name: SmolStr,
    /// Shapes for collision checks, in the frame of the link.
    pub collisions: Vec<LinkShape>,
    /// Shapes for display, in the frame of the link.
    pub visuals: Vec<LinkShape>,
}

/// Shape with its pose on a link.
#[derive(Clone, PartialEq, Debug)]
pub struct LinkShape {
    /// Pose of the centre of the shape in the frame of the link.
    pub link_from_shape: Pose,
    pub shape: UrdfShape,
}

/// Shape centred at its origin; lengths in m, none negative.
#[derive(Clone, PartialEq, Debug)]
pub enum UrdfShape {
    /// Box with full extents along x, y and z.
    Box([f64; 3]),
    /// Cylinder along z.
    Cylinder {
        radius: f64,
        length: f64,
    },
    /// Capsule along z.
    Capsule {
        /// Radius of the tube and of both ends.
        radius: f64,
        /// Length of the tube, without the round ends.
        length: f64,
    },
    Sphere {
        radius: f64,
    },
    /// Triangles from a file.
    Mesh {
        /// File as the URDF names it: `package://…`, `file://…` or a path relative to the URDF.
        file: String,
        /// Factors along x, y and z, none zero; a negative one mirrors.
        scale: [f64; 3],
    },
}

impl UrdfShape {
    /// Elements that a `<geometry>` may hold.
    pub(super) const ELEMENTS: [&str; 5] = ["box", "cylinder", "sphere", "capsule", "mesh"];
}

/// Rigid transform: a translation in m and a unit quaternion.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pose {
    /// Translation in m.
    pub xyz: [f64; 3],
    /// Rotation as a unit quaternion, x, y, z, w.
    pub quaternion_xyzw: [f64; 4],
}

impl Pose {
    /// Transform that moves nothing.
    pub const IDENTITY: Self = Self { xyz: [0.0; 3], quaternion_xyzw: [0.0, 0.0, 0.0, 1.0] };
}

/// Joint between a parent and a child link.
#[derive(Clone, PartialEq, Debug)]
pub struct Joint {
    /// Name, unique among joints.
    pub name: SmolStr,
    /// Motions that it allows.
    pub kind: JointKind,
    /// Index of the parent link.
    pub parent: usize,
    /// Index of the child link.
    pub child: usize,
    /// Pose of the joint, and of the child at position 0, in the parent's frame.
    pub parent_from_joint: Pose,
    /// Unit vector in the joint's frame: axis of rotation, direction of travel, or normal of the plane.
    pub axis: [f64; 3],
    /// Range of positions in rad or m; `None` for a joint without limits (fixed, continuous, planar,
    /// floating). For a joint that moves by itself it is narrowed to the limits of all that follow it.
    pub limits: Option<JointLimits>,
    /// Greatest speed in rad/s or m/s; `None` if the file gives none.
    pub velocity: Option<f64>,
    /// Mimic rule. No chain of these has a cycle.
    pub mimic: Option<Mimic>,
}

/// Kind of a joint.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum JointKind {
    /// Does not move.
    Fixed,
    /// Turns within limits.
    Revolute,
    /// Turns without limits.
    Continuous,
    /// Slides within limits.
    Prismatic,
    /// Slides in a plane and turns about its normal.
    Planar,
    /// Moves freely; held at its origin, with a warning.
    Floating,
}

impl JointKind {
    /// Kinds by their word in a URDF.
    pub const WORDS: [(&'static str, Self); 6] = [
        ("fixed", Self::Fixed),
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("planar", Self::Planar),
        ("floating", Self::Floating),
    ];

    /// True if one number gives the position of the joint.
    #[must_use]
    pub fn has_one_position(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous | Self::Prismatic)
    }
}

/// Closed interval of joint positions; `lower <= upper`, both finite.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct JointLimits {
    /// Least position, in rad or m.
    pub lower: f64,
    pub upper: f64,
}

/// Mimic rule: `position = multiplier * leader + offset`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Mimic {
    /// Index of the leader joint.
    pub joint: usize,
    pub multiplier: f64,
    /// Offset in rad or m.
    pub offset: f64,
}
