//! Declarations in force, by name: those of the library, the robot, the domains and a document, each with its
//! place and its text. Entities of the scene and the robot's card count among them.

use std::collections::BTreeMap;

use motet_project::ProjectSession;
use motet_syntax::ast::{Doc, File, Item, Name};
use motet_syntax::located::{Located, LocatedValue, parse_json};
use motet_syntax::{FileId, Source, Span};
use smol_str::SmolStr;

use super::names::NameSpace;

/// Declaration of a name.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Declaration {
    pub(crate) kind: DeclarationKind,
    /// Place of the name.
    pub(crate) span: Span,
    /// Place of the whole declaration.
    pub(crate) whole: Span,
    pub(crate) doc: Doc,
}

/// Kind of a declaration.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum DeclarationKind {
    Policy,
    Action,
    Perception,
    Fluent,
    Measure,
    Kind,
    Enum,
    Case,
    Failure,
    Entity,
    Robot,
}

impl DeclarationKind {
    /// Word for the kind.
    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::Policy => "policy",
            Self::Action => "action",
            Self::Perception => "perception",
            Self::Fluent => "fluent",
            Self::Measure => "measure",
            Self::Kind => "kind",
            Self::Enum => "enum",
            Self::Case => "case",
            Self::Failure => "failure",
            Self::Entity => "entity",
            Self::Robot => "robot",
        }
    }
}

/// Declarations by name space and name; the last one counts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Declarations {
    by_name: BTreeMap<(NameSpace, SmolStr), Declaration>,
}

impl Declarations {
    /// Empty table, of a document without a project.
    pub(crate) const fn none() -> Self {
        Self { by_name: BTreeMap::new() }
    }

    /// Declarations of a file.
    pub(crate) fn of_file(file: &File) -> Self {
        let mut all = Self::default();
        all.add_file(file);
        all
    }

    /// Declarations of a project, without those of a document. O(bytes of its files).
    pub(crate) fn of_project(project: &ProjectSession) -> Self {
        let mut all = Self::default();
        let sources = project.sources(Source::new("", ""));
        for index in 1..sources.len() {
            let Ok(file) = u16::try_from(index).map(FileId) else { break };
            let Some(source) = sources.get(file) else { break };
            if source.name.ends_with(".motet") {
                all.add_file(&motet_syntax::read(source, file).file);
            } else if source.name.ends_with(".json") {
                all.add_scene(source, file);
            } else if source.name.ends_with("robot.toml")
                && let Some(robot) = &project.robot
            {
                let span = Span::new(file, 0, 0);
                let doc = Doc::default();
                let kind = DeclarationKind::Robot;
                all.add(NameSpace::Robot, &robot.name, Declaration { kind, span, whole: span, doc });
            }
        }
        all
    }

    /// Declaration of a name.
    pub(crate) fn get(&self, space: NameSpace, name: &str) -> Option<&Declaration> {
        self.by_name.get(&(space, SmolStr::from(name)))
    }

    fn add(&mut self, space: NameSpace, name: &SmolStr, declaration: Declaration) {
        self.by_name.insert((space, name.clone()), declaration);
    }

    fn add_name(&mut self, space: NameSpace, kind: DeclarationKind, name: &Name, (whole, doc): (Span, &Doc)) {
        self.add(space, &name.text, Declaration { kind, span: name.span, whole, doc: doc.clone() });
    }

