//! Motion queries and their answers, with the tally of contacts that gives the reason of an infeasible one.
//! This is the vocabulary of all folders of `planning`.

use std::collections::BTreeMap;

use motet_robots::clearance::Clearance;
use motet_stdlib::lang::approaches;
use smol_str::{SmolStr, format_smolstr};

use super::placing::{MapPose, Misfit, PlaceRules};
use super::scene::{Configuration, Contact, KEPT};

/// Direction from which an object is grasped.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum GraspSide {
    /// Within 35° of straight down.
    Top,
    /// Any direction but from above.
    Side,
    /// Within 45° of the direction from the base.
    Front,
}

impl GraspSide {
    /// All sides, in order.
    pub const ALL: [Self; 3] = [Self::Top, Self::Side, Self::Front];

    /// Name of the side in the language.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Top => approaches::TOP,
            Self::Side => approaches::SIDE,
            Self::Front => approaches::FRONT,
        }
    }

    /// Side with a name; `None` for any other word.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|side| side.name() == name)
    }
}

/// Motion query. Names are ids of the scene.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum MotionQuery {
    /// Drive to a place from which an entity is served.
    GoTo(SmolStr),
    /// Grasp an object, from a given side or from any.
    Reach(SmolStr, Option<GraspSide>),
    /// Grasp an object at a point; `None` for one that only the run knows.
    ReachAt(SmolStr, Option<MapPose>),
    /// Drive to a pose of the base.
    StandAt(MapPose),
    /// Put the held object on a surface or into a container, at a place by these rules.
    Put(SmolStr, SmolStr, PlaceRules),
    /// Hold the held object out to a person.
    Offer(SmolStr, SmolStr),
    /// Bring an entity into the camera's view.
    Look(SmolStr),
    /// Open a container by its handle.
    Pull(SmolStr),
    /// Close a container by its handle, or push any other object a little away from the robot.
    Push(SmolStr),
    /// Move the arm to a posture of the card.
    Posture(SmolStr),
    /// Any other motion, by name; it is not computed.
    Other(SmolStr),
}

impl MotionQuery {
    /// Entities that the motion is about, the one where it ends last.
    ///
    /// ```
    /// use motet_geometry::planning::MotionQuery;
    ///
    /// let query = MotionQuery::from_call("put", ["mug_1", "shelf"], None).unwrap();
    /// assert!(query.entities().eq(["mug_1", "shelf"]));
    /// ```
    pub fn entities(&self) -> impl DoubleEndedIterator<Item = &SmolStr> {
        let (first, second) = match self {
            Self::Put(object, other, _) | Self::Offer(object, other) => (Some(object), Some(other)),
            Self::GoTo(id)
            | Self::Reach(id, _)
            | Self::ReachAt(id, _)
            | Self::Look(id)
            | Self::Pull(id)
            | Self::Push(id) => (Some(id), None),
            Self::StandAt(_) | Self::Posture(_) | Self::Other(_) => (None, None),
        };
        first.into_iter().chain(second)
    }

    /// Query of a motion by its name in the language, the ids that it names, and the side of a grasp. `None`
    /// where no motion has this name, this number of ids and, if a side is given, a side.
    ///
    /// ```
    /// use motet_geometry::planning::{GraspSide, MotionQuery};
    ///
    /// let query = MotionQuery::from_call("reach", ["mug_1"], Some(GraspSide::Top)).unwrap();
    /// assert_eq!(query.to_string(), "reach(mug_1, top)");
    /// assert_eq!(MotionQuery::from_call("put", ["mug_1"], None), None);
    /// ```
    #[must_use]
    pub fn from_call<I: Into<SmolStr>>(
        name: &str,
        ids: impl IntoIterator<Item = I>,
        side: Option<GraspSide>,
    ) -> Option<Self> {
        let mut ids = ids.into_iter().map(Into::into);
        let (first, second, third) = (ids.next()?, ids.next(), ids.next());
        Some(match (name, second, side) {
            _ if third.is_some() => return None,
            ("reach", None, side) => Self::Reach(first, side),
            ("go_to", None, None) => Self::GoTo(first),
            ("put", Some(on), None) => Self::Put(first, on, PlaceRules::default()),
            ("offer", Some(to), None) => Self::Offer(first, to),
            ("look", None, None) => Self::Look(first),
            ("pull", None, None) => Self::Pull(first),
            ("push", None, None) => Self::Push(first),
            ("posture", None, None) => Self::Posture(first),
            _ => return None,
        })
    }
}

