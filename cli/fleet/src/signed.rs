//! Signed messages to a robot: orders, policies and answers. A robot ignores a message whose signature is not
//! of a key that it trusts, that is meant for another robot, or that is too old.

use ed25519_dalek::{Signature, Signer as _, SigningKey, VerifyingKey};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{SystemTime, UNIX_EPOCH};

/// Greatest size of a signed message in bytes.
pub(crate) const MAX_BYTES: usize = 900 * 1024;
/// Greatest lifetime of an order in s.
const MAX_LIFE: u64 = 7 * 24 * 3600;
/// Greatest difference of two clocks in s.
const CLOCKS: u64 = 60;

/// Message with a signature. The signature is of the bytes of `body`, which is JSON.
#[derive(Serialize, Deserialize, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct Signed {
    body: String,
    /// Public key in hexadecimal digits.
    key: String,
    signature: String,
}

/// Message to one robot.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct OperatorMessage {
    /// Name that no other message has.
    pub(crate) id: String,
    pub(crate) robot: String,
    /// Seconds since 1970 at which it was signed, and until which it counts.
    pub(crate) at: u64,
    pub(crate) until: u64,
    pub(crate) what: Instruction,
}

/// Message with the public key that signed it, whether or not a robot trusts it.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct SignedMessage {
    /// Public key in hexadecimal digits.
    pub(crate) key: String,
    pub(crate) words: OperatorMessage,
}

/// Instruction to a robot.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Instruction {
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

impl Instruction {
    /// Digest by which two orders with the same id are told apart: 16 hexadecimal digits.
    pub(crate) fn digest(&self) -> String {
        let json = serde_json::to_vec(self).unwrap_or_default();
        hex(&Sha256::digest(json)[..8])
    }
}

/// File with the keys of people whose words a robot follows. It is read anew at each use, so that a key that
/// is taken out of it counts no more.
#[derive(Debug)]
pub(crate) struct TrustFile {
    path: PathBuf,
    /// Keys of the last time, and the reason for which the file cannot be read since.
    last: Mutex<(Trust, String)>,
}

impl TrustFile {
    /// Opens a file that has a key.
    pub(crate) fn open(path: &Path) -> Result<Self, String> {
        let trust = Trust::read(path)?;
        if trust.0.is_empty() {
            return Err(format!("{} has no key", path.display()));
        }
        let path = std::path::absolute(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Self { path, last: Mutex::new((trust, String::new())) })
    }

    /// Keys of the file as it is now, or as it was when it could be read last.
    pub(crate) fn now(&self) -> Trust {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        match Trust::read(&self.path) {
            Ok(trust) => *last = (trust, String::new()),
            Err(why) if why != last.1 => {
                crate::notes::note(&format!("trust: {why}; the keys before count"));
                last.1 = why;
            }
            Err(_) => {}
        }
        last.0.clone()
    }
}

/// Keys of people whose words a robot follows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trust(Vec<VerifyingKey>);

impl Trust {
    /// Reads a file with a key a line: 64 hexadecimal digits, then a comment.
    fn read(path: &Path) -> Result<Self, String> {
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
        Ok(Self(keys))
    }

