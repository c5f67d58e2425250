//! Names of a document: each place where a name is declared or used, with what kind of name it is. Feeds
//! references, renaming, definitions and the colours of names.

use std::collections::BTreeSet;

use motet_syntax::ast::{
    Block, Call, Catch, CatchOn, Clause, End, Expr, ExprKind, File, Item, Keep, KeepKind, Manner, Name,
    Param, Policy, PrimitiveDecl, Quantified, Reaction, Step, StepKind, TextPart, TypeExpr,
};
use motet_syntax::{Parsed, Span};
use smol_str::SmolStr;

/// Name space of a name.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum NameSpace {
    /// Primitives and policies.
    Callable,
    /// Fluents and measures.
    Relation,
    /// Kinds and enumerations.
    Type,
    /// Entities, cases and failures.
    Value,
    /// Bindings and parameters of one policy or primitive.
    Local,
    /// Names of arguments and of fields.
    Label,
    Robot,
    Resource,
    Motion,
    /// Names of sequences.
    Group,
}

/// Place of a name in a document.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Occurrence {
    /// The name alone, without quotes or `$`.
    pub(crate) span: Span,
    pub(crate) name: SmolStr,
    pub(crate) space: NameSpace,
    pub(crate) is_declaration: bool,
    /// Index of the declaration that a local name belongs to; 0 for all other names.
    pub(crate) item: usize,
}

impl Occurrence {
    /// Returns whether both are places of the same name.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        (self.space, &self.name, self.item) == (other.space, &other.name, other.item)
    }
}

/// All names of a document, in the order of their places. O(nodes).
pub(crate) fn occurrences(parsed: &Parsed) -> Vec<Occurrence> {
    let mut walk = NameWalk { text: &parsed.text, found: Vec::new(), locals: BTreeSet::new(), item: 0 };
    walk.file(&parsed.file);
    let mut found = walk.found;
    found.sort_by_key(|place| (place.span, !place.is_declaration));
    found.dedup_by(|later, first| later.span == first.span);
    found
}

/// Name at an offset, if there is one; its end counts as well.
pub(crate) fn name_at(occurrences: &[Occurrence], offset: usize) -> Option<&Occurrence> {
    let within = |place: &&Occurrence| {
        let range = place.span.range();
        range.start <= offset && offset <= range.end
    };
    occurrences.iter().rfind(within)
}

struct NameWalk<'t> {
    text: &'t str,
    found: Vec<Occurrence>,
    /// Names that are bound somewhere in the present declaration.
    locals: BTreeSet<SmolStr>,
    item: usize,
}