impl std::fmt::Display for MotionQuery {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::GoTo(to) => write!(f, "go_to({to})"),
            Self::Reach(object, None) => write!(f, "reach({object})"),
            Self::Reach(object, Some(side)) => write!(f, "reach({object}, {})", side.name()),
            Self::ReachAt(object, Some(pose)) => write!(f, "reach_at({object}, {pose})"),
            Self::ReachAt(object, None) => write!(f, "reach_at({object}, …)"),
            Self::StandAt(pose) => write!(f, "stand_at({pose})"),
            Self::Put(object, on, rules) => write!(f, "put({object}, {on}{rules})"),
            Self::Offer(object, to) => write!(f, "offer({object}, {to})"),
            Self::Look(at) => write!(f, "look({at})"),
            Self::Pull(what) => write!(f, "pull({what})"),
            Self::Push(what) => write!(f, "push({what})"),
            Self::Posture(name) => write!(f, "posture({name})"),
            Self::Other(name) => write!(f, "{name}(…)"),
        }
    }
}

/// Search budget. A larger budget finds more and never contradicts an answer of a smaller one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SearchBudget {
    /// Candidate configurations per grasp.
    pub candidates: usize,
    /// Free candidates for which a path is searched.
    pub paths: usize,
    /// Cells and grasp patches of a proof that no configuration is free. An unfinished proof leaves the
    /// answer uncertified.
    pub cells: usize,
}

impl SearchBudget {
    /// Budget scaled by a factor.
    #[must_use]
    pub fn times(self, factor: usize) -> Self {
        let [candidates, paths, cells] =
            [self.candidates, self.paths, self.cells].map(|count| count.saturating_mul(factor));
        Self { candidates, paths, cells }
    }
}

impl Default for SearchBudget {
    fn default() -> Self {
        Self { candidates: 512, paths: 64, cells: 32_768 }
    }
}

/// Answer to a motion query.
#[derive(Clone, PartialEq, Debug)]
pub enum MotionAnswer {
    /// A motion exists: this one.
    Feasible(Box<MotionWitness>),
    /// No motion exists, or a complete search found none: see [`Infeasible::certified`].
    Infeasible(Infeasible),
    Unknown(UnknownReason),
}

/// Witness: a path that proves a motion feasible.
#[derive(Clone, PartialEq, Debug)]
pub struct MotionWitness {
    /// Configurations from the start to the goal; each edge between two is certified free.
    pub path: Vec<Configuration>,
    /// Grasp at the end of the path. On the last edge the hand approaches it and may touch the object.
    pub grasp: Option<Grasp>,
    pub margins: Margins,
}

/// Grasp of an object: a hand pose relative to it, with an opening.
#[derive(Clone, PartialEq, Debug)]
pub struct Grasp {
    pub object: SmolStr,
    pub side: GraspSide,
    /// Pose of the tip in the map.
    pub map_from_tip: nalgebra::Isometry3<f64>,
    /// Pose of the object in the tip's frame.
    pub tip_from_object: nalgebra::Isometry3<f64>,
    /// Opening of the hand, in m.
    pub width: f64,
}

/// Margins of a motion.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Margins {
    /// Least distance to obstacles and floor, in m, at most 1, at the way-points and half-way between them.
    /// Along the whole path it is at least [`MIN_CLEARANCE`](crate::planning::MIN_CLEARANCE). What may come
    /// near by intent, such as the hand to the support of what it grasps, does not count.
    pub clearance: f64,
    /// Distances from obstacles that the whole path was checked to keep; see
    /// [`PlanningScene::clearance_kept`](crate::planning::PlanningScene::clearance_kept).
    pub required: Clearance,
    /// Distance of the last configuration to the nearest limit of a joint that moved, in rad or m; `None`
    /// where none moved.
    pub limit: Option<f64>,
    /// Payload that is left, in kg; `None` where no mass is known.
    pub payload: Option<f64>,
}

