//! `motet do`: a request in words, carried out in simulation: planned, checked, run, asked about and planned anew.

mod camera;
mod eyes;
mod model;
mod person;
mod record;
mod scribe;
mod speaker;

use std::cell::RefCell;
use std::rc::Rc;

use motet_compiler::Options;
use motet_planner::Planner;
use motet_planner::dialogue::{Conversation, DialogueSetup, Outcome};
use motet_runtime::{Driver, Time};
use motet_sim::Sim;
use motet_syntax::Sources;
use motet_syntax::ast::File;

use super::run;
use crate::args::{DoArgs, Format, RunFormat};
use crate::exit::{Exit, Trouble};
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::{self, Workbench};
use eyes::Eyes;
use person::{Asked, Asking};
use record::Recorder;
use speaker::Speaker;

/// Runs the command.
///
/// # Errors
///
/// What it runs against cannot be used, or the record cannot be written.
pub(crate) fn run(args: &DoArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(Format::Human, colors);
    report.hold();
    let result = act(args, colors, &mut report);
    report.close(result)
}

fn act(args: &DoArgs, colors: Colors, report: &mut Report) -> Result<Exit, Trouble> {
    let mut bench = Workbench::open(&args.world, report)?;
    let setting = bench.setting(&File::default(), report)?;
    let Some(robot) = setting.robot.clone() else {
        return Err(Trouble::Other("a robot is needed to do something: give --robot NAME".to_owned()));
    };
    let scene = setting.scene.clone().unwrap_or_default();
    let (domains, geometry) = (setting.domains.clone(), setting.geometry.clone());
    let real = match &args.real {
        Some(name) => workbench::read_scene(name, &mut Sources::default(), report)?,
        None => scene.clone(),
    };
    let eye = geometry.as_ref().and_then(|geometry| geometry.eye());
    let simulator = run::simulator((&robot, &setting.session), &real, eye, &args.simulated, report)?;
    let asked = Rc::new(Asked::read(&args.ask)?);
    let recorder = args.record.as_deref().map(Recorder::create).transpose()?;
    let setting = DialogueSetup {
        robot,
        scene,
        domains,
        geometry,
        options: Options { max_duration_secs: args.world.max_duration },
    };
    let mut planner = model::planner(args, colors, recorder.clone())?;
    run::catch_interrupts()?;
    let outcome = carry_out(args, colors, &setting, &mut *planner, simulator, &asked, recorder)?;
    Ok(match &outcome {
        Outcome::Done => Exit::Clean,
        Outcome::Stopped => Exit::Interrupted,
        Outcome::GivenUp => {
            note("left as it is");
            Exit::Failed
        }
        Outcome::Failed(problem) => {
            note(&format!("not done ({}): {}", problem.kind.name(), problem.question));
            Exit::Failed
        }
    })
}

fn carry_out(
    args: &DoArgs,
    colors: Colors,
    setting: &DialogueSetup,
    planner: &mut dyn Planner,
    simulator: Sim,
    asked: &Rc<Asked>,
    recorder: Option<Recorder>,
) -> Result<Outcome, Trouble> {
    let mut talk = Conversation::new(setting);
    let mut world = Rc::new(RefCell::new(simulator));
    let (mut sight, eyes) = (Rc::clone(&world), Rc::clone(&world));
    let mut robot = Speaker::new(&mut world, Rc::clone(asked));
    let mut pointing;
    let driver: &mut dyn Driver = if args.asking.camera {
        talk = talk.with_eyes(eyes);
        let is_shown = args.format == RunFormat::Human;
        let told = camera::Told { is_shown, recorder: recorder.clone() };
        pointing = camera::pointing(&args.asking, &mut robot, &mut sight, &setting.scene, told)?;
        &mut pointing
    } else {
        &mut robot
    };
    let mut watcher = Eyes::new(args, colors, Rc::clone(asked), recorder);
    let mut person = Asking(Rc::clone(asked));
    watcher.requested(&args.request);
    let (outcome, _) = talk.carry_out(&args.request, planner, driver, &mut person, &mut watcher, Time::ZERO);
    watcher.finish(&outcome)?;
    Ok(outcome)
}
