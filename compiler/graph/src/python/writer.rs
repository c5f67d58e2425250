//! The writer of a script: its parts so far, the names of bindings, and the entities that were heard of.

use std::collections::BTreeSet;

use smol_str::SmolStr;

use crate::model::{BindingId, Graph, Kind, KindId, Type};

/// Names that the script uses itself, and that no binding may have.
const TAKEN: &str = "\
    ANY Case Contract EACH Entity Entry Failed False MOTIONS Need None Planned Pose RESULT SCRIPT Robot \
    Script Text True all_of and any_of arith as assert async await break class compare continue \
    count def del elif else except fact failure field finally first for from global if import in is \
    json lambda main measure no nonlocal not or pass planned raise range return robot said try \
    while with yield";

/// A script while it is written.
pub(super) struct Writer<'g> {
    pub(super) graph: &'g Graph,
    /// Name of the function with the steps.
    pub(super) name: String,
    /// Names of the bindings in the script.
    pub(super) names: Vec<String>,
    /// Entities with their kinds, in the order in which they are heard of.
    pub(super) entities: Vec<(SmolStr, KindId)>,
    /// Functions that give the contracts of calls.
    pub(super) contracts: String,
    pub(super) steps: String,
    /// Paths that the compiler has found, by step.
    pub(super) motions: Vec<(SmolStr, String)>,
}

impl<'g> Writer<'g> {
    pub(super) fn new(graph: &'g Graph, entities: &[(SmolStr, SmolStr)]) -> Self {
        let mut taken: BTreeSet<String> = TAKEN.split_whitespace().map(str::to_owned).collect();
        let name = free(&identifier(&graph.policy), &mut taken);
        let names = graph.bindings.iter().map(|binding| free(&identifier(&binding.name), &mut taken));
        let names = names.collect();
        let mut writer = Self {
            graph,
            name,
            names,
            entities: Vec::new(),
            contracts: String::new(),
            steps: String::new(),
            motions: Vec::new(),
        };
        for (id, kind) in entities {
            let known = graph.kinds.iter().position(|known| known.name == *kind);
            if let Some(kind) = known.and_then(|index| u32::try_from(index).ok()) {
                writer.hear(id, KindId(kind));
            }
        }
        writer
    }

    /// Notes an entity; the narrowest kind of each is kept.
    pub(super) fn hear(&mut self, id: &SmolStr, kind: KindId) {
        match self.entities.iter().position(|(known, _)| known == id) {
            Some(index) => {
                let graph = self.graph;
                if let Some((_, known)) = self.entities.get_mut(index)
                    && is_kind(graph, kind, *known)
                {
                    *known = kind;
                }
            }
            None => self.entities.push((id.clone(), kind)),
        }
    }

    pub(super) fn binding(&self, id: BindingId) -> String {
        self.names.get(id.index()).cloned().unwrap_or_else(|| "None".to_owned())
    }

    pub(super) fn binding_type(&self, id: BindingId) -> Type {
        self.graph.bindings.get(id.index()).map_or(Type::Bool, |binding| binding.ty.clone())
    }

    pub(super) fn line(&mut self, level: usize, text: &str) {
        self.steps.extend(std::iter::repeat_n("    ", level));
        self.steps.push_str(text);
        self.steps.push('\n');
    }

    /// A comment of one line, whatever is in it.
    pub(super) fn comment(&mut self, level: usize, text: &str) {
        let text: String = text.chars().map(|char| if char.is_control() { ' ' } else { char }).collect();
        self.line(level, &format!("# {text}"));
    }
}

/// A name as most languages have it: letters, digits and underscores of ASCII.
#[must_use]
pub fn identifier(name: &str) -> String {
    let plain = |char: char| if char.is_ascii_alphanumeric() { char } else { '_' };
    let name: String = name.chars().map(plain).collect();
    if name.starts_with(|char: char| char.is_ascii_digit()) || name.is_empty() {
        format!("_{name}")
    } else {
        name
    }
}

/// A name that is not taken yet, and is from now on.
fn free(name: &str, taken: &mut BTreeSet<String>) -> String {
    let generated = ["part_", "cleanup_", "contract_"].iter().any(|stem| name.starts_with(stem));
    let stem = if generated || name == "_" { format!("its_{name}") } else { name.to_owned() };
    let mut candidates =
        std::iter::once(stem.clone()).chain((2_u64..).map(|number| format!("{stem}_{number}")));
    let name = candidates.find(|name| !taken.contains(name)).unwrap_or(stem);
    taken.insert(name.clone());
    name
}

/// True if a kind is another or below it.
fn is_kind(graph: &Graph, kind: KindId, above: KindId) -> bool {
    let parent = |id: &KindId| graph.kinds.get(id.index()).and_then(|kind: &Kind| kind.parent);
    let ancestors = std::iter::successors(Some(kind), |id| parent(id).filter(|parent| parent < id));
    ancestors.into_iter().any(|id| id == above)
}
