//! Trajectories of joints from a certified path.
//!
//! From one waypoint to the next a path accelerates evenly, moves evenly, and brakes evenly. Controllers
//! interpolate between points with positions and velocities by cubic splines. Such a profile consists of
//! these, so four points for each pair of waypoints give the path exactly.

use crate::tf::Planar;
use motet_graph::Witness;
use serde_json::{Value, json};

/// Motion of one controller: positions and velocities of its joints at times in s.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Trajectory {
    pub(crate) joints: Vec<String>,
    pub(crate) points: Vec<Point>,
}

/// Point of a trajectory.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Point {
    /// Seconds from the start.
    pub(crate) at: f64,
    pub(crate) positions: Vec<f64>,
    pub(crate) velocities: Vec<f64>,
}

/// One degree of freedom of a controller.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Axis<'a> {
    /// x, y or yaw of the base: 0, 1 or 2.
    Base(usize),
    /// Joint of the path, by its name in Motet; where the path lacks it, it stays at this position.
    Joint(&'a str, f64),
}

/// Waypoints of a part of a path, with the times between them.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Part {
    /// Pose of the base at each waypoint, with the positions of the joints of the path.
    pub(crate) waypoints: Vec<([f64; 3], Vec<f64>)>,
    /// Duration and ramp in s from each waypoint to the next.
    pub(crate) legs: Vec<[f64; 2]>,
}

impl Part {
    /// The whole path of a witness.
    ///
    /// # Errors
    ///
    /// The waypoint whose numbers make no path.
    pub(crate) fn of(witness: &Witness) -> Result<Self, String> {
        if witness.path.is_empty() {
            return Err("the path has no waypoint".to_owned());
        }
        let mut before = f64::NEG_INFINITY;
        for (number, waypoint) in (1..).zip(&witness.path) {
            let wrong = |what: &str| Err(format!("waypoint {number} of the path {what}"));
            let mut numbers = waypoint.base.iter().chain(&waypoint.joints);
            if waypoint.joints.len() != witness.joints.len() {
                return wrong("has other joints than the path");
            }
            if !numbers.all(|number| number.is_finite()) {
                return wrong("has a position that is no number");
            }
            if !(waypoint.at.is_finite() && waypoint.at >= before) {
                return wrong("comes before the one before it");
            }
            if !(waypoint.ramp.is_finite() && waypoint.ramp >= 0.0) {
                return wrong("has a ramp that is no time");
            }
            before = waypoint.at;
        }
        let waypoints =
            witness.path.iter().map(|waypoint| (waypoint.base, waypoint.joints.clone())).collect();
        let pairs = witness.path.windows(2);
        Ok(Self { waypoints, legs: pairs.map(|pair| [pair[1].at - pair[0].at, pair[1].ramp]).collect() })
    }

    /// The same way from its end to its start.
    #[must_use]
    pub(crate) fn reversed(&self) -> Self {
        let waypoints = self.waypoints.iter().rev().cloned().collect();
        Self { waypoints, legs: self.legs.iter().rev().copied().collect() }
    }

    /// Parts in which only the base moves (`true`) and in which only joints move (`false`), in order. `None`
    /// where both move at once.
    #[must_use]
    pub(crate) fn phases(&self) -> Option<Vec<(bool, Self)>> {
        let mut phases: Vec<(bool, Self)> = Vec::new();
        for (pair, leg) in self.waypoints.windows(2).zip(&self.legs) {
            let drives = moves(&pair[0].0, &pair[1].0);
            if drives && moves(&pair[0].1, &pair[1].1) {
                return None;
            }
            match phases.last_mut() {
                Some((last, part)) if *last == drives => {
                    part.waypoints.push(pair[1].clone());
                    part.legs.push(*leg);
                }
                _ => phases.push((drives, Self { waypoints: pair.to_vec(), legs: vec![*leg] })),
            }
        }
        Some(phases)
    }

