//! Driver of a run: the kinematic simulator, physics, a command, or a port, with the flags that belong to it.
//! `motet run`, `motet do` and `motet talk` have the same ones.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::str::FromStr;

use clap::Args;
use motet_host::remote::{DriverAddress, DriverAddressError};
use motet_planner::runtime_check::CheckMode;
use motet_project::{DiagnosticSink, ProjectError, SimulationInputs, read_profile, read_scene};
use motet_robots::card::CameraMount;
use motet_syntax::Sources;

use crate::error::CliError;
use crate::sibling;

/// Driver with its settings.
#[derive(Args, Debug)]
pub(crate) struct DriverArgs {
    /// Driver: `kinematic`, the simulator without physics; `mujoco`, physics, for which Python needs the
    /// package `motet-mujoco`; `ros2:BINDING`, a robot that speaks ROS 2, which needs the executable
    /// `motet-ros2`; a command that speaks the driver protocol on its stdin and stdout; or
    /// tcp://127.0.0.1:PORT
    #[arg(long, default_value = "kinematic", value_name = "kinematic|mujoco|ros2:BINDING|COMMAND|ADDRESS")]
    pub(crate) driver: DriverChoice,
    /// Speed relative to real time: a factor, or `max` for as fast as possible [default: 1]
    #[arg(long, value_name = "max|FACTOR", allow_negative_numbers = true)]
    pub(crate) speed: Option<Speed>,
    /// Seed of all randomness in the simulation [default: 0]
    #[arg(long, value_name = "NUMBER", value_parser = seed, allow_negative_numbers = true)]
    pub(crate) seed: Option<u64>,
    /// JSON file with faults to inject
    #[arg(long, value_name = "FILE")]
    pub(crate) faults: Option<PathBuf>,
    /// Profile of what goes wrong by itself: `ideal`, `typical`, `harsh`, or a TOML file [default: typical]
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) profile: Option<String>,
    /// Scene of the simulation if it differs from the one that the robot knows: a built-in name, or a JSON
    /// file
    #[arg(long, alias = "real", value_name = "NAME|FILE")]
    pub(crate) world: Option<String>,
    /// JSON file with the answers of the simulated person to `ask` and `choose`; the robot's own questions
    /// about a request are asked on the terminal
    #[arg(long, value_name = "FILE")]
    pub(crate) answers: Option<PathBuf>,
}

impl DriverArgs {
    /// Profile of the simulation.
    fn profile(&self) -> &str {
        self.profile.as_deref().unwrap_or("typical")
    }

    /// Refuses flags that mean nothing to the driver.
    pub(crate) fn refuse_flags(&self) -> Result<(), CliError> {
        if matches!(self.driver, DriverChoice::Kinematic | DriverChoice::Mujoco) {
            return Ok(());
        }
        let given = [
            ("--faults", self.faults.is_some()),
            ("--answers", self.answers.is_some()),
            ("--profile", self.profile.is_some()),
            ("--world", self.world.is_some()),
            ("--seed", self.seed.is_some()),
        ];
        match given.iter().find(|(_, is_given)| *is_given) {
            None => Ok(()),
            Some((flag, _)) => Err(CliError::Advised {
                problem: format!(
                    "`{flag}` is for the simulators, `kinematic` and `mujoco`, not for another driver"
                ),
                help: format!("leave out `{flag}`, or write a flag of the driver into `--driver COMMAND`"),
            }),
        }
    }

    /// Speed of the run.
    pub(crate) fn speed(&self) -> Speed {
        self.speed.unwrap_or(Speed::Times(1.0))
    }

    /// Seed of the run.
    pub(crate) fn seed(&self) -> u64 {
        self.seed.unwrap_or_default()
    }

    /// Reads the inputs of a simulation. `eye` is the camera of the robot as its joints bear it.
    pub(crate) fn inputs(
        &self,
        eye: Option<CameraMount>,
        sink: &mut dyn DiagnosticSink,
    ) -> Result<SimulationInputs, ProjectError> {
        let (faults, answers) = (self.faults.as_deref(), self.answers.as_deref());
        let inputs = SimulationInputs::read(self.seed(), faults, answers, sink)?;
        let world = match &self.world {
            Some(name) => Some(read_scene(name, &mut Sources::default(), sink)?),
            None => None,
        };
        Ok(inputs.with_profile(read_profile(self.profile())?).with_world(world).with_eye(eye))
    }
}

/// Reads a seed.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| format!("write a whole number from 0 to {}, such as 7", u64::MAX))
}

/// Speed of simulated time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Speed {
    /// As fast as possible.
    Max,
    /// Factor of real time.
    Times(f64),
}

impl Speed {
    /// Schedule of the checks of deferred motions. A run at full speed checks them in place and so is
    /// reproducible.
    pub(crate) const fn verifies(self) -> CheckMode {
        match self {
            Self::Max => CheckMode::AtOnce,
            Self::Times(_) => CheckMode::Background,
        }
    }
}

