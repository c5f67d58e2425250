//! The text form of the model subset: one line, one space between words and around braces, `when` always in braces, no
//! `else if`, groups of conditions in parentheses.

use motet_syntax::ast::EndKind;
use motet_syntax::print::identifier;
use motet_syntax::unit::Unit;
use smol_str::SmolStr;

use crate::subset::{Call, Condition, Decimal, Document, End, Reaction, Step, Subject, Value, When};

pub(super) fn print(document: &Document) -> String {
    let mut out = String::new();
    put(&mut out, &["policy ", &document.name]);
    if let Some(robot) = &document.robot {
        put(&mut out, &[" for ", &identifier(robot)]);
    }
    if let Some(goal) = &document.achieves {
        out.push_str(" achieves ");
        condition(&mut out, goal);
    }
    out.push(' ');
    block(&mut out, &document.steps);
    out
}

fn put(out: &mut String, parts: &[&str]) {
    parts.iter().for_each(|part| out.push_str(part));
}

fn block(out: &mut String, steps: &[Step]) {
    out.push('{');
    for step in steps {
        out.push(' ');
        self::step(out, step);
    }
    out.push_str(" }");
}

fn step(out: &mut String, step: &Step) {
    match step {
        Step::Do(call) => self::call(out, call),
        Step::Sequence(name, steps) => {
            put(out, &["sequence ", name, " "]);
            block(out, steps);
        }
        Step::If(test, then, otherwise) => {
            out.push_str("if ");
            condition(out, test);
            out.push(' ');
            block(out, then);
            if !otherwise.is_empty() {
                out.push_str(" else ");
                block(out, otherwise);
            }
        }
        Step::Wait(test, within) => {
            out.push_str("wait until ");
            condition(out, test);
            seconds(out, " within ", *within);
        }
        Step::Monitor(whens, steps) => {
            out.push_str("monitor {");
            for when in whens {
                out.push(' ');
                self::when(out, when);
            }
            out.push_str(" } during ");
            block(out, steps);
        }
        Step::Try(steps, catches) => {
            out.push_str("try ");
            block(out, steps);
            for catch in catches {
                out.push_str(" catch ");
                match catch.on.as_slice() {
                    [] => out.push_str("any"),
                    kinds => {
                        let kinds: Vec<_> = kinds.iter().map(|kind| identifier(kind)).collect();
                        out.push_str(&kinds.join(", "));
                    }
                }
                out.push(' ');
                block(out, &catch.steps);
            }
        }
        Step::Repeat(times, steps, until) => {
            put(out, &["repeat ", &times.to_string(), " "]);
            block(out, steps);
            if let Some(until) = until {
                out.push_str(" until ");
                condition(out, until);
            }
        }
        Step::Each { item, list, at_most, steps } => {
            put(out, &["each ", item, " in "]);
            value(out, list);
            put(out, &[" at most ", &at_most.to_string(), " "]);
            block(out, steps);
        }
        Step::Parallel(branches) => {
            out.push_str("parallel {");
            for branch in branches {
                out.push(' ');
                block(out, branch);
            }
            out.push_str(" }");
        }
        Step::End(end) => self::end(out, end),
    }
}

fn call(out: &mut String, call: &Call) {
    if let Some(bind) = &call.bind {
        put(out, &["let ", bind, " = "]);
    }
    applied(out, &call.name, &call.args);
    seconds(out, " within ", call.within);
    if let Some(retry) = call.retry {
        put(out, &[" retry ", &retry.to_string()]);
    }
}

fn seconds(out: &mut String, word: &str, time: Option<Decimal>) {
    if let Some(time) = time {
        put(out, &[word, &time.to_string(), " s"]);
    }
}

fn when(out: &mut String, when: &When) {
    out.push_str("when ");
    condition(out, &when.condition);
    seconds(out, " for ", when.hold);
    out.push_str(" then ");
    match &when.reaction {
        Reaction::Pause(within) => {
            out.push_str("pause");
            seconds(out, " within ", *within);
        }
        Reaction::Restart(at_most) => put(out, &["restart at most ", &at_most.to_string()]),
        Reaction::Resume(at_most, steps) => {
            put(out, &["resume at most ", &at_most.to_string(), " "]);
            block(out, steps);
        }
        Reaction::End(end) => self::end(out, end),
    }
}

fn end(out: &mut String, end: &End) {
    out.push_str(match end.kind {
        EndKind::Done => "done",
        EndKind::Fail => "fail",
        EndKind::Replan => "replan",
    });
    if let Some(why) = &end.why {
        out.push(' ');
        value(out, why);
    }
}

/// A condition where nothing binds around it.
fn condition(out: &mut String, condition: &Condition) {
    match condition {
        Condition::Is(fluent, args) => applied(out, fluent, args),
        Condition::Not(inner) => {
            out.push_str("not ");
            match &**inner {
                Condition::Is(..) | Condition::Not(_) => self::condition(out, inner),
                Condition::All(_) | Condition::Any(_) | Condition::Compare(..) => grouped(out, inner),
            }
        }
        Condition::All(parts) => joined(out, parts, " and "),
        Condition::Any(parts) => joined(out, parts, " or "),
        Condition::Compare(subject, relation, with) => {
            match subject {
                Subject::Measure(name, args) => applied(out, name, args),
                Subject::Field(name, of) => {
                    value(out, of);
                    put(out, &[".", &identifier(name)]);
                }
            }
            put(out, &[" ", relation.symbol(), " "]);
            value(out, with);
        }
    }
}

fn joined(out: &mut String, parts: &[Condition], word: &str) {
    for (index, part) in parts.iter().enumerate() {
        if index > 0 {
            out.push_str(word);
        }
        match part {
            Condition::Is(..) | Condition::Not(_) | Condition::Compare(..) => condition(out, part),
            Condition::All(_) | Condition::Any(_) => grouped(out, part),
        }
    }
}

fn grouped(out: &mut String, inner: &Condition) {
    out.push('(');
    condition(out, inner);
    out.push(')');
}

fn applied(out: &mut String, name: &str, args: &[(SmolStr, Value)]) {
    put(out, &[&identifier(name), "("]);
    values(out, args.iter().map(|(_, value)| value));
    out.push(')');
}

fn values<'v>(out: &mut String, values: impl Iterator<Item = &'v Value>) {
    for (index, value) in values.enumerate() {
        if index > 0 {
            out.push_str(", ");
        }
        self::value(out, value);
    }
}

fn value(out: &mut String, value: &Value) {
    match value {
        Value::Binding(name) => out.push_str(name),
        Value::Name(name) => out.push_str(&identifier(name)),
        Value::Number(number, None) => out.push_str(&number.to_string()),
        Value::Number(number, Some(Unit::Percent)) => put(out, &[&number.percent().to_string(), " %"]),
        Value::Number(number, Some(unit)) => put(out, &[&number.to_string(), " ", unit.symbol()]),
        // The subset has no text that needs an escape.
        Value::Text(text) => put(out, &["\"", text, "\""]),
        Value::Bool(value) => out.push_str(if *value { "true" } else { "false" }),
        Value::Any => out.push_str("any"),
        Value::List(items) => {
            out.push('[');
            values(out, items.iter());
            out.push(']');
        }
    }
}
