//! Signatures as the leaves of behaviour trees.

use motet_btcpp::{ActionLeaf, Leaves, PortType};
use smol_str::SmolStr;

use crate::signature::{Signatures, Type};

impl Signatures {
    /// Leaves of behaviour trees: the primitives, and the fluents, measures and fields that a step may test.
    #[must_use]
    pub fn leaves(&self) -> Leaves {
        let ports = |params: &[(SmolStr, Type)]| {
            params.iter().map(|(name, ty)| (name.clone(), port_type(ty))).collect()
        };
        let primitives = self.callables.iter().filter(|callable| !callable.is_policy);
        Leaves {
            robot: self.robot.clone(),
            actions: primitives
                .map(|callable| ActionLeaf {
                    name: callable.name.clone(),
                    ports: callable
                        .params
                        .iter()
                        .map(|param| (param.name.clone(), port_type(&param.ty)))
                        .collect(),
                    has_result: callable.result.is_some(),
                })
                .collect(),
            fluents: self.fluents.iter().map(|fluent| (fluent.name.clone(), ports(&fluent.params))).collect(),
            measures: self
                .measures
                .iter()
                .map(|measure| (measure.name.clone(), ports(&measure.params), port_type(&measure.result)))
                .collect(),
            fields: self.fields.iter().map(|field| (field.name.clone(), port_type(&field.ty))).collect(),
        }
    }
}

fn port_type(ty: &Type) -> PortType {
    match ty {
        Type::Bool => PortType::Bool,
        Type::Int | Type::Number => PortType::Number,
        Type::Quantity(dimension) => PortType::Quantity(*dimension),
        Type::Text | Type::Failure => PortType::Text,
        Type::Entity(_) | Type::Enum(_) => PortType::Name,
        Type::Pose => PortType::Pose,
        Type::List(inner) => PortType::List(Box::new(port_type(inner))),
    }
}
