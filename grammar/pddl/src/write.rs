//! Translation of a domain, a problem and a plan to declarations and a policy.
//!
//! Names of PDDL become names of Motet. Any name may stand in back-quotes, so most stay as they are; those
//! that would mean something else get a `_` at their end.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use motet_syntax::ast::{
    Arg as AstArg, Block, Call, Clause, CompareOp, Do, End, EndKind, EntitiesDecl, Expr, ExprKind, File,
    FluentDecl, InitiallyDecl, Item, KindDecl, Name, Param, Policy, PrimitiveDecl, PrimitiveKind, Quantified,
    Step, StepKind, TypeExpr,
};
use motet_syntax::words::is_json_key;
use motet_syntax::{FileId, Source, Span};
use smol_str::{SmolStr, format_smolstr};

use crate::Translation;
use crate::domain::{Domain, Problem};
use crate::formula::{Action, Argument, Effect, Literal};
use crate::plan::PlanStep;
use crate::typed::{DomainNames, OBJECT, Objects, TypedName};

/// All of it.
pub(crate) fn imported(domain: &Domain, problem: &Problem, plan: Vec<PlanStep>) -> Translation {
    let mut items = kinds(domain);
    items.extend(domain.words.predicates.iter().map(|(name, params)| fluent(name, params)));
    items.extend(domain.actions.values().map(|action| primitive(action, &domain.words)));
    items.extend(entities(&problem.objects));
    let facts: Vec<_> = problem.init.iter().map(|fact| literal(fact, &Objects::new())).collect();
    if !facts.is_empty() {
        items.push(Item::Initially(InitiallyDecl { facts, span: Span::default() }));
    }
    items.push(Item::ClosedWorld(Span::default()));
    let policy = File { items: vec![Item::Policy(policy(problem, plan))] };
    Translation { declarations: File { items }, policy }
}

/// Parents before children, `object` first: PDDL's root, which the standard library's entities are not of.
fn kinds(domain: &Domain) -> Vec<Item> {
    let span = Span::default();
    let decl = |doc: SmolStr, name: &SmolStr, parent: Name| {
        Item::Kind(KindDecl {
            doc,
            name: kind_name(name, span),
            parent: Some(parent),
            fields: Vec::new(),
            span,
        })
    };
    let root = Name { text: "Entity".into(), span };
    let doc = format_smolstr!("Imported from the PDDL domain `{}`: any of its objects.", domain.name);
    let mut items = vec![decl(doc, &OBJECT, root)];
    let types = &domain.words.types;
    items.extend(types.iter().map(|(ty, parent)| decl(SmolStr::default(), ty, kind_name(parent, span))));
    items
}

fn typed(param: &TypedName, constants: &Objects) -> Param {
    let ty = TypeExpr::Named(kind_name(&param.ty, param.span));
    Param { name: param_name(&param.name, param.span, constants), ty, default: None }
}

fn fluent(name: &SmolStr, params: &[TypedName]) -> Item {
    let span = Span::default();
    let mut written: Vec<Param> = Vec::with_capacity(params.len());
    for param in params {
        let mut param = typed(param, &Objects::new());
        while written.iter().any(|other| other.name.text == param.name.text) {
            param.name.text = format_smolstr!("{}_", param.name.text);
        }
        written.push(param);
    }
    Item::Fluent(FluentDecl { doc: SmolStr::default(), name: fluent_name(name, span), params: written, span })
}

fn primitive(action: &Action, words: &DomainNames) -> Item {
    let span = Span::default();
    let plain = |expr| Quantified { expr, each: None, when: None };
    let needs: Vec<_> = action.needs.iter().map(|need| plain(literal(need, &words.constants))).collect();
    let makes: Vec<_> = action.makes.iter().map(|effect| quantified(effect, words)).collect();
    let clauses = [(needs.is_empty(), Clause::Needs(needs)), (makes.is_empty(), Clause::Makes(makes))];
    Item::Primitive(PrimitiveDecl {
        doc: SmolStr::default(),
        kind: PrimitiveKind::Action,
        name: Name { text: action.name.clone(), span },
        params: action.params.iter().map(|param| typed(param, &words.constants)).collect(),
        result: None,
        clauses: clauses.into_iter().filter(|(is_empty, _)| !is_empty).map(|(_, clause)| clause).collect(),
        span,
    })
}

fn quantified(effect: &Effect, words: &DomainNames) -> Quantified {
    let each = effect.each.as_ref().map(|each| {
        (param_name(&each.name, each.span, &words.constants), TypeExpr::Named(kind_name(&each.ty, each.span)))
    });
    let when: Vec<_> = effect.when.iter().map(|part| literal(part, &words.constants)).collect();
    let when = if when.is_empty() { None } else { conjunction(when) };
    Quantified { expr: literal(&effect.literal, &words.constants), each, when }
}

/// Objects of one type in a row, as they stand in the file.
fn entities(objects: &Objects) -> Vec<Item> {
    let objects: Vec<_> = objects.values().collect();
    objects
        .chunk_by(|one, other| one.ty == other.ty)
        .filter_map(|chunk| {
            let first = chunk.first()?;
            Some(Item::Entities(EntitiesDecl {
                doc: SmolStr::default(),
                names: chunk.iter().map(|object| entity_name(&object.name, object.span)).collect(),
                kind: kind_name(&first.ty, first.span),
                span: Span::default(),
            }))
        })
        .collect()
}