    /// Parts between the legs in which nothing but the hand moves, and closes. `hand` has its joints by their
    /// places in a waypoint, with their positions when it is open. A leg that closes it is left out.
    #[must_use]
    pub(crate) fn between_grips(&self, hand: &[(usize, f64)]) -> Vec<Self> {
        let mut parts =
            vec![Self { waypoints: self.waypoints.iter().take(1).cloned().collect(), legs: Vec::new() }];
        for (pair, leg) in self.waypoints.windows(2).zip(&self.legs) {
            let is_hand = |at: &usize| hand.iter().any(|(own, _)| own == at);
            let joints = pair[0].1.iter().zip(&pair[1].1).enumerate();
            let rests =
                joints.filter(|(at, _)| !is_hand(at)).all(|(_, (one, other))| !moves(&[*one], &[*other]));
            let opened = |joints: &[f64]| -> f64 {
                hand.iter().map(|(at, open)| joints.get(*at).map_or(0.0, |is| (is - open).abs())).sum()
            };
            let closes = opened(&pair[1].1) - opened(&pair[0].1) > 1e-6;
            if closes && rests && !moves(&pair[0].0, &pair[1].0) {
                parts.push(Self { waypoints: vec![pair[1].clone()], legs: Vec::new() });
            } else if let Some(part) = parts.last_mut() {
                part.waypoints.push(pair[1].clone());
                part.legs.push(*leg);
            }
        }
        parts
    }

    /// True if the base moves.
    #[must_use]
    pub(crate) fn drives(&self) -> bool {
        self.waypoints.windows(2).any(|pair| moves(&pair[0].0, &pair[1].0))
    }

    /// Seconds from its start to its end.
    #[must_use]
    pub(crate) fn secs(&self) -> f64 {
        self.legs.iter().map(|[secs, _]| secs).sum()
    }

    /// Motion of a controller with the axes `axes`, which it calls `names`; `joints` are those of the path.
    /// The trajectory has poses of the base in the controller's frame, whose pose in the map is `frame`.
    /// `None` if no axis moves.
    #[must_use]
    pub(crate) fn trajectory(
        &self,
        names: &[String],
        axes: &[Axis<'_>],
        joints: &[&str],
        frame: Planar,
    ) -> Option<Trajectory> {
        let positions = |(base, positions): &([f64; 3], Vec<f64>)| -> Vec<f64> {
            let base = frame.seen_from(*base);
            let position = |axis: &Axis<'_>| match axis {
                Axis::Base(at) => base[*at],
                Axis::Joint(name, stays) => {
                    let at = joints.iter().position(|joint| joint == name);
                    at.and_then(|at| positions.get(at).copied()).unwrap_or(*stays)
                }
            };
            axes.iter().map(position).collect()
        };
        let places: Vec<Vec<f64>> = self.waypoints.iter().map(positions).collect();
        if !places.windows(2).any(|pair| moves(&pair[0], &pair[1])) {
            return None;
        }
        let still = vec![0.0; axes.len()];
        let mut points = vec![Point { at: 0.0, positions: places[0].clone(), velocities: still.clone() }];
        let mut start = 0.0;
        for (pair, [secs, ramp]) in places.windows(2).zip(&self.legs) {
            let ramp = ramp.clamp(0.0, secs / 2.0);
            let speed = if *secs > ramp { 1.0 / (secs - ramp) } else { 0.0 };
            let along = |share: f64| -> Vec<f64> {
                pair[0].iter().zip(&pair[1]).map(|(from, to)| from + share * (to - from)).collect()
            };
            let velocities: Vec<f64> =
                pair[0].iter().zip(&pair[1]).map(|(from, to)| speed * (to - from)).collect();
            if ramp > 0.0 {
                let gone = speed * ramp / 2.0;
                points.push(Point {
                    at: start + ramp,
                    positions: along(gone),
                    velocities: velocities.clone(),
                });
                if secs - 2.0 * ramp > 1e-6 {
                    points.push(Point { at: start + secs - ramp, positions: along(1.0 - gone), velocities });
                }
            }
            start += secs;
            points.push(Point { at: start, positions: pair[1].clone(), velocities: still.clone() });
        }
        // The times of a controller grow: of two points at one time the later one counts.
        points.dedup_by(|next, before| {
            let is_same = next.at - before.at < 1e-9;
            if is_same {
                *before = next.clone();
            }
            is_same
        });
        Some(Trajectory { joints: names.to_vec(), points })
    }
}