impl NameWalk<'_> {
    fn push(&mut self, name: &Name, space: NameSpace, is_declaration: bool) {
        self.push_text(&name.text, name.span, space, is_declaration);
    }

    fn push_text(&mut self, name: &SmolStr, span: Span, space: NameSpace, is_declaration: bool) {
        let Some(written) = self.text.get(span.range()) else { return };
        let bare = written.trim_start_matches(['"', '`', '$']).trim_end_matches(['"', '`']);
        // What is written with escapes has no place of its own.
        if bare != name.as_str() || bare.is_empty() {
            return;
        }
        let Some(before) = written.find(bare) else { return };
        let start = span.range().start + before;
        let span = Span::new(span.file, start, start + bare.len());
        let item = if space == NameSpace::Local { self.item } else { 0 };
        self.found.push(Occurrence { span, name: name.clone(), space, is_declaration, item });
    }

    fn file(&mut self, file: &File) {
        for (index, item) in file.items.iter().enumerate() {
            self.item = index;
            self.locals.clear();
            match item {
                Item::Kind(decl) => {
                    self.push(&decl.name, NameSpace::Type, true);
                    decl.parent.iter().for_each(|parent| self.push(parent, NameSpace::Type, false));
                    for field in &decl.fields {
                        self.push(&field.name, NameSpace::Label, true);
                        self.type_expr(&field.ty);
                    }
                }
                Item::Fluent(decl) => {
                    self.push(&decl.name, NameSpace::Relation, true);
                    self.labels(&decl.params);
                }
                Item::Measure(decl) => {
                    self.push(&decl.name, NameSpace::Relation, true);
                    self.labels(&decl.params);
                    self.type_expr(&decl.result);
                }
                Item::Failure(decl) => self.push(&decl.name, NameSpace::Value, true),
                Item::Enum(decl) => {
                    self.push(&decl.name, NameSpace::Type, true);
                    decl.cases.iter().for_each(|case| self.push(case, NameSpace::Value, true));
                }
                Item::Primitive(decl) => self.primitive(decl),
                Item::Policy(policy) => self.policy(policy),
                Item::Entities(decl) => {
                    decl.names.iter().for_each(|name| self.push(name, NameSpace::Value, true));
                    self.push(&decl.kind, NameSpace::Type, false);
                }
                Item::Initially(decl) => decl.facts.iter().for_each(|fact| self.expr(fact)),
                Item::ClosedWorld(_) => {}
            }
        }
    }

    fn labels(&mut self, params: &[Param]) {
        for param in params {
            self.push(&param.name, NameSpace::Label, true);
            self.type_expr(&param.ty);
        }
    }

    fn params(&mut self, params: &[Param]) {
        self.locals.extend(params.iter().map(|param| param.name.text.clone()));
        for param in params {
            self.push(&param.name, NameSpace::Local, true);
            self.type_expr(&param.ty);
            param.default.iter().for_each(|default| self.expr(default));
        }
    }

    fn primitive(&mut self, decl: &PrimitiveDecl) {
        self.push(&decl.name, NameSpace::Callable, true);
        self.params(&decl.params);
        decl.result.iter().for_each(|result| self.type_expr(result));
        for clause in &decl.clauses {
            match clause {
                Clause::Needs(all) | Clause::Makes(all) | Clause::Unsettles(all) => {
                    all.iter().for_each(|one| self.quantified(one));
                }
                Clause::Motion(call) => {
                    self.push(&call.name, NameSpace::Motion, false);
                    self.args(call);
                }
                Clause::Uses(names) => {
                    names.iter().for_each(|name| self.push(name, NameSpace::Resource, false));
                }
                Clause::Takes { least, greatest } => {
                    self.expr(least);
                    self.expr(greatest);
                }
                Clause::Fails(names) => {
                    names.iter().for_each(|name| self.push(name, NameSpace::Value, false))
                }
                Clause::Lasts(names) => {
                    for name in names {
                        let is_local = self.locals.contains(&name.text);
                        let space = if is_local { NameSpace::Local } else { NameSpace::Resource };
                        self.push(name, space, false);
                    }
                }
            }
        }
    }

    fn quantified(&mut self, one: &Quantified) {
        if let Some((name, ty)) = &one.each {
            self.locals.insert(name.text.clone());
            self.push(name, NameSpace::Local, true);
            self.type_expr(ty);
        }
        self.expr(&one.expr);
        one.when.iter().for_each(|when| self.expr(when));
    }

    fn type_expr(&mut self, ty: &TypeExpr) {
        match ty {
            TypeExpr::Named(name) => self.push(name, NameSpace::Type, false),
            TypeExpr::List(inner, _) => self.type_expr(inner),
        }
    }

    fn policy(&mut self, policy: &Policy) {
        self.push(&policy.name, NameSpace::Callable, true);
        let mut bound = Vec::new();
        bindings(&policy.body, &mut bound);
        policy.cleanup.iter().for_each(|cleanup| bindings(cleanup, &mut bound));
        self.locals.extend(bound.iter().map(|name| name.text.clone()));
        self.params(&policy.params);
        policy.result.iter().for_each(|result| self.type_expr(result));
        policy.robot.iter().for_each(|robot| self.push(robot, NameSpace::Robot, false));
        policy.achieves.iter().for_each(|goal| self.expr(goal));
        policy.keeps.iter().for_each(|keep| self.keep(keep));
        self.block(&policy.body);
        policy.cleanup.iter().for_each(|cleanup| self.block(cleanup));
    }

    fn block(&mut self, block: &Block) {
        block.steps.iter().for_each(|step| self.step(step));
    }

    fn step(&mut self, step: &Step) {
        match &step.kind {
            StepKind::Do(step) => {
                step.bind.iter().for_each(|name| self.push(name, NameSpace::Local, true));
                self.push(&step.call.name, NameSpace::Callable, false);
                self.args(&step.call);
                if let Some(Manner::At(ratio, _)) = &step.manner {
                    self.expr(ratio);
                }
                step.within.iter().chain(&step.retry).for_each(|value| self.expr(value));
            }
            StepKind::Let { name, value } => {
                self.push(name, NameSpace::Local, true);
                self.expr(value);
            }
            StepKind::Sequence { name, body } => {
                self.push(name, NameSpace::Group, true);
                self.block(body);
            }
            StepKind::If { condition, then, otherwise } => {
                self.expr(condition);
                self.block(then);
                otherwise.iter().for_each(|block| self.block(block));
            }
            StepKind::Wait { condition, within } => {
                self.expr(condition);
                within.iter().for_each(|time| self.expr(time));
            }
            StepKind::Monitor { whens, body } => {
                for when in whens {
                    self.expr(&when.condition);
                    when.hold.iter().for_each(|time| self.expr(time));
                    self.reaction(&when.reaction);
                }
                self.block(body);
            }
            StepKind::Try { body, catches } => {
                self.block(body);
                catches.iter().for_each(|catch| self.catch(catch));
            }
            StepKind::Repeat { times, body, until } => {
                self.expr(times);
                self.block(body);
                until.iter().for_each(|condition| self.expr(condition));
            }
            StepKind::Each { item, list, at_most, body } => {
                self.push(item, NameSpace::Local, true);
                self.expr(list);
                self.expr(at_most);
                self.block(body);
            }
            StepKind::Parallel { branches } => branches.iter().for_each(|branch| self.block(branch)),
            StepKind::Keep { keeps, body } => {
                keeps.iter().for_each(|keep| self.keep(keep));
                self.block(body);
            }
            StepKind::Delay { time } => self.expr(time),
            StepKind::Within { time, body } => {
                self.expr(time);
                self.block(body);
            }
            StepKind::Finally { step, cleanup } => {
                self.step(step);
                self.block(cleanup);
            }
            StepKind::End(end) => self.end(end),
        }
    }

    fn end(&mut self, end: &End) {
        end.result.iter().chain(&end.why).for_each(|value| self.expr(value));
    }

    fn keep(&mut self, keep: &Keep) {
        match &keep.kind {
            KeepKind::OutOf(zone) => self.expr(zone),
            KeepKind::Distance { to, at_least } => {
                self.expr(to);
                self.expr(at_least);
            }
        }
    }

    fn reaction(&mut self, reaction: &Reaction) {
        match reaction {
            Reaction::Pause { within, .. } => within.iter().for_each(|time| self.expr(time)),
            Reaction::Restart { at_most, .. } => self.expr(at_most),
            Reaction::Resume { at_most, body, .. } => {
                self.expr(at_most);
                self.block(body);
            }
            Reaction::End(end) => self.end(end),
        }
    }

    fn catch(&mut self, catch: &Catch) {
        if let CatchOn::Kinds(kinds) = &catch.on {
            kinds.iter().for_each(|kind| self.push(kind, NameSpace::Value, false));
        }
        catch.bind.iter().for_each(|name| self.push(name, NameSpace::Local, true));
        self.block(&catch.body);
    }

    fn args(&mut self, call: &Call) {
        for arg in &call.args {
            arg.name.iter().for_each(|name| self.push(name, NameSpace::Label, false));
            self.expr(&arg.value);
        }
    }

    fn expr(&mut self, expr: &Expr) {
        match &expr.kind {
            ExprKind::Name(name) => {
                let is_local = self.locals.contains(name);
                let space = if is_local { NameSpace::Local } else { NameSpace::Value };
                self.push_text(name, expr.span, space, false);
            }
            ExprKind::Binding(name) => self.push_text(name, expr.span, NameSpace::Local, false),
            ExprKind::Plain(name) => self.push_text(name, expr.span, NameSpace::Value, false),
            ExprKind::Template(parts) => {
                for part in parts {
                    if let TextPart::Value(value) = part {
                        self.expr(value);
                    }
                }
            }
            ExprKind::Call(call) => {
                self.push(&call.name, NameSpace::Relation, false);
                self.args(call);
            }
            ExprKind::Field(of, name) => {
                self.expr(of);
                self.push(name, NameSpace::Label, false);
            }
            ExprKind::List(all) | ExprKind::All(all) | ExprKind::AnyOf(all) => {
                all.iter().for_each(|one| self.expr(one));
            }
            ExprKind::Not(inner) => self.expr(inner),
            ExprKind::Compare(_, left, right) | ExprKind::Arith(_, left, right) => {
                self.expr(left);
                self.expr(right);
            }
            ExprKind::Bool(_)
            | ExprKind::Number(_)
            | ExprKind::Quantity(..)
            | ExprKind::Text(_)
            | ExprKind::Wrong(_)
            | ExprKind::Any => {}
        }
    }
}

