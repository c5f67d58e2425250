//! Datasets: scenes are varied, cases drawn in them and played, and the turns kept that hold what they
//! promise.

use std::collections::BTreeMap;
use std::sync::Arc;

use indexmap::IndexMap;
use motet_geometry::planning::SearchBudget;
use motet_robots::scene::Scene;
use rand_xoshiro::SplitMix64;
use rustc_hash::FxHashSet;
use serde::{Deserialize, Serialize};
use smol_str::{SmolStr, ToSmolStr, format_smolstr};

use crate::format::{self, About, Row, RowFormat, UPDATE};
use crate::lesson::{self, Lesson};
use crate::picture::{Picture, Pictures};
use crate::play::{IN_VIEW, play};
use crate::random::{self, Draw as _};
use crate::sampling::{CaseKind, StratifiedSampler};
use crate::testbed::{Body, Posture, Testbed};
use crate::wordings::Wordings;
use crate::{case, kept, lint, scenery};

/// Order for a dataset.
#[derive(Clone, Debug)]
pub struct Order {
    /// The same seed gives the same dataset.
    pub seed: u64,
    pub bodies: Vec<Body>,
    /// Scenes by name, to be varied in turn.
    pub bases: Vec<(SmolStr, Scene)>,
    /// Things that may stand in them beside their own.
    pub things: Scene,
    /// Wordings of requests and answers.
    pub wordings: Wordings,
    /// Instructions that no row may have: those of evaluations.
    pub held_out: HeldOut,
    /// Lessons beside the requests; the form of InteLiPlan has none.
    pub lessons: Vec<Lesson>,
    /// Number of varied scenes.
    pub scenes: usize,
    /// Number of cases for each robot in each scene.
    pub cases: usize,
    /// Share of the varied scenes that is kept for tests, between 0 and 1.
    pub test: f64,
    /// Budget of a motion search; without one, no motion is searched.
    pub effort: Option<SearchBudget>,
    /// In which form the rows will be written: what that cannot say is left out.
    pub form: RowFormat,
    /// Images of the rows. The form of InteLiPlan has none.
    pub pictures: Pictures,
}

/// Instructions that no row may have. Case, white space and punctuation count for nothing.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct HeldOut(FxHashSet<String>);

impl HeldOut {
    /// The instructions of the evaluations that come with Motet.
    #[must_use]
    pub fn own() -> Self {
        include_str!("../data/held_out.txt").lines().filter(|line| !line.starts_with('#')).collect()
    }

    /// True if an instruction is held out.
    #[must_use]
    pub fn has(&self, instruction: &str) -> bool {
        self.0.contains(&lint::normal(instruction))
    }
}

impl<'t> FromIterator<&'t str> for HeldOut {
    fn from_iter<T: IntoIterator<Item = &'t str>>(instructions: T) -> Self {
        Self(instructions.into_iter().map(lint::normal).filter(|one| !one.is_empty()).collect())
    }
}

/// Rows of one varied scene.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SceneRows {
    rows: Vec<Row>,
    #[serde(with = "kept::scenes")]
    scenes: IndexMap<SmolStr, Scene>,
    postures: IndexMap<SmolStr, Posture>,
    #[serde(with = "kept::images")]
    pictures: BTreeMap<SmolStr, Picture>,
    dropped: BTreeMap<SmolStr, usize>,
}

/// A dataset in memory, before it is written.
#[derive(Clone, Debug, Default)]
pub struct Dataset {
    /// To learn from.
    pub train: Vec<Row>,
    /// To test with, in scenes that are not among those of `train`.
    pub test: Vec<Row>,
    /// Every scene of a row, by name.
    pub scenes: IndexMap<SmolStr, Scene>,
    /// State of the robot's body in scenes where it is not that of the card.
    pub postures: IndexMap<SmolStr, Posture>,
    /// The picture of each row that has one, by its path: PNGs.
    pub pictures: BTreeMap<SmolStr, Arc<[u8]>>,
    /// Number of dropped cases and turns by reason.
    pub dropped: BTreeMap<SmolStr, usize>,
}

impl Order {
    /// Images that the form allows.
    const fn shown(&self) -> Pictures {
        match self.form {
            RowFormat::InteLiPlan => Pictures::None,
            RowFormat::Trl | RowFormat::LlamaFactory | RowFormat::QwenVl => self.pictures,
        }
    }

    /// Lessons that the form allows: a list of actions has no constructs.
    fn taught(&self) -> &[Lesson] {
        match self.form {
            RowFormat::InteLiPlan => &[],
            RowFormat::Trl | RowFormat::LlamaFactory | RowFormat::QwenVl => &self.lessons,
        }
    }
}

