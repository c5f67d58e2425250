//! The parts of a prompt that depend on the robot and its library only: the form of a policy, every kind of
//! step, the conditions, the primitives, advice, and examples.

use std::fmt::Write as _;

use indexmap::IndexMap;
use motet_compiler::signature::{Callable, Signatures, Type};
use motet_compiler::{Session, make_explicit};
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_robots::scene::{Entity, Scene};
use motet_stdlib::lang::entities::ROBOT;
use motet_stdlib::lang::{kinds, primitives};
use motet_syntax::ast::{Arg, Block, Clause, ExprKind, PrimitiveDecl, Quantified, StepKind};
use motet_syntax::{FileId, Severity, Source, Syntax, print};
use smol_str::SmolStr;

use super::in_line;
use crate::builtin;

/// Kinds of steps, each line an example and its meaning.
const STEPS: &str = include_str!("../../prompt/language.txt");
/// Advice on planning.
const ADVICE: &str = include_str!("../../prompt/advice.txt");

/// Requests for a thing that the scene does not list, each with a policy, for scenes and robots of different
/// kinds, the most instructive first.
const EXAMPLES: [(&str, &str); 5] = [
    ("put the WHAT in the CONTAINER", include_str!("../../prompt/example.json")),
    ("put the WHAT in the CONTAINER", include_str!("../../prompt/example_with_postures.json")),
    ("bring me the WHAT", include_str!("../../prompt/example_to_person.json")),
    ("bring me the WHAT", include_str!("../../prompt/example_to_person_with_postures.json")),
    ("put the WHAT on the FIRST", include_str!("../../prompt/example_in_place.json")),
];

/// Descriptions for the example of a thing that the scene does not list.
const UNLISTED: [&str; 3] = ["blue cup", "tennis ball", "pink umbrella"];

/// The parts of a prompt that do not change.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StaticPrompt {
    /// Form of a policy, kinds of steps, conditions and advice.
    pub(super) rules: String,
    /// The robot's primitives with needs and failures.
    pub(super) contracts: String,
    /// The robot's primitives without needs and failures.
    pub(super) signatures: String,
    /// Example request with its policy; empty if the robot has none.
    pub(super) example: String,
}

impl StaticPrompt {
    /// Writes the parts. Only examples that pass the check are in them.
    #[must_use]
    pub fn new(session: &Session, robot: &Robot, scene: &Scene) -> Self {
        let bare = session.with_scene(Some(scene), None);
        let (steps, conditions) = (steps(&bare, robot, scene), conditions(&session.signatures()));
        Self {
            rules: format!("{}\n{steps}\n{conditions}\n{ADVICE}", form(robot)),
            contracts: primitives(session, Detail::Contracts),
            signatures: primitives(session, Detail::Signatures),
            example: searching_example(&bare, robot, scene)
                .or_else(|| planned_example(session, robot, scene))
                .unwrap_or_default(),
        }
    }
}

fn form(robot: &Robot) -> String {
    let name = &robot.name;
    format!(
        "You plan for a robot, {}. Answer with one policy and nothing else, as JSON:\n\
         {{\"motet\": 1, \"policy\": NAME, \"robot\": \"{name}\", \"steps\": [STEP, …]}}\n",
        in_line(&robot.title)
    )
}

/// The kinds of steps, without the examples that this robot cannot carry out. Only where the scene has a zone
/// is there something to keep out of.
fn steps(session: &Session, robot: &Robot, scene: &Scene) -> String {
    let zone = scene.entities.values().find(|entity| entity.kind == kinds::ZONE);
    let mut text = String::new();
    for line in STEPS.lines() {
        let example = line.split_once("  ").map_or(line, |(example, _)| example);
        if !example.starts_with('{') || is_step(session, robot, example) {
            text.push_str(line);
            if let Some(zone) = zone.filter(|_| example.starts_with("{\"keep\"")) {
                let _ = write!(text, "; or {{\"out_of\": \"{}\"}}", zone.id);
            }
            text.push('\n');
        }
    }
    text
}

