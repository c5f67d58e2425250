//! Declarations in the text syntax.

use super::expr;
use super::writer::{Blank, Writer};
use crate::ast::{
    Clause, Expr, File, Item, Name, Param, Policy, PrimitiveDecl, PrimitiveKind, Quantified, TypeExpr,
};
use crate::source::Span;

/// Column of the entries of a clause, after its keyword.
const CLAUSE_WIDTH: usize = 10;
/// Lists of entries are broken before this column.
const LINE_WIDTH: usize = 100;

impl Writer<'_> {
    pub(super) fn file(&mut self, file: &File) {
        let mut previous: Option<&Item> = None;
        for item in &file.items {
            let apart = previous.is_some_and(|previous| stands_apart(previous) || stands_apart(item))
                || previous
                    .is_some_and(|previous| std::mem::discriminant(previous) != std::mem::discriminant(item));
            self.item(item, if apart { Blank::Always } else { Blank::AsWritten });
            previous = Some(item);
        }
    }

    fn item(&mut self, item: &Item, blank: Blank) {
        let (doc, span) = head(item);
        let doc_lines = if doc.is_empty() { 0 } else { doc.split('\n').count() };
        self.begin_documented(span.start, doc_lines, blank);
        for line in doc.split('\n').take(doc_lines) {
            self.text.push_str(if line.is_empty() { "///" } else { "/// " });
            self.text.push_str(line);
            self.text.push('\n');
        }
        match item {
            Item::Kind(decl) => {
                self.keyword("kind", &decl.name);
                if let Some(parent) = &decl.parent {
                    self.text.push_str(": ");
                    expr::name(&mut self.text, &parent.text);
                }
                if !decl.fields.is_empty() {
                    self.text.push_str(" { ");
                    self.params(&decl.fields);
                    self.text.push_str(" }");
                }
            }
            Item::Fluent(decl) => {
                self.keyword("fluent", &decl.name);
                self.in_parentheses(&decl.params);
            }
            Item::Measure(decl) => {
                self.keyword("measure", &decl.name);
                self.in_parentheses(&decl.params);
                self.result(&decl.result);
            }
            Item::Failure(decl) => self.keyword("failure", &decl.name),
            Item::Enum(decl) => {
                self.keyword("enum", &decl.name);
                self.text.push_str(" { ");
                expr::names(&mut self.text, &decl.cases);
                self.text.push_str(" }");
            }
            Item::Entities(decl) => {
                self.text.push_str("entity ");
                expr::names(&mut self.text, &decl.names);
                self.text.push_str(": ");
                expr::name(&mut self.text, &decl.kind.text);
            }
            Item::Initially(decl) => {
                self.text.push_str("initially ");
                let facts: Vec<String> = decl.facts.iter().map(super::expression).collect();
                self.entries(&facts, "    ");
            }
            Item::ClosedWorld(_) => self.text.push_str("closed world"),
            Item::Primitive(decl) => return self.primitive(decl),
            Item::Policy(policy) => return self.policy(policy),
        }
        self.end(span.end);
    }

    fn keyword(&mut self, keyword: &str, name: &Name) {
        self.text.push_str(keyword);
        self.text.push(' ');
        expr::name(&mut self.text, &name.text);
    }

    fn policy(&mut self, policy: &Policy) {
        self.keyword("policy", &policy.name);
        if !policy.params.is_empty() {
            self.in_parentheses(&policy.params);
        }
        if let Some(result) = &policy.result {
            self.result(result);
        }
        if let Some(robot) = &policy.robot {
            self.text.push_str(" for ");
            expr::name(&mut self.text, &robot.text);
        }
        if let Some(goal) = &policy.achieves {
            self.text.push_str(" achieves ");
            expr::write(&mut self.text, goal);
        }
        self.text.push(' ');
        if !policy.keeps.is_empty() {
            self.keeps(&policy.keeps);
            self.text.push(' ');
        }
        self.block(&policy.body);
        if let Some(cleanup) = &policy.cleanup {
            self.finally(cleanup);
        }
        self.end(policy.span.end);
    }

    fn primitive(&mut self, decl: &PrimitiveDecl) {
        let keyword = match decl.kind {
            PrimitiveKind::Action => "action",
            PrimitiveKind::Perception => "perception",
        };
        self.keyword(keyword, &decl.name);
        self.in_parentheses(&decl.params);
        if let Some(result) = &decl.result {
            self.result(result);
        }
        let params_end = decl.params.last().map_or(decl.name.span.end, |param| param.ty.span().end);
        self.end(decl.result.as_ref().map_or(params_end, |result| result.span().end));
        // A clause has no span of its own: its entries stand for it.
        self.indented(|writer| {
            for clause in &decl.clauses {
                let span = clause_span(clause).unwrap_or(decl.span);
                writer.begin(span.start, Blank::AsWritten);
                writer.clause(clause);
                writer.end(span.end);
            }
        });
    }

    fn clause(&mut self, clause: &Clause) {
        let (keyword, entries) = match clause {
            Clause::Needs(entries) => ("needs", quantified(entries)),
            Clause::Makes(entries) => ("makes", quantified(entries)),
            Clause::Unsettles(entries) => ("unsettles", quantified(entries)),
            Clause::Motion(call) => {
                let mut text = String::new();
                expr::call(&mut text, call);
                ("motion", vec![text])
            }
            Clause::Uses(names) => ("uses", each_name(names)),
            Clause::Takes { least, greatest } => {
                ("takes", vec![format!("{} .. {}", super::expression(least), super::expression(greatest))])
            }
            Clause::Fails(names) => ("fails", each_name(names)),
            Clause::Lasts(names) => {
                let mut entries = each_name(names);
                if let Some(first) = entries.first_mut() {
                    first.insert_str(0, "until ");
                }
                ("lasts", entries)
            }
        };
        self.text.push_str(&format!("{keyword:CLAUSE_WIDTH$}"));
        self.entries(&entries, &" ".repeat(4 + CLAUSE_WIDTH));
    }

    /// Entries with commas, broken where the line is full.
    fn entries(&mut self, entries: &[String], indent: &str) {
        for (index, entry) in entries.iter().enumerate() {
            let is_last = index + 1 == entries.len();
            if index > 0 {
                let width = entry.chars().count() + usize::from(!is_last);
                if self.column() + 1 + width > LINE_WIDTH {
                    self.text.push('\n');
                    self.text.push_str(indent);
                } else {
                    self.text.push(' ');
                }
            }
            self.text.push_str(entry);
            if !is_last {
                self.text.push(',');
            }
        }
    }

    fn in_parentheses(&mut self, params: &[Param]) {
        self.text.push('(');
        self.params(params);
        self.text.push(')');
    }

    fn params(&mut self, params: &[Param]) {
        for (index, param) in params.iter().enumerate() {
            if index > 0 {
                self.text.push_str(", ");
            }
            expr::name(&mut self.text, &param.name.text);
            self.text.push_str(": ");
            type_expr(&mut self.text, &param.ty);
            if let Some(default) = &param.default {
                self.text.push_str(" = ");
                expr::write(&mut self.text, default);
            }
        }
    }

    fn result(&mut self, result: &TypeExpr) {
        self.text.push_str(" -> ");
        type_expr(&mut self.text, result);
    }
}

