//! Edits that rename a name in its document.

use motet_syntax::words::{is_bare_name, is_name};
use motet_syntax::{Edit, Parsed, Syntax};

use super::names::{NameSpace, Occurrence, name_at, occurrences};

/// Name at an offset that can be renamed.
///
/// # Errors
///
/// A clause that says why nothing there can be renamed.
pub(crate) fn renamable(all: &[Occurrence], offset: usize) -> Result<&Occurrence, String> {
    let named = name_at(all, offset).ok_or("there is no name here")?;
    let is_its_own = |place: &&Occurrence| place.is_same(named) && place.is_declaration;
    match named.space {
        NameSpace::Local | NameSpace::Callable | NameSpace::Relation | NameSpace::Type | NameSpace::Value
            if all.iter().any(|place| is_its_own(&place)) =>
        {
            Ok(named)
        }
        NameSpace::Group => Ok(named),
        _ => Err(format!("`{}` is not declared in this document", named.name)),
    }
}

/// Edits that give the name at an offset another name, everywhere in the document.
///
/// # Errors
///
/// A clause that says why: the name is not of this document, the new one is no name, or it is taken.
pub(crate) fn rename(parsed: &Parsed, offset: usize, new: &str) -> Result<Vec<Edit>, String> {
    let all = occurrences(parsed);
    let named = renamable(&all, offset)?;
    if !is_name(new) {
        return Err(format!("`{new}` is no name"));
    }
    let is_taken = |place: &Occurrence| {
        let meets = match (named.space, place.space) {
            // A local name hides a value of the same name.
            (NameSpace::Local, NameSpace::Local) => named.item == place.item,
            (NameSpace::Local, NameSpace::Value) | (NameSpace::Value, NameSpace::Local) => true,
            (one, other) => one == other,
        };
        meets && place.name == new && !place.is_same(named)
    };
    if new != named.name && all.iter().any(is_taken) {
        return Err(format!("there is a name `{new}` already"));
    }
    let is_quoted = parsed.syntax == Syntax::Text && !is_bare_name(new);
    let places = all.iter().filter(|place| place.is_same(named));
    let edits = places.map(|place| {
        let text = if is_quoted { format!("`{new}`") } else { new.to_owned() };
        let mut span = place.span;
        // The quotes of the old name go with it.
        let range = span.range();
        let has_quotes = range.start > 0
            && parsed.text.get(range.start - 1..range.start) == Some("`")
            && parsed.text.get(range.end..range.end + 1) == Some("`");
        if has_quotes {
            span = motet_syntax::Span { start: span.start - 1, end: span.end + 1, ..span };
        }
        Edit { span, text }
    });
    Ok(edits.collect())
}

#[cfg(test)]
mod tests {
    use motet_syntax::{FileId, Fix, Source};

    fn check(text: &str, at: &str, new: &str, expected: Result<&str, &str>) {
        let parsed = motet_syntax::read(&Source::new("test", text), FileId(0));
        let renamed = super::rename(&parsed, text.find(at).unwrap(), new);
        let renamed = renamed.map(|edits| {
            let fix = Fix { title: String::new(), edits };
            motet_compiler::fix::apply(text, FileId(0), &fix).unwrap()
        });
        assert_eq!(renamed.as_deref().map_err(String::as_str), expected);
    }

    #[test]
    fn rename_changes_every_place_of_a_name() {
        let text = "policy p { let x = detect(\"the {x}\") pick(x) } policy q { p() }";
        check(
            text,
            "x =",
            "mug",
            Ok("policy p { let mug = detect(\"the {mug}\") pick(mug) } policy q { p() }"),
        );
        check(text, "p()", "r", Ok("policy r { let x = detect(\"the {x}\") pick(x) } policy q { r() }"));
        check(
            text,
            "x =",
            "7 up",
            Ok("policy p { let `7 up` = detect(\"the {`7 up`}\") pick(`7 up`) } policy q { p() }"),
        );
        check("policy p { let `a b` = 1 go(`a b`) }", "a b", "c", Ok("policy p { let c = 1 go(c) }"));
        let json = |name: &str| {
            let detect = format!(r#"{{"do": "detect", "what": "m", "as": "{name}"}}"#);
            let pick = format!(r#"{{"do": "pick", "object": "${name}"}}"#);
            format!(r#"{{"policy": "p", "steps": [{detect}, {pick}]}}"#)
        };
        check(&json("x"), "x\"}, ", "y", Ok(&json("y")));
    }

    #[test]
    fn rename_refuses_what_it_would_break() {
        let text = "entity cup: Object policy p { let x = 1 let y = 2 go(cup) pick(x) }";
        check(text, "x =", "y", Err("there is a name `y` already"));
        check(text, "x =", "cup", Err("there is a name `cup` already"));
        check(text, "pick", "take", Err("`pick` is not declared in this document"));
        check(text, "x =", "a`b", Err("`a`b` is no name"));
        check(text, "{ let", "a", Err("there is no name here"));
    }
}