/// Checks the syntax, names and types of a step behind two that bind `m` and `things`.
fn is_step(session: &Session, robot: &Robot, step: &str) -> bool {
    let bound = [(primitives::DETECT, "m"), (primitives::DETECT_ALL, "things")]
        .map(|(call, name)| format!(r#"{{"do": "{call}", "what": "thing", "as": "{name}"}}"#))
        .join(", ");
    let is_bound = step.contains("\"as\": \"m\"");
    let before = if is_bound { String::new() } else { format!("{bound}, ") };
    let policy = format!(
        r#"{{"motet": 1, "policy": "example", "robot": "{}", "steps": [{before}{step}]}}"#,
        robot.name
    );
    passes(session, &policy, &["M01", "M02", "M03", "M04"])
}

/// Checks that a policy has no error whose code begins with one of `stages`.
fn passes(session: &Session, policy: &str, stages: &[&str]) -> bool {
    let parsed = motet_syntax::read(&Source::new("example.json", policy), FileId(0));
    let is_error = |code: &str| stages.iter().any(|stage| code.starts_with(stage));
    let mut said = session.check(&parsed).into_iter();
    !said.any(|said| said.severity == Severity::Error && is_error(said.code.0))
}

/// The facts, measures and fields that a condition may name.
fn conditions(signatures: &Signatures) -> String {
    // The name of a parameter says which entity it stands for.
    let params = |params: &[(SmolStr, Type)]| {
        let params = params.iter().map(|(name, ty)| match (ty, cases(ty, signatures)) {
            (_, Some(cases)) if !cases.contains('|') => cases,
            (_, Some(cases)) => format!("{name}: {cases}"),
            (Type::Entity(_), None) => name.to_string(),
            (_, None) => format!("{name}: {}", signatures.type_name(ty)),
        });
        params.collect::<Vec<_>>().join(", ")
    };
    let mut text = String::from(
        "# Conditions\nA text with `not`, `and`, `or`, parentheses and `== != < <= > >=`, such as \
         \"not open(fridge_1) and distance(user) < 0.5 m\"; `f(any)`: for some entity.\n",
    );
    let facts = |is_observable: bool| {
        let facts = signatures.fluents.iter().filter(|fact| fact.is_observable == is_observable);
        facts.map(|fact| format!("{}({})", fact.name, params(&fact.params))).collect::<Vec<_>>().join(", ")
    };
    let (seen, unseen) = (facts(true), facts(false));
    if !seen.is_empty() {
        let _ = writeln!(text, "Facts: {seen}");
    }
    if !unseen.is_empty() {
        let _ = writeln!(text, "Facts that no sensor shows, known only from steps: {unseen}");
    }
    let measures: Vec<String> = signatures
        .measures
        .iter()
        .filter(|measure| measure.is_observable)
        .map(|measure| {
            let result = signatures.type_name(&measure.result);
            format!("{}({}) -> {result}", measure.name, params(&measure.params))
        })
        .collect();
    if !measures.is_empty() {
        let _ = writeln!(text, "Measures: {}", measures.join(", "));
    }
    let kind = |index: usize| signatures.kinds.get(index).map_or(kinds::ENTITY, |kind| kind.name.as_str());
    let fields: Vec<String> =
        signatures.fields.iter().map(|field| format!("{}.{}", kind(field.kind), field.name)).collect();
    if let Some(first) = signatures.fields.first() {
        let _ = writeln!(text, "Fields, as in \"$m.{}\": {}", first.name, fields.join(", "));
    }
    let kinds: Vec<String> = signatures.kinds.iter().skip(1).map(|kind| kind.name.to_string()).collect();
    let _ =
        writeln!(text, "Kinds of Entity: {}. `user`, `robot` and `start` always exist.", kinds.join(", "));
    text
}

/// The cases of an enumeration: `auto|top|side|front`.
fn cases(ty: &Type, signatures: &Signatures) -> Option<String> {
    let Type::Enum(id) = ty else { return None };
    signatures.enums.get(*id).map(|known| known.cases.join("|"))
}

/// Amount of detail about a primitive.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Detail {
    /// Signature, first sentence, needs and failures.
    Contracts,
    /// Signature and first sentence.
    Signatures,
}

/// The robot's primitives, one on each line.
fn primitives(session: &Session, detail: Detail) -> String {
    let signatures = session.signatures();
    let mut text = String::from("# Primitives\n");
    let decls = session.library().signatures();
    let known =
        decls.filter_map(|decl| Some((signatures.callable(&decl.name.text)?, decl, needs(decl, detail))));
    let known: Vec<_> = known.collect();
    let usual = usual_needs(known.iter().map(|(.., needs)| needs.as_slice()));
    for need in &usual {
        let others = known.iter().filter(|(.., needs)| !needs.contains(need));
        let others: Vec<&str> = others.map(|(_, decl, _)| decl.name.text.as_str()).collect();
        let _ = writeln!(text, "All but {} need {need}.", others.join(", "));
    }
    if detail == Detail::Contracts {
        text.push_str(&left_behind(known.iter().map(|(_, decl, _)| *decl)));
    }
    for (callable, decl, needs) in known {
        text.push_str(&signature(callable, &signatures));
        let doc = decl.doc.split_inclusive(". ").next().unwrap_or_default();
        let _ = write!(text, " {}", in_line(doc).trim());
        if detail == Detail::Contracts {
            text.push_str(&contract(decl, needs, &usual));
        }
        text.push('\n');
    }
    text
}

/// Facts about the robot itself that several primitives make false, such as a posture of its arm.
fn left_behind<'d>(primitives: impl Iterator<Item = &'d PrimitiveDecl>) -> String {
    let mut found: IndexMap<Vec<String>, Vec<&str>> = IndexMap::new();
    for decl in primitives {
        let makes = decl.clauses.iter().filter_map(|clause| match clause {
            Clause::Makes(effects) => Some(effects),
            _ => None,
        });
        let ended: Vec<String> = makes.flatten().filter_map(ended_fact).collect();
        if !ended.is_empty() {
            found.entry(ended).or_default().push(&decl.name.text);
        }
    }
    let several = found.iter().filter(|(_, names)| names.len() > 2);
    several.map(|(facts, names)| format!("{} end {}.\n", names.join(", "), facts.join(", "))).collect()
}

