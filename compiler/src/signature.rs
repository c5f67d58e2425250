//! Signatures: the callables, fluents, measures, fields and entities that a policy may use, as plain data.
//!
//! Grammars and prompts for language models derive from them, so they offer exactly what the stages accept.
//! Built once from a library and an environment, then only read.

use motet_stdlib::lang;
use motet_syntax::ast::{Expr, Policy};
use motet_syntax::unit::Dimension;
use motet_syntax::{Severity, Syntax};
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::{Base, Kind, Ty};

/// Declarations and entities in force.
#[derive(Clone, Debug, Default)]
pub struct Signatures {
    /// Name of the robot; empty without one.
    pub robot: SmolStr,
    /// Kinds of entities; the first is the root `Entity`.
    pub kinds: Vec<KindSignature>,
    /// Enumerations, with those of the robot's card.
    pub enums: Vec<EnumSignature>,
    /// Primitives that the robot provides, then policies that it can carry out.
    pub callables: Vec<Callable>,
    pub fluents: Vec<FluentSignature>,
    pub measures: Vec<MeasureSignature>,
    pub fields: Vec<FieldSignature>,
    /// Names of the failures, with `timeout`.
    pub failures: Vec<SmolStr>,
    /// Entities of the environment, in order, with the indices of their kinds.
    pub entities: Vec<(SmolStr, usize)>,
}

/// Type of a value.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Type {
    Bool,
    Int,
    Number,
    Quantity(Dimension),
    Text,
    Pose,
    /// A failure that a handler caught.
    Failure,
    /// Entity of the kind with this index, or of a descendant.
    Entity(usize),
    /// Case of the enumeration with this index.
    Enum(usize),
    List(Box<Type>),
}

/// Signature of a kind of entities.
#[derive(Clone, Debug)]
pub struct KindSignature {
    pub name: SmolStr,
    /// Index of the parent; `None` for the root.
    pub parent: Option<usize>,
}

/// Signature of an enumeration.
#[derive(Clone, Debug)]
pub struct EnumSignature {
    pub name: SmolStr,
    pub cases: Vec<SmolStr>,
}

/// Signature of a primitive or policy.
#[derive(Clone, Debug)]
pub struct Callable {
    pub name: SmolStr,
    pub params: Vec<ParamSignature>,
    /// Type of the result.
    pub result: Option<Type>,
    /// True for a policy, which takes neither a deadline nor retries.
    pub is_policy: bool,
    /// True for a primitive that moves the robot, and so has a manner.
    pub moves: bool,
}

/// Signature of a parameter.
#[derive(Clone, Debug)]
pub struct ParamSignature {
    pub name: SmolStr,
    pub ty: Type,
    /// Default argument, as written.
    pub default: Option<Expr>,
    /// Least and greatest value from the robot's card, in SI units.
    pub range: Option<(f64, f64)>,
}

/// Signature of a fluent.
#[derive(Clone, Debug)]
pub struct FluentSignature {
    pub name: SmolStr,
    pub params: Vec<(SmolStr, Type)>,
    /// True if the robot can observe the fluent, so that a step may test it.
    pub is_observable: bool,
}

/// Signature of a measure.
#[derive(Clone, Debug)]
pub struct MeasureSignature {
    pub name: SmolStr,
    pub params: Vec<(SmolStr, Type)>,
    pub result: Type,
    /// True if the robot can observe the measure, so that a step may test it.
    pub is_observable: bool,
}

/// Signature of a field of a kind.
#[derive(Clone, Debug)]
pub struct FieldSignature {
    pub name: SmolStr,
    /// Index of the kind that declares it.
    pub kind: usize,
    pub ty: Type,
}

