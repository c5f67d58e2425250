//! The tagged text: `<history> … <user> … <vision> … <feasibility> … <robot> …`.

use std::fmt::Write as _;

use thiserror::Error;

use crate::prompt::{Reachability, Sighting};

/// One exchange between a person and a robot. Each part is the trimmed text after its tag, empty if the tag
/// is missing.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Exchange {
    /// Text of `<history>`: earlier turns.
    pub history: String,
    /// Text of `<user>`: words of the person.
    pub user: String,
    /// Text of `<vision>`: visibility of the things that the person names.
    pub vision: String,
    /// Text of `<feasibility>`: reachability of these things.
    pub feasibility: String,
    /// Text of `<robot>`: a list of actions, or a sentence.
    pub robot: String,
}

/// Reasons why a text is not a dialogue.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
pub enum NoDialogue {
    /// Text before the first tag.
    #[error("line {line}: `{text}` stands before the first tag")]
    BeforeTag {
        /// Line of the text, from 1.
        line: usize,
        text: String,
    },
    /// A repeated part that does not begin a new exchange.
    #[error("line {line}: `<{tag}>` comes twice; an exchange begins with `<history>` or `<user>`")]
    Twice {
        /// Line of the text, from 1.
        line: usize,
        tag: &'static str,
    },
    /// More exchanges than [`MAX_EXCHANGES`].
    #[error("line {line}: there are more than {MAX_EXCHANGES} exchanges; split the text into several")]
    TooMany {
        /// Line of the first one that is too many, from 1.
        line: usize,
    },
    /// The text has no parts.
    #[error("there is no tag in it: a dialogue has `<user>` and `<robot>`")]
    Empty,
}

/// The tags, in writing order.
const TAGS: [&str; 5] = ["history", "user", "vision", "feasibility", "robot"];
/// The most exchanges of a text.
pub const MAX_EXCHANGES: usize = 5_000;
/// Length of a quotation in a message, in characters.
pub(super) const QUOTED: usize = 40;

/// Reads all exchanges of a text. Tags may be in either case, closing tags are optional, and the parts of an
/// exchange may come in any order. A second `<history>`, or a `<user>` after a `<robot>`, begins the next
/// exchange. O(bytes).
///
/// ```
/// use motet_planner::inteliplan::exchange;
///
/// let exchanges = exchange::read("<user> bring me the coke <robot> 1. go to counter, 2. pick up coke")?;
/// assert_eq!(exchanges[0].user, "bring me the coke");
/// # Ok::<(), exchange::NoDialogue>(())
/// ```
///
/// # Errors
///
/// Text before the first tag, a repeated part, too many exchanges, or no part at all.
pub fn read(text: &str) -> Result<Vec<Exchange>, NoDialogue> {
    let mut exchanges: Vec<Exchange> = Vec::new();
    let mut found = [false; TAGS.len()];
    let mut open: Option<usize> = None;
    let mut rest = text;
    let line_of = |rest: &str| {
        1 + text
            .len()
            .checked_sub(rest.len())
            .map_or(0, |end| text.bytes().take(end).filter(|byte| *byte == b'\n').count())
    };
    while let Some((before, tag, closes, after)) = next_tag(rest) {
        take(before, open, &mut exchanges)
            .map_err(|text| NoDialogue::BeforeTag { line: line_of(rest), text })?;
        rest = after;
        if closes {
            open = None;
            continue;
        }
        let was = |tag: usize| found.get(tag).copied().unwrap_or_default();
        let begins = exchanges.is_empty()
            || (tag == 0 && found.contains(&true))
            || (tag == 1 && was(1))
            || (tag == 1 && was(4));
        if begins {
            if exchanges.len() == MAX_EXCHANGES {
                return Err(NoDialogue::TooMany { line: line_of(rest) });
            }
            exchanges.push(Exchange::default());
            found = [false; TAGS.len()];
        } else if was(tag) {
            let tag = TAGS.get(tag).copied().unwrap_or_default();
            return Err(NoDialogue::Twice { line: line_of(rest), tag });
        }
        if let Some(found) = found.get_mut(tag) {
            *found = true;
        }
        open = Some(tag);
    }
    take(rest, open, &mut exchanges).map_err(|text| NoDialogue::BeforeTag { line: line_of(rest), text })?;
    if exchanges.is_empty() { Err(NoDialogue::Empty) } else { Ok(exchanges) }
}

