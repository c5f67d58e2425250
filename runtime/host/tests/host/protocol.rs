//! Wire form of the driver protocol.

use motet_host::remote::protocol::{
    self, AdvanceResult, Detections, DriverCall, DriverMessage, LookResult, QueryResult, RefusedData,
    RpcError, StatusResult, Welcome, hear,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// A change of the schema is a new version of the protocol, unless older drivers still understand it.
#[test]
fn protocol_schema_is_as_recorded() {
    insta::assert_json_snapshot!(serde_json::json!({
        "version": protocol::VERSION,
        "messages": protocol::schema(),
    }));
}

/// Reads a result and writes it again; both have to say the same.
fn round<T: DeserializeOwned + Serialize>(result: Value) {
    let read: T = serde_json::from_value(result.clone()).unwrap_or_else(|error| panic!("{error}: {result}"));
    assert_eq!(serde_json::to_value(read).unwrap(), result);
}

fn check_answer(method: &str, answer: Result<Value, RpcError>) {
    match (method, answer) {
        ("hello", Ok(result)) => assert_eq!(serde_json::from_value::<Welcome>(result).unwrap().protocol, 2),
        ("observe" | "watch" | "truth", Ok(result)) => round::<QueryResult>(result),
        ("status", Ok(result)) => round::<StatusResult>(result),
        ("advance", Ok(result)) => round::<AdvanceResult>(result),
        ("look", Ok(result)) => round::<LookResult>(result),
        ("detections", Ok(result)) => round::<Detections>(result),
        (_, Ok(result)) => assert_eq!(result, serde_json::json!({}), "{method}"),
        ("start", Err(wrong)) => round::<RefusedData>(wrong.data),
        (_, Err(wrong)) => panic!("{method}: {wrong:?}"),
    }
}

#[test]
fn protocol_page_shows_every_message_as_it_is() {
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/drivers.md")).unwrap();
    let mut asked: BTreeMap<u64, String> = BTreeMap::new();
    let mut shown = BTreeSet::new();
    for line in page.lines() {
        if let Some(call) = line.strip_prefix("> {") {
            let message: Value = serde_json::from_str(&format!("{{{call}")).unwrap();
            let read: DriverCall =
                serde_json::from_value(message.clone()).unwrap_or_else(|error| panic!("{error}: {line}"));
            let again = serde_json::to_value(&read).unwrap();
            let mut params = message["params"].clone();
            params.as_object_mut().unwrap().remove("at");
            assert_eq!(again["params"], params, "{line}");
            let method = message["method"].as_str().unwrap().to_owned();
            shown.insert(method.clone());
            if let Some(id) = message["id"].as_u64() {
                asked.insert(id, method);
            }
        } else if let Some(said) = line.strip_prefix("< {") {
            match hear(&format!("{{{said}")).unwrap_or_else(|error| panic!("{error}: {line}")) {
                DriverMessage::Answer(id, answer) => {
                    check_answer(&asked.remove(&id).unwrap_or_else(|| panic!("{line}")), answer);
                }
                DriverMessage::Report(report) => {
                    let report = serde_json::to_value(report).unwrap();
                    shown.insert(report["method"].as_str().unwrap().to_owned());
                }
            }
        }
    }
    assert_eq!(asked, BTreeMap::new(), "every call has its answer");
    let schema = serde_json::to_value(protocol::schema()).unwrap();
    let methods = |of: &str| -> BTreeSet<String> {
        let messages = schema["$defs"][of]["oneOf"].as_array().unwrap();
        messages.iter().map(|one| one["properties"]["method"]["const"].as_str().unwrap().to_owned()).collect()
    };
    let all: BTreeSet<String> = methods("DriverCall").union(&methods("DriverReport")).cloned().collect();
    assert_eq!(shown, all);
}
