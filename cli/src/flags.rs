//! Flags that several subcommands share: documents, the robot and its scene, the format of diagnostics, the
//! driver of a run. The flags of one subcommand are in its own file in `command`.

mod batch;
mod driver;
mod key;
mod server;

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum, value_parser};
use motet_project::{Project, ProjectBuilder, ProjectSession, find_config, read_config};
use motet_robots::clearance::{ClearanceOverride, GREATEST_CLEARANCE};
use motet_syntax::Syntax;
use motet_syntax::unit::{Dimension, Unit};

use crate::error::CliError;

pub(crate) use batch::{JobArgs, ResultArgs};
pub(crate) use driver::{DriverArgs, DriverChoice, Speed, seed};
pub(crate) use key::{KeyArgs, token_from};
pub(crate) use server::{CarrierArg, ServerArgs, ServerDialect, refuse_carrier, tell_proxy};

/// Documents to read.
#[derive(Args, Debug)]
pub(crate) struct DocumentArgs {
    /// Files, folders (all .motet and .json files in them), .jsonl files with one policy per line, or `-`
    /// for stdin
    #[arg(value_name = "PATH", required = true)]
    pub(crate) paths: Vec<PathBuf>,
}

/// Robot, scene, state and domains.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct EnvironmentArgs {
    /// Robot: a built-in name (see `motet robots`), or a folder with a robot.toml [default: that of
    /// the policy (`for NAME`), or of motet.toml]
    #[arg(long, value_name = "NAME|FOLDER")]
    pub(crate) robot: Option<String>,
    /// Scene: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) scene: Option<String>,
    /// Facts at the start: a JSON object such as '{"holding(mug_1)": true, "free(hand)": false}', or a file
    /// with one
    #[arg(long, value_name = "FACTS|FILE")]
    pub(crate) state: Option<PathBuf>,
    /// File with further declarations; repeatable
    #[arg(long, value_name = "FILE")]
    pub(crate) domain: Vec<PathBuf>,
}

impl EnvironmentArgs {
    /// Project of these inputs in which no motion is searched.
    pub(crate) fn without_motions(&self) -> ProjectBuilder {
        self.over(Project::builder().without_motions())
    }

    /// Project of these inputs over the nearest `motet.toml` at or above a folder, in which no motion is
    /// searched.
    pub(crate) fn without_motions_in(&self, folder: &Path) -> Result<ProjectBuilder, CliError> {
        Ok(self.over(settings_of(folder)?).without_motions())
    }

    /// Robot and scene of an open project where none is given.
    pub(crate) fn or_of(&self, opened: &ProjectSession) -> Self {
        let inputs = opened.inputs();
        let or = |given: &Option<String>, other: Option<&str>| given.clone().or(other.map(str::to_owned));
        let (robot, scene) = (or(&self.robot, inputs.robot_name()), or(&self.scene, inputs.scene_name()));
        Self { robot, scene, ..self.clone() }
    }

    /// Project of these inputs, in which those that are missing are the given ones.
    fn over(&self, mut project: ProjectBuilder) -> ProjectBuilder {
        if let Some(robot) = &self.robot {
            project = project.robot(robot);
        }
        if let Some(scene) = &self.scene {
            project = project.scene(scene);
        }
        if let Some(state) = &self.state {
            project = project.state(state);
        }
        self.domain.iter().fold(project, ProjectBuilder::domain)
    }
}

/// Environment and limits of a check.
#[derive(Args, Clone, Debug)]
pub(crate) struct SessionArgs {
    #[command(flatten)]
    pub(crate) environment: EnvironmentArgs,
    /// Maximum duration of a policy, such as 90s or 10min
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) max_duration: Option<f64>,
    #[command(flatten)]
    pub(crate) motions: MotionArgs,
}

impl SessionArgs {
    /// Project of these inputs, in which those that are missing are those of the nearest `motet.toml` at
    /// or above a folder.
    pub(crate) fn project_in(&self, folder: &Path) -> Result<ProjectBuilder, CliError> {
        Ok(self.over(settings_of(folder)?))
    }

    /// Project of these inputs over the nearest `motet.toml` at or above the present folder.
    pub(crate) fn project_here(&self) -> Result<ProjectBuilder, CliError> {
        self.project_in(Path::new("."))
    }

