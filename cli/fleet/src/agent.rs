//! `motet agent`: runs orders on a robot, lets policies take over, and reports. It goes on without the link.

use crate::link::{Fleet, RESULTS, STATES, ServerArgs, name, refusal, within_message};
use crate::notes::note;
use crate::run::{Events, OrderFolder, RunSettings, tell_page};
use crate::ship::Shipment;
use crate::signed::{
    Instruction, OperatorMessage, SignedMessage, TrustFile, UNTRUSTED, is_name, open, verify,
};
use async_nats::connection::State;
use async_nats::jetstream::{AckKind, Message};
use futures::StreamExt as _;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tokio::time::{sleep, timeout};

/// Time between two looks at a run, and between two states that are told.
pub(crate) const LOOKS: Duration = Duration::from_millis(50);
const TELLS: Duration = Duration::from_secs(2);
/// Time between two messages to the server that an order is still worked at.
const WORKS: Duration = Duration::from_secs(5);
/// Time after which something that the server did not take is tried again.
const AGAIN: Duration = Duration::from_millis(500);
/// Number of times that a run that was cut off is continued, and the longest wait before one.
const RESUMES: u32 = 10;
const MAX_WAIT: Duration = Duration::from_secs(8);
/// Time for something that a run does with the server beside its work.
const BESIDE: Duration = Duration::from_secs(2);

/// Reason of the stop of a run whose order counts no more.
const REVOKED: &str = "the key of the order is trusted no more: the run was stopped";

#[derive(clap::Args, Debug)]
pub(crate) struct AgentArgs {
    /// Name of this robot in the fleet
    #[arg(long, value_name = "NAME", value_parser = name)]
    robot: String,
    #[command(flatten)]
    server: ServerArgs,
    /// File with the public keys of those whose orders this robot follows
    #[arg(long, value_name = "FILE")]
    trust: PathBuf,
    /// Folder for orders, journals and results
    #[arg(long, value_name = "FOLDER", default_value = "motet-agent")]
    folder: PathBuf,
    /// Card of the robot: a built-in name, or a folder with a robot.toml. No policy runs that does not
    /// check against it
    #[arg(long, value_name = "NAME|FOLDER")]
    card: String,
    /// Scene: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    scene: String,
    /// Driver, as in `motet run`
    #[arg(long, value_name = "DRIVER", default_value = "kinematic")]
    driver: String,
    /// Speed of simulated time, as in `motet run`
    #[arg(long, value_name = "max|FACTOR")]
    speed: Option<String>,
    /// Command `motet` [default: next to this executable, or in PATH]
    #[arg(long, value_name = "FILE")]
    motet: Option<PathBuf>,
}

/// The run that goes on.
#[derive(Clone, Debug)]
struct Current {
    order: String,
    folder: OrderFolder,
    step: String,
    question: Option<(String, String)>,
    /// False for a run of an agent before this one, until its order is given out again.
    is_followed: bool,
}

/// What the tasks of an agent share.
pub(crate) struct Agent {
    pub(crate) robot: String,
    pub(crate) root: PathBuf,
    pub(crate) fleet: Fleet,
    pub(crate) trust: TrustFile,
    settings: RunSettings,
    current: Mutex<Option<Current>>,
    shipments: tokio::sync::Mutex<BTreeMap<String, Shipment>>,
}