    /// Checks whether a public key, in hexadecimal digits, is one of these.
    pub(crate) fn has(&self, key: &str) -> bool {
        bytes(key).is_some_and(|key| self.0.iter().any(|own| *own.as_bytes() == key))
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
    what: Instruction,
) -> Result<Vec<u8>, String> {
    let at = now();
    let words = OperatorMessage {
        id: id.to_owned(),
        robot: robot.to_owned(),
        at,
        until: at + life.min(MAX_LIFE),
        what,
    };
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

impl OperatorMessage {
    /// Says since when words do not count any more.
    pub(crate) fn check_time(&self) -> Result<(), String> {
        let late = now().saturating_sub(self.until);
        if late > 0 { Err(format!("they counted until {late} s before now")) } else { Ok(()) }
    }
}

/// Message of a trusted key to this robot that still counts.
pub(crate) fn open(bytes_of: &[u8], trust: &Trust, robot: &str) -> Result<OperatorMessage, String> {
    let words = read(bytes_of, trust, robot)?;
    words.check_time().map(|()| words)
}

/// Message of a trusted key to this robot, whether or not it still counts.
pub(crate) fn read(bytes_of: &[u8], trust: &Trust, robot: &str) -> Result<OperatorMessage, String> {
    let SignedMessage { key, words } = verify(bytes_of, robot)?;
    if trust.has(&key) { Ok(words) } else { Err(UNTRUSTED.to_owned()) }
}

/// Reason of a refusal.
pub(crate) const UNTRUSTED: &str = "their key is not trusted";

/// Message to this robot with a right signature, whoever signed it and whether or not it still counts.
pub(crate) fn verify(bytes_of: &[u8], robot: &str) -> Result<SignedMessage, String> {
    if bytes_of.len() > MAX_BYTES {
        return Err(format!("they have more than {MAX_BYTES} bytes"));
    }
    let signed: Signed =
        serde_json::from_slice(bytes_of).map_err(|error| format!("they are not signed: {error}"))?;
    let key = bytes(&signed.key).and_then(|bytes| VerifyingKey::from_bytes(&bytes).ok());
    let key = key.ok_or("their key is none")?;
    let signature = bytes(&signed.signature)
        .map(|bytes| Signature::from_bytes(&bytes))
        .ok_or("their signature is none")?;
    key.verify_strict(signed.body.as_bytes(), &signature).map_err(|_| "their signature is wrong")?;
    let words: OperatorMessage =
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
    Ok(SignedMessage { key: hex(key.as_bytes()), words })
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
        let what =
            Instruction::Swap { order: "order-0".to_owned(), policy: "policy a for hsr { done }".to_owned() };
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
        let what = Instruction::Swap { order: String::new(), policy: String::new() };
        let words =
            OperatorMessage { id: "a/b".to_owned(), robot: "r".to_owned(), at: now(), until: now(), what };
        let body = serde_json::to_string(&words).unwrap();
        let signature = hex(&key(1).sign(body.as_bytes()).to_bytes());
        let signed = Signed { body, key: hex(key(1).verifying_key().as_bytes()), signature };
        assert_eq!(wrong(&serde_json::to_vec(&signed).unwrap(), "r"), "their id is no name");
    }

    #[test]
    fn digest_tells_orders_apart_and_not_their_times() {
        let what = |state: &str| Instruction::Run {
            policy: "policy a for hsr { done }".to_owned(),
            state: serde_json::from_str(state).unwrap(),
        };
        let digest = what(r#"{"distance": 0.1}"#).digest();
        assert_eq!(digest.len(), 16);
        assert_ne!(digest, what(r#"{"distance": 0.2}"#).digest());
        assert_ne!(digest, what("null").digest());
        // It is the same on the robot: numbers are read as they were written.
        let numbers = what(r#"{"a": 0.30000000000000004, "b": 1e-7, "c": 123456789.12345679}"#);
        let signed = sign(&key(1), "order-1", "r", 60, numbers.clone()).unwrap();
        assert_eq!(verify(&signed, "r").unwrap().words.what.digest(), numbers.digest());
    }

    #[test]
    fn words_that_count_no_more_are_read_and_not_opened() {
        let trust = Trust(vec![key(1).verifying_key()]);
        let what = Instruction::Run { policy: String::new(), state: None };
        let times = (now() - 100, now() - 40);
        let words =
            OperatorMessage { id: "a".to_owned(), robot: "r".to_owned(), at: times.0, until: times.1, what };
        let body = serde_json::to_string(&words).unwrap();
        let signature = hex(&key(1).sign(body.as_bytes()).to_bytes());
        let signed = Signed { body, key: hex(key(1).verifying_key().as_bytes()), signature };
        let bytes = serde_json::to_vec(&signed).unwrap();
        assert_eq!(read(&bytes, &trust, "r"), Ok(words));
        assert!(open(&bytes, &trust, "r").unwrap_err().starts_with("they counted until 4"));
    }

    #[test]
    fn key_is_written_for_its_owner_alone() {
        let folder = std::env::temp_dir().join(format!("motet-fleet-key-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("anna.key");
        let public = new_key(&path).unwrap();
        assert_eq!(hex(private_key(&path).unwrap().verifying_key().as_bytes()), public);
        let trust = TrustFile::open(&folder.join("anna.pub")).unwrap();
        assert!(trust.now().has(&public));
        // What cannot be read changes nothing; a file without the key does.
        std::fs::write(folder.join("anna.pub"), "no key\n").unwrap();
        assert!(trust.now().has(&public));
        std::fs::write(folder.join("anna.pub"), "# nobody\n").unwrap();
        assert!(!trust.now().has(&public));
        assert!(TrustFile::open(&folder.join("anna.pub")).unwrap_err().contains("has no key"));
        assert!(new_key(&path).is_err(), "a key is never overwritten");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o077, 0);
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