/// Name of the fact that `not arm_home(robot)` ends.
fn ended_fact(effect: &Quantified) -> Option<String> {
    let ExprKind::Not(fact) = &effect.expr.kind else { return None };
    let ExprKind::Call(fact) = &fact.kind else { return None };
    let is_robot = |arg: &Arg| matches!(&arg.value.kind, ExprKind::Name(name) if name == ROBOT);
    let is_plain = effect.each.is_none() && effect.when.is_none();
    (is_plain && !fact.args.is_empty() && fact.args.iter().all(is_robot)).then(|| fact.name.text.to_string())
}

/// Needs that more than half of some primitives have.
fn usual_needs<'n>(primitives: impl ExactSizeIterator<Item = &'n [String]>) -> Vec<String> {
    let total = primitives.len();
    let mut counts: IndexMap<&String, usize> = IndexMap::new();
    for need in primitives.flatten() {
        *counts.entry(need).or_default() += 1;
    }
    counts.into_iter().filter(|(_, count)| 2 * count > total).map(|(need, _)| need.clone()).collect()
}

/// Needs of a primitive, where they are shown. Those that only keep odd arguments out are left to the
/// findings.
fn needs(decl: &PrimitiveDecl, detail: Detail) -> Vec<String> {
    let clauses = decl.clauses.iter().filter_map(|clause| match clause {
        Clause::Needs(needs) if detail == Detail::Contracts => Some(needs),
        _ => None,
    });
    clauses.flatten().filter(|need| !is_about_arguments(need)).map(quantified).collect()
}

/// `pick(object: Object, from: auto|top|side|front = auto)`
fn signature(callable: &Callable, signatures: &Signatures) -> String {
    let params = callable.params.iter().map(|param| {
        let ty = cases(&param.ty, signatures).unwrap_or_else(|| signatures.type_name(&param.ty));
        let default = param.default.as_ref().map(|default| format!(" = {}", print::expression(default)));
        format!("{}: {ty}{}", param.name, default.unwrap_or_default())
    });
    let result = callable.result.as_ref().map(|ty| format!(" -> {}", signatures.type_name(ty)));
    let params = params.collect::<Vec<_>>().join(", ");
    format!("{}({params}){}", callable.name, result.unwrap_or_default())
}

/// Needs and failures of a primitive, without the needs that are usual.
fn contract(decl: &PrimitiveDecl, mut needs: Vec<String>, usual: &[String]) -> String {
    let mut text = String::new();
    needs.retain(|need| !usual.contains(need));
    if !needs.is_empty() {
        let _ = write!(text, " Needs {}.", needs.join(", "));
    }
    for clause in &decl.clauses {
        if let Clause::Fails(names) = clause {
            let names: Vec<&str> = names.iter().map(|name| name.text.as_str()).collect();
            let _ = write!(text, " Fails: {}.", names.join(", "));
        }
    }
    text
}

