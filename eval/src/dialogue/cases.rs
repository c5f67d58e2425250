//! The cases: every wording in every room, with every kind of failure that it can have.

use motet_planner::dialogue::Kind;
use motet_robots::scene::Scene;

use super::objects::{CaseThing, Objects, Swap};
use super::rooms::{Named, ROOMS, Room};

/// One case.
#[derive(Clone, Debug, Default)]
pub struct Case {
    /// The robot.
    pub robot: String,
    /// The room.
    pub scene: String,
    /// The task of the wording.
    pub task: String,
    /// Request of the person.
    pub request: String,
    /// Facts that shall hold at the end.
    pub goal: Vec<(String, Vec<String>)>,
    /// Fact that shall not hold at the end, though it does at the start.
    pub undo: Option<(String, Vec<String>)>,
    /// Failures in order; one for each round of recovery.
    pub failures: Vec<Kind>,
    /// The thing that is asked for.
    thing: String,
    /// Unseen things in the room.
    swaps: Vec<Swap>,
    /// Its true place, where it is not found.
    hidden: Option<(&'static str, String)>,
    /// Answers of the person to the question of each kind.
    answers: Vec<(Kind, String)>,
}

/// Failures of the cases: none, each kind by itself, and two after each other.
const TROUBLES: &[&[Kind]] = &[
    &[],
    &[Kind::NotFound],
    &[Kind::NotReachable],
    &[Kind::AmbiguousReference],
    &[Kind::AmbiguousTask],
    &[Kind::ActionFailed],
    &[Kind::AmbiguousReference, Kind::NotFound],
    &[Kind::NotFound, Kind::ActionFailed],
    &[Kind::AmbiguousTask, Kind::NotReachable],
];

/// Sayings of a person beside the task, for files without their own: where a thing is, `{at}` being the place
/// with its preposition, that it shall be tried again, yes, and that something shall be done with `{thing}`.
const WHERE: &[&str] =
    &["It is {at}.", "I put it {at}.", "Look {at}.", "It should be {at}, I think.", "{at}"];
const AGAIN: &[&str] = &["Please try again.", "Try once more.", "yes, try again", "Again, please."];
const YES: &[&str] = &["Yes.", "yes please", "Please try again.", "sure"];
const VAGUE: &[&str] = &["Do something about {thing}."];

/// Sayings of a person beside the task.
struct Sayings<'w> {
    places: Vec<&'w str>,
    again: Vec<&'w str>,
    yes: Vec<&'w str>,
    vague: Vec<&'w str>,
}

