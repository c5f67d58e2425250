//! A robot card after reading: every number is finite and in range, every name it mentions exists in the card.

use indexmap::IndexMap;
use smol_str::SmolStr;

use super::spans::CardSpans;

/// A robot.
#[derive(Clone, PartialEq, Debug)]
pub struct Robot {
    /// Its id, `hsr`.
    pub name: SmolStr,
    /// What people call it, "Toyota HSR".
    pub title: String,
    /// How it drives.
    pub base: BaseSpec,
    /// Its hands, by resource name; the first is the one meant where only one is.
    pub hands: IndexMap<SmolStr, HandSpec>,
    /// Its cameras, by resource name.
    pub cameras: IndexMap<SmolStr, CameraSpec>,
    /// Its body, where the card names a URDF.
    pub model: Option<ModelSpec>,
    /// Named postures: positions of joints by name, in rad or m.
    pub postures: IndexMap<SmolStr, IndexMap<SmolStr, f64>>,
    /// Exclusive resources and what each contains, directly (`arm` contains `camera` on a robot with a wrist camera).
    /// Hands and cameras are resources too and always listed here.
    pub resources: IndexMap<SmolStr, Vec<SmolStr>>,
    /// Fluents and measures that it can observe, by name.
    pub observes: Vec<SmolStr>,
    /// Seconds that one observation takes at most.
    pub observe_within_secs: f64,
    /// Primitives that it provides, by name, with bounds on their numeric parameters.
    pub primitives: IndexMap<SmolStr, IndexMap<SmolStr, Range>>,
    /// QuantityReader that contracts may use as `robot.NAME`, in SI units, with their quantity type (`Length`, `Mass`, …,
    /// `Number` where it has no unit): `payload`, `opening` and `reach` of the first hand, `speed` of the base, and what
    /// the card lists beside them.
    pub numbers: IndexMap<SmolStr, (f64, SmolStr)>,
    /// Facts that hold at the start unless a state says otherwise, as text conditions: `free(hand)`, `not standing(robot)`.
    pub initially: Vec<String>,
    /// Text of the card's `primitives.motet`: signatures that differ from the standard ones; empty where there is none.
    pub declarations: String,
    /// Where the card says what declarations give a meaning to.
    pub spans: CardSpans,
}

/// How a robot drives.
#[derive(Clone, PartialEq, Debug)]
pub struct BaseSpec {
    /// Whether it drives at all, and how.
    pub drive: Drive,
    /// Nominal speed in m/s.
    pub speed_m_per_s: f64,
    /// Nominal turning speed in rad/s.
    pub turn_rad_per_s: f64,
    /// Radius of the disc that encloses the footprint, in m.
    pub radius_m: f64,
}

/// The kind of a base.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Drive {
    /// Bolted down.
    Fixed,
    /// Any direction at any time.
    Omnidirectional,
    /// Forward and turning.
    Differential,
    /// On legs; treated as omnidirectional while standing.
    Legged,
}

/// A robot's body.
#[derive(Clone, PartialEq, Debug)]
pub struct ModelSpec {
    /// The URDF, a path as seen from the card's folder.
    pub urdf: String,
    /// The SRDF, likewise.
    pub srdf: Option<String>,
    /// The link whose pose is that of the base; the root where none is named.
    pub base: Option<SmolStr>,
    /// How high above the floor that link is, in m.
    pub height_m: f64,
    /// Positions of joints where no posture says otherwise, in rad or m.
    pub rest: IndexMap<SmolStr, f64>,
    /// Folders that hold ROS packages, as seen from the card's.
    pub packages: Vec<String>,
}

/// A hand.
#[derive(Clone, PartialEq, Debug)]
pub struct HandSpec {
    /// The heaviest object in kg.
    pub payload_kg: f64,
    /// The widest object in m.
    pub opening_m: f64,
    /// The greatest distance in m, in the plane, at which it serves a thing from where the base stands.
    pub reach_m: f64,
    /// Heights above the floor in m at which it serves a thing.
    pub heights_m: Range,
    /// Its link in the URDF: what it holds is where the link's origin is.
    pub tip: Option<SmolStr>,
    /// The direction in the link's frame in which the fingers point; along one axis.
    pub points: [f64; 3],
    /// The direction in the link's frame along which they close; along another axis.
    pub closes: [f64; 3],
    /// Positions of its own joints when it is open, in rad or m.
    pub open: IndexMap<SmolStr, f64>,
}

/// A camera.
#[derive(Clone, PartialEq, Debug)]
pub struct CameraSpec {
    /// How far it sees, in m.
    pub range_m: f64,
    /// Full horizontal angle of view in rad.
    pub view_rad: f64,
    /// Its link in the URDF, which looks along z with y down.
    pub frame: Option<SmolStr>,
}

/// A closed interval in SI units; `least <= greatest`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Range {
    /// Least.
    pub least: f64,
    /// Greatest.
    pub greatest: f64,
}
