//! Body of a robot from its card: the one place that reads a URDF with its SRDF and its meshes.

use std::fs::{self, File};
use std::io::Read;
use std::path::PathBuf;

use motet_robots::builtin;
use motet_robots::card::{self, ModelFile, ModelSpec, Robot};
use motet_robots::mesh::{self, MeshFile};
use motet_robots::srdf;
use motet_robots::urdf::{self, Urdf};
use motet_syntax::Sources;

use crate::error::{DiagnosticSink, ProjectError, invalid, require};
use crate::files::{add_source, read_optional};
use crate::robot::{Home, RobotFiles};

impl RobotFiles {
    /// Reads the URDF that the card names, with solids for its meshes and with the pairs of links that the
    /// SRDF allows to touch. `None` if the card names no URDF.
    ///
    /// # Errors
    ///
    /// A file cannot be read, has errors, or does not fit the card.
    pub fn body(
        &self,
        robot: &Robot,
        sources: &mut Sources,
        sink: &mut dyn DiagnosticSink,
    ) -> Result<Option<Urdf>, ProjectError> {
        let Some(model) = &robot.model else { return Ok(None) };
        let (toml, toml_id, _) = add_source(&self.name, &self.toml, sources);
        let missing = |which| card::missing(&toml, toml_id, which);
        let Some((name, bytes)) = self.urdf(model)? else {
            let found = missing(ModelFile::Urdf);
            require("robot card", found.as_slice(), sources, sink)?;
            return Err(invalid("robot card", found.into_iter().collect(), sources));
        };
        let (source, file, mut diagnostics) = add_source(&name, &bytes, sources);
        let (urdf, more) = urdf::read(&source, file);
        diagnostics.extend(more);
        require("URDF", &diagnostics, sources, sink)?;
        let Some(urdf) = urdf else { return Err(invalid("URDF", diagnostics, sources)) };
        // The remaining files are read even so: one pass reports all that is wrong with them.
        let fits = require("robot card", &card::fit(&toml, toml_id, &urdf), sources, sink);
        self.missing_packages(model, |at| sink.report(missing(ModelFile::Package(at)).as_slice(), sources));
        let folders = self.mesh_folders(model);
        let (mut urdf, found) = mesh::attach(&source, file, urdf, |name| folders.find(name));
        let meshes = require("URDF", &found, sources, sink);
        match self.srdf(model)? {
            Srdf::None => {}
            Srdf::Missing => require("robot card", missing(ModelFile::Srdf).as_slice(), sources, sink)?,
            Srdf::Text(name, bytes) => {
                let (source, file, mut diagnostics) = add_source(&name, &bytes, sources);
                let (srdf, more) = srdf::read(&source, file, &urdf);
                diagnostics.extend(more);
                require("SRDF", &diagnostics, sources, sink)?;
                urdf.may_touch = srdf.map(|srdf| srdf.disabled).unwrap_or_default();
            }
        }
        fits.and(meshes).map(|()| Some(urdf))
    }

    /// Name and content of the URDF; `None` if it does not exist.
    fn urdf(&self, model: &ModelSpec) -> Result<Option<(String, Vec<u8>)>, ProjectError> {
        match &self.home {
            Home::BuiltIn(name) => {
                let text = builtin::robot_texts(name).map_or("", |texts| texts.urdf);
                Ok(Some((format!("{name}/{}", model.urdf), text.as_bytes().to_vec())))
            }
            Home::Folder(folder) => read_optional(&folder.join(&model.urdf)),
        }
    }

    fn srdf(&self, model: &ModelSpec) -> Result<Srdf, ProjectError> {
        let (Home::Folder(folder), Some(file)) = (&self.home, &model.srdf) else { return Ok(Srdf::None) };
        Ok(read_optional(&folder.join(file))?.map_or(Srdf::Missing, |(name, bytes)| Srdf::Text(name, bytes)))
    }

    /// Passes the index of each package folder that does not exist.
    fn missing_packages(&self, model: &ModelSpec, mut each: impl FnMut(usize)) {
        let Home::Folder(folder) = &self.home else { return };
        for (package, at) in model.packages.iter().zip(0..) {
            if !folder.join(package).is_dir() {
                each(at);
            }
        }
    }

    fn mesh_folders(&self, model: &ModelSpec) -> MeshFolders {
        let Home::Folder(folder) = &self.home else { return MeshFolders::default() };
        let urdf = folder.join(&model.urdf);
        let own = urdf.parent().unwrap_or(folder).to_owned();
        let packages: Vec<PathBuf> = model.packages.iter().map(|package| folder.join(package)).collect();
        let allowed = [folder.clone(), own.clone()].into_iter().chain(packages.iter().cloned());
        let allowed = allowed.filter_map(|folder| fs::canonicalize(folder).ok()).collect();
        let text = |path: &PathBuf| path.display().to_string();
        MeshFolders { own: text(&own), packages: packages.iter().map(text).collect(), allowed }
    }
}

enum Srdf {
    None,
    Missing,
    Text(String, Vec<u8>),
}

/// Folders in which the meshes of a URDF are searched.
#[derive(Default)]
struct MeshFolders {
    /// Folder of the URDF.
    own: String,
    /// Package folders, in the order of the card.
    packages: Vec<String>,
    /// Canonical folders below which a mesh must be: no link leads out of them.
    allowed: Vec<PathBuf>,
}

impl MeshFolders {
    fn find(&self, name: &str) -> MeshFile {
        let looked = mesh::locate(name, &self.own, &self.packages);
        let mut there: Vec<PathBuf> = looked.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
        // Files first.
        there.sort_by_key(|path| !path.is_file());
        let Some(path) = there.first() else {
            // `locate` gives no candidate for a name that leaves its package.
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
        // One byte above the limit shows that the file is too large.
        let read = File::open(path).and_then(|file| file.take(mesh::MAX_BYTES + 1).read_to_end(&mut bytes));
        match read {
            Ok(_) if bytes.len() as u64 > mesh::MAX_BYTES => MeshFile::TooLarge,
            Ok(_) => MeshFile::Bytes(bytes),
            Err(_) => MeshFile::Missing(looked),
        }
    }
}
