//! Wordings, from a file: how people ask for things, and how they answer.

use thiserror::Error;

/// The wordings that come with Motet.
pub const OWN: &str = include_str!("../data/wordings.txt");

/// Kind of request.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Task {
    /// A thing to the person who asks.
    Bring,
    /// A thing onto a surface.
    Put,
    /// A thing into a container.
    Stow,
    /// A thing into the bin.
    Throw,
    /// A thing into the hand.
    Pick,
    /// The robot to a place.
    Go,
    /// A container open.
    Open,
    /// A container closed.
    Close,
}

impl Task {
    /// All of them.
    pub const ALL: [Self; 8] =
        [Self::Bring, Self::Put, Self::Stow, Self::Throw, Self::Pick, Self::Go, Self::Open, Self::Close];

    /// As a file of wordings has it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bring => "bring",
            Self::Put => "put",
            Self::Stow => "stow",
            Self::Throw => "throw",
            Self::Pick => "pick",
            Self::Go => "go",
            Self::Open => "open",
            Self::Close => "close",
        }
    }

    /// True if the task moves a thing.
    #[must_use]
    pub const fn carries(self) -> bool {
        match self {
            Self::Bring | Self::Put | Self::Stow | Self::Throw | Self::Pick => true,
            Self::Go | Self::Open | Self::Close => false,
        }
    }

    /// Slots of the task's wordings.
    const fn holes(self) -> &'static [&'static str] {
        match self {
            Self::Bring | Self::Throw | Self::Pick => &["{thing}"],
            Self::Put | Self::Stow => &["{thing}", "{place}"],
            Self::Go | Self::Open | Self::Close => &["{place}"],
        }
    }
}

/// Wordings by purpose.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Wordings {
    /// Requests; `{thing}` and `{place}` are names with their articles.
    pub requests: Vec<(Task, String)>,
    /// Statements of a location; `{at}` is a place with its preposition.
    pub places: Vec<String>,
    /// To try again.
    pub again: Vec<String>,
    /// To leave it.
    pub leave: Vec<String>,
    /// Requests that do not say what to do with `{thing}`.
    pub vague: Vec<String>,
    /// Other wishes for `{thing}` while it is being carried; `{place}` is a surface.
    pub instead: Vec<String>,
}

/// A line that is no wording.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
#[error("line {line}: {why}")]
pub struct NoWording {
    /// Line of the file, from 1.
    pub line: usize,
    pub why: String,
}

/// Reads wordings: a line each, `KEY: WORDING`, where the key is a task, `where`, `again`, `leave`,
/// `vague` or `instead`. Empty lines and those that begin with `#` are skipped. O(bytes).
///
/// ```
/// use motet_dataset::wordings::{OWN, read};
///
/// assert!(read(OWN).is_ok());
/// let wrong = read("bring: Bring me that.").unwrap_err();
/// assert_eq!((wrong.line, wrong.why.as_str()), (1, "`bring` has no {thing}"));
/// ```
///
/// # Errors
///
/// The first line that is none, or that there is no request at all.
pub fn read(text: &str) -> Result<Wordings, NoWording> {
    let mut wordings = Wordings::default();
    for (index, line) in text.lines().enumerate() {
        let wrong = |why: String| NoWording { line: index + 1, why };
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let Some((key, said)) = line.split_once(':').map(|(key, said)| (key.trim(), said.trim())) else {
            return Err(wrong("it has no `KEY:` before the wording".to_owned()));
        };
        let needs = |holes: &[&str]| match holes.iter().find(|hole| !said.contains(**hole)) {
            Some(hole) => Err(wrong(format!("`{key}` has no {hole}"))),
            None => Ok(()),
        };
        let list = match key {
            "where" => {
                needs(&["{at}"])?;
                &mut wordings.places
            }
            "vague" => {
                needs(&["{thing}"])?;
                &mut wordings.vague
            }
            "instead" => &mut wordings.instead,
            "again" => &mut wordings.again,
            "leave" => &mut wordings.leave,
            _ => {
                let Some(task) = Task::ALL.into_iter().find(|task| task.name() == key) else {
                    let known: Vec<&str> = Task::ALL.iter().map(|task| task.name()).collect();
                    let known = known.join(", ");
                    return Err(wrong(format!(
                        "there is no task `{key}`; known are {known}, \
                         `where`, `again`, `leave`, `vague` and \
                         `instead`"
                    )));
                };
                needs(task.holes())?;
                wordings.requests.push((task, said.to_owned()));
                continue;
            }
        };
        list.push(said.to_owned());
    }
    if wordings.requests.is_empty() {
        return Err(NoWording { line: text.lines().count(), why: "there is no request".to_owned() });
    }
    Ok(wordings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wordings_own_wordings_are_right_and_have_every_kind() {
        let own = read(OWN).unwrap();
        for task in Task::ALL {
            assert!(own.requests.iter().filter(|(known, _)| *known == task).count() >= 6, "{task:?}");
        }
        for list in [&own.places, &own.again, &own.leave, &own.vague, &own.instead] {
            assert!(list.len() >= 3, "{list:?}");
        }
    }

    #[test]
    fn wordings_line_that_is_wrong_is_named() {
        for (text, line, words) in [
            ("bring: get {thing}\nnonsense", 2, "KEY:"),
            ("wash: wash {thing}", 1, "no task `wash`"),
            ("put: put {thing} down", 1, "{place}"),
            ("where: there", 1, "{at}"),
            ("# nothing\n", 1, "no request"),
        ] {
            let wrong = read(text).unwrap_err();
            assert_eq!((wrong.line, wrong.why.contains(words)), (line, true), "{text}: {wrong}");
        }
    }
}