/// Runs the agent until it is ended.
pub(crate) async fn serve(args: AgentArgs) -> Result<u8, String> {
    let trust = TrustFile::open(&args.trust)?;
    let motet = args
        .motet
        .clone()
        .or_else(crate::motet)
        .ok_or("`motet` is neither beside this program nor in PATH")?;
    std::fs::create_dir_all(&args.folder).map_err(|error| format!("{}: {error}", args.folder.display()))?;
    let root = std::path::absolute(&args.folder).map_err(|error| error.to_string())?;
    own(&root)?;
    let lock =
        std::fs::File::create(root.join("lock")).map_err(|error| format!("{}: {error}", root.display()))?;
    if !fs4::fs_std::FileExt::try_lock_exclusive(&lock).unwrap_or(false) {
        return Err(format!("another agent uses {}", root.display()));
    }
    let client = args.server.connect(&args.robot, true).await?;
    let agent = Arc::new(Agent {
        robot: args.robot.clone(),
        root,
        fleet: Fleet::new(client),
        trust,
        settings: RunSettings {
            motet,
            robot: args.card.clone(),
            scene: args.scene.clone(),
            driver: args.driver.clone(),
            speed: args.speed.clone(),
        },
        current: Mutex::new(None),
        shipments: tokio::sync::Mutex::default(),
    });
    crate::run::client();
    agent.take_up();
    let _ = crate::notes::write_lines(std::io::stdout()).send("ready".to_owned());
    let tasks = [
        tokio::spawn(forever(Arc::clone(&agent), "orders", |agent| async move { agent.take_orders().await })),
        tokio::spawn(forever(
            Arc::clone(&agent),
            "policies",
            |agent| async move { agent.take_policies().await },
        )),
        tokio::spawn(forever(Arc::clone(&agent), "words", |agent| async move { agent.take_words().await })),
        tokio::spawn(forever(Arc::clone(&agent), "trust", |agent| async move { agent.watch_trust().await })),
        tokio::spawn(forever(Arc::clone(&agent), "state", |agent| async move { agent.tell_state().await })),
        tokio::spawn(forever(
            Arc::clone(&agent),
            "journals",
            |agent| async move { agent.ship_journals().await },
        )),
    ];
    // A run goes on when the agent ends: its journal is on disk, and the next agent follows it.
    let _ = tokio::signal::ctrl_c().await;
    tasks.iter().for_each(tokio::task::JoinHandle::abort);
    Ok(0)
}

/// Keeps a folder from everybody else: it has the tokens of the pages of runs.
fn own(folder: &Path) -> Result<(), String> {
    #[cfg(unix)]
    {
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o700);
        std::fs::set_permissions(folder, mode).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    Ok(())
}

/// Does something again and again, whatever the link does. A reason is printed once until it changes.
async fn forever<F>(agent: Arc<Agent>, what: &str, task: impl Fn(Arc<Agent>) -> F)
where
    F: Future<Output = Result<(), String>> + Send + 'static,
{
    let mut told = String::new();
    loop {
        // On a task of its own a fault inside ends this round, and not the agent.
        let done = tokio::spawn(task(Arc::clone(&agent))).await;
        let done = done.unwrap_or_else(|_| Err("it failed inside, and begins again".to_owned()));
        if let Err(why) = done
            && why != told
        {
            note(&format!("{what}: {why}"));
            told = why;
        }
        sleep(AGAIN).await;
    }
}

