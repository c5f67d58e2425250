//! Elaboration of contracts: the clauses of a primitive.

use std::sync::Arc;

use motet_robots::card::Robot;
use motet_syntax::ast::{Clause, Expr, ExprKind, MAX_MISTAKES, Name, PrimitiveDecl, Quantified, TypeExpr};
use motet_syntax::unit::Dimension;
use motet_syntax::words::is_json_key;
use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use super::builder::{Declarations, MAX_INITIALLY, MAX_PATTERNS, elaborator, limit};
use super::card;
use super::diagnostics::{
    BadDeclaration, Duplicate, LimitExceeded, ReservedName, UnknownFailure, UnknownMotion, UnknownResource,
    UnknownType,
};
use super::elaborator::{Elaborator, Expected, ValueRole};
use super::library::{EffectDef, FAILURE, LastsDef, Library, NeedDef, ParamDef, PrimitiveDef, ResourceSet};
use super::name::{list, near};
use crate::ir::{Base, Entities, Kind, MotionKind, Primitive, TIMEOUT, Term, Ty};

/// Duration in seconds, least and greatest, of a primitive without a `takes` clause.
const DEFAULT_TAKES: (f64, f64) = (0.0, 60.0);

pub(super) fn primitives(
    library: &mut Library,
    declarations: &Declarations,
    robot: Option<&Robot>,
    entities: &Entities,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut defs: Vec<PrimitiveDef> = Vec::with_capacity(declarations.primitives.len());
    for (index, decl) in declarations.primitives.values().enumerate() {
        if limit(index, "primitives", decl.item.span, diagnostics) || diagnostics.len() > MAX_MISTAKES {
            break;
        }
        let mut elaborator = elaborator(library, entities);
        let def = primitive(&mut elaborator, &decl.item, robot);
        let mistakes = elaborator.diagnostics;
        if !mistakes.is_empty() {
            // A robot need not have what a primitive needs that it does not provide; what a domain declares
            // is looked at always.
            if !def.provided && decl.layer <= declarations.robot_top() {
                continue;
            }
            // A layer above may replace what a contract below speaks of: what no longer fits goes with it.
            let is_alone = declarations.top() == declarations.robot_top();
            match robot.filter(|_| decl.layer == 0) {
                Some(robot) => diagnostics.extend(card::unfit(robot, &def.name, &mistakes, is_alone)),
                None if decl.layer == declarations.top() => diagnostics.extend(mistakes),
                None => {}
            }
            if decl.layer != declarations.top() {
                continue;
            }
        }
        defs.push(def);
    }
    for (index, def) in defs.iter().enumerate() {
        let id = Primitive(u16::try_from(index).unwrap_or(u16::MAX));
        library.names.primitives.insert(def.name.clone(), id);
    }
    let perceptions = defs.iter().filter(|def| def.lasts.is_some());
    let mut perceived: Vec<_> =
        perceptions.flat_map(|def| &def.makes).map(|effect| effect.fact.fluent).collect();
    perceived.sort_unstable();
    perceived.dedup();
    library.perceived = perceived;
    library.primitives = defs;
}

/// Elaborates `initially` of the declarations and of the card.
pub(super) fn initially(
    library: &mut Library,
    declarations: &Declarations,
    robot: Option<&Robot>,
    entities: &Entities,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut elaborator = elaborator(library, entities);
    let (mut facts, mut patterns) = (Vec::new(), 0);
    if let Some(robot) = robot {
        for (text, expr, span) in card::facts(robot, diagnostics) {
            let (value, inner) = strip_not(&expr);
            if let Some(fact) = literal(&mut elaborator, inner) {
                facts.push((fact, value, span));
            }
            // Places in the entry's own text are none in the card.
            let why = std::mem::take(&mut elaborator.diagnostics).into_iter().next();
            diagnostics.extend(why.map(|why| card::not_at_first(text, (why.message, why.help), span)));
        }
    }
    for expr in declarations.initially.iter().flat_map(|decl| &decl.facts) {
        if elaborator.has_too_many_errors() {
            break;
        }
        if facts.len() >= MAX_INITIALLY {
            let (what, limit) = ("facts at the start", MAX_INITIALLY);
            elaborator.report(LimitExceeded { span: expr.span, what, limit });
            break;
        }
        let (value, inner) = strip_not(expr);
        if let Some(fact) = literal(&mut elaborator, inner) {
            patterns += usize::from(fact.args.contains(&None));
            if patterns > MAX_PATTERNS {
                let (what, limit) = ("facts about `any` at the start", MAX_PATTERNS);
                elaborator.report(LimitExceeded { span: expr.span, what, limit });
                break;
            }
            facts.push((fact, value, expr.span));
        }
    }
    diagnostics.extend(elaborator.diagnostics);
    library.initially = facts;
}