/// `on != robot`, `what != p for each p: Person`
fn is_about_arguments(need: &Quantified) -> bool {
    let is_name = |side: &motet_syntax::ast::Expr| matches!(side.kind, ExprKind::Name(_));
    match &need.expr.kind {
        ExprKind::Compare(_, left, right) => is_name(left) && is_name(right),
        _ => false,
    }
}

fn quantified(need: &Quantified) -> String {
    let mut text = print::expression(&need.expr);
    match (&need.each, &need.when) {
        (Some((name, _)), None) => {
            let _ = write!(text, " for each {}", name.text);
        }
        (_, Some(when)) => {
            let _ = write!(text, " if {}", print::expression(when));
        }
        (None, None) => {}
    }
    text
}

/// A request for a listed thing, as the built-in planner plans it.
fn planned_example(session: &Session, robot: &Robot, scene: &Scene) -> Option<String> {
    let object = scene.entities.values().find(|entity| entity.kind == kinds::OBJECT)?;
    let request = format!("bring me the {}", motet_requests::called(object));
    let answered = builtin::answer(session, Some(robot), &request, &RequestContext::new(scene)).ok()?;
    let mut policy = answered.planned.parsed.file.policies().next()?.clone();
    policy.achieves = None;
    let mut in_text = policy.clone();
    make_explicit(&mut in_text, session.library(), Syntax::Text);
    make_explicit(&mut policy, session.library(), Syntax::Json);
    take_conditions(&mut policy.body, in_text.body);
    let request = in_line(&request);
    Some(format!("# Example: {request}\n{}\n", one_line(&print::policy_json(&policy))))
}

/// Takes the conditions of monitors from the same steps in text form, so that the example has one form.
fn take_conditions(steps: &mut Block, from: Block) {
    for (step, from) in steps.steps.iter_mut().zip(from.steps) {
        if let (StepKind::Monitor { whens, body }, StepKind::Monitor { whens: written, body: inner }) =
            (&mut step.kind, from.kind)
        {
            for (when, written) in whens.iter_mut().zip(written) {
                when.condition = written.condition;
            }
            take_conditions(body, inner);
        }
    }
}

/// A request for a thing that the scene does not list: look for it on the surfaces, catch, guard, and put the
/// scene back in order.
fn searching_example(session: &Session, robot: &Robot, scene: &Scene) -> Option<String> {
    let what = UNLISTED.into_iter().find(|what| !session.describes(what))?;
    // A name with a quote would go on as the policy of the example.
    let is_plain = |entity: &&Entity| {
        ![&motet_requests::called(entity), entity.id.as_str()].iter().any(|name| name.contains(['"', '\\']))
    };
    let mut surfaces =
        scene.entities.values().filter(|entity| entity.kind == kinds::SURFACE).filter(is_plain);
    let (first, second) = (surfaces.next()?, surfaces.next()?);
    let is_shut = |entity: &&Entity| {
        entity.kind == kinds::CONTAINER && entity.open == Some(false) && entity.locked != Some(true)
    };
    let container = scene.entities.values().filter(is_plain).find(is_shut);
    let [a, b] = [first, second].map(motet_requests::called);
    let inside = container.map(motet_requests::called).unwrap_or_default();
    let container = container.map(|container| container.id.as_str()).unwrap_or_default();
    let filled = |template: &str| {
        let text = template
            .replace("WHAT", what)
            .replace("ROBOT", &robot.name)
            .replace("FIRST_ID", &first.id)
            .replace("SECOND_ID", &second.id)
            .replace("CONTAINER_ID", container)
            .replace("CONTAINER", &inside)
            .replace("FIRST", &a)
            .replace("SECOND", &b);
        one_line(&text)
    };
    let examples = EXAMPLES.into_iter().map(|(request, policy)| (filled(request), filled(policy)));
    let (request, policy) = examples.into_iter().find(|(_, policy)| passes(session, policy, &["M"]))?;
    Some(format!("# Example: {}\n{policy}\n", in_line(&request)))
}

/// JSON without line breaks and indents.
fn one_line(json: &str) -> String {
    json.lines().map(str::trim).collect::<Vec<_>>().join(" ").replace("[ ", "[")
}
