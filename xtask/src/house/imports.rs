//! Import circles between the files of a crate, and between its folders.
//!
//! A file imports another where it names a path (`crate::…`, `super::…`, `self::…`) that leads to it; a
//! re-export leads on
//! to the file that defines the item. The face of a folder (`lib.rs`, `mod.rs`, `folder.rs`) declares and
//! re-exports; its
//! declarations are no imports.

use std::collections::{BTreeMap, BTreeSet};

use super::files::SourceFile;
use super::{Measure, is_source};

type Module = Vec<String>;

/// One crate: its modules by path, and the names that each re-exports.
struct Crate<'a> {
    files: BTreeMap<Module, &'a SourceFile>,
    exports: BTreeMap<Module, Vec<(String, Vec<String>)>>,
}

/// Circles of files, and circles in which a folder takes part.
pub(super) fn circles(files: &[SourceFile]) -> Vec<Measure> {
    let mut crates: BTreeMap<&str, BTreeMap<Module, &SourceFile>> = BTreeMap::new();
    for file in files.iter().filter(|file| is_source(file)) {
        if let Some((root, inner)) =
            file.path.rsplit_once("/src/").map(|(root, inner)| (root, inner.trim_end_matches(".rs")))
        {
            let mut module: Module = inner.split('/').map(str::to_owned).collect();
            if module.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
                module.pop();
            }
            crates.entry(root).or_default().insert(module, file);
        }
    }
    let (mut of_files, mut of_folders) = (Vec::new(), Vec::new());
    for (root, modules) in &crates {
        let edges = edges(modules);
        for circle in components(&edges) {
            of_files.push(format!("{root}: {}", show(&circle)));
        }
        for circle in folder_circles(&edges, modules) {
            of_folders.push(format!("{root}: {circle}"));
        }
    }
    vec![Measure::count("file-circles", of_files), Measure::count("folder-circles", of_folders)]
}

fn show(circle: &[Module]) -> String {
    circle.iter().map(|module| module.join("/")).collect::<Vec<_>>().join(" <-> ")
}

/// The imports between the modules of one crate.
fn edges(files: &BTreeMap<Module, &SourceFile>) -> BTreeMap<Module, BTreeSet<Module>> {
    let mut krate = Crate { files: files.clone(), exports: BTreeMap::new() };
    for (module, file) in files {
        let exports = uses(file)
            .into_iter()
            .filter(|(is_public, _)| *is_public)
            .filter_map(|(_, path)| Some((path.last()?.clone(), path)))
            .collect();
        krate.exports.insert(module.clone(), exports);
    }
    let mut edges = BTreeMap::new();
    for (module, file) in files {
        let mut targets = BTreeSet::new();
        let declared: Vec<String> = declared_modules(file);
        for (is_public, path) in
            uses(file).into_iter().chain(inline_paths(file).into_iter().map(|path| (false, path)))
        {
            let Some(target) = krate.resolve(module, &path, 0) else { continue };
            // A face re-exports its own children: that is its task, not an import.
            let own_child = target.len() > module.len() && target.starts_with(module);
            let declares =
                own_child && target.get(module.len()).is_some_and(|child| declared.contains(child));
            if target != *module && !(is_public && declares) {
                targets.insert(target);
            }
        }
        edges.insert(module.clone(), targets);
    }
    edges
}

impl Crate<'_> {
    /// The module that defines what `path` names, seen from `module`.
    fn resolve(&self, module: &Module, path: &[String], depth: usize) -> Option<Module> {
        let mut base: Module = Vec::new();
        let mut rest = path;
        match path.first().map(String::as_str) {
            Some("crate") => rest = path.get(1..)?,
            Some("self") => {
                base.clone_from(module);
                rest = path.get(1..)?;
            }
            Some("super") => {
                base.clone_from(module);
                while rest.first().map(String::as_str) == Some("super") {
                    base.pop()?;
                    rest = rest.get(1..)?;
                }
            }
            Some(first) => {
                // A path that begins with a child module, as in the face of a folder.
                let mut child = module.clone();
                child.push(first.to_owned());
                if !self.files.contains_key(&child) {
                    return None;
                }
                base.clone_from(module);
            }
            None => return None,
        }
        while let Some((first, tail)) = rest.split_first() {
            let mut next = base.clone();
            next.push(first.clone());
            if !self.files.contains_key(&next) {
                break;
            }
            base = next;
            rest = tail;
        }
        if !self.files.contains_key(&base) {
            return None;
        }
        if let (Some(name), true) = (rest.first(), depth < 8) {
            let exports = self.exports.get(&base)?;
            let found = exports.iter().find(|(export, _)| export == name);
            if let Some(target) = found.and_then(|(_, path)| self.resolve(&base, path, depth + 1)) {
                return Some(target);
            }
        }
        Some(base)
    }
}

