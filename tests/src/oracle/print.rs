//! Domains and policies in the text form.

use std::fmt::Write as _;

use super::make::{Arg, Atom, Domain, Kind, Literal, Policy, Step};

fn word(kind: Kind) -> &'static str {
    match kind {
        Kind::Slipped => "slipped",
        Kind::Blocked => "blocked",
        Kind::Timeout => "timeout",
        Kind::Exhausted => "exhausted",
    }
}

fn atom(atom: &Atom) -> String {
    let args: Vec<_> = atom
        .args
        .iter()
        .map(|arg| match arg {
            Arg::Param => "x".to_owned(),
            Arg::Entity(entity) => format!("e{entity}"),
            Arg::Any => "any".to_owned(),
        })
        .collect();
    format!("f{}({})", atom.fluent, args.join(", "))
}

fn literal(literal: &Literal) -> String {
    format!("{}{}", if literal.truth { "" } else { "not " }, atom(&literal.atom))
}

/// A domain as declarations.
#[must_use]
pub fn domain_text(domain: &Domain) -> String {
    let mut out = String::new();
    if domain.is_closed {
        out.push_str("closed world\n");
    }
    let names: Vec<_> = (0..domain.entities).map(|entity| format!("e{entity}")).collect();
    let _ = writeln!(out, "entity {}: Object", names.join(", "));
    for (fluent, arity) in domain.arities.iter().enumerate() {
        let params: Vec<_> = (0..*arity).map(|index| format!("p{index}: Object")).collect();
        let _ = writeln!(out, "fluent f{fluent}({})", params.join(", "));
    }
    let list = |items: Vec<String>| items.join(", ");
    for (index, action) in domain.actions.iter().enumerate() {
        let _ = writeln!(out, "action a{index}({})", if action.has_param { "x: Object" } else { "" });
        let clause = |out: &mut String, name: &str, items: Vec<String>| {
            if !items.is_empty() {
                let _ = writeln!(out, "    {name} {}", list(items));
            }
        };
        clause(&mut out, "needs", action.needs.iter().map(literal).collect());
        let makes = action.makes.iter().map(|effect| match &effect.when {
            Some(when) => format!("{} when {}", literal(&effect.literal), literal(when)),
            None => literal(&effect.literal),
        });
        clause(&mut out, "makes", makes.collect());
        clause(&mut out, "unsettles", action.unsettles.iter().map(atom).collect());
        clause(&mut out, "fails", action.fails.iter().map(|kind| word(*kind).to_owned()).collect());
    }
    let start: Vec<_> = domain
        .start
        .iter()
        .map(|(known, truth)| literal(&Literal { atom: known.clone(), truth: *truth }))
        .collect();
    if !start.is_empty() {
        let _ = writeln!(out, "initially {}", list(start));
    }
    out
}

/// A policy.
#[must_use]
pub fn policy_text(domain: &Domain, policy: &Policy) -> String {
    let mut out = "policy p {\n".to_owned();
    let mut groups = 0;
    block(domain, policy, &mut groups, &mut out);
    out.push_str("}\n");
    out
}

fn block(domain: &Domain, steps: &[Step], groups: &mut usize, out: &mut String) {
    for step in steps {
        print(domain, step, groups, out);
    }
}

fn call(domain: &Domain, action: usize, entity: usize) -> String {
    let has_param = domain.actions.get(action).is_some_and(|action| action.has_param);
    if has_param { format!("a{action}(e{entity})") } else { format!("a{action}()") }
}

fn print(domain: &Domain, step: &Step, groups: &mut usize, out: &mut String) {
    match step {
        Step::Call { action, entity, retry } => {
            let _ = write!(out, "{}", call(domain, *action, *entity));
            if *retry > 0 {
                let _ = write!(out, " retry {retry}");
            }
            out.push('\n');
        }
        Step::Sequence(body) => {
            *groups += 1;
            let _ = writeln!(out, "sequence s{groups} {{");
            block(domain, body, groups, out);
            out.push_str("}\n");
        }
        Step::Finally(body, cleanup) => {
            *groups += 1;
            let _ = writeln!(out, "sequence s{groups} {{");
            block(domain, body, groups, out);
            out.push_str("} finally {\n");
            block(domain, cleanup, groups, out);
            out.push_str("}\n");
        }
        Step::If(test, then, otherwise) => {
            let _ = writeln!(out, "if {} {{", literal(test));
            block(domain, then, groups, out);
            out.push_str("} else {\n");
            block(domain, otherwise, groups, out);
            out.push_str("}\n");
        }
        Step::Try(body, handlers) => {
            out.push_str("try {\n");
            block(domain, body, groups, out);
            for (on, handler) in handlers {
                let on: Vec<_> = on.iter().flatten().map(|kind| word(*kind)).collect();
                let on = if on.is_empty() { "any".to_owned() } else { on.join(", ") };
                let _ = writeln!(out, "}} catch {on} {{");
                block(domain, handler, groups, out);
            }
            out.push_str("}\n");
        }
        Step::Repeat(times, body, until) => {
            let _ = writeln!(out, "repeat {times} {{");
            block(domain, body, groups, out);
            match until {
                Some(until) => {
                    let _ = writeln!(out, "}} until {}", literal(until));
                }
                None => out.push_str("}\n"),
            }
        }
        Step::Resume(body, at_most, reaction) => {
            let _ = writeln!(out, "monitor when battery() < 20 % for 1 s then resume at most {at_most} {{");
            block(domain, reaction, groups, out);
            out.push_str("} during {\n");
            block(domain, body, groups, out);
            out.push_str("}\n");
        }
        Step::Parallel(branches) => {
            out.push_str("parallel {\n");
            for branch in branches {
                let calls: Vec<_> =
                    branch.iter().map(|(action, entity)| call(domain, *action, *entity)).collect();
                let _ = writeln!(out, "{{ {} }}", calls.join("\n"));
            }
            out.push_str("}\n");
        }
        Step::End(done) => out.push_str(if *done { "done\n" } else { "fail \"no\"\n" }),
    }
}