/// True where two configurations differ.
fn moves(one: &[f64], other: &[f64]) -> bool {
    one.iter().zip(other).any(|(one, other)| (one - other).abs() > 1e-9)
}

impl Trajectory {
    /// Goal of `control_msgs/FollowJointTrajectory`.
    #[must_use]
    pub(crate) fn goal(&self) -> Value {
        let point = |point: &Point| {
            json!({"positions": point.positions, "velocities": point.velocities,
                "time_from_start": duration(point.at)})
        };
        let points: Vec<Value> = self.points.iter().map(point).collect();
        json!({"trajectory": {"joint_names": self.joints, "points": points}})
    }

    /// Trajectory that keeps joints where they are.
    #[must_use]
    pub(crate) fn standing(joints: &[String], positions: &[f64]) -> Self {
        let point = |at| Point { at, positions: positions.to_vec(), velocities: vec![0.0; positions.len()] };
        Self { joints: joints.to_vec(), points: vec![point(0.1)] }
    }
}

/// Seconds as `builtin_interfaces/Duration`.
#[must_use]
pub(crate) fn duration(secs: f64) -> Value {
    #[allow(clippy::cast_possible_truncation, reason = "times of a path are bounded")]
    let nanos = (secs.clamp(0.0, 1e6) * 1e9).round() as i64;
    json!({"sec": nanos / 1_000_000_000, "nanosec": nanos % 1_000_000_000})
}

#[cfg(test)]
mod tests {
    use super::*;
    use motet_graph::Waypoint;

    fn witness() -> Witness {
        let waypoint =
            |base, joints: [f64; 2], at, ramp| Waypoint { base, joints: joints.to_vec(), at, ramp };
        Witness {
            joints: vec!["lift".into(), "wrist".into()],
            path: vec![
                waypoint([0.0; 3], [0.0, 0.1], 0.0, 0.0),
                waypoint([0.0; 3], [0.4, -1.2], 3.0, 0.5),
                waypoint([1.0, 0.5, 0.3], [0.4, -1.2], 7.0, 2.0),
            ],
            grasp: None,
            clearance: 0.1,
            keeps: motet_graph::Clearance::default(),
            limit: None,
            payload: None,
        }
    }

    #[test]
    fn part_ends_where_the_hand_alone_closes() {
        let place = |x: f64, hand: f64| ([x, 0.0, 0.0], vec![0.3, hand]);
        let waypoints =
            vec![place(0.0, 0.0), place(0.5, 1.2), place(0.6, 1.2), place(0.6, 0.2), place(0.1, 0.2)];
        let part = Part { waypoints, legs: vec![[1.0, 0.1], [2.0, 0.2], [3.0, 0.3], [4.0, 0.4]] };
        let parts = part.between_grips(&[(1, 1.24)]);
        let legs: Vec<_> = parts.iter().map(|part| part.legs.clone()).collect();
        assert_eq!(legs, [vec![[1.0, 0.1], [2.0, 0.2]], vec![[4.0, 0.4]]]);
        assert_eq!(parts[1].waypoints, [place(0.6, 0.2), place(0.1, 0.2)]);
        // On the way back it opens there, and closes while the base moves.
        assert_eq!(part.reversed().between_grips(&[(1, 1.24)]).len(), 1);
        assert_eq!(part.between_grips(&[]), [part]);
    }

    /// Positions at a time by cubic splines, as controllers have them.
    fn at(trajectory: &Trajectory, time: f64) -> Vec<f64> {
        let after = trajectory
            .points
            .iter()
            .position(|point| point.at >= time)
            .unwrap_or(trajectory.points.len() - 1);
        let (from, to) = (&trajectory.points[after.saturating_sub(1)], &trajectory.points[after]);
        let span = to.at - from.at;
        if span <= 0.0 {
            return to.positions.clone();
        }
        let t = ((time - from.at) / span).clamp(0.0, 1.0);
        let (t2, t3) = (t * t, t * t * t);
        let weights =
            [2.0 * t3 - 3.0 * t2 + 1.0, (t3 - 2.0 * t2 + t) * span, 3.0 * t2 - 2.0 * t3, (t3 - t2) * span];
        let axis = |at: usize| {
            weights[0] * from.positions[at]
                + weights[1] * from.velocities[at]
                + weights[2] * to.positions[at]
                + weights[3] * to.velocities[at]
        };
        (0..from.positions.len()).map(axis).collect()
    }

