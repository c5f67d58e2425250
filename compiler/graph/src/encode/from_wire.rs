//! From what was read to the model. Whether ids name something is checked later.

use super::wire as w;
use crate::model as m;
use smol_str::SmolStr;

/// The graph of a document.
pub(super) fn graph(document: w::Document) -> m::Graph {
    m::Graph {
        policy: SmolStr::new(document.policy),
        robot: SmolStr::new(document.robot),
        kinds: list(document.kinds, |kind| m::Kind {
            name: text(kind.name),
            parent: kind.parent.map(m::KindId),
        }),
        fluents: list(document.fluents, |fluent| m::Fluent {
            name: text(fluent.name),
            params: list(fluent.params, ty),
            observable: fluent.observable,
        }),
        measures: list(document.measures, |measure| m::Measure {
            name: text(measure.name),
            params: list(measure.params, ty),
            result: ty(measure.result),
        }),
        primitives: list(document.primitives, |primitive| m::Primitive {
            name: text(primitive.name),
            params: list(primitive.params, |param| (text(param.name), ty(param.ty))),
            result: primitive.result.map(ty),
            perceives: primitive.perceives,
            uses: list(primitive.uses, m::ResourceId),
            fails: list(primitive.fails, m::FailureId),
        }),
        failures: list(document.failures, text),
        resources: list(document.resources, |resource| m::Resource {
            name: text(resource.name),
            contains: list(resource.contains, m::ResourceId),
        }),
        bindings: list(document.bindings, |binding| m::Binding {
            name: text(binding.name),
            ty: ty(binding.ty),
            given: binding.given,
        }),
        regions: list(document.regions, |region| m::Region {
            owner: region.owner.map(m::NodeId),
            entry: region.entry.map(m::NodeId),
        }),
        nodes: list(document.nodes, node),
        initial: list(document.initial, |known| (fact(known.fact), known.value)),
        observe_within_secs: document.observe_within,
        duration: bounds(document.duration),
    }
}

fn list<A, B>(items: Vec<A>, convert: impl FnMut(A) -> B) -> Vec<B> {
    items.into_iter().map(convert).collect()
}

fn text(text: String) -> SmolStr {
    SmolStr::from(text)
}

fn bounds([least_secs, greatest_secs]: [f64; 2]) -> m::DurationBounds {
    m::DurationBounds { least_secs, greatest_secs }
}

fn ty(of: w::Type) -> m::Type {
    match of {
        w::Type::Bool => m::Type::Bool,
        w::Type::Int => m::Type::Int,
        w::Type::Number => m::Type::Number,
        w::Type::Quantity(name) => m::Type::Quantity(text(name)),
        w::Type::Text => m::Type::Text,
        w::Type::Pose => m::Type::Pose,
        w::Type::Entity(kind) => m::Type::Entity(m::KindId(kind)),
        w::Type::Case(name) => m::Type::Case(text(name)),
        w::Type::List(inner) => m::Type::List(Box::new(ty(*inner))),
    }
}

impl From<w::Value> for m::Value {
    fn from(of: w::Value) -> Self {
        match of {
            w::Value::Bool(value) => Self::Bool(value),
            w::Value::Int(value) => Self::Int(value),
            w::Value::Number(value) => Self::Number(value.0),
            w::Value::Text(value) => Self::Text(text(value)),
            w::Value::Entity(id) => Self::Entity(text(id)),
            w::Value::Case(name) => Self::Case(text(name)),
            w::Value::Pose { xyz, quaternion } => Self::Pose(m::Pose {
                xyz: xyz.map(|number| number.0),
                quaternion: quaternion.map(|number| number.0),
            }),
            w::Value::List(items) => Self::List(list(items, Self::from)),
        }
    }
}

fn node(node: w::Node) -> m::Node {
    m::Node {
        path: text(node.path),
        region: m::RegionId(node.region),
        next: node.next.map(m::NodeId),
        duration: bounds(node.duration),
        kind: kind(node.kind),
    }
}

fn kind(kind: w::NodeKind) -> m::NodeKind {
    match kind {
        w::NodeKind::Call(of) => m::NodeKind::Call(call(*of)),
        w::NodeKind::Sequence { name, body } => {
            m::NodeKind::Sequence { name: text(name), body: m::RegionId(body) }
        }
        w::NodeKind::Inline { policy, body } => {
            m::NodeKind::Inline { policy: text(policy), body: m::RegionId(body) }
        }
        w::NodeKind::If { condition: test, then, otherwise } => m::NodeKind::If {
            condition: condition(test),
            then: m::RegionId(then),
            otherwise: otherwise.map(m::RegionId),
        },
        w::NodeKind::Wait { condition: test, within } => {
            m::NodeKind::Wait { condition: condition(test), within_secs: within }
        }
        w::NodeKind::Monitor { watches, body } => {
            m::NodeKind::Monitor { watches: list(watches, watch), body: m::RegionId(body) }
        }
        w::NodeKind::Try { body, handlers } => m::NodeKind::Try {
            body: m::RegionId(body),
            handlers: list(handlers, |handler| m::Handler {
                on: handler.on.map(|on| list(on, m::FailureId)),
                body: m::RegionId(handler.body),
            }),
        },
        w::NodeKind::Repeat { times, body, until } => {
            m::NodeKind::Repeat { times, body: m::RegionId(body), until: until.map(condition) }
        }
        w::NodeKind::Each { item, list, at_most, body } => {
            m::NodeKind::Each { item: m::BindingId(item), list: term(list), at_most, body: m::RegionId(body) }
        }
        w::NodeKind::Parallel { branches } => m::NodeKind::Parallel { branches: list(branches, m::RegionId) },
        w::NodeKind::End(of) => {
            let (how, of, why) = end(of);
            m::NodeKind::End { how, of, why }
        }
    }
}

