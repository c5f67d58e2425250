//! The run of one order: a process `motet run` with a journal, which goes on whatever becomes of the agent.

use crate::signed::{Instruction, SignedMessage};
use serde_json::{Value, json};
use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::OnceLock;
use std::time::Duration;
use tokio::process::{Child, Command};

/// File with the events of a run. A process of the run locks it.
const EVENTS: &str = "events.jsonl";
/// File that is there once somebody wants the run to stop; it may have the reason.
const STOP: &str = "stop";
/// File with the address and the token of the page of a run, for its owner alone.
const PAGE: &str = "page";
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
    pub(crate) fn create(root: &Path, order: &SignedMessage) -> Result<Self, String> {
        let words = &order.words;
        let folder = Self(root.join(&words.id));
        std::fs::create_dir_all(&folder.0).map_err(|error| format!("{}: {error}", folder.0.display()))?;
        if let Instruction::Run { policy, state } = &words.what {
            if let Some(state) = state {
                folder.write("state.json", state.to_string().as_bytes())?;
            }
            folder.write(policy_file(policy), policy.as_bytes())?;
        }
        let order = serde_json::to_vec(order).map_err(|error| error.to_string())?;
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

    /// The order with the key of who gave it, if it is there as a whole.
    pub(crate) fn order(&self) -> Option<SignedMessage> {
        serde_json::from_slice(&std::fs::read(self.0.join("order.json")).ok()?).ok()
    }

    /// Id of the order.
    pub(crate) fn id(&self) -> String {
        self.0.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
    }

    pub(crate) fn journal(&self) -> PathBuf {
        self.0.join("run")
    }

    /// True while a process of the run is there. It locks its output from before it opens the robot's driver,
    /// and its journal.
    pub(crate) fn is_running(&self) -> bool {
        let is_locked = |path: PathBuf| {
            let Ok(lock) = File::open(path) else { return false };
            let is_free = fs4::fs_std::FileExt::try_lock_exclusive(&lock).unwrap_or(false);
            if is_free {
                let _ = fs4::fs_std::FileExt::unlock(&lock);
            }
            !is_free
        };
        is_locked(self.0.join(EVENTS)) || is_locked(self.journal().join("lock"))
    }

    /// True if the journal of the run has a line: something may have moved.
    pub(crate) fn has_begun(&self) -> bool {
        let Some(first) = segments(&self.journal()).into_iter().next() else { return false };
        let is_whole = |file: File| {
            let mut line = Vec::new();
            BufReader::new(file).read_until(b'\n', &mut line).is_ok_and(|_| line.ends_with(b"\n"))
        };
        File::open(first).is_ok_and(is_whole)
    }

    /// True if somebody wants the run to stop, whatever becomes of its process.
    pub(crate) fn is_stopped(&self) -> bool {
        self.0.join(STOP).exists()
    }

    /// Notes that somebody wants the run to stop, and why if there is more to say. The first reason counts.
    pub(crate) fn want_stop(&self, why: &str) -> Result<(), String> {
        if self.is_stopped() { Ok(()) } else { self.write(STOP, why.as_bytes()) }
    }

    /// Reason of a stop.
    fn stop_reason(&self) -> Option<String> {
        std::fs::read_to_string(self.0.join(STOP)).ok().filter(|why| !why.is_empty())
    }

    /// Address and token of the page of the run.
    pub(crate) fn page(&self) -> Option<(String, String)> {
        let address = std::fs::read_to_string(self.0.join(PAGE)).ok()?;
        let (page, token) = address.trim().split_once("/#")?;
        Some((page.to_owned(), token.to_owned()))
    }

    /// Starts the run, or continues it if it was cut off. Its output goes to files, so that it goes on
    /// without the agent.
    pub(crate) fn start(&self, settings: &RunSettings) -> Result<Child, String> {
        let wrong = |error: std::io::Error| format!("{}: {error}", self.0.display());
        let append =
            |name: &str| File::options().create(true).append(true).open(self.0.join(name)).map_err(wrong);
        let events = append(EVENTS)?;
        // The process inherits the lock, and keeps it until it ends.
        if !fs4::fs_std::FileExt::try_lock_exclusive(&events).unwrap_or(false) {
            return Err("the run goes on already".to_owned());
        }
        // The page of a process before this one is gone.
        let _ = std::fs::remove_file(self.0.join(PAGE));
        let is_resumed = self.has_begun();
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
        command.args(["--view=127.0.0.1:0", "--format", "json"]).arg("--view-file").arg(self.0.join(PAGE));
        command.stdin(Stdio::null()).stdout(events).stderr(append("errors.log")?);
        // A signal for the agent is not one for the run.
        command.process_group(0);
        command.spawn().map_err(|error| format!("cannot start `{}`: {error}", settings.motet.display()))
    }

    /// Result of a run whose process has ended with a code; without one, of a process that this agent has not
    /// started. `None` if the run was cut off and can go on.
    pub(crate) fn ending(&self, code: Option<i32>) -> Option<Value> {
        let events = std::fs::read(self.0.join(EVENTS)).unwrap_or_default();
        let events = String::from_utf8_lossy(&events);
        let events: Vec<Value> = events.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        let named = |name: &'static str| {
            move |event: &&Value| event.get("event").and_then(Value::as_str) == Some(name)
        };
        if let Some(finished) = events.iter().rfind(named("finished")) {
            let outcome = finished.get("outcome").cloned().unwrap_or_default();
            let stopped = self.stop_reason().filter(|_| outcome == "interrupted").map(Value::from);
            let why = stopped.as_ref().or(finished.get("why"));
            return Some(json!({"state": "ended", "outcome": outcome, "why": why}));
        }
        // Nothing is refused that may have moved: the run goes on, or it has failed.
        if self.has_begun() {
            return None;
        }
        let findings: Vec<&Value> = events.iter().filter(named("diagnostic")).take(MAX_FINDINGS).collect();
        match code {
            Some(1) => {
                Some(json!({"state": "refused", "why": "the check refuses the policy", "findings": findings}))
            }
            Some(2) => Some(json!({"state": "refused", "why": self.last_error("the run could not start")})),
            _ => None,
        }
    }

    /// Last error that a process of the run has printed.
    pub(crate) fn last_error(&self, otherwise: &str) -> String {
        let said = std::fs::read(self.0.join("errors.log")).unwrap_or_default();
        let said = String::from_utf8_lossy(&said);
        let line = said.lines().rfind(|line| line.starts_with("error")).unwrap_or(otherwise);
        line.chars().take(500).collect()
    }
}

