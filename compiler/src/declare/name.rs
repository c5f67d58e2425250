//! Resolution of names to bindings, entities and cases, and the diagnostics of unknown names.

use motet_syntax::words::is_bare_name;
use motet_syntax::{Diagnostic, Mistake as _, Span};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use smol_str::{SmolStr, format_smolstr};

use super::diagnostics::{UnknownBinding, UnknownCase, UnknownName};
use super::elaborator::{Elaborator, Expected, parse_quantity};
use super::unbound::UnboundName;
use crate::ir::{Base, BindingId, EnumId, Term, Ty};

impl Elaborator<'_> {
    pub(super) fn name(&mut self, name: &SmolStr, span: Span, wanted: Option<Expected<'_>>) -> (Term, Ty) {
        if let Some(found) = self.in_scope(name, span) {
            return found;
        }
        if let Some(Expected { ty: Ty { base: Base::Enum(id), .. }, .. }) = wanted
            && let Some(case) = self.case_of(id, name)
        {
            return case;
        }
        if let Some((entity, kind)) = self.entities.find(name) {
            return (Term::Entity(entity), Ty::plain(Base::Entity(kind)));
        }
        if let Some((id, case)) = self.library.names.cases.get(name) {
            return (Term::Case(*id, *case), Ty::plain(Base::Enum(*id)));
        }
        self.unknown_name(name, span, wanted, NameNotation::Bare);
        (Term::Unknown, Ty::UNKNOWN)
    }

    /// Elaborates a plain string of the JSON syntax.
    pub(super) fn plain(&mut self, text: &SmolStr, span: Span, wanted: Option<Expected<'_>>) -> (Term, Ty) {
        let Some(ty) = wanted.map(|wanted| wanted.ty) else {
            if let Some((entity, kind)) = self.entities.find(text) {
                return (Term::Entity(entity), Ty::plain(Base::Entity(kind)));
            }
            if let Some((id, case)) = self.library.names.cases.get(text) {
                return (Term::Case(*id, *case), Ty::plain(Base::Enum(*id)));
            }
            return match parse_quantity(text) {
                Some((value, unit)) => {
                    (Term::Number(unit.to_si(value)), Ty::plain(Base::Quantity(unit.dimension())))
                }
                None if is_bare_name(text) => {
                    self.unknown_name(text, span, wanted, NameNotation::Quoted);
                    (Term::Unknown, Ty::UNKNOWN)
                }
                None => (Term::Text(text.clone()), Ty::TEXT),
            };
        };
        match ty {
            Ty { base: Base::Text | Base::Unknown, lists: 0 } => (Term::Text(text.clone()), Ty::TEXT),
            Ty { base: Base::Entity(_), .. } => match self.entities.find(text) {
                Some((entity, kind)) => (Term::Entity(entity), Ty::plain(Base::Entity(kind))),
                None => {
                    self.unknown_name(text, span, wanted, NameNotation::Quoted);
                    (Term::Unknown, Ty::UNKNOWN)
                }
            },
            Ty { base: Base::Enum(id), .. } => match self.case_of(id, text) {
                Some(case) => case,
                None => {
                    self.unknown_name(text, span, wanted, NameNotation::Quoted);
                    (Term::Unknown, Ty::UNKNOWN)
                }
            },
            Ty { base: Base::Quantity(_), lists: 0 } => match parse_quantity(text) {
                Some((value, unit)) => {
                    (Term::Number(unit.to_si(value)), Ty::plain(Base::Quantity(unit.dimension())))
                }
                None => (Term::Text(text.clone()), Ty::TEXT),
            },
            Ty {
                base: Base::Bool | Base::Int | Base::Number | Base::Pose | Base::Text | Base::Unknown,
                ..
            }
            | Ty { base: Base::Failure, .. }
            | Ty { base: Base::Quantity(_), .. } => (Term::Text(text.clone()), Ty::TEXT),
        }
    }

    /// Meaning of a name that is bound here, or was bound before on some paths only, which is an error.
    fn in_scope(&mut self, name: &SmolStr, span: Span) -> Option<(Term, Ty)> {
        let entry = self.scope.latest(name)?;
        let Some(unbound) = &entry.unbound else {
            let (term, value, ty) = (entry.term.clone(), entry.value.clone(), entry.ty);
            if let Term::Binding(id) | Term::Caught(_, id) = term {
                self.count_use(id);
            }
            return Some((value.unwrap_or(term), ty));
        };
        // One report is enough for all uses of a binding.
        if self.unbound_told.insert(entry.span) {
            let (said, ids) = (unbound.report(name, span, entry.span), unbound.ids.clone());
            self.diagnostics.push(said);
            ids.into_iter().for_each(|id| self.count_use(id));
        }
        Some((Term::Unknown, Ty::UNKNOWN))
    }

    /// Counts a use of a binding.
    pub(crate) fn count_use(&mut self, id: BindingId) {
        if let Some(binding) = self.bindings.get_mut(id.index()) {
            binding.uses += 1;
        }
    }

    pub(super) fn binding(&mut self, name: &SmolStr, span: Span, wanted: Option<Expected<'_>>) -> (Term, Ty) {
        if let Some(found) = self.in_scope(name, span) {
            return found;
        }
        if self.is_behind_gap {
            return (Term::Unknown, Ty::UNKNOWN);
        }
        let same = self.entities.find(name).map(|_| name.clone());
        let near = same.or_else(|| near(name, self.scope.names().map(SmolStr::as_str)));
        let is_text = wanted.is_some_and(|wanted| wanted.ty == Ty::TEXT);
        self.report_unbound(name, UnknownBinding { span, name: name.clone(), near, is_text });
        (Term::Unknown, Ty::UNKNOWN)
    }

    /// Reports a use of a name that nothing binds. Another use of it is mended by the fix of the first
    /// report, and needs none of its own.
    fn report_unbound(&mut self, name: &SmolStr, mistake: impl Into<Diagnostic>) {
        let said: Diagnostic = mistake.into();
        let first = self.unbound.get(name).and_then(|place| self.diagnostics.get_mut(*place));
        match first.filter(|first| first.code == UnknownBinding::CODE) {
            Some(first) => {
                if let (Some(fix), Some(more)) = (&mut first.fix, said.fix) {
                    fix.edits.extend(more.edits);
                }
            }
            None => {
                self.unbound.insert(name.clone(), self.diagnostics.len());
                self.diagnostics.push(said);
            }
        }
    }

    pub(super) fn case_of(&self, id: EnumId, name: &str) -> Option<(Term, Ty)> {
        let def = self.library.enums.get(id.index())?;
        let case = def.cases.iter().position(|case| case == name)?;
        Some((Term::Case(id, u16::try_from(case).ok()?), Ty::plain(Base::Enum(id))))
    }

    fn unknown_name(
        &mut self,
        name: &SmolStr,
        span: Span,
        wanted: Option<Expected<'_>>,
        written: NameNotation,
    ) {
        if self.is_behind_gap && written == NameNotation::Bare || self.has_too_many_errors() {
            return;
        }
        // What a string of JSON writes with a `$` has no `$` in the braces of a text.
        if written == NameNotation::Bare
            && self.unbound.get(name).is_some_and(|place| *place < self.diagnostics.len())
        {
            return;
        }
        let name = name.clone();
        let call = self.call_of(&name).filter(|_| written == NameNotation::Bare);
        let library = self.library;
        let about = wanted.and_then(|wanted| wanted.place.about());
        match wanted.map(|wanted| wanted.ty.base) {
            Some(Base::Enum(id)) => {
                let cases = library.enums.get(id.index()).map(|def| def.cases.as_slice()).unwrap_or_default();
                let mistake = UnknownCase {
                    span,
                    of: format!("`{}`", library.type_name(Ty::plain(Base::Enum(id)))),
                    near: near(&name, cases.iter().map(SmolStr::as_str)),
                    known: list(cases.iter().cloned()),
                    name,
                };
                self.report(mistake);
            }
            Some(Base::Entity(kind)) => {
                let fitting: Vec<_> =
                    self.entities.iter().filter(|(_, _, other)| library.is_kind(*other, kind)).collect();
                let names =
                    self.scope.names().map(SmolStr::as_str).chain(fitting.iter().map(|row| row.1.as_str()));
                // A room is none of the things in it: `kitchen` is not `kitchen_table`.
                let names = names.filter(|known| !is_begun(&name, known));
                let near = near(&name, names).map(|near| self.spelled(near, written));
                let known = if fitting.len() <= 12 {
                    list(fitting.iter().map(|row| row.1.clone()))
                } else {
                    String::new()
                };
                let wanted = format!("`{}`", library.type_name(Ty::plain(Base::Entity(kind))));
                let scene = self.has_scene;
                let is_quoted = false;
                self.report(UnknownName { span, name, near, wanted, known, scene, about, call, is_quoted });
            }
            Some(_) | None => {
                let names = self.scope.names().map(SmolStr::as_str);
                let near = near(&name, names.chain(self.entities.iter().map(|row| row.1.as_str())))
                    .map(|near| self.spelled(near, written));
                let scene = self.has_scene;
                self.report(UnknownName {
                    span,
                    name,
                    near,
                    wanted: String::new(),
                    known: String::new(),
                    scene,
                    about,
                    call,
                    is_quoted: written == NameNotation::Quoted,
                });
            }
        }
    }

    /// Spelling of a known name in the document: a binding in a JSON string has a `$`.
    fn spelled(&self, name: SmolStr, written: NameNotation) -> SmolStr {
        match written {
            NameNotation::Quoted if self.scope.find(&name).is_some() => format_smolstr!("${name}"),
            NameNotation::Quoted | NameNotation::Bare => name,
        }
    }

    /// Call of the fluent or measure with a name: `distance(to)`.
    fn call_of(&self, name: &str) -> Option<String> {
        let names = &self.library.names;
        let fluent = names.fluents.get(name).and_then(|id| self.library.fluent(*id)).map(|def| &def.params);
        let measure =
            || names.measures.get(name).and_then(|id| self.library.measure(*id)).map(|def| &def.params);
        let params: Vec<&str> = fluent.or_else(measure)?.iter().map(|(param, _)| param.as_str()).collect();
        Some(format!("{name}({})", params.join(", ")))
    }
}

