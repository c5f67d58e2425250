//! Contracts of calls as functions of a script, and the declarations at its end.

use std::collections::BTreeMap;

use serde_json::json;

use super::term::quoted;
use super::writer::{Writer, identifier};
use crate::model::{
    CallEffect, CallNode, Condition, Fact, FactArg, KindId, Need, Node, NodeId, ResourceId, Term, TextPart,
    Unsettled, Verdict,
};

/// Name of the result of a call in its own contract.
const RESULT: &str = "RESULT";

impl Writer<'_> {
    /// Writes the function that gives the contract of a call, and returns the call of it; none without one.
    pub(super) fn contract(&mut self, id: NodeId, node: &Node, call: &CallNode) -> Option<String> {
        if call.needs.is_empty()
            && call.effects.is_empty()
            && call.unsettles.is_empty()
            && call.motion.is_none()
        {
            return None;
        }
        let primitive = self.graph.primitives.get(call.primitive.index());
        let primitive = identifier(primitive.map_or("call", |primitive| &primitive.name));
        let name = format!("contract_{}_{primitive}", id.0);
        // What the call itself binds has no value before it ends.
        let own = call.binds.and_then(|binding| self.names.get_mut(binding.index()));
        let own = own.map(|name| std::mem::replace(name, RESULT.to_owned()));
        let params: Vec<String> = self.used(call).into_iter().filter(|name| name != RESULT).collect();
        let params = params.join(", ");
        let parts: [(&str, Vec<String>); 3] = [
            ("needs", call.needs.iter().map(|need| self.need(need)).collect()),
            ("makes", call.effects.iter().map(|effect| self.effect(effect)).collect()),
            ("unsettles", call.unsettles.iter().map(|one| self.unsettled(one)).collect()),
        ];
        let mut text = format!(
            "\n\ndef {name}({params}) -> Contract:\n    # {}\n    return Contract(\n",
            quoted(&node.path)
        );
        for (part, entries) in parts.into_iter().filter(|(_, entries)| !entries.is_empty()) {
            let entries: String = entries.iter().map(|entry| format!("            {entry},\n")).collect();
            text.push_str(&format!("        {part}=(\n{entries}        ),\n"));
        }
        if let Some(lifetime) = &call.lasts {
            let named = |id: &ResourceId| self.graph.resources.get(id.index()).map(|it| quoted(&it.name));
            let uses: String = lifetime.uses.iter().filter_map(named).map(|it| it + ", ").collect();
            let of: String = lifetime.entities.iter().map(|it| self.term(it, None) + ", ").collect();
            for (part, entries) in [("until_used", uses), ("until_moved", of)] {
                if !entries.is_empty() {
                    text.push_str(&format!("        {part}=({}),\n", entries.trim_end()));
                }
            }
        }
        if let Some(motion) = &call.motion {
            let verdict = match motion.verdict {
                Verdict::Proven => "proven",
                Verdict::Deferred => "open",
            };
            let mut found = json!({"query": motion.query, "verdict": verdict});
            for (key, value) in [("witness", json!(motion.witness)), ("why", json!(motion.why))] {
                if !value.is_null()
                    && let Some(found) = found.as_object_mut()
                {
                    found.insert(key.to_owned(), value);
                }
            }
            self.motions.push((node.path.clone(), json!([found, motion.leaves]).to_string()));
            let args: String = motion.args.iter().map(|arg| format!("{}, ", self.term(arg, None))).collect();
            text.push_str(&format!("        planned=planned({}, ({args})),\n", quoted(&node.path)));
        }
        text.push_str("    )\n");
        self.contracts.push_str(&text);
        if let Some((binding, own)) = call.binds.zip(own)
            && let Some(name) = self.names.get_mut(binding.index())
        {
            *name = own;
        }
        Some(format!("{name}({params})"))
    }

    fn need(&mut self, need: &Need) -> String {
        let failure = self.graph.failures.get(need.failure.index()).map_or("", |name| name);
        let mut text = format!("Need({}, {}", self.condition(&need.condition), quoted(failure));
        text.push_str(&self.quantifier(need.when.as_ref(), need.each));
        text.push_str(if need.verdict == Verdict::Proven { ", proven=True)" } else { ")" });
        text
    }

    fn effect(&mut self, effect: &CallEffect) -> String {
        let fact = self.fact(&effect.fact);
        let fact = if effect.value { fact } else { format!("no({fact})") };
        format!("Entry({fact}{})", self.quantifier(effect.when.as_ref(), effect.each))
    }

    fn unsettled(&mut self, unsettled: &Unsettled) -> String {
        let fact = self.fact(&unsettled.fact);
        format!("Entry({fact}{})", self.quantifier(unsettled.when.as_ref(), unsettled.each))
    }

    fn quantifier(&mut self, when: Option<&Condition>, each: Option<KindId>) -> String {
        let when = when.map(|when| format!(", when={}", self.condition(when))).unwrap_or_default();
        let each = each.and_then(|kind| self.graph.kinds.get(kind.index()));
        when + &each.map(|kind| format!(", each={}", quoted(&kind.name))).unwrap_or_default()
    }

    /// Names of the bindings that a contract speaks of, in the order of the graph.
    fn used(&self, call: &CallNode) -> Vec<String> {
        let mut used = vec![false; self.names.len()];
        let needs = call.needs.iter().flat_map(|need| need.when.iter().chain([&need.condition]));
        let whens = call.effects.iter().filter_map(|effect| effect.when.as_ref());
        let whens = whens.chain(call.unsettles.iter().filter_map(|one| one.when.as_ref()));
        needs.chain(whens).for_each(|part| in_condition(part, &mut used));
        let facts = call.effects.iter().map(|effect| &effect.fact);
        facts.chain(call.unsettles.iter().map(|one| &one.fact)).for_each(|fact| in_fact(fact, &mut used));
        let motions = call.motion.iter().flat_map(|motion| &motion.args);
        let entities = call.lasts.iter().flat_map(|lifetime| &lifetime.entities);
        motions.chain(entities).for_each(|arg| in_term(arg, &mut used));
        self.names.iter().zip(used).filter(|(_, is_used)| *is_used).map(|(name, _)| name.clone()).collect()
    }

    /// The whole script.
    pub(super) fn finish(mut self) -> String {
        let graph = self.graph;
        let goal: Vec<String> = graph.goal.iter().map(|part| self.condition(part)).collect();
        let known: Vec<String> = graph
            .initial
            .iter()
            .map(|initial| {
                let fact = self.fact(&initial.fact);
                if initial.value { fact } else { format!("no({fact})") }
            })
            .collect();
        let title = quoted(&format!("Policy {} for {}.", graph.policy, graph.robot));
        let mut text = format!(
            "{title}\n\n\
             # Written by `motet compile --emit python`. Run it with `python FILE MODULE:CLASS`.\n\n\
             import json\n\n\
             from motet import ANY, Case, Entity, Failed, Pose, Text\n\
             from motet.belief import EACH, RESULT, all_of, any_of, arith, compare, count, fact\n\
             from motet.belief import field, first, measure, no, said\n\
             from motet.script import Contract, Entry, Need, Planned, Robot, Script, main\n\n\n\
             async def {}(robot: Robot):\n{}",
            self.name, self.steps
        );
        text.push_str(&self.contracts);
        if !self.motions.is_empty() {
            text.push_str(
                "\n\ndef planned(step: str, args: tuple) -> Planned:\n    \
                 motion, leaves = json.loads(MOTIONS[step])\n    return Planned(motion, args, leaves)\n\n\n\
                 MOTIONS = {\n",
            );
            for (path, motion) in &self.motions {
                text.push_str(&format!("    {}: {},\n", quoted(path), quoted(motion)));
            }
            text.push_str("}\n");
        }
        text + &self.declarations(&known, &goal)
    }

    fn declarations(&self, known: &[String], goal: &[String]) -> String {
        let graph = self.graph;
        let tuple = |parts: &[String]| parts.iter().map(|part| format!("{part}, ")).collect::<String>();
        let kind_name = |id: KindId| graph.kinds.get(id.index()).map(|kind| quoted(&kind.name));
        let kinds = graph.kinds.iter().map(|kind| {
            let parent = kind.parent.and_then(kind_name).unwrap_or_else(|| "None".to_owned());
            format!("{}: {parent}", quoted(&kind.name))
        });
        let entities = self
            .entities
            .iter()
            .filter_map(|(id, kind)| Some(format!("{}: {}", quoted(id), kind_name(*kind)?)));
        let observable = graph.fluents.iter().filter(|fluent| fluent.observable);
        let observable: Vec<String> = observable.map(|fluent| quoted(&fluent.name)).collect();
        let names: BTreeMap<_, _> = graph.names.iter().map(|name| (&name.entity, &name.name)).collect();
        let sentences = graph
            .sentences
            .iter()
            .filter_map(|sentence| Some((graph.failures.get(sentence.failure.index())?, &sentence.text)));
        let sentences: BTreeMap<_, _> = sentences.collect();
        let primitives: BTreeMap<_, _> = graph
            .primitives
            .iter()
            .map(|primitive| {
                let failures = primitive.fails.iter().filter_map(|id| graph.failures.get(id.index()));
                let uses = primitive.uses.iter().filter_map(|id| graph.resources.get(id.index()));
                let uses: Vec<_> = uses.map(|resource| &resource.name).collect();
                let mut declared = json!({"fails": failures.collect::<Vec<_>>(), "uses": uses});
                if let (Some(result), Some(declared)) = (&primitive.result, declared.as_object_mut()) {
                    declared.insert("result".to_owned(), graph.type_name(result).into());
                }
                if let (true, Some(declared)) = (primitive.perceives, declared.as_object_mut()) {
                    declared.insert("kind".to_owned(), "perception".into());
                }
                (&primitive.name, declared)
            })
            .collect();
        let entry = |name: &str, value: String| format!("    {name}={value},\n");
        let mut text = format!(
            "\n\nSCRIPT = Script(\n    {},\n    {},\n    {},\n",
            quoted(&graph.policy),
            quoted(&graph.robot),
            self.name
        );
        text.push_str(&entry("kinds", format!("{{{}}}", kinds.collect::<Vec<_>>().join(", "))));
        text.push_str(&entry("entities", format!("{{{}}}", entities.collect::<Vec<_>>().join(", "))));
        text.push_str(&entry("names", json!(names).to_string()));
        text.push_str(&entry("observable", format!("({})", tuple(&observable))));
        text.push_str(&entry("known", format!("({})", tuple(known))));
        text.push_str(&entry("goal", format!("({})", tuple(goal))));
        text.push_str(&entry("sentences", json!(sentences).to_string()));
        text.push_str(&entry("primitives", json!(primitives).to_string()));
        text.push_str(&entry("observe_within", format!("{:?}", graph.observe_within_secs)));
        text.push_str(")\n\nif __name__ == \"__main__\":\n    main(SCRIPT)\n");
        text
    }
}

