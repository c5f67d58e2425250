//! The server: streams, buckets and subjects.

use crate::signed::{Instruction, is_name, new_id, sign};
use async_nats::jetstream::consumer::PullConsumer;
use async_nats::jetstream::{self, kv, stream};
use async_nats::{Client, ConnectOptions};
use ed25519_dalek::SigningKey;
use futures::StreamExt as _;
use serde_json::{Value, json};
use std::io::Write as _;
use std::path::PathBuf;
use std::time::Duration;

/// Stream of orders, each of which one agent takes.
pub(crate) const ORDERS: &str = "MOTET_ORDERS";
/// Stream of the lines of all journals.
pub(crate) const JOURNALS: &str = "MOTET_JOURNALS";
/// Buckets: policies that are to take over, by robot; results of these; states of robots; results of orders.
pub(crate) const POLICIES: &str = "motet-policies";
pub(crate) const SWAPS: &str = "motet-swaps";
pub(crate) const STATES: &str = "motet-states";
pub(crate) const RESULTS: &str = "motet-results";
/// Time for which the server refuses a second message of the same id.
const DUPLICATES: Duration = Duration::from_secs(120);
/// Time after which an order that nobody works at is given out again.
pub(crate) const WAITS: Duration = Duration::from_secs(15);

/// Time for a request to a robot, and for a policy to take over.
pub(crate) const ANSWERS: Duration = Duration::from_secs(40);

/// How to reach the server.
#[derive(clap::Args, Clone, Debug)]
pub(crate) struct ServerArgs {
    /// Address of the NATS server
    #[arg(
        long,
        value_name = "URL",
        default_value = "nats://127.0.0.1:4222",
        env = "NATS_URL",
        hide_env_values = true
    )]
    pub(crate) server: String,
    /// File with the credentials of a NATS account
    #[arg(long, value_name = "FILE")]
    creds: Option<PathBuf>,
    /// File with a user and a password, in one line with a colon between them
    #[arg(long, value_name = "FILE", conflicts_with = "creds")]
    login: Option<PathBuf>,
}

impl ServerArgs {
    /// Connects as somebody with a name. Answers come to an inbox of this name. With `waits` the server may
    /// come later; otherwise a server that is not there is an error.
    pub(crate) async fn connect(&self, name: &str, waits: bool) -> Result<Client, String> {
        let mut options = ConnectOptions::new()
            .name(format!("motet {name}"))
            .custom_inbox_prefix(format!("_INBOX_{name}"))
            .ping_interval(Duration::from_secs(2))
            .connection_timeout(Duration::from_secs(5))
            .max_reconnects(if waits { None } else { Some(3) })
            .reconnect_delay_callback(|tries| Duration::from_millis((50 << tries.min(5)).min(1000)));
        if waits {
            options = options.retry_on_initial_connect();
        }
        if let Some(file) = &self.creds {
            options = options
                .credentials_file(file)
                .await
                .map_err(|error| format!("{}: {error}", file.display()))?;
        }
        if let Some(file) = &self.login {
            let text =
                std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
            let (user, password) = text
                .trim()
                .split_once(':')
                .ok_or_else(|| format!("{} has no `user:password`", file.display()))?;
            options = options.user_and_password(user.to_owned(), password.to_owned());
        }
        // The address may contain a password: it is in no message.
        options
            .connect(&self.server)
            .await
            .map_err(|error| format!("cannot connect to the NATS server: {error}"))
    }
}

/// Streams and buckets of the fleet.
#[derive(Clone)]
pub(crate) struct Fleet {
    pub(crate) client: Client,
    pub(crate) js: jetstream::Context,
}

impl Fleet {
    pub(crate) fn new(client: Client) -> Self {
        let mut js = jetstream::new(client.clone());
        js.set_timeout(Duration::from_secs(5));
        Self { client, js }
    }

    /// Makes what is not there. It needs the permission to do so, which robots lack.
    pub(crate) async fn create(&self) -> Result<(), String> {
        let orders = stream::Config {
            name: ORDERS.to_owned(),
            subjects: vec!["motet.orders.*".to_owned()],
            retention: stream::RetentionPolicy::WorkQueue,
            duplicate_window: DUPLICATES,
            ..stream::Config::default()
        };
        let journals = stream::Config {
            name: JOURNALS.to_owned(),
            subjects: vec!["motet.journal.*.*".to_owned()],
            duplicate_window: DUPLICATES,
            ..stream::Config::default()
        };
        for config in [orders, journals] {
            let name = config.name.clone();
            self.js
                .get_or_create_stream(config)
                .await
                .map_err(|error| format!("the stream {name}: {error}"))?;
        }
        for bucket in [POLICIES, SWAPS, STATES, RESULTS] {
            // A bucket is a stream. The client's own way to make one fails with servers before 2.10.
            let config = stream::Config {
                name: format!("KV_{bucket}"),
                subjects: vec![format!("$KV.{bucket}.>")],
                max_messages_per_subject: 1,
                discard: stream::DiscardPolicy::New,
                allow_rollup: true,
                deny_delete: true,
                allow_direct: true,
                duplicate_window: DUPLICATES,
                ..stream::Config::default()
            };
            let made = self.js.get_or_create_stream(config).await;
            made.map_err(|error| format!("the bucket {bucket}: {error}"))?;
        }
        Ok(())
    }

