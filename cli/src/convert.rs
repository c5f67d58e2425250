//! Conversion of a document between text and JSON. Types are filled in first where one syntax leaves them
//! open.

use motet_compiler::{Library, settle};
use motet_syntax::ast::{Item, Policy};
use motet_syntax::{Parsed, Syntax, print};

/// Writes a document, or one policy of it, in a syntax.
///
/// # Errors
///
/// Reason why the syntax cannot express the document, as one clause.
pub(crate) fn write(
    parsed: &Parsed,
    policy: Option<&str>,
    library: &Library,
    syntax: Syntax,
) -> Result<String, String> {
    let mut file = parsed.file.clone();
    if let Some(name) = policy {
        file.items.retain(|item| matches!(item, Item::Policy(policy) if policy.name.text == name));
        if file.items.is_empty() {
            return Err(format!("there is no policy `{name}`"));
        }
    }
    for item in &mut file.items {
        if let Item::Policy(policy) = item {
            settle(policy, library, syntax);
        }
    }
    match syntax {
        Syntax::Text => Ok(print::text(&file)),
        Syntax::Json => Ok(print::policy_json(only(&file.items)?)),
    }
}

/// Only policy of a document, which has no parameters.
fn only(items: &[Item]) -> Result<&Policy, String> {
    let rule = "a JSON document holds exactly one policy without parameters";
    match items {
        [Item::Policy(policy)] if policy.params.is_empty() => Ok(policy),
        [Item::Policy(policy)] => Err(format!("`{}` has parameters, and {rule}", policy.name.text)),
        [] => Err(format!("there is no policy, and {rule}")),
        [_] => Err(format!("there is no policy but another declaration, and {rule}")),
        more => Err(format!("there are {} declarations, and {rule}", more.len())),
    }
}
