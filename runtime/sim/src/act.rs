//! Results of primitives: what the world makes of them at their end, and what the robot sees of it.

use crate::command::{Placing, SimCommand};
use crate::failure::Failure;
use crate::sight::the_one;
use crate::sim::Sim;
use crate::task::{NextStage, Task};
use crate::world::{Rest, ViewDirection};
use motet_graph::{Pose, Value};
use motet_runtime::Outcome;
use motet_stdlib::lang::failures;
use smol_str::SmolStr;

/// Distance in m from where a thing is believed to be at which the hand closes on nothing.
const GRASP_MISS_M: f64 = 0.1;

impl Sim {
    /// The work is done: what came of it.
    pub(crate) fn finish(&mut self, task: &Task) -> NextStage {
        let nothing = |()| None;
        let result = match &task.command {
            SimCommand::Pick(id) => {
                self.take(id, None, &task.uses).and_then(|()| self.world.lift()).map(nothing)
            }
            SimCommand::Grasp(id, at) => self.take(id, at.as_ref(), &task.uses).map(nothing),
            SimCommand::Lift => self.world.lift().map(nothing),
            SimCommand::Place(id, on, rules) => self.put_down(id, on, rules).map(nothing),
            SimCommand::Handover(id, to) => self.hand_to(id, to).map(nothing),
            SimCommand::Open(id) => self.work_door(id, true).map(nothing),
            SimCommand::Close(id) => self.work_door(id, false).map(nothing),
            SimCommand::Push(id) => {
                let pushed = self.world.push(id);
                self.notice(id);
                pushed.map(nothing)
            }
            SimCommand::WakeUp => {
                self.world.standing = true;
                Ok(None)
            }
            SimCommand::Detect(what) => {
                the_one(self.found(what, ViewDirection::Ahead), what).map(|id| Some(Value::Entity(id)))
            }
            SimCommand::DetectAll(what) => {
                let found = self.found(what, ViewDirection::Ahead);
                Ok(Some(Value::List(found.into_iter().map(Value::Entity).collect())))
            }
            SimCommand::Locate(id) | SimCommand::Ground(id) => {
                let seen = self.look_at(id);
                seen.map(|()| self.belief.thing(id).map(|thing| Value::Pose(thing.body.pose())))
            }
            SimCommand::Inspect(id) => self.look_at(id).map(nothing),
            SimCommand::Say(text) => {
                self.people.hear(self.world.now, text);
                Ok(None)
            }
            SimCommand::Ask(_) => {
                let refuses = self.refuses("");
                let answer = self.people.answer(refuses);
                self.faults.answered(self.world.now);
                answer.map(|answer| Some(Value::Text(answer)))
            }
            SimCommand::Choose(among) => {
                let refuses = self.refuses("");
                let chosen = self.people.choice(&self.scene, among, refuses);
                self.faults.answered(self.world.now);
                chosen.map(|chosen| Some(Value::Entity(chosen)))
            }
            SimCommand::Home | SimCommand::StartPose | SimCommand::Turn(_) | SimCommand::Unknown => Ok(None),
            SimCommand::Go(_) | SimCommand::GoToPose(_) | SimCommand::Search(_, _) => Ok(None),
        };
        self.feel();
        match result {
            Ok(value) => {
                task.command.leave_arm(&mut self.world);
                NextStage::End(Outcome::Success(value))
            }
            Err(failure) => NextStage::End(failure.outcome()),
        }
    }