    /// Share of a leg of 3 s with ramps of 0.5 s that is done at a time.
    fn done(t: f64) -> f64 {
        let speed = 1.0 / 2.5;
        if t < 0.5 {
            speed * t * t
        } else if t < 2.5 {
            speed * (t - 0.25)
        } else {
            1.0 - speed * (3.0 - t) * (3.0 - t)
        }
    }

    #[test]
    fn splines_through_the_points_are_the_path() {
        let part = Part::of(&witness()).unwrap();
        let axes = [Axis::Joint("lift", 9.0), Axis::Joint("wrist", 9.0), Axis::Joint("head", 0.7)];
        let names = ["l", "w", "h"].map(str::to_owned);
        let trajectory = part.trajectory(&names, &axes, &["lift", "wrist"], Planar::default()).unwrap();
        for step in 0..=300 {
            let time = f64::from(step) / 100.0;
            let is = at(&trajectory, time);
            let expected = [0.4 * done(time), 0.1 - 1.3 * done(time), 0.7];
            assert!(
                is.iter().zip(expected).all(|(is, wanted)| (is - wanted).abs() < 1e-12),
                "{time}: {is:?}"
            );
        }
        assert!(trajectory.points.windows(2).all(|pair| pair[0].at < pair[1].at));
        assert_eq!(trajectory.points.last().unwrap().positions, [0.4, -1.2, 0.7]);
    }

    #[test]
    fn path_that_is_none_is_refused() {
        let wrong = |change: &dyn Fn(&mut Witness)| {
            let mut changed = witness();
            change(&mut changed);
            Part::of(&changed).unwrap_err()
        };
        assert_eq!(wrong(&|one| one.path.clear()), "the path has no waypoint");
        let short = wrong(&|one| one.path[1].joints.truncate(1));
        assert_eq!(short, "waypoint 2 of the path has other joints than the path");
        assert_eq!(
            wrong(&|one| one.path[2].at = 1.0),
            "waypoint 3 of the path comes before the one before it"
        );
        assert_eq!(
            wrong(&|one| one.path[1].ramp = -0.5),
            "waypoint 2 of the path has a ramp that is no time"
        );
        let none = wrong(&|one| one.path[0].base[2] = f64::NAN);
        assert_eq!(none, "waypoint 1 of the path has a position that is no number");
    }

    #[test]
    fn path_is_split_where_base_and_joints_take_turns() {
        let part = Part::of(&witness()).unwrap();
        let phases = part.phases().unwrap();
        assert_eq!(phases.iter().map(|(drives, _)| *drives).collect::<Vec<_>>(), [false, true]);
        let head = [Axis::Joint("head", 0.7)];
        assert_eq!(part.trajectory(&["h".to_owned()], &head, &["lift", "wrist"], Planar::default()), None);
        let mut both = witness();
        both.path[2].joints[0] = 0.0;
        assert_eq!(Part::of(&both).unwrap().phases(), None);
    }

    #[test]
    fn base_is_given_in_the_frame_of_its_controller() {
        let odom = Planar { x: 1.0, y: 0.0, yaw: std::f64::consts::FRAC_PI_2 };
        let axes = [Axis::Base(0), Axis::Base(1), Axis::Base(2)];
        let names = ["x", "y", "t"].map(str::to_owned);
        let trajectory = Part::of(&witness()).unwrap().trajectory(&names, &axes, &[], odom).unwrap();
        let end = &trajectory.points.last().unwrap().positions;
        let expected = [0.5, 0.0, 0.3 - std::f64::consts::FRAC_PI_2];
        assert!(end.iter().zip(expected).all(|(is, wanted)| (is - wanted).abs() < 1e-12), "{end:?}");
    }
}
