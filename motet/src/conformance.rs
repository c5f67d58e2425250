//! Check of a driver over the driver protocol: it is led through the scenes of the conformance suite.

use std::cell::RefCell;
use std::collections::{BTreeSet, VecDeque};
use std::ops::ControlFlow;
use std::rc::Rc;

use motet_graph::Graph;
use motet_host::remote::{DriverLog, LineFrom, RemoteDriver};
use motet_runtime::conformance::{ConformanceSubject, check_perception, check_scenes};
use motet_runtime::{
    Answer, Command, Driver, DriverClock, DriverEvent, Effect, Engine, Event, GoalId, Pattern, Query,
    StartState, Time,
};
use motet_stdlib::lang;
use smol_str::SmolStr;

use crate::printable::escape;

/// Call that harms nothing and nobody, as the steps of a policy.
pub const SAY: &str = "{ say(\"This is a test.\") }";
/// Seconds within which a driver answers a question, and nothing changes of its own accord.
const MOMENT_SECS: f64 = 1.0;
/// Seconds that a call may take on the wall.
const PATIENCE_SECS: f64 = 5.0;
/// The most lines that are shown of a scene, and the most characters of a line.
const SHOWN: (usize, usize) = (24, 240);

/// Scene through which a driver was led.
#[derive(Clone, Debug)]
pub struct DriverScene {
    pub name: &'static str,
    /// Broken laws, each with what happened.
    pub broken: Vec<(&'static str, String)>,
    /// Last messages of the scene: `>` from the host, `<` from the driver, `#` notes.
    pub messages: VecDeque<String>,
}

/// Result of a check.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DriverResult {
    /// Name that the driver gave itself.
    pub driver: String,
    /// Number of broken laws.
    pub broken: usize,
}

/// Leads a driver through all scenes with a call, and gives each scene to `each`, which may break off.
/// `connect` makes a driver that has done nothing, and greets it with a log; the first one is only asked for
/// its name and its clock, with `log`. A call may take `patience_secs`, or else 5 s on the wall, or its
/// deadline on a driver that owns the clock.
///
/// # Errors
///
/// A clause that says why the driver cannot be reached, that it does not have the primitive of the call, or
/// why the patience is no span.
pub fn check(
    command: Command,
    patience_secs: Option<f64>,
    log: Box<dyn DriverLog>,
    connect: &mut dyn FnMut(Box<dyn DriverLog>) -> Result<RemoteDriver, String>,
    each: &mut dyn FnMut(DriverScene) -> ControlFlow<()>,
) -> Result<DriverResult, String> {
    let greeted = connect(log)?;
    let is_virtual = greeted.capabilities().clock == DriverClock::Driver;
    let driver = escape(&greeted.welcome().driver);
    if !greeted.capabilities().primitives.contains(&command.primitive) {
        return Err(format!("{driver} does not have `{}`: check it with another call", command.primitive));
    }
    // In real time no two looks are at the same time.
    let sees = is_virtual && (greeted.capabilities().look || greeted.capabilities().detections);
    drop(greeted);
    let patience = match (patience_secs, is_virtual) {
        (Some(secs), _) => secs,
        (None, true) => command.deadline_secs,
        (None, false) => PATIENCE_SECS,
    };
    if !(patience.is_finite() && patience > 0.0) {
        return Err("`--patience` is a number of seconds above 0".to_owned());
    }
    let transcript = Rc::new(RefCell::new(Transcript::default()));
    let mut fresh = || -> Box<dyn Driver> {
        match connect(Box::new(TranscriptLog(Rc::clone(&transcript)))) {
            Ok(driver) => Box::new(driver),
            Err(why) => {
                transcript.borrow_mut().unreachable = Some(why);
                Box::new(NoDriver)
            }
        }
    };
    let mut subject = ConformanceSubject {
        fresh: &mut fresh,
        command,
        query: question(),
        moment: Time::from_secs(MOMENT_SECS),
        patience: Time::from_secs(patience),
        is_virtual,
    };
    let (mut broken, mut unreachable, mut is_over) = (0, None, false);
    check_scenes(&mut subject, &mut |name, violations| {
        let transcript = transcript.take();
        if transcript.unreachable.is_some() {
            unreachable = transcript.unreachable;
            return ControlFlow::Break(());
        }
        let laws = violations.iter().map(|broken| (broken.law.text(), broken.told.clone()));
        let others = transcript.breaches.into_iter().map(|told| ("a driver reports only true facts", told));
        let scene = DriverScene { name, broken: laws.chain(others).collect(), messages: transcript.lines };
        broken += scene.broken.len();
        let goes_on = each(scene);
        is_over = goes_on.is_break();
        goes_on
    });
    if let Some(why) = unreachable {
        return Err(why);
    }
    if sees && !is_over {
        let mut eyes = connect(Box::new(TranscriptLog(Rc::clone(&transcript))))?;
        let told = check_perception(&mut eyes, &[Time::ZERO]);
        let Transcript { lines, breaches, .. } = transcript.take();
        let laws =
            told.into_iter().chain(breaches).map(|told| ("a driver's view is current and possible", told));
        let scene = DriverScene { name: "a look", broken: laws.collect(), messages: lines };
        broken += scene.broken.len();
        let _: ControlFlow<()> = each(scene);
    }
    Ok(DriverResult { driver, broken })
}