    pub(crate) async fn bucket(&self, name: &str) -> Result<kv::Store, String> {
        let found = self.js.get_key_value(name).await;
        found.map_err(|error| format!("the bucket {name}: {error}; `motet fleet init` makes it"))
    }

    /// Consumer of the orders for a robot: one at a time, in order.
    pub(crate) async fn orders(&self, robot: &str) -> Result<PullConsumer, String> {
        let wrong = |error: String| format!("the orders: {error}");
        let stream = self.js.get_stream(ORDERS).await.map_err(|error| wrong(error.to_string()))?;
        let config = jetstream::consumer::pull::Config {
            durable_name: Some(format!("agent-{robot}")),
            filter_subject: format!("motet.orders.{robot}"),
            ack_wait: WAITS,
            max_ack_pending: 1,
            ..jetstream::consumer::pull::Config::default()
        };
        let consumer = stream.get_or_create_consumer(&format!("agent-{robot}"), config).await;
        consumer.map_err(|error| wrong(error.to_string()))
    }

    /// States of all robots by name.
    pub(crate) async fn states(&self) -> Result<Vec<(String, Value)>, String> {
        let bucket = self.bucket(STATES).await?;
        let mut keys = bucket.keys().await.map_err(|error| error.to_string())?;
        let mut states = Vec::new();
        while let Some(robot) = keys.next().await {
            let robot = robot.map_err(|error| error.to_string())?;
            let entry = bucket.entry(&robot).await.map_err(|error| error.to_string())?;
            let Some(entry) = entry else { continue };
            let state = serde_json::from_slice(&entry.value).ok().filter(Value::is_object);
            let mut state = state.unwrap_or_else(|| json!({}));
            // The clock of the server says how old it is, not the one of the robot.
            state["heard"] = json!(entry.created.unix_timestamp());
            states.push((robot, state));
        }
        states.sort_by(|one, other| one.0.cmp(&other.0));
        Ok(states)
    }

    /// Asks a robot, and waits for its answer.
    pub(crate) async fn request(&self, robot: &str, what: &str, bytes: Vec<u8>) -> Result<Value, String> {
        let sent =
            tokio::time::timeout(ANSWERS, self.client.request(format!("motet.{robot}.{what}"), bytes.into()))
                .await;
        let answer = sent.map_err(|_| "the robot does not answer".to_owned())?;
        let answer = answer.map_err(|error| format!("the robot does not answer: {error}"))?;
        serde_json::from_slice(&answer.payload).map_err(|error| format!("the answer is none: {error}"))
    }

    /// Answers a question `ORDER/NUMBER`: the one that the operator has read, whatever is open now.
    pub(crate) async fn answer(
        &self,
        key: &SigningKey,
        robot: &str,
        question: &str,
        text: &str,
    ) -> Result<Value, String> {
        let (order, question) = question.split_once('/').ok_or("write --question ORDER/NUMBER")?;
        let (order, question) = (order.to_owned(), question.to_owned());
        let what = Instruction::Answer { order, question, text: text.to_owned() };
        self.request(robot, "answer", sign(key, &new_id()?, robot, 60, what)?).await
    }
}

/// Greatest size of a value that goes into a message.
const MAX_VALUE: usize = 256 * 1024;
/// Letters of a text of a value that is too large.
const MAX_TEXT: usize = 500;

/// A value that fits into a message: without its findings and the rest of its long texts if need be.
pub(crate) fn within_message(mut value: Value) -> Value {
    if value.to_string().len() <= MAX_VALUE {
        return value;
    }
    if let Some(fields) = value.as_object_mut() {
        fields.insert("findings".to_owned(), json!([]));
        fields.retain(|_, field| !field.is_object());
        for field in fields.values_mut() {
            if let Value::String(text) = field {
                *text = text.chars().take(MAX_TEXT).collect();
            }
        }
    }
    value
}

/// Prints a text with a line break. Nobody may read it.
pub(crate) fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Name in the bucket of results for the refusal of words with the id of another order. The result of that
/// one stays where it is.
pub(crate) fn refusal(order: &str, digest: &str) -> String {
    format!("{order}={digest}")
}

/// Reads the name of a robot or an order.
pub(crate) fn name(text: &str) -> Result<String, String> {
    if is_name(text) {
        Ok(text.to_owned())
    } else {
        Err("write 1 to 64 letters, digits, `_` and `-`".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn result_too_large_for_a_message_loses_its_findings() {
        let small = json!({"state": "refused", "why": "x", "findings": ["a"]});
        assert_eq!(within_message(small.clone()), small);
        let large =
            json!({"state": "refused", "why": "x".repeat(MAX_VALUE), "findings": ["y".repeat(MAX_VALUE)]});
        let cut = within_message(large);
        assert_eq!(cut["state"], "refused");
        assert_eq!(cut["why"].as_str().unwrap().len(), MAX_TEXT);
        assert!(cut.to_string().len() < 1_000);
    }
}
