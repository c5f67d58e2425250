//! People: what they answer, and what they were told.

use crate::hand::Failure;
use motet_robots::scene::Scene;
use motet_runtime::Time;
use smol_str::SmolStr;
use std::collections::VecDeque;

/// People in the simulated room: scripted answers and heard utterances.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct People {
    answers: VecDeque<Option<String>>,
    /// Utterances of the robot with the times at which they ended.
    pub(crate) heard: Vec<(Time, SmolStr)>,
}

impl People {
    pub(crate) fn new(answers: impl IntoIterator<Item = Option<String>>) -> Self {
        Self { answers: answers.into_iter().collect(), heard: Vec::new() }
    }

    /// The answer to a question.
    pub(crate) fn answer(&mut self) -> Result<SmolStr, Failure> {
        match self.answers.pop_front() {
            Some(Some(answer)) => Ok(answer.into()),
            Some(None) => Err("refused"),
            None => Ok(SmolStr::new_static("yes")),
        }
    }

    /// Choice of a person among several things: the one that the answer describes, or the first without a
    /// script.
    pub(crate) fn choice(&mut self, scene: &Scene, among: &[SmolStr]) -> Result<SmolStr, Failure> {
        let Some(answer) = self.answers.pop_front() else { return among.first().cloned().ok_or("refused") };
        let Some(answer) = answer else { return Err("refused") };
        let fitting = scene.matches(&answer);
        let fits = |id: &SmolStr| *id == answer || fitting.iter().any(|entity| entity.id == *id);
        let mut chosen = among.iter().filter(|id| fits(id));
        match (chosen.next(), chosen.next()) {
            (None, _) => Err("refused"),
            (Some(only), None) => Ok(only.clone()),
            (Some(_), Some(_)) => Err("ambiguous"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_answers_come_in_order_and_then_by_default() {
        let mut people = People::new([Some("no".to_owned()), None]);
        assert_eq!(people.answer(), Ok("no".into()));
        assert_eq!(people.answer(), Err("refused"));
        assert_eq!(people.answer(), Ok("yes".into()));
    }

    #[test]
    fn people_choose_among_what_they_are_offered() {
        let scene = Scene::default();
        let among = ["cup_1".into(), "cup_2".into()];
        let mut people = People::new([Some("cup_2".to_owned()), Some("cup_3".to_owned())]);
        assert_eq!(people.choice(&scene, &among), Ok("cup_2".into()));
        assert_eq!(people.choice(&scene, &among), Err("refused"));
        assert_eq!(people.choice(&scene, &among), Ok("cup_1".into()));
        assert_eq!(people.choice(&scene, &[]), Err("refused"));
    }
}
