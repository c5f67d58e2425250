//! Latest results of orders, for the page: a copy of the end of a bucket that may have very many.

use crate::link::{Fleet, RESULTS};
use async_nats::jetstream::kv::{Entry, Operation};
use futures::StreamExt as _;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Most results that are kept.
const MOST: usize = 100;
/// Most findings of a result that are shown, and letters of a text.
const FINDINGS: usize = 5;
const LETTERS: usize = 500;
/// Time after which a watch that has ended is begun anew.
const AGAIN: Duration = Duration::from_secs(1);

/// Results by their numbers in the bucket, which grow.
#[derive(Debug, Default)]
pub(crate) struct Results(Mutex<BTreeMap<u64, Value>>);

impl Results {
    /// Latest results, the newest first.
    pub(crate) fn latest(&self) -> Vec<Value> {
        let results = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        results.values().rev().cloned().collect()
    }

    /// Follows the bucket for ever.
    pub(crate) async fn follow(&self, fleet: &Fleet) {
        loop {
            let _ = self.watch(fleet).await;
            tokio::time::sleep(AGAIN).await;
        }
    }

    async fn watch(&self, fleet: &Fleet) -> Result<(), String> {
        let bucket = fleet.bucket(RESULTS).await?;
        let mut entries = bucket.watch_with_history(">").await.map_err(|error| error.to_string())?;
        while let Some(entry) = entries.next().await {
            self.take(&entry.map_err(|error| error.to_string())?);
        }
        Ok(())
    }

    fn take(&self, entry: &Entry) {
        let mut results = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        results.retain(|_, result| result["key"] != json!(entry.key));
        if entry.operation == Operation::Put {
            results.insert(entry.revision, shown(&entry.key, entry.created.unix_timestamp(), &entry.value));
        }
        while results.len() > MOST {
            results.pop_first();
        }
    }
}

/// Part of a result that the page shows. Its robot and order are those of its place: a robot writes no other.
fn shown(key: &str, at: i64, value: &[u8]) -> Value {
    let result: Value = serde_json::from_slice(value).unwrap_or_default();
    let short = |text: &str| text.chars().take(LETTERS).collect::<String>();
    let text = |name: &str| result.get(name).and_then(Value::as_str).map(short);
    let (robot, place) = key.split_once('.').unwrap_or((key, ""));
    let (order, other) = place.split_once('=').map_or((place, false), |(order, _)| (order, true));
    let findings = result.get("findings").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let line = |finding: &Value| {
        let part = |name: &str| finding.get(name).and_then(Value::as_str).unwrap_or_default();
        short(&format!("{} {}", part("code"), part("message")))
    };
    let lines: Vec<String> = findings.iter().take(FINDINGS).map(line).collect();
    json!({
        "key": key, "robot": robot, "order": order, "written": at, "is_of_other": other,
        "state": text("state"), "outcome": text("outcome"), "why": text("why"),
        "findings": lines, "more": findings.len() - lines.len(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn result_is_shown_in_short_whatever_a_robot_wrote() {
        let finding = json!({"code": "M0201", "message": "x".repeat(2 * LETTERS)});
        let result = json!({"state": "refused", "why": "no", "findings": vec![finding; FINDINGS + 2],
            "robot": "other"});
        let told = shown("r1.order-1", 7, result.to_string().as_bytes());
        assert_eq!(
            (&told["robot"], &told["order"], &told["written"]),
            (&json!("r1"), &json!("order-1"), &json!(7))
        );
        assert_eq!(told["findings"].as_array().unwrap().len(), FINDINGS);
        assert_eq!(told["findings"][0].as_str().unwrap().len(), LETTERS);
        assert_eq!((&told["more"], &told["is_of_other"]), (&json!(2), &json!(false)));
        let told = shown("r1.order-1=00ff", 7, b"\xff");
        assert_eq!((&told["order"], &told["is_of_other"]), (&json!("order-1"), &json!(true)));
        assert_eq!((&told["state"], &told["findings"]), (&Value::Null, &json!([])));
    }
}
