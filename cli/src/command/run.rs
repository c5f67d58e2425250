//! `motet run`: checks a policy and runs it in simulation or on a driver in another process, with or without
//! a journal; or checks such a driver.

mod conformance;
mod many;

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

use clap::Args;
use motet::run::{create_journal, engine, events, journal_head, run_id, start_state, unix_ns};
use motet_graph::Graph;
use motet_host::journal::JournalWriter;
use motet_host::remote::DriverAddress;
use motet_host::remote::protocol::Hello;
use motet_planner::runtime_check::Guard;
use motet_project::{Project, ProjectSession, SavedDriver, SavedProject};
use motet_runtime::journal::{
    DriverReplay, EngineReplay, JournalEntry, JournalHead, OpenGoals, ResumeEntry, StepEntry,
};
use motet_runtime::{
    Capabilities, Driver, DriverClock, Event, MissingPrimitive, Observer as _, Time, Verifier as _,
};
use motet_syntax::{Parsed, Severity, Syntax};

use crate::conversation::operator::{OperatorAnswers, OperatorInput, OperatorPrompt};
use crate::conversation::words::{RunWords, WordArgs};
use crate::documents::{Document, one_document};
use crate::error::{CliError, Exit, journal_error};
use crate::flags::{
    DriverArgs, DriverChoice, JobArgs, OutputFormat, PageArgs, ResultArgs, SessionArgs, Speed, folder_of,
};
use crate::interrupt::{note_moving, note_open};
use crate::output::{Colors, count, escape, note, opened_again, replace_file};
use crate::questions::{QuestionDriver, answering, jumps};
use crate::ready_driver::{ReadyDriver, RunSubject, connect, open_driver};
use crate::report::Report;
use crate::run_view::{Clock, view};
use crate::runner::{Beginning, PacedView, Runner, exit_of};
use crate::swap_checker::SwapChecker;
use crate::view::answered::AnsweredQuestions;
use crate::view::conversation::session;
use crate::view::journal::recorded_text;
use crate::view::live::{LivePage, SharedPage};
use motet::page::source::PolicyText;

/// Commands of a page's operator.
const TAKES: &[&str] = &["stop", "hold", "answer"];

/// Flags of `motet run`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet run fetch_mug.motet --robot hsr --scene kitchen --speed max\n  \
    motet run fetch_mug.motet --scene kitchen --faults slips.json --answers person.json --format json\n  \
    motet run fetch_mug.motet --scene kitchen --record run/    write a journal for `motet replay run/`\n  \
    motet run fetch_mug.motet --scene kitchen --say '5s: wait' --say '9s: go on'\n  \
    motet run policies.jsonl --robot hsr --scene kitchen --out runs.jsonl\n  \
    motet run --resume run/                                    continue after a crash\n  \
    motet run --resume run/ --driver 'python3 my_driver.py'    the same on a driver\n  \
    motet run fetch_mug.motet --scene kitchen --driver 'python3 examples/drivers/echo.py'\n  \
    motet run fetch_mug.motet --scene kitchen --driver tcp://127.0.0.1:4711\n  \
    motet run fetch_mug.motet --scene kitchen --driver mujoco  run in physics\n  \
    motet run --check --driver 'python3 my_driver.py'          check the laws of drivers")]
pub(crate) struct RunArgs {
    /// Policy file, `-` for stdin, or a .jsonl file with one policy per line, which are all simulated at
    /// full speed; with `--check`, the driver gets its first call instead of `say`
    #[arg(value_name = "FILE", required_unless_present_any = ["resume", "check"])]
    file: Option<PathBuf>,
    /// Policy to run; required if the file has several
    #[arg(long, value_name = "NAME")]
    policy: Option<String>,
    #[command(flatten)]
    session: SessionArgs,
    /// Check if a driver in another process keeps the laws of drivers, and print each broken one with its
    /// messages
    #[arg(long, conflicts_with_all = ["record", "speed", "resume", "say", "live"])]
    check: bool,
    /// Seconds that a call may take in a check
    ///
    /// The default is 5, or the deadline of the call for a driver that owns the clock.
    #[arg(long, value_name = "SECS", requires = "check")]
    patience: Option<f64>,
    #[command(flatten)]
    driver: DriverArgs,
    /// Write a journal of the run into this folder, which must be empty or not exist
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// Continue the run whose journal is in this folder; a driver in another process is given again with
    /// `--driver`
    #[arg(
        long,
        value_name = "FOLDER",
        conflicts_with_all = [
            "file", "policy", "record", "seed", "faults", "answers", "robot", "scene", "state", "domain",
            "profile", "world",
        ]
    )]
    resume: Option<PathBuf>,
    #[command(flatten)]
    words: WordArgs,
    #[command(flatten)]
    page: PageArgs,
    /// View of the run: a tree of steps, or JSON events
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: OutputFormat,
    #[command(flatten)]
    jobs: JobArgs,
    #[command(flatten)]
    results: ResultArgs,
}

