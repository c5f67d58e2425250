//! Scenes: built in, or a file.

use std::path::Path;

use motet_robots::scene::{self, Scene};
use motet_syntax::{Sources, suggest};

use super::add;
use crate::exit::Trouble;
use crate::input::read_small;
use crate::report::Report;

/// The names of the scenes that are built in.
fn scene_names() -> impl Iterator<Item = &'static str> {
    scene::embedded().iter().map(|(name, _)| *name)
}

/// Reads a scene by the name of a built-in one or from a file.
pub(crate) fn read(name: &str, sources: &mut Sources, report: &mut Report) -> Result<Scene, Trouble> {
    let (name, bytes) = match scene::embedded().iter().find(|(known, _)| *known == name) {
        Some((name, text)) => (format!("{name}.json"), text.as_bytes().to_vec()),
        None if looks_like_file(name) => (name.to_owned(), read_small(Path::new(name))?),
        None => return Err(unknown(name)),
    };
    let (source, file, mut said) = add(&name, &bytes, sources);
    let (scene, more) = scene::read(&source, file);
    said.extend(more);
    report.usable("scene", &said, sources)?;
    scene.ok_or(Trouble::Diagnosed("scene"))
}

fn looks_like_file(name: &str) -> bool {
    let path = Path::new(name);
    path.exists() || path.extension().is_some() || path.components().count() > 1
}

fn unknown(name: &str) -> Trouble {
    let near = suggest::closest(name, scene_names()).map(|near| format!("did you mean `{near}`? "));
    let known = suggest::one_of(scene_names());
    let help = format!("{}built in: {known}; a scene of your own is a JSON file", near.unwrap_or_default());
    Trouble::Unknown { what: "scene", name: name.to_owned(), help }
}
