//! A small vocabulary: every byte, and pieces that cross the borders of words, texts and steps.

/// Pieces of policies.
const PIECES: [&str; 42] = [
    "{\"",
    "\":\"",
    "\",\"",
    "\":{\"",
    "\":[{\"",
    "\"}",
    "\"},{\"",
    "\"}]",
    "\"}]}",
    "\"}]},{\"",
    "}]}",
    "]}]",
    "null",
    "null}",
    ",\"as\":\"",
    "do\":\"",
    "end\":\"done\"}",
    "end\":\"fail\",\"why\":\"",
    "go\"",
    "pick",
    "detect\",\"what\":\"",
    "red mug",
    "mug",
    "mug_1\"",
    "$m",
    "\"$",
    "\"$m\"",
    "m\"}",
    "1.5",
    "0.",
    "00",
    "99",
    "2}",
    "is\":\"holding\",\"",
    "an",
    " and",
    "x1",
    "_",
    "why",
    "\"}}]",
    "],\"else\":[]}",
    "\"fail\"",
];

/// What ends a sequence: it has no bytes.
pub const END: u32 = 256 + PIECES.len() as u32;

/// The bytes of each token.
#[must_use]
pub fn tokens() -> Vec<Vec<u8>> {
    let bytes = (0..=u8::MAX).map(|byte| vec![byte]);
    let pieces = PIECES.iter().map(|piece| piece.as_bytes().to_vec());
    bytes.chain(pieces).chain([Vec::new()]).collect()
}
