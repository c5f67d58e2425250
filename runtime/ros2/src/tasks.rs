//! `motet ros2 tasks`: an action server that runs policies, for ROS 2 nodes that ask Motet.

mod answers;

use crate::action::{Uuid, uuid};
use crate::cdr::{Message, decode, encode};
use crate::dds::{Dds, Quality, Received, Source, Writer, dds_topic, dds_type};
use crate::layout::{Distribution, Layouts};
use crate::lines::{Output, note};
use crate::service::{Interface, Middleware, PendingRequest, Server};
use answers::{Answer, OpenQuestion, Page};
use crossbeam_channel::{Receiver, Sender, bounded, select, tick};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Type of the action.
const TYPE: &str = "motet_msgs/RunPolicy";
/// Greatest size of a policy in bytes.
const MAX_POLICY: usize = 1024 * 1024;
/// Most characters of standard error that a result has.
const MAX_TEXT: usize = 10_000;
/// Messages, and lines of a run, that wait to be taken in.
const WAITING: usize = 4_096;
/// Ended goals whose result is kept, and for how long.
const KEPT: usize = 100;
const KEEPS: Duration = Duration::from_secs(900);

/// Number of the subscription of answers.
const ANSWERS: Source = 3;

/// Codes of `action_msgs/GoalStatus`.
const EXECUTING: i8 = 2;
const CANCELING: i8 = 3;
const SUCCEEDED: i8 = 4;
const CANCELED: i8 = 5;
const ABORTED: i8 = 6;

#[derive(clap::Args, Debug)]
pub(crate) struct TasksArgs {
    /// Robot of the policies: a built-in name, or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: String,
    /// Scene: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    scene: String,
    /// Driver of the runs, as in `motet run`
    #[arg(long, value_name = "DRIVER", default_value = "kinematic")]
    driver: String,
    /// Name of the action; its topics of state, questions and answers stand beside it
    #[arg(long, value_name = "NAME", default_value = "/motet/run_policy")]
    action: String,
    /// Let nodes answer the questions of policies on the topic `answers`, instead of the driver
    #[arg(long)]
    answers: bool,
    /// Distribution of ROS 2
    #[arg(long, default_value = "jazzy", value_name = "NAME")]
    distribution: Distribution,
    /// Middleware of the nodes that ask: `fastdds` or `cyclonedds`
    #[arg(long, default_value = "fastdds", value_name = "NAME", value_parser = middleware)]
    middleware: Middleware,
    /// Domain of DDS [default: ROS_DOMAIN_ID, or 0]
    #[arg(long, value_name = "NUMBER")]
    domain: Option<u16>,
    /// Command `motet` [default: from PATH]
    #[arg(long, value_name = "FILE")]
    motet: Option<PathBuf>,
}

fn middleware(text: &str) -> Result<Middleware, String> {
    match text {
        "fastdds" => Ok(Middleware::Fastdds),
        "cyclonedds" => Ok(Middleware::Cyclonedds),
        _ => Err("write fastdds or cyclonedds".to_owned()),
    }
}

/// What a run said.
enum RunMessage {
    Event(Uuid, String),
    /// Page at which it takes answers.
    Page(Uuid, Page),
    /// Fate of an answer to a question.
    Answered(String, Result<(), String>),
    Ended(Uuid, i32, String),
}

struct Goal {
    id: Uuid,
    status: i8,
    result: Value,
    asked: Vec<PendingRequest>,
    child: Option<u32>,
    page: Option<Page>,
    question: Option<OpenQuestion>,
    at: Instant,
}

struct Tasks<'a> {
    args: &'a TasksArgs,
    layouts: Layouts,
    send: Server,
    result: Server,
    cancel: Server,
    feedback: Writer,
    status: Writer,
    state: Writer,
    questions: Writer,
    goals: Vec<Goal>,
    said: Sender<RunMessage>,
}

