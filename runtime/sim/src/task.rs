//! A running primitive: stages of driving and of work, one after the other, and what each comes to.

use crate::body::{BasePose, turned};
use crate::command::SimCommand;
use crate::failure::Failure;
use crate::motion::BaseMotion;
use crate::sight::{ViewDirection, the_one};
use crate::sim::Sim;
use crate::world::Role;
use motet_graph::{Pose, Value};
use motet_runtime::{FailureReport, GoalId, Outcome, Time};
use smol_str::SmolStr;
use std::sync::Arc;

/// Greatest distance, and greatest angle, from the robot to the start of a path that it follows: some times
/// the error of a drive.
const PATH_START_M: f64 = 0.08;
const PATH_START_RAD: f64 = 0.1;

/// Least distance in m to a stance for which the base drives again.
const AGAIN_M: f64 = 0.05;

/// A goal that runs.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Task {
    pub(crate) goal: GoalId,
    pub(crate) command: SimCommand,
    /// Stances along the path that was found for its drive, from its start; empty without one.
    pub(crate) path: Vec<BasePose>,
    /// Number of its call in the run.
    pub(crate) occasion: u64,
    pub(crate) uses: Arc<[SmolStr]>,
    /// Seconds that its work takes, driving aside.
    pub(crate) work_secs: f64,
    /// Factor on all durations.
    pub(crate) slower: f64,
    /// Factor of the manner on the time of a drive; the time of the work follows the deadline.
    pub(crate) stretch: f64,
    /// Ends in this failure, whatever else.
    pub(crate) fails: Option<FailureReport>,
    pub(crate) stage: TaskStage,
    /// Stages that are over.
    pub(crate) step: u32,
    /// Result of `search` so far.
    pub(crate) found: Option<SmolStr>,
}

/// Stage of a running task.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum TaskStage {
    /// The base moves, which ends then.
    Driving(Time),
    /// Everything else, which ends then.
    Working(Time),
    /// It keeps still; what was left of the motion.
    HeldDriving(BaseMotion),
    /// It keeps still; what was left of the work.
    HeldWorking(Time),
}

impl TaskStage {
    /// Time at which something happens.
    pub(crate) const fn due(&self) -> Time {
        match self {
            Self::Driving(at) | Self::Working(at) => *at,
            Self::HeldDriving(_) | Self::HeldWorking(_) => Time::NEVER,
        }
    }
}

/// Next stage of a task.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum NextStage {
    Drive(BasePose),
    /// Drives through stances one after the other.
    Follow(Vec<BasePose>),
    Turn(f64),
    Work,
    End(Outcome),
}

impl Sim {
    /// Next stage of a task. Called at its start and at the end of each stage.
    pub(crate) fn next_stage(&mut self, task: &mut Task) -> NextStage {
        let step = task.step;
        task.step += 1;
        self.occasion = task.occasion;
        if let Some(failure) = &task.fails {
            return if step == 0 {
                NextStage::Work
            } else {
                NextStage::End(Outcome::Failure(failure.clone()))
            };
        }
        if let Some(path) = self.path_from_here(&mut task.path) {
            return NextStage::Follow(path);
        }
        match &task.command {
            SimCommand::Go(to) => self.go(to, step),
            SimCommand::GoToPose(pose) => self.go_to_pose(pose, step),
            SimCommand::Search(what, around) => {
                let (what, around) = (what.clone(), around.clone());
                self.search(task, &what, &around, step)
            }
            SimCommand::Turn(by) if step == 0 => NextStage::Turn(*by),
            SimCommand::Pick(id) | SimCommand::Grasp(id, _) if step == 0 => self.shuffle(id),
            SimCommand::Pick(_) | SimCommand::Grasp(..) if step == 1 => NextStage::Work,
            SimCommand::Turn(_) | SimCommand::Pick(_) | SimCommand::Grasp(..) => self.finish(task),
            SimCommand::Home
            | SimCommand::StartPose
            | SimCommand::WakeUp
            | SimCommand::Lift
            | SimCommand::Unknown => self.work(task, step),
            SimCommand::Place(id, on, rules) if step < 2 => match step {
                0 => NextStage::Drive(self.belief.stance_for_place(id, on, rules)),
                _ => NextStage::Work,
            },
            SimCommand::Place(..) => self.finish(task),
            SimCommand::Open(id) | SimCommand::Close(id) if step < 2 => match step {
                0 => NextStage::Drive(self.belief.stance_for_door(id)),
                _ => NextStage::Work,
            },
            SimCommand::Open(_) | SimCommand::Close(_) => self.finish(task),
            SimCommand::Handover(_, _) => self.work(task, step),
            SimCommand::Push(_)
            | SimCommand::Detect(_)
            | SimCommand::DetectAll(_)
            | SimCommand::Locate(_) => self.work(task, step),
            SimCommand::Ground(_) | SimCommand::Inspect(_) => self.work(task, step),
            SimCommand::Say(_) | SimCommand::Ask(_) | SimCommand::Choose(_) => self.work(task, step),
        }
    }

