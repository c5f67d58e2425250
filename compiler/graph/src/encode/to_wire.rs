//! From the model to what is written.

use super::wire as w;
use crate::model as m;
use smol_str::SmolStr;

/// The document of a graph, with an empty hash.
pub(super) fn document(graph: &m::Graph) -> w::Document {
    w::Document {
        motet_graph: super::VERSION,
        hash: String::new(),
        policy: graph.policy.to_string(),
        robot: graph.robot.to_string(),
        kinds: list(&graph.kinds, |kind| w::Kind {
            name: text(&kind.name),
            parent: kind.parent.map(|id| id.0),
        }),
        fluents: list(&graph.fluents, |fluent| w::Fluent {
            name: text(&fluent.name),
            params: list(&fluent.params, ty),
            observable: fluent.observable,
        }),
        measures: list(&graph.measures, |measure| w::Measure {
            name: text(&measure.name),
            params: list(&measure.params, ty),
            result: ty(&measure.result),
        }),
        primitives: list(&graph.primitives, |primitive| w::Primitive {
            name: text(&primitive.name),
            params: list(&primitive.params, |(name, of)| w::Param { name: text(name), ty: ty(of) }),
            result: primitive.result.as_ref().map(ty),
            perceives: primitive.perceives,
            uses: list(&primitive.uses, |id| id.0),
            fails: list(&primitive.fails, |id| id.0),
        }),
        failures: list(&graph.failures, text),
        resources: list(&graph.resources, |resource| w::Resource {
            name: text(&resource.name),
            contains: list(&resource.contains, |id| id.0),
        }),
        bindings: list(&graph.bindings, |binding| w::Binding {
            name: text(&binding.name),
            ty: ty(&binding.ty),
            given: binding.given,
        }),
        regions: list(&graph.regions, |region| w::Region {
            owner: region.owner.map(|id| id.0),
            entry: region.entry.map(|id| id.0),
        }),
        nodes: list(&graph.nodes, node),
        initial: list(&graph.initial, |(known, value)| w::Known { fact: fact(known), value: *value }),
        observe_within: graph.observe_within_secs,
        duration: bounds(graph.duration),
    }
}

fn list<A, B>(items: &[A], convert: impl Fn(&A) -> B) -> Vec<B> {
    items.iter().map(convert).collect()
}

fn text(text: &SmolStr) -> String {
    text.to_string()
}

fn bounds(bounds: m::DurationBounds) -> [f64; 2] {
    [bounds.least_secs, bounds.greatest_secs]
}

fn ty(of: &m::Type) -> w::Type {
    match of {
        m::Type::Bool => w::Type::Bool,
        m::Type::Int => w::Type::Int,
        m::Type::Number => w::Type::Number,
        m::Type::Quantity(name) => w::Type::Quantity(text(name)),
        m::Type::Text => w::Type::Text,
        m::Type::Pose => w::Type::Pose,
        m::Type::Entity(kind) => w::Type::Entity(kind.0),
        m::Type::Case(name) => w::Type::Case(text(name)),
        m::Type::List(inner) => w::Type::List(Box::new(ty(inner))),
    }
}

impl From<&m::Value> for w::Value {
    fn from(of: &m::Value) -> Self {
        match of {
            m::Value::Bool(value) => Self::Bool(*value),
            m::Value::Int(value) => Self::Int(*value),
            m::Value::Number(value) => Self::Number(w::Float(*value)),
            m::Value::Text(value) => Self::Text(text(value)),
            m::Value::Entity(id) => Self::Entity(text(id)),
            m::Value::Case(name) => Self::Case(text(name)),
            m::Value::Pose(pose) => {
                Self::Pose { xyz: pose.xyz.map(w::Float), quaternion: pose.quaternion.map(w::Float) }
            }
            m::Value::List(items) => Self::List(list(items, |item| Self::from(item))),
        }
    }
}

fn node(node: &m::Node) -> w::Node {
    w::Node {
        path: text(&node.path),
        region: node.region.0,
        next: node.next.map(|id| id.0),
        duration: bounds(node.duration),
        kind: kind(&node.kind),
    }
}

fn kind(kind: &m::NodeKind) -> w::NodeKind {
    match kind {
        m::NodeKind::Call(of) => w::NodeKind::Call(Box::new(call(of))),
        m::NodeKind::Sequence { name, body } => w::NodeKind::Sequence { name: text(name), body: body.0 },
        m::NodeKind::Inline { policy, body } => w::NodeKind::Inline { policy: text(policy), body: body.0 },
        m::NodeKind::If { condition: test, then, otherwise } => {
            w::NodeKind::If { condition: condition(test), then: then.0, otherwise: otherwise.map(|id| id.0) }
        }
        m::NodeKind::Wait { condition: test, within_secs } => {
            w::NodeKind::Wait { condition: condition(test), within: *within_secs }
        }
        m::NodeKind::Monitor { watches, body } => {
            w::NodeKind::Monitor { watches: list(watches, watch), body: body.0 }
        }
        m::NodeKind::Try { body, handlers } => w::NodeKind::Try {
            body: body.0,
            handlers: list(handlers, |handler| w::Handler {
                on: handler.on.as_ref().map(|on| list(on, |id| id.0)),
                body: handler.body.0,
            }),
        },
        m::NodeKind::Repeat { times, body, until } => {
            w::NodeKind::Repeat { times: *times, body: body.0, until: until.as_ref().map(condition) }
        }
        m::NodeKind::Each { item, list, at_most, body } => {
            w::NodeKind::Each { item: item.0, list: term(list), at_most: *at_most, body: body.0 }
        }
        m::NodeKind::Parallel { branches } => w::NodeKind::Parallel { branches: list(branches, |id| id.0) },
        m::NodeKind::End { how, of, why } => w::NodeKind::End(end(*how, *of, why.as_ref())),
    }
}

