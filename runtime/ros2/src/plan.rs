//! Paths from where the robot really stands, by the command `motet feasible`.

use crate::tf::Planar;
use motet_graph::{Value, Witness};
use motet_robots::clearance::{Clearance, ClearanceOverride};
use motet_robots::scene::{Scene, write};
use motet_runtime::PlannedMotion;
use std::collections::BTreeMap;
use std::io::Read as _;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::Weak;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Limits of joints by their names in the card, in rad or m.
pub(crate) type Limits = BTreeMap<String, (f64, f64)>;

/// Error of a measured joint beyond its limit in rad or m.
const NEAR: f64 = 0.02;
/// Time limit for an answer of `motet feasible`.
const ANSWERS: Duration = Duration::from_secs(30);
/// Time between two looks at whether it has answered.
const LOOKS: Duration = Duration::from_millis(5);
/// Greatest size of its answer in bytes.
const MAX_ANSWER: u64 = 16 * 1024 * 1024;

/// What the card of the robot says, and the command that plans its paths.
#[derive(Clone, Debug)]
pub(crate) struct Card {
    /// Robot as the command line names it.
    pub(crate) name: String,
    /// The command `motet`, if it was found.
    pub(crate) program: Option<PathBuf>,
    pub(crate) limits: Limits,
    /// Positions of joints by their names in the card, by the name of the posture.
    pub(crate) postures: BTreeMap<String, Vec<(String, f64)>>,
    /// Positions of the joints of open hands, by their names in the card.
    pub(crate) open_hand: BTreeMap<String, f64>,
    /// Distances that the motions of the robot keep from obstacles.
    pub(crate) clearance: Clearance,
}

/// Why there is no path.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct NoPath {
    pub(crate) says: String,
    /// True if it is certain that there is none, and not only that none was found.
    pub(crate) is_certified: bool,
}

impl From<String> for NoPath {
    fn from(says: String) -> Self {
        Self { says, is_certified: false }
    }
}

/// Question that another thread answers: does a motion exist from here?
#[derive(Clone, Debug)]
pub(crate) struct Question {
    pub(crate) program: PathBuf,
    pub(crate) robot: String,
    pub(crate) scene: Scene,
    /// Motion as the language writes it, such as `reach(mug_1)`.
    pub(crate) motion: String,
}

impl Question {
    /// Question for a motion from a pose of the base and positions of joints by their names in the card. The
    /// path is to keep at least `clearance` m from obstacles. `None` without a command that plans.
    #[must_use]
    pub(crate) fn new(
        card: &Card,
        scene: &Scene,
        motion: String,
        base: Planar,
        joints: &BTreeMap<String, f64>,
        clearance: f64,
    ) -> Option<Self> {
        let (program, limits) = (card.program.clone()?, &card.limits);
        let mut scene = scene.clone();
        let Clearance { base_m, arm_m } = scene.clearance.over(card.clearance);
        scene.clearance =
            ClearanceOverride { base_m: Some(base_m.max(clearance)), arm_m: Some(arm_m.max(clearance)) };
        scene.robot.base = [base.x, base.y, base.yaw];
        scene.robot.joints.extend(joints.iter().map(|(name, value)| {
            // A joint that is measured a little beyond its limit is at it.
            let near = limits.get(name).filter(|(low, high)| (low - NEAR..=high + NEAR).contains(value));
            (name.as_str().into(), near.map_or(*value, |(low, high)| value.clamp(*low, *high)))
        }));
        Some(Self { program, robot: card.name.clone(), scene, motion })
    }

    /// Asks, and waits for the answer, as long as somebody wants it.
    ///
    /// # Errors
    ///
    /// The reason that no motion exists, or why nobody could say.
    pub(crate) fn ask(&self, wanted: &Weak<()>) -> Result<Witness, NoPath> {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("motet-ros2-{}-{number}.json", std::process::id()));
        std::fs::write(&path, write(&self.scene)).map_err(|error| format!("{}: {error}", path.display()))?;
        let asked = Command::new(&self.program)
            .args(["feasible", "--robot", &self.robot, "--for", &self.motion, "--format", "json", "--scene"])
            .arg(&path)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| format!("`{}` cannot be started: {error}", self.program.display()))
            .and_then(|child| said(child, wanted));
        let _ = std::fs::remove_file(&path);
        let [line, said] = asked?;
        let answer: serde_json::Value = serde_json::from_str(&line).map_err(|_| {
            format!("`motet feasible` has no answer: {}", said.lines().next().unwrap_or("it printed nothing"))
        })?;
        match answer.get("witness") {
            Some(witness) => {
                witness_of(witness).ok_or_else(|| "`motet feasible` wrote no path".to_owned().into())
            }
            None => {
                // An error in the motion or the scene comes as a finding with a code.
                let says = answer.get("says").or(answer.get("message")).and_then(serde_json::Value::as_str);
                let says = says.unwrap_or("no motion was found").to_owned();
                let certified = answer.get("certified").and_then(serde_json::Value::as_bool);
                let is_certified = certified.unwrap_or(answer.get("code").is_some());
                Err(NoPath { says, is_certified })
            }
        }
    }
}

