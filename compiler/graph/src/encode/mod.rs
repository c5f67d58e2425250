//! Graphs as JSON: versioned, the same bytes for the same graph, with a hash over the content.
//!
//! What is written has types of its own in [`wire`]; the graph in memory does not know them. Decoding checks form, size and
//! hash; what the graph says is checked by [`crate::validate()`].

mod error;
mod from_wire;
mod to_wire;
pub mod wire;

pub use error::DecodeError;

use crate::model::Graph;
use serde::Deserialize;
use sha2::{Digest, Sha256};
use wire::Document;

/// The version that is written, and the only one that is read. 2 since motions have witnesses.
pub const VERSION: u32 = 2;
/// The largest document in bytes.
pub const MAX_BYTES: usize = 64 * 1024 * 1024;

/// A graph as a JSON document. A duration that is not finite, which no valid graph holds, is written as `null` and is not
/// read again.
#[must_use]
pub fn encode(graph: &Graph) -> String {
    json(&document(graph))
}

/// A graph as a document with its hash, to stand within another one.
#[must_use]
pub fn document(graph: &Graph) -> Document {
    let mut document = to_wire::document(graph);
    document.hash = hash_of(&document);
    document
}

/// The graph in a JSON document.
///
/// # Errors
///
/// Where the document is too large or too deep, no JSON, of another version, has unknown, missing or doubled keys, or where
/// its hash is not that of its content.
pub fn decode(text: &str) -> Result<Graph, DecodeError> {
    if text.len() > MAX_BYTES {
        return Err(DecodeError::TooLarge { bytes: text.len(), limit: MAX_BYTES });
    }
    // The version first: of another one the keys would only confuse.
    let version = serde_json::from_str::<Version>(text)?.motet_graph;
    if version != u64::from(VERSION) {
        return Err(DecodeError::Version { found: version, expected: VERSION });
    }
    from_document(serde_json::from_str(text)?)
}

/// The graph in a document that stood within another one.
///
/// # Errors
///
/// Where it is of another version, or its hash is not that of its content.
pub fn from_document(mut document: Document) -> Result<Graph, DecodeError> {
    if document.motet_graph != VERSION {
        return Err(DecodeError::Version { found: document.motet_graph.into(), expected: VERSION });
    }
    let stated = std::mem::take(&mut document.hash);
    let actual = hash_of(&document);
    if stated != actual {
        return Err(DecodeError::Hash { stated, actual });
    }
    Ok(from_wire::graph(document))
}

/// The hash over a graph's content: `sha256:` and 64 hexadecimal digits.
#[must_use]
pub fn hash(graph: &Graph) -> String {
    hash_of(&to_wire::document(graph))
}

/// The JSON Schema of a document.
#[must_use]
pub fn schema() -> schemars::Schema {
    schemars::schema_for!(Document)
}

/// What is read of any version.
#[derive(Deserialize)]
struct Version {
    motet_graph: u64,
}

/// Over the document with an empty hash, without white space.
fn hash_of(document: &Document) -> String {
    let digest = Sha256::digest(json(document).as_bytes());
    let hex = digest
        .iter()
        .flat_map(|byte| [byte >> 4, byte & 15])
        .filter_map(|digit| char::from_digit(digit.into(), 16));
    std::iter::once("sha256:".to_owned()).chain(hex.map(String::from)).collect()
}

fn json(document: &Document) -> String {
    // Writing to memory fails for no value of these types.
    serde_json::to_string(document).unwrap_or_default()
}