fn end(how: m::Ending, of: Option<m::NodeId>, why: Option<&m::Term>) -> w::End {
    let how = match how {
        m::Ending::Done => w::Ending::Done,
        m::Ending::Fail => w::Ending::Fail,
        m::Ending::Replan => w::Ending::Replan,
    };
    w::End { how, of: of.map(|id| id.0), why: why.map(term) }
}

fn call(call: &m::CallNode) -> w::Call {
    w::Call {
        primitive: call.primitive.0,
        args: list(&call.args, term),
        binds: call.binds.map(|id| id.0),
        deadline: call.deadline_secs,
        retries: call.retries,
        needs: list(&call.needs, |need| w::Need {
            condition: condition(&need.condition),
            when: need.when.as_ref().map(condition),
            each: need.each.map(|id| id.0),
            verdict: verdict(need.verdict),
            failure: need.failure.0,
        }),
        motion: call.motion.as_ref().map(|motion| w::Motion {
            query: text(&motion.query),
            args: list(&motion.args, term),
            verdict: verdict(motion.verdict),
            witness: motion.witness.as_deref().map(witness).map(Box::new),
            why: motion.why.as_ref().map(text),
        }),
        effects: list(&call.effects, |effect| w::Effect {
            fact: fact(&effect.fact),
            value: effect.value,
            when: effect.when.as_ref().map(condition),
            each: effect.each.map(|id| id.0),
        }),
        unsettles: list(&call.unsettles, |unsettled| w::Unsettled {
            fact: fact(&unsettled.fact),
            when: unsettled.when.as_ref().map(condition),
            each: unsettled.each.map(|id| id.0),
        }),
    }
}

fn witness(witness: &m::Witness) -> w::Witness {
    w::Witness {
        joints: list(&witness.joints, text),
        path: list(&witness.path, |at| w::Waypoint { base: at.base, joints: at.joints.clone() }),
        grasp: witness.grasp.as_ref().map(|grasp| w::Grasp {
            xyz: grasp.xyz,
            quaternion: grasp.quaternion,
            width: grasp.width,
        }),
        clearance: witness.clearance,
        limit: witness.limit,
        payload: witness.payload,
    }
}

fn verdict(verdict: m::Verdict) -> w::Verdict {
    match verdict {
        m::Verdict::Proven => w::Verdict::Proven,
        m::Verdict::Deferred => w::Verdict::Deferred,
    }
}

fn watch(watch: &m::Watch) -> w::Watch {
    let reaction = match &watch.reaction {
        m::Reaction::Pause { within_secs } => w::Reaction::Pause { within: *within_secs },
        m::Reaction::Restart { at_most } => w::Reaction::Restart { at_most: *at_most },
        m::Reaction::Resume { at_most, body } => w::Reaction::Resume { at_most: *at_most, body: body.0 },
        m::Reaction::End { how, of, why } => w::Reaction::End(end(*how, *of, why.as_ref())),
    };
    w::Watch { condition: condition(&watch.condition), hold: watch.hold_secs, reaction }
}

fn fact(fact: &m::Fact) -> w::Fact {
    let args = list(&fact.args, |arg| match arg {
        m::FactArg::Term(of) => w::FactArg::Term(term(of)),
        m::FactArg::Any => w::FactArg::Any,
    });
    w::Fact { fluent: fact.fluent.0, args }
}

fn condition(of: &m::Condition) -> w::Condition {
    match of {
        m::Condition::Literal(value) => w::Condition::Literal(*value),
        m::Condition::Fact(of) => w::Condition::Fact(fact(of)),
        m::Condition::Compare(of, left, right) => {
            let comparison = match of {
                m::Comparison::Equal => w::Comparison::Equal,
                m::Comparison::Unequal => w::Comparison::Unequal,
                m::Comparison::Less => w::Comparison::Less,
                m::Comparison::AtMost => w::Comparison::AtMost,
                m::Comparison::More => w::Comparison::More,
                m::Comparison::AtLeast => w::Comparison::AtLeast,
            };
            w::Condition::Compare(comparison, term(left), term(right))
        }
        m::Condition::Not(inner) => w::Condition::Not(Box::new(condition(inner))),
        m::Condition::All(parts) => w::Condition::All(list(parts, condition)),
        m::Condition::AnyOf(parts) => w::Condition::Any(list(parts, condition)),
    }
}

fn term(of: &m::Term) -> w::Term {
    match of {
        m::Term::Literal(of) => w::Term::Literal(of.into()),
        m::Term::Binding(id) => w::Term::Binding(id.0),
        m::Term::Each => w::Term::Each,
        m::Term::Field(of, field) => w::Term::Field(Box::new(term(of)), text(field)),
        m::Term::Measure(id, args) => w::Term::Measure(id.0, list(args, term)),
        m::Term::List(items) => w::Term::List(list(items, term)),
        m::Term::Arith(of, left, right) => {
            let operation = match of {
                m::Arithmetic::Add => w::Arithmetic::Add,
                m::Arithmetic::Subtract => w::Arithmetic::Subtract,
                m::Arithmetic::Multiply => w::Arithmetic::Multiply,
                m::Arithmetic::Divide => w::Arithmetic::Divide,
            };
            w::Term::Arith(operation, Box::new(term(left)), Box::new(term(right)))
        }
    }
}
