//! Projects of documents: the flags of the command line over the `motet.toml` of each folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use motet_project::{DiagnosticSink, Project, find_config};

use crate::error::CliError;
use crate::flags::SessionArgs;

/// Projects that were opened, one for each `motet.toml`.
pub(crate) struct Projects<'a> {
    args: &'a SessionArgs,
    /// By the path of the file; without one there is one project for all.
    opened: BTreeMap<Option<PathBuf>, Project>,
    /// The `motet.toml` of each folder, as far as it was looked for.
    configs: BTreeMap<PathBuf, Option<PathBuf>>,
}

impl<'a> Projects<'a> {
    pub(crate) fn new(args: &'a SessionArgs) -> Self {
        Self { args, opened: BTreeMap::new(), configs: BTreeMap::new() }
    }

    /// Project of the documents in a folder.
    pub(crate) fn of(
        &mut self,
        folder: &Path,
        sink: &mut dyn DiagnosticSink,
    ) -> Result<&mut Project, CliError> {
        let config = match self.configs.get(folder) {
            Some(config) => config.clone(),
            None => {
                let config = find_config(folder);
                self.configs.insert(folder.to_owned(), config.clone());
                config
            }
        };
        if !self.opened.contains_key(&config) {
            let project = self.args.project_in(folder)?.open_with(sink)?;
            self.opened.insert(config.clone(), project);
        }
        let missing = || CliError::Message("the project is not open".to_owned());
        self.opened.get_mut(&config).ok_or_else(missing)
    }

    /// Is `true` if a project has a scene.
    pub(crate) fn have_scene(&self) -> bool {
        self.opened.values().any(Project::has_scene)
    }

    /// Is `true` if a project searches motions.
    pub(crate) fn have_geometry(&self) -> bool {
        self.opened.values().any(Project::has_geometry)
    }
}