    /// Closes a hand around a thing: at a pose, or where the robot sees or else believes it.
    fn take(&mut self, id: &str, at: Option<&Pose>, uses: &[SmolStr]) -> Result<(), Failure> {
        let (chance, name) = (self.chance(), self.belief.name(id));
        if self.world.holder(id).is_some() {
            return self.world.grasp(id, uses);
        }
        let target = match at {
            Some(at) => {
                self.world.grasp_at(id, at)?;
                None
            }
            None => {
                self.see_before_grasp(id);
                if self.belief.thing(id).is_some_and(|thing| thing.lost) {
                    let text = format!("{name} is not where it was believed to be");
                    return Err(Failure::new(failures::NOT_FOUND, text));
                }
                self.belief.cannot_take(id).map_or(Ok(()), Err)?;
                self.belief.thing(id).map(|thing| thing.body.xyz)
            }
        };
        let truth = self.world.thing(id).map(|thing| thing.body.xyz);
        if let (Some(aim), Some(truth)) = (target, truth) {
            let [dx, dy] = chance.error(self.profile.hand.error_m, "hand", id);
            let off = (aim[0] + dx - truth[0]).hypot(aim[1] + dy - truth[1]).max((aim[2] - truth[2]).abs());
            if off > GRASP_MISS_M {
                let text = format!("the hand closes on nothing where {name} was believed to be");
                return Err(Failure::new(failures::NOT_FOUND, text));
            }
            if off > self.world.grasp_margin(id) + 1e-9 && self.world.cannot_take(id).is_none() {
                let text = format!("the fingers close {off:.3} m beside the middle of {name}");
                return Err(Failure::new(failures::SLIPPED, text));
            }
        }
        self.world.cannot_take(id).map_or(Ok(()), Err)?;
        if chance.comes(self.profile.hand.slip, "slip", id) {
            return Err(Failure::new(failures::SLIPPED, format!("{name} slips out of the fingers")));
        }
        self.world.grasp(id, uses)?;
        self.notice(id);
        Ok(())
    }

    /// Looks at a thing before the hand goes there. A thing that is seen is known better; one that is seen
    /// not to be there is lost; of one that is hidden nothing new is known.
    fn see_before_grasp(&mut self, id: &str) {
        let look = ViewDirection::Ahead;
        let [miss, _] = self.world.miss(id, self.profile.camera.miss, look);
        if !self.chance().comes(miss, "see", id) {
            self.refresh(id, look);
        }
    }

    fn put_down(&mut self, id: &str, on: &str, rules: &Placing) -> Result<(), Failure> {
        let chance = self.chance();
        self.world.place(id, on, rules)?;
        let name = self.belief.name(id);
        if chance.comes(self.profile.hand.short, "short", id) {
            let base = self.world.base;
            let ahead = self.world.base_extent() + 0.1;
            let spot = [base.x + ahead * base.heading.cos(), base.y + ahead * base.heading.sin()];
            self.world.put(id, spot, 0.0, Rest::Free);
            self.feel();
            self.notice(id);
            let text = format!("{name} falls to the floor beside {}", self.belief.name(on));
            return Err(Failure::new(failures::SLIPPED, text));
        }
        let error = chance.error(self.profile.hand.error_m, "place", id);
        self.world.nudge(id, error);
        self.feel();
        self.notice(id);
        Ok(())
    }

    fn hand_to(&mut self, id: &str, to: &str) -> Result<(), Failure> {
        if self.refuses(to) {
            let text = format!("{} does not take {}", self.belief.name(to), self.belief.name(id));
            return Err(Failure::new(failures::REFUSED, text));
        }
        self.world.hand_over(id, to)?;
        self.feel();
        self.notice(id);
        Ok(())
    }

    fn refuses(&self, person: &str) -> bool {
        self.chance().comes(self.profile.people.refuse, "refuse", person)
    }

    fn work_door(&mut self, id: &str, open: bool) -> Result<(), Failure> {
        let is_so = self.world.thing(id).is_some_and(|thing| thing.is_open() == open);
        if !is_so && self.chance().comes(self.profile.hand.stick, "stick", id) {
            return Err(Failure::new(failures::BLOCKED, format!("{} sticks", self.belief.name(id))));
        }
        self.world.work_door(id, open)?;
        self.notice(id);
        Ok(())
    }
}
