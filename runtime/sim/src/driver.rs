//! The simulator as a driver: goals become tasks, and time goes from one thing that happens to the next.

use crate::body::{BasePose, distance};
use crate::chance::Chance;
use crate::command::SimCommand;
use crate::failure::Failure;
use crate::faults::WorldEvent;
use crate::motion::BaseMotion;
use crate::sim::Sim;
use crate::task::{NextStage, Task, TaskStage};
use crate::world::ViewDirection;
use motet_graph::{Graph, Manner, Waypoint};
use motet_runtime::{
    Capabilities, Command, Detection, Driver, DriverEvent, GoalId, Moved, Outcome, PrimitiveSet, Query,
    RgbdView, Time, ToldThing,
};
use motet_stdlib::lang::failures;
use rand::RngExt;
use smol_str::SmolStr;
use std::collections::BTreeSet;

/// Difference in m up to which something stands where it was told.
const AS_TOLD_M: f64 = 0.01;

impl Driver for Sim {
    fn base(&self) -> Option<[f64; 3]> {
        let at = self.world.base;
        Some([at.x, at.y, at.heading])
    }

    fn begin_run(&mut self, now: Time, _run: &str, _graph: Option<&Graph>) -> Time {
        self.pass(now);
        while let Some(goal) = self.tasks.first().map(|task| task.goal) {
            self.drop_task(goal);
        }
        self.watches.clear();
        self.outbox.clear();
        now
    }

    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.pass(now);
        self.calls += 1;
        let jitter = 0.9 + self.random.random::<f64>() * (1.1 - 0.9);
        let fault = self.faults.of_call(&command.primitive);
        if let Some(failure) = fault.refuses {
            self.report(DriverEvent::Refused { goal, failure });
            return;
        }
        self.report(DriverEvent::Acknowledged { goal });
        let parsed = SimCommand::of(command);
        let share = if fault.fails.is_some() { parsed.share().max(0.05) } else { parsed.share() };
        let task = Task {
            goal,
            uses: command.uses.clone(),
            work_secs: command.deadline_secs * share * jitter + self.delay(&parsed),
            path: base_path(&parsed, command),
            occasion: self.calls,
            command: parsed,
            slower: fault.slower,
            stretch: stretch(command),
            fails: fault.fails,
            stage: TaskStage::Working(Time::NEVER),
            step: 0,
            found: None,
        };
        if fault.hangs {
            self.tasks.push(task);
        } else {
            self.go_on(task);
        }
        self.look();
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.pass(now);
        if self.drop_task(goal) {
            self.report(DriverEvent::Ended { goal, outcome: Outcome::Interrupted });
        }
    }

    /// It can hold everything, and `go` somewhere else on the way. It sees if its card has a camera.
    fn capabilities(&self) -> Capabilities {
        Capabilities {
            update: PrimitiveSet::Only(BTreeSet::from([SmolStr::new_static("go")])),
            moved: true,
            look: self.camera.is_some(),
            detections: self.camera.is_some(),
            told: true,
            ..Capabilities::default()
        }
    }

    fn update(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.pass(now);
        let Some(place) = self.tasks.iter().position(|task| task.goal == goal) else { return };
        let mut task = self.tasks.remove(place);
        let hangs = task.stage == TaskStage::Working(Time::NEVER);
        if matches!(task.stage, TaskStage::Driving(_)) {
            self.halt();
        }
        task.command = SimCommand::of(command);
        task.path = base_path(&task.command, command);
        task.stretch = stretch(command);
        if hangs {
            self.tasks.push(task);
        } else {
            task.step = 0;
            self.go_on(task);
        }
        self.look();
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        self.pass(now);
        let motion = self.world.motion.clone();
        let is_driving = |task: &Task| task.goal == goal && matches!(task.stage, TaskStage::Driving(_));
        if self.tasks.iter().any(is_driving) {
            self.contact = None;
        }
        let Some(task) = self.tasks.iter_mut().find(|task| task.goal == goal) else { return };
        task.stage = match (&task.stage, motion) {
            (TaskStage::Driving(_), Some(motion)) => {
                self.world.motion = None;
                TaskStage::HeldDriving(motion)
            }
            (TaskStage::Driving(until) | TaskStage::Working(until), _) => {
                TaskStage::HeldWorking(until_after(*until, now))
            }
            (held @ (TaskStage::HeldDriving(_) | TaskStage::HeldWorking(_)), _) => held.clone(),
        };
        if let TaskStage::HeldDriving(motion) = &mut task.stage {
            *motion = motion.rest(now, now);
        }
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        self.pass(now);
        let Some(task) = self.tasks.iter_mut().find(|task| task.goal == goal) else { return };
        task.stage = match task.stage.clone() {
            TaskStage::HeldDriving(motion) => {
                let motion = motion.begun(now);
                let end = motion.end();
                self.world.motion = Some(motion);
                TaskStage::Driving(end)
            }
            TaskStage::HeldWorking(left) => TaskStage::Working(now.after(left)),
            running @ (TaskStage::Driving(_) | TaskStage::Working(_)) => running,
        };
        self.expect_contact();
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.pass(now);
        self.drop_task(goal);
        self.report(DriverEvent::Stopped { goal });
    }

    fn observe(&mut self, now: Time, query: &Query) {
        self.pass(now);
        let answer = self.read(query);
        self.report(DriverEvent::Observed { query: query.clone(), answer });
    }

    fn watch(&mut self, now: Time, query: &Query) {
        self.pass(now);
        if self.watches.iter().any(|(watched, _)| watched == query) {
            return;
        }
        let answer = self.read(query);
        self.watches.push((query.clone(), answer.clone()));
        self.report(DriverEvent::Observed { query: query.clone(), answer });
    }

    fn unwatch(&mut self, now: Time, query: &Query) {
        self.pass(now);
        self.watches.retain(|(watched, _)| watched != query);
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        loop {
            if let Some(report) = self.outbox.pop_front() {
                return Some(report);
            }
            let next = self.next_time();
            if next > until || next == Time::NEVER {
                if until != Time::NEVER {
                    self.reach(until);
                }
                return self.outbox.pop_front();
            }
            self.reach(next);
        }
    }

    fn telemetry(&mut self) -> Option<Moved> {
        self.trail.next(&self.world)
    }

    fn detected(&mut self) -> Option<Vec<Detection>> {
        (!self.sighted.is_empty()).then(|| self.sighted.drain(..).collect())
    }

    fn told(&mut self, now: Time, thing: &ToldThing) {
        self.pass(now);
        self.hear_of(thing);
    }

    fn look(&mut self, now: Time, camera: Option<&str>) -> Option<RgbdView> {
        self.overview(now, camera)
    }

    fn detections(&mut self, now: Time) -> Vec<Detection> {
        self.detected_at(now)
    }
}