fn in_condition(condition: &Condition, used: &mut [bool]) {
    match condition {
        Condition::Literal(_) => {}
        Condition::Fact(fact) => in_fact(fact, used),
        Condition::Compare(_, left, right) => [left, right].into_iter().for_each(|term| in_term(term, used)),
        Condition::Not(inner) => in_condition(inner, used),
        Condition::All(parts) | Condition::AnyOf(parts) => {
            parts.iter().for_each(|part| in_condition(part, used));
        }
    }
}

fn in_fact(fact: &Fact, used: &mut [bool]) {
    for arg in &fact.args {
        if let FactArg::Term(term) = arg {
            in_term(term, used);
        }
    }
}

fn in_term(term: &Term, used: &mut [bool]) {
    match term {
        Term::Literal(_) | Term::Each => {}
        Term::Binding(id) => {
            if let Some(used) = used.get_mut(id.index()) {
                *used = true;
            }
        }
        Term::Field(of, _) | Term::Count(of) | Term::First(of) => in_term(of, used),
        Term::Measure(_, args) | Term::List(args) => args.iter().for_each(|arg| in_term(arg, used)),
        Term::Arith(_, left, right) => [left, right].into_iter().for_each(|term| in_term(term, used)),
        Term::Template(parts) => {
            for part in parts {
                if let TextPart::Value(value, _) = part {
                    in_term(value, used);
                }
            }
        }
    }
}