/// Runs the command.
pub(crate) fn run(args: &RunArgs, colors: Colors) -> Result<Exit, CliError> {
    args.driver.refuse_flags()?;
    many::refuse_flags(args)?;
    Report::run(args.format.into(), colors, |report| match (&args.resume, &args.file) {
        (None, file) if args.check => conformance::check(file.as_deref(), args, report),
        (Some(folder), _) => resume(folder, args, colors, report),
        (None, Some(file)) if many::is_lines(file) => many::run(file, args, report),
        (None, Some(file)) => check_and_run(file, args, colors, report),
        (None, None) => Err(CliError::Message("a policy is needed".to_owned())),
    })
}

fn check_and_run(file: &Path, args: &RunArgs, colors: Colors, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project_in(folder_of(file))?.open_with(report)?;
    let policy = args.policy.as_deref();
    let document = one_document(file)?;
    let Some(compiled) = compile(&document, policy, args.format, &mut project, report)? else {
        return Ok(Exit::Findings);
    };
    let CompiledPolicy { graph, parsed, opened: shared, text } = compiled;
    let (opened, run) = (&*shared, run_id());
    let wanted = RunSubject { run: &run, policy: Some((&graph, &parsed)), opened };
    let ReadyDriver { mut driver, saved, clock, speed, settings, .. } =
        open_driver(&args.driver, &args.session.environment, &wanted, report)?;
    // The simulated person of a script answers the questions of policies.
    let has_person = args.page.view.is_some() && args.driver.answers.is_none();
    let can = capabilities(&*driver, has_person);
    let missing = can.missing(&graph);
    if !missing.is_empty() {
        refuse(&missing, &text, args.format, report);
        return Ok(Exit::Findings);
    }
    let page = LivePage::shared(&args.page, opened, TAKES)?;
    let written = (text.text.clone(), parsed.syntax);
    page.iter().for_each(|page| page.borrow_mut().text(text.clone()));
    let start = start_state(opened.scene.as_ref());
    let guard = opened.session.world_tracker().map(|course| Guard::new(course, speed.verifies()));
    let engine = engine(graph, &start, can, guard.as_ref(), settings)?;
    let is_simulated = matches!(&saved, Some(SavedDriver::Simulator(_)));
    let journal = match args.record.as_deref().zip(saved) {
        Some((folder, saved)) => {
            let saved = saved.with_person(has_person);
            let journal = create_journal(folder, &run, (&engine, &start), Some(&saved))?;
            let name = if written.1 == Syntax::Json { "policy.json" } else { "policy.motet" };
            replace_file(&folder.join(name), &written.0)?;
            Some(journal)
        }
        None => None,
    };
    let head = journal_head(&run, &engine, &start);
    let beginning = page.clone().map(|page| (page, Beginning::Head(Box::new(head))));
    let room = opened.scene.clone().unwrap_or_default();
    let mut asking;
    let driver: &mut dyn Driver = if has_person {
        let answers = OperatorAnswers { operator: operator(page.as_ref()), scene: &room };
        asking = QuestionDriver::new(&mut *driver, answers, Time::ZERO, jumps(speed, clock));
        &mut asking
    } else {
        &mut *driver
    };
    let view = view(args.format, engine.graph(), colors, clock);
    // Where the driver keeps the time of the wall clock, the view never waits.
    let words = RunWords::of(&args.words)?;
    let paced =
        PacedView::new(view, speed).with_words(words).with_guard(guard).with_room(opened.scene.clone());
    let paced = with_desk(paced, page.as_ref(), Some(Arc::clone(&shared)), args, (colors, clock));
    let events = vec![Event::Begin];
    let (from, was_stopped) = (Time::ZERO, false);
    Runner { engine, driver, journal, is_simulated, was_stopped, from, events }.run(paced, beginning)
}