/// Light of pictures: least and greatest, where 1 is that of the camera.
const LIGHT: [f64; 2] = [0.5, 1.2];
/// Number of draws of a conversation of a kind in a scene that has nothing for the first one.
const DRAWS: usize = 8;
/// Number of conversations of a kind that are played until one goes as it was drawn, before another kind is.
const PLAYS: usize = 3;
/// Number of kinds that are tried for one conversation.
const KINDS: usize = 3;

/// Makes the rows of one varied scene, by its number below [`Order::scenes`]. Each number by itself gives the
/// same, so they can be made in any order.
#[must_use]
pub fn part(order: &Order, number: usize) -> SceneRows {
    let mut part = SceneRows::default();
    let Some((name, base)) = order.bases.get(number % order.bases.len().max(1)) else { return part };
    let seed = u64::try_from(number).unwrap_or(u64::MAX);
    let mut draw = random::part(order.seed, seed);
    let told = scenery::vary(base, &order.things, &mut draw);
    let name = format_smolstr!("{name}-{}", number + 1);
    let mut sampler = StratifiedSampler::new(order.seed, order.taught());
    for (index, body) in order.bodies.iter().enumerate() {
        let testbed = match Testbed::new(body, (&told, &Posture::new()), order.effort) {
            Ok(testbed) => testbed,
            Err(_) => {
                part.leave_out("the robot cannot be in the scene");
                continue;
            }
        };
        for case in 0..order.cases {
            let light = draw.within(LIGHT[0], LIGHT[1]);
            let place = (number * order.bodies.len() + index) * order.cases + case;
            for kind in 0..KINDS {
                // What a scene cannot give gives way to what comes next.
                let wish = sampler.at(place + kind);
                if part.conversation(order, (body, &testbed, &name), (wish, light), &mut draw) {
                    break;
                }
            }
        }
    }
    part
}

/// Request of a recorded conversation that was done by its first plan.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct RecordedPlan {
    pub request: String,
    /// The policy, in either syntax.
    pub policy: String,
}

/// Makes rows of recorded plans, in the first scene and for the first robot of the order. Each is played in
/// simulation and verified like a generated one.
#[must_use]
pub fn recorded(order: &Order, plans: &[RecordedPlan]) -> SceneRows {
    let mut part = SceneRows::default();
    let (Some((name, scene)), Some(body)) = (order.bases.first(), order.bodies.first()) else { return part };
    let Ok(testbed) = Testbed::new(body, (scene, &Posture::new()), order.effort) else {
        part.leave_out("the robot cannot be in the scene");
        return part;
    };
    for plan in plans {
        let case = case::recorded(scene, &plan.request, &plan.policy);
        match play(&case, &testbed, (order.shown(), 1.0)) {
            Ok(turns) => {
                for (turn, played) in turns.into_iter().enumerate() {
                    part.turn(order, body, &testbed, name, &case, turn, played);
                }
            }
            Err(why) => part.leave_out(why),
        }
    }
    part
}

impl SceneRows {
    fn leave_out(&mut self, why: &'static str) {
        *self.dropped.entry(SmolStr::new_static(why)).or_default() += 1;
    }

    /// Draws conversations of a kind and plays them until one gives a row. False if none does.
    fn conversation(
        &mut self,
        order: &Order,
        (body, testbed, name): (&Body, &Testbed, &SmolStr),
        (wish, light): (CaseKind, f64),
        draw: &mut SplitMix64,
    ) -> bool {
        let mut plays = 0;
        for _ in 0..DRAWS {
            if plays == PLAYS {
                return false;
            }
            let drawn = (0..DRAWS).find_map(|_| {
                let mut request = |failures, is_changed| {
                    case::draw(&body.robot, &testbed.scene, &order.wordings, (failures, is_changed), draw)
                };
                match wish {
                    CaseKind::Changed => request(&[], true),
                    CaseKind::Request(failures) => request(failures, false),
                    CaseKind::Lesson(construct) => {
                        lesson::draw(&body.robot, &testbed.scene, order.taught(), construct, draw)
                    }
                }
            });
            let Some(case) = drawn else {
                self.leave_out("the scene has nothing for it");
                return false;
            };
            match play(&case, testbed, (order.shown(), light)) {
                Ok(turns) => {
                    let before = self.rows.len();
                    for (turn, played) in turns.into_iter().enumerate() {
                        self.turn(order, body, testbed, name, &case, turn, played);
                    }
                    if self.rows.len() > before {
                        return true;
                    }
                    plays += 1;
                }
                Err(why) => {
                    plays += usize::from(why != IN_VIEW);
                    self.leave_out(why);
                }
            }
        }
        false
    }

