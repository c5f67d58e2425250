//! Lists of typed names: `a b - block c - table d`.

use indexmap::IndexMap;
use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use crate::diagnostics::{Unsupported, WrongName, unknown};
use crate::s_expression::SExpr;

/// The type above all others, which what has no type is of.
pub(crate) const OBJECT: SmolStr = SmolStr::new_static("object");

/// A name, its type, and where the name stands.
#[derive(Clone, Debug)]
pub(crate) struct TypedName {
    pub(crate) name: SmolStr,
    pub(crate) ty: SmolStr,
    pub(crate) span: Span,
}

/// A type to the one above it. All but `object` have one, and `object` is above them all.
pub(crate) type TypeHierarchy = IndexMap<SmolStr, SmolStr>;

/// Constants and objects by their names.
pub(crate) type Objects = IndexMap<SmolStr, TypedName>;

/// Declarations that the formulas of a domain and its problems refer to.
#[derive(Clone, Debug, Default)]
pub(crate) struct DomainNames {
    pub(crate) types: TypeHierarchy,
    pub(crate) predicates: IndexMap<SmolStr, Vec<TypedName>>,
    pub(crate) constants: Objects,
}

/// Reads a typed list. Variables lose their `?`, and only they may stand where `variables` is asked for.
pub(crate) fn read(items: &[SExpr], wanted: ListItem, diagnostics: &mut Vec<Diagnostic>) -> Vec<TypedName> {
    let mut found: Vec<TypedName> = Vec::new();
    let mut typed = 0;
    let mut items = items.iter();
    while let Some(item) = items.next() {
        let Some(word) = item.word() else {
            diagnostics.push(item.not(wanted.word()).into());
            continue;
        };
        if word == "-" {
            let ty = match items.next() {
                Some(ty) => type_name(ty, diagnostics),
                None => {
                    diagnostics.push(item.not("a type behind the dash").into());
                    OBJECT
                }
            };
            for one in found.iter_mut().skip(typed) {
                one.ty = ty.clone();
            }
            typed = found.len();
            continue;
        }
        match (wanted, word.strip_prefix('?')) {
            (ListItem::Variables, Some(name)) if !name.is_empty() => {
                found.push(TypedName { name: name.into(), ty: OBJECT, span: item.span });
            }
            (ListItem::Names, None) if !word.starts_with(':') => {
                found.push(TypedName { name: word.clone(), ty: OBJECT, span: item.span });
            }
            _ => diagnostics.push(item.not(wanted.word()).into()),
        }
    }
    found
}

/// SExprKind of the items of a typed list.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ListItem {
    Variables,
    Names,
}

impl ListItem {
    fn word(self) -> &'static str {
        match self {
            Self::Variables => "a variable `?…`",
            Self::Names => "a name",
        }
    }
}

fn type_name(tree: &SExpr, diagnostics: &mut Vec<Diagnostic>) -> SmolStr {
    if let Some(word) = tree.word() {
        return word.clone();
    }
    if tree.form().is_some_and(|(head, _)| head == "either") {
        diagnostics
            .push(Unsupported { span: tree.span, what: "a union of types, `(either …)`,".into() }.into());
    } else {
        diagnostics.push(tree.not("a type").into());
    }
    OBJECT
}

/// The tree of types that a `:types` section declares. A parent that is not declared itself lies below
/// `object`.
pub(crate) fn hierarchy(declared: &[TypedName], diagnostics: &mut Vec<Diagnostic>) -> TypeHierarchy {
    let mut types = TypeHierarchy::new();
    for TypedName { name, ty, span } in declared.iter().filter(|one| one.name != OBJECT) {
        match types.get(name) {
            Some(before) if before != ty => {
                let what = format!("the type `{name}` below two others, `{before}` and `{ty}`,");
                diagnostics.push(Unsupported { span: *span, what }.into());
            }
            _ => {
                types.insert(name.clone(), ty.clone());
            }
        }
    }
    let implied: Vec<_> = types.values().filter(|ty| !types.contains_key(*ty)).cloned().collect();
    types.extend(implied.into_iter().filter(|ty| *ty != OBJECT).map(|ty| (ty, OBJECT)));
    for TypedName { name, span, .. } in declared {
        // A chain that is longer than there are types goes round.
        let chain = std::iter::successors(types.get(name), |ty| types.get(*ty));
        if chain.take(types.len() + 1).count() > types.len() {
            let what = format!("the type `{name}` lies below itself");
            diagnostics.push(WrongName { span: *span, what, help: None }.into());
            return types;
        }
    }
    types
}

/// Says which types of a list are not declared.
pub(crate) fn check(list: &[TypedName], types: &TypeHierarchy, diagnostics: &mut Vec<Diagnostic>) {
    for TypedName { ty, span, .. } in list {
        if *ty != OBJECT && !types.contains_key(ty) {
            let known = types.keys().map(SmolStr::as_str).chain(["object"]);
            diagnostics.push(unknown(*span, "type", ty, known).into());
        }
    }
}

/// Checks if `ty` is `ancestor` or a subtype of it. The hierarchy has no cycle.
pub(crate) fn is_type(types: &TypeHierarchy, ty: &SmolStr, ancestor: &SmolStr) -> bool {
    *ancestor == OBJECT
        || std::iter::successors(Some(ty), |ty| types.get(*ty)).take(types.len() + 1).any(|ty| ty == ancestor)
}
