//! Whether a robot can get at a thing from where it is: asked by who plans, before there is any policy.

use std::sync::Arc;

use motet_geometry::planning::{MotionAnswer, MotionQuery, UnknownReason};
use smol_str::{SmolStr, format_smolstr};

use super::Geometry;
use super::geometry::Change;

/// Whether a robot can get at a thing.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Access {
    /// A way and the motion at its end were found.
    Feasible,
    /// There is none.
    Infeasible {
        /// Why: `too heavy: …`.
        why: SmolStr,
        /// Whether that is proven; else a search came to its end and found nothing.
        is_certified: bool,
    },
    /// It is not known, for this reason.
    Unknown(SmolStr),
}

impl Geometry {
    /// Whether the robot, from where it is at the start, can get to a thing and there grasp it, or open or close it by its
    /// handle, where it is something of that kind. At most two searches, whose answers are kept.
    #[must_use]
    pub fn access(&self, id: &str) -> Access {
        let start = match self.start() {
            Ok(start) => start,
            Err(why) => return Access::Unknown(why),
        };
        let Some(entity) = self.scene().entities.get(id) else {
            return Access::Unknown(format_smolstr!("the scene has no `{id}`"));
        };
        if self.scene().robot.holding.as_ref().and_then(Option::as_ref) == Some(&entity.id) {
            return Access::Feasible;
        }
        if let Some(around) = &entity.inside
            && self.is_open(&start.world, around) == Some(false)
        {
            return Access::Unknown(format_smolstr!("it is in {around}, which is closed"));
        }
        let (mut at, id) = (start, entity.id.clone());
        if self.machine().drives() {
            let query = MotionQuery::GoTo(id.clone());
            let answer = self.answer(&at, &query);
            let MotionAnswer::Feasible(way) = &*answer else { return said(&answer) };
            match self.after(&at, &query, Change::Gone, way) {
                Some(there) => at = Arc::clone(&there),
                None => return Access::Unknown(SmolStr::new_static("where the way ends is not known")),
            }
        }
        let query = match self.is_open(&at.world, &id) {
            Some(true) => MotionQuery::Push(id),
            Some(false) => MotionQuery::Pull(id),
            None if entity.kind == "Object" => MotionQuery::Reach(id, None),
            None => return Access::Feasible,
        };
        said(&self.answer(&at, &query))
    }
}

fn said(answer: &MotionAnswer) -> Access {
    match answer {
        MotionAnswer::Feasible(_) => Access::Feasible,
        MotionAnswer::Infeasible(why) => {
            let is_certified = why.certified;
            Access::Infeasible { why: format_smolstr!("{}", why.reason), is_certified }
        }
        MotionAnswer::Unknown(UnknownReason::Budget) => {
            Access::Unknown(SmolStr::new_static("the search was cut short"))
        }
        MotionAnswer::Unknown(UnknownReason::Because(why)) => Access::Unknown(why.as_str().into()),
    }
}