/// Capabilities of a driver, with those of the person who answers at the page of the run.
fn capabilities(driver: &dyn Driver, has_person: bool) -> Capabilities {
    let can = driver.capabilities();
    if has_person { answering(can) } else { can }
}

/// Says which primitives the driver does not have, and the lines of their first calls.
fn refuse(missing: &[MissingPrimitive], text: &PolicyText, format: OutputFormat, report: &mut Report) {
    if format == OutputFormat::Json {
        report.out.json_line(&events::refused(missing, &|path| text.line(path)));
    }
    let place = |one: &MissingPrimitive| match text.line(&one.path) {
        Some(line) => format!("`{}` ({}:{line})", one.name, escape(&text.name)),
        None => one.to_string(),
    };
    let places: Vec<String> = missing.iter().map(place).collect();
    note(&format!("refused: the driver does not have {}; nothing has moved", places.join(", ")));
}

/// Operator at the page of a run; nobody without one.
fn operator(page: Option<&SharedPage>) -> OperatorPrompt {
    let input = Rc::new(page.map_or(OperatorInput::Never, OperatorInput::of_page));
    OperatorPrompt { input, page: page.map(Rc::clone) }
}

/// The view with a desk of policies that are to take over, if the run has a page to offer them.
fn with_desk(
    paced: PacedView,
    page: Option<&SharedPage>,
    opened: Option<Arc<ProjectSession>>,
    args: &RunArgs,
    (colors, clock): (Colors, Clock),
) -> PacedView {
    let desk = page.zip(opened).and_then(|(page, opened)| {
        let (desk, offers) = SwapChecker::new(opened)?;
        page.borrow().hub().take_offers(offers);
        Some(desk)
    });
    let format = args.format;
    paced.with_desk(desk, Box::new(move |graph| view(format, graph, colors, clock)))
}

/// Policy that passed the check.
pub(super) struct CompiledPolicy {
    pub(super) graph: Graph,
    pub(super) parsed: Parsed,
    pub(super) opened: Arc<ProjectSession>,
    /// Text with the findings of the check.
    pub(super) text: PolicyText,
}

/// Reads and compiles a policy, and reports the diagnostics. `None` if the check refuses it.
pub(super) fn compile(
    document: &Document,
    policy: Option<&str>,
    format: OutputFormat,
    project: &mut Project,
    report: &mut Report,
) -> Result<Option<CompiledPolicy>, CliError> {
    let (source, parsed) = document.parse();
    let opened = project.shared_session_for(&parsed.file, report)?;
    let compiled = opened.session.compile(&parsed, policy);
    let sources = opened.sources(source.clone());
    match format {
        OutputFormat::Human => report.print(&compiled.diagnostics, &sources),
        OutputFormat::Json => {
            let lines = events::diagnostics(&compiled.diagnostics, &sources);
            lines.iter().for_each(|line| report.out.json_line(line));
        }
    }
    if let Some(graph) = compiled.graph {
        let text = PolicyText::of(&source, &parsed.file, &graph.policy);
        let text = text.with_findings(&compiled.diagnostics, &sources);
        return Ok(Some(CompiledPolicy { graph, parsed, opened, text }));
    }
    let errors = compiled.diagnostics.iter().filter(|found| found.severity == Severity::Error).count();
    note(&format!("refused: {}; nothing has moved", count(errors, "error")));
    Ok(None)
}

