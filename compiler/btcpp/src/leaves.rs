//! Leaves that a library gives: its primitives as actions, its fluents, measures and fields as conditions.

use motet_syntax::unit::Dimension;
use smol_str::SmolStr;

/// Leaves of a library and a robot.
#[derive(Clone, Debug, Default)]
pub struct Leaves {
    /// Name of the robot; empty without one.
    pub robot: SmolStr,
    pub actions: Vec<ActionLeaf>,
    /// Fluents with their parameters.
    pub fluents: Vec<(SmolStr, Ports)>,
    /// Measures with their parameters and the type of the reading.
    pub measures: Vec<(SmolStr, Ports, PortType)>,
    /// Fields of kinds with their types.
    pub fields: Vec<(SmolStr, PortType)>,
}

/// Input ports in the order of the declaration.
pub type Ports = Vec<(SmolStr, PortType)>;

/// Primitive as an action.
#[derive(Clone, Debug)]
pub struct ActionLeaf {
    pub name: SmolStr,
    pub ports: Ports,
    /// True for a primitive with a result.
    pub has_result: bool,
}

/// Type of a port, as far as the text of a value depends on it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum PortType {
    Bool,
    Number,
    Quantity(Dimension),
    Text,
    /// An entity or a case of an enumeration.
    Name,
    Pose,
    List(Box<PortType>),
}

impl Leaves {
    pub(crate) fn action(&self, name: &str) -> Option<&ActionLeaf> {
        self.actions.iter().find(|action| action.name == name)
    }

    pub(crate) fn fluent(&self, name: &str) -> Option<&Ports> {
        self.fluents.iter().find(|(known, _)| known == name).map(|(_, ports)| ports)
    }

    pub(crate) fn measure(&self, name: &str) -> Option<(&Ports, &PortType)> {
        self.measures.iter().find(|(known, ..)| known == name).map(|(_, ports, ty)| (ports, ty))
    }

    pub(crate) fn field(&self, name: &str) -> Option<&PortType> {
        self.fields.iter().find(|(known, _)| known == name).map(|(_, ty)| ty)
    }

    /// Names of all leaves.
    pub(crate) fn names(&self) -> Vec<String> {
        let actions = self.actions.iter().map(|action| action.name.to_string());
        let fluents = self.fluents.iter().map(|(name, _)| format!("{}{name}", crate::names::FLUENT));
        let measures = self.measures.iter().map(|(name, ..)| format!("{}{name}", crate::names::MEASURE));
        actions.chain(fluents).chain(measures).collect()
    }
}
