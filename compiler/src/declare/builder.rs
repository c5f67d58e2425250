//! Builds a [`Library`] from layers of declarations: kinds, enumerations, fluents and measures first, then
//! the contracts that use them.

use std::sync::Arc;

use indexmap::IndexMap;
use motet_robots::card::Robot;
use motet_stdlib::lang;
use motet_syntax::ast::{
    EntitiesDecl, EnumDecl, FailureDecl, File, FluentDecl, InitiallyDecl, Item, KindDecl, MAX_MISTAKES,
    MeasureDecl, Name, Param, Policy, PrimitiveDecl, TypeExpr,
};
use motet_syntax::{Diagnostic, Source, Sources, Span, Syntax};
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use super::contract;
use super::diagnostics::{BadDeclaration, Duplicate, FluentParameter, LimitExceeded, UnknownType};
use super::elaborator::Elaborator;
use super::library::{EnumDef, FailureDef, FluentDef, KindDef, LangItems, Library, MeasureDef};
use super::name::near;
use crate::ir::{Base, Entities, Entity, EnumId, Failure, Fluent, Kind, MAX_ENTITIES, Measure, Ty};

/// Maximal number of parameters of a fluent.
pub const MAX_FLUENT_PARAMS: usize = 4;
/// Maximal number of declarations of one sort.
pub const MAX_DECLARATIONS: usize = 10_000;
/// Maximal number of facts at the start.
pub(crate) const MAX_INITIALLY: usize = 50_000;
/// Maximal number of them that are about `any`: each crosses others.
pub(crate) const MAX_PATTERNS: usize = 1000;

/// Layers of declarations with the files they come from; larger libraries are built on top of them.
#[derive(Clone, Debug)]
pub struct LibraryBuilder {
    declarations: Declarations,
    robot: Option<Robot>,
    diagnostics: Vec<Diagnostic>,
}

impl Library {
    /// Reads the standard library, and the robot's declarations if there is a robot. Adds their files to
    /// `sources`.
    #[must_use]
    pub fn builder(robot: Option<&Robot>, sources: &mut Sources) -> LibraryBuilder {
        let mut builder = LibraryBuilder {
            declarations: Declarations::default(),
            robot: robot.cloned(),
            diagnostics: Vec::new(),
        };
        let standard: Vec<_> = motet_stdlib::FILES
            .iter()
            .map(|(name, text)| builder.read(Source::new(*name, *text), sources))
            .collect();
        builder.layer(&standard);
        if let Some(robot) = robot.filter(|robot| !robot.declarations.is_empty()) {
            let name = robot.spans.declarations.as_str();
            let file = builder.read(Source::new(name, robot.declarations.as_str()), sources);
            builder.layer(&[file]);
        }
        builder.declarations.close_robot();
        builder
    }
}

impl LibraryBuilder {
    fn read(&mut self, source: Source, sources: &mut Sources) -> File {
        let id = sources.add(source.clone());
        let parsed = motet_syntax::read(&source, id);
        self.diagnostics.extend(parsed.diagnostics);
        parsed.file
    }

    /// Adds a layer, such as a domain or the declarations of a document.
    pub fn layer(&mut self, files: &[File]) {
        self.declarations.add(files, &mut self.diagnostics);
    }

    /// Builds the library of all layers, and returns it with the diagnostics about them.
    #[must_use]
    pub fn build(self) -> (Library, Vec<Diagnostic>) {
        let Self { declarations, robot, mut diagnostics } = self;
        let mut library = Library { closed_world: declarations.closed_world, ..Library::default() };
        library.names.cases = FxHashMap::default();
        kinds(&mut library, &declarations, &mut diagnostics);
        super::card::apply(&mut library, robot.as_ref());
        enums(&mut library, &declarations, &mut diagnostics);
        failures(&mut library, &declarations, &mut diagnostics);
        library.add_failure_kinds();
        fields(&mut library, &declarations, &mut diagnostics);
        fluents(&mut library, &declarations, robot.as_ref(), &mut diagnostics);
        measures(&mut library, &declarations, robot.as_ref(), &mut diagnostics);
        library.lang_items = LangItems::of(&library.names);
        let entities = entities(&mut library, &declarations, &mut diagnostics);
        contract::primitives(&mut library, &declarations, robot.as_ref(), &entities, &mut diagnostics);
        for (index, (name, policy)) in declarations.policies.iter().enumerate() {
            if limit(index, "policies", policy.item.span, &mut diagnostics) {
                break;
            }
            library.names.policies.insert(name.clone(), index);
            library.policies.push(policy.item.clone());
        }
        contract::initially(&mut library, &declarations, robot.as_ref(), &entities, &mut diagnostics);
        if let Some(robot) = &robot {
            diagnostics.extend(super::card::check(&library, &declarations, robot));
        }
        (library, diagnostics)
    }
}

