//! The names of a library for behaviour trees ([`motet_btcpp`]), which know no types.

use motet_btcpp::{NodeSignature, PortType, Vocabulary};
use motet_syntax::Parsed;
use smol_str::SmolStr;

use crate::session::Session;
use crate::signature::{Signatures, Type};

impl Session {
    /// Names that a behaviour tree may use beside the declarations of a document. O(declarations × entities).
    #[must_use]
    pub fn tree_vocabulary(&self, parsed: &Parsed) -> Vocabulary {
        let mut vocabulary = Vocabulary::default();
        self.within(parsed, &mut Vec::new(), |library, environment, _| {
            vocabulary = of(&Signatures::new(library, environment));
        });
        vocabulary
    }
}

fn of(signatures: &Signatures) -> Vocabulary {
    let actions = signatures.callables.iter().map(|callable| {
        let params = callable.params.iter().map(|param| (param.name.clone(), port(&param.ty)));
        let result = callable.result.as_ref().map(port);
        (callable.name.clone(), NodeSignature { params: params.collect(), result })
    });
    let fluents = signatures
        .fluents
        .iter()
        .map(|fluent| (fluent.name.clone(), NodeSignature { params: ports(&fluent.params), result: None }));
    let measures = signatures.measures.iter().map(|measure| {
        let result = Some(port(&measure.result));
        (measure.name.clone(), NodeSignature { params: ports(&measure.params), result })
    });
    Vocabulary {
        actions: actions.collect(),
        fluents: fluents.collect(),
        measures: measures.collect(),
        entities: signatures.entities.iter().map(|(name, _)| name.clone()).collect(),
    }
}

fn ports(params: &[(SmolStr, Type)]) -> Vec<(SmolStr, PortType)> {
    params.iter().map(|(name, ty)| (name.clone(), port(ty))).collect()
}

fn port(ty: &Type) -> PortType {
    match ty {
        Type::Bool => PortType::Bool,
        Type::Int | Type::Number | Type::Quantity(_) => PortType::Number,
        Type::Pose => PortType::Pose,
        Type::Text | Type::Failure | Type::Entity(_) | Type::Enum(_) => PortType::Text,
        Type::List(inner) => PortType::List(Box::new(port(inner))),
    }
}
