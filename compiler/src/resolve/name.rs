//! What a name means: a binding, an entity, a case; and what is said of one that means nothing.

use motet_syntax::Span;
use smol_str::SmolStr;

use super::errors::{UnknownBinding, UnknownCase, UnknownName};
use super::expr::{Resolver, Wanted, parse_quantity};
use super::near::{list, near};
use crate::ir::{Base, EnumId, Term, Ty};

impl Resolver<'_> {
    pub(super) fn name(&mut self, name: &SmolStr, span: Span, wanted: Option<Wanted<'_>>) -> (Term, Ty) {
        if let Some(found) = self.in_scope(name) {
            return found;
        }
        if let Some(Wanted { ty: Ty { base: Base::Enum(id), .. }, .. }) = wanted
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
        self.unknown_name(name, span, wanted);
        (Term::Unknown, Ty::UNKNOWN)
    }

    /// A plain string of the JSON form.
    pub(super) fn plain(&mut self, text: &SmolStr, span: Span, wanted: Option<Wanted<'_>>) -> (Term, Ty) {
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
                None => (Term::Text(text.clone()), Ty::TEXT),
            };
        };
        match ty {
            Ty { base: Base::Text | Base::Unknown, lists: 0 } => (Term::Text(text.clone()), Ty::TEXT),
            Ty { base: Base::Entity(_), .. } => match self.entities.find(text) {
                Some((entity, kind)) => (Term::Entity(entity), Ty::plain(Base::Entity(kind))),
                None => {
                    self.unknown_name(text, span, wanted);
                    (Term::Unknown, Ty::UNKNOWN)
                }
            },
            Ty { base: Base::Enum(id), .. } => match self.case_of(id, text) {
                Some(case) => case,
                None => {
                    self.unknown_name(text, span, wanted);
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
            | Ty { base: Base::Quantity(_), .. } => (Term::Text(text.clone()), Ty::TEXT),
        }
    }

    pub(super) fn in_scope(&mut self, name: &str) -> Option<(Term, Ty)> {
        let entry = self.scope.find(name)?;
        let found = (entry.term.clone(), entry.ty);
        if let Term::Binding(id) = found.0
            && let Some(binding) = self.bindings.get_mut(id.index())
        {
            binding.uses += 1;
        }
        Some(found)
    }

    pub(super) fn binding(&mut self, name: &SmolStr, span: Span) -> (Term, Ty) {
        if let Some(found) = self.in_scope(name) {
            return found;
        }
        let same = self.entities.find(name).map(|_| name.clone());
        let near = same.or_else(|| near(name, self.scope.names().map(SmolStr::as_str)));
        self.say(UnknownBinding { span, name: name.clone(), near });
        (Term::Unknown, Ty::UNKNOWN)
    }

    pub(super) fn case_of(&self, id: EnumId, name: &str) -> Option<(Term, Ty)> {
        let def = self.library.enums.get(id.index())?;
        let case = def.cases.iter().position(|case| case == name)?;
        Some((Term::Case(id, u16::try_from(case).ok()?), Ty::plain(Base::Enum(id))))
    }

    pub(super) fn unknown_name(&mut self, name: &SmolStr, span: Span, wanted: Option<Wanted<'_>>) {
        let name = name.clone();
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
                self.say(mistake);
            }
            Some(Base::Entity(kind)) => {
                let fitting: Vec<_> =
                    self.entities.iter().filter(|(_, _, other)| library.is_kind(*other, kind)).collect();
                let names =
                    self.scope.names().map(SmolStr::as_str).chain(fitting.iter().map(|row| row.1.as_str()));
                let near = near(&name, names);
                let known = if fitting.len() <= 12 {
                    list(fitting.iter().map(|row| row.1.clone()))
                } else {
                    String::new()
                };
                let wanted = format!("`{}`", library.type_name(Ty::plain(Base::Entity(kind))));
                let scene = self.has_scene;
                self.say(UnknownName { span, name, near, wanted, known, scene, about });
            }
            Some(_) | None => {
                let names = self.scope.names().map(SmolStr::as_str);
                let near = near(&name, names.chain(self.entities.iter().map(|row| row.1.as_str())));
                let scene = self.has_scene;
                self.say(UnknownName {
                    span,
                    name,
                    near,
                    wanted: String::new(),
                    known: String::new(),
                    scene,
                    about,
                });
            }
        }
    }
}
