//! Licences, known advisories and the list of all dependencies, from the lock files of the workspace and of
//! the packages outside of it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use semver::{Version, VersionReq};
use serde::Deserialize;
use serde_json::{Value, json};
use spdx::{Expression, ParseMode};

/// Manifests whose dependencies count.
const MANIFESTS: [&str; 4] =
    ["Cargo.toml", "python/Cargo.toml", "cli/fleet/Cargo.toml", "tests/embedding/stack/Cargo.toml"];

/// Package of a lock file that others have made.
#[derive(Clone, Deserialize)]
struct Package {
    name: String,
    version: Version,
    license: Option<String>,
    source: Option<String>,
    repository: Option<String>,
}

#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

/// Front matter of an advisory of RustSec.
#[derive(Deserialize)]
struct Advisory {
    advisory: AdvisoryHead,
    #[serde(default)]
    versions: AffectedVersions,
}

#[derive(Deserialize)]
struct AdvisoryHead {
    id: String,
    package: String,
    withdrawn: Option<toml::Value>,
    informational: Option<String>,
}

#[derive(Default, Deserialize)]
struct AffectedVersions {
    #[serde(default)]
    patched: Vec<VersionReq>,
    #[serde(default)]
    unaffected: Vec<VersionReq>,
}

/// Runs the chore: false if a licence is not permitted or a version has a vulnerability.
pub(crate) fn run(root: &Path, options: &[&str]) -> Result<bool, String> {
    let packages = packages(root)?;
    let text = fs::read_to_string(root.join("deny.toml")).map_err(|error| format!("deny.toml: {error}"))?;
    let deny: toml::Table = text.parse().map_err(|error| format!("deny.toml: {error}"))?;
    let mut is_good = licences(&listed(&deny, "licenses", "allow"), &packages);
    match options {
        [] => {}
        ["--advisories", folder] => {
            let ignored = listed(&deny, "advisories", "ignore");
            is_good &= advisories(Path::new(folder), &ignored, &packages)?;
        }
        ["--sbom", file] => {
            let text = serde_json::to_string_pretty(&sbom(&packages)).map_err(|error| error.to_string())?;
            fs::write(file, text + "\n").map_err(|error| format!("{file}: {error}"))?;
        }
        _ => return Err(crate::USAGE.to_owned()),
    }
    Ok(is_good)
}

/// Packages of all lock files by name and version.
fn packages(root: &Path) -> Result<BTreeMap<(String, Version), Package>, String> {
    let mut all = BTreeMap::new();
    for manifest in MANIFESTS {
        let mut cargo = Command::new("cargo");
        cargo.args(["metadata", "--locked", "--format-version", "1", "--manifest-path"]);
        let done = cargo.arg(root.join(manifest)).output().map_err(|error| format!("cargo: {error}"))?;
        if !done.status.success() {
            return Err(format!("{manifest}: {}", String::from_utf8_lossy(&done.stderr)));
        }
        let metadata: Metadata =
            serde_json::from_slice(&done.stdout).map_err(|error| format!("{manifest}: {error}"))?;
        let others = metadata.packages.into_iter().filter(|package| package.source.is_some());
        all.extend(others.map(|package| ((package.name.clone(), package.version.clone()), package)));
    }
    Ok(all)
}

/// Texts of a list of `deny.toml`.
fn listed<'t>(deny: &'t toml::Table, table: &str, name: &str) -> Vec<&'t str> {
    let list = deny.get(table).and_then(|table| table.get(name)).and_then(|list| list.as_array());
    list.into_iter().flatten().filter_map(toml::Value::as_str).collect()
}

/// Compares each licence with those that are permitted.
fn licences(allowed: &[&str], packages: &BTreeMap<(String, Version), Package>) -> bool {
    let mut refused = 0;
    for package in packages.values() {
        let license = package.license.as_deref().unwrap_or_default();
        let is_permitted = Expression::parse_mode(license, ParseMode::LAX)
            .is_ok_and(|expression| expression.evaluate(|one| allowed.contains(&one.to_string().as_str())));
        if !is_permitted {
            println!("{} {}: the licence `{license}` is not permitted", package.name, package.version);
            refused += 1;
        }
    }
    println!("licences: {} packages, {refused} not permitted", packages.len());
    refused == 0
}

/// Compares each version with the advisories in a checkout of RustSec's list.
fn advisories(
    folder: &Path,
    ignored: &[&str],
    packages: &BTreeMap<(String, Version), Package>,
) -> Result<bool, String> {
    let (mut wrong, mut seen) = (0, 0);
    for file in advisory_files(&folder.join("crates"), packages)? {
        let text = fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        let front = text.split("```").nth(1).and_then(|front| front.strip_prefix("toml"));
        let read = front.map(toml::from_str::<Advisory>).transpose();
        let advisory = read.map_err(|error| format!("{}: {error}", file.display()))?;
        let Some(advisory) = advisory.filter(|found| found.advisory.withdrawn.is_none()) else { continue };
        seen += 1;
        for package in packages.values().filter(|package| package.name == advisory.advisory.package) {
            let AffectedVersions { patched, unaffected } = &advisory.versions;
            if patched.iter().chain(unaffected).any(|versions| versions.matches(&package.version)) {
                continue;
            }
            let AdvisoryHead { id, informational, .. } = &advisory.advisory;
            let is_ignored = ignored.contains(&id.as_str());
            let kind =
                if is_ignored { "ignored" } else { informational.as_deref().unwrap_or("vulnerability") };
            println!("{} {}: {id} ({kind})", package.name, package.version);
            wrong += usize::from(informational.is_none() && !is_ignored);
        }
    }
    println!("advisories: {seen} of these packages, {wrong} vulnerabilities");
    Ok(wrong == 0)
}

/// Files of the advisories of the packages.
fn advisory_files(
    folder: &Path,
    packages: &BTreeMap<(String, Version), Package>,
) -> Result<Vec<PathBuf>, String> {
    fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut names: Vec<&str> = packages.values().map(|package| package.name.as_str()).collect();
    names.dedup();
    let mut files = Vec::new();
    for name in names {
        let Ok(entries) = fs::read_dir(folder.join(name)) else { continue };
        files.extend(entries.flatten().map(|entry| entry.path()));
    }
    files.sort();
    Ok(files)
}

/// Licence in the spelling of SPDX: older packages write `MIT/Apache-2.0`.
fn spelt(license: &str) -> String {
    let spelt = Expression::canonicalize(license).ok().flatten();
    spelt.unwrap_or_else(|| license.to_owned())
}

/// List of the packages as CycloneDX 1.5 has it.
fn sbom(packages: &BTreeMap<(String, Version), Package>) -> Value {
    let component = |package: &Package| {
        let Package { name, version, license, repository, .. } = package;
        let url = format!("pkg:cargo/{name}@{version}");
        let links: Vec<Value> = repository.iter().map(|url| json!({"type": "vcs", "url": url})).collect();
        json!({
            "type": "library", "bom-ref": url, "purl": url, "name": name, "version": version.to_string(),
            "licenses": license.iter().map(|one| json!({"expression": spelt(one)})).collect::<Vec<_>>(),
            "externalReferences": links,
        })
    };
    json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {
            "component": {"type": "application", "name": "motet", "version": env!("CARGO_PKG_VERSION")},
        },
        "components": packages.values().map(component).collect::<Vec<_>>(),
    })
}
