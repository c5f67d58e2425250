//! What a policy can be made of, as plain data: the callables, fluents, measures and fields of a library and the entities
//! of a world, with their types. What is generated for language models is generated from this, so it offers exactly what
//! the stages take. Made once from a library and a world, then only read.

use motet_syntax::Severity;
use motet_syntax::Syntax;
use motet_syntax::ast::{Expr, Policy};
use motet_syntax::unit::Dimension;
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use crate::ir::{Base, Kind, Ty};
use crate::library::Library;
use crate::world::World;

/// The declarations and entities in force.
#[derive(Clone, Debug, Default)]
pub struct Signatures {
    /// The robot's name; empty without one.
    pub robot: SmolStr,
    /// The kinds of entities; the first is the root `Entity`.
    pub kinds: Vec<KindSignature>,
    /// The enumerations, those of the robot's card among them.
    pub enums: Vec<EnumSignature>,
    /// What a step may call: the primitives that the robot provides, then the policies that it can carry out.
    pub callables: Vec<Callable>,
    /// The fluents.
    pub fluents: Vec<FluentSignature>,
    /// The measures.
    pub measures: Vec<MeasureSignature>,
    /// The fields of entities.
    pub fields: Vec<FieldSignature>,
    /// The kinds of failure, `timeout` among them.
    pub failures: Vec<SmolStr>,
    /// The entities of the world, in its order, with the indices of their kinds.
    pub entities: Vec<(SmolStr, usize)>,
}

/// A type.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Type {
    /// `Bool`
    Bool,
    /// `Int`
    Int,
    /// `Number`
    Number,
    /// `Length`, `Ratio`, …
    Quantity(Dimension),
    /// `Text`
    Text,
    /// `Pose`
    Pose,
    /// An entity of the kind with this index, or of one below it.
    Entity(usize),
    /// A case of the enumeration with this index.
    Enum(usize),
    /// A list.
    List(Box<Type>),
}

/// A kind of entities.
#[derive(Clone, Debug)]
pub struct KindSignature {
    /// Its name.
    pub name: SmolStr,
    /// The index of its parent; only the root has none.
    pub parent: Option<usize>,
}

/// An enumeration.
#[derive(Clone, Debug)]
pub struct EnumSignature {
    /// Its name.
    pub name: SmolStr,
    /// Its cases, in order.
    pub cases: Vec<SmolStr>,
}

/// What a step may call.
#[derive(Clone, Debug)]
pub struct Callable {
    /// Its name.
    pub name: SmolStr,
    /// Its parameters, in order.
    pub params: Vec<ParamSignature>,
    /// What it binds.
    pub result: Option<Type>,
    /// Whether it is a policy, which takes neither a deadline nor retries.
    pub is_policy: bool,
}

/// A parameter of a callable.
#[derive(Clone, Debug)]
pub struct ParamSignature {
    /// Its name.
    pub name: SmolStr,
    /// Its type.
    pub ty: Type,
    /// What stands in for a missing argument, as written.
    pub default: Option<Expr>,
    /// Least and greatest value, from the robot's card, in SI units.
    pub range: Option<(f64, f64)>,
}

/// A fluent.
#[derive(Clone, Debug)]
pub struct FluentSignature {
    /// Its name.
    pub name: SmolStr,
    /// Its parameters, in order.
    pub params: Vec<(SmolStr, Type)>,
    /// Whether the robot can observe it, so that a step may ask for it.
    pub is_observable: bool,
}

/// A measure.
#[derive(Clone, Debug)]
pub struct MeasureSignature {
    /// Its name.
    pub name: SmolStr,
    /// Its parameters, in order.
    pub params: Vec<(SmolStr, Type)>,
    /// What it gives.
    pub result: Type,
    /// Whether the robot can observe it, so that a step may ask for it.
    pub is_observable: bool,
}

/// A field of the entities of a kind.
#[derive(Clone, Debug)]
pub struct FieldSignature {
    /// Its name.
    pub name: SmolStr,
    /// The kind that declares it.
    pub kind: usize,
    /// What it holds.
    pub ty: Type,
}

