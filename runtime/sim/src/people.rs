//! People: what they answer, what they were told, and where they walk.

use crate::chance::Chance;
use crate::failure::Failure;
use crate::profile::PeopleRates;
use crate::world::{Role, SimWorld};
use motet_robots::scene::Scene;
use motet_runtime::Time;
use motet_stdlib::lang::failures;
use smol_str::SmolStr;
use std::collections::VecDeque;

/// Number of utterances that are kept at least; a run may go on for ever.
const HEARD: usize = 1_000;

/// People in the simulated room: scripted answers and heard utterances.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct People {
    answers: VecDeque<Option<String>>,
    /// Latest utterances of the robot with the times at which they ended.
    pub(crate) heard: Vec<(Time, SmolStr)>,
}

impl People {
    pub(crate) fn new(answers: impl IntoIterator<Item = Option<String>>) -> Self {
        Self { answers: answers.into_iter().collect(), heard: Vec::new() }
    }

    /// Takes in what the robot has said.
    pub(crate) fn hear(&mut self, now: Time, text: &SmolStr) {
        if self.heard.len() >= 2 * HEARD {
            self.heard.drain(..HEARD);
        }
        self.heard.push((now, text.clone()));
    }

    /// The answer to a question. A script says whether it is refused; without one `refuses` does.
    pub(crate) fn answer(&mut self, refuses: bool) -> Result<SmolStr, Failure> {
        match self.answers.pop_front() {
            Some(Some(answer)) => Ok(answer.into()),
            Some(None) => Err(failures::REFUSED.into()),
            None if refuses => Err(Failure::new(failures::REFUSED, "the person does not answer")),
            None => Ok(SmolStr::new_static("yes")),
        }
    }

    /// Choice of a person among several things: the one that the answer describes, or the first without a
    /// script.
    pub(crate) fn choice(
        &mut self,
        scene: &Scene,
        among: &[SmolStr],
        refuses: bool,
    ) -> Result<SmolStr, Failure> {
        let Some(answer) = self.answers.pop_front() else {
            if refuses {
                return Err(Failure::new(failures::REFUSED, "the person does not choose"));
            }
            return among.first().cloned().ok_or_else(|| failures::REFUSED.into());
        };
        let Some(answer) = answer else { return Err(failures::REFUSED.into()) };
        let fitting = scene.matches(&answer);
        let fits = |id: &SmolStr| *id == answer || fitting.iter().any(|entity| entity.id == *id);
        let mut chosen = among.iter().filter(|id| fits(id));
        match (chosen.next(), chosen.next()) {
            (None, _) => Err(failures::REFUSED.into()),
            (Some(only), None) => Ok(only.clone()),
            (Some(_), Some(_)) => Err(failures::AMBIGUOUS.into()),
        }
    }
}

/// Time in s up to which people walk by themselves.
const STROLL_SECS: f64 = 1800.0;

/// Walks that people take by themselves, in order of time.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Strolls {
    walks: VecDeque<(Time, SmolStr)>,
}

impl Strolls {
    /// Draws the times of the walks of everybody in a world: a Poisson process for each.
    pub(crate) fn new(world: &SimWorld, rates: &PeopleRates, seed: u64) -> Self {
        if rates.walk_per_min <= 0.0 {
            return Self { walks: VecDeque::new() };
        }
        let mut walks = Vec::new();
        for (id, _) in world.things.iter().filter(|(_, thing)| thing.role == Role::Person) {
            let (mut at, mut number) = (0.0, 0);
            loop {
                number += 1;
                at -= 60.0 / rates.walk_per_min * (1.0 - Chance::new(seed, number).share("stroll", id)).ln();
                if at > STROLL_SECS {
                    break;
                }
                walks.push((Time::from_secs(at), id.clone()));
            }
        }
        walks.sort_by_key(|(at, _)| *at);
        Self { walks: walks.into() }
    }

    /// Time of the next walk.
    pub(crate) fn next_time(&self) -> Time {
        self.walks.front().map_or(Time::NEVER, |(at, _)| *at)
    }

    /// The next person who walks off.
    pub(crate) fn take(&mut self, now: Time) -> Option<SmolStr> {
        self.walks.pop_front_if(|(at, _)| *at <= now).map(|(_, person)| person)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_answers_come_in_order_and_then_by_default() {
        let mut people = People::new([Some("no".to_owned()), None]);
        assert_eq!(people.answer(true), Ok("no".into()));
        assert_eq!(people.answer(false), Err("refused".into()));
        assert_eq!(people.answer(false), Ok("yes".into()));
        assert_eq!(people.answer(true).map_err(|failure| failure.kind), Err("refused"));
    }

    #[test]
    fn people_choose_among_what_they_are_offered() {
        let scene = Scene::default();
        let among = ["cup_1".into(), "cup_2".into()];
        let mut people = People::new([Some("cup_2".to_owned()), Some("cup_3".to_owned())]);
        assert_eq!(people.choice(&scene, &among, false), Ok("cup_2".into()));
        assert_eq!(people.choice(&scene, &among, false), Err("refused".into()));
        assert_eq!(people.choice(&scene, &among, false), Ok("cup_1".into()));
        assert_eq!(people.choice(&scene, &[], false), Err("refused".into()));
    }
}
