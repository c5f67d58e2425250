//! What the robot's camera shows the model: `ground` goes to it with a picture.

use motet_planner::vision::{GroundedPoint, GroundingDriver};
use motet_robots::scene::Scene;
use motet_runtime::{Driver, Perception};
use serde_json::json;

use super::model;
use super::record::Recorder;
use crate::args::ModelArgs;
use crate::exit::Trouble;
use crate::out::note;

/// Who is told of the points that a model gives.
pub(super) struct Told {
    pub(super) is_shown: bool,
    pub(super) recorder: Option<Recorder>,
}

/// A driver whose `ground` asks the model that the flags name.
///
/// # Errors
///
/// There is none to be asked.
pub(super) fn pointing<'d>(
    asking: &ModelArgs,
    driver: &'d mut dyn Driver,
    eyes: &'d mut dyn Perception,
    scene: &'d Scene,
    told: Told,
) -> Result<GroundingDriver<'d>, Trouble> {
    let client = model::client(asking)?;
    Ok(GroundingDriver::new(driver, eyes, scene, Box::new(client))
        .with_listener(move |pointed| told.hear(pointed)))
}

impl Told {
    fn hear(&self, GroundedPoint { object, used_for, found }: GroundedPoint<'_>) {
        let used_for = model::printable(used_for);
        let (words, more) = match found {
            Ok(pose) => {
                let [x, y, z] = pose.xyz;
                (format!("at ({x:.2}, {y:.2}, {z:.2}) m"), json!({"xyz": pose.xyz}))
            }
            Err(why) => (format!("no point: {why}"), json!({"why": why.to_string()})),
        };
        if self.is_shown {
            note(&model::printable(&format!("  {used_for} of {object}: {words}")));
        }
        if let Some(recorder) = &self.recorder {
            let mut line = json!({"object": object.as_str(), "use": used_for});
            if let (Some(line), Some(more)) = (line.as_object_mut(), more.as_object()) {
                line.extend(more.clone());
            }
            recorder.write("pointed", line);
        }
    }
}
