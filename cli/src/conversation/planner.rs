//! Planner of a conversation: the built-in one, or a model on a server with a log of its replies.

use std::io::{self, IsTerminal};

use motet_client::{Client, ClientSettings, EncodedImage};
use motet_compiler::CheckOptions;
use motet_planner::builtin::{PlanError, PlannedRequest};
use motet_planner::model::{self, ModelEvent, ModelObserver, ModelPlanner, Role, Start};
use motet_planner::runtime_check::CheckMode;
use motet_planner::{BackgroundBuiltin, Builtin, PlanRequest, Planner, RemainingSteps, Wait};
use motet_project::files::read_small;
use serde_json::json;

use super::flags::{ConversationArgs, ModelArgs};
use super::record::ConversationRecord;
use crate::error::CliError;
use crate::flags::{CarrierArg, OutputFormat, Speed};
use crate::interrupt::is_interrupted;
use crate::output::{Colors, note, printable, prompt, styled_note};

/// Planner of the flags.
pub(super) fn planner(
    args: &ConversationArgs,
    speed: Speed,
    options: CheckOptions,
    colors: Colors,
    record: Option<ConversationRecord>,
) -> Result<Box<dyn Planner>, CliError> {
    let flags = &args.model;
    if flags.planner == "builtin" {
        if flags.camera {
            let why = "--camera needs a model: give one with --planner URL, or leave --camera out";
            return Err(CliError::Message(why.to_owned()));
        }
        let unused = [
            ("--model", flags.server.model != "default"),
            ("--dialect", flags.server.dialect.0.is_some()),
            ("--image", !flags.image.is_empty()),
            ("--key-from or --key-file", flags.server.key.is_given()),
            ("--eager", flags.eager),
            ("--carrier", flags.server.carrier != CarrierArg::default()),
            ("--fallback", flags.fallback),
        ];
        if let Some((flag, _)) = unused.iter().find(|(_, is_given)| *is_given) {
            let why = format!("{flag} needs a model: give one with --planner URL, or leave {flag} out");
            return Err(CliError::Message(why));
        }
        // In virtual time a plan takes no time, so that every run is the same.
        return Ok(match speed.verifies() {
            CheckMode::AtOnce => Box::new(Builtin),
            CheckMode::Background => Box::new(BackgroundBuiltin::default()),
        });
    }
    let client = client(flags)?;
    let log = ModelLog {
        record,
        is_shown: args.format == OutputFormat::Human,
        is_live: io::stderr().is_terminal(),
        is_colored: colors.stderr,
        in_line: false,
    };
    // The first step alone does not show whether the whole policy keeps the maximum duration.
    let is_bounded = options.max_duration_secs.is_some();
    let start = if flags.eager && !is_bounded { Start::FirstStep } else { Start::Whole };
    let checks = speed.verifies();
    let settings =
        model::Settings { repairs: flags.server.repair, start, checks, ..model::Settings::default() };
    let planner = ModelPlanner::new(client, log, settings);
    Ok(if flags.fallback { Box::new(FallbackPlanner(planner)) } else { Box::new(planner) })
}

/// Connection to the server of the flags.
pub(super) fn client(flags: &ModelArgs) -> Result<Client, CliError> {
    let settings = settings(flags)?;
    let name = settings.address.to_string();
    Client::new(settings).map_err(|why| CliError::Message(format!("cannot ask `{name}`: {why}")))
}

fn settings(args: &ModelArgs) -> Result<ClientSettings, CliError> {
    let settings = args.server.settings(&args.planner)?;
    let mut images = Vec::new();
    for path in &args.image {
        let image = EncodedImage::new(&read_small(path)?).map_err(|why| {
            CliError::Message(format!("`{}` is not an image for a model: {why}", path.display()))
        })?;
        images.push(image);
    }
    Ok(ClientSettings { images, ..settings })
}

/// Model planner with the built-in planner behind it.
struct FallbackPlanner(ModelPlanner<'static>);

impl Planner for FallbackPlanner {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        match self.0.plan(ask) {
            Err(why @ (PlanError::NoModel { .. } | PlanError::Refused { .. })) => {
                note(&format!("planned without the model: {why}"));
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

/// Log of a model's replies: on stderr for people, and in the record.
struct ModelLog {
    record: Option<ConversationRecord>,
    is_shown: bool,
    /// Shows replies piece by piece as they arrive.
    is_live: bool,
    is_colored: bool,
    /// Is `true` if the cursor is behind a piece of a reply.
    in_line: bool,
}

impl ModelLog {
    fn show(&mut self, color: &str, text: &str) {
        if !self.is_shown {
            return;
        }
        if std::mem::take(&mut self.in_line) {
            note("");
        }
        styled_note(&self.paint(color, &printable(text)));
    }

    fn paint(&self, color: &str, text: &str) -> String {
        if self.is_colored { format!("\u{1b}[{color}m{text}\u{1b}[0m") } else { text.to_owned() }
    }

    /// Shows a reply at once, unless it was shown as it arrived.
    fn reply(&mut self, reply: &str) {
        if !self.is_live && !reply.trim().is_empty() {
            self.show("2", reply.trim());
        }
    }

    fn keep(&self, what: &str, more: serde_json::Value) {
        if let Some(record) = &self.record {
            record.write(what, more);
        }
    }
}

impl ModelObserver for ModelLog {
    fn hear(&mut self, happening: &ModelEvent<'_>) {
        match *happening {
            ModelEvent::Asked { round, model, chat } => {
                let again = if round == 0 { String::new() } else { format!(", repair {round}") };
                self.show("1", &format!("asking {model}{again}"));
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
                self.show("33", &format!("  retrying in {:.1} s: {why}", after.as_secs_f64()));
                self.keep("retrying", json!({"why": why, "after": after.as_secs_f64()}));
            }
            ModelEvent::Wrote(piece) => {
                if self.is_shown && self.is_live {
                    prompt(&self.paint("2", &printable(piece)));
                    self.in_line = true;
                }
            }
            ModelEvent::Used(usage) => {
                self.keep("used", json!({"input_tokens": usage.input, "output_tokens": usage.output}));
            }
            ModelEvent::Said { round, words } => {
                self.reply(words);
                self.keep("said", json!({"round": round, "words": words}));
            }
            ModelEvent::Unmet { goal } => {
                self.show("33", &format!("  does not reach {goal}, a guess at the goal"));
                self.keep("unmet", json!({"goal": goal, "certain": false}));
            }
            ModelEvent::Mended { titles } => {
                self.show("33", &format!("  fixed: {}", titles.join(", ")));
                self.keep("mended", json!({"titles": titles}));
            }
            ModelEvent::Refused { round, reply, findings } => {
                self.reply(reply);
                findings.lines().for_each(|line| self.show("31", &format!("  {line}")));
                self.keep("refused", json!({"round": round, "reply": reply, "findings": findings}));
            }
            ModelEvent::Failed { round, reply, why } => {
                self.reply(reply);
                self.show("31", &format!("  {why}"));
                self.keep("failed", json!({"round": round, "reply": reply, "why": why.to_string()}));
            }
            ModelEvent::Taken { round, reply } => {
                self.reply(reply);
                self.show("32", "  passes the check");
                self.keep("taken", json!({"round": round, "reply": reply}));
            }
            ModelEvent::Begun { reply } => {
                self.show("32", "  starting the first step");
                self.keep("begun", json!({"reply": reply}));
            }
        }
    }

    fn is_stopped(&self) -> bool {
        is_interrupted()
    }
}
