//! Policies over a made-up domain, and the text of both.

use std::fmt::Write as _;

use super::contract::{Action, Arg, Atom, Change, Condition, Domain, Kind, Length, Need};
use super::make::BASE;

/// A step.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// A call of an action; `name` is that of its result.
    Call {
        action: usize,
        args: Vec<Arg>,
        name: Option<usize>,
        retry: u32,
        /// Speed of its motion, one of [`MANNERS`]; empty for the robot's own.
        manner: &'static str,
        /// True if it has a deadline of its own.
        is_bounded: bool,
    },
    /// Another name for an entity or a name.
    Let {
        name: usize,
        value: Arg,
    },
    /// Words with the text of a failure.
    Say(usize),
    /// Choice of a person among entities.
    Choose {
        among: Vec<Arg>,
        name: usize,
    },
    /// A list with its parts, of which each has one kind.
    List {
        of: Vec<Arg>,
        name: usize,
    },
    /// A name for the length of a list.
    Count {
        list: usize,
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
    Try(Vec<Self>, Vec<Handler>),
    Finally(Vec<Self>, Vec<Self>),
    Repeat(u32, Vec<Self>, Option<Condition>),
    Each {
        among: Among,
        name: usize,
        body: Vec<Self>,
    },
    Monitor(Vec<Rule>, Vec<Self>),
    /// A distance is kept from an entity or a name.
    Keep(Arg, Vec<Self>),
    Within(Vec<Self>),
    Parallel(Vec<Vec<Self>>),
    /// A call of a policy with an argument; `name` is that of its result.
    Policy(usize, Arg, Option<usize>),
    /// The end of the policy, one of [`ENDS`].
    End(&'static str),
    /// The end of a policy with a result.
    Give(Arg),
}

/// Endings of a policy, as text.
pub(super) const ENDS: [&str; 4] = ["done", "fail \"no\"", "cannot \"no\"", "replan \"no\""];

/// Manners of a motion, as text.
pub(super) const MANNERS: [&str; 3] = [" slowly", " gently", " at 30 %"];

/// Handler of kinds of failure, of any without one; `name` is that of the failure.
#[derive(Clone, Debug)]
pub(super) struct Handler {
    pub(super) kinds: Vec<&'static str>,
    pub(super) name: Option<usize>,
    pub(super) steps: Vec<Step>,
}

/// Things of one kind that a loop goes over.
#[derive(Clone, Debug)]
pub(super) enum Among {
    Written(Vec<Arg>),
    /// A list that a perception has found.
    List(usize),
}

/// Condition of a monitor, the time in s for which it has to hold, and the reaction to it.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) condition: Condition,
    pub(super) for_secs: u32,
    pub(super) reaction: Reaction,
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
    pub(super) cleanup: Vec<Step>,
    pub(super) goal: Option<Condition>,
    pub(super) called: Vec<Called>,
    /// Steps of a policy that takes over in mid-run; none without one.
    pub(super) later: Vec<Step>,
}

/// A policy that is called with an object.
#[derive(Clone, Debug)]
pub(super) struct Called {
    /// Name of the parameter.
    pub(super) param: usize,
    pub(super) body: Vec<Step>,
    /// True if it gives an object.
    pub(super) gives: bool,
}

impl Step {
    /// The blocks of the step.
    #[must_use]
    pub(super) fn blocks(&self) -> Vec<&Vec<Self>> {
        match self {
            Self::Call { .. } | Self::Choose { .. } | Self::First { .. } | Self::Policy(..) => Vec::new(),
            Self::Let { .. } | Self::List { .. } | Self::Count { .. } => Vec::new(),
            Self::Say(_) | Self::Give(_) => Vec::new(),
            Self::Wait(_) | Self::Delay | Self::End(_) => Vec::new(),
            Self::If(_, one, other) | Self::Finally(one, other) => vec![one, other],
            Self::Try(body, handlers) => {
                let handlers = handlers.iter().map(|handler| &handler.steps);
                std::iter::once(body).chain(handlers).collect()
            }
            Self::Repeat(_, body, _) | Self::Each { body, .. } => vec![body],
            Self::Keep(_, body) | Self::Within(body) => vec![body],
            Self::Monitor(rules, body) => {
                let reactions = rules.iter().filter_map(|rule| match &rule.reaction {
                    Reaction::Resume(_, steps) => Some(steps),
                    Reaction::Pause | Reaction::Restart(_) | Reaction::End(_) => None,
                });
                std::iter::once(body).chain(reactions).collect()
            }
            Self::Parallel(branches) => branches.iter().collect(),
        }
    }