/// Infeasibility: the reason, and a change that would help.
#[derive(Clone, PartialEq, Debug)]
pub struct Infeasible {
    pub reason: InfeasibleReason,
    /// Change that would make the motion feasible, in words; known after
    /// [`QueryContext::explain`](crate::planning::QueryContext::explain) or where it follows from the reason.
    pub change: Option<String>,
    /// Set where infeasibility is proven for all grasps and configurations; else the search ended without a
    /// motion.
    pub certified: bool,
    /// Free goal configuration to which no path was found. `None` where a proof excludes one.
    pub configuration: Option<Box<Configuration>>,
    /// Place that is too tight for the clearance, where a smaller clearance leaves a motion; known after
    /// [`QueryContext::explain`](crate::planning::QueryContext::explain).
    pub tight: Option<Box<TightSpot>>,
}

/// Place that is too tight for the clearance.
#[derive(Clone, PartialEq, Debug)]
pub struct TightSpot {
    /// Parts whose clearance excludes the motion.
    pub group: TightGroup,
    /// Clearance that they have to keep, in m.
    pub needs: f64,
    /// Clearance with which a motion was found, in m: at most a thirtieth of `needs` below the greatest.
    pub most: f64,
    /// Obstacle that this motion passes at the least distance, if it is known.
    pub by: Option<SmolStr>,
    /// Gap between two obstacles, if the base passes one there.
    pub gap: Option<Gap>,
}

/// Parts of the robot that keep one clearance.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TightGroup {
    Base,
    Arm,
    /// Neither clearance alone excludes the motion; lengths are those of the arm.
    Both,
}

/// Gap between two obstacles that the base passes.
#[derive(Clone, PartialEq, Debug)]
pub struct Gap {
    /// Obstacle on the other side.
    pub other: SmolStr,
    /// Width of the gap, in m.
    pub width: f64,
    /// Width of the base between the two obstacles, in m.
    pub base: f64,
}

impl std::fmt::Display for TightSpot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { group, needs, most, by, gap } = self;
        let needs = Centimetres(*needs);
        if let (Some(by), Some(Gap { other, width, base })) = (by, gap) {
            let (one, other) = (named(by), named(other));
            return write!(
                f,
                "the gap between {one} and {other} is {width:.2} m; the base needs {base:.2} m and {needs} \
                 clearance on each side"
            );
        }
        let who = match group {
            TightGroup::Base => "the base",
            TightGroup::Arm => "the arm",
            TightGroup::Both => "the robot",
        };
        write!(f, "{who} needs a clearance of {needs}, and there is ")?;
        if *most < 0.001 {
            f.write_str("no room for one")?;
        } else {
            write!(f, "room for {}", Centimetres(*most))?;
        }
        by.as_ref().map_or(Ok(()), |by| write!(f, " beside {}", named(by)))
    }
}

/// Length in m, written in cm and rounded down to a tenth.
struct Centimetres(f64);

impl std::fmt::Display for Centimetres {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} cm", libm::floor(self.0 * 1000.0 + 1e-6) / 10.0)
    }
}

impl Infeasible {
    /// Infeasibility with a proof.
    pub(crate) fn proven(reason: InfeasibleReason, change: Option<String>) -> Self {
        Self { reason, change, certified: true, configuration: None, tight: None }
    }

    /// Infeasibility after a search without a result.
    pub(crate) fn exhausted(reason: InfeasibleReason) -> Self {
        Self { reason, change: None, certified: false, configuration: None, tight: None }
    }

    /// Reason in words, with the place that is too tight for the clearance.
    #[must_use]
    pub fn says(&self) -> String {
        match &self.tight {
            Some(tight) => format!("{}; {tight}", self.reason),
            None => self.reason.to_string(),
        }
    }
}

