//! Domain of a document, for its worlds: entities, fluents and contracts as far as the worlds have them.

use motet_syntax::ast::{
    Call, Clause, CompareOp, Expr, ExprKind, File, Item, PrimitiveDecl, PrimitiveKind, Quantified, TypeExpr,
};

use super::contract::{Action, Arg, Atom, Change, Condition, Domain, Kind, Need};
use super::make::{BASE, FAILURES, LIBRARY};

/// Names that a contract may use.
#[derive(Clone, Copy)]
struct Scope<'a> {
    /// Parameters that are entities.
    params: &'a [&'a str],
    /// Variable of a quantified entry.
    each: Option<&'a str>,
}

/// Reads the declarations of a document.
///
/// # Errors
///
/// A declaration that the worlds cannot play, in words.
pub(super) fn domain(file: &File) -> Result<Domain, String> {
    let mut domain = Domain::default();
    for item in &file.items {
        match item {
            Item::Entities(decl) => {
                let kind = named_kind(&decl.kind.text)?;
                domain.entities.extend(decl.names.iter().map(|name| (name.text.to_string(), kind)));
            }
            Item::Fluent(decl) => {
                domain.names.push(decl.name.text.to_string());
                let kinds = decl.params.iter().map(|param| kind(&param.ty));
                domain.fluents.push(kinds.collect::<Result<_, _>>()?);
            }
            Item::ClosedWorld(_) => domain.is_closed = true,
            Item::Policy(_) | Item::Primitive(_) | Item::Initially(_) => {}
            Item::Kind(_) | Item::Measure(_) | Item::Failure(_) | Item::Enum(_) => {
                return Err(
                    "the worlds have no kinds, measures, failures and enumerations of a document".into()
                );
            }
        }
    }
    domain.declared = domain.entities.len();
    for (name, kind) in LIBRARY {
        domain.entities.push((name.to_owned(), kind));
    }
    for item in &file.items {
        match item {
            Item::Primitive(decl) => {
                let action = action(decl, &domain)?;
                domain.actions.push(action);
            }
            Item::Initially(decl) => {
                for fact in &decl.facts {
                    let started = signed(fact, &domain, Scope { params: &[], each: None })?;
                    domain.start.push(started);
                }
            }
            _ => {}
        }
    }
    Ok(domain)
}

/// Reads the goal of a policy.
///
/// # Errors
///
/// A goal that the worlds cannot judge, in words.
pub(super) fn goal(file: &File, policy: &str, domain: &Domain) -> Result<Option<Condition>, String> {
    let mut policies = file.policies().filter(|known| known.name.text == policy);
    let goal = policies.find_map(|policy| policy.achieves.as_ref());
    goal.map(|goal| condition(goal, domain, Scope { params: &[], each: None })).transpose()
}

fn named_kind(name: &str) -> Result<Kind, String> {
    let kinds = [Kind::Entity, Kind::Object, Kind::Container, Kind::Person, Kind::Place];
    kinds
        .into_iter()
        .find(|kind| kind.to_string() == name)
        .ok_or_else(|| format!("the worlds have no kind `{name}`"))
}

fn kind(ty: &TypeExpr) -> Result<Kind, String> {
    match ty {
        TypeExpr::Named(name) => named_kind(&name.text),
        TypeExpr::List(..) => Err("the worlds have no lists".to_owned()),
    }
}

fn action(decl: &PrimitiveDecl, domain: &Domain) -> Result<Action, String> {
    // Texts and numbers say nothing about facts.
    let entities = decl.params.iter().filter_map(|param| Some((&*param.name.text, kind(&param.ty).ok()?)));
    let (names, params): (Vec<&str>, Vec<Kind>) = entities.unzip();
    let finds_all = matches!(decl.result, Some(TypeExpr::List(..)));
    let found = decl.result.as_ref().filter(|_| decl.kind == PrimitiveKind::Perception && !finds_all);
    let finds = found.map(kind).transpose()?;
    let name = decl.name.text.to_string();
    let mut action = Action { name, params, finds, finds_all, ..Action::default() };
    for clause in &decl.clauses {
        match clause {
            Clause::Needs(all) => {
                for one in all {
                    let (scope, each) = quantified(one, &names)?;
                    let when = one.when.as_ref().map(|when| condition(when, domain, scope)).transpose()?;
                    action.needs.push(Need { condition: condition(&one.expr, domain, scope)?, each, when });
                }
            }
            Clause::Makes(all) => changes(all, domain, &names, &mut action.makes)?,
            Clause::Unsettles(all) => changes(all, domain, &names, &mut action.unsettles)?,
            Clause::Fails(fails) => {
                let known = |name: &str| FAILURES.into_iter().find(|failure| *failure == name);
                let all = fails.iter().map(|name| known(&name.text).ok_or(&name.text));
                action.fails = all
                    .collect::<Result<_, _>>()
                    .map_err(|name| format!("the worlds never fail with `{name}`"))?;
            }
            Clause::Uses(uses) => {
                action.uses = uses.iter().any(|name| &*name.text == BASE).then_some(BASE);
            }
            Clause::Takes { .. } => {}
            Clause::Lasts(until) if until.iter().all(|name| &*name.text == BASE) => {
                action.is_stale_by_base = true;
            }
            Clause::Lasts(_) => return Err("in the worlds a fact lasts until the base is used".to_owned()),
            Clause::Motion(_) => return Err("the worlds have no motions".to_owned()),
        }
    }
    Ok(action)
}

