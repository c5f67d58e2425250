//! Time parametrisation: the times at which a robot passes the configurations of a path, within the speeds
//! and accelerations of its card and its URDF.
//!
//! On each edge the base and all joints move together along the straight line that was checked, from rest to
//! rest: they accelerate evenly, move evenly, and brake evenly (a trapezoidal profile). The slowest of them
//! decides the time of the edge. A path is not left, because no edge is blended into the next.

use nalgebra::Isometry3;

use super::{Configuration, RobotModel};

/// Greatest speeds of joints whose URDF gives none, in rad/s and m/s.
const DEFAULT_SPEED: [f64; 2] = [1.0, 0.25];
/// Seconds within which a joint reaches its greatest speed, where its card gives no acceleration.
const JOINT_RAMP: f64 = 0.5;
/// Greatest accelerations of a hand that holds something, in m/s² and rad/s²: in physics, what is held at a
/// slant slips at the full speed of an arm.
const LOADED: [f64; 2] = [1.0, 3.0];
/// Least speed and acceleration of an edge in parts per second, which keeps every time finite.
const SLOWEST: f64 = 1e-9;
/// Times are rounded up to this many parts of a second.
const TICKS: f64 = 1e6;

/// Greatest speed and acceleration of one variable, in its unit per second and per second squared.
type Limit = [f64; 2];

/// Greatest speeds and accelerations of a robot.
#[derive(Clone, PartialEq, Debug)]
pub struct MotionLimits {
    /// Limit of the base along the floor, in m.
    drive: Limit,
    /// Limit of the yaw of the base, in rad.
    turn: Limit,
    /// Limits of the degrees of freedom, in the order of a configuration.
    joints: Vec<Limit>,
}

/// Parts of the greatest speed and acceleration that a motion uses, above 0 and at most 1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SpeedShare {
    pub speed: f64,
    pub acceleration: f64,
}

impl SpeedShare {
    /// All of the speed and of the acceleration.
    pub const FULL: Self = Self { speed: 1.0, acceleration: 1.0 };
}

/// Time at which a path reaches a configuration, and the shape of the motion to it.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct PathTime {
    /// Seconds since the start of the path.
    pub at: f64,
    /// Seconds of even acceleration after the configuration before, and of even braking before this one.
    pub ramp: f64,
}

impl MotionLimits {
    /// Limits of a robot: of its base from the card, of its joints from URDF and card.
    #[must_use]
    pub fn of(model: &RobotModel) -> Self {
        let base = &model.card().base;
        let given = model.card().model.as_ref().map(|model| &model.accelerations);
        let joints = model.tree().dofs().iter().map(|dof| {
            let [angle, length] = DEFAULT_SPEED;
            let speed = dof.speed.unwrap_or(if dof.is_prismatic { length } else { angle });
            let acceleration = given.and_then(|given| given.get(&dof.name)).copied();
            [speed, acceleration.unwrap_or(speed / JOINT_RAMP)]
        });
        Self {
            drive: [base.speed_m_per_s, base.acceleration_m_per_s2],
            turn: [base.turn_rad_per_s, base.turn_acceleration_rad_per_s2],
            joints: joints.collect(),
        }
    }

    /// Time at each configuration of a path, 0 at the first. O(path · degrees of freedom).
    #[must_use]
    pub fn times(&self, path: &[Configuration], share: SpeedShare) -> Vec<PathTime> {
        self.times_with_load(path, share, None)
    }

    /// The same with something in the hand of a model: the hand accelerates no more than 1 m/s² and
    /// 3 rad/s², so that what its fingers hold by friction does not slip.
    #[must_use]
    pub fn times_with_load(
        &self,
        path: &[Configuration],
        share: SpeedShare,
        model: Option<&RobotModel>,
    ) -> Vec<PathTime> {
        let mut now = 0.0;
        let edges = path.windows(2).map(|edge| {
            let [from, to] = edge else { return PathTime::default() };
            let [cruise, ramp] = self.edge(from, to, share);
            let factor = model.map_or(1.0, |model| slowed(model, [from, to], cruise * ramp));
            let slow = |secs: f64| if factor > 1.0 { round_up(secs * factor) } else { secs };
            let [cruise, ramp] = [slow(cruise), slow(ramp)];
            now += cruise + ramp;
            PathTime { at: now, ramp }
        });
        let mut times = Vec::with_capacity(path.len());
        times.extend(path.first().map(|_| PathTime::default()));
        times.extend(edges);
        times
    }

    /// Seconds at the greatest speed of an edge, counting each ramp half, and seconds of a ramp.
    fn edge(&self, from: &Configuration, to: &Configuration, share: SpeedShare) -> [f64; 2] {
        let ([x, y, yaw], [to_x, to_y, to_yaw]) = (from.base, to.base);
        let base = [((to_x - x).hypot(to_y - y), self.drive), ((to_yaw - yaw).abs(), self.turn)];
        let joints = from.joints.iter().zip(&to.joints).zip(&self.joints);
        let joints = joints.map(|((from, to), limit)| ((to - from).abs(), *limit));
        // Speed and acceleration of the part of the edge that is done: those that no variable exceeds.
        let (mut speed, mut acceleration) = (f64::INFINITY, f64::INFINITY);
        for (far, [fastest, strongest]) in base.into_iter().chain(joints) {
            if far > 0.0 {
                speed = speed.min(fastest * share.speed / far);
                acceleration = acceleration.min(strongest * share.acceleration / far);
            }
        }
        if speed.is_infinite() {
            return [0.0, 0.0];
        }
        let (speed, acceleration) = (speed.max(SLOWEST), acceleration.max(SLOWEST));
        let cruise = round_up((1.0 / speed).max(1.0 / acceleration.sqrt()));
        let ramp = round_up(1.0 / (acceleration * cruise)).min(cruise);
        [cruise, ramp]
    }
}

/// Factor of the time of an edge at which the hand accelerates no more than with a load. The edge has an
/// acceleration of 1 / `accelerates` parts per second squared.
fn slowed(model: &RobotModel, [from, to]: [&Configuration; 2], accelerates: f64) -> f64 {
    let Some(hand) = model.hand().filter(|_| accelerates > 0.0) else { return 1.0 };
    let tip = |share| model.map_from_links(&from.towards(to, share)).get(hand.tip).copied();
    let tips: Vec<_> = (0..=4).filter_map(|step| tip(f64::from(step) / 4.0)).collect();
    let ways = tips.windows(2).filter_map(|pair| Some(pair.first()?.inverse() * pair.last()?));
    let add = |[far, turn]: [f64; 2], way: Isometry3<f64>| {
        [far + way.translation.vector.norm(), turn + way.rotation.angle()]
    };
    let [far, turn] = ways.fold([0.0; 2], add);
    ((far / LOADED[0]).max(turn / LOADED[1]) / accelerates).sqrt().max(1.0)
}

fn round_up(secs: f64) -> f64 {
    (secs * TICKS).ceil() / TICKS
}
