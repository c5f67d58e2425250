//! Journal of a simulation in which a person answered questions: the simulator never heard of them.

use std::collections::BTreeSet;

use motet_graph::Value;
use motet_runtime::journal::{JournalEntry, StepEntry};
use motet_runtime::{Command, DriverEvent, Effect, Event, GoalId, Outcome};
use motet_stdlib::lang::{failures, primitives};

/// Goals of questions that a person answered.
#[derive(Clone, Debug, Default)]
pub(crate) struct AnsweredQuestions {
    goals: BTreeSet<GoalId>,
}

/// True for a command that an operator answers.
pub(crate) fn is_question(command: &Command) -> bool {
    let has_question = matches!(command.arg("question"), Some(Value::Text(_)));
    has_question && (command.primitive == primitives::ASK || command.primitive == primitives::CHOOSE)
}

impl AnsweredQuestions {
    /// Entry as the simulator saw it: without the starts and the ends of these goals.
    pub(crate) fn without(&mut self, entry: &JournalEntry) -> JournalEntry {
        match entry {
            JournalEntry::Step(step) => JournalEntry::Step(self.step(step)),
            JournalEntry::GaveUp(step) => JournalEntry::GaveUp(self.step(step)),
            JournalEntry::Swap(swap) => {
                let mut swap = swap.clone();
                swap.effects = self.effects(&swap.effects);
                JournalEntry::Swap(swap)
            }
            JournalEntry::Head(_) | JournalEntry::Resumed(_) => entry.clone(),
        }
    }

    fn step(&mut self, step: &StepEntry) -> StepEntry {
        let event = match &step.event {
            Some(Event::Driver(report)) if report.goal().is_some_and(|goal| self.goals.contains(&goal)) => {
                if let DriverEvent::Ended { goal, .. } | DriverEvent::Stopped { goal } = report {
                    self.goals.remove(goal);
                }
                // Time passes all the same.
                Some(Event::Tick)
            }
            event => event.clone(),
        };
        StepEntry { at: step.at, event, effects: self.effects(&step.effects) }
    }

    fn effects(&mut self, effects: &[Effect]) -> Vec<Effect> {
        let mut kept = Vec::with_capacity(effects.len());
        for effect in effects {
            match effect {
                Effect::Start { goal, command, .. } if is_question(command) => {
                    self.goals.insert(*goal);
                }
                Effect::Cancel { goal }
                | Effect::Hold { goal }
                | Effect::Proceed { goal }
                | Effect::SafeStop { goal }
                    if self.goals.contains(goal) => {}
                effect => kept.push(effect.clone()),
            }
        }
        kept
    }

    /// True for the goal of a question that nobody has answered.
    pub(crate) fn is_open(&self, goal: GoalId) -> bool {
        self.goals.contains(&goal)
    }

    /// Ends of the questions that nobody has answered: the person who was asked is gone.
    pub(crate) fn refused(&self) -> impl Iterator<Item = Event> {
        self.goals.iter().map(|goal| {
            let outcome = Outcome::Failure(failures::REFUSED.into());
            Event::Driver(DriverEvent::Ended { goal: *goal, outcome })
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use motet_graph::{NodeId, Value};
    use motet_runtime::journal::{JournalEntry, StepEntry};
    use motet_runtime::{Command, DriverEvent, Effect, Event, GoalId, Outcome, Time};
    use serde_json::json;

    use super::AnsweredQuestions;

    fn start(goal: GoalId, primitive: &str) -> Effect {
        let command = Command {
            primitive: primitive.into(),
            args: vec![("question".into(), Value::Text("why?".into()))],
            uses: Arc::from([]),
            manner: None,
            deadline_secs: 60.0,
            motions: Vec::new(),
            leaves: None,
        };
        Effect::Start { goal, node: NodeId(0), command: Arc::new(command), deadline: Time::from_secs(60.0) }
    }

    fn step(event: Event, effects: Vec<Effect>) -> JournalEntry {
        JournalEntry::Step(StepEntry { at: Time::ZERO, event: Some(event), effects })
    }

    #[test]
    fn answered_questions_are_no_matter_of_the_simulator() {
        let goal = |number: u64| -> GoalId { serde_json::from_value(json!(number)).unwrap() };
        let mut questions = AnsweredQuestions::default();
        let asked = step(Event::Begin, vec![start(goal(1), "ask"), start(goal(2), "say")]);
        assert_eq!(questions.without(&asked), step(Event::Begin, vec![start(goal(2), "say")]));
        assert_eq!(questions.refused().count(), 1);
        let ended = |number| {
            let outcome = Outcome::Success(None);
            step(Event::Driver(DriverEvent::Ended { goal: goal(number), outcome }), Vec::new())
        };
        assert_eq!(questions.without(&ended(2)), ended(2));
        assert_eq!(questions.without(&ended(1)), step(Event::Tick, Vec::new()));
        assert_eq!(questions.refused().count(), 0);
    }
}