/// The span from `now` until a time; never where that is never.
const fn until_after(until: Time, now: Time) -> Time {
    if until.nanos() == Time::NEVER.nanos() { until } else { until.since(now) }
}

/// Stances of the base along the witness of a drive; none without one, or of another command.
fn base_path(parsed: &SimCommand, command: &Command) -> Vec<BasePose> {
    let motion = command.motions.first().filter(|_| parsed.is_drive());
    let witness = motion.and_then(|motion| motion.witness.as_ref());
    let stance = |point: &Waypoint| {
        let [x, y, heading] = point.base;
        BasePose { x, y, heading }
    };
    witness.map_or_else(Vec::new, |witness| witness.path.iter().map(stance).collect())
}

/// Factor by which the manner of a command makes its motion longer.
fn stretch(command: &Command) -> f64 {
    command.manner.map_or(1.0, Manner::stretch)
}

impl Sim {
    /// Takes a task to its next stage, or ends it.
    pub(crate) fn go_on(&mut self, mut task: Task) {
        let now = self.world.now;
        self.feel();
        if task.step > 0 {
            self.look_about(ViewDirection::Still);
        }
        let next = self.next_stage(&mut task);
        let follows = matches!(next, NextStage::Follow(_));
        let motion = match next {
            NextStage::Drive(to) => match self.belief.route(to) {
                Ok(way) => self.motion_through(way),
                Err(id) => {
                    let failure =
                        Failure::new(failures::BLOCKED, format!("{} is in the way", self.belief.name(&id)));
                    self.report(DriverEvent::Ended { goal: task.goal, outcome: failure.outcome() });
                    return;
                }
            },
            NextStage::Follow(path) => self.motion_through(path),
            NextStage::Turn(by) => Some(BaseMotion::turn(&self.world.drive, self.world.base, by, now)),
            NextStage::Work => {
                task.stage = TaskStage::Working(now.after(Time::from_secs(task.work_secs * task.slower)));
                self.tasks.push(task);
                return;
            }
            NextStage::End(outcome) => {
                self.report(DriverEvent::Ended { goal: task.goal, outcome });
                return;
            }
        };
        if let Some(motion) = motion {
            let motion = motion.slowed(task.slower * task.stretch);
            task.stage = TaskStage::Driving(motion.end());
            self.drop_on_the_way(&motion);
            self.world.gaze = None;
            self.world.motion = Some(motion);
            self.follows = follows;
            self.expect_contact();
            self.tasks.push(task);
        } else {
            let failure = Failure::new(failures::UNREACHABLE, "the base cannot move");
            self.report(DriverEvent::Ended { goal: task.goal, outcome: failure.outcome() });
        }
    }