fn strip_not(expr: &Expr) -> (bool, &Expr) {
    match &expr.kind {
        ExprKind::Not(inner) => (false, inner),
        _ => (true, expr),
    }
}

/// Elaborates a fluent where no other condition is allowed.
fn literal(elaborator: &mut Elaborator<'_>, expr: &Expr) -> Option<crate::ir::Fact> {
    match &expr.kind {
        ExprKind::Call(call) => elaborator.fact(call),
        _ => {
            let what = "a fact is a fluent, with or without one `not`".to_owned();
            let remedy = "write it as `on(cup, table)` or `not on(cup, table)`".to_owned();
            elaborator.report(BadDeclaration { span: expr.span, what, remedy });
            None
        }
    }
}

/// Most entries of each of the clauses `needs`, `makes` and `unsettles`.
const MAX_ENTRIES: usize = 1_000;

/// A clause without the entries that are too many.
fn cut(mut clause: Clause) -> Clause {
    if let Clause::Needs(all) | Clause::Makes(all) | Clause::Unsettles(all) = &mut clause {
        all.truncate(MAX_ENTRIES);
    }
    clause
}

fn primitive(
    elaborator: &mut Elaborator<'_>,
    decl: &Arc<PrimitiveDecl>,
    robot: Option<&Robot>,
) -> PrimitiveDef {
    let name = decl.name.text.clone();
    for clause in &decl.clauses {
        let (Clause::Needs(all) | Clause::Makes(all) | Clause::Unsettles(all)) = clause else { continue };
        if let Some(beyond) = all.get(MAX_ENTRIES) {
            let (span, what) = (beyond.expr.span, "needs or effects of a primitive");
            elaborator.report(LimitExceeded { span, what, limit: MAX_ENTRIES });
            let cut = decl.clauses.iter().map(|clause| cut(clause.clone()));
            let decl = PrimitiveDecl { clauses: cut.collect(), ..PrimitiveDecl::clone(decl) };
            return primitive(elaborator, &Arc::new(decl), robot);
        }
    }
    let ranges = robot.and_then(|robot| robot.primitives.get(&name));
    let mut params: Vec<ParamDef> = Vec::with_capacity(decl.params.len());
    for (index, param) in decl.params.iter().enumerate() {
        let ty = resolve_type(elaborator, &param.ty);
        let param_name = &param.name.text;
        if is_json_key(param_name) {
            elaborator.report(ReservedName { span: param.name.span, name: param_name.clone() });
        }
        if let Some(first) = elaborator.scope.find(param_name).map(|entry| entry.span) {
            let name = param_name.clone();
            elaborator.report(Duplicate { span: param.name.span, name, what: "parameter", first });
        }
        let wanted = Expected { ty, place: ValueRole::Param(param_name, &name) };
        let default = param.default.as_ref().map(|default| {
            let term = elaborator.term_of(default, wanted);
            if !matches!(term, Term::Param(_)) && term.last_param().is_some() {
                elaborator.report(BadDeclaration {
                    span: default.span,
                    what: "a default is a constant, or an earlier parameter alone".to_owned(),
                    remedy: "give the value in each call".to_owned(),
                });
                return Term::Unknown;
            }
            term
        });
        let term = Term::Param(u16::try_from(index).unwrap_or(u16::MAX));
        elaborator.scope.push(param_name.clone(), term, ty, param.name.span);
        let range =
            ranges.and_then(|ranges| ranges.get(param_name)).map(|range| (range.least, range.greatest));
        params.push(ParamDef { name: param_name.clone(), ty, default, range });
    }
    let result = decl.result.as_ref().map(|ty| resolve_type(elaborator, ty));
    if let Some(ty) = result {
        elaborator.scope.push("result".into(), Term::Result, ty, decl.name.span);
    }
    let mut def = PrimitiveDef {
        provided: robot.is_none_or(|robot| robot.primitives.contains_key(&name)),
        name,
        form: decl.kind,
        params,
        result,
        needs: Vec::new(),
        makes: Vec::new(),
        unsettles: Vec::new(),
        motion: None,
        uses: 0,
        uses_named: Vec::new(),
        takes: DEFAULT_TAKES,
        fails: Vec::new(),
        lasts: None,
        source: Arc::clone(decl),
    };
    for clause in &decl.clauses {
        clause_into(elaborator, clause, &mut def);
    }
    if !def.fails.contains(&TIMEOUT) {
        def.fails.push(TIMEOUT);
    }
    def
}