impl Signatures {
    /// The signatures of a library and a world. O(declarations × entities) for the policies, which are checked by
    /// themselves: one that the robot cannot carry out is left out.
    #[must_use]
    pub fn new(library: &Library, world: &World) -> Self {
        let mut signatures = Self {
            robot: library.robot.clone(),
            kinds: library
                .kinds
                .iter()
                .map(|def| KindSignature { name: def.name.clone(), parent: def.parent.map(Kind::index) })
                .collect(),
            enums: library
                .enums
                .iter()
                .map(|def| EnumSignature { name: def.name.clone(), cases: def.cases.clone() })
                .collect(),
            failures: library.failures.iter().map(|(name, _)| name.clone()).collect(),
            entities: world.entities().iter().map(|(_, name, kind)| (name.clone(), kind.index())).collect(),
            ..Self::default()
        };
        signatures.callables = primitives(library);
        let policies = library.policies.iter().filter(|policy| can_be_carried_out(policy, library, world));
        signatures.callables.extend(policies.filter_map(|policy| of_policy(policy, library)));
        observed(&mut signatures, library);
        signatures
    }

    /// Whether the kind with an index is another one or below it.
    #[must_use]
    pub fn is_kind(&self, kind: usize, ancestor: usize) -> bool {
        let mut at = Some(kind);
        while let Some(current) = at {
            if current == ancestor {
                return true;
            }
            at = self.kinds.get(current).and_then(|def| def.parent);
        }
        false
    }

    /// Whether a value of type `actual` may stand where `expected` is asked for.
    #[must_use]
    pub fn fits(&self, expected: &Type, actual: &Type) -> bool {
        match (expected, actual) {
            (Type::Entity(parent), Type::Entity(kind)) => self.is_kind(*kind, *parent),
            (Type::List(expected), Type::List(actual)) => self.fits(expected, actual),
            (Type::Number, Type::Int) => true,
            _ => expected == actual,
        }
    }

    /// The entities of a kind and of those below it, in the order of the world. O(entities).
    pub fn entities_of(&self, kind: usize) -> impl Iterator<Item = &SmolStr> {
        self.entities.iter().filter(move |(_, of)| self.is_kind(*of, kind)).map(|(name, _)| name)
    }

    /// The types that a name of a policy can have: what callables give, the elements of lists of that, and the kinds of the
    /// entities that a loop can list.
    #[must_use]
    pub fn bindable(&self) -> Vec<Type> {
        let mut found: Vec<Type> = Vec::new();
        for callable in &self.callables {
            let mut ty = callable.result.clone();
            while let Some(next) = ty {
                ty = match &next {
                    Type::List(element) => Some((**element).clone()),
                    _ => None,
                };
                if !found.contains(&next) {
                    found.push(next);
                }
            }
        }
        for kind in (0..self.kinds.len()).filter(|kind| self.entities.iter().any(|(_, of)| of == kind)) {
            let ty = Type::Entity(kind);
            if !found.contains(&ty) {
                found.push(ty);
            }
        }
        found
    }

    /// The callable with a name.
    #[must_use]
    pub fn callable(&self, name: &str) -> Option<&Callable> {
        self.callables.iter().find(|callable| callable.name == name)
    }

    /// The fluent with a name.
    #[must_use]
    pub fn fluent(&self, name: &str) -> Option<&FluentSignature> {
        self.fluents.iter().find(|fluent| fluent.name == name)
    }

    /// The measure with a name.
    #[must_use]
    pub fn measure(&self, name: &str) -> Option<&MeasureSignature> {
        self.measures.iter().find(|measure| measure.name == name)
    }

