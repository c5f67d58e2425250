//! The JSON form of the model subset: compact, the key that tells a thing first, all keys in one order.

use motet_syntax::ast::EndKind;
use smol_str::SmolStr;

use crate::subset::{
    Call, Catch, Condition, Decimal, Document, End, Modifiers, Reaction, Step, Subject, Subset, Value, When,
};

pub(super) fn print(document: &Document, subset: Subset) -> String {
    let mut printer = Printer { out: String::new(), modifiers: subset.modifiers };
    printer.put("{\"motet\":1,\"policy\":");
    printer.string(&document.name);
    if let Some(robot) = &document.robot {
        printer.put(",\"robot\":");
        printer.string(robot);
    }
    printer.put(",\"achieves\":");
    match &document.achieves {
        Some(goal) => printer.condition(goal),
        None => printer.put("null"),
    }
    printer.put(",\"steps\":");
    printer.steps(&document.steps);
    printer.put("}");
    printer.out
}

struct Printer {
    out: String,
    modifiers: Modifiers,
}

impl Printer {
    fn put(&mut self, text: &str) {
        self.out.push_str(text);
    }

    /// Writes a string that needs no escape. The subset has no other strings, except for names of entities.
    fn string(&mut self, text: &str) {
        // A string always has a JSON form.
        self.out.push_str(&serde_json::to_string(text).unwrap_or_default());
    }

    fn key(&mut self, key: &str) {
        self.put(",");
        self.string(key);
        self.put(":");
    }

    fn list<T>(&mut self, items: &[T], mut item: impl FnMut(&mut Self, &T)) {
        self.put("[");
        for (index, value) in items.iter().enumerate() {
            if index > 0 {
                self.put(",");
            }
            item(self, value);
        }
        self.put("]");
    }

    fn steps(&mut self, steps: &[Step]) {
        self.list(steps, Self::step);
    }

    fn step(&mut self, step: &Step) {
        match step {
            Step::Do(call) => self.call(call),
            Step::Sequence(name, steps) => {
                self.put("{\"sequence\":");
                self.string(name);
                self.put(",\"steps\":");
                self.steps(steps);
            }
            Step::If(condition, then, otherwise) => {
                self.put("{\"if\":");
                self.condition(condition);
                self.put(",\"then\":");
                self.steps(then);
                self.put(",\"else\":");
                self.steps(otherwise);
            }
            Step::Wait(condition, within) => {
                self.put("{\"wait\":");
                self.condition(condition);
                self.modifier("within", *within);
            }
            Step::Monitor(whens, steps) => {
                self.put("{\"monitor\":");
                self.list(whens, Self::when);
                self.put(",\"during\":");
                self.steps(steps);
            }
            Step::Try(steps, catches) => {
                self.put("{\"try\":");
                self.steps(steps);
                self.put(",\"catch\":");
                self.list(catches, Self::catch);
            }
            Step::Repeat(times, steps, until) => {
                self.put(&format!("{{\"repeat\":{times},\"steps\":"));
                self.steps(steps);
                self.put(",\"until\":");
                match until {
                    Some(until) => self.condition(until),
                    None => self.put("null"),
                }
            }
            Step::Each { item, list, at_most, steps } => {
                self.put("{\"each\":");
                self.string(item);
                self.key("in");
                self.value(list);
                self.put(&format!(",\"at_most\":{at_most},\"steps\":"));
                self.steps(steps);
            }
            Step::Parallel(branches) => {
                self.put("{\"parallel\":");
                self.list(branches, |printer, steps| printer.steps(steps));
            }
            Step::End(end) => return self.end(end),
        }
        self.put("}");
    }

    /// A call without its closing brace.
    fn call(&mut self, call: &Call) {
        self.put("{\"do\":");
        self.string(&call.name);
        self.args(&call.args);
        if !call.is_policy {
            self.modifier("within", call.within);
            self.modifier("retry", call.retry);
        }
        if let Some(bind) = &call.bind {
            self.key("as");
            self.string(bind);
        }
    }

    fn modifier(&mut self, key: &str, value: Option<impl ToString>) {
        if self.modifiers == Modifiers::Written {
            self.key(key);
            self.put(&value.map_or_else(|| "null".to_owned(), |value| value.to_string()));
        }
    }

    fn when(&mut self, when: &When) {
        self.put("{\"when\":");
        self.condition(&when.condition);
        self.put(",\"for\":");
        self.put(&when.hold.map_or_else(|| "null".to_owned(), |hold: Decimal| hold.to_string()));
        self.put(",\"then\":");
        match &when.reaction {
            Reaction::Pause(within) => {
                self.put("{\"react\":\"pause\"");
                self.modifier("within", *within);
                self.put("}");
            }
            Reaction::Restart(at_most) => {
                self.put(&format!("{{\"react\":\"restart\",\"at_most\":{at_most}}}"))
            }
            Reaction::Resume(at_most, steps) => {
                self.put(&format!("{{\"react\":\"resume\",\"at_most\":{at_most},\"steps\":"));
                self.steps(steps);
                self.put("}");
            }
            Reaction::End(end) => self.end(end),
        }
        self.put("}");
    }

    fn catch(&mut self, catch: &Catch) {
        self.put("{\"on\":");
        match catch.on.as_slice() {
            [] => self.put("[\"any\"]"),
            kinds => self.list(kinds, |printer, kind| printer.string(kind)),
        }
        self.put(",\"steps\":");
        self.steps(&catch.steps);
        self.put("}");
    }

    fn end(&mut self, end: &End) {
        self.put(match end.kind {
            EndKind::Done => "{\"end\":\"done\"",
            EndKind::Fail => "{\"end\":\"fail\"",
            EndKind::Replan => "{\"end\":\"replan\"",
        });
        if let Some(why) = &end.why {
            self.key("why");
            self.value(why);
        }
        self.put("}");
    }

    fn condition(&mut self, condition: &Condition) {
        match condition {
            Condition::Is(fluent, args) => {
                self.put("{\"is\":");
                self.string(fluent);
                self.args(args);
            }
            Condition::Not(inner) => {
                self.put("{\"not\":");
                self.condition(inner);
            }
            Condition::All(parts) => {
                self.put("{\"all\":");
                self.list(parts, Self::condition);
            }
            Condition::Any(parts) => {
                self.put("{\"any\":");
                self.list(parts, Self::condition);
            }
            Condition::Compare(subject, relation, value) => {
                match subject {
                    Subject::Measure(name, args) => {
                        self.put("{\"get\":");
                        self.string(name);
                        self.args(args);
                    }
                    Subject::Field(name, of) => {
                        self.put("{\"field\":");
                        self.string(name);
                        self.key("of");
                        self.value(of);
                    }
                }
                self.put(&format!(",\"is\":\"{}\",\"than\":", relation.word()));
                self.value(value);
            }
        }
        self.put("}");
    }

    fn args(&mut self, args: &[(SmolStr, Value)]) {
        for (name, value) in args {
            self.key(name);
            self.value(value);
        }
    }

    fn value(&mut self, value: &Value) {
        match value {
            Value::Binding(name) => self.put(&format!("\"${name}\"")),
            Value::Name(text) | Value::Text(text) => self.string(text),
            Value::Number(number, _) => self.put(&number.to_string()),
            Value::Bool(value) => self.put(if *value { "true" } else { "false" }),
            Value::Any => self.put("\"any\""),
            Value::List(items) => self.list(items, Self::value),
        }
    }
}