    /// The blocks of the step, to be changed.
    pub(super) fn blocks_mut(&mut self) -> Vec<&mut Vec<Self>> {
        match self {
            Self::Call { .. } | Self::Choose { .. } | Self::First { .. } | Self::Policy(..) => Vec::new(),
            Self::Let { .. } | Self::List { .. } | Self::Count { .. } => Vec::new(),
            Self::Say(_) | Self::Give(_) => Vec::new(),
            Self::Wait(_) | Self::Delay | Self::End(_) => Vec::new(),
            Self::If(_, one, other) | Self::Finally(one, other) => vec![one, other],
            Self::Try(body, handlers) => {
                let handlers = handlers.iter_mut().map(|handler| &mut handler.steps);
                std::iter::once(body).chain(handlers).collect()
            }
            Self::Repeat(_, body, _) | Self::Each { body, .. } => vec![body],
            Self::Keep(_, body) | Self::Within(body) => vec![body],
            Self::Monitor(rules, body) => {
                let reactions = rules.iter_mut().filter_map(|rule| match &mut rule.reaction {
                    Reaction::Resume(_, steps) => Some(steps),
                    Reaction::Pause | Reaction::Restart(_) | Reaction::End(_) => None,
                });
                std::iter::once(body).chain(reactions).collect()
            }
            Self::Parallel(branches) => branches.iter_mut().collect(),
        }
    }