    /// A motion through stances that ends a little beside the last.
    fn motion_through(&self, mut stances: Vec<BasePose>) -> Option<BaseMotion> {
        let from = self.world.base;
        if let Some(last) = stances.last_mut().filter(|last| from.distance_to(last.x, last.y) > 1e-6) {
            let [dx, dy] = self.chance().error(self.profile.base.error_m, "drive", "");
            (last.x, last.y) = (last.x + dx, last.y + dy);
        }
        BaseMotion::through(&self.world.drive, from, &stances, self.world.now)
    }

    /// The hand may drop on a drive what it carries.
    fn drop_on_the_way(&mut self, motion: &BaseMotion) {
        let carried = self.world.hands.values().find(|grip| grip.lifted).and_then(|grip| grip.holds.clone());
        let Some(carried) = carried else { return };
        let chance = self.chance();
        if !motion.is_still() && chance.comes(self.profile.hand.drop, "drop", &carried) {
            let span = motion.end().since(self.world.now).secs() * chance.share("drop at", &carried);
            self.faults.insert(self.world.now.after(Time::from_secs(span)), WorldEvent::Slips(carried));
        }
    }

    /// Delay of a late answer, in s.
    fn delay(&self, command: &SimCommand) -> f64 {
        let rates = &self.profile.people;
        let is_answered = matches!(command, SimCommand::Ask(_) | SimCommand::Choose(_));
        let is_late = is_answered && Chance::new(self.seed, self.calls).comes(rates.late, "late", "");
        if is_late { rates.late_secs } else { 0.0 }
    }

    /// Looks ahead for the contact at which the motion of the base will end. On a certified path, what stands
    /// where it was told is none: the certificate knows the robot's shape better than a disc does.
    pub(crate) fn expect_contact(&mut self) {
        let follows = self.follows;
        let is_as_told = |id: &SmolStr| {
            let pair = self.world.thing(id).zip(self.told.get(id));
            pair.is_some_and(|(thing, told)| distance(thing.body.xyz, *told) <= AS_TOLD_M)
        };
        let solid = |id: &SmolStr| !(follows && is_as_told(id));
        self.contact = self.world.motion.as_ref().and_then(|motion| self.world.contact(motion, solid));
    }

    /// The base touches something and stops: the drive ends.
    pub(crate) fn bump(&mut self, with: &str) {
        self.halt();
        self.feel();
        self.notice(with);
        let is_driving = |task: &Task| matches!(task.stage, TaskStage::Driving(_));
        if let Some(place) = self.tasks.iter().position(is_driving) {
            let task = self.tasks.remove(place);
            if matches!(&task.command, SimCommand::Go(to) if self.belief.root(to) == with) {
                // It came to what it went to earlier than it thought.
                self.go_on(task);
                return;
            }
            let failure = Failure::new(
                failures::BLOCKED,
                format!("the base meets {} on its way", self.world.name(with)),
            );
            self.report(DriverEvent::Ended { goal: task.goal, outcome: failure.outcome() });
        }
    }

    /// The base stops where it is.
    fn halt(&mut self) {
        self.world.motion = None;
        self.contact = None;
    }

    /// Forgets a goal; the base stops where it is. Whether it was live.
    fn drop_task(&mut self, goal: GoalId) -> bool {
        let Some(place) = self.tasks.iter().position(|task| task.goal == goal) else { return false };
        let task = self.tasks.remove(place);
        if matches!(task.stage, TaskStage::Driving(_)) {
            self.halt();
        }
        true
    }
}