/// Adds a text to the open part. The error is the beginning of a text outside of all parts.
fn take(text: &str, open: Option<usize>, exchanges: &mut [Exchange]) -> Result<(), String> {
    let text = text.trim();
    if text.is_empty() {
        return Ok(());
    }
    let part = open.and_then(|tag| exchanges.last_mut()?.part(tag));
    match part {
        Some(part) => {
            part.push_str(text);
            Ok(())
        }
        None => Err(text.chars().take(QUOTED).collect()),
    }
}

/// The text before the next tag, the tag, its kind (opening or closing), and the rest.
fn next_tag(text: &str) -> Option<(&str, usize, bool, &str)> {
    let mut from = 0;
    loop {
        let (_, tail) = text.split_at_checked(from)?;
        let start = from + tail.find('<')?;
        let (before, at) = text.split_at_checked(start)?;
        let inner = at.strip_prefix('<')?;
        if let Some((name, after)) = inner.split_once('>') {
            let bare = name.trim();
            let (closes, bare) = bare.strip_prefix('/').map_or((false, bare), |bare| (true, bare.trim()));
            if let Some(tag) = TAGS.iter().position(|tag| tag.eq_ignore_ascii_case(bare)) {
                return Some((before, tag, closes, after));
            }
        }
        // Any other `<` is text.
        from = start + 1;
    }
}

/// Text without the beginnings of tags: a name in it can begin no part.
pub(super) fn untagged(text: &str) -> String {
    let (mut whole, mut rest) = (String::new(), text);
    while let Some((before, _, _, after)) = next_tag(rest) {
        let tag = rest.strip_prefix(before).and_then(|tag| tag.strip_suffix(after)).unwrap_or_default();
        whole.push_str(before);
        whole.push_str(tag.trim_start_matches('<'));
        rest = after;
    }
    whole + rest
}

/// Texts of `<vision>` and `<feasibility>` for the objects that a request names.
#[must_use]
pub fn sight(seen: &[Sighting]) -> (String, String) {
    let vision = seen.iter().map(|one| {
        let word = match one.seen {
            Some(true) => "seen",
            Some(false) => "not seen",
            None => "unknown",
        };
        format!("{}: {word}", one.id)
    });
    let feasibility = seen.iter().map(|one| match &one.feasible {
        Reachability::Yes | Reachability::AsFarAsNumbersTell => format!("{}: feasible", one.id),
        Reachability::No(why) | Reachability::Hardly(why) => format!("{}: infeasible ({why})", one.id),
        Reachability::Unknown(why) => format!("{}: unknown ({why})", one.id),
    });
    (vision.collect::<Vec<_>>().join(", "), feasibility.collect::<Vec<_>>().join(", "))
}

impl Exchange {
    fn part(&mut self, tag: usize) -> Option<&mut String> {
        [&mut self.history, &mut self.user, &mut self.vision, &mut self.feasibility, &mut self.robot]
            .into_iter()
            .nth(tag)
    }

    /// True if the robot asks a question instead of planning.
    #[must_use]
    pub fn asks(&self) -> bool {
        self.robot.ends_with('?')
    }

    /// The exchange as text, one part per line. Empty history, vision and feasibility are left out. Reading
    /// the text gives the same exchange, but for white space; a tag in a part loses its `<`.
    #[must_use]
    pub fn write(&self) -> String {
        let parts = [&self.history, &self.user, &self.vision, &self.feasibility, &self.robot];
        let mut text = String::new();
        for (tag, part) in TAGS.iter().zip(parts) {
            let part = untagged(&part.split_whitespace().collect::<Vec<_>>().join(" "));
            if !part.is_empty() || matches!(*tag, "user" | "robot") {
                let _ = writeln!(text, "<{tag}> {part}");
            }
        }
        text
    }
}
