//! Signed words for a robot: orders, policies and answers. A robot does nothing for words whose signature is
//! not of a key that it trusts, that are meant for another robot, or that are too old.

use ed25519_dalek::{Signature, Signer as _, SigningKey, VerifyingKey};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

/// Greatest size of signed words in bytes.
pub(crate) const MAX_BYTES: usize = 900 * 1024;
/// Greatest lifetime of an order in s.
const MAX_LIFE: u64 = 7 * 24 * 3600;
/// Greatest difference of two clocks in s.
const CLOCKS: u64 = 60;

/// Words with a signature. The signature is of the bytes of `body`, which is JSON.
#[derive(Serialize, Deserialize, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct Signed {
    body: String,
    /// Public key in hexadecimal digits.
    key: String,
    signature: String,
}

/// Words for one robot.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct Words {
    /// Name that no other words have.
    pub(crate) id: String,
    pub(crate) robot: String,
    /// Seconds since 1970 at which they were signed, and until which they count.
    pub(crate) at: u64,
    pub(crate) until: u64,
    pub(crate) what: What,
}

/// What a robot is to do.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum What {
    /// Run a policy, as text or JSON, from a state.
    Run {
        policy: String,
        #[serde(default)]
        state: Option<Value>,
    },
    /// Let a policy take over from the one of an order that runs.
    Swap { order: String, policy: String },
    /// Answer a question of the run of an order.
    Answer { order: String, question: String, text: String },
}

/// Keys of people whose words a robot follows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trust(Vec<VerifyingKey>);

impl Trust {
    /// Reads a file with a key a line: 64 hexadecimal digits, then a comment.
    pub(crate) fn read(path: &Path) -> Result<Self, String> {
        let place = path.display();
        let text = std::fs::read_to_string(path).map_err(|error| format!("{place}: {error}"))?;
        let mut keys = Vec::new();
        for (at, line) in text.lines().enumerate() {
            let Some(word) = line.split_whitespace().next().filter(|word| !word.starts_with('#')) else {
                continue;
            };
            let key = bytes(word).and_then(|bytes| VerifyingKey::from_bytes(&bytes).ok());
            keys.push(key.ok_or_else(|| format!("{place}, line {}: no public key", at + 1))?);
        }
        if keys.is_empty() { Err(format!("{place} has no key")) } else { Ok(Self(keys)) }
    }
}

/// Reads a private key: 64 hexadecimal digits.
pub(crate) fn private_key(path: &Path) -> Result<SigningKey, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let key = bytes(text.trim()).map(|bytes| SigningKey::from_bytes(&bytes));
    key.ok_or_else(|| format!("{} is no private key", path.display()))
}

/// Writes a new private key to a file that only its owner reads, and the public one beside it.
pub(crate) fn new_key(path: &Path) -> Result<String, String> {
    let mut seed = [0; 32];
    getrandom::fill(&mut seed).map_err(|error| format!("no random number: {error}"))?;
    let key = SigningKey::from_bytes(&seed);
    let public = hex(key.verifying_key().as_bytes());
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let wrong = |error: std::io::Error| format!("{}: {error}", path.display());
    let mut file = options.open(path).map_err(wrong)?;
    writeln!(file, "{}", hex(&seed)).map_err(wrong)?;
    let beside = path.with_extension("pub");
    std::fs::write(&beside, format!("{public}\n"))
        .map_err(|error| format!("{}: {error}", beside.display()))?;
    Ok(public)
}

/// Signs words for a robot that count for so many seconds.
pub(crate) fn sign(
    key: &SigningKey,
    id: &str,
    robot: &str,
    life: u64,
    what: What,
) -> Result<Vec<u8>, String> {
    let at = now();
    let words =
        Words { id: id.to_owned(), robot: robot.to_owned(), at, until: at + life.min(MAX_LIFE), what };
    let body = serde_json::to_string(&words).map_err(|error| error.to_string())?;
    let signature = hex(&key.sign(body.as_bytes()).to_bytes());
    let signed = Signed { body, key: hex(key.verifying_key().as_bytes()), signature };
    let bytes = serde_json::to_vec(&signed).map_err(|error| error.to_string())?;
    if bytes.len() > MAX_BYTES {
        Err(format!("the policy is larger than {MAX_BYTES} bytes"))
    } else {
        Ok(bytes)
    }
}

impl Words {
    /// Says since when words do not count any more.
    pub(crate) fn check_time(&self) -> Result<(), String> {
        let late = now().saturating_sub(self.until);
        if late > 0 { Err(format!("they counted until {late} s before now")) } else { Ok(()) }
    }
}

/// Words of a trusted key for this robot that still count.
pub(crate) fn open(bytes_of: &[u8], trust: &Trust, robot: &str) -> Result<Words, String> {
    let words = read(bytes_of, trust, robot)?;
    words.check_time().map(|()| words)
}