fn clause_into(elaborator: &mut Elaborator<'_>, clause: &Clause, def: &mut PrimitiveDef) {
    match clause {
        Clause::Needs(entries) => {
            for entry in entries {
                let (each, when, condition) = quantified(elaborator, entry, Elaborator::condition);
                def.needs.push(NeedDef { condition, each, when, span: entry.expr.span });
            }
        }
        Clause::Makes(entries) => {
            def.makes.extend(entries.iter().filter_map(|entry| effect(elaborator, entry)))
        }
        Clause::Unsettles(entries) => {
            def.unsettles.extend(entries.iter().filter_map(|entry| effect(elaborator, entry)))
        }
        Clause::Motion(call) => {
            let name = &call.name.text;
            let Some(kind) = MotionKind::from_name(name) else {
                let near = near(name, MotionKind::ALL.iter().map(|known| known.name()));
                elaborator.report(UnknownMotion { span: call.name.span, name: name.clone(), near });
                return;
            };
            let (least, most) = (kind.arity(), kind.arity() + kind.options().len());
            if !(least..=most).contains(&call.args.len()) {
                let plural = if most == 1 { "" } else { "s" };
                let count = if least == most { least.to_string() } else { format!("{least} to {most}") };
                elaborator.report(BadDeclaration {
                    span: call.span,
                    what: format!("the motion `{name}` takes {count} argument{plural}"),
                    remedy: "give one entity or term for each argument".to_owned(),
                });
            }
            let args = call.args.iter().map(|arg| elaborator.term(&arg.value, None).0).collect();
            def.motion = Some((kind, args));
        }
        Clause::Uses(names) => {
            for name in names {
                if let Some((index, closure)) = resource(elaborator, name) {
                    def.uses |= closure;
                    def.uses_named.push(index);
                }
            }
        }
        Clause::Takes { least, greatest } => {
            let bounds =
                (elaborator.seconds(least, "a duration"), elaborator.seconds(greatest, "a duration"));
            if let (Some(low), Some(high)) = bounds {
                if low > high {
                    let what = format!("`takes` goes from {low} s down to {high} s");
                    let remedy = "write the least duration first".to_owned();
                    elaborator.report(BadDeclaration { span: least.span.to(greatest.span), what, remedy });
                }
                def.takes = (low, high.max(low));
            }
        }
        Clause::Fails(names) => {
            for name in names {
                match elaborator.library.names.failures.get(&name.text) {
                    Some(kind) if def.fails.contains(kind) => {}
                    Some(kind) => def.fails.push(*kind),
                    None => {
                        let known = || elaborator.library.failures.iter().map(|def| &def.name);
                        let near = near(&name.text, known().map(SmolStr::as_str));
                        let known = list(known().cloned());
                        elaborator.report(UnknownFailure {
                            span: name.span,
                            name: name.text.clone(),
                            near,
                            known,
                        });
                    }
                }
            }
        }
        Clause::Lasts(names) => lasts(elaborator, names, def),
    }
}

fn lasts(elaborator: &mut Elaborator<'_>, names: &[Name], def: &mut PrimitiveDef) {
    let mut lasts = LastsDef { resources: 0, entities: Vec::new() };
    for name in names {
        match elaborator.scope.find(&name.text) {
            Some(entry) => lasts.entities.push(entry.term.clone()),
            None => {
                if let Some((_, closure)) = resource(elaborator, name) {
                    lasts.resources |= closure;
                }
            }
        }
    }
    def.lasts = Some(lasts);
}

fn resource(elaborator: &mut Elaborator<'_>, name: &Name) -> Option<(u8, ResourceSet)> {
    let library = elaborator.library;
    let resources = &library.resources;
    let named = |name: &str| resources.iter().position(|def| def.name == name);
    let first =
        || library.names.cases.get(&name.text).and_then(|(id, case)| named(library.case_name(*id, *case)));
    match named(&name.text).or_else(first) {
        Some(index) => Some((u8::try_from(index).ok()?, resources.get(index)?.closure)),
        None => {
            let near = near(&name.text, resources.iter().map(|def| def.name.as_str()));
            let known = list(resources.iter().map(|def| def.name.clone()));
            elaborator.report(UnknownResource { span: name.span, name: name.text.clone(), near, known });
            None
        }
    }
}

