//! `motet fleet`: what an operator does with the robots.

use crate::journal;
use crate::link::{ANSWERS, Fleet, POLICIES, RESULTS, STATES, SWAPS, ServerArgs, name, refusal, say};
use crate::signed::{Instruction, new_id, new_key, now, private_key, sign};
use async_nats::jetstream::kv;
use futures::StreamExt as _;
use serde_json::{Value, json};
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Time after which a robot that has said nothing counts as out of reach.
const SILENT: u64 = 10;

#[derive(clap::Args, Debug)]
pub(crate) struct FleetArgs {
    #[command(flatten)]
    pub(crate) server: ServerArgs,
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand, Debug)]
enum Command {
    /// Make the streams and buckets of the fleet on the server
    Init,
    /// Make a key that signs orders: FILE, and FILE with the ending .pub for the robots
    Key { file: PathBuf },
    /// Show the robots: what they do, what they ask, and since when they are silent
    Status,
    /// Send an order to a robot: it runs the policy
    Send(SendArgs),
    /// Let a policy take over from the one that runs on a robot
    Swap(SwapArgs),
    /// Answer the open question of a robot
    Ask(AskArgs),
    /// Write the journal of an order into a folder
    Journal(JournalArgs),
    /// Stop the run of a robot safely; needs no key
    Stop {
        #[arg(value_parser = name)]
        robot: String,
    },
    /// Serve a page with all robots
    View(crate::view::ViewArgs),
}

#[derive(clap::Args, Debug)]
struct SendArgs {
    #[arg(value_parser = name)]
    robot: String,
    /// Policy as text or JSON, `-` for stdin
    policy: PathBuf,
    /// File with the private key of the operator
    #[arg(long, value_name = "FILE")]
    key: PathBuf,
    /// Facts at the start, as a JSON object
    #[arg(long, value_name = "JSON")]
    state: Option<String>,
    /// Id of the order; the same id never runs twice [default: a new one]
    #[arg(long, value_name = "NAME", value_parser = name)]
    id: Option<String>,
    /// Seconds within which the robot must begin
    #[arg(long, value_name = "SECS", default_value_t = 3600)]
    life: u64,
    /// Wait for the result; the exit code is 0 only if the policy was done
    #[arg(long)]
    wait: bool,
}

#[derive(clap::Args, Debug)]
struct SwapArgs {
    #[arg(value_parser = name)]
    robot: String,
    /// Policy as text or JSON, `-` for stdin
    policy: PathBuf,
    /// File with the private key of the operator
    #[arg(long, value_name = "FILE")]
    key: PathBuf,
    /// Order whose policy it takes over from [default: the one that runs]
    #[arg(long, value_name = "NAME", value_parser = name)]
    order: Option<String>,
}

#[derive(clap::Args, Debug)]
struct AskArgs {
    #[arg(value_parser = name)]
    robot: String,
    /// Answer; without one the open question is shown
    #[arg(requires = "question")]
    answer: Option<String>,
    /// Question that it answers, as `status` shows it
    #[arg(long, value_name = "ORDER/NUMBER", requires = "answer")]
    question: Option<String>,
    /// File with the private key of the operator
    #[arg(long, value_name = "FILE", requires = "answer")]
    key: Option<PathBuf>,
}

#[derive(clap::Args, Debug)]
struct JournalArgs {
    #[arg(value_parser = name)]
    robot: String,
    #[arg(value_parser = name)]
    order: String,
    /// Folder of the journal, which must not exist
    folder: PathBuf,
}

/// Carries a command out.
pub(crate) async fn run(args: FleetArgs) -> Result<u8, String> {
    if let Command::Key { file } = &args.command {
        let public = new_key(file)?;
        say(&format!(
            "{public}\nprivate key: {}; give the robots {}",
            file.display(),
            file.with_extension("pub").display()
        ));
        return Ok(0);
    }
    // A page goes on when the server is away for a while.
    let waits = matches!(args.command, Command::View(_));
    let fleet = Fleet::new(args.server.connect("operator", waits).await?);
    match args.command {
        Command::Init => fleet.create().await.map(|()| 0),
        Command::Key { .. } => Ok(0),
        Command::Status => status(&fleet).await,
        Command::Send(args) => send(&fleet, &args).await,
        Command::Swap(args) => swap(&fleet, &args).await,
        Command::Ask(args) => ask(&fleet, &args).await,
        Command::Journal(args) => journal(&fleet, &args).await,
        Command::Stop { robot } => {
            let answer = fleet.request(&robot, "stop", Vec::new()).await?;
            report(&answer)
        }
        Command::View(args) => crate::view::serve(fleet, &args).await,
    }
}

