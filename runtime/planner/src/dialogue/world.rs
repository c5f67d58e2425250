//! The present of a conversation, for a host that brings policies of its own: the session that checks them
//! now and during a run, and the knowledge that a run leaves behind.

use motet_compiler::Session;
use motet_requests::ReportedLocation;
use motet_robots::scene::Scene;
use motet_runtime::{Driver, Engine, RunEnd, Time};
use motet_stdlib::lang::failures;

use super::conversation::Conversation;
use super::senses::sense;

impl Conversation<'_> {
    /// The scene as it is known now.
    #[must_use]
    pub fn scene(&self) -> Scene {
        self.known.scene(&self.setting.scene)
    }

    /// Session that checks a policy which begins now, with the base at this pose if it is known.
    #[must_use]
    pub fn present(&self, base: Option<[f64; 3]>) -> Session {
        self.session(&self.scene(), &self.known, base)
    }

    /// Session that checks a policy which takes over from the one that runs. Facts that running steps change
    /// are unknown in it.
    #[must_use]
    pub fn midway(&self, engine: &Engine) -> Session {
        let mut known = self.known.clone();
        known.learn_midway(engine, self.base());
        // Where the base is while it moves nobody knows beforehand.
        self.session(&known.scene(&self.setting.scene), &known, None)
    }

    /// Begins a run: returns the places of things before it, for [`Conversation::learn`].
    pub fn begin(&mut self) -> Vec<ReportedLocation> {
        let before = self.known.places(&self.scene());
        self.known.look_away();
        before
    }

    /// Takes over what a run has left behind. `told` are the places that people told meanwhile, and `before`
    /// comes from [`Conversation::begin`]. After a run that was not done, the driver is asked for the state
    /// of the robot. Returns the time after that.
    pub fn learn(
        &mut self,
        (engine, end): (&Engine, &RunEnd),
        (before, told): (&[ReportedLocation], &[ReportedLocation]),
        driver: &mut dyn Driver,
        now: Time,
    ) -> Time {
        let mut known = std::mem::take(&mut self.known);
        known.learn(engine, self.base());
        told.iter().for_each(|one| known.hear(one));
        self.known = known;
        // What was not found is not where it was thought to be.
        if !matches!(end, RunEnd::Failed { kind, .. } if kind == failures::NOT_FOUND) {
            self.known.presume(&self.setting.scene, before);
        }
        let after = self.known.places(&self.setting.scene);
        self.known.remember_moved(before, &after);
        if matches!(end, RunEnd::Done { .. }) {
            return now;
        }
        let scene = self.known.seen_scene(&self.setting.scene);
        let (felt, after) = sense(driver, &self.setting.robot, &scene, now);
        self.known.notice(&felt);
        now.max(after)
    }
}