/// A name is the first word of a longer one that goes on with another word, and not with a number.
fn is_begun(name: &str, known: &str) -> bool {
    let rest = known.strip_prefix(name).and_then(|rest| rest.strip_prefix('_'));
    rest.is_some_and(|rest| rest.bytes().any(|byte| byte.is_ascii_alphabetic()))
}

/// Notation of a name in the document.
#[derive(Clone, Copy, PartialEq, Eq)]
enum NameNotation {
    Bare,
    /// In a string of the JSON syntax.
    Quoted,
}

/// Stack of names. A barrier hides the names below it: the body of an inlined policy does not see its caller.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scope {
    entries: Vec<ScopeEntry>,
    /// By name, the places of its entries, in order.
    places: FxHashMap<SmolStr, SmallVec<[usize; 1]>>,
    barrier: usize,
}

/// Name in scope with its meaning.
#[derive(Clone, Debug)]
pub(crate) struct ScopeEntry {
    pub(crate) name: SmolStr,
    pub(crate) term: Term,
    /// What a `let` gave the name, where that is a constant or another name: it stands for it.
    pub(crate) value: Option<Term>,
    pub(crate) ty: Ty,
    pub(crate) span: Span,
    /// Reason for which the name, which was bound before, has no value here.
    pub(crate) unbound: Option<UnboundName>,
    /// True behind the block that bound it, where another binding may have its name.
    pub(crate) is_free: bool,
}

