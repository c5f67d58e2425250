//! A robot's card in the library: resources, the enumerations of hands and cameras, numbers; and its check
//! against the declarations. What a card observes and provides must be declared, bounds must fit their
//! parameter, and facts at the start must be facts. All diagnostics point into the card.

use motet_robots::card::{BoundSpan, Robot};
use motet_robots::scene::ServingReach;
use motet_stdlib::lang;
use motet_syntax::ast::Expr;
use motet_syntax::unit::Dimension;
use motet_syntax::{Diagnostic, Mistake, Span};
use smol_str::SmolStr;

use super::builder::Declarations;
use super::diagnostics::{
    NotAtFirst, UnfitPrimitive, UnknownBound, UnknownObserved, UnknownProvided, UnknownResource, WrongBound,
};
use super::library::{EnumDef, Library, Manners, ResourceDef, ResourceSet};
use super::name::{list, near};
use crate::ir::{Base, EnumId, Ty};

/// Maximal number of resources of one robot.
pub const MAX_RESOURCES: usize = 64;

/// Resources of an unknown robot.
const GENERIC: &[&str] = &["base", "arm", "hand", "camera", "voice"];

pub(super) fn apply(library: &mut Library, robot: Option<&Robot>) {
    let (hands, cameras) = match robot {
        Some(robot) => {
            library.robot = robot.name.clone();
            library.observe_within_secs = robot.observe_within_secs;
            library.manners = Manners::of(&robot.manners);
            library.serving_reach = ServingReach::of(robot);
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

/// Reports names of the card that are not declared, and bounds that do not fit their parameter.
pub(super) fn check(library: &Library, declarations: &Declarations, robot: &Robot) -> Vec<Diagnostic> {
    let mut found = observes(library, robot);
    for (name, bounds) in &robot.primitives {
        let span = place(robot, name);
        let Some(decl) = declarations.primitives.get(name) else {
            let (is_policy, name) = (declarations.policies.contains_key(name), name.clone());
            let near = near(&name, declarations.primitives.keys().map(SmolStr::as_str));
            found.push(UnknownProvided { span, name, near, is_policy }.into());
            continue;
        };
        // A layer above the card's has parameters of its own, of which the card cannot know.
        if decl.layer > declarations.robot_top() {
            continue;
        }
        let params = &decl.item.params;
        for param in bounds.keys() {
            let key = (name.clone(), param.clone());
            let bound = robot.spans.bounds.get(&key).copied().unwrap_or(BoundSpan { span, dimension: None });
            let Some(known) = params.iter().find(|known| known.name.text == *param) else {
                let names = || params.iter().map(|param| &param.name.text);
                let near = near(param, names().map(SmolStr::as_str));
                let known = list(names().cloned());
                let (primitive, param) = (name.clone(), param.clone());
                found.push(UnknownBound { span: bound.span, primitive, param, near, known }.into());
                continue;
            };
            let ty = library.written_type(&known.ty);
            let wanted = match ty.base {
                Base::Unknown => continue,
                Base::Int | Base::Number => Some(Dimension::NONE),
                Base::Quantity(dimension) => Some(dimension),
                Base::Bool | Base::Text | Base::Pose | Base::Entity(_) | Base::Enum(_) => None,
                Base::Failure => None,
            }
            .filter(|_| ty.lists == 0);
            let fits = wanted.is_some_and(|wanted| bound.dimension.is_none_or(|found| found == wanted));
            if !fits {
                let (primitive, param) = (name.clone(), param.clone());
                let (ty, unit) = (library.type_name(ty), wanted.map(Dimension::si_symbol));
                found.push(WrongBound { span: bound.span, primitive, param, ty, unit }.into());
            }
        }
    }
    found
}

fn observes(library: &Library, robot: &Robot) -> Vec<Diagnostic> {
    let (fluents, measures) = (&library.names.fluents, &library.names.measures);
    let unknown = |name: &&SmolStr| !fluents.contains_key(*name) && !measures.contains_key(*name);
    let known = || {
        let fluents = library.fluents.iter().map(|def| def.name.as_str());
        fluents.chain(library.measures.iter().map(|def| def.name.as_str()))
    };
    let found = robot.observes.iter().filter(unknown).map(|name| {
        let span = robot.spans.observes.get(name).copied().unwrap_or_default();
        UnknownObserved { span, name: name.clone(), near: near(name, known()) }.into()
    });
    found.collect()
}

/// Span at which the card provides a primitive.
fn place(robot: &Robot, primitive: &str) -> Span {
    robot.spans.primitives.get(primitive).copied().unwrap_or_default()
}

/// Diagnostic for a provided primitive whose declaration, in a layer below the card, has mistakes on this
/// robot. The declaration is right for other robots, so the card has to change. `is_alone` is true if no
/// layer lies above the card: such a layer may replace names that the contract uses, but never adds a
/// resource.
pub(super) fn unfit(
    robot: &Robot,
    primitive: &SmolStr,
    mistakes: &[Diagnostic],
    is_alone: bool,
) -> Option<Diagnostic> {
    let is_resource = |said: &&Diagnostic| said.code == UnknownResource::CODE;
    let said = mistakes.iter().find(is_resource).or_else(|| mistakes.first().filter(|_| is_alone))?;
    let span = place(robot, primitive);
    let (why, at) = (said.message.clone(), said.span);
    Some(UnfitPrimitive { span, name: primitive.clone(), why, at }.into())
}

/// Parses the facts that the card states for the start, each with its span, and reports entries that are no
/// condition.
pub(super) fn facts<'r>(robot: &'r Robot, diagnostics: &mut Vec<Diagnostic>) -> Vec<(&'r str, Expr, Span)> {
    let spans = robot.spans.initially.iter().copied().chain(std::iter::repeat(Span::default()));
    let mut facts = Vec::new();
    for (text, span) in robot.initially.iter().zip(spans) {
        match motet_syntax::text::parse_condition(text) {
            Ok(fact) => facts.push((text.as_str(), fact, span)),
            Err(why) => diagnostics.push(not_at_first(text, (why, None), span)),
        }
    }
    facts
}

/// Diagnostic for an entry under `initially` that is no fact, with the reason and, where known, a correction.
pub(super) fn not_at_first(text: &str, (why, remedy): (String, Option<String>), span: Span) -> Diagnostic {
    NotAtFirst { span, text: text.to_owned(), why, remedy }.into()
}