/// Elaborator for declarations: no bindings and no scene.
pub(super) fn elaborator<'a>(library: &'a Library, entities: &'a Entities) -> Elaborator<'a> {
    Elaborator::new(library, entities, true, Syntax::Text)
}

fn index<T>(table: &[T]) -> u16 {
    u16::try_from(table.len()).unwrap_or(u16::MAX)
}

pub(super) fn limit(
    len: usize,
    what: &'static str,
    span: motet_syntax::Span,
    diagnostics: &mut Vec<Diagnostic>,
) -> bool {
    if len == MAX_DECLARATIONS {
        diagnostics.push(LimitExceeded { span, what, limit: MAX_DECLARATIONS }.into());
    }
    len >= MAX_DECLARATIONS
}

/// Adds the kinds, parents before children. A kind without a valid parent becomes a child of the root
/// `Entity`.
fn kinds(library: &mut Library, declarations: &Declarations, diagnostics: &mut Vec<Diagnostic>) {
    let root = SmolStr::new_static(lang::kinds::ENTITY);
    library.names.kinds.insert(root.clone(), Kind::ROOT);
    library.kinds.push(KindDef { name: root.clone(), parent: None, fields: Default::default() });
    let mut waiting: Vec<_> =
        declarations.kinds.values().filter(|decl| decl.item.name.text != root).collect();
    while !waiting.is_empty() {
        let before = waiting.len();
        waiting.retain(|decl| {
            let decl = &decl.item;
            let parent = match &decl.parent {
                None => Some(Kind::ROOT),
                Some(parent) => library.names.kinds.get(&parent.text).copied(),
            };
            let Some(parent) = parent else { return true };
            if limit(library.kinds.len(), "kinds", decl.span, diagnostics) {
                return false;
            }
            library.names.kinds.insert(decl.name.text.clone(), Kind(index(&library.kinds)));
            let name = decl.name.text.clone();
            let fields = Default::default();
            library.kinds.push(KindDef { name, parent: Some(parent), fields });
            false
        });
        if waiting.len() == before {
            break;
        }
    }
    for decl in waiting {
        if diagnostics.len() > MAX_MISTAKES {
            return;
        }
        let decl = &decl.item;
        let Some(parent) = &decl.parent else { continue };
        if declarations.kinds.contains_key(&parent.text) {
            let what = format!("the kind `{}` is its own ancestor", decl.name.text);
            let remedy = "choose a parent that does not descend from it".to_owned();
            diagnostics.push(BadDeclaration { span: parent.span, what, remedy }.into());
        } else {
            let known = declarations.kinds.keys().map(SmolStr::as_str);
            let near = near(&parent.text, known.take(candidates(diagnostics)));
            diagnostics.push(UnknownType { span: parent.span, name: parent.text.clone(), near }.into());
        }
        library.names.kinds.insert(decl.name.text.clone(), Kind(index(&library.kinds)));
        let (name, fields) = (decl.name.text.clone(), Default::default());
        library.kinds.push(KindDef { name, parent: Some(Kind::ROOT), fields });
    }
}

/// Number of names among which the nearest one is looked for: fewer once there are many mistakes.
fn candidates(diagnostics: &[Diagnostic]) -> usize {
    if diagnostics.len() < MAX_MISTAKES / 20 { MAX_DECLARATIONS } else { MAX_DECLARATIONS / 100 }
}

