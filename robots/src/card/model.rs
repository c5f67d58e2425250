//! Data model of a robot card: every number is finite and in range, every name in it exists. With the spans
//! of the names and bounds that the compiler checks against the library.

use std::f64::consts::{FRAC_PI_2, TAU};

use indexmap::IndexMap;
use motet_syntax::unit::Dimension;
use motet_syntax::{FileId, Span};
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::clearance::Clearance;

/// Robot as its card describes it.
#[derive(Clone, PartialEq, Debug)]
pub struct Robot {
    /// Id such as `hsr`.
    pub name: SmolStr,
    /// Title for people, such as "Toyota HSR".
    pub title: String,
    /// Drive, speeds and size of the base.
    pub base: BaseSpec,
    /// Hands by resource name; the first is the default.
    pub hands: IndexMap<SmolStr, HandSpec>,
    /// Cameras by resource name.
    pub cameras: IndexMap<SmolStr, CameraSpec>,
    /// URDF and SRDF, if the card names them.
    pub model: Option<ModelSpec>,
    /// Named postures: joint positions by name, in rad or m.
    pub postures: IndexMap<SmolStr, IndexMap<SmolStr, f64>>,
    /// Exclusive resources, each with those that it contains directly (`arm` contains `camera` on a robot
    /// with a wrist camera). Hands and cameras are always listed.
    pub resources: IndexMap<SmolStr, Vec<SmolStr>>,
    /// Fluents and measures that it can observe, by name.
    pub observes: Vec<SmolStr>,
    /// Longest time of one observation, in s.
    pub observe_within_secs: f64,
    /// Distances that its motions keep from obstacles.
    pub clearance: Clearance,
    /// Meanings of the words for manners.
    pub manners: Manners,
    /// Primitives that it provides, by name, with bounds on their numeric parameters.
    pub primitives: IndexMap<SmolStr, IndexMap<SmolStr, Range>>,
    /// Numbers that contracts may use as `robot.NAME`, in SI units, with their quantity type
    /// (`Length`, `Mass`, …, `Number` where it has no unit): `payload`, `opening` and `reach` of the first
    /// hand, `speed` of the base, and what the card lists beside them.
    pub numbers: IndexMap<SmolStr, (f64, SmolStr)>,
    /// Facts that hold at the start unless a state says otherwise, as text conditions: `free(hand)`, `not
    /// standing(robot)`.
    pub initially: Vec<String>,
    /// Text of `primitives.motet`: signatures that differ from the standard ones; empty without the file.
    pub declarations: String,
    /// Spans of the names that only the compiler can check.
    pub spans: CardSpans,
}

/// Meanings of `slowly` and `gently`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Manners {
    /// The manner of `slowly`.
    pub slowly: MannerSpec,
    /// The manner of `gently`.
    pub gently: MannerSpec,
}

/// Parts of the greatest speed and acceleration that a motion may use, above 0 and at most 1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MannerSpec {
    /// Part of the speed.
    pub speed: f64,
    /// Part of the acceleration.
    pub acceleration: f64,
}

impl Default for Manners {
    /// Manners of a card that gives none.
    fn default() -> Self {
        Self {
            slowly: MannerSpec { speed: 0.5, acceleration: 0.5 },
            gently: MannerSpec { speed: 0.3, acceleration: 0.25 },
        }
    }
}

/// Mobile or fixed base.
#[derive(Clone, PartialEq, Debug)]
pub struct BaseSpec {
    /// Kind of the drive.
    pub drive: Drive,
    /// Nominal speed in m/s.
    pub speed_m_per_s: f64,
    /// Nominal turning speed in rad/s.
    pub turn_rad_per_s: f64,
    /// Greatest acceleration in m/s².
    pub acceleration_m_per_s2: f64,
    /// Greatest angular acceleration in rad/s².
    pub turn_acceleration_rad_per_s2: f64,
    /// Radius of the disc that encloses the footprint, in m.
    pub radius_m: f64,
}

/// Kind of a drive.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Drive {
    /// Fixed to the floor or a table.
    Fixed,
    /// Any direction at any time.
    Omnidirectional,
    /// Forward and turning.
    Differential,
    /// On legs; treated as omnidirectional while standing.
    Legged,
}