/// Serves the action until the process is ended.
///
/// # Errors
///
/// DDS does not start.
pub(crate) fn serve(args: &TasksArgs) -> Result<u8, String> {
    let (sender, received) = bounded(WAITING);
    let of_environment = || std::env::var("ROS_DOMAIN_ID").ok()?.trim().parse().ok();
    let dds = Dds::join(args.domain.or_else(of_environment).unwrap_or(0), &[], sender)?;
    // A run that says more than is told waits.
    let (said, heard) = bounded(WAITING);
    let mut tasks = Tasks::open(args, &dds, said)?;
    // Whoever starts it may not read.
    let ready = Output::open(std::io::stdout());
    let _ = ready.write("ready".to_owned());
    tasks.run(&received, &heard)
}

impl<'a> Tasks<'a> {
    fn open(args: &'a TasksArgs, dds: &Dds, said: Sender<RunMessage>) -> Result<Self, String> {
        let layouts = Layouts::of(args.distribution, None)?;
        let server = |service: &str, interface: Interface<'_>, source: Source| {
            Server::new(
                dds,
                args.middleware,
                &format!("{}/_action/{service}", args.action),
                interface,
                source,
            )
        };
        let own = |end| Interface { name: TYPE, kind: "action", end };
        let cancel = Interface { name: "action_msgs/CancelGoal", kind: "srv", end: "" };
        let beside = args.action.rsplit_once('/').map_or("", |(folder, _)| folder);
        let text = dds_type("std_msgs/String", "msg", "");
        let publish = |topic: &str, type_name: &str, quality| {
            dds.publish(&dds_topic("rt", topic, ""), type_name, quality)
        };
        let part = |end: &str| format!("{}/_action/{end}", args.action);
        if args.answers {
            dds.subscribe(
                &dds_topic("rt", &format!("{beside}/answers"), ""),
                &text,
                Quality::Reliable,
                ANSWERS,
            )?;
        }
        let feedback = dds_type(TYPE, "action", "_FeedbackMessage");
        let states = dds_type("action_msgs/GoalStatusArray", "msg", "");
        Ok(Self {
            args,
            layouts,
            send: server("send_goal", own("_SendGoal"), 0)?,
            result: server("get_result", own("_GetResult"), 1)?,
            cancel: server("cancel_goal", cancel, 2)?,
            feedback: publish(&part("feedback"), &feedback, Quality::Reliable)?,
            status: publish(&part("status"), &states, Quality::Latched)?,
            state: publish(&format!("{beside}/state"), &text, Quality::Latched)?,
            questions: publish(&format!("{beside}/questions"), &text, Quality::Reliable)?,
            goals: Vec::new(),
            said,
        })
    }

    fn run(&mut self, received: &Receiver<Received>, heard: &Receiver<RunMessage>) -> Result<u8, String> {
        let ticks = tick(Duration::from_secs(1));
        loop {
            let done = select! {
                recv(received) -> message => message.map_err(|_| "DDS has ended".to_owned()).map(|message| {
                    if let Err(wrong) = self.hear(&message) {
                        note(&wrong);
                    }
                }),
                recv(heard) -> said => {
                    said.map_err(|_| "no run can say anything".to_owned()).map(|said| self.take(said))
                }
                recv(ticks) -> _ => {
                    self.goals.retain(|goal| goal.status <= CANCELING || goal.at.elapsed() < KEEPS);
                    Ok(())
                }
            };
            done?;
        }
    }

    fn hear(&mut self, message: &Received) -> Result<(), String> {
        match message.source {
            0 => {
                let (asked, request) = self.send.hear(&self.layouts, message)?;
                let accepted = self.begin(&request);
                if let Err(why) = &accepted {
                    note(&format!("a policy is refused: {why}"));
                }
                self.send.answer(&self.layouts, asked, &json!({"accepted": accepted.is_ok()}))?;
                self.tell();
            }
            1 => {
                let (asked, request) = self.result.hear(&self.layouts, message)?;
                let id = uuid(&request, "goal_id");
                match self.goals.iter_mut().find(|goal| Some(goal.id) == id) {
                    Some(goal) => goal.asked.push(asked),
                    None => self.result.answer(&self.layouts, asked, &json!({"status": 0}))?,
                }
                self.answer_results();
            }
            ANSWERS => {
                let text = decode(&self.layouts, "std_msgs/String", &message.bytes)?;
                self.answer(text.text("data"));
            }
            _ => {
                let (asked, request) = self.cancel.hear(&self.layouts, message)?;
                let id = uuid(&request, "goal_info.goal_id");
                let is_meant = |goal: &&mut Goal| id.is_some_and(|id| id == goal.id || id == [0; 16]);
                let running = self.goals.iter_mut().filter(|goal| goal.status <= CANCELING);
                let mut infos = Vec::new();
                for goal in running.filter(is_meant) {
                    goal.status = CANCELING;
                    infos.push(json!({"goal_id": {"uuid": goal.id}}));
                    goal.child.into_iter().for_each(interrupt);
                }
                let code = if infos.is_empty() { 2 } else { 0 };
                let answer = json!({"return_code": code, "goals_canceling": infos});
                self.cancel.answer(&self.layouts, asked, &answer)?;
                self.tell();
            }
        }
        Ok(())
    }

    /// Passes an answer on to the run that asks. The first one counts.
    fn answer(&mut self, text: &str) {
        let (question, refused) = match Answer::read(text) {
            Err(why) => (String::new(), why),
            Ok(answer) => {
                let asks =
                    |goal: &&mut Goal| goal.question.as_ref().is_some_and(|open| open.id == answer.question);
                let goal = self.goals.iter_mut().find(asks);
                let open = goal.and_then(|goal| Some((goal.page.clone()?, goal.question.take()?)));
                if let Some((page, open)) = open {
                    let said = self.said.clone();
                    // The page may take its time.
                    std::thread::spawn(move || {
                        let done = page.answer(&open, &answer);
                        let _ = said.send(RunMessage::Answered(open.id, done));
                    });
                    return;
                }
                (answer.question, "no such question is open".to_owned())
            }
        };
        self.take(RunMessage::Answered(question, Err(refused)));
    }

    /// Starts the run of a policy. One runs at a time.
    fn begin(&mut self, request: &Message) -> Result<(), String> {
        let id = uuid(request, "goal_id").ok_or("the goal has no id")?;
        let policy = request.text("goal.policy");
        if self.goals.iter().any(|goal| goal.status <= CANCELING) {
            return Err("another policy runs".to_owned());
        }
        if self.goals.iter().any(|goal| goal.id == id) {
            return Err("the goal has run before".to_owned());
        }
        if policy.len() > MAX_POLICY {
            return Err(format!("it has more than {MAX_POLICY} bytes"));
        }
        let end = if policy.trim_start().starts_with('{') { "json" } else { "motet" };
        let digits = hexadecimal(id);
        let file = std::env::temp_dir().join(format!("motet-task-{digits}.{end}"));
        std::fs::write(&file, policy).map_err(|error| format!("{}: {error}", file.display()))?;
        let program =
            self.args.motet.clone().or_else(|| crate::on_path("motet")).ok_or("`motet` is not in PATH")?;
        let page = self.args.answers.then_some("--view");
        let child = Command::new(program)
            .arg("run")
            .args(page)
            .arg(&file)
            .args(["--robot", &self.args.robot, "--scene", &self.args.scene, "--driver", &self.args.driver])
            .args(["--format", "json"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn();
        let child = child.map_err(|error| format!("`motet` cannot be started: {error}"))?;
        let (number, said) = (child.id(), self.said.clone());
        std::thread::spawn(move || follow(child, id, &file, &said));
        self.goals.push(Goal {
            id,
            status: EXECUTING,
            result: Value::Null,
            asked: Vec::new(),
            child: Some(number),
            page: None,
            question: None,
            at: Instant::now(),
        });
        if self.goals.len() > KEPT {
            self.goals.remove(0);
        }
        Ok(())
    }

    fn take(&mut self, said: RunMessage) {
        match said {
            RunMessage::Event(id, event) => {
                if let Ok(line) = serde_json::from_str::<Value>(&event) {
                    self.take_question(id, &line);
                }
                self.publish(&self.state, "std_msgs/String", &json!({"data": event}));
                let message = json!({"goal_id": {"uuid": id}, "feedback": {"event": event}});
                self.publish(&self.feedback, &format!("{TYPE}_FeedbackMessage"), &message);
            }
            RunMessage::Page(id, page) => {
                let goal = self.goals.iter_mut().find(|goal| goal.id == id);
                goal.into_iter().for_each(|goal| goal.page = Some(page.clone()));
            }
            RunMessage::Answered(question, done) => {
                let event = json!({"event": "answer", "question": question, "taken": done.is_ok(),
                    "why": done.err()});
                self.publish(&self.state, "std_msgs/String", &json!({"data": event.to_string()}));
            }
            RunMessage::Ended(id, code, text) => {
                if let Some(goal) = self.goals.iter_mut().find(|goal| goal.id == id) {
                    goal.status = match (goal.status, code) {
                        (_, 0) => SUCCEEDED,
                        (CANCELING, _) => CANCELED,
                        _ => ABORTED,
                    };
                    goal.child = None;
                    goal.at = Instant::now();
                    goal.result = json!({"code": code, "text": text});
                }
                self.tell();
                self.answer_results();
            }
        }
    }

    /// Tells nodes of a question, and keeps it as long as it is open.
    fn take_question(&mut self, id: Uuid, event: &Value) {
        let digits = hexadecimal(id);
        let Some(goal) = self.goals.iter_mut().find(|goal| goal.id == id) else { return };
        goal.question.take_if(|open| open.is_over(event));
        let Some(open) = OpenQuestion::of_event(event, &digits) else { return };
        let message = json!({"data": open.message().to_string()});
        goal.question = Some(open);
        self.publish(&self.questions, "std_msgs/String", &message);
    }

    /// Answers those who asked for the result of a goal that has ended.
    fn answer_results(&mut self) {
        for goal in self.goals.iter_mut().filter(|goal| goal.status > CANCELING) {
            for asked in goal.asked.drain(..) {
                let answer = json!({"status": goal.status, "result": goal.result});
                if let Err(wrong) = self.result.answer(&self.layouts, asked, &answer) {
                    note(&wrong);
                }
            }
        }
    }

    fn tell(&self) {
        let state = |goal: &Goal| json!({"goal_info": {"goal_id": {"uuid": goal.id}}, "status": goal.status});
        let states: Vec<Value> = self.goals.iter().map(state).collect();
        self.publish(&self.status, "action_msgs/GoalStatusArray", &json!({"status_list": states}));
    }

    fn publish(&self, writer: &Writer, type_name: &str, message: &Value) {
        let sent = encode(&self.layouts, type_name, message).and_then(|bytes| writer.write(bytes, None));
        if let Err(wrong) = sent {
            note(&wrong);
        }
    }
}

/// Reads what a run prints until it ends.
fn follow(mut child: Child, id: Uuid, file: &std::path::Path, said: &Sender<RunMessage>) {
    let errors = child.stderr.take().map(|stderr| {
        let said = said.clone();
        std::thread::spawn(move || {
            let (mut text, mut stderr) = (Vec::new(), BufReader::new(stderr));
            let mut first = stderr.by_ref().take(64 * 1024);
            let mut line = Vec::new();
            while first.read_until(b'\n', &mut line).is_ok_and(|read| read > 0) {
                match Page::of_line(&String::from_utf8_lossy(&line)) {
                    // Its token is for nobody else.
                    Some(page) => drop(said.send(RunMessage::Page(id, page))),
                    None => text.extend_from_slice(&line),
                }
                line.clear();
            }
            // The rest is read, so that the run does not wait for a reader.
            let _ = std::io::copy(&mut stderr, &mut std::io::sink());
            text
        })
    });
    if let Some(stdout) = child.stdout.take() {
        for line in BufReader::new(stdout).lines().map_while(Result::ok) {
            let _ = said.send(RunMessage::Event(id, line));
        }
    }
    let text = errors.and_then(|errors| errors.join().ok()).unwrap_or_default();
    let text: String =
        String::from_utf8_lossy(&text).chars().filter(|letter| *letter != '\0').take(MAX_TEXT).collect();
    let code = child.wait().ok().and_then(|status| status.code()).unwrap_or(130);
    let _ = std::fs::remove_file(file);
    let _ = said.send(RunMessage::Ended(id, code, text));
}

fn hexadecimal(id: Uuid) -> String {
    id.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Asks a run to stop, as Ctrl-C does.
fn interrupt(process: u32) {
    let process = i32::try_from(process).ok().and_then(rustix::process::Pid::from_raw);
    if let Some(process) = process {
        let _ = rustix::process::kill_process(process, rustix::process::Signal::INT);
    }
}
