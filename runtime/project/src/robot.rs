//! Robots by name: built in, or a folder of the user's own with a `robot.toml`.

use std::path::{Path, PathBuf};

use motet_robots::builtin;
use motet_robots::card::{self, Robot};
use motet_syntax::{Sources, suggest};

use crate::error::{DiagnosticSink, ProjectError, invalid, require};
use crate::files::{add_source, read_small};

/// Files of one robot: its card, its declarations, and the folder with its URDF, SRDF and meshes.
#[derive(Clone, Debug)]
pub struct RobotFiles {
    /// Name of the card in diagnostics.
    pub(crate) name: String,
    pub(crate) home: Home,
    /// Text of `robot.toml`.
    pub(crate) toml: Vec<u8>,
    /// Text of `primitives.motet`.
    declarations: Option<String>,
}

/// Location of the files that a card names.
#[derive(Clone, Debug)]
pub(crate) enum Home {
    /// In this binary, under the robot's name.
    BuiltIn(&'static str),
    Folder(PathBuf),
}

/// Names of the built-in robots.
pub fn robot_names() -> impl Iterator<Item = &'static str> {
    builtin::ROBOTS.iter().map(|robot| robot.name)
}

impl RobotFiles {
    /// Files of a built-in robot.
    #[must_use]
    pub fn built_in(name: &str) -> Option<Self> {
        builtin::robot_texts(name).map(|texts| Self {
            name: format!("{name}/robot.toml"),
            home: Home::BuiltIn(texts.name),
            toml: texts.card.as_bytes().to_vec(),
            declarations: texts.declarations.map(Into::into),
        })
    }

    /// Finds a robot by a built-in name, by its folder, or by the path of its `robot.toml`.
    ///
    /// # Errors
    ///
    /// There is no such robot, or its files cannot be read.
    pub fn find(name: &str) -> Result<Self, ProjectError> {
        if let Some(files) = Self::built_in(name) {
            return Ok(files);
        }
        let path = Path::new(name);
        if path.is_dir() {
            return Self::in_folder(path);
        }
        if path.file_name().is_some_and(|file| file == "robot.toml") && path.is_file() {
            return Self::in_folder(path.parent().unwrap_or(Path::new(".")));
        }
        let near = suggest::closest(name, robot_names()).map(|near| format!("did you mean `{near}`? "));
        let help = format!(
            "{}built-in robots: {}; your own robot is a folder with a robot.toml",
            near.unwrap_or_default(),
            suggest::one_of(robot_names())
        );
        Err(ProjectError::Unknown { what: "robot", name: name.to_owned(), help })
    }

    /// Text of the card and of its declarations.
    #[must_use]
    pub fn texts(&self) -> (String, Option<String>) {
        (String::from_utf8_lossy(&self.toml).into_owned(), self.declarations.clone())
    }

    /// Card that is not written yet, in the folder where it will be.
    #[must_use]
    pub fn draft(folder: &Path, toml: &str) -> Self {
        Self {
            name: folder.join("robot.toml").display().to_string(),
            home: Home::Folder(folder.to_owned()),
            toml: toml.as_bytes().to_vec(),
            declarations: None,
        }
    }

    fn in_folder(folder: &Path) -> Result<Self, ProjectError> {
        let path = folder.join("robot.toml");
        if !path.is_file() {
            return Err(ProjectError::NoCard { path: folder.to_owned() });
        }
        let declarations = folder.join("primitives.motet");
        let declarations = if declarations.exists() {
            let text = String::from_utf8(read_small(&declarations)?);
            Some(text.map_err(|_| ProjectError::NotText { path: declarations })?)
        } else {
            None
        };
        let home = Home::Folder(folder.to_owned());
        Ok(Self { name: path.display().to_string(), home, toml: read_small(&path)?, declarations })
    }

    /// Reads the card and its declarations.
    ///
    /// # Errors
    ///
    /// [`ProjectError::Invalid`] if the card has errors.
    pub fn card(&self, sources: &mut Sources, sink: &mut dyn DiagnosticSink) -> Result<Robot, ProjectError> {
        let (source, file, mut diagnostics) = add_source(&self.name, &self.toml, sources);
        let (robot, more) = card::read(&source, file, self.declarations.as_deref());
        diagnostics.extend(more);
        require("robot card", &diagnostics, sources, sink)?;
        robot.ok_or_else(|| invalid("robot card", diagnostics, sources))
    }
}
