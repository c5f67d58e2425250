//! Whether a robot's card and the declarations fit: what it observes and provides is declared, its bounds are for
//! parameters that are there and in their unit, what holds at the start is a fact. Every finding stands in the card.

use motet_robots::card::{BoundSpan, Robot};
use motet_syntax::ast::Expr;
use motet_syntax::unit::Dimension;
use motet_syntax::{Diagnostic, Mistake, Span};
use smol_str::SmolStr;

use super::errors::{NotAtFirst, UnfitPrimitive, UnknownBound, UnknownObserved, UnknownProvided, WrongBound};
use super::layer::Declarations;
use super::model::Library;
use crate::ir::Base;
use crate::resolve::errors::UnknownResource;
use crate::resolve::near::{list, near};

/// What the card names that is not declared, and bounds that do not fit their parameter.
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

/// Where the card says that the robot provides a primitive.
fn place(robot: &Robot, primitive: &str) -> Span {
    robot.spans.primitives.get(primitive).copied().unwrap_or_default()
}

/// What is wrong with a primitive that the card provides and that a layer below the card declares. The declaration is
/// right for other robots, so it is the card that has to mend it. `is_alone` says that nothing lies above the card: what
/// lies above may replace what a contract speaks of, but never gives a robot a resource.
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

/// The facts that the card says hold at the start, each with its place, and what is no fact at all.
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

/// What is said of an entry under `initially` that is no fact: why, and what to write instead where that is known.
pub(super) fn not_at_first(text: &str, (why, mend): (String, Option<String>), span: Span) -> Diagnostic {
    NotAtFirst { span, text: text.to_owned(), why, mend }.into()
}