/// First line of the output and text of the errors of a process. It is ended if nobody wants them any more.
///
/// # Errors
///
/// It took too long, or nobody wants its answer.
fn said(mut child: Child, wanted: &Weak<()>) -> Result<[String; 2], String> {
    let read = |stream: Option<Box<dyn std::io::Read + Send>>| {
        std::thread::spawn(move || {
            let mut bytes = Vec::new();
            // What was read before an error is the answer.
            let _ = stream.map(|stream| stream.take(MAX_ANSWER).read_to_end(&mut bytes));
            String::from_utf8_lossy(&bytes).into_owned()
        })
    };
    let output = read(child.stdout.take().map(|stream| Box::new(stream) as _));
    let errors = read(child.stderr.take().map(|stream| Box::new(stream) as _));
    let begun = Instant::now();
    let end = loop {
        match child.try_wait() {
            Ok(Some(_)) => break Ok(()),
            Ok(None) if wanted.strong_count() == 0 => break Err("nobody wants the path any more".to_owned()),
            Ok(None) if begun.elapsed() > ANSWERS => {
                break Err(format!("`motet feasible` had no answer after {} s", ANSWERS.as_secs()));
            }
            Ok(None) => std::thread::sleep(LOOKS),
            Err(error) => break Err(format!("`motet feasible`: {error}")),
        }
    };
    if let Err(why) = end {
        // It may have ended meanwhile.
        let _ = child.kill().and_then(|()| child.wait());
        return Err(why);
    }
    let [output, errors] = [output, errors].map(|thread| thread.join().unwrap_or_default());
    Ok([output.lines().next().unwrap_or_default().to_owned(), errors])
}

/// Motion of a command as the language writes it.
#[must_use]
pub(crate) fn motion(planned: &PlannedMotion) -> String {
    let args: Vec<String> = planned.args.iter().map(written).collect();
    format!("{}({})", planned.query, args.join(", "))
}

/// Witness in the form that `motet feasible` prints: joints by name at each waypoint.
fn witness_of(json: &serde_json::Value) -> Option<Witness> {
    let path = json.get("path")?.as_array()?;
    let number = |value: Option<&serde_json::Value>| value.and_then(serde_json::Value::as_f64);
    let mut names: Vec<smol_str::SmolStr> = Vec::new();
    for waypoint in path {
        for name in waypoint.get("joints")?.as_object()?.keys() {
            if !names.iter().any(|own| own == name) {
                names.push(name.as_str().into());
            }
        }
    }
    let waypoint = |waypoint: &serde_json::Value| {
        let base = waypoint.get("base")?.as_array()?;
        let base = [number(base.first())?, number(base.get(1))?, number(base.get(2))?];
        let joints = waypoint.get("joints")?;
        let joints: Option<Vec<f64>> = names.iter().map(|name| number(joints.get(name.as_str()))).collect();
        let (at, ramp) =
            (number(waypoint.get("at")).unwrap_or(0.0), number(waypoint.get("ramp")).unwrap_or(0.0));
        Some(motet_graph::Waypoint { base, joints: joints?, at, ramp })
    };
    let path: Option<Vec<_>> = path.iter().map(waypoint).collect();
    let path = path.filter(|path| !path.is_empty())?;
    let numbers = |value: Option<&serde_json::Value>| -> Option<Vec<f64>> {
        value?.as_array()?.iter().map(serde_json::Value::as_f64).collect()
    };
    let grasp = json.get("grasp").and_then(|grasp| {
        let tip = grasp.get("map_from_tip")?;
        let xyz = numbers(tip.get("xyz"))?.try_into().ok()?;
        let quaternion = numbers(tip.get("quaternion_xyzw"))?.try_into().ok()?;
        Some(motet_graph::Grasp { xyz, quaternion, width: number(grasp.get("width"))?, object: None })
    });
    let clearance = number(json.pointer("/margins/clearance")).unwrap_or(0.0);
    let keeps = motet_graph::Clearance::default();
    Some(Witness { joints: names, path, grasp, clearance, keeps, limit: None, payload: None })
}

/// A value as the language writes it.
pub(crate) fn written(value: &Value) -> String {
    match value {
        Value::Entity(id) => {
            let is_plain = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
            let is_name =
                id.starts_with(|first: char| first.is_ascii_alphabetic()) && id.chars().all(is_plain);
            if is_name { id.to_string() } else { format!("`{id}`") }
        }
        Value::Pose(pose) => {
            let [x, y, z] = pose.xyz;
            format!("pose({x:.4} m, {y:.4} m, {z:.4} m, {:.5} rad)", pose.yaw())
        }
        other => other.to_string(),
    }
}