/// The documentation and the place of a declaration.
fn head(item: &Item) -> (&str, Span) {
    match item {
        Item::Kind(decl) => (&decl.doc, decl.span),
        Item::Fluent(decl) => (&decl.doc, decl.span),
        Item::Measure(decl) => (&decl.doc, decl.span),
        Item::Failure(decl) => (&decl.doc, decl.span),
        Item::Enum(decl) => (&decl.doc, decl.span),
        Item::Entities(decl) => (&decl.doc, decl.span),
        Item::Initially(decl) => ("", decl.span),
        Item::ClosedWorld(span) => ("", *span),
        Item::Primitive(decl) => (&decl.doc, decl.span),
        Item::Policy(policy) => (&policy.doc, policy.span),
    }
}

/// Checks if a declaration takes more than one line.
fn stands_apart(item: &Item) -> bool {
    let has_body = match item {
        Item::Primitive(decl) => !decl.clauses.is_empty(),
        Item::Policy(_) => true,
        _ => false,
    };
    has_body || !head(item).0.is_empty()
}

fn type_expr(text: &mut String, ty: &TypeExpr) {
    match ty {
        TypeExpr::Named(name) => expr::name(text, &name.text),
        TypeExpr::List(element, _) => {
            text.push_str("List<");
            type_expr(text, element);
            text.push('>');
        }
    }
}

fn each_name(names: &[Name]) -> Vec<String> {
    let quoted = |name: &Name| {
        let mut text = String::new();
        expr::name(&mut text, &name.text);
        text
    };
    names.iter().map(quoted).collect()
}

fn quantified(entries: &[Quantified]) -> Vec<String> {
    let whole = |entry: &Quantified| {
        let mut text = super::expression(&entry.expr);
        if let Some((name, ty)) = &entry.each {
            text.push_str(" for each ");
            expr::name(&mut text, &name.text);
            text.push_str(": ");
            type_expr(&mut text, ty);
        }
        if let Some(when) = &entry.when {
            text.push_str(" when ");
            expr::write(&mut text, when);
        }
        text
    };
    entries.iter().map(whole).collect()
}

/// From the first to the last entry of a clause.
fn clause_span(clause: &Clause) -> Option<Span> {
    let of_names = |names: &[Name]| Some(names.first()?.span.to(names.last()?.span));
    let of_entries = |entries: &[Quantified]| {
        let last = entries.last()?;
        let end = last.when.as_ref().map(|when| when.span).or(last.each.as_ref().map(|(_, ty)| ty.span()));
        Some(entries.first()?.expr.span.to(end.unwrap_or(last.expr.span)))
    };
    let of_pair = |least: &Expr, greatest: &Expr| Some(least.span.to(greatest.span));
    match clause {
        Clause::Needs(entries) | Clause::Makes(entries) | Clause::Unsettles(entries) => of_entries(entries),
        Clause::Motion(call) => Some(call.span),
        Clause::Uses(names) | Clause::Fails(names) | Clause::Lasts(names) => of_names(names),
        Clause::Takes { least, greatest } => of_pair(least, greatest),
    }
}
