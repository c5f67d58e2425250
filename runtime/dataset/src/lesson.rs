//! Lessons, from a file: requests with the steps that they ask for, in constructs of the language that the
//! built-in planner does not write.
//!
//! A drawn lesson is a [`crate::case::Case`] with a policy. It is played and verified like any other.

use motet_robots::card::Robot;
use motet_robots::scene::{Entity, Scene};
use motet_stdlib::lang::kinds;
use motet_syntax::print;
use rand_xoshiro::SplitMix64;
use smol_str::SmolStr;
use thiserror::Error;

use crate::case::{self, Case};
use crate::coverage::{self, Construct};
use crate::random::Draw;

/// The lessons that come with Motet.
pub const OWN: &str = include_str!("../data/lessons.txt");

/// Requests in several wordings, with their steps.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Lesson {
    /// Name in the rows.
    pub name: SmolStr,
    /// Requests with slots.
    pub wordings: Vec<String>,
    /// Steps with slots, in the text syntax.
    pub steps: String,
    /// Constructs of the steps, in the order of reports.
    pub constructs: Vec<Construct>,
}

/// A line that is no part of a lesson.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
#[error("line {line}: {why}")]
pub struct NoLesson {
    /// Line of the file, from 1.
    pub line: usize,
    pub why: String,
}

/// Slots, with the part of the scene that fills them.
const SLOTS: [(&str, Slot); 5] = [
    ("thing", Slot::Thing),
    ("place", Slot::Surface),
    ("other", Slot::Surface),
    ("box", Slot::Closed),
    ("open", Slot::Open),
];

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Slot {
    /// A thing that the robot can carry, on a surface.
    Thing,
    Surface,
    /// A closed container that the robot can open.
    Closed,
    /// The same, open.
    Open,
}

/// Reads lessons. O(bytes).
///
/// ```
/// use motet_dataset::lesson::{OWN, read};
///
/// assert!(read(OWN).is_ok());
/// let wrong = read("lesson: hello\nsay: Say hello.\n").unwrap_err();
/// assert_eq!((wrong.line, wrong.why.as_str()), (1, "the lesson `hello` has no steps"));
/// ```
///
/// # Errors
///
/// The first line that has no place in a lesson, or the first line of a lesson without wordings or steps.
pub fn read(text: &str) -> Result<Vec<Lesson>, NoLesson> {
    let mut lessons: Vec<(usize, Lesson)> = Vec::new();
    let mut is_in_steps = false;
    for (index, line) in text.lines().enumerate() {
        let wrong = |why: &str| NoLesson { line: index + 1, why: why.to_owned() };
        let line = line.trim();
        if line.is_empty() {
            is_in_steps = false;
        } else if let Some(name) = line.strip_prefix("lesson:") {
            is_in_steps = false;
            let name = SmolStr::from(name.trim());
            lessons.push((index + 1, Lesson { name, ..Lesson::default() }));
        } else if line.starts_with('#') && !is_in_steps {
        } else {
            let (_, lesson) = lessons.last_mut().ok_or_else(|| wrong("it is before the first `lesson:`"))?;
            match (is_in_steps, line.strip_prefix("say:")) {
                (true, _) => lesson.steps.push_str(&format!("{line}\n")),
                (false, Some(wording)) => lesson.wordings.push(wording.trim().to_owned()),
                (false, None) if line == "do:" => is_in_steps = true,
                (false, None) => return Err(wrong("it is none of `lesson:`, `say:` and `do:`")),
            }
        }
    }
    for (line, lesson) in &lessons {
        let lacks = match (lesson.wordings.is_empty(), lesson.steps.is_empty()) {
            (false, false) => continue,
            (true, _) => "wordings",
            (false, true) => "steps",
        };
        return Err(NoLesson { line: *line, why: format!("the lesson `{}` has no {lacks}", lesson.name) });
    }
    Ok(lessons
        .into_iter()
        .map(|(_, lesson)| {
            let used = coverage::constructs(&format!("policy p {{\n{}}}\n", without_slots(&lesson.steps)));
            let constructs =
                Construct::ALL.into_iter().filter(|construct| used.contains(construct)).collect();
            Lesson { constructs, ..lesson }
        })
        .collect())
}

