//! Images of rows on disk: finds the missing and the unused ones.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use motet_dataset::form;
use motet_dataset::lint::{Fault, Finding, Place, Shelf};
use motet_dataset::picture;

use super::lint::{ROOMS, lines};
use crate::documents::Flow;
use crate::error::CliError;

/// Extensions of images.
const EXTENSIONS: &[&str] = &["png", "jpg", "jpeg", "webp", "gif"];

/// Images that rows refer to, each with its fault.
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
    /// Images beside files of rows to which no row refers, in these files or in others of their folders.
    ///
    /// # Errors
    ///
    /// A line of another file is too long for a row.
    pub(super) fn unused(mut self, files: &[PathBuf]) -> Result<Vec<Finding>, CliError> {
        let folders: BTreeSet<PathBuf> = files.iter().map(|file| folder(file)).collect();
        let mut folders_with_images: BTreeSet<PathBuf> = self.0.keys().map(|path| folder(path)).collect();
        for folder in &folders {
            folders_with_images.insert(folder.join(picture::FOLDER));
            for other in listed(folder, &["jsonl"]) {
                if !files.contains(&other) && !other.ends_with(ROOMS) {
                    self.refer(&other)?;
                }
            }
        }
        let pictures = folders_with_images.iter().flat_map(|place| listed(place, EXTENSIONS));
        let unused = pictures.filter(|path| !self.0.contains_key(path)).map(|path| Finding {
            at: Place { file: path.display().to_string(), row: 0 },
            fault: Fault::Image,
            message: "no row refers to it".to_owned(),
            other: None,
        });
        Ok(unused.collect())
    }

    /// Adds the images of the rows in another file.
    fn refer(&mut self, file: &Path) -> Result<(), CliError> {
        lines(file, &mut |_, line| {
            let images = form::read(line).map(|row| row.images).unwrap_or_default();
            self.0.extend(images.into_iter().map(|image| (folder(file).join(image), None)));
            Ok(Flow::Continue)
        })
    }
}

/// Folder of a file.
fn folder(file: &Path) -> PathBuf {
    file.parent().unwrap_or(Path::new("")).to_owned()
}

/// Files of a folder with one of these extensions, in order; none if it is not a folder.
fn listed(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let place = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let names =
        fs::read_dir(place).into_iter().flatten().flatten().map(|entry| folder.join(entry.file_name()));
    let has_extension = |path: &PathBuf| {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        extension.is_some_and(|extension| extensions.contains(&extension.as_str()))
    };
    let mut found: Vec<PathBuf> = names.filter(has_extension).collect();
    found.sort();
    found
}
