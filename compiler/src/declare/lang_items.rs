//! Language items: the names of [`motet_stdlib::lang`] as ids of a library.

use motet_stdlib::lang;

use super::library::Names;
use crate::ir::{EnumId, Failure, Fluent, Kind, Measure};

/// Declarations of the standard library that the compiler knows by name; `None` for one that a library does
/// not
/// declare.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LangItems {
    pub(crate) place: Option<Kind>,
    pub(crate) surface: Option<Kind>,
    pub(crate) container: Option<Kind>,
    pub(crate) object: Option<Kind>,
    pub(crate) person: Option<Kind>,
    pub(crate) approach: Option<EnumId>,
    pub(crate) hand: Option<EnumId>,
    pub(crate) at: Option<Fluent>,
    pub(crate) clear: Option<Fluent>,
    pub(crate) free: Option<Fluent>,
    pub(crate) holding: Option<Fluent>,
    pub(crate) inside: Option<Fluent>,
    pub(crate) lifted: Option<Fluent>,
    pub(crate) located: Option<Fluent>,
    pub(crate) locked: Option<Fluent>,
    pub(crate) near: Option<Fluent>,
    pub(crate) on: Option<Fluent>,
    pub(crate) open: Option<Fluent>,
    pub(crate) reachable: Option<Fluent>,
    pub(crate) visible: Option<Fluent>,
    pub(crate) visited: Option<Fluent>,
    pub(crate) distance: Option<Measure>,
    pub(crate) blocked: Option<Failure>,
    pub(crate) exhausted: Option<Failure>,
    pub(crate) failed: Option<Failure>,
    pub(crate) not_found: Option<Failure>,
    pub(crate) too_heavy: Option<Failure>,
    pub(crate) unreachable: Option<Failure>,
    pub(crate) harm: Option<Failure>,
}

impl LangItems {
    /// Looks up the items among the names of a library.
    pub(super) fn of(names: &Names) -> Self {
        let kind = |name: &str| names.kinds.get(name).copied();
        let enumeration = |name: &str| names.enums.get(name).copied();
        let fluent = |name: &str| names.fluents.get(name).copied();
        let failure = |name: &str| names.failures.get(name).copied();
        Self {
            place: kind(lang::kinds::PLACE),
            surface: kind(lang::kinds::SURFACE),
            container: kind(lang::kinds::CONTAINER),
            object: kind(lang::kinds::OBJECT),
            person: kind(lang::kinds::PERSON),
            approach: enumeration(lang::enums::APPROACH),
            hand: enumeration(lang::card_enums::HAND),
            at: fluent(lang::fluents::AT),
            clear: fluent(lang::fluents::CLEAR),
            free: fluent(lang::fluents::FREE),
            holding: fluent(lang::fluents::HOLDING),
            inside: fluent(lang::fluents::IN),
            lifted: fluent(lang::fluents::LIFTED),
            located: fluent(lang::fluents::LOCATED),
            locked: fluent(lang::fluents::LOCKED),
            near: fluent(lang::fluents::NEAR),
            on: fluent(lang::fluents::ON),
            open: fluent(lang::fluents::OPEN),
            reachable: fluent(lang::fluents::REACHABLE),
            visible: fluent(lang::fluents::VISIBLE),
            visited: fluent(lang::fluents::VISITED),
            distance: names.measures.get(lang::measures::DISTANCE).copied(),
            blocked: failure(lang::failures::BLOCKED),
            exhausted: failure(lang::failures::EXHAUSTED),
            failed: failure(lang::failures::FAILED),
            not_found: failure(lang::failures::NOT_FOUND),
            too_heavy: failure(lang::failures::TOO_HEAVY),
            unreachable: failure(lang::failures::UNREACHABLE),
            harm: failure(lang::failures::UNSAFE),
        }
    }

    /// Fluents that depend on the poses of the robot and of things.
    pub(crate) fn poses(&self) -> impl Iterator<Item = Fluent> {
        [self.at, self.on, self.inside, self.holding, self.open, self.lifted].into_iter().flatten()
    }

    /// Failure of a guard on a fluent.
    pub(crate) fn guard_failure(&self, fluent: Fluent) -> Option<Failure> {
        let is_one_of = |fluents: &[Option<Fluent>]| fluents.contains(&Some(fluent));
        if is_one_of(&[self.reachable, self.at, self.near]) {
            self.unreachable
        } else if is_one_of(&[self.visible, self.located]) {
            self.not_found
        } else if is_one_of(&[self.clear, self.open, self.locked]) {
            self.blocked
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use motet_stdlib::lang;
    use motet_syntax::Sources;

    use crate::declare::Library;

    #[test]
    fn lang_items_are_declared_in_the_standard_library() {
        let library = Library::builder(None, &mut Sources::default()).build().0;
        let names = &library.names;
        let missing = |all: &[&'static str], is_declared: &dyn Fn(&str) -> bool| {
            all.iter().copied().filter(|name| !is_declared(name)).collect::<Vec<_>>()
        };
        assert_eq!(missing(lang::kinds::ALL, &|name| names.kinds.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::enums::ALL, &|name| names.enums.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::card_enums::ALL, &|name| names.enums.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::approaches::ALL, &|name| names.cases.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::entities::ALL, &|name| names.entities.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::fluents::ALL, &|name| names.fluents.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::measures::ALL, &|name| names.measures.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::failures::ALL, &|name| names.failures.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::builtin_failures::ALL, &|name| names.failures.contains_key(name)), [""; 0]);
        let object =
            library.lang_items.object.map(|kind| library.fields_of(kind).cloned().collect::<Vec<_>>());
        let object = object.unwrap_or_default();
        assert_eq!(missing(lang::fields::ALL, &|name| object.iter().any(|field| field == name)), [""; 0]);
    }
}
