//! Ends of a task: cancels, failures and holds, each of which is over when everything stands still.

use super::moving::{is_hand, wrapped};
use super::{Ending, Finish, Move, Phase, Surroundings, Task};
use crate::joint::{Part, Trajectory};
use crate::robot::Robot;
use motet_runtime::Outcome;
use std::time::{Duration, Instant};

/// Time for a server to end a goal after its cancel. Then a trajectory that stands still takes its place.
const HEEDS: Duration = Duration::from_millis(1500);
/// Time between two stops that are sent to a robot that still moves.
const STOPS_AGAIN: Duration = Duration::from_millis(500);
/// Time for standstill before an interrupted goal counts as lost.
const STANDS: Duration = Duration::from_secs(6);

impl Task {
    /// Waits until the servers have ended their goals and everything stands still.
    pub(super) fn advance_stop(&mut self, around: &mut Surroundings<'_>) -> Option<Finish> {
        let parts = self.parts();
        let stopping = self.stopping.as_mut()?;
        let is_still = around.robot.body.is_still(&parts, &around.robot.binding);
        // A server that has not ended its goal could still begin to move: it gets another one before.
        let is_over =
            self.running.is_empty() || (stopping.is_told && stopping.stopped.elapsed() > STOPS_AGAIN);
        if is_still && is_over {
            self.running.clear();
            return Some(match &stopping.ending {
                Ending::Cancel => Finish::Ended(Outcome::Interrupted),
                Ending::Fail(failure) => Finish::Ended(Outcome::Failure(failure.clone())),
                Ending::SafeStop => Finish::Stopped,
            });
        }
        if stopping.since.elapsed() > HEEDS && stopping.stopped.elapsed() > STOPS_AGAIN {
            stopping.stopped = Instant::now();
            if !stopping.is_told {
                stopping.is_told = true;
                let moving = around.robot.body.fastest(&parts).map_or_else(String::new, |(joint, speed)| {
                    format!("; `{joint}` moves with {speed:.3} per second")
                });
                let what = if is_still { "a server has not ended its goal" } else { "the robot moves on" };
                self.feedback
                    .push(format!("{what} after the cancel{moving}; trajectories that stand still are sent"));
            }
            stand_still(around.robot, &self.parts);
        }
        if stopping.since.elapsed() > STANDS && stopping.ending != Ending::SafeStop {
            return Some(Finish::Lost);
        }
        None
    }

    /// Waits for standstill in a hold, and then goes on from where the robot stands.
    pub(super) fn advance_hold(&mut self, around: &mut Surroundings<'_>) {
        if self.held
            || !self.running.is_empty()
            || !around.robot.body.is_still(&self.parts(), &around.robot.binding)
        {
            return;
        }
        self.holding = false;
        self.phase = Phase::Next;
        match self.current.take() {
            Some(Move::Follow(part, names)) => {
                let rest = self.rest(around.robot, &part, &names);
                self.moves.push_front(Move::Follow(rest, names));
            }
            Some(again) => self.moves.push_front(again),
            None => {}
        }
    }

    /// Rest of a path from where the robot stands, which is on one of its legs.
    pub(super) fn rest(&self, robot: &Robot, part: &Part, names: &[String]) -> Part {
        let base = robot.body.base(&robot.binding).ok();
        let here = |at: usize| -> ([f64; 3], Vec<f64>) {
            let (planned, joints) = &part.waypoints[at];
            let base = base
                .filter(|_| part.drives())
                .map_or(*planned, |base| [base.x, base.y, planned[2] + wrapped(base.yaw - planned[2])]);
            let joint = |(at, name): (usize, &String)| {
                robot
                    .body
                    .position(robot.binding.ros_joint(name))
                    .filter(|_| !is_hand(name))
                    .unwrap_or(joints[at])
            };
            (base, names.iter().enumerate().map(joint).collect())
        };
        let gap = |one: &([f64; 3], Vec<f64>), other: &([f64; 3], Vec<f64>)| {
            let base = one.0.iter().zip(other.0).map(|(one, other)| (one - other).powi(2)).sum::<f64>();
            let joints = one.1.iter().zip(&other.1).map(|(one, other)| (one - other).powi(2)).sum::<f64>();
            (base + joints).sqrt()
        };
        // The leg whose ends are together nearest, compared with its length.
        let excess = |leg: &usize| {
            let here = here(*leg);
            let (from, to) = (&part.waypoints[*leg], &part.waypoints[leg + 1]);
            gap(from, &here) + gap(&here, to) - gap(from, to)
        };
        let legs = 0..part.legs.len();
        let leg = legs.min_by(|one, other| excess(one).total_cmp(&excess(other))).unwrap_or(0);
        let mut waypoints = vec![here(leg)];
        waypoints.extend(part.waypoints.iter().skip(leg + 1).cloned());
        Part { waypoints, legs: part.legs.iter().skip(leg).copied().collect() }
    }
}

/// Sends trajectories that stand still to the controllers of some joints, and zero speeds to the base.
pub(crate) fn stand_still(robot: &mut Robot, (joints, drives): &(Vec<String>, bool)) {
    for at in 0..robot.binding.controllers.len() {
        let controller = robot.binding.controllers[at].clone();
        let Some(action) = robot.action_at(&controller.action) else { continue };
        let trajectory = if controller.base.len() == 3 && *drives {
            let names = &robot.binding.frames;
            let base = robot.body.base(&robot.binding);
            let frame = robot.body.frames.look_up(&names.map, &controller.frame, None, names.age_secs);
            let (Ok(base), Ok(frame)) = (base, frame) else { continue };
            let place = frame.planar().seen_from([base.x, base.y, base.yaw]);
            Trajectory::standing(&controller.base, &place)
        } else if controller.joints.iter().any(|joint| joints.contains(joint)) {
            let positions: Option<Vec<f64>> =
                controller.joints.iter().map(|joint| robot.body.position(joint)).collect();
            let Some(positions) = positions else { continue };
            Trajectory::standing(&controller.joints, &positions)
        } else {
            continue;
        };
        if let Err(why) = robot.actions[action].start(&robot.layouts, &trajectory.goal()) {
            robot.tell(&why);
        }
    }
    if *drives {
        robot.send_stops();
    }
}
