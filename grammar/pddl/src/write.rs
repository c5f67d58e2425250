//! The AST of what was read.

use motet_syntax::Span;
use motet_syntax::ast::{
    Arg as AstArg, Block, Call, Clause, CompareOp, Do, EntitiesDecl, Expr, ExprKind, File, FluentDecl,
    InitiallyDecl, Item, KindDecl, Name, Param, Policy, PrimitiveDecl, PrimitiveKind, Quantified, Step,
    StepKind, TypeExpr,
};
use smol_str::{SmolStr, format_smolstr};

use crate::Translation;
use crate::actions::{Action, Effect};
use crate::domain::Domain;
use crate::formula::{Argument, Literal};
use crate::name;
use crate::plan::PlanStep;
use crate::problem::Problem;
use crate::typed::{DomainNames, OBJECT, TypedName};

/// All of it.
pub(crate) fn imported(domain: &Domain, problem: &Problem, plan: Vec<PlanStep>) -> Translation {
    let mut items = kinds(domain);
    items.extend(domain.words.predicates.iter().map(|(name, params)| fluent(name, params)));
    items.extend(domain.actions.values().map(|action| primitive(action, &domain.words)));
    items.extend(entities(&problem.objects));
    let facts: Vec<_> = problem.init.iter().map(|fact| literal(fact, &[])).collect();
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
            name: name::kind(name, span),
            parent: Some(parent),
            fields: Vec::new(),
            span,
        })
    };
    let root = Name { text: "Entity".into(), span };
    let doc = format_smolstr!("Imported from the PDDL domain `{}`: any of its objects.", domain.name);
    let mut items = vec![decl(doc, &OBJECT, root)];
    let types = &domain.words.types;
    items.extend(types.iter().map(|(ty, parent)| decl(SmolStr::default(), ty, name::kind(parent, span))));
    items
}

fn typed(param: &TypedName, constants: &[TypedName]) -> Param {
    let ty = TypeExpr::Named(name::kind(&param.ty, param.span));
    Param { name: name::param(&param.name, param.span, constants), ty, default: None }
}

fn fluent(name: &SmolStr, params: &[TypedName]) -> Item {
    let span = Span::default();
    let mut written: Vec<Param> = Vec::with_capacity(params.len());
    for param in params {
        let mut param = typed(param, &[]);
        while written.iter().any(|other| other.name.text == param.name.text) {
            param.name.text = format_smolstr!("{}_", param.name.text);
        }
        written.push(param);
    }
    Item::Fluent(FluentDecl {
        doc: SmolStr::default(),
        name: name::fluent(name, span),
        params: written,
        span,
    })
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
        (
            name::param(&each.name, each.span, &words.constants),
            TypeExpr::Named(name::kind(&each.ty, each.span)),
        )
    });
    let when: Vec<_> = effect.when.iter().map(|part| literal(part, &words.constants)).collect();
    let when = if when.is_empty() { None } else { conjunction(when) };
    Quantified { expr: literal(&effect.literal, &words.constants), each, when }
}

/// Objects of one type in a row, as they stand in the file.
fn entities(objects: &[TypedName]) -> Vec<Item> {
    objects
        .chunk_by(|one, other| one.ty == other.ty)
        .filter_map(|chunk| {
            let first = chunk.first()?;
            Some(Item::Entities(EntitiesDecl {
                doc: SmolStr::default(),
                names: chunk.iter().map(|object| name::entity(&object.name, object.span)).collect(),
                kind: name::kind(&first.ty, first.span),
                span: Span::default(),
            }))
        })
        .collect()
}

fn policy(problem: &Problem, plan: Vec<PlanStep>) -> Policy {
    let span = Span::default();
    let steps = plan.into_iter().map(|step| {
        let args = step.args.into_iter().map(|(arg, span)| {
            let value = expr(ExprKind::Name(name::entity(&arg, span).text), span);
            AstArg { name: None, value, span }
        });
        let call =
            Call { name: Name { text: step.action, span: step.span }, args: args.collect(), span: step.span };
        Step { kind: StepKind::Do(Do { call, bind: None, within: None, retry: None }), span: step.span }
    });
    Policy {
        doc: format_smolstr!("A plan for the PDDL problem `{}`.", problem.name),
        name: Name { text: "plan".into(), span },
        params: Vec::new(),
        robot: None,
        achieves: conjunction(problem.goal.iter().map(|part| literal(part, &[])).collect()),
        body: Block { steps: steps.collect(), span },
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

fn literal(literal: &Literal, constants: &[TypedName]) -> Expr {
    let span = literal.atom.span;
    let args = literal.atom.args.iter().map(|arg| {
        let name = match arg {
            Argument::Variable(text) => name::param(text, span, constants),
            Argument::Name(text) => name::entity(text, span),
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
    let atom = expr(ExprKind::Call(Call { name: name::fluent(predicate, span), args, span }), span);
    if literal.truth { atom } else { expr(ExprKind::Not(Box::new(atom)), span) }
}