fn fields(library: &mut Library, declarations: &Declarations, diagnostics: &mut Vec<Diagnostic>) {
    for decl in declarations.kinds.values() {
        let Some(kind) = library.names.kinds.get(&decl.item.name.text).copied() else { continue };
        let params = params(library, &decl.item.fields, diagnostics);
        if let Some(def) = library.kinds.get_mut(kind.index()) {
            def.fields = params.into_iter().collect();
        }
    }
}

fn enums(library: &mut Library, declarations: &Declarations, diagnostics: &mut Vec<Diagnostic>) {
    for (name, decl) in &declarations.enums {
        if limit(library.enums.len(), "enumerations", decl.item.span, diagnostics) {
            return;
        }
        if limit(decl.item.cases.len().min(MAX_DECLARATIONS), "cases", decl.item.span, diagnostics) {
            continue;
        }
        let id = EnumId(index(&library.enums));
        let mut cases: Vec<SmolStr> = Vec::with_capacity(decl.item.cases.len());
        for case in &decl.item.cases {
            if cases.contains(&case.text) {
                let (name, what, first) = (case.text.clone(), "case", decl.item.name.span);
                diagnostics.push(Duplicate { span: case.span, name, what, first }.into());
            } else {
                library.names.cases.entry(case.text.clone()).or_insert((id, index(&cases)));
                cases.push(case.text.clone());
            }
        }
        library.names.enums.insert(name.clone(), id);
        library.enums.push(EnumDef { name: name.clone(), cases });
    }
}

fn failures(library: &mut Library, declarations: &Declarations, diagnostics: &mut Vec<Diagnostic>) {
    let always = [lang::builtin_failures::TIMEOUT, lang::failures::FAILED, lang::failures::EXHAUSTED]
        .map(SmolStr::new_static);
    for name in always.into_iter().chain(declarations.failures.keys().cloned()) {
        if library.names.failures.contains_key(&name) {
            continue;
        }
        let decl = declarations.failures.get(&name);
        let span = decl.map_or_else(Span::default, |decl| decl.item.name.span);
        if limit(library.failures.len(), "failures", span, diagnostics) {
            return;
        }
        let doc = decl.map_or("", |decl| decl.item.doc.as_str());
        let doc = if name == lang::builtin_failures::TIMEOUT { lang::TIMEOUT_DOC } else { doc };
        library.names.failures.insert(name.clone(), Failure(index(&library.failures)));
        library.failures.push(FailureDef { text: clause(&name, doc), name });
    }
}

/// The first sentence of a documentation as a clause: without its full stop, and in lower case. Without
/// documentation it is the name in words.
fn clause(name: &str, doc: &str) -> SmolStr {
    let line = doc.lines().next().unwrap_or_default();
    let sentence = line.split_once(". ").map_or(line, |(first, _)| first).trim_end_matches('.').trim();
    let mut letters = sentence.chars();
    match (letters.next(), letters.next()) {
        (None, _) => name.replace('_', " ").into(),
        // A word in capitals stays one.
        (Some(_), Some(second)) if second.is_uppercase() => sentence.into(),
        (Some(first), _) => first.to_lowercase().chain(sentence.chars().skip(1)).collect::<String>().into(),
    }
}

fn fluents(
    library: &mut Library,
    declarations: &Declarations,
    robot: Option<&Robot>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for (name, decl) in &declarations.fluents {
        let decl = &decl.item;
        if diagnostics.len() > MAX_MISTAKES {
            return;
        }
        let params = params(library, &decl.params, diagnostics);
        for ((_, ty), param) in params.iter().zip(&decl.params) {
            let about = matches!(ty, Ty { base: Base::Entity(_) | Base::Enum(_) | Base::Unknown, lists: 0 });
            if !about {
                let (name, ty) = (param.name.text.clone(), format!("a {}", library.type_name(*ty)));
                diagnostics.push(FluentParameter { span: param.ty.span(), name, ty }.into());
            }
        }
        if params.len() > MAX_FLUENT_PARAMS {
            let what = "parameters of a fluent";
            diagnostics.push(LimitExceeded { span: decl.span, what, limit: MAX_FLUENT_PARAMS }.into());
            continue;
        }
        if limit(library.fluents.len(), "fluents", decl.span, diagnostics) {
            return;
        }
        library.names.fluents.insert(name.clone(), Fluent(index(&library.fluents)));
        let derived = name == lang::fluents::REACHABLE;
        let observable = derived || robot.is_none_or(|robot| robot.observes.contains(name));
        library.fluents.push(FluentDef { name: name.clone(), params, derived, observable });
    }
}