impl FromStr for Speed {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "max" {
            return Ok(Self::Max);
        }
        let factor: Option<f64> = text.strip_suffix('x').unwrap_or(text).parse().ok();
        match factor {
            Some(factor) if factor.is_finite() && factor > 0.0 => Ok(Self::Times(factor)),
            _ => Err("write `max`, or a factor above 0 such as 10".to_owned()),
        }
    }
}

/// Python interpreter of the physics driver.
const PYTHON: &str = "python3";
/// Package of the physics driver.
const PACKAGE: &str = "motet_mujoco";
/// Executable of the driver for ROS 2, and its subcommand.
const ROS2: &str = "motet-ros2";
const DRIVE: &str = "drive";
/// Modules that the physics driver imports.
const MODULES: [&str; 3] = [PACKAGE, "mujoco", "numpy"];
/// Program that prints the modules that are missing, of those that are its arguments.
const MISSING: &str = "import importlib.util as u, sys\n\
    print(*[m for m in sys.argv[1:] if u.find_spec(m) is None])";

/// Driver that a run asks for.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum DriverChoice {
    /// The simulator in this process.
    Kinematic,
    /// The physics driver with the robot, the scene and the seed of the flags.
    Mujoco,
    /// The driver for ROS 2 with a binding, and the robot and the scene of the flags.
    Ros2(String),
    /// A driver in another process.
    Process(DriverAddress),
}

impl FromStr for DriverChoice {
    type Err = DriverAddressError;

    fn from_str(text: &str) -> Result<Self, DriverAddressError> {
        match text.trim() {
            "kinematic" => Ok(Self::Kinematic),
            "mujoco" => Ok(Self::Mujoco),
            other => match other.strip_prefix("ros2:") {
                Some(binding) => Ok(Self::Ros2(binding.to_owned())),
                None => Ok(Self::Process(other.parse()?)),
            },
        }
    }
}

impl DriverChoice {
    /// Address of the driver; `None` for the simulator in this process.
    pub(crate) fn address(
        &self,
        robot: Option<&str>,
        scene: Option<&str>,
        simulation: &DriverArgs,
    ) -> Result<Option<DriverAddress>, CliError> {
        match self {
            Self::Kinematic => Ok(None),
            Self::Process(address) => Ok(Some(address.clone())),
            Self::Ros2(binding) => {
                let missing = "`--driver ros2:BINDING` needs a scene: give --scene NAME|FILE";
                let scene = scene.ok_or_else(|| CliError::Message(missing.to_owned()))?;
                let program = sibling::find(ROS2)?.to_string_lossy().into_owned();
                let mut words = vec![program, DRIVE.to_owned(), binding.clone()];
                words.extend(["--scene".to_owned(), scene.to_owned()]);
                words.extend(robot.into_iter().flat_map(|robot| ["--robot".to_owned(), robot.to_owned()]));
                words.extend(own_program());
                Ok(Some(DriverAddress::Command(words)))
            }
            Self::Mujoco => {
                let missing = |what: &str, flag: &str| {
                    CliError::Message(format!("`--driver mujoco` needs a {what}: give {flag}"))
                };
                let robot = robot.ok_or_else(|| missing("robot", "--robot NAME|FOLDER"))?;
                let scene = scene.ok_or_else(|| missing("scene", "--scene NAME|FILE"))?;
                check_modules()?;
                let seed = simulation.seed().to_string();
                let world = simulation.world.as_deref().unwrap_or(scene);
                let words = [PYTHON, "-m", PACKAGE, "--robot", robot, "--scene", world, "--seed", &seed];
                let mut words: Vec<String> = words.map(str::to_owned).to_vec();
                let path = |path: Option<&Path>| path.map(|path| path.display().to_string());
                let flags = [
                    ("--told", simulation.world.as_ref().map(|_| scene.to_owned())),
                    ("--profile", Some(simulation.profile().to_owned())),
                    ("--faults", path(simulation.faults.as_deref())),
                    ("--answers-file", path(simulation.answers.as_deref())),
                ];
                let flags = flags.into_iter().filter_map(|(flag, value)| Some([flag.to_owned(), value?]));
                words.extend(flags.flatten());
                words.extend(own_program());
                Ok(Some(DriverAddress::Command(words)))
            }
        }
    }

