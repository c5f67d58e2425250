//! Who plans: the built-in planner, or a model on a server, with what there is to see of asking it.

use std::io::{self, IsTerminal, Write as _};
use std::time::Duration;

use motet_client::{Client, ClientSettings, EncodedImage, Notation, ServerUrl};
use motet_decode::export::Dialect;
use motet_planner::builtin::{PlanError, PlannedRequest};
use motet_planner::model::{self, ModelEvent, ModelObserver, ModelPlanner, Role, Start};
use motet_planner::{Builtin, PlanRequest, Planner, RemainingSteps, Wait};
use serde_json::json;

use super::record::Recorder;
use crate::args::{DoArgs, Held, ModelArgs, RunFormat};
use crate::command::{grammar, run};
use crate::exit::Trouble;
use crate::input::read_small;
use crate::out::{Colors, note};

/// The planner that the flags ask for.
///
/// # Errors
///
/// The address, an image or the key cannot be used.
pub(super) fn planner(
    args: &DoArgs,
    colors: Colors,
    recorder: Option<Recorder>,
) -> Result<Box<dyn Planner>, Trouble> {
    let asking = &args.asking;
    if asking.planner == "builtin" {
        if asking.camera {
            let why = "nobody looks at what the camera sees: give a model with --planner URL, or leave --camera out";
            return Err(Trouble::Other(why.to_owned()));
        }
        let idle = [
            ("--model", asking.model != "default"),
            ("--dialect", asking.dialect != Held::None),
            ("--image", !asking.image.is_empty()),
            ("--key-from", asking.key_from.is_some()),
            ("--eager", asking.eager),
            ("--lark", asking.lark),
            ("--fallback", asking.fallback),
        ];
        if let Some((flag, _)) = idle.iter().find(|(_, is_given)| *is_given) {
            let why = format!("{flag} is for a model: give one with --planner URL, or leave {flag} out");
            return Err(Trouble::Other(why));
        }
        return Ok(Box::new(Builtin));
    }
    let client = client(asking)?;
    let screen = Screen {
        recorder,
        is_shown: args.format == RunFormat::Human,
        is_live: io::stderr().is_terminal(),
        is_colored: colors.stderr,
        in_line: false,
    };
    // What the whole may take at most, its first step does not know.
    let start =
        if asking.eager && args.world.max_duration.is_none() { Start::FirstStep } else { Start::Whole };
    let how = model::Settings { repairs: asking.repair, start, ..model::Settings::default() };
    let planner = ModelPlanner::new(client, screen, how);
    Ok(if asking.fallback { Box::new(Fallback(planner)) } else { Box::new(planner) })
}

/// A connection to the server that the flags name.
///
/// # Errors
///
/// The address, an image or the key cannot be used.
pub(super) fn client(asking: &ModelArgs) -> Result<Client, Trouble> {
    let settings = settings(asking)?;
    let name = settings.address.to_string();
    Client::new(settings).map_err(|why| Trouble::Other(format!("cannot ask `{name}`: {why}")))
}

fn settings(args: &ModelArgs) -> Result<ClientSettings, Trouble> {
    let dialect = match args.dialect {
        Held::None => None,
        Held::Vllm => Some(Dialect::Vllm),
        Held::Llamacpp => Some(Dialect::LlamaCpp),
        Held::Ollama => Some(Dialect::Ollama),
        Held::Sglang => Some(Dialect::Sglang),
        Held::Openai => Some(Dialect::OpenAi),
    };
    let takes_lark = matches!(dialect, Some(Dialect::Vllm | Dialect::Sglang | Dialect::LlamaCpp));
    if args.lark && !takes_lark {
        let why = "--lark is for servers that run grammars with llguidance: give --dialect vllm, sglang or llamacpp";
        return Err(Trouble::Other(why.to_owned()));
    }
    let notation = if args.lark { Notation::Lark } else { Notation::Usual };
    let address = ServerUrl::new(&args.planner, dialect).map_err(Trouble::Other)?;
    let mut images = Vec::new();
    for path in &args.image {
        let image = EncodedImage::new(&read_small(path)?).map_err(|why| {
            Trouble::Other(format!("`{}` cannot be shown to a model: {why}", path.display()))
        })?;
        images.push(image);
    }
    let key = args.key_from.as_deref().map(grammar::key).transpose()?;
    let timeout = Duration::from_secs(args.timeout);
    let new = ClientSettings::new(address, &args.model);
    Ok(ClientSettings {
        dialect,
        notation,
        key,
        images,
        timeout,
        idle_timeout: new.idle_timeout.min(timeout),
        ..new
    })
}

