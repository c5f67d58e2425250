//! Stages of a running primitive: what comes next, and to where it drives.

use crate::body::{BasePose, turned};
use crate::command::SimCommand;
use crate::failure::Failure;
use crate::sight::the_one;
use crate::sim::Sim;
use crate::task::{NextStage, Task};
use crate::world::{Role, ViewDirection};
use motet_graph::{Pose, Value};
use motet_runtime::Outcome;
use motet_stdlib::lang::failures;
use smol_str::SmolStr;

/// Greatest distance, and greatest angle, from the robot to the start of a path that it follows: some times
/// the error of a drive.
const PATH_START_M: f64 = 0.08;
const PATH_START_RAD: f64 = 0.1;

/// Least distance in m to a stance for which the base drives again.
const AGAIN_M: f64 = 0.05;

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
            self.refresh(&root, ViewDirection::Ahead);
        }
        let (name, base) = (self.belief.name(to), self.world.base);
        let is_gone = |thing: &crate::world::Thing| thing.lost && thing.role == Role::Person;
        if self.belief.thing(&root).is_some_and(is_gone) {
            return fail(failures::UNREACHABLE, format!("{name} is not where they were believed to be"));
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
        place.map_or_else(
            || fail(failures::UNREACHABLE, format!("{name} has no place to stand at")),
            NextStage::Drive,
        )
    }

    /// Drives to a pose of the base, where there is room for it.
    fn go_to_pose(&mut self, pose: &Pose, step: u32) -> NextStage {
        if step > 0 {
            return NextStage::End(Outcome::Success(None));
        }
        let [x, y, _] = pose.xyz;
        if !self.belief.has_room_at(x, y) {
            return fail(failures::BLOCKED, format!("the base has no room at {x:.2} m, {y:.2} m"));
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
                    let nowhere = || {
                        fail(
                            failures::UNREACHABLE,
                            format!("{} has no place to stand at", self.belief.name(&id)),
                        )
                    };
                    let next = place.map_or_else(nowhere, NextStage::Drive);
                    task.found = Some(id);
                    return next;
                }
                Err(failure) if failure.kind == failures::NOT_FOUND => {}
                Err(failure) => return NextStage::End(failure.outcome()),
            }
        }
        match around.get(step as usize / 2) {
            Some(next) => {
                let nowhere =
                    || fail(failures::UNREACHABLE, format!("there is no {}", self.belief.name(next)));
                self.belief.place_for(next).map_or_else(nowhere, NextStage::Drive)
            }
            None => fail(failures::NOT_FOUND, format!("\"{what}\" is at none of the places")),
        }
    }
}

fn fail(kind: &'static str, text: String) -> NextStage {
    NextStage::End(Failure::new(kind, text).outcome())
}