/// The paths of the `use` declarations of a file, with whether each is public.
fn uses(file: &SourceFile) -> Vec<(bool, Vec<String>)> {
    let mut found = Vec::new();
    let mut open: Option<(bool, String)> = None;
    for line in file.lines.iter().take(file.source_lines) {
        let trimmed = line.trim();
        let started = match &mut open {
            Some((_, text)) => {
                text.push_str(trimmed);
                true
            }
            None => {
                let is_public = trimmed.starts_with("pub");
                let rest = trimmed.strip_prefix("pub ").or_else(|| trimmed.strip_prefix("pub(crate) "));
                let rest = rest.or_else(|| trimmed.strip_prefix("pub(super) ")).unwrap_or(trimmed);
                rest.strip_prefix("use ").is_some_and(|text| {
                    open = Some((is_public, text.to_owned()));
                    true
                })
            }
        };
        if started
            && trimmed.ends_with(';')
            && let Some((is_public, text)) = open.take()
        {
            let mut paths = Vec::new();
            expand(text.trim_end_matches(';'), &[], &mut paths);
            found.extend(paths.into_iter().map(|path| (is_public, path)));
        }
    }
    found
}

/// Expands `a::{b, c::d}` below `prefix` into single paths.
fn expand(text: &str, prefix: &[String], paths: &mut Vec<Vec<String>>) {
    let text = text.trim();
    let (head, group) = match text.find('{') {
        Some(at) => (text.get(..at).unwrap_or(""), text.get(at + 1..text.len() - 1)),
        None => (text, None),
    };
    let head = head.split(" as ").next().unwrap_or(head);
    let mut path = prefix.to_vec();
    path.extend(head.split("::").map(str::trim).filter(|part| !part.is_empty()).map(str::to_owned));
    match group {
        None => {
            // `use a::{self}` names `a`; `use a::*` names the module.
            if path.len() > 1 && path.last().is_some_and(|last| last == "self" || last == "*") {
                path.pop();
            }
            paths.push(path);
        }
        Some(group) => {
            let (mut depth, mut start) = (0_i32, 0);
            for (at, character) in group.char_indices() {
                match character {
                    '{' => depth += 1,
                    '}' => depth -= 1,
                    ',' if depth == 0 => {
                        expand(group.get(start..at).unwrap_or(""), &path, paths);
                        start = at + 1;
                    }
                    _ => {}
                }
            }
            let last = group.get(start..).unwrap_or("").trim();
            if !last.is_empty() {
                expand(last, &path, paths);
            }
        }
    }
}

/// Paths that begin with `crate::` or `super::` in code, outside of `use`.
fn inline_paths(file: &SourceFile) -> Vec<Vec<String>> {
    let mut paths = Vec::new();
    for line in file.lines.iter().take(file.source_lines) {
        let trimmed = line.trim_start();
        if trimmed.starts_with("//") || trimmed.starts_with("use ") || trimmed.starts_with("pub use ") {
            continue;
        }
        for start in ["crate::", "super::"] {
            for (at, _) in line.match_indices(start) {
                let before = line.get(..at).and_then(|text| text.chars().next_back());
                if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':' || c == '$') {
                    continue;
                }
                let path: String = line
                    .get(at..)
                    .unwrap_or("")
                    .chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':')
                    .collect();
                paths.push(path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect());
            }
        }
    }
    paths
}

/// The modules that a file declares.
fn declared_modules(file: &SourceFile) -> Vec<String> {
    let lines = file.lines.iter().filter_map(|line| line.trim().strip_suffix(';'));
    lines
        .filter_map(|line| {
            let line = line.strip_prefix("pub ").or_else(|| line.strip_prefix("pub(crate) ")).unwrap_or(line);
            line.strip_prefix("pub(super) ").unwrap_or(line).strip_prefix("mod ")
        })
        .map(str::to_owned)
        .collect()
}