fn measures(
    library: &mut Library,
    declarations: &Declarations,
    robot: Option<&Robot>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for (name, decl) in &declarations.measures {
        let decl = &decl.item;
        if diagnostics.len() > MAX_MISTAKES {
            return;
        }
        let params = params(library, &decl.params, diagnostics);
        let result = named_type(library, &decl.result, diagnostics);
        if limit(library.measures.len(), "measures", decl.span, diagnostics) {
            return;
        }
        library.names.measures.insert(name.clone(), Measure(index(&library.measures)));
        let observable = robot.is_none_or(|robot| robot.observes.contains(name));
        library.measures.push(MeasureDef { name: name.clone(), params, result, observable });
    }
}

/// Entities of the declarations, after `robot`, `user` and `start`.
fn entities(
    library: &mut Library,
    declarations: &Declarations,
    diagnostics: &mut Vec<Diagnostic>,
) -> Entities {
    let mut entities = Entities::default();
    for (name, kind) in library.standard_entities() {
        entities.add(name.into(), kind);
    }
    for decl in &declarations.entities {
        if diagnostics.len() > MAX_MISTAKES {
            break;
        }
        let kind = match library.names.kinds.get(&decl.kind.text) {
            Some(kind) => *kind,
            None => {
                let known = library.kinds.iter().map(|def| def.name.as_str());
                let near = near(&decl.kind.text, known.take(candidates(diagnostics)));
                diagnostics
                    .push(UnknownType { span: decl.kind.span, name: decl.kind.text.clone(), near }.into());
                Kind::ROOT
            }
        };
        for name in &decl.names {
            if diagnostics.len() > MAX_MISTAKES {
                break;
            }
            if entities.len() >= MAX_ENTITIES {
                diagnostics
                    .push(LimitExceeded { span: name.span, what: "entities", limit: MAX_ENTITIES }.into());
                break;
            }
            if entities.add(name.text.clone(), kind).is_none() {
                let known = library.entities.iter().find(|(known, ..)| *known == name.text);
                let first = known.map_or(decl.span, |(.., span)| *span);
                let name_text = name.text.clone();
                diagnostics
                    .push(Duplicate { span: name.span, name: name_text, what: "entity", first }.into());
                continue;
            }
            library.entities.push((name.text.clone(), kind, name.span));
        }
    }
    library.names.entities =
        entities.iter().map(|(id, name, _)| (name.clone(), id)).collect::<FxHashMap<SmolStr, Entity>>();
    entities
}

fn params(library: &Library, params: &[Param], diagnostics: &mut Vec<Diagnostic>) -> Vec<(SmolStr, Ty)> {
    let mut list: Vec<(SmolStr, Ty)> = Vec::with_capacity(params.len());
    for param in params {
        if list.iter().any(|(name, _)| *name == param.name.text) {
            let (span, name) = (param.name.span, param.name.text.clone());
            diagnostics.push(Duplicate { span, name, what: "parameter", first: span }.into());
        }
        list.push((param.name.text.clone(), named_type(library, &param.ty, diagnostics)));
    }
    list
}

fn named_type(library: &Library, ty: &TypeExpr, diagnostics: &mut Vec<Diagnostic>) -> Ty {
    let (ty, mistakes) = contract::type_of(library, ty);
    diagnostics.extend(mistakes);
    ty
}

/// Declaration with the number of its layer.
#[derive(Clone, Debug)]
pub(super) struct Layered<T> {
    pub(super) item: T,
    pub(super) layer: usize,
}

type Table<T> = IndexMap<SmolStr, Layered<Arc<T>>>;

