//! Scenarios: plans for two household robots in two profiles, with the verdict of a contract (`CONTRACT.md`
//! beside the rows).
//!
//! A row becomes an ordinary scene, an ordinary policy and facts at the start; where the contract differs
//! from the standard library its words are declared in `contract.motet`. Every verdict is one of `check`,
//! through the table of `verdict.rs`.

mod policy;
mod row;
mod verdict;
mod words;

use std::time::Instant;

use motet_compiler::Session;
use motet_compiler::fix::FixLimits;
use motet_robots::card::Robot;
use motet_syntax::ast::Item;
use motet_syntax::{FileId, Severity, Source, Sources};
use serde_json::Value;

use self::policy::Written;
use self::row::{Names, Row};
use super::Judged;
use super::repairs::{ROUNDS, Repair};

const CONTRACT: &str = include_str!("contract.motet");

/// Words of the contract that the cards do not list, because the policies of people have no use for them.
const OWN_WORDS: &[&str] =
    &["detect_container", "detect_person", "find", "check", "aim", "choose_spot", "wait", "take_over"];

/// Words of the contract that a card may list.
const WORDS: &[&str] = &[
    "go",
    "turn",
    "wake_up",
    "home",
    "start_pose",
    "search",
    "detect",
    "ground",
    "pick",
    "lift",
    "place",
    "handover",
    "open",
    "close",
    "ask",
    "choose",
];

/// Judges a line.
///
/// # Errors
///
/// Where the line is no such row, or its scene is none.
pub fn judge(line: &str) -> Result<Judged, String> {
    let row: Row = serde_json::from_str(line).map_err(|error| error.to_string())?;
    let Prepared { written, session, source, file } = prepare(&row)?;
    let begin = Instant::now();
    let said = session.check(&motet_syntax::read(&source, file));
    let took = begin.elapsed();
    let found = verdict::first(&said, &written);
    let expected_error = row.verdict != "ok";
    let both = |expected: Option<String>, found: Option<&str>| {
        expected.filter(|_| expected_error).zip(found.map(str::to_owned))
    };
    let class = both(row.class.clone(), found.as_ref().map(|found| found.class));
    let step = both(row.error_step(), found.as_ref().map(|found| found.step.as_str()));
    let group = row.needs.filter(|needs| needs != "static");
    let note = found.as_ref().map(|found| {
        let (code, message) = (found.said.code, &found.said.message);
        format!("{} at {}: {code} {message}", found.class, found.step)
    });
    Ok(Judged { id: row.id, expected_error, found_error: found.is_some(), class, step, took, group, note })
}

/// Mends the plan of a line by at most [`ROUNDS`] fixes and judges what comes of it; none where the row calls
/// the plan right, or its verdict rests on something that is not static.
///
/// # Errors
///
/// Where the line is no such row, or its scene is none.
pub fn repair(line: &str) -> Result<Option<Repair>, String> {
    let row: Row = serde_json::from_str(line).map_err(|error| error.to_string())?;
    if row.verdict == "ok" || row.needs.as_deref().is_some_and(|needs| needs != "static") {
        return Ok(None);
    }
    let Prepared { written, session, source, file } = prepare(&row)?;
    let fixed = motet_compiler::fix::fix(&session, &source, file, FixLimits::all(ROUNDS));
    let said = session.check(&motet_syntax::read(&Source::new("plan.json", fixed.text), file));
    let left = verdict::first(&said, &written).map(|found| {
        let (code, message) = (found.said.code, &found.said.message);
        format!("{} at {}: {code} {message}", found.class, found.said.path)
    });
    let done = fixed.applied.into_iter().map(|applied| applied.title).collect();
    Ok(Some(Repair { id: row.id, class: row.class.unwrap_or_default(), done, left }))
}

/// A row as documents.
struct Prepared {
    written: Written,
    session: Session,
    source: Source,
    file: FileId,
}

fn prepare(row: &Row) -> Result<Prepared, String> {
    let plan = row.plan()?;
    let names = Names::of(&row.scene);
    let written = policy::write(row, &plan, &names)?;
    let mut sources = Sources::default();
    let (session, _) = session(row, &names, &written, &mut sources)?;
    let source = Source::new("plan.json", written.policy.to_string());
    let file = sources.add(source.clone());
    Ok(Prepared { written, session, source, file })
}

/// The session of a row's robot, scene and contract.
fn session(
    row: &Row,
    names: &Names,
    written: &Written,
    sources: &mut Sources,
) -> Result<(Session, Robot), String> {
    let mut robot = robot(&row.robot, sources)?;
    robot.primitives.retain(|name, _| WORDS.contains(&name.as_str()));
    robot.primitives.extend(OWN_WORDS.iter().map(|word| ((*word).into(), Default::default())));
    // How the robot starts is the row's to say.
    robot.initially.clear();
    // What a plan watches, its robot can observe.
    robot.observes.extend(written.fluents.keys().map(Into::into));
    let mut contract = CONTRACT.to_owned();
    for rule in row.scene.get("rules").and_then(Value::as_array).into_iter().flatten() {
        contract = watched(contract, rule);
    }
    contract.push_str(&words::declarations(&written.fluents));
    let source = Source::new("contract.motet", contract);
    let file = sources.add(source.clone());
    let parsed = motet_syntax::read(&source, file);
    let scene = row::scene(row, names, sources)?;
    let state = row::state(row, names, &robot);
    let session =
        Session::builder().robot(&robot).domains(&[parsed.file]).scene(&scene).state(&state).build(sources);
    let mut said = session.input_diagnostics().to_vec();
    said.extend(parsed.diagnostics);
    match said.iter().find(|said| said.severity == Severity::Error) {
        Some(wrong) => Err(format!("the world of the row: {} {}", wrong.code, wrong.message)),
        None => Ok((session, robot)),
    }
}

fn robot(name: &str, sources: &mut Sources) -> Result<Robot, String> {
    let Some(texts) = motet_robots::builtin::robot_texts(name) else {
        return Err(format!("there is no robot `{name}`"));
    };
    let source = Source::new(format!("{name}/robot.toml"), texts.card);
    let file = sources.add(source.clone());
    // The contract stands for the robot's own declarations, so what only they declare cannot be observed.
    let (robot, said) = motet_robots::card::read(&source, file, None);
    let mut robot = robot.ok_or_else(|| format!("the card of `{name}`: {said:?}"))?;
    let own = Source::new("primitives.motet", texts.declarations.unwrap_or_default());
    let own = motet_syntax::read(&own, file).file;
    let is_own =
        |name: &str| own.items.iter().any(|item| matches!(item, Item::Fluent(it) if it.name.text == name));
    robot.observes.retain(|name| !is_own(name));
    Ok(robot)
}

/// The contract with a rule of the home: a monitor that a primitive needs.
fn watched(contract: String, rule: &Value) -> String {
    let text = |key: &str| rule.get(key).and_then(Value::as_str);
    let (Some("monitor_required"), Some(op), Some(watched)) = (text("rule"), text("op"), text("cond")) else {
        return contract;
    };
    let name: String = watched.split('(').next().unwrap_or_default().trim().to_owned();
    let header = [format!("\naction {op}("), format!("\nperception {op}(")];
    let Some(start) = header.iter().find_map(|header| contract.find(header.as_str())) else {
        return contract;
    };
    let rest = contract.get(start + 1..).unwrap_or_default();
    let Some(end) = rest.find('\n').map(|end| start + 1 + end) else { return contract };
    let (before, after) = contract.split_at(end);
    format!("{before}\n    needs monitored(`{name}`){after}")
}