/// The circles among the children of each folder in which a folder takes part.
fn folder_circles(
    edges: &BTreeMap<Module, BTreeSet<Module>>,
    files: &BTreeMap<Module, &SourceFile>,
) -> Vec<String> {
    let folders: BTreeSet<Module> =
        files.keys().filter_map(|module| module.split_last()).map(|(_, folder)| folder.to_vec()).collect();
    let mut found = Vec::new();
    for folder in &folders {
        let child = |module: &Module| {
            let inside = module.starts_with(folder) && module.len() > folder.len();
            inside.then(|| module.iter().take(folder.len() + 1).cloned().collect::<Module>())
        };
        let mut between: BTreeMap<Module, BTreeSet<Module>> = BTreeMap::new();
        for (from, targets) in edges {
            let Some(from) = child(from) else { continue };
            let all = between.entry(from.clone()).or_default();
            all.extend(targets.iter().filter_map(child).filter(|target| *target != from));
        }
        for circle in components(&between) {
            if circle.iter().any(|module| folders.contains(module)) {
                found.push(show(&circle));
            }
        }
    }
    found
}

/// Strongly connected components of two or more modules (Tarjan's algorithm, by repeated reachability:
/// crates are small).
fn components(edges: &BTreeMap<Module, BTreeSet<Module>>) -> Vec<Vec<Module>> {
    let reach: BTreeMap<&Module, BTreeSet<&Module>> =
        edges.keys().map(|module| (module, reachable(module, edges))).collect();
    let mut seen: BTreeSet<&Module> = BTreeSet::new();
    let mut circles = Vec::new();
    for (module, reached) in &reach {
        if seen.contains(*module) || !reached.contains(*module) {
            continue;
        }
        let circle: Vec<Module> = reached
            .iter()
            .filter(|other| reach.get(**other).is_some_and(|back| back.contains(*module)))
            .map(|other| (*other).clone())
            .collect();
        seen.extend(reached.iter().filter(|other| circle.contains(**other)));
        if circle.len() > 1 {
            circles.push(circle);
        }
    }
    circles
}

fn reachable<'a>(from: &Module, edges: &'a BTreeMap<Module, BTreeSet<Module>>) -> BTreeSet<&'a Module> {
    let mut reached = BTreeSet::new();
    let mut open: Vec<&Module> = edges.get(from).into_iter().flatten().collect();
    while let Some(module) = open.pop() {
        if reached.insert(module) {
            open.extend(edges.get(module).into_iter().flatten());
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::super::files::SourceFile;
    use super::*;

    fn file(path: &str, text: &str) -> SourceFile {
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        SourceFile { path: path.to_owned(), source_lines: lines.len(), lines, is_test: false }
    }

    #[test]
    fn circles_follow_re_exports_to_the_defining_file() {
        let files = [
            file("c/src/lib.rs", "mod a;\nmod b;\npub use a::A;\n"),
            file("c/src/a.rs", "use crate::b::B;\n"),
            file("c/src/b.rs", "use crate::A;\n"),
        ];
        let found = circles(&files);
        assert_eq!(found.first().map(|measure| measure.places.clone()), Some(vec!["c: a <-> b".to_owned()]));
    }

    #[test]
    fn circles_between_folders_are_counted_at_their_level() {
        let files = [
            file("c/src/lib.rs", "mod a;\nmod b;\n"),
            file("c/src/a/mod.rs", "mod x;\nmod y;\n"),
            file("c/src/a/x.rs", "use crate::b::B;\n"),
            file("c/src/a/y.rs", ""),
            file("c/src/b.rs", "use crate::a::y::Y;\n"),
        ];
        let found = circles(&files);
        let places: Vec<_> = found.iter().map(|measure| measure.places.len()).collect();
        assert_eq!(places, [0, 1]);
    }

    #[test]
    fn expand_reads_nested_groups() {
        let mut paths = Vec::new();
        expand("crate::{a::{self, B as C}, d::*}", &[], &mut paths);
        let paths: Vec<String> = paths.iter().map(|path| path.join("::")).collect();
        assert_eq!(paths, ["crate::a", "crate::a::B", "crate::d"]);
    }
}