/// State of the stack, to restore later.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScopeMark {
    len: usize,
    barrier: usize,
}

impl Scope {
    pub(crate) fn push(&mut self, name: SmolStr, term: Term, ty: Ty, span: Span) {
        self.extend([ScopeEntry { name, term, value: None, ty, span, unbound: None, is_free: false }]);
    }

    /// Lets the latest name stand for a value.
    pub(crate) fn stand_for(&mut self, value: Term) {
        if let Some(entry) = self.entries.last_mut() {
            entry.value = Some(value);
        }
    }

    pub(crate) fn extend(&mut self, entries: impl IntoIterator<Item = ScopeEntry>) {
        for entry in entries {
            self.places.entry(entry.name.clone()).or_default().push(self.entries.len());
            self.entries.push(entry);
        }
    }

    /// Leaves a block: the names bound since a mark stay visible, and others may bear them.
    pub(crate) fn end_block(&mut self, mark: ScopeMark) {
        self.entries.iter_mut().skip(mark.len).for_each(|entry| entry.is_free = true);
    }

    /// Entry of a name that has a value here.
    pub(crate) fn find(&self, name: &str) -> Option<&ScopeEntry> {
        self.latest(name).filter(|entry| entry.unbound.is_none())
    }

    /// Latest entry of a name, with or without a value.
    fn latest(&self, name: &str) -> Option<&ScopeEntry> {
        let place = self.places.get(name)?.last().filter(|place| **place >= self.barrier)?;
        self.entries.get(*place)
    }

    /// Names that have a value here.
    pub(crate) fn names(&self) -> impl Iterator<Item = &SmolStr> {
        let visible = |place: &usize, entry: &ScopeEntry| {
            entry.unbound.is_none()
                && self.places.get(&entry.name).and_then(|places| places.last()) == Some(place)
        };
        let entries = self.entries.iter().enumerate().skip(self.barrier);
        entries.filter(move |(place, entry)| visible(place, entry)).map(|(_, entry)| &entry.name)
    }

    pub(crate) fn mark(&self) -> ScopeMark {
        ScopeMark { len: self.entries.len(), barrier: self.barrier }
    }

    pub(crate) fn raise_barrier(&mut self) {
        self.barrier = self.entries.len();
    }

    pub(crate) fn back_to(&mut self, mark: ScopeMark) {
        self.take_since(mark);
    }

    /// Goes back to a mark, and returns the entries since then.
    pub(crate) fn take_since(&mut self, mark: ScopeMark) -> Vec<ScopeEntry> {
        self.barrier = mark.barrier;
        let taken = self.entries.split_off(mark.len.min(self.entries.len()));
        for entry in &taken {
            if let Some(places) = self.places.get_mut(&entry.name) {
                places.pop();
            }
        }
        taken
    }
}

/// Nearest known name to a written one, if one is near.
pub(crate) fn near<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<SmolStr> {
    motet_syntax::suggest::closest(name, known).map(SmolStr::new)
}

/// Joins names into a phrase: "`a`, `b` and `c`".
pub(crate) fn list(names: impl Iterator<Item = SmolStr>) -> String {
    let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    match names.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
    }
}

/// Name of a type with its article: "an `Object`".
pub(crate) fn article(name: &str) -> String {
    let vowel =
        name.chars().next().is_some_and(|first| matches!(first.to_ascii_lowercase(), 'a' | 'e' | 'i' | 'o'));
    format!("{} `{name}`", if vowel { "an" } else { "a" })
}