/// Prints an answer; the exit code is 1 for a problem.
fn report(answer: &Value) -> Result<u8, String> {
    say(&serde_json::to_string_pretty(answer).unwrap_or_default());
    Ok(u8::from(answer.get("problem").is_some()))
}

async fn status(fleet: &Fleet) -> Result<u8, String> {
    for (robot, state) in fleet.states().await? {
        let text = |path: &str| clean(state.pointer(path).and_then(Value::as_str).unwrap_or_default());
        let silent = now().saturating_sub(state.get("heard").and_then(Value::as_u64).unwrap_or(0));
        let what = match (text("/order").as_str(), silent > SILENT) {
            (_, true) => format!("silent for {silent} s"),
            ("", _) => "waits for orders".to_owned(),
            (order, _) => format!("{order}: {}", text("/step")),
        };
        say(&format!("{:<20} {what}", clean(&robot)));
        if !text("/question/text").is_empty() && silent <= SILENT {
            let id = format!("{}/{}", text("/order"), text("/question/id"));
            say(&format!("{:<20} asks: {} (question {id})", "", text("/question/text")));
        }
    }
    Ok(0)
}

/// A text of a robot without control characters.
fn clean(text: &str) -> String {
    text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}

fn read(path: &Path) -> Result<String, String> {
    let mut text = String::new();
    let limit = 1024 * 1024 + 1;
    let read = if path == Path::new("-") {
        std::io::stdin().take(limit).read_to_string(&mut text)
    } else {
        std::fs::File::open(path).and_then(|file| file.take(limit).read_to_string(&mut text))
    };
    read.map_err(|error| format!("{}: {error}", path.display()))?;
    if text.len() as u64 == limit { Err(format!("{} is too large", path.display())) } else { Ok(text) }
}

async fn send(fleet: &Fleet, args: &SendArgs) -> Result<u8, String> {
    let id = args.id.clone().map_or_else(new_id, Ok)?;
    let state = args.state.as_deref().map(serde_json::from_str).transpose();
    let state = state.map_err(|error| format!("--state: {error}"))?;
    let what = Instruction::Run { policy: read(&args.policy)?, state };
    let digest = what.digest();
    let signed = sign(&private_key(&args.key)?, &id, &args.robot, args.life, what)?;
    let bucket = fleet.bucket(RESULTS).await?;
    let keys = [id.clone(), refusal(&id, &digest)].map(|name| format!("{}.{name}", args.robot));
    // The robot would refuse it, too, once it has done what waits before.
    if let Some(other) = latest(&bucket, &keys[0]).await?.filter(|result| !is_of(result, &digest)) {
        let why = format!("the id `{id}` is that of another order");
        let refused = json!({"state": "refused", "why": why, "robot": args.robot, "order": id,
            "digest": digest, "other": other});
        return exit_code(&refused);
    }
    let mut results = Vec::new();
    for key in &keys {
        results.push(bucket.watch(key).await.map_err(|error| error.to_string())?);
    }
    let mut results = futures::stream::select_all(results);
    let mut headers = async_nats::HeaderMap::new();
    // The server takes an order once, however often it is sent. Another one with its id reaches the robot,
    // which refuses it.
    headers.insert("Nats-Msg-Id", keys[1].as_str());
    let sent =
        fleet.js.publish_with_headers(format!("motet.orders.{}", args.robot), headers, signed.into()).await;
    let acknowledged = sent.map_err(|error| error.to_string())?.await;
    let acknowledged = acknowledged.map_err(|error| format!("the server did not take the order: {error}"))?;
    if acknowledged.duplicate {
        let _ = writeln!(std::io::stderr(), "motet-fleet: this order was sent before; it runs once");
    }
    if !args.wait {
        say(&id);
        return Ok(0);
    }
    // The order may have been sent before, and be over.
    let known = if acknowledged.duplicate { &keys[..] } else { &keys[..1] };
    for key in known {
        if let Some(result) = latest(&bucket, key).await?.filter(|result| is_of(result, &digest)) {
            return exit_code(&result);
        }
    }
    while let Some(entry) = results.next().await {
        let entry = entry.map_err(|error| error.to_string())?;
        let result: Option<Value> = serde_json::from_slice(&entry.value).ok();
        if let Some(result) = result.filter(|result| is_of(result, &digest)) {
            return exit_code(&result);
        }
    }
    Err("the link was cut before the result came".to_owned())
}