    fn add_file(&mut self, file: &File) {
        for item in &file.items {
            let whole = item.span();
            match item {
                Item::Kind(decl) => {
                    let at = (whole, &decl.doc);
                    self.add_name(NameSpace::Type, DeclarationKind::Kind, &decl.name, at);
                }
                Item::Fluent(decl) => {
                    let at = (whole, &decl.doc);
                    self.add_name(NameSpace::Relation, DeclarationKind::Fluent, &decl.name, at);
                }
                Item::Measure(decl) => {
                    let at = (whole, &decl.doc);
                    self.add_name(NameSpace::Relation, DeclarationKind::Measure, &decl.name, at);
                }
                Item::Failure(decl) => {
                    let at = (whole, &decl.doc);
                    self.add_name(NameSpace::Value, DeclarationKind::Failure, &decl.name, at);
                }
                Item::Enum(decl) => {
                    let at = (whole, &decl.doc);
                    self.add_name(NameSpace::Type, DeclarationKind::Enum, &decl.name, at);
                    for case in &decl.cases {
                        self.add_name(NameSpace::Value, DeclarationKind::Case, case, at);
                    }
                }
                Item::Primitive(decl) => {
                    let kind = match decl.kind {
                        motet_syntax::ast::PrimitiveKind::Action => DeclarationKind::Action,
                        motet_syntax::ast::PrimitiveKind::Perception => DeclarationKind::Perception,
                    };
                    self.add_name(NameSpace::Callable, kind, &decl.name, (whole, &decl.doc));
                }
                Item::Policy(decl) => {
                    let at = (whole, &decl.doc);
                    self.add_name(NameSpace::Callable, DeclarationKind::Policy, &decl.name, at);
                }
                Item::Entities(decl) => {
                    for name in &decl.names {
                        let at = (whole, &decl.doc);
                        self.add_name(NameSpace::Value, DeclarationKind::Entity, name, at);
                    }
                }
                Item::Initially(_) | Item::ClosedWorld(_) => {}
            }
        }
    }

    /// Adds the entities of a scene; nothing of a file that is none.
    fn add_scene(&mut self, source: &Source, file: FileId) {
        let (Some(tree), _) = parse_json(&source.text, file) else { return };
        let Some(LocatedValue::Array(entities)) = member(&tree, "entities").map(|list| &list.value) else {
            return;
        };
        for entity in entities {
            let Some(id) = member(entity, "id") else { continue };
            let Some(name) = id.text().map(SmolStr::from) else { continue };
            let range = id.span.range();
            let span = Span::new(file, range.start + 1, range.end.saturating_sub(1));
            let declaration =
                Declaration { kind: DeclarationKind::Entity, span, whole: entity.span, doc: Doc::default() };
            self.add(NameSpace::Value, &name, declaration);
        }
    }
}

/// Member of an object with a key.
fn member<'t, 's>(of: &'t Located<'s>, key: &str) -> Option<&'t Located<'s>> {
    of.members().iter().find(|(name, _)| name.text() == Some(key)).map(|(_, value)| value)
}

#[cfg(test)]
mod tests {
    use motet_project::{Discard, Project};

    use super::{DeclarationKind, Declarations};
    use crate::editor::names::NameSpace;

    #[test]
    fn of_project_finds_declarations_in_all_files() {
        let project = Project::builder().robot("hsr").scene("kitchen").without_motions();
        let project = project.open().unwrap().into_session(&mut Discard).unwrap();
        let all = Declarations::of_project(&project);
        let sources = project.sources(motet_syntax::Source::new("", ""));
        for (space, name, kind, file) in [
            (NameSpace::Callable, "pick", DeclarationKind::Action, "stdlib/manipulation.motet"),
            (NameSpace::Callable, "detect", DeclarationKind::Perception, "stdlib/perception.motet"),
            (NameSpace::Relation, "holding", DeclarationKind::Fluent, "stdlib/world.motet"),
            (NameSpace::Value, "mug_1", DeclarationKind::Entity, "kitchen.json"),
        ] {
            let found = all.get(space, name).unwrap_or_else(|| panic!("{name}"));
            let source = sources.get(found.span.file).unwrap();
            assert_eq!((found.kind, source.slice(found.span), &*source.name), (kind, name, file));
        }
        assert!(all.get(NameSpace::Robot, "hsr").is_some());
        assert!(all.get(NameSpace::Value, "pick").is_none());
    }
}
