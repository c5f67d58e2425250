//! Policies that take over: each is offered to its run once, whatever becomes of the link and of the agent.

use crate::agent::{Agent, LOOKS, claimed};
use crate::link::{POLICIES, SWAPS, within_message};
use crate::run::{OrderFolder, tell_page};
use crate::signed::{Instruction, OperatorMessage, is_name, read};
use async_nats::jetstream::kv::Operation;
use futures::StreamExt as _;
use serde_json::{Value, json};
use std::time::{Duration, Instant};
use tokio::time::{sleep, timeout};

/// Time for a run that is continued to take a policy.
const BEGINS: Duration = Duration::from_secs(20);
/// Time after which a watch of policies that has nothing new is begun anew.
const WATCHES: Duration = Duration::from_secs(60);

impl Agent {
    /// Follows the policies that are put for the robot.
    pub(crate) async fn take_policies(&self) -> Result<(), String> {
        let bucket = self.fleet.bucket(POLICIES).await?;
        let results = self.fleet.bucket(SWAPS).await?;
        // The policy that is there comes first: it may have been put while no agent was here.
        let watched = bucket.watch_with_history(&self.robot).await;
        let mut policies = watched.map_err(|error| error.to_string())?;
        // A server that lost power may count anew, below the number from which this watch goes on.
        while let Ok(entry) = timeout(WATCHES, policies.next()).await {
            let entry = entry.ok_or("the watch of the policies has ended")?;
            let entry = entry.map_err(|error| error.to_string())?;
            if entry.operation != Operation::Put {
                continue;
            }
            let (id, mut told, is_marked) = match self.swap(&entry.value).await {
                Ok(Some((id, told))) => (id, told, true),
                Ok(None) => continue,
                Err(why) => {
                    let id = claimed(&entry.value).map(|(id, _)| id);
                    (id.unwrap_or_default(), json!({"problem": why}), false)
                }
            };
            if let Some(fields) = told.as_object_mut() {
                fields.insert("id".to_owned(), json!(id));
            }
            let told = within_message(told).to_string();
            let put = results.put(&self.robot, told.clone().into()).await;
            if is_marked {
                // The operator waits, and the disk does not.
                self.swaps().write(&id, told.as_bytes())?;
            }
            put.map_err(|error| error.to_string())?;
            if is_marked {
                self.swaps().write(&format!("{id}.told"), b"")?;
            }
        }
        Ok(())
    }

    /// Folder with what became of policies that were offered.
    fn swaps(&self) -> OrderFolder {
        OrderFolder(self.root.join("swaps"))
    }

    /// Lets a policy take over, once: its id, with what became of it. For one that was offered before, it
    /// says what became of it then; `None` if the server knows.
    async fn swap(&self, bytes: &[u8]) -> Result<Option<(String, Value)>, String> {
        let words = read(bytes, &self.trust.now(), &self.robot)?;
        let (id, Instruction::Swap { order, policy }) = (words.id.clone(), &words.what) else {
            return Err("the words have no policy".to_owned());
        };
        // A policy that was offered once is not offered again, also not to a later order.
        let swaps = self.swaps();
        let mark = swaps.0.join(&id);
        std::fs::create_dir_all(&swaps.0).map_err(|error| format!("{}: {error}", swaps.0.display()))?;
        if let Err(error) = std::fs::File::create_new(&mark) {
            if error.kind() != std::io::ErrorKind::AlreadyExists {
                return Err(format!("{}: {error}", mark.display()));
            }
            if swaps.0.join(format!("{id}.told")).exists() {
                return Ok(None);
            }
            let told = std::fs::read(&mark).ok().and_then(|told| serde_json::from_slice(&told).ok());
            let lost = "the agent was ended meanwhile; the journal of the order says whether it took over";
            return Ok(Some((id, told.unwrap_or_else(|| json!({"problem": lost})))));
        }
        let told = match self.offer(&words, order, policy).await {
            Ok(told) => told,
            Err(why) => json!({"problem": why}),
        };
        Ok(Some((id, told)))
    }

    /// Offers a policy to the run of an order; its answer. A run that is continued gets a while.
    async fn offer(&self, words: &OperatorMessage, order: &str, policy: &str) -> Result<Value, String> {
        if !is_name(order) {
            return Err("the order has no name".to_owned());
        }
        let folder = self.folder(order);
        let (begun, is_here) = (Instant::now(), folder.order().is_some());
        loop {
            words.check_time()?;
            if self.runs(order) && folder.page().is_some() {
                break;
            }
            if !is_here || folder.result().is_some() || begun.elapsed() > BEGINS {
                return Err(format!("the order `{order}` does not run"));
            }
            sleep(LOOKS).await;
        }
        let answer = tell_page(&folder, "/swap", policy.to_owned(), "text/plain").await;
        Ok(match answer {
            Ok(mut swapped) => {
                if let Some(fields) = swapped.as_object_mut() {
                    fields.insert("order".to_owned(), json!(order));
                }
                swapped
            }
            Err(refusal) => refusal,
        })
    }
}
