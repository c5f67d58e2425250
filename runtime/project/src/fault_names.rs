//! Names in a file of faults. Each is looked up before the run: a fault with an unknown name would never
//! happen, and nobody would notice.

use motet_compiler::signature::Signatures;
use motet_syntax::json::{self, Spanned};
use motet_syntax::{FileId, Source, suggest};
use schemars::JsonSchema;
use serde::Deserialize;
use smol_str::SmolStr;

/// Names of a file of faults with their spans. Its other values are read with the faults themselves.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct FaultFile {
    calls: Vec<CallFault>,
    world: Vec<WorldChange>,
    #[serde(rename = "answers")]
    _answers: Option<serde_json::Value>,
}

#[derive(Debug, Deserialize, JsonSchema)]
struct CallFault {
    primitive: Spanned<SmolStr>,
    #[serde(default, rename = "nth")]
    _nth: Option<u32>,
    then: CallEnd,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[allow(dead_code, reason = "numbers are read with the faults themselves")]
enum CallEnd {
    Fails(Spanned<SmolStr>),
    Refuses(Spanned<SmolStr>),
    Slower(f64),
    Hangs,
}

#[derive(Debug, Deserialize, JsonSchema)]
struct WorldChange {
    #[serde(rename = "at")]
    _at: f64,
    what: Change,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[allow(dead_code, reason = "numbers are read with the faults themselves")]
enum Change {
    Moves {
        object: Spanned<SmolStr>,
        to: Destination,
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
enum Destination {
    Surface(Spanned<SmolStr>),
    Container(Spanned<SmolStr>),
    Point([f64; 3]),
}

/// Category of a name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum NameKind {
    Primitive,
    Failure,
    Entity,
}

/// Describes each unknown name of a file of faults in a line with its place.
pub(crate) fn unknown(source: &Source, known: &Signatures) -> Vec<String> {
    let (file, _) = json::read::<FaultFile>(source, FileId(0));
    let names = file.map(names).unwrap_or_default();
    names.iter().filter_map(|(kind, name)| describe_unknown(source, *kind, name, known)).collect()
}

fn names(file: FaultFile) -> Vec<(NameKind, Spanned<SmolStr>)> {
    let mut names = Vec::new();
    for call in file.calls {
        names.push((NameKind::Primitive, call.primitive));
        match call.then {
            CallEnd::Fails(kind) | CallEnd::Refuses(kind) => names.push((NameKind::Failure, kind)),
            CallEnd::Slower(_) | CallEnd::Hangs => {}
        }
    }
    for change in file.world {
        match change.what {
            Change::Moves { object, to } => {
                names.push((NameKind::Entity, object));
                match to {
                    Destination::Surface(on) | Destination::Container(on) => {
                        names.push((NameKind::Entity, on))
                    }
                    Destination::Point(_) => {}
                }
            }
            Change::Walks { person, .. } => names.push((NameKind::Entity, person)),
            Change::Slips(it)
            | Change::Opens(it)
            | Change::Closes(it)
            | Change::Locks(it)
            | Change::Unlocks(it) => {
                names.push((NameKind::Entity, it));
            }
            Change::Battery(_) => {}
        }
    }
    names
}

fn describe_unknown(
    source: &Source,
    kind: NameKind,
    name: &Spanned<SmolStr>,
    known: &Signatures,
) -> Option<String> {
    let primitives = known.callables.iter().filter(|callable| !callable.is_policy);
    let (what, all): (_, Vec<&str>) = match kind {
        NameKind::Primitive => ("primitive", primitives.map(|callable| callable.name.as_str()).collect()),
        NameKind::Failure => ("failure", known.failures.iter().map(SmolStr::as_str).collect()),
        NameKind::Entity => ("entity", known.entities.iter().map(|(name, _)| name.as_str()).collect()),
    };
    if all.contains(&name.value.as_str()) {
        return None;
    }
    let (line, column) = source.line_column(name.span.start);
    let near = suggest::closest(&name.value, all)
        .map_or_else(String::new, |near| format!(": did you mean `{near}`?"));
    Some(format!("{}:{line}:{column}: there is no {what} `{}`{near}", source.name, name.value))
}
