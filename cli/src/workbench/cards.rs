//! Robot cards: built in, or a folder of the user's own.

use std::path::{Path, PathBuf};

use motet_robots::card::{self, Robot};
use motet_syntax::{Sources, suggest};

use super::add;
use crate::exit::Trouble;
use crate::input::read_small;
use crate::report::Report;

/// The text of a card.
#[derive(Clone, Debug)]
pub(crate) struct Card {
    /// Its name in diagnostics.
    pub(super) name: String,
    /// Where its files are.
    pub(super) home: Home,
    /// The text of its `robot.toml`.
    pub(super) toml: Vec<u8>,
    declarations: Option<String>,
}

/// Where the files of a card are.
#[derive(Clone, Debug)]
pub(super) enum Home {
    /// In the command, under the robot's name.
    BuiltIn(&'static str),
    /// In a folder.
    Folder(PathBuf),
}

/// The names of the robots that are built in.
pub(crate) fn robot_names() -> impl Iterator<Item = &'static str> {
    card::embedded().iter().map(|(name, _, _)| *name)
}

/// The card of a robot that is built in.
pub(super) fn embedded(name: &str) -> Option<Card> {
    card::embedded().iter().find(|(known, _, _)| *known == name).map(|(name, toml, declarations)| Card {
        name: format!("{name}/robot.toml"),
        home: Home::BuiltIn(name),
        toml: toml.as_bytes().to_vec(),
        declarations: declarations.map(Into::into),
    })
}

impl Card {
    /// Finds a card by the name of a built-in robot or by a folder.
    ///
    /// # Errors
    ///
    /// There is none, or its files cannot be read.
    pub(crate) fn find(name: &str) -> Result<Self, Trouble> {
        if let Some(card) = embedded(name) {
            return Ok(card);
        }
        let path = Path::new(name);
        if path.is_dir() {
            return Self::in_folder(path);
        }
        if path.file_name().is_some_and(|file| file == "robot.toml") && path.is_file() {
            return Self::in_folder(path.parent().unwrap_or(Path::new(".")));
        }
        let near = suggest::closest(name, robot_names()).map(|near| format!("did you mean `{near}`? "));
        let known = suggest::one_of(robot_names());
        let help = format!(
            "{}built in: {known}; a robot of your own is a folder with a robot.toml",
            near.unwrap_or_default()
        );
        Err(Trouble::Unknown { what: "robot", name: name.to_owned(), help })
    }

    /// The card's own text and its declarations, to be read again elsewhere.
    #[must_use]
    pub(crate) fn texts(&self) -> (String, Option<String>) {
        (String::from_utf8_lossy(&self.toml).into_owned(), self.declarations.clone())
    }

    /// A card that is not written yet, in the folder where it will be.
    #[must_use]
    pub(crate) fn drafted(folder: &Path, toml: &str) -> Self {
        let name = folder.join("robot.toml").display().to_string();
        Self {
            name,
            home: Home::Folder(folder.to_owned()),
            toml: toml.as_bytes().to_vec(),
            declarations: None,
        }
    }

    fn in_folder(folder: &Path) -> Result<Self, Trouble> {
        let path = folder.join("robot.toml");
        if !path.is_file() {
            return Err(Trouble::NoCard { path: folder.to_owned() });
        }
        let declarations: PathBuf = folder.join("primitives.motet");
        let declarations = if declarations.exists() {
            let text = String::from_utf8(read_small(&declarations)?);
            Some(text.map_err(|_| Trouble::Other(format!("`{}` is not UTF-8 text", declarations.display())))?)
        } else {
            None
        };
        let home = Home::Folder(folder.to_owned());
        Ok(Self { name: path.display().to_string(), home, toml: read_small(&path)?, declarations })
    }

    /// Reads the card; its diagnostics go to the report.
    ///
    /// # Errors
    ///
    /// It has a mistake.
    pub(crate) fn read(&self, sources: &mut Sources, report: &mut Report) -> Result<Robot, Trouble> {
        let (source, file, mut said) = add(&self.name, &self.toml, sources);
        let (robot, more) = card::read(&source, file, self.declarations.as_deref());
        said.extend(more);
        report.usable("robot card", &said, sources)?;
        robot.ok_or(Trouble::Diagnosed("robot card"))
    }
}
