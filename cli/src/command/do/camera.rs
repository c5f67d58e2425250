//! Grounding with the robot's camera: `ground` asks the model with a picture.

use motet_planner::vision::{GroundedPoint, GroundingDriver};
use motet_robots::scene::Scene;
use motet_runtime::{Driver, Perception};
use serde_json::json;

use super::ModelArgs;
use super::planner::{client, printable};
use super::record::ConversationRecord;
use crate::error::CliError;
use crate::output::note;

/// Log of the points that a model gives.
pub(super) struct PointLog {
    pub(super) is_shown: bool,
    pub(super) record: Option<ConversationRecord>,
}

/// Driver whose `ground` asks the model of the flags.
///
/// # Errors
///
/// The address, an image or the key cannot be used.
pub(super) fn pointing<'d>(
    model: &ModelArgs,
    driver: &'d mut dyn Driver,
    eyes: &'d mut dyn Perception,
    scene: &'d Scene,
    log: PointLog,
) -> Result<GroundingDriver<'d>, CliError> {
    let client = client(model)?;
    Ok(GroundingDriver::new(driver, eyes, scene, Box::new(client))
        .with_listener(move |pointed| log.add(pointed)))
}

impl PointLog {
    fn add(&self, GroundedPoint { object, used_for, found }: GroundedPoint<'_>) {
        let used_for = printable(used_for);
        let (words, more) = match found {
            Ok(pose) => {
                let [x, y, z] = pose.xyz;
                (format!("at ({x:.2}, {y:.2}, {z:.2}) m"), json!({"xyz": pose.xyz}))
            }
            Err(why) => (format!("no point: {why}"), json!({"why": why.to_string()})),
        };
        if self.is_shown {
            note(&printable(&format!("  {used_for} of {object}: {words}")));
        }
        if let Some(record) = &self.record {
            let mut line = json!({"object": object.as_str(), "use": used_for});
            if let (Some(line), Some(more)) = (line.as_object_mut(), more.as_object()) {
                line.extend(more.clone());
            }
            record.write("pointed", line);
        }
    }
}
