//! Cases: a request in words for something in a scene, what shall come of it, and what goes wrong on the way.

use motet_planner::dialogue::Kind;
use motet_robots::card::Robot;
use motet_robots::scene::{Entity, Scene};
use motet_sim::{CallFault, CallFaultKind, Faults};
use motet_stdlib::lang::{entities, failures, fluents, kinds, primitives};
use rand_xoshiro::SplitMix64;
use smol_str::SmolStr;

use crate::random::Draw;
use crate::scenery::{HIGH, TRIES, is_bin, spot};
use crate::wordings::{Task, Wordings};

/// One conversation to record: a request, and the failures on its way.
#[derive(Clone, Debug)]
pub struct Case {
    /// Name of the task or lesson.
    pub task: SmolStr,
    /// In which words.
    pub request: String,
    /// A fact, and whether it shall hold at the end; none of a lesson.
    pub goal: Option<(&'static str, Vec<SmolStr>, bool)>,
    /// Failures in their order.
    pub failures: Vec<Kind>,
    /// The scene as it is, where that is not as the robot was told.
    pub real: Scene,
    /// The thing that is elsewhere than the robot was told.
    pub hidden: Option<SmolStr>,
    /// Injected faults of steps.
    pub faults: Faults,
    /// Answers of the person to questions of each kind.
    pub answers: Vec<(Kind, String)>,
    /// The person gives up, since the request cannot be carried out.
    pub is_given_up: bool,
    /// The policy of a lesson.
    pub policy: Option<String>,
    /// Seconds after which the person wants something else, and the words for it.
    pub update: Option<(f64, String)>,
}

/// Number of attempts of a step that merely failed, before a question and once more.
const SLIPS: u32 = 3;
/// Seconds after which a person wants something else: at least, and at most.
const CHANGED_AFTER_SECS: [f64; 2] = [2.0, 14.0];

/// Draws a request with failures on its way for a robot in a scene, or one that is changed; none where the
/// scene has nothing for what was drawn. O(things²).
pub(crate) fn draw(
    robot: &Robot,
    scene: &Scene,
    wordings: &Wordings,
    (failures, is_changed): (&[Kind], bool),
    draw: &mut SplitMix64,
) -> Option<Case> {
    // What is about a place alone neither fails nor changes.
    let fits = |task: &Task| task.carries() || (failures.is_empty() && !is_changed);
    let tasks: Vec<Task> = Task::ALL.into_iter().filter(fits).collect();
    let task = *draw.pick(&tasks)?;
    let said: Vec<&String> =
        wordings.requests.iter().filter(|(known, _)| *known == task).map(|(_, said)| said).collect();
    let wording = (*draw.pick(&said)?).clone();
    if task.carries() {
        carried(robot, scene, wordings, (task, &wording), (failures, is_changed), draw)
    } else {
        plain(scene, task, &wording, draw)
    }
}

/// A recorded request with its policy, in the scene as it was told.
pub(crate) fn recorded(scene: &Scene, request: &str, policy: &str) -> Case {
    Case {
        task: SmolStr::new_static("recorded"),
        request: request.to_owned(),
        goal: None,
        failures: Vec::new(),
        real: scene.clone(),
        hidden: None,
        faults: Faults::default(),
        answers: Vec::new(),
        is_given_up: false,
        policy: Some(policy.to_owned()),
        update: None,
    }
}

/// A request that is about a place alone: nothing goes wrong with it.
fn plain(scene: &Scene, task: Task, wording: &str, draw: &mut SplitMix64) -> Option<Case> {
    let fits = |entity: &&Entity| match task {
        Task::Open => is_closet(entity) && entity.open == Some(false),
        Task::Close => is_closet(entity) && entity.open == Some(true),
        _ => matches!(entity.kind.as_str(), kinds::SURFACE | kinds::PLACE) && !is_high(scene, &entity.id),
    };
    let places: Vec<&Entity> = scene.entities.values().filter(fits).collect();
    let place = draw.pick(&places)?;
    let goal = match task {
        Task::Go => (fluents::AT, vec![SmolStr::new_static(entities::ROBOT), place.id.clone()], true),
        other => (fluents::OPEN, vec![place.id.clone()], other == Task::Open),
    };
    Some(Case {
        task: SmolStr::new_static(task.name()),
        request: fill(wording, "{place}", &the(scene, place, draw)?),
        goal: Some(goal),
        policy: None,
        ..recorded(scene, "", "")
    })
}

fn carried(
    robot: &Robot,
    scene: &Scene,
    wordings: &Wordings,
    (task, wording): (Task, &str),
    (failures, is_changed): (&[Kind], bool),
    draw: &mut SplitMix64,
) -> Option<Case> {
    let objects: Vec<&Entity> =
        scene.entities.values().filter(|entity| entity.kind == kinds::OBJECT && !entity.fixed).collect();
    let is_twin = |one: &&&Entity| objects.iter().any(|other| other.id != one.id && other.class == one.class);
    let asks_which = failures.contains(&Kind::AmbiguousReference);
    // Out of reach is what stands too high, and nothing helps with what is too heavy.
    let is_far = failures.contains(&Kind::NotReachable);
    let stands_high = |one: &&&Entity| one.on.as_ref().is_some_and(|on| is_high(scene, on));
    let is_heavy = |one: &&&Entity| !can_carry(robot, one);
    let fits = |one: &&&Entity| match failures {
        [Kind::NotReachable] => stands_high(one) || is_heavy(one),
        _ => (!asks_which || is_twin(one)) && stands_high(one) == is_far && !is_heavy(one),
    };
    let among: Vec<&Entity> = objects.iter().filter(fits).copied().collect();
    let thing = *draw.pick(&among)?;
    let is_given_up = is_heavy(&&thing);
    let own = the(scene, thing, draw)?;
    let called = if asks_which { format!("the {}", thing.class) } else { own.clone() };
    let holder = match task {
        Task::Put => Some(other_place(scene, kinds::SURFACE, thing, draw)?),
        Task::Stow => Some(other_place(scene, kinds::CONTAINER, thing, draw)?),
        _ => None,
    };
    let place = holder.map(|holder| the(scene, holder, draw)).unwrap_or(Some(String::new()))?;
    let mut request = fill(&fill(wording, "{thing}", &called), "{place}", &place);
    let id = thing.id.clone();
    let mut goal = match (task, holder) {
        (Task::Put, Some(holder)) => (fluents::ON, vec![id, holder.id.clone()], true),
        (Task::Stow, Some(holder)) => (fluents::IN, vec![id, holder.id.clone()], true),
        (Task::Throw, _) => {
            (fluents::IN, vec![id, scene.entities.values().find(|entity| is_bin(entity))?.id.clone()], true)
        }
        (Task::Pick, _) => (fluents::HOLDING, vec![id], true),
        _ => (fluents::AT, vec![id, SmolStr::new_static(entities::USER)], true),
    };
    let mut answers = Vec::new();
    let mut real = scene.clone();
    let mut is_hidden = false;
    for kind in failures {
        let answer = match kind {
            Kind::NotReachable if is_given_up => draw.pick(&wordings.leave)?.clone(),
            Kind::ActionFailed => draw.pick(&wordings.again)?.clone(),
            Kind::AmbiguousReference => own.clone(),
            Kind::AmbiguousTask => {
                let vague = fill(draw.pick(&wordings.vague)?, "{thing}", &called);
                std::mem::replace(&mut request, vague)
            }
            // The person takes it down.
            Kind::NotReachable | Kind::NotFound => {
                let hidden = hide(&mut real, thing, holder, draw)?;
                is_hidden = true;
                fill(draw.pick(&wordings.places)?, "{at}", &hidden)
            }
        };
        answers.push((*kind, answer));
    }
    let faults = if is_given_up { Faults::default() } else { faults(failures) };
    let mut update = None;
    if is_changed {
        let (words, other) = change(scene, wordings, thing, holder, draw)?;
        (update, goal) = (Some((draw.within(CHANGED_AFTER_SECS[0], CHANGED_AFTER_SECS[1]), words)), other);
    }
    let task = SmolStr::new_static(task.name());
    let goal = Some(goal);
    let (failures, hidden) = (failures.to_vec(), is_hidden.then(|| thing.id.clone()));
    Some(Case {
        task,
        request,
        goal,
        failures,
        real,
        hidden,
        faults,
        answers,
        is_given_up,
        policy: None,
        update,
    })
}

/// Fact that shall hold, as a case has it.
type Goal = (&'static str, Vec<SmolStr>, bool);

/// Another wish for a thing that is being carried, and the fact that it makes.
fn change(
    scene: &Scene,
    wordings: &Wordings,
    thing: &Entity,
    holder: Option<&Entity>,
    draw: &mut SplitMix64,
) -> Option<(String, Goal)> {
    let (said, own) = (draw.pick(&wordings.instead)?, the(scene, thing, draw)?);
    let said = fill(said, "{thing}", &own);
    if !said.contains("{place}") {
        return Some((
            said,
            (fluents::AT, vec![thing.id.clone(), SmolStr::new_static(entities::USER)], true),
        ));
    }
    let place = other_place(scene, kinds::SURFACE, thing, draw)
        .filter(|place| holder.is_none_or(|holder| holder.id != place.id))?;
    let said = fill(&said, "{place}", &the(scene, place, draw)?);
    Some((said, (fluents::ON, vec![thing.id.clone(), place.id.clone()], true)))
}

/// Faults of the steps that pick up.
fn faults(failures: &[Kind]) -> Faults {
    let fails = |nth: u32, kind: &'static str| CallFault {
        primitive: SmolStr::new_static(primitives::PICK),
        nth: Some(nth),
        then: CallFaultKind::Fails(kind.into()),
    };
    let calls = if failures.contains(&Kind::ActionFailed) {
        (1..=SLIPS).map(|nth| fails(nth, failures::SLIPPED)).collect()
    } else {
        Vec::new()
    };
    Faults { calls, ..Faults::default() }
}

/// Puts a thing where the robot does not think that it is, and says where.
fn hide(real: &mut Scene, thing: &Entity, goal: Option<&Entity>, draw: &mut SplitMix64) -> Option<String> {
    let is_other = |place: &Entity| {
        let is_goal = goal.is_some_and(|goal| goal.id == place.id);
        let is_there = [&thing.on, &thing.inside].into_iter().flatten().any(|id| *id == place.id);
        !is_goal && !is_there && !place.categories.iter().any(|category| category == HIGH)
    };
    let fits = |place: &&Entity| (place.kind == kinds::SURFACE || is_closet(place)) && is_other(place);
    let places: Vec<&Entity> = real.entities.values().filter(fits).collect();
    let place = (*draw.pick(&places)?).clone();
    let called = the(real, &place, draw)?;
    let size = thing.extents()?;
    let pose = (0..TRIES).find_map(|_| spot(real, &place, size, draw))?;
    let hidden = real.entities.get_mut(&thing.id)?;
    (hidden.on, hidden.inside, hidden.pose) = (None, None, Some(pose));
    hidden.visible = Some(false);
    if place.kind == kinds::CONTAINER {
        hidden.inside = Some(place.id);
        Some(format!("in {called}"))
    } else {
        hidden.on = Some(place.id);
        Some(format!("on {called}"))
    }
}

/// A place of a kind where a thing is not yet.
fn other_place<'r>(
    scene: &'r Scene,
    kind: &str,
    thing: &Entity,
    draw: &mut SplitMix64,
) -> Option<&'r Entity> {
    let fits = |place: &&Entity| {
        let is_there = [&thing.on, &thing.inside].into_iter().flatten().any(|id| *id == place.id);
        let is_low = !place.categories.iter().any(|category| category == HIGH);
        place.kind == kind && !is_there && is_low && (kind == kinds::SURFACE || is_closet(place))
    };
    let places: Vec<&Entity> = scene.entities.values().filter(fits).collect();
    draw.pick(&places).copied()
}