/// First call of a policy. What the policy observes before it is answered with true, as by a robot in the
/// state that the call needs.
///
/// # Errors
///
/// A clause that says why there is none.
pub fn first_call(graph: &Graph) -> Result<Command, String> {
    let mut engine = Engine::new(graph.clone(), &StartState::default())
        .map_err(|errors| format!("the graph is not valid: {errors:?}"))?;
    let (mut effects, mut asked) = (Vec::new(), Vec::new());
    engine.handle(Time::ZERO, Event::Begin, &mut effects);
    loop {
        let mut news = Vec::new();
        for effect in effects.drain(..) {
            match effect {
                Effect::Start { command, .. } => return Ok(Command::clone(&command)),
                Effect::Observe { query } if !asked.contains(&query) => news.push(query),
                _ => {}
            }
        }
        if news.is_empty() {
            break;
        }
        for query in news {
            let answer = Event::Noticed { query: Query::clone(&query), answer: Answer::Truth(true) };
            engine.handle(Time::ZERO, answer, &mut effects);
            asked.push(query);
        }
    }
    Err(match asked.last() {
        None => "the policy does not begin with a call".to_owned(),
        Some(query) => {
            format!("the policy observes `{query}` before its first call, and it has to be false or a number")
        }
    })
}

/// Something that every robot with a hand observes, without the name of an entity.
fn question() -> Query {
    Query::Fact { fluent: SmolStr::new_static(lang::fluents::HOLDING), args: vec![Pattern::Any] }
}

/// Messages of a scene, and the promises that were broken besides the laws.
#[derive(Default)]
struct Transcript {
    lines: VecDeque<String>,
    breaches: BTreeSet<String>,
    /// Reason why the driver could not be reached.
    unreachable: Option<String>,
}

impl Transcript {
    fn push(&mut self, mark: char, line: &str) {
        let (most, letters) = SHOWN;
        if self.lines.len() == most {
            self.lines.pop_front();
        }
        let more = if line.chars().nth(letters).is_some() { "…" } else { "" };
        let beginning: String = line.chars().take(letters).collect();
        self.lines.push_back(format!("{mark} {}{more}", escape(&beginning)));
    }
}

/// Log that writes a transcript.
struct TranscriptLog(Rc<RefCell<Transcript>>);

impl DriverLog for TranscriptLog {
    fn note(&mut self, text: &str) {
        self.0.borrow_mut().push('#', text);
    }

    fn breach(&mut self, text: &str) {
        self.note(text);
        self.0.borrow_mut().breaches.insert(text.to_owned());
    }

    fn line(&mut self, from: LineFrom, line: &str) {
        let mark = if from == LineFrom::Host { '>' } else { '<' };
        self.0.borrow_mut().push(mark, line);
    }
}

/// Stand-in for a driver that cannot be reached.
struct NoDriver;

impl Driver for NoDriver {
    fn start(&mut self, _: Time, _: GoalId, _: &Command) {}
    fn cancel(&mut self, _: Time, _: GoalId) {}
    fn update(&mut self, _: Time, _: GoalId, _: &Command) {}
    fn hold(&mut self, _: Time, _: GoalId) {}
    fn proceed(&mut self, _: Time, _: GoalId) {}
    fn safe_stop(&mut self, _: Time, _: GoalId) {}
    fn observe(&mut self, _: Time, _: &Query) {}
    fn watch(&mut self, _: Time, _: &Query) {}
    fn unwatch(&mut self, _: Time, _: &Query) {}
    fn advance(&mut self, _: Time) -> Option<(Time, DriverEvent)> {
        None
    }
}
