//! Ends of a task: cancels, failures and holds, each of which is over when everything stands still.

use super::moving::{is_hand, turn_to, wrapped};
use super::{Ending, Finish, Move, Phase, Surroundings, Task};
use crate::action::Uuid;
use crate::bind::Controller;
use crate::joint::{Part, Trajectory};
use crate::robot::Robot;
use crate::state::Parts;
use motet_runtime::Outcome;
use std::time::{Duration, Instant};

/// Time for a server to end a goal after its cancel. Then a trajectory that stands still takes its place.
const HEEDS: Duration = Duration::from_millis(1500);
/// Time between two stops that are sent to a robot that still moves.
const STOPS_AGAIN: Duration = Duration::from_millis(500);
/// Time for a trajectory that stands still to take the place of another one.
const REPLACES: Duration = Duration::from_millis(400);
/// Time for standstill before an interrupted goal counts as lost.
const STANDS: Duration = Duration::from_secs(6);

impl Task {
    /// Waits until no server carries out a goal and everything stands still, and then ends, or goes on after
    /// a hold.
    pub(super) fn advance_stop(&mut self, around: &mut Surroundings<'_>) -> Option<Finish> {
        // Of a safe stop people believe that the robot stands, whatever this goal moved of it.
        let is_still = match self.stopping.as_ref()?.ending {
            Ending::SafeStop => around.robot.is_still(),
            Ending::Hold | Ending::Cancel | Ending::Fail(_) => {
                around.robot.body.is_still(&self.parts, &around.robot.binding)
            }
        };
        let is_over = self.is_over_everywhere(around);
        let stopping = self.stopping.as_mut()?;
        if is_still && is_over {
            let finish = match &stopping.ending {
                Ending::Hold => {
                    // If it moves again, it gets its time anew.
                    stopping.since = Instant::now();
                    if !self.held {
                        self.give_up(around);
                        self.go_on(around);
                    }
                    return None;
                }
                Ending::Cancel => Finish::Ended(Outcome::Interrupted),
                Ending::Fail(failure) => Finish::Ended(Outcome::Failure(failure.clone())),
                Ending::SafeStop => Finish::Stopped,
            };
            self.give_up(around);
            return Some(finish);
        }
        if stopping.since.elapsed() > HEEDS && stopping.stopped.elapsed() > STOPS_AGAIN {
            stopping.stopped = Instant::now();
            if !stopping.is_told {
                stopping.is_told = true;
                let fastest = around.robot.body.fastest(&self.parts);
                let moving = fastest.map_or_else(String::new, |(joint, speed)| {
                    format!("; `{joint}` moves with {speed:.3} per second")
                });
                let what = if is_still { "a server has not ended its goal" } else { "the robot moves on" };
                self.feedback
                    .push(format!("{what} after the cancel{moving}; trajectories that stand still are sent"));
            }
            stopping.replaced = stand_still(around.robot, &self.parts);
        }
        if stopping.since.elapsed() > STANDS && stopping.ending != Ending::SafeStop {
            self.give_up(around);
            return Some(Finish::Lost);
        }
        None
    }

    /// True if no server carries out a goal of the task any more. A server that has not ended its goal could
    /// still begin to move: it has, if another one took its place. A navigation or a call has to say so.
    fn is_over_everywhere(&self, around: &Surroundings<'_>) -> bool {
        let Some(stopping) = &self.stopping else { return true };
        let is_replaced = |action: usize| {
            stopping.replaced.contains(&action)
                && stopping.stopped.elapsed() > REPLACES
                && around.robot.missing(action).is_empty()
        };
        let is_settled = |(action, id): &(usize, Uuid)| {
            is_replaced(*action)
                || !around.robot.missing(*action).is_empty()
                || around.robot.actions[*action].is_settled(*id)
        };
        self.running.iter().all(|running| is_replaced(running.action)) && self.lost.iter().all(is_settled)
    }

    /// Waits no more for the goals that have not ended.
    fn give_up(&mut self, around: &mut Surroundings<'_>) {
        for running in self.running.drain(..) {
            around.robot.actions[running.action].give_up(&around.robot.layouts, running.id);
        }
        self.lost.clear();
    }

    /// Goes on after a hold from where the robot stands.
    fn go_on(&mut self, around: &mut Surroundings<'_>) {
        (self.stopping, self.phase) = (None, Phase::Next);
        match self.current.take() {
            Some(Move::Follow(part, names)) => match self.rest(around.robot, &part, &names) {
                Ok(rest) => self.moves.push_front(Move::Follow(rest, names)),
                Err(away) => self.plan_anew(around, away),
            },
            Some(again) => self.moves.push_front(again),
            // The step, such as one of the hand, begins again.
            None => {}
        }
    }