    fn work(&mut self, task: &Task, step: u32) -> NextStage {
        if step == 0 { NextStage::Work } else { self.finish(task) }
    }

    /// The path of a task, once, if it begins where the robot stands.
    fn path_from_here(&self, path: &mut Vec<BasePose>) -> Option<Vec<BasePose>> {
        let (path, base) = (std::mem::take(path), self.world.base);
        let first = path.first()?;
        let is_here = base.distance_to(first.x, first.y) < PATH_START_M
            && turned(base.heading - first.heading).abs() < PATH_START_RAD;
        is_here.then_some(path)
    }

    /// Drives until it stands at the target, which may walk away meanwhile.
    fn go(&mut self, to: &str, step: u32) -> NextStage {
        let root = self.belief.root(to).to_owned();
        if step > 0 {
            self.refresh(&root);
        }
        let (name, base) = (self.belief.name(to), self.world.base);
        let is_gone = |thing: &crate::world::Thing| thing.lost && thing.role == Role::Person;
        if self.belief.thing(&root).is_some_and(is_gone) {
            return fail("unreachable", format!("{name} is not where they were believed to be"));
        }
        let arrived = step > 0 && self.belief.stands_at(&root);
        if arrived || self.world.holder(to).is_some() {
            self.world.visit(to);
            self.belief.visit(to);
            return NextStage::End(Outcome::Success(None));
        }
        // Where the best place does not serve it, no other will.
        let is_further = |place: &BasePose| step == 0 || base.distance_to(place.x, place.y) > AGAIN_M;
        let place = self.belief.place_for(to).filter(is_further);
        place
            .map_or_else(|| fail("unreachable", format!("{name} has no place to stand at")), NextStage::Drive)
    }

    /// Drives to a pose of the base, where there is room for it.
    fn go_to_pose(&mut self, pose: &Pose, step: u32) -> NextStage {
        if step > 0 {
            return NextStage::End(Outcome::Success(None));
        }
        let [x, y, _] = pose.xyz;
        if !self.belief.has_room_at(x, y) {
            return fail("blocked", format!("the base has no room at {x:.2} m, {y:.2} m"));
        }
        NextStage::Drive(BasePose { x, y, heading: pose.yaw() })
    }

    /// A step along what it stands at, so that the hand reaches.
    fn shuffle(&self, id: &str) -> NextStage {
        NextStage::Drive(self.belief.stance_for_hand(id).unwrap_or(self.world.base))
    }

    /// Drives to each place, looks around there, and drives to what it found.
    fn search(&mut self, task: &mut Task, what: &str, around: &[SmolStr], step: u32) -> NextStage {
        if let Some(id) = &task.found {
            let id = id.clone();
            if let Err(failure) = self.look_at(&id) {
                return NextStage::End(failure.outcome());
            }
            self.world.visit(&id);
            self.belief.visit(&id);
            task.command.leave_arm(&mut self.world);
            return NextStage::End(Outcome::Success(Some(Value::Entity(id))));
        }
        // Even stages drive to the next place, odd ones look around there.
        if step % 2 == 1 {
            return NextStage::Work;
        }
        if step > 0 {
            self.occasion = task.occasion.wrapping_add(u64::from(step) << 32);
            match the_one(self.found(what, ViewDirection::Around), what) {
                Ok(id) => {
                    let place = self.belief.place_for(&id);
                    let nowhere =
                        || fail("unreachable", format!("{} has no place to stand at", self.belief.name(&id)));
                    let next = place.map_or_else(nowhere, NextStage::Drive);
                    task.found = Some(id);
                    return next;
                }
                Err(Failure { kind: "not_found", .. }) => {}
                Err(failure) => return NextStage::End(failure.outcome()),
            }
        }
        match around.get(step as usize / 2) {
            Some(next) => {
                let nowhere = || fail("unreachable", format!("there is no {}", self.belief.name(next)));
                self.belief.place_for(next).map_or_else(nowhere, NextStage::Drive)
            }
            None => fail("not_found", format!("\"{what}\" is at none of the places")),
        }
    }
}

fn fail(kind: &'static str, text: String) -> NextStage {
    NextStage::End(Failure::new(kind, text).outcome())
}