    /// Keeps a turn as a row where its answer can be carried out in the scene as it is then.
    #[expect(clippy::too_many_arguments, reason = "what a turn is about")]
    fn turn(
        &mut self,
        order: &Order,
        body: &Body,
        testbed: &Testbed,
        scene: &SmolStr,
        case: &case::Case,
        turn: usize,
        played: crate::play::Turn,
    ) {
        if order.held_out.has(&played.request) {
            self.leave_out("the instruction is one of an evaluation");
            return;
        }
        let Ok(policy) = played.policy else {
            self.leave_out("the plan has no place on the model surface");
            return;
        };
        let is_start = played.scene == testbed.scene && played.posture == testbed.posture;
        let is_update = turn > 0 && case.update.is_some();
        let named = |picture: Picture| (picture.path(scene, &body.robot.name), picture);
        let pictures: Vec<(SmolStr, Picture)> = played.pictures.into_iter().map(named).collect();
        let mut row = Row {
            about: About {
                robot: body.robot.name.to_smolstr(),
                scene: scene.clone(),
                task: if is_update { SmolStr::new_static(UPDATE) } else { case.task.clone() },
                failures: case.failures.clone(),
                turn,
            },
            system: played.system,
            user: played.user,
            images: pictures.iter().map(|(path, _)| path.clone()).collect(),
            policy,
            request: played.request,
            history: played.history,
            vision: played.vision,
            feasibility: played.feasibility,
            actions: played.actions,
        };
        let Ok(read) = format::read(&format::write(&row, order.form)) else {
            self.leave_out("the form cannot say it");
            return;
        };
        let own = if is_start {
            None
        } else {
            testbed.elsewhere(body, (&played.scene, &played.posture), order.effort).ok()
        };
        let fault = match &own {
            Some(own) => lint::fault(own, &read.target),
            None if is_start => lint::fault(testbed, &read.target),
            None => Some(String::new()),
        };
        if fault.is_some() {
            self.leave_out("the plan cannot run in the scene as it is known then");
            return;
        }
        if !is_start {
            let posture = |name: &SmolStr| self.postures.get(name).cloned().unwrap_or_default();
            let is_it = |(name, scene): &(&SmolStr, &Scene)| {
                **scene == played.scene && posture(name) == played.posture
            };
            row.about.scene = self
                .scenes
                .iter()
                .find(is_it)
                .map(|(name, _)| name.clone())
                .unwrap_or_else(|| format_smolstr!("{scene}.{}", self.scenes.len() + 1));
        }
        self.scenes.entry(row.about.scene.clone()).or_insert(played.scene);
        if !played.posture.is_empty() {
            self.postures.entry(row.about.scene.clone()).or_insert(played.posture);
        }
        self.pictures.extend(pictures);
        self.rows.push(row);
    }
}

/// Puts parts together, in the order of their numbers, which come with them: a row whose input is there
/// already is left out, and each varied scene is either for learning or for testing. Some of the parts give
/// some of the rows, each in the file where it is with all parts.
#[must_use]
pub fn gather(order: &Order, parts: Vec<(usize, SceneRows)>) -> Dataset {
    let mut dataset = Dataset::default();
    let is_test = tested(order);
    let mut inputs: FxHashSet<String> = FxHashSet::default();
    for (number, mut part) in parts {
        let Some(is_test) = is_test.get(number).copied() else { continue };
        for (why, count) in part.dropped {
            *dataset.dropped.entry(why).or_default() += count;
        }
        let rows = if is_test { &mut dataset.test } else { &mut dataset.train };
        for row in part.rows {
            let input = format::read(&format::write(&row, order.form)).map(|read| lint::normal(&read.input));
            if !inputs.insert(input.unwrap_or_default()) {
                *dataset
                    .dropped
                    .entry(SmolStr::new_static("the same input is there already"))
                    .or_default() += 1;
                continue;
            }
            if let Some(scene) = part.scenes.get(&row.about.scene) {
                dataset.scenes.entry(row.about.scene.clone()).or_insert_with(|| scene.clone());
            }
            if let Some(posture) = part.postures.get(&row.about.scene) {
                dataset.postures.entry(row.about.scene.clone()).or_insert_with(|| posture.clone());
            }
            for path in &row.images {
                if let Some((path, picture)) = part.pictures.remove_entry(path) {
                    dataset.pictures.insert(path, picture.0);
                }
            }
            rows.push(row);
        }
    }
    dataset
}

/// Chooses the scenes that are kept for tests: at least one if the share is above 0, and never all.
fn tested(order: &Order) -> Vec<bool> {
    let wanted = (order.test.clamp(0.0, 1.0) * order.scenes as f64).round() as usize;
    let least = usize::from(order.test > 0.0);
    let count = wanted.max(least).min(order.scenes.saturating_sub(1));
    let mut is_test: Vec<bool> = (0..order.scenes).map(|number| number < count).collect();
    random::part(order.seed, u64::MAX).shuffle(&mut is_test);
    is_test
}
