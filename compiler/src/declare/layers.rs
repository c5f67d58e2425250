//! Layers of declarations: the standard library, then the robot's, then domains. A layer replaces the
//! declarations of lower layers that have the same name.

use std::sync::Arc;

use indexmap::IndexMap;
use motet_syntax::ast::{
    EntitiesDecl, EnumDecl, FailureDecl, File, FluentDecl, InitiallyDecl, Item, KindDecl,
};
use motet_syntax::ast::{MeasureDecl, Name, Policy, PrimitiveDecl};
use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use super::errors::Duplicate;

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
                    self.policies.shift_remove(&decl.name.text);
                    put(&mut self.primitives, "primitive", &decl.name, decl, layer, diagnostics);
                }
                Item::Policy(decl) => {
                    self.primitives.shift_remove(&decl.name.text);
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
        diagnostics.push(Duplicate { span: name.span, name: name.text.clone(), what, first }.into());
        return;
    }
    table.insert(name.text.clone(), Layered { item: Arc::new(decl.clone()), layer });
}