    /// Rest of a path from where the robot stands.
    ///
    /// # Errors
    ///
    /// The robot is beside all legs of the path.
    fn rest(&self, robot: &Robot, part: &Part, names: &[String]) -> Result<Part, String> {
        let base = robot.body.base(&robot.binding).ok().filter(|_| part.drives());
        let here = |at: usize| -> ([f64; 3], Vec<f64>) {
            let (planned, joints) = &part.waypoints[at];
            let base =
                base.map_or(*planned, |base| [base.x, base.y, planned[2] + wrapped(base.yaw - planned[2])]);
            let joint = |(at, name): (usize, &String)| {
                robot
                    .body
                    .position(robot.binding.ros_joint(name))
                    .filter(|_| !is_hand(name))
                    .unwrap_or(joints[at])
            };
            (base, names.iter().enumerate().map(joint).collect())
        };
        // How far the robot is from the nearest place of a leg, as a multiple of what the binding allows.
        let limits = robot.binding.start;
        let excess = |leg: usize| {
            let flat = |(base, joints): &([f64; 3], Vec<f64>)| -> Vec<f64> {
                let base = [base[0] / limits.base, base[1] / limits.base, base[2] / limits.turn];
                base.into_iter().chain(joints.iter().map(|joint| joint / limits.joints)).collect()
            };
            let ends = [flat(&part.waypoints[leg]), flat(&part.waypoints[leg + 1])];
            beside(&flat(&here(leg)), &ends)
        };
        let legs = (0..part.legs.len()).map(|leg| (leg, excess(leg)));
        let (leg, excess) =
            legs.min_by(|one, other| one.1.total_cmp(&other.1)).ok_or("the path has no leg")?;
        if excess > 1.0 {
            return Err("the robot was held beside its path".to_owned());
        }
        let mut waypoints = vec![here(leg)];
        waypoints.extend(part.waypoints.iter().skip(leg + 1).cloned());
        Ok(Part { waypoints, legs: part.legs.iter().skip(leg).copied().collect() })
    }
}

/// Greatest difference of a coordinate from the nearest place of a leg.
fn beside(here: &[f64], [from, to]: &[Vec<f64>; 2]) -> f64 {
    let along: Vec<f64> = from.iter().zip(to).map(|(from, to)| to - from).collect();
    let square: f64 = along.iter().map(|part| part * part).sum();
    let dot: f64 =
        along.iter().zip(here.iter().zip(from)).map(|(along, (is, from))| along * (is - from)).sum();
    let share = if square > 0.0 { (dot / square).clamp(0.0, 1.0) } else { 0.0 };
    let differences = here.iter().zip(from.iter().zip(&along));
    differences.map(|(is, (from, along))| (is - from - share * along).abs()).fold(0.0, f64::max)
}

/// Sends trajectories that stand still to the controllers of some parts, and zero speeds to the base. Answers
/// the actions whose goals they replace.
pub(crate) fn stand_still(robot: &mut Robot, parts: &Parts) -> Vec<usize> {
    let mut replaced = Vec::new();
    for at in 0..robot.binding.controllers.len() {
        let controller = robot.binding.controllers[at].clone();
        let Some(action) = robot.action_at(&controller.action) else { continue };
        let Some(trajectory) = standing(robot, &controller, parts) else { continue };
        match robot.actions[action].start(&robot.layouts, &trajectory.goal()) {
            Ok(_) => replaced.push(action),
            Err(why) => robot.tell(&why),
        }
    }
    if parts.drives || parts.all {
        robot.send_stops();
    }
    replaced
}

/// Trajectory of a controller that stands still; `None` if it moves none of the parts, or where it is
/// unknown.
fn standing(robot: &Robot, controller: &Controller, parts: &Parts) -> Option<Trajectory> {
    if controller.base.is_empty() {
        let is_asked = parts.all || controller.joints.iter().any(|joint| parts.joints.contains(joint));
        let joints = controller.joints.iter().filter(|_| is_asked);
        let positions: Option<Vec<f64>> = joints.map(|joint| robot.body.position(joint)).collect();
        return positions
            .filter(|positions| !positions.is_empty())
            .map(|positions| Trajectory::standing(&controller.joints, &positions));
    }
    if !parts.drives && !parts.all {
        return None;
    }
    let names = &robot.binding.frames;
    let base = robot.body.base(&robot.binding).ok()?;
    let frame = robot.body.frames.look_up(&names.map, &controller.frame, None, names.age_secs).ok()?;
    let place = frame.planar().seen_from([base.x, base.y, base.yaw]);
    let mut trajectory = Trajectory::standing(&controller.base, &place);
    turn_to(robot, controller, &mut trajectory);
    Some(trajectory)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robot_beside_its_path_is_told() {
        let leg = [vec![0.0, 0.0], vec![2.0, 0.0]];
        assert!(beside(&[1.0, 0.0], &leg) < 1e-12);
        assert!((beside(&[1.0, 0.5], &leg) - 0.5).abs() < 1e-12);
        assert!((beside(&[3.0, 0.0], &leg) - 1.0).abs() < 1e-12);
        assert!((beside(&[0.25, 0.0], &[vec![0.0, 0.0], vec![0.0, 0.0]]) - 0.25).abs() < 1e-12);
    }
}