    fn over(&self, project: ProjectBuilder) -> ProjectBuilder {
        let mut project = self.environment.over(project);
        if let Some(secs) = self.max_duration {
            project = project.max_duration(secs);
        }
        if let Some(clearance) = self.motions.clearance.clearance {
            project = project.clearance(clearance);
        }
        if self.motions.no_geometry {
            return project.without_motions();
        }
        match self.motions.effort {
            Some(effort) => project.motion_effort(effort),
            None => project,
        }
    }
}

/// Settings of the nearest `motet.toml` at or above a folder; none where there is no such file.
pub(crate) fn settings_of(folder: &Path) -> Result<ProjectBuilder, CliError> {
    let config = find_config(folder).map(|path| read_config(&path)).transpose()?;
    Ok(config.unwrap_or_else(Project::builder))
}

/// Folder of a file that is named on the command line; the present one for `-`.
pub(crate) fn folder_of(file: &Path) -> &Path {
    file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Search for motions.
#[derive(Args, Clone, Debug)]
pub(crate) struct MotionArgs {
    /// Do not search motions: defer all of them to the run
    #[arg(long)]
    pub(crate) no_geometry: bool,
    /// Search budget of a motion: 4 tries four times as often before the motion is deferred to the run
    /// [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = value_parser!(u16).range(1..=1000))]
    pub(crate) effort: Option<u16>,
    #[command(flatten)]
    pub(crate) clearance: ClearanceArgs,
}

/// Distances that motions keep from obstacles.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct ClearanceArgs {
    /// Distances that motions keep from obstacles, in m or with a unit: `base=5cm,arm=0.01` [default: those
    /// of the scene, or of the robot]
    #[arg(long, value_name = "base=M,arm=M", value_parser = clearance)]
    clearance: Option<ClearanceOverride>,
}

impl ClearanceArgs {
    /// Distances that are given.
    pub(crate) fn given(self) -> ClearanceOverride {
        self.clearance.unwrap_or_default()
    }
}

/// Format of diagnostics.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct FormatArgs {
    /// Format of diagnostics
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(crate) format: DiagnosticFormat,
}

/// Format of diagnostics.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum DiagnosticFormat {
    /// For people: with the source, in colour
    #[default]
    Human,
    /// One JSON object per line (`motet schema diagnostic`)
    Json,
    /// SARIF 2.1.0, for code scanners
    Sarif,
    /// Workflow commands of GitHub Actions
    Github,
    /// Short sentences for the next prompt of a language model, the most useful first
    Llm,
}

/// Format of results that are not diagnostics.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum OutputFormat {
    /// Text for people
    #[default]
    Human,
    /// One JSON object per line
    Json,
}

impl From<OutputFormat> for DiagnosticFormat {
    fn from(format: OutputFormat) -> Self {
        match format {
            OutputFormat::Human => Self::Human,
            OutputFormat::Json => Self::Json,
        }
    }
}

/// Syntax of a policy.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum SyntaxArg {
    /// Text, as in .motet files
    Text,
    /// JSON, as language models write it
    Json,
}

impl From<SyntaxArg> for Syntax {
    fn from(syntax: SyntaxArg) -> Self {
        match syntax {
            SyntaxArg::Text => Self::Text,
            SyntaxArg::Json => Self::Json,
        }
    }
}

/// Reads clearances such as `base=5cm,arm=0.01`.
fn clearance(text: &str) -> Result<ClearanceOverride, String> {
    let wrong =
        || format!("write `base` and `arm` with 0 to {GREATEST_CLEARANCE} m each, such as base=5cm,arm=0.01");
    let mut read = ClearanceOverride::default();
    for part in text.split(',') {
        let (group, length) = part.split_once('=').ok_or_else(wrong)?;
        let slot = match group.trim() {
            "base" => &mut read.base_m,
            "arm" => &mut read.arm_m,
            _ => return Err(wrong()),
        };
        let metres = length_m(length.trim()).filter(|metres| (0.0..=GREATEST_CLEARANCE).contains(metres));
        // A group that is given twice is a mistake.
        if slot.replace(metres.ok_or_else(wrong)?).is_some() {
            return Err(wrong());
        }
    }
    Ok(read)
}