/// Rebuilds the engine and the simulator from a journal, and continues.
fn resume(folder: &Path, args: &RunArgs, colors: Colors, report: &mut Report) -> Result<Exit, CliError> {
    let mut entries = Vec::new();
    let (mut writer, tail) =
        JournalWriter::open(folder, &mut |_, entry| entries.push(entry)).map_err(journal_error)?;
    let Some(JournalEntry::Head(head)) = entries.first() else {
        return Err(CliError::Message("the journal has no head".to_owned()));
    };
    let mut replay = EngineReplay::new(head).map_err(|error| CliError::Message(error.to_string()))?;
    let saved = given_again(SavedDriver::from_json(&head.driver)?, args)?;
    let mut simulator = match &saved {
        SavedDriver::Simulator(saved) => Some(saved.open()?),
        SavedDriver::Process { .. } => None,
    };
    let clock = clock_of(head, &saved);
    let (page, opened) = resumed_page(folder, args, &entries, report)?.unzip();
    let view = view(args.format, replay.engine().graph(), colors, clock);
    let speed = match clock {
        Clock::Simulated => args.driver.speed(),
        Clock::Wall => Speed::Times(1.0),
    };
    let mut paced = PacedView::new(view, speed);
    let (mut ledger, mut retrace) = (OpenGoals::default(), DriverReplay::default());
    let mut questions = saved.asks().then(AnsweredQuestions::default);
    let checked = saved.project().filter(|_| head.settings.verify_within.is_some());
    let session = checked.and_then(|checked| open_session(checked, report));
    let course = session.as_ref().and_then(|opened| opened.session.world_tracker());
    let mut guard = course.map(|course| Guard::new(course, speed.verifies()));
    let room = match &saved {
        SavedDriver::Simulator(saved) => Some(saved.scene()?),
        SavedDriver::Process { .. } => session.and_then(|opened| opened.scene),
    };
    let (mut begun, mut has_noticed, mut was_stopped) = (false, false, false);
    for (number, entry) in entries.iter().enumerate() {
        let differs = |why: String| CliError::Message(format!("entry {number} of the journal: {why}"));
        match replay.take(entry) {
            Ok(None) => {}
            Ok(Some(_)) => {
                return Err(differs(
                    "the engine acts differently now; `motet replay` shows the difference".to_owned(),
                ));
            }
            Err(error) => return Err(differs(error.to_string())),
        }
        let seen = questions.as_mut().map(|questions| questions.without(entry));
        if let Some(simulator) = &mut simulator {
            let taken = retrace.take(simulator, seen.as_ref().unwrap_or(entry));
            taken.map_err(|astray| differs(astray.to_string()))?;
        }
        if let Some(guard) = &mut guard {
            if let JournalEntry::Step(StepEntry { at, event: Some(event), .. }) = entry {
                guard.event(*at, event);
            }
            replay.effects().iter().for_each(|effect| guard.effect(effect));
        }
        ledger.take(entry);
        paced.past(replay.now(), replay.effects());
        if let JournalEntry::Step(step) = entry {
            begun |= step.event == Some(Event::Begin);
            was_stopped |= step.event == Some(Event::Stop);
            has_noticed |= matches!(step.event, Some(Event::Noticed { .. }));
        }
    }
    if ledger.is_over {
        note("the run is over; nothing is left to do");
        let end = replay.effects().iter().find_map(|effect| match effect {
            motet_runtime::Effect::Finished(end) => Some(end),
            _ => None,
        });
        // It may have been cut off before it said how it ended.
        end.iter().for_each(|end| paced.finish(end));
        return Ok(end.map_or(Exit::Success, |end| exit_of(end)));
    }
    let from = now(head, clock, replay.now());
    // Older journals have no id; the time of their beginning is as good.
    let run = if head.run.is_empty() { format!("{:x}", head.began_unix_ns) } else { head.run.clone() };
    let mut events = if begun { Vec::new() } else { vec![Event::Begin] };
    if let Some(questions) = &questions {
        // No driver has heard of these goals.
        ledger.goals.retain(|goal, _| !questions.is_open(*goal));
        events.extend(questions.refused());
    }
    let unix_ns = unix_ns();
    let resumed = JournalEntry::Resumed(ResumeEntry { unix_ns, cut_bytes: tail.torn_bytes });
    writer.append(|chain| chain.line(resumed)).and_then(|()| writer.sync()).map_err(journal_error)?;
    let cut = match tail.torn_bytes {
        0 => String::new(),
        bytes => format!("; cut off {bytes} bytes of an unfinished entry"),
    };
    note_open(&ledger);
    let goals = count(ledger.goals.len(), "goal");
    note(&format!("resumed at {} after {} entries, {goals} open{cut}", replay.now(), entries.len()));
    let has_person = saved.asks();
    let is_simulated = matches!(&saved, SavedDriver::Simulator(_));
    let driver: Box<dyn Driver> = match (saved, simulator) {
        (SavedDriver::Process { address, instance, .. }, _) => {
            let hello = Hello { resumed: true, ..Hello::of(replay.engine().graph(), &run) };
            let mut driver = connect(&address.into(), hello, from).inspect_err(|_| _ = note_moving())?;
            let missing = capabilities(&driver, has_person).missing(replay.engine().graph());
            if !missing.is_empty() {
                note_moving();
                return Err(motet::Error::Lacking(missing).into());
            }
            events.extend(driver.catch_up(&ledger, &instance, from));
            Box::new(driver)
        }
        (SavedDriver::Simulator(_), Some(simulator)) => Box::new(simulator),
        (SavedDriver::Simulator(saved), None) => Box::new(saved.open()?),
    };
    let mut driver = driver;
    let engine = replay.into_engine();
    let sees = driver.capabilities().detections;
    if guard.is_some() && has_noticed && !sees {
        guard = None;
        note("the robot's detections are lost: deferred motions are left to the driver");
    }
    let scene = room.clone().unwrap_or_default();
    let mut paced = paced.with_words(RunWords::of(&args.words)?).with_guard(guard).with_room(room);
    if sees {
        // What is in view counts for the motions that are checked from now on.
        let seen = driver.detections(from);
        let noticed = paced.detected(from, &seen, &engine);
        events.extend(noticed.into_iter().map(|(query, answer)| Event::Noticed { query, answer }));
    }
    let paced = with_desk(paced, page.as_ref(), opened.flatten(), args, (colors, clock));
    let mut asking;
    let driver: &mut dyn Driver = if has_person {
        let answers = OperatorAnswers { operator: operator(page.as_ref()), scene: &scene };
        asking = QuestionDriver::new(&mut *driver, answers, from, jumps(speed, clock));
        &mut asking
    } else {
        &mut *driver
    };
    let beginning = page.map(|page| (page, Beginning::Entry(entries.len() as u64 + 1)));
    let runner = Runner { engine, driver, journal: Some(writer), is_simulated, was_stopped, from, events };
    runner.run(paced, beginning)
}