/// Names that the steps of a block bind, with those in the blocks of its steps.
fn bindings<'a>(block: &'a Block, found: &mut Vec<&'a Name>) {
    for step in &block.steps {
        let mut step = step;
        while let StepKind::Finally { step: inner, cleanup } = &step.kind {
            bindings(cleanup, found);
            step = inner;
        }
        match &step.kind {
            StepKind::Do(step) => found.extend(&step.bind),
            StepKind::Let { name, .. } => found.push(name),
            StepKind::Each { item, .. } => found.push(item),
            StepKind::Try { catches, .. } => found.extend(catches.iter().filter_map(|it| it.bind.as_ref())),
            _ => {}
        }
        blocks(step).into_iter().for_each(|block| bindings(block, found));
    }
}

/// Blocks of a step in the order of the document, those of reactions and handlers included.
pub(crate) fn blocks(step: &Step) -> Vec<&Block> {
    match &step.kind {
        StepKind::Do(_)
        | StepKind::Let { .. }
        | StepKind::Wait { .. }
        | StepKind::Delay { .. }
        | StepKind::End(_) => Vec::new(),
        StepKind::Sequence { body, .. }
        | StepKind::Repeat { body, .. }
        | StepKind::Each { body, .. }
        | StepKind::Keep { body, .. }
        | StepKind::Within { body, .. } => vec![body],
        StepKind::If { then, otherwise, .. } => std::iter::once(then).chain(otherwise).collect(),
        StepKind::Monitor { whens, body } => {
            let reactions = whens.iter().filter_map(|when| match &when.reaction {
                Reaction::Resume { body, .. } => Some(body),
                Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::End(_) => None,
            });
            reactions.chain([body]).collect()
        }
        StepKind::Try { body, catches } => {
            std::iter::once(body).chain(catches.iter().map(|catch| &catch.body)).collect()
        }
        StepKind::Parallel { branches } => branches.iter().collect(),
        StepKind::Finally { step, cleanup } => {
            let mut all = blocks(step);
            all.push(cleanup);
            all
        }
    }
}