/// Words of a trusted key for this robot, whether or not they still count.
pub(crate) fn read(bytes_of: &[u8], trust: &Trust, robot: &str) -> Result<Words, String> {
    if bytes_of.len() > MAX_BYTES {
        return Err(format!("they have more than {MAX_BYTES} bytes"));
    }
    let signed: Signed =
        serde_json::from_slice(bytes_of).map_err(|error| format!("they are not signed: {error}"))?;
    let key = bytes(&signed.key).ok_or("their key is none")?;
    let key = trust.0.iter().find(|own| *own.as_bytes() == key).ok_or("their key is not trusted")?;
    let signature = bytes(&signed.signature)
        .map(|bytes| Signature::from_bytes(&bytes))
        .ok_or("their signature is none")?;
    key.verify_strict(signed.body.as_bytes(), &signature).map_err(|_| "their signature is wrong")?;
    let words: Words =
        serde_json::from_str(&signed.body).map_err(|error| format!("they cannot be read: {error}"))?;
    if words.robot != robot {
        return Err(format!("they are for the robot `{}`", words.robot.escape_debug()));
    }
    if !is_name(&words.id) {
        return Err("their id is no name".to_owned());
    }
    if words.at > now() + CLOCKS || words.until > words.at + MAX_LIFE {
        return Err("their times are wrong".to_owned());
    }
    Ok(words)
}

/// True for names of robots and orders: 1 to 64 letters, digits, `_` and `-`.
pub(crate) fn is_name(text: &str) -> bool {
    let is_letter = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    (1..=64).contains(&text.len()) && text.bytes().all(is_letter)
}

/// A new id.
pub(crate) fn new_id() -> Result<String, String> {
    let mut bytes = [0; 12];
    getrandom::fill(&mut bytes).map_err(|error| format!("no random number: {error}"))?;
    Ok(hex(&bytes))
}

/// Seconds since 1970.
pub(crate) fn now() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs()
}

pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn bytes<const COUNT: usize>(text: &str) -> Option<[u8; COUNT]> {
    if text.len() != 2 * COUNT || !text.is_ascii() {
        return None;
    }
    let digits = (0..COUNT).map(|at| u8::from_str_radix(&text[2 * at..2 * at + 2], 16).ok());
    digits.collect::<Option<Vec<u8>>>()?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(seed: u8) -> SigningKey {
        SigningKey::from_bytes(&[seed; 32])
    }

    fn said(key: &SigningKey, robot: &str, life: u64) -> Vec<u8> {
        let what = What::Swap { order: "order-0".to_owned(), policy: "policy a for hsr { done }".to_owned() };
        sign(key, "order-1", robot, life, what).unwrap()
    }

    #[test]
    fn only_words_of_a_trusted_key_for_this_robot_are_opened() {
        let trust = Trust(vec![key(1).verifying_key()]);
        let opened = open(&said(&key(1), "kitchen_1", 60), &trust, "kitchen_1").unwrap();
        assert_eq!(opened.id, "order-1");
        let wrong = |bytes: &[u8], robot| open(bytes, &trust, robot).unwrap_err();
        assert_eq!(wrong(&said(&key(2), "kitchen_1", 60), "kitchen_1"), "their key is not trusted");
        assert_eq!(wrong(&said(&key(1), "kitchen_1", 60), "kitchen_2"), "they are for the robot `kitchen_1`");
        let mut changed: Signed = serde_json::from_slice(&said(&key(1), "kitchen_1", 60)).unwrap();
        changed.body = changed.body.replace("policy a", "policy b");
        assert_eq!(wrong(&serde_json::to_vec(&changed).unwrap(), "kitchen_1"), "their signature is wrong");
        assert!(wrong(b"{}", "kitchen_1").starts_with("they are not signed"));
        let what = What::Swap { order: String::new(), policy: String::new() };
        let words = Words { id: "a/b".to_owned(), robot: "r".to_owned(), at: now(), until: now(), what };
        let body = serde_json::to_string(&words).unwrap();
        let signature = hex(&key(1).sign(body.as_bytes()).to_bytes());
        let signed = Signed { body, key: hex(key(1).verifying_key().as_bytes()), signature };
        assert_eq!(wrong(&serde_json::to_vec(&signed).unwrap(), "r"), "their id is no name");
    }

    #[test]
    fn words_that_count_no_more_are_read_and_not_opened() {
        let trust = Trust(vec![key(1).verifying_key()]);
        let what = What::Run { policy: String::new(), state: None };
        let times = (now() - 100, now() - 40);
        let words = Words { id: "a".to_owned(), robot: "r".to_owned(), at: times.0, until: times.1, what };
        let body = serde_json::to_string(&words).unwrap();
        let signature = hex(&key(1).sign(body.as_bytes()).to_bytes());
        let signed = Signed { body, key: hex(key(1).verifying_key().as_bytes()), signature };
        let bytes = serde_json::to_vec(&signed).unwrap();
        assert_eq!(read(&bytes, &trust, "r"), Ok(words));
        assert!(open(&bytes, &trust, "r").unwrap_err().starts_with("they counted until 4"));
    }

    #[test]
    fn a_key_is_written_for_its_owner_alone() {
        let folder = std::env::temp_dir().join(format!("motet-fleet-key-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("anna.key");
        let public = new_key(&path).unwrap();
        assert_eq!(hex(private_key(&path).unwrap().verifying_key().as_bytes()), public);
        assert!(Trust::read(&folder.join("anna.pub")).is_ok());
        assert!(new_key(&path).is_err(), "a key is never overwritten");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o077, 0);
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