/// Driver of a journal at the address that the flags give again. A journal is data, and its author may be
/// anybody: it starts no command by itself.
fn given_again(saved: SavedDriver, args: &RunArgs) -> Result<SavedDriver, CliError> {
    let choice = &args.driver.driver;
    match saved {
        SavedDriver::Simulator(_) if *choice == DriverChoice::Kinematic => Ok(saved),
        SavedDriver::Simulator(_) => {
            let why = "the run was in the simulator: `--driver` cannot take it over";
            Err(CliError::Message(why.to_owned()))
        }
        SavedDriver::Process { address, instance, guard, asks } => {
            let named = DriverAddress::from(address);
            let given = choice.again(&named).ok_or_else(|| CliError::Advised {
                problem: "the journal names a driver in another process, and a journal starts none by itself"
                    .to_owned(),
                help: format!("give it again, if you trust it: {}", escape(&DriverChoice::flag_for(&named))),
            })?;
            Ok(SavedDriver::process(&given, &instance, guard.map(|guard| *guard)).with_person(asks))
        }
    }
}

/// Page of a run that goes on, with the project if it can be opened.
type ResumedPage = (SharedPage, Option<Arc<ProjectSession>>);

/// Page of a run that goes on, with what happened before.
fn resumed_page(
    folder: &Path,
    args: &RunArgs,
    entries: &[JournalEntry],
    report: &mut Report,
) -> Result<Option<ResumedPage>, CliError> {
    let Some(address) = args.page.view else { return Ok(None) };
    let opened = session(folder, report).map(Arc::new);
    let mut page = LivePage::start(address, args.page.view_file.as_deref(), opened.as_deref(), TAKES)?;
    if let Some(text) = recorded_text(folder) {
        page.text(text);
    }
    for (entry, seq) in entries.iter().zip(0..) {
        page.entry(seq, entry);
    }
    Ok(Some((Rc::new(RefCell::new(page)), opened)))
}

/// Clock of the run of a journal.
fn clock_of(head: &JournalHead, saved: &SavedDriver) -> Clock {
    match (saved, head.capabilities.clock) {
        (SavedDriver::Simulator(_), _) | (_, DriverClock::Driver) => Clock::Simulated,
        (SavedDriver::Process { .. }, DriverClock::Wall) => Clock::Wall,
    }
}

/// Time at which the run continues. Simulated time has stood still since the crash; the time of a robot has
/// not.
fn now(head: &JournalHead, clock: Clock, last: Time) -> Time {
    match clock {
        Clock::Simulated => last,
        Clock::Wall => {
            let passed = unix_ns().saturating_sub(head.began_unix_ns);
            head.from.after(Time::from_nanos(passed)).max(last)
        }
    }
}

/// Session at the beginning of the run; `None`, with a note, if the files of the project are gone or have
/// changed.
fn open_session(saved: &SavedProject, report: &mut Report) -> Option<ProjectSession> {
    let session = saved.session(report);
    opened_again(
        session,
        "the scene has changed since the run began",
        "deferred motions are left to the driver",
    )
}