fn quantified<'a>(one: &'a Quantified, params: &'a [&'a str]) -> Result<(Scope<'a>, Option<Kind>), String> {
    let each = one.each.as_ref().map(|(name, ty)| kind(ty).map(|kind| (&*name.text, kind))).transpose()?;
    Ok((Scope { params, each: each.map(|(name, _)| name) }, each.map(|(_, kind)| kind)))
}

fn changes(
    all: &[Quantified],
    domain: &Domain,
    params: &[&str],
    changes: &mut Vec<Change>,
) -> Result<(), String> {
    for one in all {
        let (scope, each) = quantified(one, params)?;
        let when = one.when.as_ref().map(|when| condition(when, domain, scope)).transpose()?;
        let (atom, truth) = signed(&one.expr, domain, scope)?;
        changes.push(Change { atom, truth, each, when });
    }
    Ok(())
}

/// A fact, perhaps under one `not`.
fn signed(expr: &Expr, domain: &Domain, scope: Scope<'_>) -> Result<(Atom, bool), String> {
    match condition(expr, domain, scope)? {
        Condition::Is(atom) => Ok((atom, true)),
        Condition::Not(inner) => match *inner {
            Condition::Is(atom) => Ok((atom, false)),
            _ => Err("an effect is not a fact".to_owned()),
        },
        _ => Err("an effect is not a fact".to_owned()),
    }
}

fn condition(expr: &Expr, domain: &Domain, scope: Scope<'_>) -> Result<Condition, String> {
    let parts = |parts: &[Expr]| {
        parts.iter().map(|part| condition(part, domain, scope)).collect::<Result<Vec<_>, _>>()
    };
    match &expr.kind {
        ExprKind::Call(call) => Ok(Condition::Is(atom(call, domain, scope)?)),
        ExprKind::Not(inner) => Ok(Condition::Not(Box::new(condition(inner, domain, scope)?))),
        ExprKind::All(all) => Ok(Condition::All(parts(all)?)),
        ExprKind::AnyOf(some) => Ok(Condition::AnyOf(parts(some)?)),
        ExprKind::Compare(CompareOp::Equal, one, other) => {
            Ok(Condition::Same(arg(one, domain, scope)?, arg(other, domain, scope)?))
        }
        ExprKind::Compare(CompareOp::Unequal, one, other) => {
            let same = Condition::Same(arg(one, domain, scope)?, arg(other, domain, scope)?);
            Ok(Condition::Not(Box::new(same)))
        }
        _ => Err("the worlds have facts and equalities only".to_owned()),
    }
}

fn atom(call: &Call, domain: &Domain, scope: Scope<'_>) -> Result<Atom, String> {
    let name = &call.name.text;
    let fluent = domain.fluent(name).ok_or_else(|| format!("the document declares no fluent `{name}`"))?;
    let args = call.args.iter().map(|one| arg(&one.value, domain, scope));
    Ok(Atom { fluent, args: args.collect::<Result<_, _>>()? })
}

fn arg(expr: &Expr, domain: &Domain, scope: Scope<'_>) -> Result<Arg, String> {
    let (ExprKind::Name(name) | ExprKind::Binding(name)) = &expr.kind else {
        return if expr.kind == ExprKind::Any {
            Ok(Arg::Any)
        } else {
            Err("an argument is no name".to_owned())
        };
    };
    if scope.each == Some(name) {
        return Ok(Arg::Each);
    }
    if let Some(index) = scope.params.iter().position(|param| param == name) {
        return Ok(Arg::Param(index));
    }
    if name == "result" {
        return Ok(Arg::Result);
    }
    domain.entity(name).map(Arg::Entity).ok_or_else(|| format!("the worlds have no entity `{name}`"))
}
