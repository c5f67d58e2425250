//! Knowledge from outside of runs: proprioception, statements of people, and assumptions that hold until
//! somebody has looked.

use motet_graph::Value;
use motet_runtime::{Pattern, Query, Truth};
use smol_str::SmolStr;

use super::Knowledge;
use motet_requests::ReportedLocation;

impl Knowledge {
    /// After a step that failed it is unknown where the thing is that it was about. Until somebody looks it
    /// is taken to be
    /// where it was: a hand that slipped left it there. The next plan looks before it takes.
    pub fn presume(&mut self, before: &[ReportedLocation]) {
        for known in before {
            let thing = Pattern::Is(Value::Entity(known.thing.clone()));
            let mut about = self.facts.iter().rev().filter_map(|(query, truth)| match query {
                Query::Fact { fluent, args } if fluent == "at" && args.first() == Some(&thing) => {
                    Some(*truth)
                }
                _ => None,
            });
            if about.next() != Some(Truth::Unknown) {
                continue;
            }
            let place = Pattern::Is(Value::Entity(known.place.clone()));
            for fluent in ["on", "in", "at"] {
                let args = vec![thing.clone(), Pattern::Any];
                self.facts.push((Query::Fact { fluent: fluent.into(), args }, Truth::False));
            }
            for fluent in [known.relation, "at"] {
                let args = vec![thing.clone(), place.clone()];
                self.facts.push((Query::Fact { fluent: fluent.into(), args }, Truth::True));
            }
        }
    }

    /// Takes in what the robot feels of itself: what it holds is nowhere else, and where it stands it stands.
    pub fn notice(&mut self, felt: &[(Query, Truth)]) {
        let robot = Pattern::Is(Value::Entity(SmolStr::new_static("robot")));
        let stands = |query: &Query| match query {
            Query::Fact { fluent, args } => fluent == "at" && args.first() == Some(&robot),
            Query::Measure { .. } | Query::Field { .. } => false,
        };
        if felt.iter().any(|(query, _)| stands(query)) {
            let args = vec![robot.clone(), Pattern::Any];
            self.facts.push((Query::Fact { fluent: "at".into(), args }, Truth::False));
        }
        for (query, truth) in felt {
            let Query::Fact { fluent, args } = query else { continue };
            // That it is nowhere else was said above.
            if stands(query) && *truth != Truth::True {
                continue;
            }
            if let ("holding", Truth::True, Some(thing)) = (fluent.as_str(), truth, args.first()) {
                for place in ["on", "in", "at"] {
                    let args = vec![thing.clone(), Pattern::Any];
                    self.facts.push((Query::Fact { fluent: place.into(), args }, Truth::False));
                }
            }
            self.facts.push((query.clone(), *truth));
        }
    }

    /// Forgets the robot's place at an entity, since something could not be reached from there.
    pub fn doubt_standing(&mut self) {
        let robot = Pattern::Is(Value::Entity(SmolStr::new_static("robot")));
        let args = vec![robot, Pattern::Any];
        self.facts.push((Query::Fact { fluent: "at".into(), args }, Truth::Unknown));
    }

    /// Keeps where things were that are not there any more, so that they can be put back.
    pub(in crate::dialogue) fn remember_moved(
        &mut self,
        before: &[ReportedLocation],
        after: &[ReportedLocation],
    ) {
        for known in before {
            let now = after.iter().find(|now| now.thing == known.thing);
            if now.is_none_or(|now| now.place != known.place) {
                self.came_from.retain(|(thing, _)| *thing != known.thing);
                self.came_from.push((known.thing.clone(), known.place.clone()));
            }
        }
    }

    /// Takes in where somebody says that a thing is.
    pub fn hear(&mut self, said: &ReportedLocation) {
        let thing = Pattern::Is(Value::Entity(said.thing.clone()));
        let mut tell = |fluent: &str, args: Vec<Pattern>, truth| {
            self.facts.push((Query::Fact { fluent: fluent.into(), args }, truth));
        };
        for fluent in ["on", "in", "at"] {
            tell(fluent, vec![thing.clone(), Pattern::Any], Truth::False);
        }
        let place = Pattern::Is(Value::Entity(said.place.clone()));
        for fluent in [said.relation, "at"] {
            tell(fluent, vec![thing.clone(), place.clone()], Truth::True);
        }
        for fluent in ["visible", "located", "clear"] {
            tell(fluent, vec![thing.clone()], Truth::Unknown);
        }
        self.spoken_of.push(said.thing.clone());
    }
}
