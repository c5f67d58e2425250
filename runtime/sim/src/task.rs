//! A running primitive: stages of driving and of work, one after the other, and what each comes to.

use crate::body::Stance;
use crate::deed::Deed;
use crate::motion::Motion;
use crate::people::People;
use crate::perception::Look;
use crate::world::World;
use motet_graph::Value;
use motet_robots::scene::Scene;
use motet_runtime::{GoalId, Outcome, Time};
use smol_str::SmolStr;
use std::sync::Arc;

/// A goal that runs.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Task {
    pub(crate) goal: GoalId,
    pub(crate) deed: Deed,
    pub(crate) uses: Arc<[SmolStr]>,
    /// Seconds that its work takes, driving aside.
    pub(crate) work_secs: f64,
    /// How many times as long everything takes.
    pub(crate) slower: f64,
    /// Ends in this failure, whatever else.
    pub(crate) fails: Option<SmolStr>,
    pub(crate) stage: Stage,
    /// Stages that are over.
    pub(crate) step: u32,
    /// What `search` has found.
    pub(crate) found: Option<SmolStr>,
}

/// What a task is doing.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Stage {
    /// The base moves, which ends then.
    Driving(Time),
    /// Everything else, which ends then.
    Working(Time),
    /// It keeps still; what was left of the motion.
    HeldDriving(Motion),
    /// It keeps still; what was left of the work.
    HeldWorking(Time),
}

impl Stage {
    /// When something happens.
    pub(crate) const fn due(&self) -> Time {
        match self {
            Self::Driving(at) | Self::Working(at) => *at,
            Self::HeldDriving(_) | Self::HeldWorking(_) => Time::NEVER,
        }
    }
}

/// What comes next.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Next {
    Drive(Stance),
    Turn(f64),
    Work,
    End(Outcome),
}

/// What a task works on.
pub(crate) struct Stageplay<'s> {
    pub(crate) world: &'s mut World,
    pub(crate) people: &'s mut People,
    pub(crate) scene: &'s Scene,
}

