//! Inputs and outputs that the parts of `motet dataset` share: the format of rows, robots, files of lines.

use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;

use clap::ValueEnum;
use motet_dataset::{Body, format};
use motet_geometry::planning::SearchBudget;
use motet_project::open_robot;
use motet_syntax::Sources;

use crate::error::CliError;
use crate::flags::MotionArgs;
use crate::report::Report;

/// Format of rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(super) enum RowFormat {
    /// TRL: `messages` with roles
    #[default]
    Trl,
    /// LLaMA-Factory: `conversations` and `system`, with a dataset_info.json
    Llamafactory,
    /// Trainer of Qwen2.5-VL: `conversations`
    QwenVl,
    /// InteLiPlan: tags and lists of actions, as `text`
    Inteliplan,
}

impl From<RowFormat> for format::RowFormat {
    fn from(form: RowFormat) -> Self {
        match form {
            RowFormat::Trl => Self::Trl,
            RowFormat::Llamafactory => Self::LlamaFactory,
            RowFormat::QwenVl => Self::QwenVl,
            RowFormat::Inteliplan => Self::InteLiPlan,
        }
    }
}

/// Robot of a dataset, with its URDF.
pub(super) fn body(name: &str, report: &mut Report) -> Result<Body, CliError> {
    let (robot, urdf) = open_robot(name, &mut Sources::default(), report)?;
    Ok(Body { robot, urdf })
}

/// Search budget of the flags; `None` without motions.
pub(super) fn effort(args: &MotionArgs) -> Option<SearchBudget> {
    (!args.no_geometry).then(|| SearchBudget::default().times(args.effort.unwrap_or(1).into()))
}

/// Writes lines to a file.
pub(super) fn write(path: &Path, lines: impl Iterator<Item = String>) -> Result<(), CliError> {
    let cannot = |source| CliError::Write { path: path.to_owned(), source };
    let mut file = BufWriter::new(File::create(path).map_err(cannot)?);
    for line in lines {
        writeln!(file, "{line}").map_err(cannot)?;
    }
    file.flush().map_err(cannot)
}
