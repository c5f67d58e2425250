//! A small grammar of household requests: what is asked for in words becomes goals, or a reason why not.
//!
//! It knows verbs, nouns and a scene's names, not sentences. What it does not understand as a whole it does not guess.

mod aim;
mod asking;
mod carry;
mod clash;
mod command;
mod encouragement;
mod english;
mod errand;
mod forbidden;
mod frame;
mod hedge;
mod inflection;
mod knowledge;
mod lead;
mod meaning;
mod noun;
mod part;
mod phrases;
mod pick;
mod puzzle;
mod reference;
mod remark;
mod side;
mod spoken;
mod spot;
mod statement;
mod staying;
mod template;
pub mod token;
mod verb;
mod vocabulary;
mod whereabouts;
mod wish;

use motet_robots::scene::Scene;
use smol_str::SmolStr;

pub use aim::Aim;
pub use encouragement::encourages;
pub use meaning::Intent;
pub use pick::{called, choose, named, pick};
pub use puzzle::RequestError;

/// What is known where a request is made.
#[derive(Clone, Debug)]
pub struct RequestContext<'a> {
    /// What there is and what it is called.
    pub scene: &'a Scene,
    /// What the hand holds.
    pub holding: Option<SmolStr>,
    /// Where things are now, where that is not where the scene has them; none for nowhere.
    pub supports: Vec<(SmolStr, Option<SmolStr>)>,
    /// What was spoken of before, the latest last.
    pub spoken_of: Vec<SmolStr>,
    /// Where things were before they were last taken from there, the latest last.
    pub came_from: Vec<(SmolStr, SmolStr)>,
    /// What was found out that words mean.
    pub meant: Vec<(String, SmolStr)>,
}

/// Where somebody said that a thing is.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ReportedLocation {
    /// The thing.
    pub thing: SmolStr,
    /// `on` or `in`.
    pub relation: &'static str,
    /// Where.
    pub place: SmolStr,
}

impl<'a> RequestContext<'a> {
    /// The situation at the start of a scene.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        let holding = scene.robot.holding.clone().flatten();
        Self {
            scene,
            holding,
            supports: Vec::new(),
            spoken_of: Vec::new(),
            came_from: Vec::new(),
            meant: Vec::new(),
        }
    }
}

/// Where an answer says that things are: "it should be in the cupboard" tells a place to whom asked for one, where in a
/// request it says what shall be done. Empty where it says nothing of the kind.
#[must_use]
pub fn told(answer: &str, situation: &RequestContext<'_>) -> Vec<ReportedLocation> {
    if answer.len() > MAX_REQUEST {
        return Vec::new();
    }
    meaning::told(&frame::without_courtesy(&token::tokens(answer)), situation)
}

/// Whether an answer is a bare noun or place, such as completes a request: "the cupboard", "on the table, please".
#[must_use]
pub fn is_bare(answer: &str) -> bool {
    let mut tokens = token::tokens(answer);
    tokens.retain(|token| !matches!(token.word(), "please" | ""));
    let place = spot::spot(&tokens, 0).or_else(|| spot::way(&tokens, 0)).map(|(_, end)| end);
    noun::noun(&tokens, 0).map(|(_, end)| end).or(place) == Some(tokens.len())
}

/// The most bytes of a request: what somebody says in one breath, and no document. Longer ones are not read.
pub const MAX_REQUEST: usize = 4096;

/// Understands a request. The same request and situation give the same goals. O(words · things).
///
/// # Errors
///
/// What is not understood, not there, or not clear.
pub fn understand(request: &str, situation: &RequestContext<'_>) -> Result<Intent, RequestError> {
    if request.len() > MAX_REQUEST {
        let why = format!("a request may have at most {MAX_REQUEST} bytes; this one has {}", request.len());
        return Err(RequestError::Unfit { why });
    }
    let tokens = frame::plain(&token::tokens(request));
    let spoken = spoken::spoken(&tokens).map_err(|part| RequestError::NotUnderstood { part })?;
    meaning::understood(&spoken, request, situation)
}