/// Reason of an infeasible motion, in the language's terms.
#[derive(Clone, PartialEq, Debug)]
pub enum InfeasibleReason {
    /// Too far, too high or too low; both lengths in m.
    OutOfReach {
        /// Length that is compared with the reach.
        length: ReachLength,
        needs: f64,
        reach: f64,
    },
    /// Every candidate configuration is in contact.
    NoFreePose {
        /// Most frequent contact.
        by: Option<SmolStr>,
        /// Count of that contact, where it was counted.
        share: Option<ContactShare>,
    },
    /// Free goal configurations exist, and no path to one was found.
    BlockedPath {
        /// Most frequent contact on the paths tried.
        by: Option<SmolStr>,
    },
    /// No place on the support is as it should be.
    NoPlace(Misfit),
    /// The camera does not see it from here.
    NotInView {
        /// Entity that hides it most often.
        by: Option<SmolStr>,
        /// Bearing beyond the camera's view.
        aside: Option<BearingLimit>,
    },
    /// Heavier than the payload; both in kg.
    TooHeavy { needs: f64, limit: f64 },
    /// Wider than the hand opens; both in m.
    TooWide {
        /// Least width over all grasps.
        needs: f64,
        limit: f64,
    },
    /// Point of a grasp that is not at the object; both in m.
    Beside {
        /// Distance of the point from the object.
        needs: f64,
        limit: f64,
    },
}

/// Length that decides whether a target is within reach.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ReachLength {
    /// Height of the hand above the floor.
    Height,
    /// Distance from the arm's shoulder, or from the base.
    Distance,
    /// Distance from the camera.
    Sight,
}

impl InfeasibleReason {
    /// Name of the reason in the language.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::OutOfReach { .. } => "out_of_reach",
            Self::NoFreePose { .. } => "no_free_pose",
            Self::BlockedPath { .. } => "blocked_path",
            Self::NoPlace(_) => "no_place",
            Self::NotInView { .. } => "not_in_view",
            Self::TooHeavy { .. } => "too_heavy",
            Self::TooWide { .. } => "too_wide",
            Self::Beside { .. } => "beside",
        }
    }
}

impl std::fmt::Display for InfeasibleReason {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::OutOfReach { length: ReachLength::Sight, needs, reach } => {
                write!(f, "is {needs:.2} m away, the camera sees {reach:.2} m")
            }
            Self::NotInView { by: Some(by), .. } => write!(f, "{} hides it from the camera", named(by)),
            Self::NotInView { by: None, aside: Some(BearingLimit { needs, limit }) } => {
                let (to, needs) = (if *needs > 0.0 { "left" } else { "right" }, needs.abs().to_degrees());
                write!(
                    f,
                    "is {needs:.0}° to the {to}, the camera sees {:.0}° to either side",
                    limit.to_degrees()
                )
            }
            Self::NotInView { by: None, aside: None } => f.write_str("the camera does not turn there"),
            Self::OutOfReach { length: ReachLength::Height, needs, reach } => {
                write!(f, "needs a height of {needs:.2} m, the hand reaches {reach:.2} m")
            }
            Self::OutOfReach { length: ReachLength::Distance, needs, reach } => {
                write!(f, "needs a distance of {needs:.2} m, the hand reaches {reach:.2} m")
            }
            Self::NoFreePose { by: Some(by), share } => {
                write!(f, "every candidate configuration collides, most often with {}", named(by))?;
                match share {
                    Some(ContactShare { touching, tried }) => {
                        write!(f, " ({touching} of {tried} samples)")
                    }
                    None => Ok(()),
                }
            }
            Self::NoFreePose { by: None, .. } => f.write_str("no configuration of the robot reaches it"),
            Self::BlockedPath { by: Some(by) } => write!(f, "{} blocks the path", named(by)),
            Self::BlockedPath { by: None } => f.write_str("no path leads there"),
            Self::NoPlace(why) => write!(f, "{why}"),
            Self::TooHeavy { needs, limit } => {
                write!(f, "weighs {needs:.2} kg, the hand carries {limit:.2} kg")
            }
            Self::TooWide { needs, limit } => {
                write!(f, "is {needs:.3} m wide, the hand opens to {limit:.3} m")
            }
            Self::Beside { needs, limit } => {
                write!(f, "the point is {needs:.2} m beside it, a hand closes within {limit:.2} m of it")
            }
        }
    }
}

