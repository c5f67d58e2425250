//! The names in a file of faults: each is looked up before the run, since a fault for nobody never happens and is never
//! missed.

use motet_compiler::signature::Signatures;
use motet_syntax::json::{self, Spanned};
use motet_syntax::{FileId, Source, suggest};
use schemars::JsonSchema;
use serde::Deserialize;
use smol_str::SmolStr;

/// The names of a file of faults with their places; what else stands there was read before.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct File {
    calls: Vec<Call>,
    world: Vec<Happens>,
    #[serde(rename = "answers")]
    _answers: Option<serde_json::Value>,
}

#[derive(Debug, Deserialize, JsonSchema)]
struct Call {
    primitive: Spanned<SmolStr>,
    #[serde(default, rename = "nth")]
    _nth: Option<u32>,
    then: Then,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[allow(dead_code, reason = "numbers are read with the faults themselves")]
enum Then {
    Fails(Spanned<SmolStr>),
    Refuses(Spanned<SmolStr>),
    Slower(f64),
    Hangs,
}

#[derive(Debug, Deserialize, JsonSchema)]
struct Happens {
    #[serde(rename = "at")]
    _at: f64,
    what: What,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[allow(dead_code, reason = "numbers are read with the faults themselves")]
enum What {
    Moves {
        object: Spanned<SmolStr>,
        to: To,
    },
    Walks {
        person: Spanned<SmolStr>,
        #[serde(default, rename = "from")]
        _from: Option<[f64; 2]>,
        #[serde(rename = "to")]
        _to: [f64; 2],
        #[serde(rename = "speed")]
        _speed: f64,
    },
    Slips(Spanned<SmolStr>),
    Opens(Spanned<SmolStr>),
    Closes(Spanned<SmolStr>),
    Locks(Spanned<SmolStr>),
    Unlocks(Spanned<SmolStr>),
    Battery(f64),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[allow(dead_code, reason = "numbers are read with the faults themselves")]
enum To {
    Surface(Spanned<SmolStr>),
    Container(Spanned<SmolStr>),
    Point([f64; 3]),
}

/// What a name stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Sort {
    Primitive,
    Failure,
    Entity,
}

/// What is wrong with the names of a file of faults, a line each with its place. Nothing where all are known.
pub(super) fn wrong(source: &Source, known: &Signatures) -> Vec<String> {
    let (file, _) = json::read::<File>(source, FileId(0));
    let names = file.map(names).unwrap_or_default();
    names.iter().filter_map(|(sort, name)| told(source, *sort, name, known)).collect()
}

fn names(file: File) -> Vec<(Sort, Spanned<SmolStr>)> {
    let mut names = Vec::new();
    for call in file.calls {
        names.push((Sort::Primitive, call.primitive));
        match call.then {
            Then::Fails(kind) | Then::Refuses(kind) => names.push((Sort::Failure, kind)),
            Then::Slower(_) | Then::Hangs => {}
        }
    }
    for change in file.world {
        match change.what {
            What::Moves { object, to } => {
                names.push((Sort::Entity, object));
                match to {
                    To::Surface(on) | To::Container(on) => names.push((Sort::Entity, on)),
                    To::Point(_) => {}
                }
            }
            What::Walks { person, .. } => names.push((Sort::Entity, person)),
            What::Slips(it) | What::Opens(it) | What::Closes(it) | What::Locks(it) | What::Unlocks(it) => {
                names.push((Sort::Entity, it));
            }
            What::Battery(_) => {}
        }
    }
    names
}

fn told(source: &Source, sort: Sort, name: &Spanned<SmolStr>, known: &Signatures) -> Option<String> {
    let primitives = known.callables.iter().filter(|callable| !callable.is_policy);
    let (what, all): (_, Vec<&str>) = match sort {
        Sort::Primitive => ("primitive", primitives.map(|callable| callable.name.as_str()).collect()),
        Sort::Failure => ("failure", known.failures.iter().map(SmolStr::as_str).collect()),
        Sort::Entity => ("entity", known.entities.iter().map(|(name, _)| name.as_str()).collect()),
    };
    if all.contains(&name.value.as_str()) {
        return None;
    }
    let (line, column) = source.line_column(name.span.start);
    let near = suggest::closest(&name.value, all)
        .map_or_else(String::new, |near| format!(": did you mean `{near}`?"));
    Some(format!("{}:{line}:{column}: there is no {what} `{}`{near}", source.name, name.value))
}
