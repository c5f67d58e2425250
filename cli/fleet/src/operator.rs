//! `motet fleet`: what an operator does with the robots.

use crate::link::{ANSWERS, Fleet, JOURNALS, POLICIES, RESULTS, STATES, SWAPS, ServerArgs, name, say};
use crate::ship::{PART, SEQ};
use crate::signed::{What, new_id, new_key, now, private_key, sign};
use async_nats::jetstream::consumer::{self, AckPolicy, DeliverPolicy};
use futures::StreamExt as _;
use serde_json::{Value, json};
use std::io::Read as _;
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
    let what = What::Run { policy: read(&args.policy)?, state };
    let signed = sign(&private_key(&args.key)?, &id, &args.robot, args.life, what)?;
    let bucket = fleet.bucket(RESULTS).await?;
    let key = format!("{}.{id}", args.robot);
    let mut results = bucket.watch(&key).await.map_err(|error| error.to_string())?;
    let mut headers = async_nats::HeaderMap::new();
    // The server takes an order once, however often it is sent.
    headers.insert("Nats-Msg-Id", key.as_str());
    let sent =
        fleet.js.publish_with_headers(format!("motet.orders.{}", args.robot), headers, signed.into()).await;
    let acknowledged = sent.map_err(|error| error.to_string())?.await;
    let acknowledged = acknowledged.map_err(|error| format!("the server did not take the order: {error}"))?;
    if acknowledged.duplicate {
        eprintln!("motet-fleet: an order of this id was sent before; no other one runs");
    }
    if !args.wait {
        say(&id);
        return Ok(0);
    }
    // The order may have been sent before, and be over.
    let told = bucket.get(&key).await.map_err(|error| error.to_string())?;
    if let Some(code) = told.as_deref().and_then(exit_code) {
        return code;
    }
    while let Some(entry) = results.next().await {
        let entry = entry.map_err(|error| error.to_string())?;
        if let Some(code) = exit_code(&entry.value) {
            return code;
        }
    }
    Err("the link was cut before the result came".to_owned())
}

/// Prints the result of an order; the exit code. `None` if it is none.
fn exit_code(result: &[u8]) -> Option<Result<u8, String>> {
    let result: Value = serde_json::from_slice(result).ok()?;
    let is_done = result.get("outcome") == Some(&json!("done"));
    let is_refused = result.get("state") == Some(&json!("refused"));
    Some(report(&result).map(|_| match (is_done, is_refused) {
        (true, _) => 0,
        (_, true) => 1,
        (false, false) => 3,
    }))
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
    let what = What::Swap { order, policy: read(&args.policy)? };
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
    // The answer is for the question that the operator has read, whatever is open now.
    let (order, question) = question.split_once('/').ok_or("write --question ORDER/NUMBER")?;
    let (order, question) = (order.to_owned(), question.to_owned());
    let key = private_key(args.key.as_deref().ok_or("an answer needs --key")?)?;
    let what = What::Answer { order, question, text: answer.clone() };
    let signed = sign(&key, &new_id()?, &args.robot, 60, what)?;
    report(&fleet.request(&args.robot, "answer", signed).await?)
}

/// State of a robot as it told it last.
async fn state(fleet: &Fleet, robot: &str) -> Result<Value, String> {
    let state = fleet.bucket(STATES).await?.get(robot).await.map_err(|error| error.to_string())?;
    Ok(state.and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default())
}

/// Lines of a journal from the server, checked for gaps.
pub(crate) async fn lines(fleet: &Fleet, robot: &str, order: &str) -> Result<Vec<Vec<u8>>, String> {
    let wrong = |error: String| format!("the journal: {error}");
    let stream = fleet.js.get_stream(JOURNALS).await.map_err(|error| wrong(error.to_string()))?;
    let config = consumer::pull::Config {
        filter_subject: format!("motet.journal.{robot}.{order}"),
        deliver_policy: DeliverPolicy::All,
        ack_policy: AckPolicy::None,
        ..consumer::pull::Config::default()
    };
    let mut consumer = stream.create_consumer(config).await.map_err(|error| wrong(error.to_string()))?;
    let waiting = consumer.info().await.map_err(|error| wrong(error.to_string()))?.num_pending;
    let mut lines: Vec<Vec<u8>> = Vec::new();
    let mut messages = consumer.messages().await.map_err(|error| wrong(error.to_string()))?;
    for _ in 0..waiting {
        let message = messages.next().await.ok_or_else(|| wrong("it ends early".to_owned()))?;
        let message = message.map_err(|error| wrong(error.to_string()))?;
        let header = |name: &str| {
            message.headers.as_ref().and_then(|headers| Some(headers.get(name)?.as_str().to_owned()))
        };
        let number: usize = header(SEQ)
            .and_then(|text| text.parse().ok())
            .ok_or_else(|| wrong("a line has no number".to_owned()))?;
        let is_first = header(PART).is_none_or(|part| part.starts_with("0/"));
        let whole = || message.payload.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec);
        match number {
            _ if number == lines.len() && is_first => lines.extend(whole()),
            // A further part of the last line, or the last line again after the link was cut.
            _ if number + 1 == lines.len() && is_first => {
                lines.truncate(number);
                lines.extend(whole());
            }
            _ if number + 1 == lines.len() => lines[number].extend(message.payload.iter()),
            _ => return Err(wrong(format!("line {} is followed by line {number}", lines.len()))),
        }
    }
    Ok(lines)
}

async fn journal(fleet: &Fleet, args: &JournalArgs) -> Result<u8, String> {
    let lines = lines(fleet, &args.robot, &args.order).await?;
    if lines.is_empty() {
        return Err("the server has no line of this journal".to_owned());
    }
    let wrong = |error: std::io::Error| format!("{}: {error}", args.folder.display());
    std::fs::create_dir(&args.folder).map_err(wrong)?;
    std::fs::write(args.folder.join("000000000000.journal"), lines.concat()).map_err(wrong)?;
    say(&format!("{} lines in {}; `motet replay` checks them", lines.len(), args.folder.display()));
    Ok(0)
}
