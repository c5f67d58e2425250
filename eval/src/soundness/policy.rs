//! Policies over a made-up domain, and the text of both.

use std::fmt::Write as _;

use super::contract::{Action, Arg, Atom, Change, Condition, Domain, Kind, Need};

/// A step.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// A call of an action; `name` is that of its result.
    Call {
        action: usize,
        args: Vec<Arg>,
        name: Option<usize>,
        retry: u32,
    },
    /// Choice of a person among entities.
    Choose {
        among: Vec<usize>,
        name: usize,
    },
    /// The first of a list.
    First {
        list: usize,
        name: usize,
    },
    If(Condition, Vec<Self>, Vec<Self>),
    Wait(Condition),
    /// A wait for a time.
    Delay,
    /// Handlers by kinds of failure; none for any.
    Try(Vec<Self>, Vec<(Vec<&'static str>, Vec<Self>)>),
    Finally(Vec<Self>, Vec<Self>),
    Repeat(u32, Vec<Self>, Option<Condition>),
    Each {
        among: Among,
        name: usize,
        body: Vec<Self>,
    },
    Monitor(Watch, Reaction, Vec<Self>),
    /// A distance is kept from an entity or a name.
    Keep(Arg, Vec<Self>),
    Within(Vec<Self>),
    Parallel(Vec<Vec<Self>>),
    /// A call of a policy with an argument.
    Policy(usize, Arg),
    /// The end of the policy, one of [`ENDS`].
    End(&'static str),
}

/// Endings of a policy, as text.
pub(super) const ENDS: [&str; 4] = ["done", "fail \"no\"", "cannot \"no\"", "replan \"no\""];

/// Objects that a loop goes over.
#[derive(Clone, Debug)]
pub(super) enum Among {
    Entities(Vec<usize>),
    /// A list that a perception has found.
    List(usize),
}

/// Condition of a monitor, and the time in s for which it has to hold.
#[derive(Clone, Debug)]
pub(super) struct Watch {
    pub(super) condition: Condition,
    pub(super) for_secs: u32,
}

/// Reaction of a monitor.
#[derive(Clone, Debug)]
pub(super) enum Reaction {
    Pause,
    Restart(u32),
    Resume(u32, Vec<Step>),
    /// The end of the policy, one of [`ENDS`].
    End(&'static str),
}

/// A policy, with those that it calls.
#[derive(Clone, Debug, Default)]
pub(super) struct Policy {
    pub(super) body: Vec<Step>,
    /// The name of the parameter, and the steps.
    pub(super) called: Vec<(usize, Vec<Step>)>,
    /// Steps of a policy that takes over in mid-run; none without one.
    pub(super) later: Vec<Step>,
}

impl Step {
    /// The blocks of the step.
    #[must_use]
    pub(super) fn blocks(&self) -> Vec<&Vec<Self>> {
        match self {
            Self::Call { .. } | Self::Choose { .. } | Self::First { .. } | Self::Policy(..) => Vec::new(),
            Self::Wait(_) | Self::Delay | Self::End(_) => Vec::new(),
            Self::If(_, one, other) | Self::Finally(one, other) => vec![one, other],
            Self::Try(body, handlers) => {
                std::iter::once(body).chain(handlers.iter().map(|(_, steps)| steps)).collect()
            }
            Self::Repeat(_, body, _) | Self::Each { body, .. } => vec![body],
            Self::Keep(_, body) | Self::Within(body) => vec![body],
            Self::Monitor(_, Reaction::Resume(_, reaction), body) => vec![body, reaction],
            Self::Monitor(_, _, body) => vec![body],
            Self::Parallel(branches) => branches.iter().collect(),
        }
    }

    /// The blocks of the step, to be changed.
    pub(super) fn blocks_mut(&mut self) -> Vec<&mut Vec<Self>> {
        match self {
            Self::Call { .. } | Self::Choose { .. } | Self::First { .. } | Self::Policy(..) => Vec::new(),
            Self::Wait(_) | Self::Delay | Self::End(_) => Vec::new(),
            Self::If(_, one, other) | Self::Finally(one, other) => vec![one, other],
            Self::Try(body, handlers) => {
                std::iter::once(body).chain(handlers.iter_mut().map(|(_, steps)| steps)).collect()
            }
            Self::Repeat(_, body, _) | Self::Each { body, .. } => vec![body],
            Self::Keep(_, body) | Self::Within(body) => vec![body],
            Self::Monitor(_, Reaction::Resume(_, reaction), body) => vec![body, reaction],
            Self::Monitor(_, _, body) => vec![body],
            Self::Parallel(branches) => branches.iter_mut().collect(),
        }
    }
}

/// Writer of text, which knows what arguments are called.
struct Writer<'d> {
    domain: &'d Domain,
    out: String,
    groups: usize,
}

/// A domain as declarations; without its needs, if they are to be left out.
#[must_use]
pub(super) fn domain_text(domain: &Domain, with_needs: bool) -> String {
    let mut writer = Writer { domain, out: String::new(), groups: 0 };
    if domain.is_closed {
        writer.out.push_str("closed world\n");
    }
    for (name, kind) in domain.entities.iter().take(domain.declared) {
        let _ = writeln!(writer.out, "entity {name}: {kind}");
    }
    for (index, (name, params)) in domain.names.iter().zip(&domain.fluents).enumerate() {
        if domain.measure == Some(index) {
            continue;
        }
        let params: Vec<String> = (0..).zip(params).map(|(at, kind)| format!("p{at}: {kind}")).collect();
        let _ = writeln!(writer.out, "fluent {name}({})", params.join(", "));
    }
    for action in &domain.actions {
        writer.action(action, with_needs);
    }
    let start: Vec<String> =
        domain.start.iter().map(|(atom, truth)| format!("{}{}", not(*truth), writer.atom(atom))).collect();
    if !start.is_empty() {
        let _ = writeln!(writer.out, "initially {}", start.join(", "));
    }
    writer.out
}

/// A policy `p`, behind those that it calls, and before the policy `later` that takes over.
#[must_use]
pub(super) fn policy_text(domain: &Domain, policy: &Policy) -> String {
    let mut writer = Writer { domain, out: String::new(), groups: 0 };
    for (index, (name, body)) in policy.called.iter().enumerate() {
        let _ = writeln!(writer.out, "policy q{index}(m{name}: Object) {{");
        writer.block(body, 1);
        writer.out.push_str("}\n");
    }
    for (name, body) in [("p", &policy.body), ("later", &policy.later)] {
        if name == "p" || !body.is_empty() {
            writer.nested(0, &format!("policy {name}"), body);
        }
    }
    writer.out
}

fn not(truth: bool) -> &'static str {
    if truth { "" } else { "not " }
}

impl Writer<'_> {
    fn action(&mut self, action: &Action, with_needs: bool) {
        let mut params: Vec<String> =
            (0..).zip(&action.params).map(|(at, kind)| format!("x{at}: {kind}")).collect();
        let (what, result) = match (action.finds, action.finds_all) {
            (true, _) => ("perception", " -> Object"),
            (_, true) => ("perception", " -> List<Object>"),
            (false, false) => ("action", ""),
        };
        if !result.is_empty() {
            params.insert(0, "what: Text".to_owned());
        }
        let _ = writeln!(self.out, "{what} {}({}){result}", action.name, params.join(", "));
        let mut clause = |name: &str, items: Vec<String>| {
            if !items.is_empty() {
                let _ = writeln!(self.out, "    {name} {}", items.join(", "));
            }
        };
        let writer = Writer { domain: self.domain, out: String::new(), groups: 0 };
        if with_needs {
            clause("needs", action.needs.iter().map(|need| writer.need(need)).collect());
        }
        clause("makes", action.makes.iter().map(|change| writer.change(change, change.truth)).collect());
        clause("unsettles", action.unsettles.iter().map(|change| writer.change(change, true)).collect());
        clause("uses", action.uses.iter().map(|&name| name.to_owned()).collect());
        clause("takes", vec!["1 s .. 4 s".to_owned()]);
        clause("fails", action.fails.iter().map(|&name| name.to_owned()).collect());
    }

    fn need(&self, need: &Need) -> String {
        self.quantified(self.condition(&need.condition), need.each, need.when.as_ref())
    }

    fn change(&self, change: &Change, truth: bool) -> String {
        let said = format!("{}{}", not(truth), self.atom(&change.atom));
        self.quantified(said, change.each, change.when.as_ref())
    }

    fn quantified(&self, said: String, each: Option<Kind>, when: Option<&Condition>) -> String {
        let each = each.map_or_else(String::new, |kind| format!(" for each y: {kind}"));
        let when = when.map_or_else(String::new, |when| format!(" when {}", self.condition(when)));
        format!("{said}{each}{when}")
    }

    fn arg(&self, arg: Arg) -> String {
        match arg {
            Arg::Entity(one) => {
                self.domain.entities.get(one).map(|(name, _)| name.clone()).unwrap_or_default()
            }
            Arg::Param(index) => format!("x{index}"),
            Arg::Each => "y".to_owned(),
            Arg::Result => "result".to_owned(),
            Arg::Name(name) => format!("m{name}"),
            Arg::Any => "any".to_owned(),
        }
    }

    fn atom(&self, atom: &Atom) -> String {
        let args: Vec<String> = atom.args.iter().map(|arg| self.arg(*arg)).collect();
        let name = self.domain.names.get(atom.fluent).map_or("", String::as_str);
        let is_measure = self.domain.measure == Some(atom.fluent);
        format!("{name}({}){}", args.join(", "), if is_measure { " < 1 m" } else { "" })
    }

    fn condition(&self, condition: &Condition) -> String {
        let parts = |parts: &[Condition], word: &str| {
            let parts: Vec<String> = parts.iter().map(|part| self.condition(part)).collect();
            format!("({})", parts.join(word))
        };
        match condition {
            Condition::Is(atom) => self.atom(atom),
            Condition::Same(one, other) => format!("{} == {}", self.arg(*one), self.arg(*other)),
            Condition::Not(inner) => match &**inner {
                Condition::Same(one, other) => format!("{} != {}", self.arg(*one), self.arg(*other)),
                Condition::Is(atom) if self.domain.measure == Some(atom.fluent) => {
                    self.atom(atom).replace('<', ">=")
                }
                inner => format!("not {}", self.condition(inner)),
            },
            Condition::All(all) => parts(all, " and "),
            Condition::AnyOf(some) => parts(some, " or "),
        }
    }

    fn names(&self, among: &[usize]) -> String {
        among.iter().map(|one| self.arg(Arg::Entity(*one))).collect::<Vec<_>>().join(", ")
    }

    fn block(&mut self, steps: &[Step], depth: usize) {
        for step in steps {
            self.step(step, depth);
        }
    }

    fn line(&mut self, depth: usize, text: &str) {
        let _ = writeln!(self.out, "{}{text}", "    ".repeat(depth));
    }

    fn step(&mut self, step: &Step, depth: usize) {
        match step {
            Step::Call { action, args, name, retry } => {
                let Some(action) = self.domain.actions.get(*action) else { return };
                let mut args: Vec<String> = args.iter().map(|arg| self.arg(*arg)).collect();
                if action.finds || action.finds_all {
                    args.insert(0, "\"thing\"".to_owned());
                }
                let sort = if action.finds_all { 'l' } else { 'm' };
                let name = name.map_or_else(String::new, |name| format!("let {sort}{name} = "));
                let retry = if *retry > 0 { format!(" retry {retry}") } else { String::new() };
                self.line(depth, &format!("{name}{}({}){retry}", action.name, args.join(", ")));
            }
            Step::Choose { among, name } => {
                let text = format!("let m{name} = choose(\"which?\", [{}])", self.names(among));
                self.line(depth, &text);
            }
            Step::First { list, name } => self.line(depth, &format!("let m{name} = first(l{list})")),
            Step::If(test, then, otherwise) => {
                self.nested(depth, &format!("if {}", self.condition(test)), then);
                if !otherwise.is_empty() {
                    self.out.truncate(self.out.trim_end().len());
                    self.nested(0, " else", otherwise);
                }
            }
            Step::Wait(test) => self.line(depth, &format!("wait until {} within 3 s", self.condition(test))),
            Step::Delay => self.line(depth, "wait 2 s"),
            Step::Try(body, handlers) => {
                self.nested(depth, "try", body);
                for (kinds, handler) in handlers {
                    self.out.truncate(self.out.trim_end().len());
                    let kinds = if kinds.is_empty() { "any".to_owned() } else { kinds.join(", ") };
                    self.nested(0, &format!(" catch {kinds}"), handler);
                }
            }
            Step::Finally(body, cleanup) => {
                self.groups += 1;
                self.nested(depth, &format!("sequence s{}", self.groups), body);
                self.out.truncate(self.out.trim_end().len());
                self.nested(0, " finally", cleanup);
            }
            Step::Repeat(times, body, until) => {
                self.nested(depth, &format!("repeat {times}"), body);
                if let Some(until) = until {
                    self.out.truncate(self.out.trim_end().len());
                    let text = format!(" until {}", self.condition(until));
                    self.line(0, &text);
                }
            }
            Step::Each { among, name, body } => {
                let among = match among {
                    Among::Entities(among) => format!("[{}]", self.names(among)),
                    Among::List(list) => format!("l{list}"),
                };
                let text = format!("each m{name} in {among} at most 3");
                self.nested(depth, &text, body);
            }
            Step::Monitor(Watch { condition, for_secs }, reaction, body) => {
                let held = if *for_secs > 0 { format!(" for {for_secs} s") } else { String::new() };
                let then = format!("monitor when {}{held} then", self.condition(condition));
                match reaction {
                    Reaction::Pause => self.nested(depth, &format!("{then} pause during"), body),
                    Reaction::End(end) => self.nested(depth, &format!("{then} {end} during"), body),
                    Reaction::Restart(count) => {
                        self.nested(depth, &format!("{then} restart at most {count} during"), body);
                    }
                    Reaction::Resume(count, reaction) => {
                        self.nested(depth, &format!("{then} resume at most {count}"), reaction);
                        self.out.truncate(self.out.trim_end().len());
                        self.nested(0, " during", body);
                    }
                }
            }
            Step::Keep(of, body) => {
                let text = format!("keep distance({}) >= 1 m", self.arg(*of));
                self.nested(depth, &text, body);
            }
            Step::Within(body) => self.nested(depth, "within 6 s", body),
            Step::Parallel(branches) => {
                self.line(depth, "parallel {");
                branches.iter().for_each(|branch| self.nested(depth + 1, "", branch));
                self.line(depth, "}");
            }
            Step::Policy(index, arg) => {
                let text = format!("q{index}({})", self.arg(*arg));
                self.line(depth, &text);
            }
            Step::End(end) => self.line(depth, end),
        }
    }

    fn nested(&mut self, depth: usize, head: &str, body: &[Step]) {
        let space = if head.is_empty() || head.ends_with(' ') { "" } else { " " };
        self.line(depth, &format!("{head}{space}{{"));
        self.block(body, depth + 1);
        self.line(depth, "}");
    }
}