/// A model, and where it finds nothing the planner that needs none.
struct Fallback(ModelPlanner<'static>);

impl Planner for Fallback {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        match self.0.plan(ask) {
            Err(why @ (PlanError::NoModel { .. } | PlanError::Refused { .. })) => {
                note(&format!("planned without a model, since {why}"));
                Builtin.plan(ask)
            }
            other => other,
        }
    }

    fn reads_answers(&self) -> bool {
        self.0.reads_answers()
    }

    fn begin(&mut self, ask: &PlanRequest<'_>) -> bool {
        self.0.begin(ask)
    }

    fn rest(&mut self, wait: Wait) -> RemainingSteps {
        self.0.rest(wait)
    }
}

/// Shows what a model writes, on standard error, and keeps it.
struct Screen {
    recorder: Option<Recorder>,
    is_shown: bool,
    /// Whether what is written is shown piece by piece.
    is_live: bool,
    is_colored: bool,
    /// Whether the cursor stands behind a piece.
    in_line: bool,
}

impl Screen {
    fn say(&mut self, color: &str, text: &str) {
        if !self.is_shown {
            return;
        }
        if std::mem::take(&mut self.in_line) {
            note("");
        }
        note(&self.paint(color, &printable(text)));
    }

    fn paint(&self, color: &str, text: &str) -> String {
        if self.is_colored { format!("\u{1b}[{color}m{text}\u{1b}[0m") } else { text.to_owned() }
    }

    /// The reply in one go, where it was not shown as it came.
    fn reply(&mut self, reply: &str) {
        if !self.is_live && !reply.trim().is_empty() {
            self.say("2", reply.trim());
        }
    }

    fn keep(&self, what: &str, more: serde_json::Value) {
        if let Some(recorder) = &self.recorder {
            recorder.write(what, more);
        }
    }
}

impl ModelObserver for Screen {
    fn hear(&mut self, happening: &ModelEvent<'_>) {
        match *happening {
            ModelEvent::Asked { round, model, chat } => {
                let again = if round == 0 { String::new() } else { format!(", repair {round}") };
                self.say("1", &format!("asking {model}{again}"));
                let message = |message: &model::Message| {
                    let role = match message.role {
                        Role::System => "system",
                        Role::User => "user",
                        Role::Assistant => "assistant",
                    };
                    json!({"role": role, "text": message.text})
                };
                let chat: Vec<_> = chat.iter().map(message).collect();
                self.keep("asked", json!({"round": round, "model": model, "chat": chat}));
            }
            ModelEvent::Retrying { why, after } => {
                self.say("33", &format!("  again in {:.1} s: {why}", after.as_secs_f64()));
                self.keep("retrying", json!({"why": why, "after": after.as_secs_f64()}));
            }
            ModelEvent::Wrote(piece) => {
                if self.is_shown && self.is_live {
                    // Nothing can be done where that fails.
                    let _ = write!(io::stderr().lock(), "{}", self.paint("2", &printable(piece)));
                    self.in_line = true;
                }
            }
            ModelEvent::Stopped { at } => {
                self.say("31", &format!("  stopped at byte {at}"));
                self.keep("stopped", json!({"at": at}));
            }
            ModelEvent::Mended { titles } => {
                self.say("33", &format!("  mended: {}", titles.join(", ")));
                self.keep("mended", json!({"titles": titles}));
            }
            ModelEvent::Refused { round, reply, findings } => {
                self.reply(reply);
                findings.lines().for_each(|line| self.say("31", &format!("  {line}")));
                self.keep("refused", json!({"round": round, "reply": reply, "findings": findings}));
            }
            ModelEvent::Failed { round, reply, why } => {
                self.reply(reply);
                self.say("31", &format!("  {why}"));
                self.keep("failed", json!({"round": round, "reply": reply, "why": why.to_string()}));
            }
            ModelEvent::Taken { round, reply } => {
                self.reply(reply);
                self.say("32", "  it passes the check");
                self.keep("taken", json!({"round": round, "reply": reply}));
            }
            ModelEvent::Begun { reply } => {
                self.say("32", "  the first step begins");
                self.keep("begun", json!({"reply": reply}));
            }
        }
    }

    fn is_stopped(&self) -> bool {
        run::is_interrupted()
    }
}

/// A text of a model without what a terminal would obey.
pub(super) fn printable(text: &str) -> String {
    text.chars().filter(|letter| !letter.is_control() || *letter == '\n').collect()
}