/// Files and joint values of the body of a robot.
#[derive(Clone, PartialEq, Debug)]
pub struct ModelSpec {
    /// The URDF, a path as seen from the card's folder.
    pub urdf: String,
    /// The SRDF, likewise.
    pub srdf: Option<String>,
    /// The link whose pose is that of the base; the root where none is named.
    pub base: Option<SmolStr>,
    /// Height of that link above the floor, in m.
    pub height_m: f64,
    /// Positions of joints where no posture says otherwise, in rad or m.
    pub rest: IndexMap<SmolStr, f64>,
    /// Greatest accelerations of joints for which the card gives one, in rad/s² or m/s².
    pub accelerations: IndexMap<SmolStr, f64>,
    /// Folders that hold ROS packages, as seen from the card's.
    pub packages: Vec<String>,
}

/// Hand with its capacity and its place in the URDF.
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

/// Camera with its range and its place in the URDF.
#[derive(Clone, PartialEq, Debug)]
pub struct CameraSpec {
    /// Range of sight, in m.
    pub range_m: f64,
    /// Full horizontal angle of view in rad.
    pub view_rad: f64,
    /// Its link in the URDF, which looks along z with y down.
    pub frame: Option<SmolStr>,
}

/// Camera as its joints bear it, in the frame of the base on the floor. Elevations are in rad above the
/// horizon.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraMount {
    /// Its position in m.
    pub eye: [f64; 3],
    /// Elevations of its axis in the postures `home` and `start`.
    pub rests: [f64; 2],
    /// Least and greatest elevation to which its joints turn its axis.
    pub tilt: [f64; 2],
    /// True if only the arm turns it.
    pub is_on_arm: bool,
}

impl CameraMount {
    /// A camera that looks ahead and turns up and down without an end.
    #[must_use]
    pub const fn free(eye: [f64; 3]) -> Self {
        Self { eye, rests: [0.0; 2], tilt: [-FRAC_PI_2, FRAC_PI_2], is_on_arm: false }
    }

    /// Returns whether the camera is within 100 m of the base, and its elevations are angles in order.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        let [least, greatest] = self.tilt;
        let mut angles = self.rests.iter().chain(&self.tilt);
        self.eye.iter().all(|number| number.abs() <= 100.0)
            && angles.all(|angle| angle.abs() <= TAU)
            && least <= greatest
    }
}

/// Closed interval in SI units; `least <= greatest`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Range {
    pub least: f64,
    pub greatest: f64,
}

/// Spans of a card. They are no part of what the robot is, so any two are equal.
#[derive(Clone, Debug, Default)]
pub struct CardSpans {
    /// Name of `primitives.motet` in diagnostics.
    pub declarations: SmolStr,
    /// Names under `observes`.
    pub observes: IndexMap<SmolStr, Span>,
    /// Keys under `[primitives]`.
    pub primitives: IndexMap<SmolStr, Span>,
    /// Bounds of each parameter, by primitive and parameter.
    pub bounds: IndexMap<(SmolStr, SmolStr), BoundSpan>,
    /// Facts under `initially`, in order.
    pub initially: Vec<Span>,
}

/// Bounds of a parameter as written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct BoundSpan {
    pub span: Span,
    /// Dimension of their unit; `None` for bare numbers.
    pub dimension: Option<Dimension>,
}

impl PartialEq for CardSpans {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Keys under `[primitives]`, each with its parameters.
pub(super) fn primitives(
    document: &Spanned<DeTable<'_>>,
    file: FileId,
) -> IndexMap<SmolStr, (Span, IndexMap<SmolStr, Span>)> {
    let listed = keys(document.get_ref().get("primitives").map(Spanned::get_ref), file);
    listed.into_iter().map(|(name, span, value)| (name, (span, params(value, file)))).collect()
}

fn params(bounds: &DeValue<'_>, file: FileId) -> IndexMap<SmolStr, Span> {
    keys(Some(bounds), file).into_iter().map(|(name, span, _)| (name, span)).collect()
}

fn keys<'d, 'i>(section: Option<&'d DeValue<'i>>, file: FileId) -> Vec<(SmolStr, Span, &'d DeValue<'i>)> {
    let Some(DeValue::Table(table)) = section else { return Vec::new() };
    let key = |(key, value): (&'d Spanned<std::borrow::Cow<'i, str>>, &'d Spanned<DeValue<'i>>)| {
        let range = key.span();
        (SmolStr::new(key.get_ref()), Span::new(file, range.start, range.end), value.get_ref())
    };
    table.iter().map(key).collect()
}

/// Name of the declarations file beside a card.
pub(super) fn beside(card: &str, robot: &str) -> SmolStr {
    match card.strip_suffix("robot.toml") {
        Some(folder) if !folder.is_empty() => SmolStr::new(format!("{folder}primitives.motet")),
        Some(_) | None => SmolStr::new(format!("{robot}/primitives.motet")),
    }
}
