//! Files of a xacro: beside it, and in the folders of packages.

use std::path::{Path, PathBuf};

use motet_project::files::read_small;
use motet_robots::xacro::{self, XacroFiles};

/// Greatest depth at which a package is looked for below a folder of packages.
const DEPTH: usize = 3;

/// Files of this machine.
struct Files<'a> {
    own: &'a Path,
    packages: &'a [&'a Path],
}

impl XacroFiles for Files<'_> {
    fn read(&mut self, path: &str) -> Result<String, String> {
        let bytes = read_small(Path::new(path)).map_err(|error| error.to_string())?;
        String::from_utf8(bytes).map_err(|_| format!("`{path}` is not UTF-8"))
    }

    fn package(&mut self, name: &str) -> Option<String> {
        Some(package(self.own, self.packages, name)?.display().to_string())
    }
}

/// Folder of a package: around a file, or below the folders of packages.
pub(super) fn package(own: &Path, packages: &[&Path], name: &str) -> Option<PathBuf> {
    // A name that leads elsewhere is no package.
    if name.contains(['/', '\\']) || name.starts_with('.') {
        return None;
    }
    let around = own.ancestors().find(|folder| folder.ends_with(name) && is_package(folder));
    let below = || packages.iter().find_map(|folder| below(folder, name, DEPTH));
    around.map(Path::to_owned).or_else(below)
}

fn is_package(folder: &Path) -> bool {
    folder.join("package.xml").is_file()
}

/// Folder of a package at or below a folder.
fn below(folder: &Path, name: &str, depth: usize) -> Option<PathBuf> {
    let own = folder.canonicalize().ok()?;
    if own.ends_with(name) && is_package(&own) {
        return Some(own);
    }
    let direct = folder.join(name);
    if is_package(&direct) {
        return direct.canonicalize().ok();
    }
    if depth == 0 || is_package(folder) {
        return None;
    }
    let mut folders: Vec<PathBuf> =
        std::fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path()).collect();
    folders.retain(|path| path.is_dir());
    folders.sort();
    folders.iter().find_map(|inner| below(inner, name, depth - 1))
}

/// Expands a xacro with arguments `NAME:=VALUE`.
pub(super) fn expand(path: &Path, packages: &[&Path], arguments: &[String]) -> Result<String, String> {
    let split = |argument: &String| {
        let pair = argument.split_once(":=").map(|(name, value)| (name.to_owned(), value.to_owned()));
        pair.ok_or_else(|| format!("`--arg {argument}` is no NAME:=VALUE"))
    };
    let arguments: Vec<(String, String)> = arguments.iter().map(split).collect::<Result<_, String>>()?;
    let own = path.canonicalize().map_err(|error| format!("cannot read `{}`: {error}", path.display()))?;
    let mut files = Files { own: &own, packages };
    let name = own.display().to_string();
    let text = files.read(&name)?;
    xacro::expand(&name, &text, &arguments, &mut files)
}