fn end(end: w::End) -> (m::Ending, Option<m::NodeId>, Option<m::Term>) {
    let how = match end.how {
        w::Ending::Done => m::Ending::Done,
        w::Ending::Fail => m::Ending::Fail,
        w::Ending::Replan => m::Ending::Replan,
    };
    (how, end.of.map(m::NodeId), end.why.map(term))
}

fn call(call: w::Call) -> m::CallNode {
    m::CallNode {
        primitive: m::PrimitiveId(call.primitive),
        args: list(call.args, term),
        binds: call.binds.map(m::BindingId),
        deadline_secs: call.deadline,
        retries: call.retries,
        needs: list(call.needs, |need| m::Need {
            condition: condition(need.condition),
            when: need.when.map(condition),
            each: need.each.map(m::KindId),
            verdict: verdict(need.verdict),
            failure: m::FailureId(need.failure),
        }),
        motion: call.motion.map(|motion| m::Motion {
            query: text(motion.query),
            args: list(motion.args, term),
            verdict: verdict(motion.verdict),
            witness: motion.witness.map(|found| Box::new(witness(*found))),
            why: motion.why.map(text),
        }),
        effects: list(call.effects, |effect| m::CallEffect {
            fact: fact(effect.fact),
            value: effect.value,
            when: effect.when.map(condition),
            each: effect.each.map(m::KindId),
        }),
        unsettles: list(call.unsettles, |unsettled| m::Unsettled {
            fact: fact(unsettled.fact),
            when: unsettled.when.map(condition),
            each: unsettled.each.map(m::KindId),
        }),
    }
}

fn witness(witness: w::Witness) -> m::Witness {
    m::Witness {
        joints: list(witness.joints, text),
        path: list(witness.path, |at| m::Waypoint { base: at.base, joints: at.joints }),
        grasp: witness.grasp.map(|grasp| m::Grasp {
            xyz: grasp.xyz,
            quaternion: grasp.quaternion,
            width: grasp.width,
        }),
        clearance: witness.clearance,
        limit: witness.limit,
        payload: witness.payload,
    }
}

fn verdict(verdict: w::Verdict) -> m::Verdict {
    match verdict {
        w::Verdict::Proven => m::Verdict::Proven,
        w::Verdict::Deferred => m::Verdict::Deferred,
    }
}

fn watch(watch: w::Watch) -> m::Watch {
    let reaction = match watch.reaction {
        w::Reaction::Pause { within } => m::Reaction::Pause { within_secs: within },
        w::Reaction::Restart { at_most } => m::Reaction::Restart { at_most },
        w::Reaction::Resume { at_most, body } => m::Reaction::Resume { at_most, body: m::RegionId(body) },
        w::Reaction::End(of) => {
            let (how, of, why) = end(of);
            m::Reaction::End { how, of, why }
        }
    };
    m::Watch { condition: condition(watch.condition), hold_secs: watch.hold, reaction }
}

fn fact(fact: w::Fact) -> m::Fact {
    let args = list(fact.args, |arg| match arg {
        w::FactArg::Term(of) => m::FactArg::Term(term(of)),
        w::FactArg::Any => m::FactArg::Any,
    });
    m::Fact { fluent: m::FluentId(fact.fluent), args }
}

fn condition(of: w::Condition) -> m::Condition {
    match of {
        w::Condition::Literal(value) => m::Condition::Literal(value),
        w::Condition::Fact(of) => m::Condition::Fact(fact(of)),
        w::Condition::Compare(of, left, right) => {
            let comparison = match of {
                w::Comparison::Equal => m::Comparison::Equal,
                w::Comparison::Unequal => m::Comparison::Unequal,
                w::Comparison::Less => m::Comparison::Less,
                w::Comparison::AtMost => m::Comparison::AtMost,
                w::Comparison::More => m::Comparison::More,
                w::Comparison::AtLeast => m::Comparison::AtLeast,
            };
            m::Condition::Compare(comparison, term(left), term(right))
        }
        w::Condition::Not(inner) => m::Condition::Not(Box::new(condition(*inner))),
        w::Condition::All(parts) => m::Condition::All(list(parts, condition)),
        w::Condition::Any(parts) => m::Condition::AnyOf(list(parts, condition)),
    }
}

fn term(of: w::Term) -> m::Term {
    match of {
        w::Term::Literal(of) => m::Term::Literal(of.into()),
        w::Term::Binding(id) => m::Term::Binding(m::BindingId(id)),
        w::Term::Each => m::Term::Each,
        w::Term::Field(of, field) => m::Term::Field(Box::new(term(*of)), text(field)),
        w::Term::Measure(id, args) => m::Term::Measure(m::MeasureId(id), list(args, term)),
        w::Term::List(items) => m::Term::List(list(items, term)),
        w::Term::Arith(of, left, right) => {
            let operation = match of {
                w::Arithmetic::Add => m::Arithmetic::Add,
                w::Arithmetic::Subtract => m::Arithmetic::Subtract,
                w::Arithmetic::Multiply => m::Arithmetic::Multiply,
                w::Arithmetic::Divide => m::Arithmetic::Divide,
            };
            m::Term::Arith(operation, Box::new(term(*left)), Box::new(term(*right)))
        }
    }
}