fn policy(problem: &Problem, plan: Vec<PlanStep>) -> Policy {
    let span = Span::default();
    let steps = plan.into_iter().map(|step| {
        let args = step.args.into_iter().map(|(arg, span)| {
            let value = expr(ExprKind::Name(entity_name(&arg, span).text), span);
            AstArg { name: None, value, span }
        });
        let call =
            Call { name: Name { text: step.action, span: step.span }, args: args.collect(), span: step.span };
        Step {
            kind: StepKind::Do(Do { call, bind: None, manner: None, within: None, retry: None }),
            span: step.span,
        }
    });
    let mut steps: Vec<Step> = steps.collect();
    if steps.is_empty() {
        let done = End { kind: EndKind::Done, result: None, why: None, span };
        steps.push(Step { kind: StepKind::End(done), span });
    }
    Policy {
        doc: format_smolstr!("A plan for the PDDL problem `{}`.", problem.name),
        name: Name { text: "plan".into(), span },
        params: Vec::new(),
        result: None,
        robot: None,
        achieves: conjunction(problem.goal.iter().map(|part| literal(part, &Objects::new())).collect()),
        body: Block::new(steps, span),
        keeps: Vec::new(),
        cleanup: None,
        span,
    }
}

fn expr(kind: ExprKind, span: Span) -> Expr {
    Expr { kind, span }
}

fn conjunction(mut parts: Vec<Expr>) -> Option<Expr> {
    match parts.len() {
        0 | 1 => parts.pop(),
        _ => Some(expr(ExprKind::All(parts), Span::default())),
    }
}

fn literal(literal: &Literal, constants: &Objects) -> Expr {
    let span = literal.atom.span;
    let args = literal.atom.args.iter().map(|arg| {
        let name = match arg {
            Argument::Variable(text) => param_name(text, span, constants),
            Argument::Name(text) => entity_name(text, span),
        };
        expr(ExprKind::Name(name.text), span)
    });
    let Some(predicate) = &literal.atom.predicate else {
        let mut args = args.map(Box::new);
        let op = if literal.truth { CompareOp::Equal } else { CompareOp::Unequal };
        return match (args.next(), args.next()) {
            (Some(left), Some(right)) => expr(ExprKind::Compare(op, left, right), span),
            // The reader asks for two.
            _ => expr(ExprKind::Bool(literal.truth), span),
        };
    };
    let args = args.map(|value| AstArg { name: None, span: value.span, value }).collect();
    let atom = expr(ExprKind::Call(Call { name: fluent_name(predicate, span), args, span }), span);
    if literal.truth { atom } else { expr(ExprKind::Not(Box::new(atom)), span) }
}

/// Entities that always exist, and the word for all of them.
const ENTITY_TAKEN: [&str; 6] = ["robot", "user", "start", "any", "true", "false"];

/// Name of a parameter. `on` is free in Motet, yet `result` is not.
fn param_name(text: &str, span: Span, constants: &Objects) -> Name {
    if constants.contains_key(text) {
        // In PDDL `?depot` and `depot` are two names.
        return Name { text: format_smolstr!("{text}__"), span };
    }
    let is_taken = is_json_key(text) || text == "result" || ENTITY_TAKEN.contains(&text);
    suffixed(text, is_taken, span)
}

/// Name of an object.
fn entity_name(text: &str, span: Span) -> Name {
    suffixed(text, ENTITY_TAKEN.contains(&text), span)
}

/// Name of a predicate. One of the standard library cannot be declared anew with other parameters: its
/// primitives use it.
fn fluent_name(text: &str, span: Span) -> Name {
    suffixed(text, standard_fluents().contains(text) || text == "monitored", span)
}

/// Name of a type. Kinds of the standard library begin with a capital letter, and types of PDDL with a small
/// one.
fn kind_name(text: &str, span: Span) -> Name {
    Name { text: text.into(), span }
}

fn suffixed(text: &str, is_taken: bool, span: Span) -> Name {
    // One more `_` for each that is there already, so that two names never become one.
    let is_taken = is_taken || {
        let bare = text.trim_end_matches('_');
        bare != text
            && (ENTITY_TAKEN.contains(&bare)
                || is_json_key(bare)
                || bare == "on"
                || standard_fluents().contains(bare))
    };
    let text = if is_taken { SmolStr::from(format!("{text}_")) } else { text.into() };
    Name { text, span }
}

/// Fluents and measures of the standard library.
fn standard_fluents() -> &'static BTreeSet<SmolStr> {
    static NAMES: OnceLock<BTreeSet<SmolStr>> = OnceLock::new();
    NAMES.get_or_init(|| {
        let files = motet_stdlib::FILES.iter().map(|(name, text)| Source::new(*name, *text));
        let items = files.flat_map(|source| motet_syntax::read(&source, FileId(0)).file.items);
        items
            .filter_map(|item| match item {
                Item::Fluent(decl) => Some(decl.name.text),
                Item::Measure(decl) => Some(decl.name.text),
                _ => None,
            })
            .collect()
    })
}
