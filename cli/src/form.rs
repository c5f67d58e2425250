//! A document in one form or the other. What one form leaves to its types is settled first, so that the other can say it.

use motet_compiler::{Library, settle};
use motet_syntax::ast::{Item, Policy};
use motet_syntax::{Parsed, Syntax, print};

/// Writes a document in a form.
///
/// # Errors
///
/// Why the form cannot say it, as one clause.
pub(crate) fn write(
    parsed: &Parsed,
    policy: Option<&str>,
    library: &Library,
    form: Syntax,
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
            settle(policy, library, form);
        }
    }
    match form {
        Syntax::Text => Ok(print::text(&file)),
        Syntax::Json => Ok(print::policy_json(only(&file.items)?)),
    }
}

/// The one policy without parameters of a document.
fn only(items: &[Item]) -> Result<&Policy, String> {
    let rule = "a JSON document is exactly one policy without parameters";
    match items {
        [Item::Policy(policy)] if policy.params.is_empty() => Ok(policy),
        [Item::Policy(policy)] => Err(format!("`{}` has parameters, and {rule}", policy.name.text)),
        [] => Err(format!("there is no policy, and {rule}")),
        [_] => Err(format!("there is no policy but another declaration, and {rule}")),
        more => Err(format!("there are {} declarations, and {rule}", more.len())),
    }
}