impl<'w> Sayings<'w> {
    /// Those of a file's lines; where it has none of a kind, the ones above.
    fn of(lines: &[(&str, &'w str)]) -> Self {
        let of = |name: &str, or: &[&'static str]| {
            let own: Vec<&'w str> =
                lines.iter().filter(|(known, _)| *known == name).map(|(_, said)| *said).collect();
            if own.is_empty() { or.to_vec() } else { own }
        };
        Self {
            places: of("where", WHERE),
            again: of("again", AGAIN),
            yes: of("yes", YES),
            vague: of("vague", VAGUE),
        }
    }
}

/// All cases of a wordings file, in order: each wording without a failure, and with one of the troubles in
/// turn. A file may have answers beside the tasks: `where`, `again`, `yes`, and requests that do not say what
/// to do: `vague`.
#[must_use]
pub fn cases(wordings: &str, objects: Objects) -> Vec<Case> {
    let lines = wordings.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let lines: Vec<(&str, &str)> = lines
        .filter_map(|line| line.split_once(':').map(|(name, said)| (name.trim(), said.trim())))
        .collect();
    let sayings = Sayings::of(&lines);
    let tasks = lines.iter().filter(|(name, _)| !matches!(*name, "where" | "again" | "yes" | "vague"));
    let mut cases = Vec::new();
    for (index, (task, wording)) in tasks.enumerate() {
        for (number, robot) in ["hsr", "anymal_z1"].into_iter().enumerate() {
            for room in ROOMS {
                let turn = index + number;
                cases.extend(case((robot, room, objects), (task, wording), turn, &[], &sayings));
                let carries = !matches!(*task, "go" | "open" | "close");
                if carries {
                    let trouble = TROUBLES.get(1 + turn % (TROUBLES.len() - 1)).copied().unwrap_or_default();
                    cases.extend(case((robot, room, objects), (task, wording), turn, trouble, &sayings));
                }
            }
        }
    }
    cases
}

fn pick<T: Copy>(from: &[T], turn: usize) -> Option<T> {
    from.get(turn % from.len().max(1)).copied()
}

fn case(
    (robot, room, objects): (&str, &Room, Objects),
    (task, wording): (&str, &str),
    turn: usize,
    failures: &[Kind],
    sayings: &Sayings<'_>,
) -> Option<Case> {
    // The trouble comes round with the turn: what is said then has to go on from one round to the next.
    let said = |from: &[&str]| pick(from, turn + turn / (TROUBLES.len() - 1)).map(str::to_owned);
    let mut thing = objects.thing(room, turn)?;
    let mut answers = Vec::new();
    if failures.contains(&Kind::AmbiguousReference) {
        let told;
        (thing, told) = objects.shared(room, turn)?;
        answers.push((Kind::AmbiguousReference, told.get(turn % told.len())?.clone()));
    }
    let CaseThing { id, name, swaps } = thing;
    let place: Named = match task {
        "put" => pick(room.surfaces, turn)?,
        "stow" | "open" | "close" => pick(room.containers, turn)?,
        "go" => pick(room.places, turn)?,
        _ => ("user", "me"),
    };
    let mut request = wording.replace("{thing}", &name).replace("{place}", place.1);
    let atom = |fluent: &str, args: &[&str]| {
        (fluent.to_owned(), args.iter().map(|arg| (*arg).to_owned()).collect::<Vec<_>>())
    };
    let goal = match task {
        "bring" => vec![atom("at", &[&id, "user"])],
        "put" => vec![atom("on", &[&id, place.0])],
        "stow" => vec![atom("in", &[&id, place.0])],
        "throw" => vec![atom("in", &[&id, room.bin])],
        "go" => vec![atom("at", &["robot", place.0])],
        "pick" => vec![atom("holding", &[&id])],
        "close" => Vec::new(),
        _ => vec![atom("open", &[place.0])],
    };
    if failures.contains(&Kind::AmbiguousTask) {
        // Something shall be done with the thing, and it is not said what; the answer is the wording.
        answers.push((Kind::AmbiguousTask, request));
        request = said(&sayings.vague)?.replace("{thing}", &name);
    }
    let mut hidden = None;
    if failures.contains(&Kind::NotFound) {
        let container = pick(room.containers, turn + 1).filter(|container| container.0 != place.0);
        let (fluent, spot) = match container {
            Some(container) => ("in", container),
            None => (
                "on",
                pick(room.surfaces, turn)
                    .filter(|surface| surface.0 != place.0)
                    .or(pick(room.surfaces, turn + 1))?,
            ),
        };
        let at = format!("{fluent} {}", spot.1);
        answers.push((Kind::NotFound, said(&sayings.places)?.replace("{at}", &at)));
        hidden = Some((fluent, spot.0.to_owned()));
    }
    if failures.contains(&Kind::NotReachable) {
        answers.push((Kind::NotReachable, said(&sayings.again)?));
    }
    if failures.contains(&Kind::ActionFailed) {
        answers.push((Kind::ActionFailed, said(&sayings.yes)?));
    }
    Some(Case {
        robot: robot.to_owned(),
        scene: room.scene.to_owned(),
        task: task.to_owned(),
        request,
        goal,
        undo: (task == "close").then(|| atom("open", &[place.0])),
        failures: failures.to_vec(),
        thing: id,
        swaps,
        hidden,
        answers,
    })
}

impl Case {
    /// The room as the robot is told that it is.
    pub(crate) fn told(&self, mut scene: Scene) -> Scene {
        self.swaps.iter().for_each(|swap| swap.make(&mut scene));
        if let Some((_, args)) = &self.undo
            && let Some(entity) = args.first().and_then(|id| scene.entities.get_mut(id.as_str()))
        {
            entity.open = Some(true);
        }
        scene
    }

    /// The room as it is, where that is not as the robot was told.
    pub(crate) fn real(&self, told: &Scene) -> Scene {
        let mut real = told.clone();
        if let (Some((fluent, spot)), Some(thing)) =
            (&self.hidden, real.entities.get_mut(self.thing.as_str()))
        {
            (thing.on, thing.inside, thing.pose) = (None, None, None);
            thing.visible = Some(false);
            match *fluent {
                "in" => thing.inside = Some(spot.as_str().into()),
                _ => thing.on = Some(spot.as_str().into()),
            }
        }
        real
    }

    /// Faults of the steps.
    pub(crate) fn faults(&self) -> String {
        let fails = |nth: u32, kind: &str| {
            format!(r#"{{"primitive": "pick", "nth": {nth}, "then": {{"fails": "{kind}"}}}}"#)
        };
        let calls: Vec<String> = if self.failures.contains(&Kind::NotReachable) {
            vec![fails(1, "unreachable")]
        } else if self.failures.contains(&Kind::ActionFailed) {
            (1..=3).map(|nth| fails(nth, "slipped")).collect()
        } else {
            Vec::new()
        };
        format!(r#"{{"calls": [{}]}}"#, calls.join(", "))
    }

    /// Answers of the person.
    #[must_use]
    pub fn answers(&self) -> Vec<(Kind, String)> {
        self.answers.clone()
    }
}