/// Share of the tried poses that are in contact with one body: poses of the robot or, where the hand alone
/// is never free, of the hand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ContactShare {
    /// Poses whose first contact is this body.
    pub touching: usize,
    /// All poses tried.
    pub tried: usize,
}

/// Bearing of a target relative to the base's heading, and the limit of the camera's view, in rad.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BearingLimit {
    /// Bearing, positive to the left.
    pub needs: f64,
    /// Greatest bearing to either side.
    pub limit: f64,
}

/// Body as it is written in a message: the robot itself and kept regions have no id.
fn named(by: &str) -> String {
    if by.starts_with(ITSELF) || by.starts_with(KEPT) { by.to_owned() } else { format!("`{by}`") }
}

/// Name of the robot in the reasons of its own contacts.
pub(crate) const ITSELF: &str = "the robot itself";

/// Reason for an undecided query.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum UnknownReason {
    /// The budget ended the search.
    Budget,
    /// The query does not apply to this robot and scene, or is not computed; in words.
    Because(String),
}

/// Answer of a proof that there is no motion.
pub(crate) fn certain(reason: InfeasibleReason, change: Option<String>) -> MotionAnswer {
    MotionAnswer::Infeasible(Infeasible::proven(reason, change))
}

/// Count of contacts by body.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTally {
    others: BTreeMap<SmolStr, usize>,
    /// Contacts within the robot, by the two links.
    own: BTreeMap<[SmolStr; 2], usize>,
}

impl ContactTally {
    pub(crate) fn add(&mut self, contact: &Contact) {
        if contact.is_own {
            *self.own.entry([contact.link.clone(), contact.other.clone()]).or_default() += 1;
        } else {
            self.add_entity(contact.other.clone());
        }
    }

    pub(crate) fn add_entity(&mut self, name: SmolStr) {
        *self.others.entry(name).or_default() += 1;
    }

    /// Most frequent body; the first by name among equals. The robot itself counts as one body, named with
    /// its two links that touch most often.
    pub(crate) fn most(&self) -> Option<SmolStr> {
        self.counted().map(|(name, _)| name)
    }

    /// Reason that no pose is free: the most frequent body and its share of all contacts.
    pub(crate) fn none_free(&self) -> InfeasibleReason {
        let (by, touching) = self.counted().unzip();
        let tried = self.others.values().chain(self.own.values()).sum();
        InfeasibleReason::NoFreePose { by, share: touching.map(|touching| ContactShare { touching, tried }) }
    }

    fn counted(&self) -> Option<(SmolStr, usize)> {
        let own: usize = self.own.values().sum();
        match first_most(&self.others) {
            Some((name, count)) if count >= own => Some((name.clone(), count)),
            _ => first_most(&self.own)
                .map(|([one, other], _)| (format_smolstr!("{ITSELF} (`{one}` and `{other}`)"), own)),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.others.is_empty() && self.own.is_empty()
    }
}

/// Key with the greatest count, the first of equals.
fn first_most<K>(counts: &BTreeMap<K, usize>) -> Option<(&K, usize)> {
    counts.iter().fold(None, |most, (name, count)| match most {
        Some((_, known)) if known >= *count => most,
        Some(_) | None => Some((name, *count)),
    })
}

/// Answer of a search without a path: blocked where a free configuration was found, else not free.
pub(crate) fn exhausted(found: bool, poses: &ContactTally, ways: &ContactTally) -> MotionAnswer {
    let reason = if found { InfeasibleReason::BlockedPath { by: ways.most() } } else { poses.none_free() };
    MotionAnswer::Infeasible(Infeasible::exhausted(reason))
}
