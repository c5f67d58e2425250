//! Pictures of rows on disk: whether each that a row refers to is there, and which nobody refers to.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use motet_dataset::form;
use motet_dataset::lint::{Fault, Finding, Place, Shelf};
use motet_dataset::picture;

use super::lint::{ROOMS, lines};
use crate::exit::Trouble;
use crate::input::Flow;

/// How the names of pictures end.
const ENDINGS: &[&str] = &["png", "jpg", "jpeg", "webp", "gif"];

/// The pictures that rows refer to, with what is wrong with each.
#[derive(Debug, Default)]
pub(super) struct Images(BTreeMap<PathBuf, Option<String>>);

impl Shelf for Images {
    fn fault(&mut self, file: &str, path: &str) -> Option<String> {
        let found = self.0.entry(folder(Path::new(file)).join(path));
        let place = found.key().clone();
        let fault = found.or_insert_with(|| match fs::read(&place) {
            Ok(bytes) => picture::fault(&bytes),
            Err(error) => Some(error.to_string()),
        });
        fault.as_ref().map(|why| format!("its image `{path}` cannot be used: {why}"))
    }
}

impl Images {
    /// The pictures beside files of rows that no row refers to, of these files or of others in their folders.
    ///
    /// # Errors
    ///
    /// One of the others is too long for a file of rows.
    pub(super) fn lost(mut self, files: &[PathBuf]) -> Result<Vec<Finding>, Trouble> {
        let folders: BTreeSet<PathBuf> = files.iter().map(|file| folder(file)).collect();
        let mut places: BTreeSet<PathBuf> = self.0.keys().map(|path| folder(path)).collect();
        for folder in &folders {
            places.insert(folder.join(picture::FOLDER));
            for other in listed(folder, &["jsonl"]) {
                if !files.contains(&other) && !other.ends_with(ROOMS) {
                    self.refer(&other)?;
                }
            }
        }
        let pictures = places.iter().flat_map(|place| listed(place, ENDINGS));
        let lost = pictures.filter(|path| !self.0.contains_key(path)).map(|path| Finding {
            at: Place { file: path.display().to_string(), row: 0 },
            fault: Fault::Image,
            message: "no row refers to it".to_owned(),
            other: None,
        });
        Ok(lost.collect())
    }

    /// Takes in what the rows of another file refer to.
    fn refer(&mut self, file: &Path) -> Result<(), Trouble> {
        lines(file, &mut |_, line| {
            let images = form::read(line).map(|row| row.images).unwrap_or_default();
            self.0.extend(images.into_iter().map(|image| (folder(file).join(image), None)));
            Ok(Flow::GoOn)
        })
    }
}

/// The folder of a file.
fn folder(file: &Path) -> PathBuf {
    file.parent().unwrap_or(Path::new("")).to_owned()
}

/// The files of a folder with such an ending, in order; none where it is no folder.
fn listed(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let place = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let names =
        fs::read_dir(place).into_iter().flatten().flatten().map(|entry| folder.join(entry.file_name()));
    let has_ending = |path: &PathBuf| {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        ending.is_some_and(|ending| endings.contains(&ending.as_str()))
    };
    let mut found: Vec<PathBuf> = names.filter(has_ending).collect();
    found.sort();
    found
}