/// Declarations of all layers, without those that were replaced.
#[derive(Clone, Debug, Default)]
pub(super) struct Declarations {
    pub(super) kinds: Table<KindDecl>,
    pub(super) fluents: Table<FluentDecl>,
    pub(super) measures: Table<MeasureDecl>,
    pub(super) failures: Table<FailureDecl>,
    pub(super) enums: Table<EnumDecl>,
    pub(super) primitives: Table<PrimitiveDecl>,
    pub(super) policies: Table<Policy>,
    pub(super) entities: Vec<Arc<EntitiesDecl>>,
    pub(super) initially: Vec<Arc<InitiallyDecl>>,
    pub(super) closed_world: bool,
    layers: usize,
    /// Number of the newest layer that belongs to the robot or lies below it.
    robot_top: usize,
}

impl Declarations {
    /// Adds a layer of files.
    pub(super) fn add(&mut self, files: &[File], diagnostics: &mut Vec<Diagnostic>) {
        let layer = self.layers;
        self.layers += 1;
        for item in files.iter().flat_map(|file| &file.items) {
            match item {
                Item::Kind(decl) => put(&mut self.kinds, "kind", &decl.name, decl, layer, diagnostics),
                Item::Fluent(decl) => put(&mut self.fluents, "fluent", &decl.name, decl, layer, diagnostics),
                Item::Measure(decl) => {
                    put(&mut self.measures, "measure", &decl.name, decl, layer, diagnostics)
                }
                Item::Failure(decl) => {
                    put(&mut self.failures, "failure", &decl.name, decl, layer, diagnostics)
                }
                Item::Enum(decl) => put(&mut self.enums, "enumeration", &decl.name, decl, layer, diagnostics),
                Item::Primitive(decl) => {
                    displace(&mut self.policies, &decl.name, layer, diagnostics);
                    put(&mut self.primitives, "primitive", &decl.name, decl, layer, diagnostics);
                }
                Item::Policy(decl) => {
                    displace(&mut self.primitives, &decl.name, layer, diagnostics);
                    put(&mut self.policies, "policy", &decl.name, decl, layer, diagnostics);
                }
                Item::Entities(decl) => self.entities.push(Arc::new(decl.clone())),
                Item::Initially(decl) => self.initially.push(Arc::new(decl.clone())),
                Item::ClosedWorld(_) => self.closed_world = true,
            }
        }
    }

    /// Marks the layers so far as the robot's own.
    pub(super) fn close_robot(&mut self) {
        self.robot_top = self.top();
    }

    /// Number of the newest layer that belongs to the robot or lies below it.
    pub(super) fn robot_top(&self) -> usize {
        self.robot_top
    }

    /// Number of the newest layer.
    pub(super) fn top(&self) -> usize {
        self.layers.saturating_sub(1)
    }
}

/// A declaration with a name.
trait Placed {
    fn name_span(&self) -> Span;
}

macro_rules! placed {
    ($($ty:ty),*) => {$(
        impl Placed for $ty {
            fn name_span(&self) -> Span {
                self.name.span
            }
        }
    )*};
}

placed!(KindDecl, FluentDecl, MeasureDecl, FailureDecl, EnumDecl, PrimitiveDecl, Policy);

/// Removes a declaration of another sort that is called by the same name. In one layer there are not two.
fn displace<T: Placed>(table: &mut Table<T>, name: &Name, layer: usize, diagnostics: &mut Vec<Diagnostic>) {
    let first = table.shift_remove(&name.text).filter(|first| first.layer == layer);
    if let Some(first) = first.filter(|_| diagnostics.len() <= MAX_MISTAKES) {
        let (what, first) = ("callable", first.item.name_span());
        diagnostics.push(Duplicate { span: name.span, name: name.text.clone(), what, first }.into());
    }
}

fn put<T: Clone + Placed>(
    table: &mut Table<T>,
    what: &'static str,
    name: &Name,
    decl: &T,
    layer: usize,
    diagnostics: &mut Vec<Diagnostic>,
) {
    if let Some(first) = table.get(&name.text).filter(|first| first.layer == layer) {
        let first = first.item.name_span();
        if diagnostics.len() > MAX_MISTAKES {
            return;
        }
        diagnostics.push(Duplicate { span: name.span, name: name.text.clone(), what, first }.into());
        return;
    }
    table.insert(name.text.clone(), Layered { item: Arc::new(decl.clone()), layer });
}