#[cfg(test)]
mod tests {
    use motet_syntax::{FileId, Source};

    use super::{NameSpace, name_at, occurrences};

    fn check(text: &str, at: &str, expected: &[&str]) {
        let parsed = motet_syntax::read(&Source::new("test", text), FileId(0));
        let all = occurrences(&parsed);
        let named = name_at(&all, text.find(at).unwrap()).unwrap();
        let same: Vec<_> = all.iter().filter(|place| place.is_same(named)).collect();
        let shown = same.iter().map(|place| {
            let mark = if place.is_declaration { "=" } else { "" };
            let (line, column) = Source::new("", text).line_column(place.span.start);
            format!("{mark}{line}:{column}")
        });
        assert_eq!(shown.collect::<Vec<_>>(), expected, "{:?}", named.space);
    }

    const TEXT: &str = "entity cup: Object\n\
        policy a(cup: Object) { go(cup) let x = detect(\"x {x}\") if holding(x) { pick(x) } }\n\
        policy b { go(cup) a(cup) try { go(x) } catch blocked as x { fail x.text } }";

    #[test]
    fn occurrences_keep_local_names_apart() {
        check(TEXT, "cup:", &["=1:8", "3:15", "3:22"]);
        check(TEXT, "cup: Object) {", &["=2:10", "2:28"]);
        check(TEXT, "x = ", &["=2:37", "2:52", "2:68", "2:78"]);
        check(TEXT, "x) } catch", &["3:36", "=3:58", "3:67"]);
        check(TEXT, "a(cup)", &["=2:8", "3:20"]);
    }

    #[test]
    fn occurrences_are_found_in_json() {
        let json = r#"{"motet": 1, "policy": "p", "steps": [{"do": "detect", "what": "mug", "as": "it"},
            {"do": "pick", "object": "$it"}]}"#;
        check(json, "it\"}", &["=1:78", "2:40"]);
        let parsed = motet_syntax::read(&Source::new("test", json), FileId(0));
        let all = occurrences(&parsed);
        assert!(all.iter().any(|place| place.space == NameSpace::Callable && place.name == "pick"));
    }
}