    /// Address of the driver of a journal, where this choice gives it again. The program to start is always
    /// that of the choice: a journal is data, and its author may be anybody.
    pub(crate) fn again(&self, saved: &DriverAddress) -> Option<DriverAddress> {
        match (self, saved) {
            (Self::Process(address), _) => Some(address.clone()),
            (Self::Mujoco, DriverAddress::Command(words)) => {
                let [python, flag, package, arguments @ ..] = words.as_slice() else { return None };
                if python != PYTHON || flag != "-m" || package != PACKAGE {
                    return None;
                }
                let arguments = arguments.iter().take_while(|word| *word != OWN_PROGRAM).cloned();
                let start = [python, flag, package].map(Clone::clone).into_iter();
                Some(DriverAddress::Command(start.chain(arguments).chain(own_program()).collect()))
            }
            (Self::Ros2(binding), DriverAddress::Command(words)) => {
                let [_, command, _, arguments @ ..] = words.as_slice() else { return None };
                let program = sibling::find(ROS2).ok().filter(|_| command == DRIVE)?;
                let start = [program.to_string_lossy().into_owned(), command.clone(), binding.clone()];
                let arguments = arguments.iter().take_while(|word| *word != OWN_PROGRAM).cloned();
                Some(DriverAddress::Command(
                    start.into_iter().chain(arguments).chain(own_program()).collect(),
                ))
            }
            (Self::Kinematic | Self::Mujoco | Self::Ros2(_), _) => None,
        }
    }

    /// Flag that gives the driver of a journal again, as a shell takes it.
    pub(crate) fn flag_for(saved: &DriverAddress) -> String {
        if Self::Mujoco.again(saved).is_some() {
            return "--driver mujoco".to_owned();
        }
        if let DriverAddress::Command(words) = saved
            && let [program, command, binding, ..] = words.as_slice()
            && Path::new(program).ends_with(ROS2)
            && command == DRIVE
        {
            return format!("--driver {}", quoted(&format!("ros2:{binding}")));
        }
        let words = match saved {
            DriverAddress::Tcp(_) => saved.to_string(),
            DriverAddress::Command(words) => {
                words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
            }
        };
        format!("--driver {}", quoted(&words))
    }
}

/// Flag of the physics driver for the program that writes its model.
const OWN_PROGRAM: &str = "--motet";

/// Arguments of the physics driver that let it read the model from this very program.
fn own_program() -> Vec<String> {
    let own = crate::PROGRAM.get().cloned().or_else(|| std::env::current_exe().ok());
    let own = own.as_deref().and_then(Path::to_str);
    own.map_or_else(Vec::new, |own| vec![OWN_PROGRAM.to_owned(), own.to_owned()])
}

/// Word as `--driver` and a shell take it.
fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_./:=,@+%".contains(letter);
    match word {
        _ if !word.is_empty() && word.chars().all(is_plain) => word.to_owned(),
        _ if word.contains('\'') => format!("\"{word}\""),
        _ => format!("'{word}'"),
    }
}

/// Checks that Python has everything that the physics driver imports.
fn check_modules() -> Result<(), CliError> {
    let advised = |problem: String, help: &str| Err(CliError::Advised { problem, help: help.to_owned() });
    let asked = Command::new(PYTHON).args(["-c", MISSING]).args(MODULES).stdin(Stdio::null()).output();
    let output = match asked {
        Ok(output) if output.status.success() => output,
        Ok(_) => return advised(format!("`{PYTHON}` does not work"), "install Python 3.11 or later"),
        Err(error) => {
            let problem = format!("`--driver mujoco` cannot start `{PYTHON}`: {error}");
            return advised(problem, "install Python 3.11 or later, in PATH");
        }
    };
    let said = String::from_utf8_lossy(&output.stdout);
    let missing: Vec<&str> =
        MODULES.into_iter().filter(|name| said.split_whitespace().any(|m| m == *name)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let names: Vec<String> = missing.iter().map(|name| format!("`{name}`")).collect();
    advised(
        format!("`--driver mujoco` needs Python modules that `{PYTHON}` does not find: {}", names.join(", ")),
        "run `pip install runtime/mujoco` in the sources of Motet, with the same Python",
    )
}

#[cfg(test)]
mod tests {
    use super::DriverChoice;
    use motet_host::remote::DriverAddress;

    #[test]
    fn driver_choice_is_a_word_or_an_address() {
        assert_eq!("kinematic".parse(), Ok(DriverChoice::Kinematic));
        assert_eq!(" mujoco ".parse(), Ok(DriverChoice::Mujoco));
        let command = DriverAddress::Command(vec!["./mujoco".to_owned(), "-x".to_owned()]);
        assert_eq!("./mujoco -x".parse(), Ok(DriverChoice::Process(command)));
        let flag = |words: &[&str]| {
            let saved = DriverAddress::Command(words.iter().map(|word| (*word).to_owned()).collect());
            DriverChoice::flag_for(&saved)
        };
        assert_eq!(flag(&["python3", "my driver.py"]), "--driver \"python3 'my driver.py'\"");
        assert_eq!(flag(&["python3", "-m", "motet_mujoco", "--robot", "hsr"]), "--driver mujoco");
        assert_eq!("ros2:hsr".parse(), Ok(DriverChoice::Ros2("hsr".to_owned())));
        assert_eq!(flag(&["bin/motet-ros2", "drive", "hsr", "--scene", "kitchen"]), "--driver ros2:hsr");
        assert!("".parse::<DriverChoice>().is_err());
        assert!("tcp://192.0.2.1:1".parse::<DriverChoice>().is_err());
    }
}