fn effect(elaborator: &mut Elaborator<'_>, entry: &Quantified) -> Option<EffectDef> {
    let (value, inner) = strip_not(&entry.expr);
    let (each, when, fact) = quantified(elaborator, entry, |elaborator, _| literal(elaborator, inner));
    let fact = fact?;
    if elaborator.library.fluent(fact.fluent).is_some_and(|def| def.derived) {
        let what = "`reachable` is derived: no primitive can make it".to_owned();
        elaborator.report(BadDeclaration { span: inner.span, what, remedy: "remove it".to_owned() });
        return None;
    }
    Some(EffectDef { fact, value, each, when })
}

/// Elaborates an entry with its `for each` variable in scope.
fn quantified<'a, T>(
    elaborator: &mut Elaborator<'a>,
    entry: &Quantified,
    read: impl FnOnce(&mut Elaborator<'a>, &Expr) -> T,
) -> (Option<Kind>, Option<crate::ir::Condition>, T) {
    let mark = elaborator.scope.mark();
    let each = entry.each.as_ref().map(|(name, ty)| {
        let ty = resolve_type(elaborator, ty);
        let kind = ty.kind().unwrap_or_else(|| {
            if ty.base != Base::Unknown {
                let what =
                    format!("`for each` ranges over entities, not over {}", elaborator.library.type_name(ty));
                elaborator.report(BadDeclaration {
                    span: name.span,
                    what,
                    remedy: "name a kind of entity".to_owned(),
                });
            }
            Kind::ROOT
        });
        elaborator.scope.push(name.text.clone(), Term::Each, Ty::plain(Base::Entity(kind)), name.span);
        kind
    });
    let when = entry.when.as_ref().map(|when| elaborator.condition(when));
    let value = read(elaborator, &entry.expr);
    elaborator.scope.back_to(mark);
    (each, when, value)
}

/// Elaborates a type; the elaborator collects the errors.
pub(crate) fn resolve_type(elaborator: &mut Elaborator<'_>, ty: &TypeExpr) -> Ty {
    let (ty, mistakes) = type_of(elaborator.library, ty);
    elaborator.diagnostics.extend(mistakes);
    ty
}

/// Elaborates a type, and returns the error if there is one.
pub(super) fn type_of(library: &Library, ty: &TypeExpr) -> (Ty, Option<Diagnostic>) {
    let mut lists = 0u8;
    let mut inner = ty;
    while let TypeExpr::List(next, _) = inner {
        lists = lists.saturating_add(1);
        inner = next;
    }
    let TypeExpr::Named(name) = inner else { return (Ty::UNKNOWN, None) };
    let base = match name.text.as_str() {
        "Bool" => Base::Bool,
        "Int" => Base::Int,
        "Number" => Base::Number,
        "Text" => Base::Text,
        "Pose" => Base::Pose,
        FAILURE if !library.names.kinds.contains_key(FAILURE) => Base::Failure,
        text => {
            match (Dimension::of_type(text), library.names.kinds.get(text), library.names.enums.get(text)) {
                (Some(dimension), ..) => Base::Quantity(dimension),
                (_, Some(kind), _) => Base::Entity(*kind),
                (_, _, Some(id)) => Base::Enum(*id),
                (None, None, None) => {
                    return (Ty::UNKNOWN, Some(unknown_type(library, name.span, &name.text)));
                }
            }
        }
    };
    (Ty { base, lists }, None)
}

fn unknown_type(library: &Library, span: Span, name: &SmolStr) -> Diagnostic {
    let builtin =
        ["Bool", "Int", "Number", "Text", "Pose", "Length", "Angle", "Duration", "Mass", "Force", "Speed"];
    let kinds = library.kinds.iter().map(|def| def.name.as_str());
    let enums = library.named_enums().map(|def| def.name.as_str());
    let near = near(name, builtin.into_iter().chain(["Ratio", "List", FAILURE]).chain(kinds).chain(enums));
    UnknownType { span, name: name.clone(), near }.into()
}

impl Library {
    /// Elaborates a type; unknown if it is not declared.
    pub(crate) fn written_type(&self, ty: &TypeExpr) -> Ty {
        type_of(self, ty).0
    }
}