impl Signatures {
    /// Collects the signatures of a library and an environment. O(declarations × entities), since each policy
    /// is checked alone: one that the robot cannot carry out is left out.
    #[must_use]
    pub fn new(library: &Library, environment: &Environment) -> Self {
        let mut signatures = Self {
            robot: library.robot.clone(),
            kinds: library
                .kinds
                .iter()
                .map(|def| KindSignature { name: def.name.clone(), parent: def.parent.map(Kind::index) })
                .collect(),
            enums: library
                .named_enums()
                .map(|def| EnumSignature { name: def.name.clone(), cases: def.cases.clone() })
                .collect(),
            failures: library.failures.iter().map(|def| def.name.clone()).collect(),
            entities: environment
                .entities()
                .iter()
                .map(|(_, name, kind)| (name.clone(), kind.index()))
                .collect(),
            ..Self::default()
        };
        signatures.callables = primitives(library);
        let policies =
            library.policies.iter().filter(|policy| can_be_carried_out(policy, library, environment));
        signatures.callables.extend(policies.filter_map(|policy| of_policy(policy, library)));
        observed(&mut signatures, library);
        signatures
    }

    /// Returns whether a kind is another one or a descendant of it.
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

    /// Returns whether a value of type `actual` is allowed where `expected` is.
    #[must_use]
    pub fn fits(&self, expected: &Type, actual: &Type) -> bool {
        match (expected, actual) {
            (Type::Entity(parent), Type::Entity(kind)) => self.is_kind(*kind, *parent),
            (Type::List(expected), Type::List(actual)) => self.fits(expected, actual),
            (Type::Number, Type::Int) => true,
            _ => expected == actual,
        }
    }

    /// Entities of a kind and its descendants, in order. O(entities).
    pub fn entities_of(&self, kind: usize) -> impl Iterator<Item = &SmolStr> {
        self.entities.iter().filter(move |(_, of)| self.is_kind(*of, kind)).map(|(name, _)| name)
    }

    /// Types that a name in a policy can have: results of callables, elements of lists of them, and kinds of
    /// entities in lists.
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

    /// Finds a callable by name. O(callables).
    #[must_use]
    pub fn callable(&self, name: &str) -> Option<&Callable> {
        self.callables.iter().find(|callable| callable.name == name)
    }

    /// Finds a fluent by name. O(fluents).
    #[must_use]
    pub fn fluent(&self, name: &str) -> Option<&FluentSignature> {
        self.fluents.iter().find(|fluent| fluent.name == name)
    }

    /// Finds a measure by name. O(measures).
    #[must_use]
    pub fn measure(&self, name: &str) -> Option<&MeasureSignature> {
        self.measures.iter().find(|measure| measure.name == name)
    }

    /// Spelling of a type in the language.
    #[must_use]
    pub fn type_name(&self, ty: &Type) -> String {
        match ty {
            Type::Bool => "Bool".into(),
            Type::Int => "Int".into(),
            Type::Number => "Number".into(),
            Type::Quantity(dimension) => dimension.type_name().unwrap_or("Number").into(),
            Type::Text => "Text".into(),
            Type::Pose => "Pose".into(),
            Type::Failure => "Failure".into(),
            Type::Entity(kind) => {
                self.kinds.get(*kind).map_or(lang::kinds::ENTITY, |kind| kind.name.as_str()).into()
            }
            Type::Enum(id) => self.enums.get(*id).map_or("Text", |id| id.name.as_str()).into(),
            Type::List(element) => format!("List<{}>", self.type_name(element)),
        }
    }
}

/// Type of a signature; `None` after an error.
pub(crate) fn of_type(ty: Ty) -> Option<Type> {
    let base = match ty.base {
        Base::Bool => Type::Bool,
        Base::Int => Type::Int,
        Base::Number => Type::Number,
        Base::Quantity(dimension) => Type::Quantity(dimension),
        Base::Text => Type::Text,
        Base::Pose => Type::Pose,
        Base::Failure => Type::Failure,
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
    let signature = |def: &crate::declare::PrimitiveDef| {
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
            moves: library.moves(def),
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
    Some(Callable { name: policy.name.text.clone(), params, result: None, is_policy: true, moves: false })
}

/// Returns whether a policy has no errors but those that depend on its state.
fn can_be_carried_out(policy: &Policy, library: &Library, environment: &Environment) -> bool {
    let (program, mut said) = crate::resolve::resolve(policy, Syntax::Text, library, environment);
    said.extend(crate::limits::check(program, library, environment, None).1);
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