impl Agent {
    fn current(&self) -> std::sync::MutexGuard<'_, Option<Current>> {
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }

    // Orders.

    async fn take_orders(&self) -> Result<(), String> {
        let consumer = self.fleet.orders(&self.robot).await?;
        let mut orders = consumer.fetch().max_messages(1).expires(Duration::from_secs(5)).messages().await;
        let orders = orders.as_mut().map_err(|error| error.to_string())?;
        while let Some(order) = orders.next().await {
            let order = order.map_err(|error| error.to_string())?;
            self.carry_out(&order).await?;
        }
        Ok(())
    }

    /// Carries an order out, however often it is delivered.
    async fn carry_out(&self, message: &Message) -> Result<(), String> {
        let order = match verify(&message.payload, &self.robot) {
            Ok(order) => order,
            Err(why) => return self.refuse(message, None, &why).await,
        };
        let words = &order.words;
        let folder = self.folder(&words.id);
        let before = folder.order();
        if before.as_ref().is_some_and(|before| before.words.what != words.what) {
            let why = format!("the id `{}` is that of another order", words.id);
            return self.refuse(message, Some(&order), &why).await;
        }
        let has_begun = folder.result().is_some() || folder.has_begun() || folder.is_running();
        if !self.trust.now().has(&order.key) {
            // A run that has begun is not left to itself: it is followed while it stops.
            if !has_begun || before.as_ref().is_none_or(|before| before.key != order.key) {
                return self.refuse(message, Some(&order), UNTRUSTED).await;
            }
            if folder.result().is_none() {
                folder.want_stop(REVOKED)?;
            }
        }
        // An order whose time is over may have begun before: then it goes on.
        if !has_begun && let Err(late) = words.check_time() {
            return self.refuse(message, Some(&order), &late).await;
        }
        let folder =
            if before.is_some() { folder } else { OrderFolder::create(&self.root.join("orders"), &order)? };
        let result = match folder.result() {
            Some(result) => result,
            None => {
                let result = self.run(words, &folder, message).await?;
                folder.write("result.json", result.to_string().as_bytes())?;
                result
            }
        };
        *self.current() = None;
        self.ship(&words.id, &folder).await;
        self.tell_result(&words.id, &words.id, &words.what.digest(), &result).await?;
        message.double_ack().await.map_err(|error| error.to_string())
    }

    pub(crate) fn folder(&self, order: &str) -> OrderFolder {
        OrderFolder(self.root.join("orders").join(order))
    }

    /// Refuses an order of which nothing has moved. `order` is what the message says if its signature is
    /// right.
    async fn refuse(
        &self,
        message: &Message,
        order: Option<&SignedMessage>,
        why: &str,
    ) -> Result<(), String> {
        note(&format!("an order is refused: {why}"));
        if let Some((id, digest)) = claimed(&message.payload) {
            let result = json!({"state": "refused", "why": why});
            let folder = self.folder(&id);
            match folder.order() {
                None => self.tell_result(&id, &id, &digest, &result).await?,
                // It was taken before, and the agent was ended before it began.
                Some(before) if order == Some(&before) && folder.result().is_none() => {
                    folder.write("result.json", result.to_string().as_bytes())?;
                    self.tell_result(&id, &id, &digest, &result).await?;
                }
                // The result of the order that has this id stays.
                Some(_) => self.tell_result(&refusal(&id, &digest), &id, &digest, &result).await?,
            }
        }
        message.double_ack().await.map_err(|error| error.to_string())
    }

    /// Tells a result under a name in the bucket of results.
    async fn tell_result(&self, name: &str, order: &str, digest: &str, result: &Value) -> Result<(), String> {
        let bucket = self.fleet.bucket(RESULTS).await?;
        let mut told = result.clone();
        if let Some(fields) = told.as_object_mut() {
            fields.insert("robot".to_owned(), json!(self.robot));
            fields.insert("order".to_owned(), json!(order));
            fields.insert("digest".to_owned(), json!(digest));
        }
        let key = format!("{}.{name}", self.robot);
        let told = within_message(told).to_string().into();
        bucket.put(key, told).await.map(|_| ()).map_err(|error| error.to_string())
    }

    /// Runs an order to its end, or follows its run that goes on already.
    async fn run(
        &self,
        words: &OperatorMessage,
        folder: &OrderFolder,
        message: &Message,
    ) -> Result<Value, String> {
        if !matches!(words.what, Instruction::Run { .. }) {
            return Ok(json!({"state": "refused", "why": "the words are no order"}));
        }
        let (mut child, mut resumes, mut worked, mut is_stop_told) = (None, 0, Instant::now(), false);
        let mut events = Events::default();
        if !folder.is_running() {
            child = Some(folder.start(&self.settings)?);
        }
        let mut code = None;
        loop {
            let is_new = events.follow(folder);
            let current = Current {
                order: words.id.clone(),
                folder: folder.clone(),
                step: events.step.clone(),
                question: events.question.clone(),
                is_followed: true,
            };
            *self.current() = Some(current);
            let is_linked = self.fleet.client.connection_state() == State::Connected;
            if is_new && is_linked {
                let _ = timeout(BESIDE, self.put_state()).await;
            }
            if folder.is_stopped() && !is_stop_told {
                // A run that has just begun has no page yet.
                is_stop_told = tell_page(folder, "/stop", String::new(), "text/plain").await.is_ok();
            }
            let is_over = match &mut child {
                Some(process) => match process.try_wait() {
                    Ok(Some(status)) => {
                        code = status.code();
                        true
                    }
                    Ok(None) => false,
                    Err(error) => return Err(error.to_string()),
                },
                None => !folder.is_running(),
            };
            if is_over {
                if let Some(result) = folder.ending(code) {
                    return Ok(result);
                }
                resumes += 1;
                if resumes > RESUMES {
                    let why = "its process ended again and again before the run was over";
                    let why = format!("{why}; {}", folder.last_error("it printed no error"));
                    return Ok(json!({"state": "failed", "why": why}));
                }
                // The robot's driver may need its time, too.
                sleep((AGAIN * 2_u32.pow(resumes.min(5) - 1)).min(MAX_WAIT)).await;
                child = Some(folder.start(&self.settings)?);
                is_stop_told = false;
            }
            // Without a link the order is given out again later; its folder says what it did.
            if worked.elapsed() > WORKS && is_linked {
                worked = Instant::now();
                let _ = timeout(BESIDE, message.ack_with(AckKind::Progress)).await;
            }
            if is_linked {
                let _ = timeout(BESIDE, self.ship(&words.id, folder)).await;
            }
            sleep(LOOKS).await;
        }
    }

    /// Checks whether the run of an order goes on.
    pub(crate) fn runs(&self, order: &str) -> bool {
        self.current().as_ref().is_some_and(|current| current.order == order)
    }

    // Messages of operators.

    /// Answers requests: `motet.ROBOT.stop`, which needs no signature, and `motet.ROBOT.answer`, which does.
    async fn take_words(&self) -> Result<(), String> {
        let subject = format!("motet.{}.*", self.robot);
        let mut requests = self.fleet.client.subscribe(subject).await.map_err(|error| error.to_string())?;
        while let Some(request) = requests.next().await {
            let what = request.subject.rsplit('.').next().unwrap_or_default().to_owned();
            let answer = match what.as_str() {
                "stop" => self.stop().await,
                "answer" => self.answer(&request.payload).await,
                _ => continue,
            };
            let answer = answer.unwrap_or_else(|problem| json!({"problem": problem}));
            if let Some(reply) = request.reply {
                let sent = self.fleet.client.publish(reply, answer.to_string().into()).await;
                sent.map_err(|error| error.to_string())?;
            }
        }
        Err("the subscription has ended".to_owned())
    }

    /// Stops the run. If its process does not answer now, the run stops as soon as one does.
    async fn stop(&self) -> Result<Value, String> {
        let folder = self.current().clone().ok_or("no run goes on")?.folder;
        folder.want_stop("")?;
        let is_told = tell_page(&folder, "/stop", String::new(), "text/plain").await.is_ok();
        Ok(json!({"order": folder.id(), "is_told": is_told}))
    }

    /// Stops the run if the key of its order is trusted no more. A file that is being written may lack it for
    /// a moment, so two looks count.
    async fn watch_trust(&self) -> Result<(), String> {
        let revoked = || {
            let current = self.current().clone()?;
            // The task that follows the run tells it again.
            let is_told = current.is_followed && current.folder.is_stopped();
            let order = current.folder.order().filter(|_| !is_told)?;
            (!self.trust.now().has(&order.key)).then_some(current.folder)
        };
        let first = revoked();
        sleep(TELLS).await;
        if let Some((first, folder)) = first.zip(revoked())
            && first.0 == folder.0
        {
            note(&format!("{}: {REVOKED}", folder.id()));
            folder.want_stop(REVOKED)?;
            let _ = tell_page(&folder, "/stop", String::new(), "text/plain").await;
        }
        Ok(())
    }

    async fn answer(&self, bytes: &[u8]) -> Result<Value, String> {
        let words = open(bytes, &self.trust.now(), &self.robot)?;
        let Instruction::Answer { order, question, text } = words.what else {
            return Err("the words are no answer".to_owned());
        };
        let current = self.current().clone().filter(|current| current.order == order);
        let current = current.ok_or("this order does not run")?;
        let body = json!({"text": text, "question": question}).to_string();
        match tell_page(&current.folder, "/answer", body, "application/json").await {
            Ok(_) => Ok(json!({"order": order})),
            Err(refusal) => {
                Err(refusal.get("problem").and_then(Value::as_str).unwrap_or("refused").to_owned())
            }
        }
    }

    // Reports.

    async fn put_state(&self) -> Result<(), String> {
        let current = self.current().clone();
        let question = current.as_ref().and_then(|current| current.question.clone());
        let question = question.map(|(id, text)| json!({"id": id, "text": text}));
        let state = json!({
            "order": current.as_ref().map(|current| current.order.clone()),
            "step": current.as_ref().map(|current| current.step.clone()),
            "question": question,
        });
        let bucket = self.fleet.bucket(STATES).await?;
        bucket.put(&self.robot, state.to_string().into()).await.map(|_| ()).map_err(|error| error.to_string())
    }

    /// Takes up a run that goes on from an agent before this one, so that it is told and can be stopped.
    fn take_up(&self) {
        let is_left = |folder: &OrderFolder| folder.is_running() && folder.order().is_some();
        let running = folders(&self.root.join("orders")).find(is_left);
        let current = |folder: OrderFolder| {
            let (order, step) = (folder.id(), String::new());
            Current { order, folder, step, question: None, is_followed: false }
        };
        *self.current() = running.map(current);
    }

    async fn tell_state(&self) -> Result<(), String> {
        // Its order may never come again.
        self.current().take_if(|current| !current.is_followed && !current.folder.is_running());
        self.put_state().await?;
        sleep(TELLS.saturating_sub(AGAIN)).await;
        Ok(())
    }

    // Journals.

    async fn ship(&self, order: &str, folder: &OrderFolder) {
        // The task of the journals tries again what the server does not take now.
        let Ok(mut shipments) = self.shipments.try_lock() else { return };
        let shipment = shipments.entry(order.to_owned()).or_default();
        let _ = shipment.ship(&self.fleet, &self.robot, order, folder).await;
    }

    /// Ships all journals that have not arrived as a whole.
    async fn ship_journals(&self) -> Result<(), String> {
        for folder in folders(&self.root.join("orders")) {
            let order = folder.id();
            let mark = folder.0.join("shipped");
            if mark.exists() || folder.order().is_none() {
                continue;
            }
            let is_over = folder.result().is_some();
            let mut shipments = self.shipments.lock().await;
            let shipment = shipments.entry(order.clone()).or_default();
            let is_all = shipment.ship(&self.fleet, &self.robot, &order, &folder).await?;
            if is_all && is_over {
                shipments.remove(&order);
                folder.write("shipped", b"")?;
            }
        }
        Ok(())
    }
}

/// Folders of orders, also those of which no order is written yet.
fn folders(root: &Path) -> impl Iterator<Item = OrderFolder> {
    let entries = std::fs::read_dir(root).into_iter().flatten();
    entries.filter_map(|entry| Some(OrderFolder(entry.ok()?.path())))
}

/// Id that words claim to have, and the digest of what they say, whoever signed them.
pub(crate) fn claimed(bytes: &[u8]) -> Option<(String, String)> {
    let signed: Value = serde_json::from_slice(bytes).ok()?;
    let body: Value = serde_json::from_str(signed.get("body")?.as_str()?).ok()?;
    let id = body.get("id")?.as_str().filter(|id| is_name(id))?.to_owned();
    let what: Option<Instruction> = serde_json::from_value(body.get("what")?.clone()).ok();
    Some((id, what.map(|what| what.digest()).unwrap_or_default()))
}
