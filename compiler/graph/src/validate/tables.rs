//! The tables of declarations.

use super::limits::{MAX_NODES, MAX_RESOURCES, MAX_TERM_DEPTH};
use super::{Findings, InvalidReason};
use crate::model::{FactArg, Graph, InitialFact, Term, Type};

pub(super) fn check(graph: &Graph, findings: &mut Findings) {
    for (what, count, limit) in [
        ("nodes", graph.nodes.len(), MAX_NODES),
        ("regions", graph.regions.len(), MAX_NODES),
        ("bindings", graph.bindings.len(), MAX_NODES),
        ("resources", graph.resources.len(), MAX_RESOURCES),
    ] {
        if count > limit {
            findings.table(what, limit, InvalidReason::TooMany { what, count, limit });
        }
    }
    if graph.failures.first().is_none_or(|first| first != "timeout") {
        findings.table("failure", 0, InvalidReason::NoTimeout);
    }
    for (index, kind) in graph.kinds.iter().enumerate() {
        if kind.parent.is_some_and(|parent| parent.index() >= index) {
            findings.table("kind", index, InvalidReason::KindOrder(kind.name.clone()));
        }
    }
    declarations(graph, findings);
    for (index, resource) in graph.resources.iter().enumerate() {
        for inner in &resource.contains {
            known(findings, "resource", index, "resource", inner.0, graph.resources.len());
        }
    }
    initial(graph, findings);
}

fn declarations(graph: &Graph, findings: &mut Findings) {
    for (index, fluent) in graph.fluents.iter().enumerate() {
        fluent.params.iter().for_each(|ty| type_known(graph, findings, "fluent", index, ty));
    }
    for (index, measure) in graph.measures.iter().enumerate() {
        measure.params.iter().for_each(|ty| type_known(graph, findings, "measure", index, ty));
        type_known(graph, findings, "measure", index, &measure.result);
    }
    for (index, primitive) in graph.primitives.iter().enumerate() {
        primitive.params.iter().for_each(|param| type_known(graph, findings, "primitive", index, &param.ty));
        primitive.result.iter().for_each(|ty| type_known(graph, findings, "primitive", index, ty));
        for resource in &primitive.uses {
            known(findings, "primitive", index, "resource", resource.0, graph.resources.len());
        }
        for failure in &primitive.fails {
            known(findings, "primitive", index, "failure", failure.0, graph.failures.len());
        }
    }
    for (index, binding) in graph.bindings.iter().enumerate() {
        type_known(graph, findings, "binding", index, &binding.ty);
    }
}

fn initial(graph: &Graph, findings: &mut Findings) {
    for (index, InitialFact { fact, .. }) in graph.initial.iter().enumerate() {
        let Some(fluent) = graph.fluents.get(fact.fluent.index()) else {
            findings.table(
                "initial fact",
                index,
                InvalidReason::NoSuch { what: "fluent", id: fact.fluent.0 },
            );
            continue;
        };
        let (expected, given) = (fluent.params.len(), fact.args.len());
        if expected != given {
            let of = fluent.name.clone();
            findings.table("initial fact", index, InvalidReason::Arity { of, expected, given });
        }
        for (place, (arg, ty)) in fact.args.iter().zip(&fluent.params).enumerate() {
            match arg {
                FactArg::Any => {}
                FactArg::Term(Term::Literal(value)) if value.fits(ty) => {}
                FactArg::Term(Term::Literal(_)) => {
                    let of = fluent.name.clone();
                    findings.table("initial fact", index, InvalidReason::Argument { of, index: place });
                }
                FactArg::Term(_) => findings.table("initial fact", index, InvalidReason::NotGround),
            }
        }
    }
}

fn type_known(graph: &Graph, findings: &mut Findings, table: &str, index: usize, ty: &Type) {
    let mut inner = ty;
    let mut depth = 0;
    while let Type::List(item) = inner {
        inner = item;
        depth += 1;
        if depth > MAX_TERM_DEPTH {
            let reason =
                InvalidReason::TooMany { what: "levels of a type", count: depth, limit: MAX_TERM_DEPTH };
            findings.table(table, index, reason);
            return;
        }
    }
    if let Type::Entity(kind) = inner {
        known(findings, table, index, "kind", kind.0, graph.kinds.len());
    }
}

fn known(findings: &mut Findings, table: &str, index: usize, what: &'static str, id: u32, len: usize) {
    if id as usize >= len {
        findings.table(table, index, InvalidReason::NoSuch { what, id });
    }
}
