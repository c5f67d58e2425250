//! A robot's body from its card: the one place where its URDF, its SRDF and its meshes are read.

use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use motet_robots::card::{self, ModelFile, ModelSpec, Robot};
use motet_robots::mesh::{self, MeshFile};
use motet_robots::srdf;
use motet_robots::urdf::{self, Urdf};
use motet_syntax::Sources;

use super::add;
use super::cards::{Card, Home};
use crate::exit::Trouble;
use crate::input::read_small;
use crate::report::Report;

impl Card {
    /// Reads what the card says of the robot's body, which must have no error: the URDF with pieces for its meshes and with
    /// the pairs of links that the SRDF lets touch, and whether the card fits it. Diagnostics go to the report. There is none
    /// where the card names no URDF.
    ///
    /// # Errors
    ///
    /// A file cannot be read, or has a mistake.
    pub(crate) fn body(
        &self,
        robot: &Robot,
        sources: &mut Sources,
        report: &mut Report,
    ) -> Result<Option<Urdf>, Trouble> {
        let Some(model) = &robot.model else { return Ok(None) };
        let (toml, toml_id, _) = add(&self.name, &self.toml, sources);
        let missing = |which| card::missing(&toml, toml_id, which);
        let Some((name, bytes)) = self.urdf(model)? else {
            report.usable("robot card", missing(ModelFile::Urdf).as_slice(), sources)?;
            return Err(Trouble::Diagnosed("robot card"));
        };
        let (source, file, mut said) = add(&name, &bytes, sources);
        let (urdf, more) = urdf::read(&source, file);
        said.extend(more);
        report.usable("URDF", &said, sources)?;
        let Some(urdf) = urdf else { return Err(Trouble::Diagnosed("URDF")) };
        // All that is wrong with the rest is told at once.
        let fits = report.usable("robot card", &card::fit(&toml, toml_id, &urdf), sources);
        self.packages(model, |at| report.say(missing(ModelFile::Package(at)).as_slice(), sources));
        let folders = self.folders(model);
        let (mut urdf, said) = mesh::attach(&source, file, urdf, |name| folders.find(name));
        let meshes = report.usable("URDF", &said, sources);
        match self.srdf(model)? {
            Srdf::None => {}
            Srdf::Missing => report.usable("robot card", missing(ModelFile::Srdf).as_slice(), sources)?,
            Srdf::Text(name, bytes) => {
                let (source, file, mut said) = add(&name, &bytes, sources);
                let (srdf, more) = srdf::read(&source, file, &urdf);
                said.extend(more);
                report.usable("SRDF", &said, sources)?;
                urdf.may_touch = srdf.map(|srdf| srdf.disabled).unwrap_or_default();
            }
        }
        fits.and(meshes).map(|()| Some(urdf))
    }

    /// The URDF's name and bytes; none where it is not there.
    fn urdf(&self, model: &ModelSpec) -> Result<Option<(String, Vec<u8>)>, Trouble> {
        match &self.home {
            Home::BuiltIn(name) => {
                let text = card::embedded_urdf(name).unwrap_or_default();
                Ok(Some((format!("{name}/{}", model.urdf), text.as_bytes().to_vec())))
            }
            Home::Folder(folder) => present(&folder.join(&model.urdf)),
        }
    }

    fn srdf(&self, model: &ModelSpec) -> Result<Srdf, Trouble> {
        let (Home::Folder(folder), Some(file)) = (&self.home, &model.srdf) else { return Ok(Srdf::None) };
        Ok(present(&folder.join(file))?.map_or(Srdf::Missing, |(name, bytes)| Srdf::Text(name, bytes)))
    }

    /// Says which folders with packages are not there.
    fn packages(&self, model: &ModelSpec, mut say: impl FnMut(usize)) {
        let Home::Folder(folder) = &self.home else { return };
        for (package, at) in model.packages.iter().zip(0..) {
            if !folder.join(package).is_dir() {
                say(at);
            }
        }
    }

    fn folders(&self, model: &ModelSpec) -> Folders {
        let Home::Folder(folder) = &self.home else { return Folders::default() };
        let urdf = folder.join(&model.urdf);
        let own = urdf.parent().unwrap_or(folder).to_owned();
        let packages: Vec<PathBuf> = model.packages.iter().map(|package| folder.join(package)).collect();
        let allowed = [folder.clone(), own.clone()].into_iter().chain(packages.iter().cloned());
        let allowed = allowed.filter_map(|folder| fs::canonicalize(folder).ok()).collect();
        let text = |path: &PathBuf| path.display().to_string();
        Folders { own: text(&own), packages: packages.iter().map(text).collect(), allowed }
    }
}

enum Srdf {
    None,
    Missing,
    Text(String, Vec<u8>),
}

/// A file's name and bytes; none where it is not there.
fn present(path: &Path) -> Result<Option<(String, Vec<u8>)>, Trouble> {
    match read_small(path) {
        Ok(bytes) => Ok(Some((path.display().to_string(), bytes))),
        Err(Trouble::Read { source, .. }) if source.kind() == ErrorKind::NotFound => Ok(None),
        Err(other) => Err(other),
    }
}

/// Where meshes may be.
#[derive(Default)]
struct Folders {
    /// That of the URDF.
    own: String,
    /// Those of packages, in their order.
    packages: Vec<String>,
    /// All below which a file may lie, with every link followed.
    allowed: Vec<PathBuf>,
}

impl Folders {
    fn find(&self, name: &str) -> MeshFile {
        let looked = mesh::locate(name, &self.own, &self.packages);
        let mut there: Vec<PathBuf> = looked.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
        // Files first.
        there.sort_by_key(|path| !path.is_file());
        let Some(path) = there.first() else {
            // A way out of a package is no path at all.
            let leaves = looked.is_empty() && name.split('/').any(|part| part == "..");
            return if leaves { MeshFile::Outside } else { MeshFile::Missing(looked) };
        };
        if !self.allowed.iter().any(|folder| path.starts_with(folder)) {
            return MeshFile::Outside;
        }
        if !path.is_file() {
            return MeshFile::NotAFile;
        }
        let mut bytes = Vec::new();
        // One byte more than is allowed tells that there are too many.
        let read = File::open(path).and_then(|file| file.take(mesh::MAX_BYTES + 1).read_to_end(&mut bytes));
        match read {
            Ok(_) if bytes.len() as u64 > mesh::MAX_BYTES => MeshFile::TooLarge,
            Ok(_) => MeshFile::Bytes(bytes),
            Err(_) => MeshFile::Missing(looked),
        }
    }
}
