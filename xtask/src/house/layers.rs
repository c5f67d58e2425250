//! Dependencies of crates against the order of the folders.

use std::path::Path;

use toml::{Table, Value};

/// Dependencies of a crate on a crate of a later folder, as `from -> to`.
pub(super) fn upward(root: &Path, layers: &[String]) -> Result<Vec<String>, String> {
    let manifest = read(&root.join("Cargo.toml"))?;
    let workspace = manifest.get("workspace").and_then(Value::as_table).ok_or("no workspace")?;
    let members = workspace.get("members").and_then(Value::as_array).ok_or("no members")?;
    let shared = workspace.get("dependencies").and_then(Value::as_table).ok_or("no dependencies")?;
    let rank = |folder: &str| {
        let top = folder.split('/').next().unwrap_or(folder);
        layers.iter().position(|layer| layer == top)
    };
    let mut upward = Vec::new();
    for member in members.iter().filter_map(Value::as_str) {
        let own = rank(member).ok_or_else(|| format!("`{member}` is in no layer of xtask/house.toml"))?;
        let manifest = read(&root.join(member).join("Cargo.toml"))?;
        let Some(dependencies) = manifest.get("dependencies").and_then(Value::as_table) else { continue };
        for name in dependencies.keys() {
            let Some(path) = shared.get(name).and_then(|entry| entry.get("path")).and_then(Value::as_str)
            else {
                continue;
            };
            if rank(path).is_some_and(|other| other > own) {
                upward.push(format!("{member} -> {path}"));
            }
        }
    }
    Ok(upward)
}

fn read(path: &Path) -> Result<Table, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    text.parse().map_err(|error| format!("{}: {error}", path.display()))
}
