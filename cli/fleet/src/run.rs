//! The run of one order: a process `motet run` with a journal, which goes on whatever becomes of the agent.

use crate::signed::{What, Words};
use serde_json::{Value, json};
use std::fs::File;
use std::io::{Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::OnceLock;
use std::time::Duration;
use tokio::process::{Child, Command};

/// Greatest number of bytes of events that are read at a time.
const CHUNK: u64 = 1024 * 1024;
/// Most findings of a result.
const MAX_FINDINGS: usize = 50;
/// Time for an answer of the page of a run.
const ANSWERS: Duration = Duration::from_secs(35);

/// How runs are started.
#[derive(Clone, Debug)]
pub(crate) struct RunSettings {
    pub(crate) motet: PathBuf,
    pub(crate) robot: String,
    pub(crate) scene: String,
    pub(crate) driver: String,
    pub(crate) speed: Option<String>,
}

/// Folder of an order on the robot's disk.
#[derive(Clone, Debug)]
pub(crate) struct OrderFolder(pub(crate) PathBuf);

impl OrderFolder {
    /// Makes the folder of an order, with the order in it, before anything moves.
    pub(crate) fn create(root: &Path, words: &Words) -> Result<Self, String> {
        let folder = Self(root.join(&words.id));
        std::fs::create_dir_all(&folder.0).map_err(|error| format!("{}: {error}", folder.0.display()))?;
        if let What::Run { policy, state } = &words.what {
            if let Some(state) = state {
                folder.write("state.json", state.to_string().as_bytes())?;
            }
            folder.write(policy_file(policy), policy.as_bytes())?;
        }
        let order = serde_json::to_vec(words).map_err(|error| error.to_string())?;
        folder.write("order.json", &order)?;
        Ok(folder)
    }

    /// Writes a file so that it is there as a whole or not at all.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let (path, draft) = (self.0.join(name), self.0.join(format!("{name}.new")));
        let write = || -> std::io::Result<()> {
            let mut file = File::create(&draft)?;
            file.write_all(bytes)?;
            file.sync_all()?;
            std::fs::rename(&draft, &path)?;
            File::open(&self.0)?.sync_all()
        };
        write().map_err(|error| format!("{}: {error}", path.display()))
    }

    /// Result of an order that has ended.
    pub(crate) fn result(&self) -> Option<Value> {
        let bytes = std::fs::read(self.0.join("result.json")).ok()?;
        serde_json::from_slice(&bytes).ok()
    }

    /// True if the folder has the order.
    pub(crate) fn has_order(&self) -> bool {
        self.0.join("order.json").is_file()
    }

    pub(crate) fn journal(&self) -> PathBuf {
        self.0.join("run")
    }

    /// True while a process writes the journal.
    pub(crate) fn is_running(&self) -> bool {
        let Ok(lock) = File::open(self.journal().join("lock")) else { return false };
        let is_free = fs4::fs_std::FileExt::try_lock_exclusive(&lock).unwrap_or(false);
        if is_free {
            let _ = fs4::fs_std::FileExt::unlock(&lock);
        }
        !is_free
    }

    /// Address and token of the page of the run, from what its process has printed.
    pub(crate) fn page(&self) -> Option<(String, String)> {
        let text = std::fs::read_to_string(self.0.join("errors.log")).ok()?;
        let address = text.lines().rev().find_map(|line| line.strip_prefix("the page is at "))?;
        let (page, token) = address.trim().split_once("/#")?;
        Some((page.to_owned(), token.to_owned()))
    }

    /// Starts the run, or continues it if it was cut off. Its output goes to files, so that it goes on
    /// without the agent.
    pub(crate) fn start(&self, settings: &RunSettings) -> Result<Child, String> {
        let wrong = |error: std::io::Error| format!("{}: {error}", self.0.display());
        let append =
            |name: &str| File::options().create(true).append(true).open(self.0.join(name)).map_err(wrong);
        let is_resumed = std::fs::read_dir(self.journal()).is_ok_and(|mut files| {
            files.any(|file| {
                file.is_ok_and(|file| file.path().extension().is_some_and(|end| end == "journal"))
            })
        });
        let mut command = Command::new(&settings.motet);
        command.arg("run");
        if is_resumed {
            command.arg("--resume").arg(self.journal());
        } else {
            let policy = ["policy.motet", "policy.json"]
                .map(|name| self.0.join(name))
                .into_iter()
                .find(|path| path.is_file());
            command.arg(policy.ok_or("the order has no policy")?);
            command
                .args(["--robot", &settings.robot, "--scene", &settings.scene])
                .arg("--record")
                .arg(self.journal());
            let state = self.0.join("state.json");
            if state.is_file() {
                command.arg("--state").arg(state);
            }
        }
        if !is_resumed || settings.driver != "kinematic" {
            command.args(["--driver", &settings.driver]);
        }
        if let Some(speed) = &settings.speed {
            command.args(["--speed", speed]);
        }
        command.args(["--view=127.0.0.1:0", "--format", "json"]);
        command.stdin(Stdio::null()).stdout(append("events.jsonl")?).stderr(append("errors.log")?);
        // A signal for the agent is not one for the run.
        command.process_group(0);
        command.spawn().map_err(|error| format!("cannot start `{}`: {error}", settings.motet.display()))
    }

    /// Result of a run whose process has ended with a code; without one, of a process that this agent has not
    /// started. `None` if the run was cut off and can go on.
    pub(crate) fn ending(&self, code: Option<i32>) -> Option<Value> {
        let events = std::fs::read_to_string(self.0.join("events.jsonl")).unwrap_or_default();
        let events: Vec<Value> = events.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        let named = |name: &'static str| {
            move |event: &&Value| event.get("event").and_then(Value::as_str) == Some(name)
        };
        if let Some(finished) = events.iter().rfind(named("finished")) {
            let outcome = finished.get("outcome").cloned().unwrap_or_default();
            return Some(json!({"state": "ended", "outcome": outcome, "why": finished.get("why")}));
        }
        let findings: Vec<&Value> = events.iter().filter(named("diagnostic")).take(MAX_FINDINGS).collect();
        match code {
            Some(1) => {
                Some(json!({"state": "refused", "why": "the check refuses the policy", "findings": findings}))
            }
            Some(2) => {
                let said = std::fs::read_to_string(self.0.join("errors.log")).unwrap_or_default();
                let why =
                    said.lines().rfind(|line| line.starts_with("error")).unwrap_or("the run could not start");
                Some(json!({"state": "refused", "why": why.chars().take(500).collect::<String>()}))
            }
            _ => None,
        }
    }
}