/// Files of a journal, in order.
pub(crate) fn segments(journal: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(journal).into_iter().flatten();
    let paths = files.filter_map(|file| Some(file.ok()?.path()));
    let mut segments: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "journal")).collect();
    segments.sort();
    segments
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
        let Ok(mut file) = File::open(folder.0.join(EVENTS)) else { return false };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn run_that_has_begun_is_not_refused() {
        let root = std::env::temp_dir().join(format!("motet-fleet-run-{}", std::process::id()));
        let folder = OrderFolder(root.clone());
        std::fs::create_dir_all(folder.journal()).unwrap();
        std::fs::write(root.join("errors.log"), "note\nerror: no driver\n").unwrap();
        let segment = folder.journal().join("000000000000.journal");
        std::fs::write(&segment, "{\"head\"").unwrap();
        assert!(!folder.has_begun(), "the first line is torn");
        let refused = folder.ending(Some(2)).unwrap();
        assert_eq!((&refused["state"], &refused["why"]), (&json!("refused"), &json!("error: no driver")));
        std::fs::write(&segment, "{\"head\": 1}\n").unwrap();
        assert!(folder.has_begun());
        assert_eq!(
            (folder.ending(Some(2)), folder.ending(Some(1)), folder.ending(Some(0))),
            (None, None, None)
        );
        std::fs::write(root.join(EVENTS), "{\"event\":\"finished\",\"outcome\":\"done\"}\n").unwrap();
        assert_eq!(folder.ending(Some(0)).unwrap()["outcome"], "done");
        assert!(!folder.is_stopped());
        folder.want_stop("its key is trusted no more").unwrap();
        folder.want_stop("").unwrap();
        assert!(folder.is_stopped());
        assert_eq!(folder.ending(Some(0)).unwrap()["why"], Value::Null, "it was done before");
        std::fs::write(root.join(EVENTS), "{\"event\":\"finished\",\"outcome\":\"interrupted\"}\n").unwrap();
        assert_eq!(folder.ending(Some(0)).unwrap()["why"], "its key is trusted no more");
        std::fs::remove_dir_all(&root).unwrap();
    }

    #[test]
    fn process_of_a_run_keeps_others_away() {
        let root = std::env::temp_dir().join(format!("motet-fleet-lock-{}", std::process::id()));
        std::fs::create_dir_all(&root).unwrap();
        let folder = OrderFolder(root.clone());
        assert!(!folder.is_running());
        let events = File::options().create(true).append(true).open(root.join(EVENTS)).unwrap();
        assert!(fs4::fs_std::FileExt::try_lock_exclusive(&events).unwrap());
        assert!(folder.is_running());
        drop(events);
        assert!(!folder.is_running());
        std::fs::remove_dir_all(&root).unwrap();
    }
}
