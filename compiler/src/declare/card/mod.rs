//! Contribution of a robot's card to the library: resources, the enumerations of hands and cameras, numbers.

pub(super) mod check;
pub(in crate::declare) mod errors;

use motet_robots::card::Robot;
use motet_stdlib::lang;
use motet_syntax::unit::Dimension;
use smol_str::SmolStr;

use crate::declare::library::{EnumDef, Library, ResourceDef, ResourceSet};
use crate::ir::{Base, EnumId, Ty};

/// Maximal number of resources of one robot.
pub const MAX_RESOURCES: usize = 64;

/// Resources of an unknown robot.
const GENERIC: &[&str] = &["base", "arm", "hand", "camera", "voice"];

pub(in crate::declare) fn apply(library: &mut Library, robot: Option<&Robot>) {
    let (hands, cameras) = match robot {
        Some(robot) => {
            library.robot = robot.name.clone();
            library.observe_within_secs = robot.observe_within_secs;
            resources(library, robot);
            numbers(library, robot);
            (robot.hands.keys().cloned().collect(), robot.cameras.keys().cloned().collect())
        }
        None => {
            library.observe_within_secs = 2.0;
            let bit = |index: usize| 1u64 << index;
            let generic = GENERIC.iter().enumerate();
            library.resources = generic
                .map(|(index, name)| ResourceDef { name: (*name).into(), closure: bit(index) })
                .collect();
            (vec![SmolStr::new_static("hand")], vec![SmolStr::new_static("camera")])
        }
    };
    let all = library.resources.iter().map(|def| def.name.clone()).collect();
    for (name, cases) in [
        (lang::card_enums::HAND, hands),
        (lang::card_enums::CAMERA, cameras),
        (lang::card_enums::RESOURCE, all),
    ] {
        let cases: Vec<SmolStr> = cases;
        let id = EnumId(u16::try_from(library.enums.len()).unwrap_or(u16::MAX));
        for (index, case) in cases.iter().enumerate() {
            let place = (id, u16::try_from(index).unwrap_or(u16::MAX));
            library.names.cases.entry(case.clone()).or_insert(place);
        }
        library.names.enums.insert(name.into(), id);
        library.enums.push(EnumDef { name: name.into(), cases });
    }
    // Contracts say `hand` and `camera` whatever a robot calls its first.
    for (word, name) in [("hand", lang::card_enums::HAND), ("camera", lang::card_enums::CAMERA)] {
        let Some(id) = library.names.enums.get(name).copied() else { continue };
        if library.enums.get(id.index()).is_some_and(|def| !def.cases.is_empty()) {
            library.names.cases.entry(word.into()).or_insert((id, 0));
        }
    }
}

fn resources(library: &mut Library, robot: &Robot) {
    let position = |name: &SmolStr| robot.resources.get_index_of(name).filter(|index| *index < MAX_RESOURCES);
    let mut closures: Vec<ResourceSet> =
        (0..robot.resources.len().min(MAX_RESOURCES)).map(|index| 1 << index).collect();
    // A card has no cycle, so as many rounds as there are resources reach the closure.
    for _ in 0..closures.len() {
        for (index, contained) in robot.resources.values().enumerate().take(MAX_RESOURCES) {
            let inner = contained.iter().filter_map(position).filter_map(|at| closures.get(at).copied());
            let inner = inner.fold(0, |set, closure| set | closure);
            if let Some(closure) = closures.get_mut(index) {
                *closure |= inner;
            }
        }
    }
    let names = robot.resources.keys().cloned();
    library.resources = names.zip(closures).map(|(name, closure)| ResourceDef { name, closure }).collect();
}

fn numbers(library: &mut Library, robot: &Robot) {
    if let Some(hand) = robot.hands.values().next() {
        for (name, value, dimension) in [
            ("payload", hand.payload_kg, Dimension::MASS),
            ("opening", hand.opening_m, Dimension::LENGTH),
            ("reach", hand.reach_m, Dimension::LENGTH),
        ] {
            library.numbers.insert(name.into(), (value, Ty::plain(Base::Quantity(dimension))));
        }
    }
    for (name, (value, ty)) in &robot.numbers {
        let base = Dimension::of_type(ty).map_or(Base::Number, Base::Quantity);
        library.numbers.insert(name.clone(), (*value, Ty::plain(base)));
    }
}