/// Reads a length, in m where it has no unit.
fn length_m(text: &str) -> Option<f64> {
    let end = text.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at_checked(end)?;
    let number: f64 = number.parse().ok()?;
    match unit.trim() {
        "" => Some(number),
        unit => Some(Unit::parse(unit).filter(|unit| unit.dimension() == Dimension::LENGTH)?.to_si(number)),
    }
}

/// Reads a duration such as `90s`, `10 min` or `1h`; in seconds.
pub(crate) fn duration(text: &str) -> Result<f64, String> {
    let secs = time_of_run(text)?;
    if secs > 0.0 { Ok(secs) } else { Err("a duration is longer than 0 s".to_owned()) }
}

/// Reads a time of a run, which may be 0; in seconds.
pub(crate) fn time_of_run(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let end = text.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at_checked(end).unwrap_or((text, ""));
    let wrong = || "write a number with ms, s, min or h, such as 90s or 10min".to_owned();
    let unit =
        Unit::parse(unit.trim()).filter(|unit| unit.dimension() == Dimension::DURATION).ok_or_else(wrong)?;
    let secs = unit.to_si(number.parse().map_err(|_| wrong())?);
    if secs.is_finite() { Ok(secs) } else { Err(wrong()) }
}

/// Live page of a run.
#[derive(Args, Clone, Debug)]
pub(crate) struct PageArgs {
    /// Show the run on a page in a browser, which can answer, pause and stop it; at a port or an address
    /// [default: a free port of 127.0.0.1]
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, require_equals = true, default_missing_value = "",
          value_parser = address)]
    pub(crate) view: Option<SocketAddr>,
    /// Write the address of the page, with its token, to a file that only its owner reads, and print it
    /// nowhere
    #[arg(long, value_name = "FILE", requires = "view")]
    pub(crate) view_file: Option<PathBuf>,
}

/// Reads the address of a page: a port, an address, or both. Without one, a free port of this machine.
pub(crate) fn address(text: &str) -> Result<SocketAddr, String> {
    let local = IpAddr::V4(Ipv4Addr::LOCALHOST);
    if text.is_empty() {
        return Ok(SocketAddr::new(local, 0));
    }
    if let Ok(port) = text.parse() {
        return Ok(SocketAddr::new(local, port));
    }
    let address = text.parse().or_else(|_| text.parse().map(|ip: IpAddr| SocketAddr::new(ip, 0)));
    address.map_err(|_| "write a port such as 8080, or an address such as 127.0.0.1:8080".to_owned())
}

#[cfg(test)]
mod tests {
    use motet_robots::clearance::ClearanceOverride;

    use super::{address, clearance, duration};

    #[test]
    fn clearance_reads_lengths_of_base_and_arm() {
        let of = |base_m, arm_m| Ok(ClearanceOverride { base_m, arm_m });
        assert_eq!(clearance("base=5cm,arm=0.01"), of(Some(0.05), Some(0.01)));
        assert_eq!(clearance("arm = 3 mm"), of(None, Some(0.003)));
        assert_eq!(clearance("base=0"), of(Some(0.0), None));
        for text in ["", "base", "base=", "base=-1", "base=1", "head=0.1", "base=0.1,base=0.2", "arm=5kg"] {
            assert!(clearance(text).is_err(), "{text}");
        }
    }

    #[test]
    fn duration_reads_numbers_with_units() {
        for (text, secs) in [("90s", 90.0), ("10min", 600.0), ("1.5 h", 5400.0), ("200ms", 0.2)] {
            assert_eq!(duration(text), Ok(secs), "{text}");
        }
        for text in ["", "10", "s", "-5s", "0s", "1e9s", "10 weeks", "1.2.3s", "∞ s"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }

    #[test]
    fn address_is_local_unless_told_otherwise() {
        for (text, is) in [
            ("", "127.0.0.1:0"),
            ("8080", "127.0.0.1:8080"),
            ("0.0.0.0", "0.0.0.0:0"),
            ("[::1]:9", "[::1]:9"),
            ("10.0.0.1:80", "10.0.0.1:80"),
        ] {
            assert_eq!(address(text), Ok(is.parse().unwrap()), "{text}");
        }
        for wrong in ["localhost", "70000", "example.org:80", "1.2.3.4:x", "-1"] {
            assert!(address(wrong).is_err(), "{wrong}");
        }
    }
}
