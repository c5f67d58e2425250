//! Driver of a run: the kinematic simulator, physics, a command, or a port.

use std::path::Path;
use std::process::{Command, Stdio};
use std::str::FromStr;

use motet_host::remote::{DriverAddress, DriverAddressError};

use crate::error::CliError;
use crate::flags::SimulationArgs;

/// Python interpreter of the physics driver.
const PYTHON: &str = "python3";
/// Package of the physics driver.
const PACKAGE: &str = "motet_mujoco";
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
    /// A driver in another process.
    Process(DriverAddress),
}

impl FromStr for DriverChoice {
    type Err = DriverAddressError;

    fn from_str(text: &str) -> Result<Self, DriverAddressError> {
        match text.trim() {
            "kinematic" => Ok(Self::Kinematic),
            "mujoco" => Ok(Self::Mujoco),
            other => Ok(Self::Process(other.parse()?)),
        }
    }
}

impl DriverChoice {
    /// Refuses flags that mean nothing to this driver.
    pub(super) fn refuse_flags(
        &self,
        simulation: &SimulationArgs,
        answers: Option<&Path>,
    ) -> Result<(), CliError> {
        if *self == Self::Kinematic {
            return Ok(());
        }
        let given = [
            ("--faults", simulation.faults.is_some()),
            ("--answers", answers.is_some()),
            ("--profile", simulation.profile.is_some() && *self != Self::Mujoco),
            ("--world", simulation.world.is_some()),
            ("--seed", simulation.seed.is_some() && *self != Self::Mujoco),
        ];
        match given.iter().find(|(_, is_given)| *is_given) {
            None => Ok(()),
            Some((flag, _)) => Err(CliError::Advised {
                problem: format!("`{flag}` is for the kinematic simulator, not for another driver"),
                help: format!("leave out `{flag}`, or write a flag of the driver into `--driver COMMAND`"),
            }),
        }
    }

    /// Address of the driver; `None` for the simulator in this process.
    pub(super) fn address(
        &self,
        robot: Option<&str>,
        scene: Option<&str>,
        simulation: &SimulationArgs,
    ) -> Result<Option<DriverAddress>, CliError> {
        match self {
            Self::Kinematic => Ok(None),
            Self::Process(address) => Ok(Some(address.clone())),
            Self::Mujoco => {
                let missing = |what: &str, flag: &str| {
                    CliError::Message(format!("`--driver mujoco` needs a {what}: give {flag}"))
                };
                let robot = robot.ok_or_else(|| missing("robot", "--robot NAME|FOLDER"))?;
                let scene = scene.ok_or_else(|| missing("scene", "--scene NAME|FILE"))?;
                check_modules()?;
                let seed = simulation.seed().to_string();
                let words = [PYTHON, "-m", PACKAGE, "--robot", robot, "--scene", scene, "--seed", &seed];
                let mut words: Vec<String> = words.map(str::to_owned).to_vec();
                if let Some(profile) = &simulation.profile {
                    words.extend(["--profile".to_owned(), profile.clone()]);
                }
                // The driver reads the model from this very program.
                if let Some(own) = std::env::current_exe().ok().as_deref().and_then(Path::to_str) {
                    words.extend(["--motet".to_owned(), own.to_owned()]);
                }
                Ok(Some(DriverAddress::Command(words)))
            }
        }
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
        assert!("".parse::<DriverChoice>().is_err());
        assert!("tcp://192.0.2.1:1".parse::<DriverChoice>().is_err());
    }
}
