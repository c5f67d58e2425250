//! Graphs as JSON documents: versioned, the same bytes for the same graph, with a hash over the content.
//!
//! Decoding checks form, size, version and hash. The content is checked by [`crate::validate()`].

use crate::model::Graph;
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeSeed, Error as _, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use sha2::{Digest, Sha256};
use std::borrow::Cow;
use std::fmt;
use thiserror::Error;

/// Version of the encoding: the one that is written, and the only one that is read.
pub const VERSION: u32 = 6;
/// Size limit of a document in bytes.
pub const MAX_BYTES: usize = 64 * 1024 * 1024;

/// Error of [`decode`]: the text is not a graph document.
#[derive(Debug, Error)]
pub enum DecodeError {
    #[error("the graph has {bytes} bytes, more than the limit of {limit}")]
    TooLarge { bytes: usize, limit: usize },
    /// The text is not JSON, or not of the form of a graph.
    #[error("no graph: {0}")]
    Form(#[from] serde_json::Error),
    #[error("the graph has version {found}; this program reads version {expected}")]
    Version { found: u64, expected: u32 },
    /// The document was changed after it was written.
    #[error("the graph was changed after it was written: its hash is {actual}, not {stated}")]
    Hash { stated: String, actual: String },
}

/// A graph with the version of the encoding and the hash of its content, to be embedded in another document.
#[derive(Clone, PartialEq, Debug, JsonSchema)]
pub struct GraphDocument {
    /// Version of the encoding.
    pub motet_graph: u32,
    /// `sha256:` and the hash of the document without white space and with an empty hash.
    pub hash: String,
    #[schemars(flatten)]
    pub graph: Graph,
}

/// Encodes a graph as a JSON document. A duration that is not finite, which no valid graph holds, becomes
/// `null` and cannot be decoded.
///
/// ```
/// use motet_graph::{Graph, decode, encode, validate};
///
/// let graph = Graph::empty("tidy_up", "hsr");
/// let back = decode(&encode(&graph))?;
/// assert_eq!(back, graph);
/// assert!(validate(&back).is_ok());
/// # Ok::<(), motet_graph::DecodeError>(())
/// ```
#[must_use]
pub fn encode(graph: &Graph) -> String {
    json(&Content { motet_graph: VERSION, hash: &hash(graph), graph })
}

/// Adds version and hash to a graph.
#[must_use]
pub fn document(graph: &Graph) -> GraphDocument {
    GraphDocument { motet_graph: VERSION, hash: hash(graph), graph: graph.clone() }
}

/// Decodes the graph in a JSON document.
///
/// # Errors
///
/// A document that is too large or too deep, is not JSON, has another version, has unknown, missing or
/// doubled keys, or states a hash that is not that of its content.
pub fn decode(text: &str) -> Result<Graph, DecodeError> {
    if text.len() > MAX_BYTES {
        return Err(DecodeError::TooLarge { bytes: text.len(), limit: MAX_BYTES });
    }
    // The version first: the keys of another version would only give a confusing error.
    let version = serde_json::from_str::<AnyVersion>(text)?.motet_graph;
    if version != u64::from(VERSION) {
        return Err(DecodeError::Version { found: version, expected: VERSION });
    }
    from_document(serde_json::from_str(text)?)
}

/// Checks version and hash of an embedded document and returns its graph.
///
/// # Errors
///
/// [`DecodeError::Version`] and [`DecodeError::Hash`].
pub fn from_document(document: GraphDocument) -> Result<Graph, DecodeError> {
    if document.motet_graph != VERSION {
        return Err(DecodeError::Version { found: document.motet_graph.into(), expected: VERSION });
    }
    let (stated, actual) = (document.hash, hash(&document.graph));
    if stated == actual { Ok(document.graph) } else { Err(DecodeError::Hash { stated, actual }) }
}

/// Hash over the content of a graph: `sha256:` and 64 hexadecimal digits.
#[must_use]
pub fn hash(graph: &Graph) -> String {
    let digest = Sha256::digest(json(&Content { motet_graph: VERSION, hash: "", graph }).as_bytes());
    let hex = digest
        .iter()
        .flat_map(|byte| [byte >> 4, byte & 15])
        .filter_map(|digit| char::from_digit(digit.into(), 16));
    std::iter::once("sha256:".to_owned()).chain(hex.map(String::from)).collect()
}

/// JSON Schema of a document.
#[must_use]
pub fn schema() -> schemars::Schema {
    schemars::schema_for!(GraphDocument)
}

/// The part of a document that every version has.
#[derive(Deserialize)]
struct AnyVersion {
    motet_graph: u64,
}

/// A document by reference, as it is written.
#[derive(Serialize)]
struct Content<'a> {
    motet_graph: u32,
    hash: &'a str,
    #[serde(flatten)]
    graph: &'a Graph,
}

fn json(document: &Content<'_>) -> String {
    // Writing to memory fails for no value of these types.
    serde_json::to_string(document).unwrap_or_default()
}

impl Serialize for GraphDocument {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Content { motet_graph: self.motet_graph, hash: &self.hash, graph: &self.graph }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for GraphDocument {
    /// Reads version and hash wherever they stand, and leaves all other keys to the graph, which refuses
    /// unknown ones. `#[serde(flatten)]` could not refuse them.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(DocumentVisitor)
    }
}

struct DocumentVisitor;

impl<'de> Visitor<'de> for DocumentVisitor {
    type Value = GraphDocument;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a graph document")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<GraphDocument, A::Error> {
        let mut header = Header { map, motet_graph: None, hash: None };
        let graph = Graph::deserialize(MapAccessDeserializer::new(&mut header))?;
        Ok(GraphDocument {
            motet_graph: header.motet_graph.ok_or_else(|| A::Error::missing_field("motet_graph"))?,
            hash: header.hash.ok_or_else(|| A::Error::missing_field("hash"))?,
            graph,
        })
    }
}

/// The map of a document, from which the keys of the header are taken as they come.
struct Header<A> {
    map: A,
    motet_graph: Option<u32>,
    hash: Option<String>,
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for &mut Header<A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, A::Error> {
        while let Some(key) = self.map.next_key::<Cow<'de, str>>()? {
            match &*key {
                "motet_graph" if self.motet_graph.is_some() => {
                    return Err(A::Error::duplicate_field("motet_graph"));
                }
                "hash" if self.hash.is_some() => return Err(A::Error::duplicate_field("hash")),
                "motet_graph" => self.motet_graph = Some(self.map.next_value()?),
                "hash" => self.hash = Some(self.map.next_value()?),
                _ => return seed.deserialize(key.into_deserializer()).map(Some),
            }
        }
        Ok(None)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}