    /// True for a step with blocks behind which a cleanup may stand.
    fn may_clean_up(&self) -> bool {
        !self.blocks().is_empty() && !matches!(self, Self::Finally(..))
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
    let (cases, entities): (Vec<_>, Vec<_>) =
        domain.entities.iter().take(domain.declared).partition(|(_, kind)| *kind == Kind::Mode);
    if !cases.is_empty() {
        let cases: Vec<&str> = cases.into_iter().map(|(name, _)| name.as_str()).collect();
        let _ = writeln!(writer.out, "enum {} {{ {} }}", Kind::Mode, cases.join(", "));
    }
    for (name, kind) in entities {
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

/// A policy `p`, behind those that it calls, and before the policy `later` that takes over; without its goal,
/// if that is to be left out.
#[must_use]
pub(super) fn policy_text(domain: &Domain, policy: &Policy, with_goal: bool) -> String {
    let mut writer = Writer { domain, out: String::new(), groups: 0 };
    for (index, Called { param, body, gives }) in policy.called.iter().enumerate() {
        let result = if *gives { " -> Object" } else { "" };
        writer.nested(0, &format!("policy q{index}(m{param}: Object){result}"), body);
    }
    let goal = policy.goal.as_ref().filter(|_| with_goal);
    let goal = goal.map_or_else(String::new, |goal| format!(" achieves {}", writer.condition(goal)));
    writer.nested(0, &format!("policy p{goal}"), &policy.body);
    if !policy.cleanup.is_empty() {
        writer.behind(" finally", &policy.cleanup, 0);
    }
    if !policy.later.is_empty() {
        writer.nested(0, "policy later", &policy.later);
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
            (Some(kind), _) => ("perception", format!(" -> {kind}")),
            (None, true) => ("perception", " -> List<Object>".to_owned()),
            (None, false) => ("action", String::new()),
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
        let stale = action.is_stale_by_base.then(|| BASE.to_owned()).into_iter();
        clause("lasts until", stale.chain(action.is_stale_by.iter().map(|arg| writer.arg(*arg))).collect());
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
            Arg::First(list) => format!("first(l{list})"),
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
            Condition::Kind(failure, kind) => format!("k{failure}.kind == {kind}"),
            Condition::Empty(list) => format!("is_empty(l{list})"),
            Condition::Length(Length::Of(list), op, count) => format!("count(l{list}) {op} {count}"),
            Condition::Length(Length::Named(name), op, count) => format!("n{name} {op} {count}"),
        }
    }

    fn names(&self, among: &[Arg]) -> String {
        among.iter().map(|one| self.arg(*one)).collect::<Vec<_>>().join(", ")
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
            Step::Call { action, args, name, retry, manner, is_bounded } => {
                let Some(action) = self.domain.actions.get(*action) else { return };
                let mut args: Vec<String> = args.iter().map(|arg| self.arg(*arg)).collect();
                if action.finds.is_some() || action.finds_all {
                    args.insert(0, "\"thing\"".to_owned());
                }
                let sort = if action.finds_all { 'l' } else { 'm' };
                let name = name.map_or_else(String::new, |name| format!("let {sort}{name} = "));
                let retry = if *retry > 0 { format!(" retry {retry}") } else { String::new() };
                let within = if *is_bounded { " within 3 s" } else { "" };
                let call = format!("{name}{}({})", action.name, args.join(", "));
                self.line(depth, &format!("{call}{manner}{within}{retry}"));
            }
            Step::Let { name, value } => self.line(depth, &format!("let m{name} = {}", self.arg(*value))),
            Step::Say(failure) => self.line(depth, &format!("say(\"it failed: {{k{failure}}}\")")),
            Step::Choose { among, name } => {
                let text = format!("let m{name} = choose(\"which?\", [{}])", self.names(among));
                self.line(depth, &text);
            }
            Step::List { of, name } => self.line(depth, &format!("let l{name} = [{}]", self.names(of))),
            Step::Count { list, name } => self.line(depth, &format!("let n{name} = count(l{list})")),
            Step::First { list, name } => self.line(depth, &format!("let m{name} = first(l{list})")),
            Step::If(test, then, otherwise) => {
                self.nested(depth, &format!("if {}", self.condition(test)), then);
                if !otherwise.is_empty() {
                    self.behind(" else", otherwise, depth);
                }
            }
            Step::Wait(test) => self.line(depth, &format!("wait until {} within 3 s", self.condition(test))),
            Step::Delay => self.line(depth, "wait 2 s"),
            Step::Try(body, handlers) => {
                self.nested(depth, "try", body);
                for Handler { kinds, name, steps } in handlers {
                    let kinds = if kinds.is_empty() { "any".to_owned() } else { kinds.join(", ") };
                    let name = name.map_or_else(String::new, |name| format!(" as k{name}"));
                    self.behind(&format!(" catch {kinds}{name}"), steps, depth);
                }
            }
            Step::Finally(body, cleanup) => {
                match &**body {
                    [only] if only.may_clean_up() => self.step(only, depth),
                    _ => self.group(body, depth),
                }
                self.behind(" finally", cleanup, depth);
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
                    Among::Written(among) => format!("[{}]", self.names(among)),
                    Among::List(list) => format!("l{list}"),
                };
                let text = format!("each m{name} in {among} at most 3");
                self.nested(depth, &text, body);
            }
            Step::Monitor(rules, body) => {
                let single = rules.len() == 1;
                self.line(depth, if single { "monitor" } else { "monitor {" });
                for rule in rules {
                    self.rule(rule, if single { depth } else { depth + 1 });
                }
                if !single {
                    self.line(depth, "}");
                }
                self.nested(depth, "during", body);
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
            Step::Policy(index, arg, name) => {
                let name = name.map_or_else(String::new, |name| format!("let m{name} = "));
                let text = format!("{name}q{index}({})", self.arg(*arg));
                self.line(depth, &text);
            }
            Step::End(end) => self.line(depth, end),
            Step::Give(arg) => self.line(depth, &format!("done {}", self.arg(*arg))),
        }
    }

    fn rule(&mut self, rule: &Rule, depth: usize) {
        let held = if rule.for_secs > 0 { format!(" for {} s", rule.for_secs) } else { String::new() };
        let then = format!("when {}{held} then", self.condition(&rule.condition));
        match &rule.reaction {
            Reaction::Pause => self.line(depth, &format!("{then} pause")),
            Reaction::End(end) => self.line(depth, &format!("{then} {end}")),
            Reaction::Restart(count) => self.line(depth, &format!("{then} restart at most {count}")),
            Reaction::Resume(count, steps) => {
                self.nested(depth, &format!("{then} resume at most {count}"), steps);
            }
        }
    }

    /// A group of steps: a sequence, or a `try` that catches nothing.
    fn group(&mut self, body: &[Step], depth: usize) {
        self.groups += 1;
        let head = if self.groups.is_multiple_of(2) {
            "try".to_owned()
        } else {
            format!("sequence s{}", self.groups)
        };
        self.nested(depth, &head, body);
    }

    /// A block on the line on which the one before it ends.
    fn behind(&mut self, head: &str, body: &[Step], depth: usize) {
        self.out.truncate(self.out.trim_end().len());
        let _ = writeln!(self.out, "{head} {{");
        self.block(body, depth + 1);
        self.line(depth, "}");
    }

    fn nested(&mut self, depth: usize, head: &str, body: &[Step]) {
        let space = if head.is_empty() || head.ends_with(' ') { "" } else { " " };
        self.line(depth, &format!("{head}{space}{{"));
        self.block(body, depth + 1);
        self.line(depth, "}");
    }
}