/// Result of a key.
async fn latest(bucket: &kv::Store, key: &str) -> Result<Option<Value>, String> {
    let told = bucket.get(key).await.map_err(|error| error.to_string())?;
    Ok(told.and_then(|told| serde_json::from_slice(&told).ok()))
}

/// Checks whether a result is that of an order with a digest, and not of another one with its id.
fn is_of(result: &Value, digest: &str) -> bool {
    result.get("digest").and_then(Value::as_str) == Some(digest)
}

/// Prints the result of an order; the exit code.
fn exit_code(result: &Value) -> Result<u8, String> {
    let is_done = result.get("outcome") == Some(&json!("done"));
    let is_refused = result.get("state") == Some(&json!("refused"));
    report(result).map(|_| match (is_done, is_refused) {
        (true, _) => 0,
        (_, true) => 1,
        (false, false) => 3,
    })
}

async fn swap(fleet: &Fleet, args: &SwapArgs) -> Result<u8, String> {
    let id = new_id()?;
    let order = match &args.order {
        Some(order) => order.clone(),
        None => {
            let state = state(fleet, &args.robot).await?;
            let order = state.get("order").and_then(Value::as_str).map(str::to_owned);
            order.ok_or("no run goes on")?
        }
    };
    let what = Instruction::Swap { order, policy: read(&args.policy)? };
    let signed = sign(&private_key(&args.key)?, &id, &args.robot, 60, what)?;
    let results = fleet.bucket(SWAPS).await?;
    let mut told = results.watch(&args.robot).await.map_err(|error| error.to_string())?;
    let (policies, begun) = (fleet.bucket(POLICIES).await?, Instant::now());
    policies.put(&args.robot, signed.into()).await.map_err(|error| error.to_string())?;
    let waited = tokio::time::timeout(ANSWERS, async {
        while let Some(entry) = told.next().await {
            let entry = entry.map_err(|error| error.to_string())?;
            let result: Value = serde_json::from_slice(&entry.value).unwrap_or_default();
            if result.get("id") == Some(&json!(id)) {
                return Ok(result);
            }
        }
        Err("the link was cut".to_owned())
    });
    let mut result = waited.await.map_err(|_| "the robot does not answer".to_owned())??;
    if let Some(fields) = result.as_object_mut() {
        #[allow(clippy::cast_precision_loss, reason = "a time in ms")]
        let millis = begun.elapsed().as_micros() as f64 / 1e3;
        fields.insert("ms".to_owned(), json!(millis));
    }
    report(&result)
}

async fn ask(fleet: &Fleet, args: &AskArgs) -> Result<u8, String> {
    let Some((answer, question)) = args.answer.as_ref().zip(args.question.as_ref()) else {
        let state = state(fleet, &args.robot).await?;
        let text = |path: &str| state.pointer(path).and_then(Value::as_str).map(clean);
        let question = text("/question/id").zip(text("/question/text")).zip(text("/order"));
        let ((question, words), order) = question.ok_or("the robot asks nothing")?;
        say(&format!("{words}\nquestion {order}/{question}"));
        return Ok(0);
    };
    let key = private_key(args.key.as_deref().ok_or("an answer needs --key")?)?;
    report(&fleet.answer(&key, &args.robot, question, answer).await?)
}

/// State of a robot as it told it last.
async fn state(fleet: &Fleet, robot: &str) -> Result<Value, String> {
    let state = fleet.bucket(STATES).await?.get(robot).await.map_err(|error| error.to_string())?;
    Ok(state.and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default())
}

async fn journal(fleet: &Fleet, args: &JournalArgs) -> Result<u8, String> {
    let lines = journal::lines(fleet, &args.robot, &args.order, usize::MAX).await?;
    journal::write(&lines, &args.folder)?;
    say(&format!("{} lines in {}; `motet replay` checks them", lines.len(), args.folder.display()));
    Ok(0)
}
