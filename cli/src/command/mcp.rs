//! `motet mcp`: a server of the Model Context Protocol for agents, on stdin and stdout or over HTTP.

mod answer;
mod check;
mod checker;
mod environment;
mod http;
mod motion;
mod narration;
mod question;
mod resource;
mod robot;
mod run_table;
mod server;
mod simulation;
mod task;
mod text;
mod tool;
mod watch;
mod world;

use std::path::PathBuf;
use std::sync::{Arc, mpsc};
use std::thread;
use std::time::Duration;

use clap::Args;
use rmcp::ServiceExt as _;
use tokio::runtime::Runtime;

use self::environment::AgentEnvironments;
use self::http::{BearerToken, HttpAccess, HttpAddress};
use self::robot::RobotInputs;
use self::run_table::RunTable;
use self::server::{DrivenRobot, MotetServer};
use crate::error::{CliError, Exit};
use crate::flags::{DriverArgs, DriverChoice, SessionArgs, Speed, seed};
use crate::interrupt::{SLICE, catch_interrupts, is_interrupted};
use crate::output::note;

/// Flags of `motet mcp`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet mcp --robot hsr --scene kitchen                     check, plan and simulate; nothing moves\n  \
    motet mcp --robot hsr --scene kitchen --drive kinematic   run policies in the simulator\n  \
    motet mcp --robot hsr --scene kitchen --drive 'python3 my_driver.py'\n  \
    motet mcp --robot hsr --scene kitchen --http 4712 --token-from MOTET_TOKEN")]
pub(crate) struct McpArgs {
    #[command(flatten)]
    session: SessionArgs,
    /// Driver on which clients may run policies that check: `kinematic`, the simulator without physics;
    /// `mujoco`, physics; a command that speaks the driver protocol; or tcp://127.0.0.1:PORT [default: none,
    /// and nothing moves]
    #[arg(long, value_name = "kinematic|mujoco|COMMAND|ADDRESS")]
    drive: Option<DriverChoice>,
    /// Speed relative to real time: a factor, or `max` for as fast as possible [default: 1]
    #[arg(long, value_name = "max|FACTOR", requires = "drive", allow_negative_numbers = true)]
    speed: Option<Speed>,
    /// Seed of all randomness in the simulation [default: 0]
    #[arg(long, value_name = "NUMBER", value_parser = seed, requires = "drive")]
    seed: Option<u64>,
    /// JSON file with faults to inject
    #[arg(long, value_name = "FILE", requires = "drive")]
    faults: Option<PathBuf>,
    /// Profile of what goes wrong by itself: `ideal`, `typical`, `harsh`, or a TOML file [default: typical]
    #[arg(long, value_name = "NAME|FILE", requires = "drive")]
    profile: Option<String>,
    /// Scene of the simulation if it differs from the one that the robot knows: a built-in name, or a JSON
    /// file
    #[arg(long, value_name = "NAME|FILE", requires = "drive")]
    world: Option<String>,
    /// Folder for the journals of runs, one folder each
    #[arg(long, value_name = "FOLDER", default_value = "motet-runs")]
    journals: PathBuf,
    /// Serve over HTTP at the path /mcp, on this port of this machine or on this address, in place of stdin
    /// and stdout
    #[arg(long, value_name = "PORT|ADDRESS", requires = "token_from")]
    http: Option<HttpAddress>,
    /// Environment variable that holds the token which clients send as `Authorization: Bearer TOKEN`
    #[arg(long, value_name = "VARIABLE", requires = "http")]
    token_from: Option<String>,
    /// Further name of this host in requests over HTTP; repeatable
    #[arg(long, value_name = "HOST", requires = "http")]
    allow_host: Vec<String>,
    /// Origin of a page in a browser that may send requests, such as https://example.com; repeatable
    #[arg(long, value_name = "ORIGIN", requires = "http")]
    allow_origin: Vec<String>,
}

impl McpArgs {
    /// Driver of the flags with its settings.
    fn driver(&self) -> Option<DriverArgs> {
        let driver = self.drive.clone()?;
        let (faults, profile, world) = (self.faults.clone(), self.profile.clone(), self.world.clone());
        Some(DriverArgs { driver, speed: self.speed, seed: self.seed, faults, profile, world, answers: None })
    }

    fn access(&self) -> Result<Option<HttpAccess>, CliError> {
        let (Some(address), Some(variable)) = (self.http, &self.token_from) else { return Ok(None) };
        let token = BearerToken::from_variable(variable)?;
        let (hosts, origins) = (self.allow_host.clone(), self.allow_origin.clone());
        Ok(Some(HttpAccess { address, token, hosts, origins }))
    }
}

/// Runs the command.
pub(crate) fn run(args: &McpArgs) -> Result<Exit, CliError> {
    let driver = args.driver();
    driver.iter().try_for_each(DriverArgs::refuse_flags)?;
    let access = args.access()?;
    let project = args.session.project_here()?;
    let scene = project.scene_name().map(str::to_owned);
    let situations = Arc::new(AgentEnvironments::open(project, scene)?);
    catch_interrupts()?;
    let runs = Arc::new(RunTable::default());
    let (orders, ordered) = mpsc::channel();
    let (ready, opened) = mpsc::channel();
    thread::scope(|scope| {
        let robot = match &driver {
            None => {
                drop((orders, ready));
                None
            }
            Some(driver) => {
                let journals = args.journals.clone();
                std::fs::create_dir_all(&journals)
                    .map_err(|source| CliError::Write { path: journals.clone(), source })?;
                let inputs = RobotInputs {
                    driver,
                    environment: &args.session.environment,
                    journals: &args.journals,
                    situations: &situations,
                    runs: &runs,
                };
                scope.spawn(move || robot::serve(&inputs, &ordered, &ready));
                let gone = || CliError::Message("the driver is gone".to_owned());
                opened.recv().map_err(|_| gone())??;
                Some(DrivenRobot { orders, runs: Arc::clone(&runs), journals })
            }
        };
        let served = serve(MotetServer::new(Arc::clone(&situations), robot), access);
        // The robot stands still before the process ends; its thread ends with the last order.
        runs.close();
        served
    })
}

/// Serves clients until they are gone or a signal comes.
fn serve(server: MotetServer, access: Option<HttpAccess>) -> Result<Exit, CliError> {
    let runtime = Runtime::new()
        .map_err(|error| CliError::Message(format!("cannot start the threads of the server: {error}")))?;
    let served = runtime.block_on(async {
        let interrupted = async {
            while !is_interrupted() {
                tokio::time::sleep(SLICE).await;
            }
            Ok(Exit::Interrupted)
        };
        let served = async {
            match access {
                Some(access) => http::serve(server, access).await?,
                None => stdio(server).await?,
            }
            Ok(Exit::Success)
        };
        tokio::select! {
            result = interrupted => result,
            result = served => result,
        }
    });
    // A read of stdin does not end by itself.
    runtime.shutdown_timeout(Duration::from_millis(200));
    served
}

async fn stdio(server: MotetServer) -> Result<(), CliError> {
    let serving = server.serve(rmcp::transport::stdio()).await;
    let serving = match serving {
        Ok(serving) => serving,
        Err(error) => {
            note(&format!("no client: {}", crate::output::escape(&error.to_string())));
            return Ok(());
        }
    };
    // How the connection ended is of no interest.
    let _ = serving.waiting().await;
    Ok(())
}