    /// The name of a type as the language writes it.
    #[must_use]
    pub fn type_name(&self, ty: &Type) -> String {
        match ty {
            Type::Bool => "Bool".into(),
            Type::Int => "Int".into(),
            Type::Number => "Number".into(),
            Type::Quantity(dimension) => dimension.type_name().unwrap_or("Number").into(),
            Type::Text => "Text".into(),
            Type::Pose => "Pose".into(),
            Type::Entity(kind) => self.kinds.get(*kind).map_or("Entity", |kind| kind.name.as_str()).into(),
            Type::Enum(id) => self.enums.get(*id).map_or("Text", |id| id.name.as_str()).into(),
            Type::List(element) => format!("List<{}>", self.type_name(element)),
        }
    }
}

/// A type; none where an error has left it unknown.
fn of_type(ty: Ty) -> Option<Type> {
    let base = match ty.base {
        Base::Bool => Type::Bool,
        Base::Int => Type::Int,
        Base::Number => Type::Number,
        Base::Quantity(dimension) => Type::Quantity(dimension),
        Base::Text => Type::Text,
        Base::Pose => Type::Pose,
        Base::Entity(kind) => Type::Entity(kind.index()),
        Base::Enum(id) => Type::Enum(id.index()),
        Base::Unknown => return None,
    };
    Some((0..ty.lists).fold(base, |inner, _| Type::List(Box::new(inner))))
}

fn of_params(params: &[(SmolStr, Ty)]) -> Option<Vec<(SmolStr, Type)>> {
    params.iter().map(|(name, ty)| Some((name.clone(), of_type(*ty)?))).collect()
}

fn primitives(library: &Library) -> Vec<Callable> {
    let provided = library.primitives.iter().filter(|def| def.provided);
    let signature = |def: &crate::library::PrimitiveDef| {
        let written: FxHashMap<&str, &Expr> = def
            .source
            .params
            .iter()
            .filter_map(|param| Some((param.name.text.as_str(), param.default.as_ref()?)))
            .collect();
        let params = def.params.iter().map(|param| {
            Some(ParamSignature {
                name: param.name.clone(),
                ty: of_type(param.ty)?,
                default: written.get(param.name.as_str()).map(|default| (*default).clone()),
                range: param.range,
            })
        });
        let result = match def.result {
            Some(ty) => Some(of_type(ty)?),
            None => None,
        };
        Some(Callable {
            name: def.name.clone(),
            params: params.collect::<Option<_>>()?,
            result,
            is_policy: false,
        })
    };
    provided.filter_map(signature).collect()
}

fn of_policy(policy: &Policy, library: &Library) -> Option<Callable> {
    let params = policy.params.iter().map(|param| {
        Some(ParamSignature {
            name: param.name.text.clone(),
            ty: of_type(library.written_type(&param.ty))?,
            default: param.default.clone(),
            range: None,
        })
    });
    let params = params.collect::<Option<_>>()?;
    Some(Callable { name: policy.name.text.clone(), params, result: None, is_policy: true })
}

/// Whether nothing is wrong with a policy beside what its state decides.
fn can_be_carried_out(policy: &Policy, library: &Library, world: &World) -> bool {
    let (mut program, mut said) = crate::resolve::resolve(policy, Syntax::Text, library, world);
    said.extend(crate::check::check(&mut program, library, world, None));
    said.iter().all(|said| said.severity != Severity::Error)
}

fn observed(signatures: &mut Signatures, library: &Library) {
    signatures.fluents = library
        .fluents
        .iter()
        .filter_map(|def| {
            let (name, params) = (def.name.clone(), of_params(&def.params)?);
            Some(FluentSignature { name, params, is_observable: def.observable })
        })
        .collect();
    signatures.measures = library
        .measures
        .iter()
        .filter_map(|def| {
            let (name, params, result) = (def.name.clone(), of_params(&def.params)?, of_type(def.result)?);
            Some(MeasureSignature { name, params, result, is_observable: def.observable })
        })
        .collect();
    for (kind, def) in library.kinds.iter().enumerate() {
        let fields = def
            .fields
            .iter()
            .filter_map(|(name, ty)| Some(FieldSignature { name: name.clone(), kind, ty: of_type(*ty)? }));
        signatures.fields.extend(fields);
    }
}
