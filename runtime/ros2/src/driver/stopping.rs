//! Stops of all goals, and of the whole robot.

use super::{Driver, Goal, TICK};
use crate::task::{Finish, Surroundings, Task, stand_still};
use motet_host::remote::protocol::{DriverReport, GoalParams};
use motet_runtime::GoalId;
use std::time::{Duration, Instant};

/// Time for everything to stand still before the process ends.
const FAREWELL: Duration = Duration::from_millis(4500);
/// Time between two stops of a whole robot that is not at rest.
const STOPS_AGAIN: Duration = Duration::from_millis(500);

impl Driver {
    pub(super) fn stop_all(&mut self) {
        let running: Vec<u64> = self.goals.keys().copied().collect();
        for number in running {
            self.with_task(GoalId::from_number(number), Task::safe_stop);
        }
    }

    /// Stops everything, and waits for standstill.
    pub(super) fn leave(&mut self) -> Result<(), String> {
        let (begun, received) = (Instant::now(), self.robot.received.clone());
        self.stop_all();
        if self.goals.values().any(|goal| matches!(goal, Goal::Lost)) {
            self.stop_whole();
        }
        while self.is_running() || self.whole_stop.is_some() {
            if begun.elapsed() > FAREWELL {
                return Err("the robot still moves, or nobody says that it stands still".to_owned());
            }
            if let Ok(message) = received.recv_timeout(TICK) {
                self.take(&message);
            }
            let heard = self.robot.tick();
            self.pass(&heard);
            // The host may not listen any more.
            let _ = self.advance();
        }
        Ok(())
    }

    /// Lets the goals of the run before come to their stop.
    pub(super) fn advance_former(&mut self) {
        let mut around = Surroundings { robot: &mut self.robot, world: &mut self.world, card: &self.card };
        let mut is_lost = false;
        self.former.retain_mut(|task| match task.advance(&mut around) {
            Some(finish) => {
                is_lost |= finish == Finish::Lost;
                false
            }
            None => true,
        });
        if is_lost {
            self.stop_whole();
        }
    }

    /// Stops the whole robot, whoever moves it.
    pub(super) fn stop_whole(&mut self) {
        self.whole_stop = Some(Instant::now());
        self.robot.cancel_all();
        if !self.robot.is_still() {
            let parts = self.robot.parts();
            stand_still(&mut self.robot, &parts);
        }
    }

    /// Goals of safe stops for which the whole robot is now at rest.
    pub(super) fn advance_whole_stop(&mut self) -> Vec<DriverReport> {
        let Some(sent) = self.whole_stop else { return Vec::new() };
        if self.robot.is_at_rest() {
            self.whole_stop = None;
            let stopped: Vec<u64> = std::mem::take(&mut self.stopping).into_iter().collect();
            for number in &stopped {
                let goal = self.goals.entry(*number).or_insert(Goal::Stopped);
                if matches!(goal, Goal::Lost) {
                    *goal = Goal::Stopped;
                }
            }
            let report = |number| DriverReport::Stopped(GoalParams { goal: GoalId::from_number(number) });
            return stopped.into_iter().map(report).collect();
        }
        if sent.elapsed() > STOPS_AGAIN {
            self.stop_whole();
        }
        Vec::new()
    }

    fn is_running(&self) -> bool {
        !self.former.is_empty() || self.goals.values().any(|goal| matches!(goal, Goal::Running(_)))
    }
}