/// Steps with something in each slot, so that they can be read.
fn without_slots(steps: &str) -> String {
    let filled = steps.replace("<n>", "2").replace("<secs>", "5").replace("<class>", "thing");
    SLOTS.iter().fold(filled, |steps, (slot, _)| {
        steps.replace(&format!("<{slot}>"), slot).replace(&format!("<{slot}.name>"), slot)
    })
}

/// Draws a lesson with a construct for a robot in a scene; none where the scene has nothing for what was
/// drawn. O(things + lessons).
pub(crate) fn draw(
    robot: &Robot,
    scene: &Scene,
    lessons: &[Lesson],
    construct: Construct,
    draw: &mut SplitMix64,
) -> Option<Case> {
    let with: Vec<&Lesson> = lessons.iter().filter(|lesson| lesson.constructs.contains(&construct)).collect();
    let lesson = *draw.pick(&with)?;
    let (mut request, mut steps) = (draw.pick(&lesson.wordings)?.clone(), lesson.steps.clone());
    let mut taken: Vec<&SmolStr> = Vec::new();
    for (slot, kind) in SLOTS {
        let is_used =
            |text: &str| text.contains(&format!("<{slot}")) || (slot == "thing" && text.contains("<class>"));
        if !is_used(&request) && !is_used(&steps) {
            continue;
        }
        let fits = |entity: &&Entity| fits(robot, scene, entity, kind) && !taken.contains(&&entity.id);
        let found: Vec<&Entity> = scene.entities.values().filter(fits).collect();
        let entity = *draw.pick(&found)?;
        let name = case::the(scene, entity, draw)?;
        let bare = name.trim_start_matches("the ");
        request = case::fill(&request, &format!("<{slot}>"), &name);
        steps = steps.replace(&format!("<{slot}>"), &print::identifier(&entity.id));
        for text in [&mut request, &mut steps] {
            *text = text.replace(&format!("<{slot}.name>"), bare).replace("<class>", &entity.class);
        }
        taken.push(&entity.id);
    }
    let count = (2 + draw.below(3)).to_string();
    let secs = (5 * (1 + draw.below(6))).to_string();
    for text in [&mut request, &mut steps] {
        *text = text.replace("<n>", &count).replace("<secs>", &secs);
    }
    let (name, robot) = (print::identifier(&lesson.name), print::identifier(&robot.name));
    let policy = format!("policy {name} for {robot} {{\n{steps}}}\n");
    Some(Case { task: lesson.name.clone(), ..case::recorded(scene, &request, &policy) })
}

fn fits(robot: &Robot, scene: &Scene, entity: &Entity, slot: Slot) -> bool {
    let is_closet = case::is_closet(entity);
    match slot {
        Slot::Thing => {
            let stands = entity.on.as_ref().is_some_and(|on| !case::is_high(scene, on));
            let is_carried = entity.kind == kinds::OBJECT && !entity.fixed && case::can_carry(robot, entity);
            is_carried && stands
        }
        Slot::Surface => entity.kind == kinds::SURFACE && !case::is_high(scene, &entity.id),
        Slot::Closed => is_closet && entity.open == Some(false),
        Slot::Open => is_closet && entity.open == Some(true),
    }
}

#[cfg(test)]
mod tests {
    use super::{OWN, read};

    #[test]
    fn lessons_own_ones_have_several_wordings_each() {
        let lessons = read(OWN).unwrap();
        assert!(lessons.len() > 20);
        for lesson in lessons {
            assert!(lesson.wordings.len() > 1 && !lesson.steps.is_empty(), "{}", lesson.name);
            assert!(!lesson.constructs.is_empty(), "{} teaches nothing", lesson.name);
        }
    }

    #[test]
    fn lesson_line_that_is_wrong_is_named() {
        for (text, line, words) in [
            ("say: Hello.", 1, "before the first"),
            ("lesson: a\nsay: A.\nwave()\n", 3, "none of"),
            ("lesson: a\ndo:\nhome()\n", 1, "no wordings"),
        ] {
            let wrong = read(text).unwrap_err();
            assert_eq!((wrong.line, wrong.why.contains(words)), (line, true), "{text}: {wrong}");
        }
    }
}
