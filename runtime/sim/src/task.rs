//! A running primitive: stages of driving and of work, one after the other, and what each comes to.

use crate::body::{BasePose, turned};
use crate::command::SimCommand;
use crate::motion::BaseMotion;
use crate::observation::ViewDirection;
use crate::people::People;
use crate::world::SimWorld;
use motet_graph::{Pose, Value};
use motet_robots::scene::Scene;
use motet_runtime::{FailureReport, GoalId, Outcome, Time};
use smol_str::SmolStr;
use std::sync::Arc;

/// Greatest distance, and greatest angle, from the robot to the start of a path that it follows.
const PATH_START_M: f64 = 0.02;
const PATH_START_RAD: f64 = 0.05;

/// A goal that runs.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Task {
    pub(crate) goal: GoalId,
    pub(crate) command: SimCommand,
    /// Stances along the path that was found for its drive, from its start; empty without one.
    pub(crate) path: Vec<BasePose>,
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

/// World, people and scene, as a task sees them.
pub(crate) struct TaskContext<'s> {
    pub(crate) world: &'s mut SimWorld,
    pub(crate) people: &'s mut People,
    pub(crate) scene: &'s Scene,
}

impl TaskContext<'_> {
    /// Next stage of a task. Called at its start and at the end of each stage.
    pub(crate) fn next(&mut self, task: &mut Task) -> NextStage {
        let step = task.step;
        task.step += 1;
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
            SimCommand::Pick(id) | SimCommand::Grasp(id) if step == 0 => self.shuffle(id),
            SimCommand::Pick(_) | SimCommand::Grasp(_) if step == 1 => NextStage::Work,
            SimCommand::Turn(_) | SimCommand::Pick(_) | SimCommand::Grasp(_) => self.finish(task),
            SimCommand::Home
            | SimCommand::StartPose
            | SimCommand::WakeUp
            | SimCommand::Lift
            | SimCommand::Unknown => self.work(task, step),
            SimCommand::Place(id, on, rules) if step < 2 => match step {
                0 => NextStage::Drive(self.world.stance_for_place(id, on, rules)),
                _ => NextStage::Work,
            },
            SimCommand::Place(..) => self.finish(task),
            SimCommand::Handover(_, _) | SimCommand::Open(_) | SimCommand::Close(_) => self.work(task, step),
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
        let arrived = step > 0 && self.world.stands_at(self.world.root(to));
        if arrived || self.world.holder(to).is_some() {
            self.world.visit(to);
            return NextStage::End(Outcome::Success(None));
        }
        let base = self.world.base;
        // Where the best place does not serve it, no other will.
        let is_further = |place: &BasePose| step == 0 || base.distance_to(place.x, place.y) > 0.01;
        let place = self.world.place_for(to).filter(is_further);
        place.map_or_else(|| fail("unreachable"), NextStage::Drive)
    }

    /// Drives to a pose of the base, where there is room for it.
    fn go_to_pose(&mut self, pose: &Pose, step: u32) -> NextStage {
        if step > 0 {
            return NextStage::End(Outcome::Success(None));
        }
        let [x, y, _] = pose.xyz;
        if !self.world.has_room_at(x, y) {
            return fail("blocked");
        }
        NextStage::Drive(BasePose { x, y, heading: pose.yaw() })
    }

    /// A step along what it stands at, so that the hand reaches.
    fn shuffle(&self, id: &str) -> NextStage {
        self.world.stance_for_hand(id).map_or(NextStage::Drive(self.world.base), NextStage::Drive)
    }

    /// Drives to each place, looks around there, and drives to what it found.
    fn search(&mut self, task: &mut Task, what: &str, around: &[SmolStr], step: u32) -> NextStage {
        if let Some(id) = &task.found {
            if self.world.look_at(id).is_err() {
                return fail("not_found");
            }
            let id = id.clone();
            self.world.visit(&id);
            task.command.leave_arm(self.world);
            return NextStage::End(Outcome::Success(Some(Value::Entity(id))));
        }
        // Even stages drive to the next place, odd ones look around there.
        if step % 2 == 1 {
            return NextStage::Work;
        }
        if step > 0 {
            match SimWorld::the_one(self.world.found(self.scene, what, ViewDirection::Around)) {
                Ok(id) => {
                    self.world.saw(&id);
                    let place = self.world.place_for(&id);
                    task.found = Some(id);
                    return place.map_or_else(|| fail("unreachable"), NextStage::Drive);
                }
                Err("not_found") => {}
                Err(failure) => return fail(failure),
            }
        }
        match around.get(step as usize / 2) {
            Some(next) => self.world.place_for(next).map_or_else(|| fail("unreachable"), NextStage::Drive),
            None => fail("not_found"),
        }
    }

    /// The work is done: what came of it.
    fn finish(&mut self, task: &Task) -> NextStage {
        let world = &mut *self.world;
        let nothing = |()| None;
        let result = match &task.command {
            SimCommand::Pick(id) => world.grasp(id, &task.uses).and_then(|()| world.lift()).map(nothing),
            SimCommand::Grasp(id) => world.grasp(id, &task.uses).map(nothing),
            SimCommand::Lift => world.lift().map(nothing),
            SimCommand::Place(id, on, rules) => world.place(id, on, rules).map(nothing),
            SimCommand::Handover(id, to) => world.hand_over(id, to).map(nothing),
            SimCommand::Open(id) => world.work_door(id, true).map(nothing),
            SimCommand::Close(id) => world.work_door(id, false).map(nothing),
            SimCommand::Push(id) => world.push(id).map(nothing),
            SimCommand::WakeUp => {
                world.standing = true;
                Ok(None)
            }
            SimCommand::Detect(what) => {
                SimWorld::the_one(world.found(self.scene, what, ViewDirection::Ahead)).map(|id| {
                    world.saw(&id);
                    Some(Value::Entity(id))
                })
            }
            SimCommand::DetectAll(what) => {
                let found = world.found(self.scene, what, ViewDirection::Ahead);
                found.iter().for_each(|id| world.saw(id));
                Ok(Some(Value::List(found.into_iter().map(Value::Entity).collect())))
            }
            SimCommand::Locate(id) | SimCommand::Ground(id) => {
                world.look_at(id).map(|thing| Some(Value::Pose(thing.body.pose())))
            }
            SimCommand::Inspect(id) => world.look_at(id).map(|_| None),
            SimCommand::Say(text) => {
                self.people.heard.push((world.now, text.clone()));
                Ok(None)
            }
            SimCommand::Ask(_) => self.people.answer().map(|answer| Some(Value::Text(answer))),
            SimCommand::Choose(among) => {
                self.people.choice(self.scene, among).map(|chosen| Some(Value::Entity(chosen)))
            }
            SimCommand::Home | SimCommand::StartPose | SimCommand::Turn(_) | SimCommand::Unknown => Ok(None),
            SimCommand::Go(_) | SimCommand::GoToPose(_) | SimCommand::Search(_, _) => Ok(None),
        };
        match result {
            Ok(value) => {
                task.command.leave_arm(world);
                NextStage::End(Outcome::Success(value))
            }
            Err(failure) => fail(failure),
        }
    }
}

fn fail(kind: &'static str) -> NextStage {
    NextStage::End(Outcome::Failure(SmolStr::new_static(kind).into()))
}