/// Name of the file of a policy.
fn policy_file(policy: &str) -> &'static str {
    if policy.trim_start().starts_with('{') { "policy.json" } else { "policy.motet" }
}

/// Reader of the events of a run, as its process writes them.
#[derive(Debug, Default)]
pub(crate) struct Events {
    read: u64,
    rest: String,
    /// Step that runs, and the question that is open: its id and its text.
    pub(crate) step: String,
    pub(crate) question: Option<(String, String)>,
}

impl Events {
    /// Reads what is new. True if the step or the question has changed.
    pub(crate) fn follow(&mut self, folder: &OrderFolder) -> bool {
        let Ok(mut file) = File::open(folder.0.join("events.jsonl")) else { return false };
        let mut bytes = Vec::new();
        let read =
            file.seek(SeekFrom::Start(self.read)).and_then(|_| file.take(CHUNK).read_to_end(&mut bytes));
        self.read += read.unwrap_or(0) as u64;
        self.rest.push_str(&String::from_utf8_lossy(&bytes));
        let before = (self.step.clone(), self.question.clone());
        while let Some(end) = self.rest.find('\n') {
            let line: String = self.rest.drain(..=end).collect();
            if let Ok(event) = serde_json::from_str(&line) {
                self.take(&event);
            }
        }
        before != (self.step.clone(), self.question.clone())
    }

    fn take(&mut self, event: &Value) {
        let text = |name: &str| event.get(name).and_then(Value::as_str).unwrap_or_default();
        match text("event") {
            "started" => self.step = text("step").chars().take(200).collect(),
            "command" => {
                if let Some(question) = event.pointer("/args/question").and_then(Value::as_str) {
                    let words = question.chars().take(1_000).collect();
                    self.question = Some((format!("1:{}", text("goal")), words));
                }
            }
            "goal_ended" | "ended" | "finished" => self.question = None,
            _ => {}
        }
    }
}

/// The one client for all pages: making it reads certificates, which takes longer than a request.
pub(crate) fn client() -> &'static reqwest::Client {
    static CLIENT: OnceLock<reqwest::Client> = OnceLock::new();
    CLIENT.get_or_init(|| {
        let client = reqwest::Client::builder().no_proxy().timeout(ANSWERS).build();
        client.unwrap_or_default()
    })
}

/// Sends something to the page of a run; the answer, or the reason that there is none.
pub(crate) async fn tell_page(
    folder: &OrderFolder,
    path: &str,
    body: String,
    kind: &str,
) -> Result<Value, Value> {
    let refused = |why: String| json!({"problem": why});
    let (page, token) = folder.page().ok_or_else(|| refused("the run has no page yet".to_owned()))?;
    let request =
        client().post(format!("{page}{path}")).header("x-motet-token", token).header("content-type", kind);
    let answer = request.body(body).send().await.map_err(|_| refused("the run is over".to_owned()))?;
    let status = answer.status();
    let text = answer.text().await.unwrap_or_default();
    let value = serde_json::from_str(&text).unwrap_or(json!({"problem": text}));
    if status.is_success() { Ok(value) } else { Err(value) }
}