/// True for a container that the robot can open and close.
pub(crate) fn is_closet(entity: &Entity) -> bool {
    entity.kind == kinds::CONTAINER && entity.travel.is_some() && entity.locked != Some(true)
}

/// True if an entity of a scene is a shelf that no robot reaches.
pub(crate) fn is_high(scene: &Scene, id: &SmolStr) -> bool {
    let is_it = |entity: &Entity| entity.categories.iter().any(|category| category == HIGH);
    scene.entities.get(id).is_some_and(is_it)
}

/// True if a hand of a robot can lift and hold a thing.
pub(crate) fn can_carry(robot: &Robot, thing: &Entity) -> bool {
    robot.hands.values().any(|hand| {
        thing.mass_kg.is_none_or(|mass| mass <= hand.payload_kg)
            && thing.width().is_none_or(|width| width <= hand.opening_m)
    })
}

/// Name of an entity in speech, with its article: one of the names that nothing else in the scene has.
pub(crate) fn the(scene: &Scene, entity: &Entity, draw: &mut SplitMix64) -> Option<String> {
    let own = entity.names.iter().chain([&entity.class]).filter(|name| !name.is_empty());
    let names: Vec<&SmolStr> = own.filter(|name| scene.matches(name).len() == 1).collect();
    draw.pick(&names).map(|name| format!("the {name}"))
}

/// Fills a hole, in upper case where the wording begins with it.
pub(crate) fn fill(wording: &str, hole: &str, with: &str) -> String {
    match wording.strip_prefix(hole) {
        Some(rest) => {
            let mut letters = with.chars();
            let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
            format!("{first}{}{}", letters.as_str(), rest.replace(hole, with))
        }
        None => wording.replace(hole, with),
    }
}