impl Stageplay<'_> {
    /// What a task does next. Called at its start and whenever a stage is over.
    pub(crate) fn next(&mut self, task: &mut Task) -> Next {
        let step = task.step;
        task.step += 1;
        if let Some(kind) = &task.fails {
            return if step == 0 { Next::Work } else { Next::End(Outcome::Failure(kind.clone())) };
        }
        match &task.deed {
            Deed::Go(to) => self.go(to, step),
            Deed::Search(what, around) => {
                let (what, around) = (what.clone(), around.clone());
                self.search(task, &what, &around, step)
            }
            Deed::Turn(by) if step == 0 => Next::Turn(*by),
            Deed::Pick(id) | Deed::Grasp(id) if step == 0 => self.shuffle(id),
            Deed::Pick(_) | Deed::Grasp(_) if step == 1 => Next::Work,
            Deed::Turn(_) | Deed::Pick(_) | Deed::Grasp(_) => self.finish(task),
            Deed::Home | Deed::StartPose | Deed::WakeUp | Deed::Lift | Deed::Unknown => self.work(task, step),
            Deed::Place(_, _) | Deed::Handover(_, _) | Deed::Open(_) | Deed::Close(_) => {
                self.work(task, step)
            }
            Deed::Push(_) | Deed::Detect(_) | Deed::DetectAll(_) | Deed::Locate(_) => self.work(task, step),
            Deed::Ground(_) | Deed::Inspect(_) => self.work(task, step),
            Deed::Say(_) | Deed::Ask(_) | Deed::Choose(_) => self.work(task, step),
        }
    }

    fn work(&mut self, task: &Task, step: u32) -> Next {
        if step == 0 { Next::Work } else { self.finish(task) }
    }

    /// Drives until it stands at the target, which may walk away meanwhile.
    fn go(&mut self, to: &str, step: u32) -> Next {
        let arrived = step > 0 && self.world.stands_at(self.world.root(to));
        if arrived || self.world.holder(to).is_some() {
            self.world.visit(to);
            return Next::End(Outcome::Success(None));
        }
        let base = self.world.base;
        // Where the best place does not serve it, no other will.
        let is_further = |place: &Stance| step == 0 || base.distance_to(place.x, place.y) > 0.01;
        let place = self.world.place_for(to).filter(is_further);
        place.map_or_else(|| fail("unreachable"), Next::Drive)
    }

    /// A step along what it stands at, so that the hand reaches.
    fn shuffle(&self, id: &str) -> Next {
        self.world.stance_for_hand(id).map_or(Next::Drive(self.world.base), Next::Drive)
    }

    /// Drives to where it looks, looks around, and drives to what it found.
    fn search(&mut self, task: &mut Task, what: &str, around: &str, step: u32) -> Next {
        match (step, task.found.clone()) {
            (0, _) => self.world.place_for(around).map_or_else(|| fail("unreachable"), Next::Drive),
            (1, _) => Next::Work,
            (2, _) => match World::the_one(self.world.found(self.scene, what, Look::Around)) {
                Ok(id) => {
                    task.found = Some(id.clone());
                    self.world.saw(&id);
                    self.world.place_for(&id).map_or_else(|| fail("unreachable"), Next::Drive)
                }
                Err(failure) => fail(failure),
            },
            (_, Some(id)) if self.world.look_at(&id).is_ok() => {
                self.world.visit(&id);
                task.deed.leave_arm(self.world);
                Next::End(Outcome::Success(Some(Value::Entity(id))))
            }
            (_, _) => fail("not_found"),
        }
    }

    /// The work is done: what came of it.
    fn finish(&mut self, task: &Task) -> Next {
        let world = &mut *self.world;
        let nothing = |()| None;
        let result = match &task.deed {
            Deed::Pick(id) => world.grasp(id, &task.uses).and_then(|()| world.lift()).map(nothing),
            Deed::Grasp(id) => world.grasp(id, &task.uses).map(nothing),
            Deed::Lift => world.lift().map(nothing),
            Deed::Place(id, on) => world.place(id, on).map(nothing),
            Deed::Handover(id, to) => world.hand_over(id, to).map(nothing),
            Deed::Open(id) => world.work_door(id, true).map(nothing),
            Deed::Close(id) => world.work_door(id, false).map(nothing),
            Deed::Push(id) => world.push(id).map(nothing),
            Deed::WakeUp => {
                world.standing = true;
                Ok(None)
            }
            Deed::Detect(what) => World::the_one(world.found(self.scene, what, Look::Ahead)).map(|id| {
                world.saw(&id);
                Some(Value::Entity(id))
            }),
            Deed::DetectAll(what) => {
                let found = world.found(self.scene, what, Look::Ahead);
                found.iter().for_each(|id| world.saw(id));
                Ok(Some(Value::List(found.into_iter().map(Value::Entity).collect())))
            }
            Deed::Locate(id) | Deed::Ground(id) => {
                world.look_at(id).map(|thing| Some(Value::Pose(thing.body.pose())))
            }
            Deed::Inspect(id) => world.look_at(id).map(|_| None),
            Deed::Say(text) => {
                self.people.heard.push((world.now, text.clone()));
                Ok(None)
            }
            Deed::Ask(_) => self.people.answer().map(|answer| Some(Value::Text(answer))),
            Deed::Choose(among) => {
                self.people.choice(self.scene, among).map(|chosen| Some(Value::Entity(chosen)))
            }
            Deed::Home | Deed::StartPose | Deed::Turn(_) | Deed::Unknown => Ok(None),
            Deed::Go(_) | Deed::Search(_, _) => Ok(None),
        };
        match result {
            Ok(value) => {
                task.deed.leave_arm(world);
                Next::End(Outcome::Success(value))
            }
            Err(failure) => fail(failure),
        }
    }
}

fn fail(kind: &'static str) -> Next {
    Next::End(Outcome::Failure(SmolStr::new_static(kind)))
}
