//! One call in the worlds that may be met: its motion answered in each, and the worlds after it.

use std::sync::Arc;

use motet_geometry::planning::{MotionAnswer, MotionQuery, UnknownReason};
use smol_str::{SmolStr, format_smolstr};

use super::Verdict;
use super::geometry::Change;
use super::meaning::{Leaves, leaves, moves, moves_blindly};
use super::walk::Walk;
use super::ways::{Situation, Ways};
use super::witness::kept;
use crate::ir::{Call, StepId};
use crate::library::PrimitiveDef;

impl Walk<'_> {
    /// The worlds after a call, where it succeeds.
    pub(super) fn call(&mut self, id: StepId, call: &Call, before: Ways) -> Ways {
        let Some(def) = self.library.primitive(call.primitive) else { return before };
        if def.motion.is_none() {
            if !moves_blindly(self.library, def) {
                self.caught(&before);
                return before;
            }
            let lost = Ways::lost(format_smolstr!("where things are after `{}` is not known", def.name));
            self.caught(&lost);
            return lost;
        }
        let before = self.possible(id, before);
        let query = match self.query(call, def) {
            Ok(query) => query,
            Err(why) => {
                self.found(id, Some(Verdict::Deferred(Some(why.clone()))), None);
                return self.blind(def, before, why);
            }
        };
        let moves = moves(&query);
        if moves {
            self.caught(&Ways::lost(format_smolstr!("where `{}` stopped is not known", def.name)));
        } else {
            self.caught(&before);
        }
        let mut after = Ways { known: Vec::new(), lost: before.lost.clone() };
        let (mut witness, mut unknown, mut refused, mut is_refused) = (None, before.lost.clone(), None, true);
        let mut warned = None;
        for situation in before.known {
            let answer = self.geometry.answer(&situation.at, &query);
            match &*answer {
                MotionAnswer::Feasible(way) => {
                    is_refused = false;
                    if witness.is_none() {
                        witness = Some(Box::new(kept(self.geometry.machine(), way)));
                    }
                    after.join(self.following(id, call, def, &query, &situation, &answer));
                }
                MotionAnswer::Unknown(why) => {
                    is_refused = false;
                    unknown = unknown.or(Some(in_words(why)));
                    let why = format_smolstr!("how `{}` ends is not known", def.name);
                    after.join(if moves { Ways::lost(why) } else { only(situation) });
                }
                // The search found nothing and proves nothing: the run will see.
                MotionAnswer::Infeasible(why) if !why.certified => {
                    is_refused = false;
                    warned = warned.or_else(|| self.refusal(id, &def.name, &query, why, &situation));
                    unknown = unknown
                        .or_else(|| Some(format_smolstr!("the search found no motion: {}", why.reason)));
                    let why = format_smolstr!("how `{}` ends is not known", def.name);
                    after.join(if moves { Ways::lost(why) } else { only(situation) });
                }
                MotionAnswer::Infeasible(why) => {
                    let told = self.refusal(id, &def.name, &query, why, &situation);
                    // After a failure it is not certain that this world is met at all.
                    match (&refused, situation.is_certain) {
                        (None, certain) => refused = told.map(|told| (told, certain)),
                        (Some((_, false)), true) => refused = told.map(|told| (told, true)),
                        (Some(_), _) => {}
                    }
                    let why = format_smolstr!("`{}` cannot be done", def.name);
                    after.join(if moves { Ways::lost(why) } else { only(situation) });
                }
            }
        }
        let is_error = |certain: bool| certain || (is_refused && before.lost.is_none());
        let verdict = match (unknown, witness, &refused) {
            (None, Some(witness), None) => Verdict::Feasible(witness),
            (unknown, ..) => Verdict::Deferred(unknown),
        };
        let refused = refused.filter(|(_, certain)| is_error(*certain)).map(|(told, _)| told);
        self.found(id, Some(verdict), refused.or(warned));
        after
    }

    /// After a call of which the motion is not known.
    fn blind(&mut self, def: &PrimitiveDef, before: Ways, why: SmolStr) -> Ways {
        let moves = def.motion.as_ref().is_some_and(|(name, _)| name != "look");
        let after = if moves { Ways::lost(why) } else { before };
        self.caught(&after);
        after
    }

    /// The world after a motion that was found in a situation.
    fn following(
        &self,
        id: StepId,
        call: &Call,
        def: &PrimitiveDef,
        query: &MotionQuery,
        from: &Situation,
        answer: &MotionAnswer,
    ) -> Ways {
        let lost = || Ways::lost(format_smolstr!("how `{}` ends is not known", def.name));
        let MotionAnswer::Feasible(way) = answer else { return lost() };
        let change = match leaves(self.library, def, query) {
            Leaves::Changed(change) => change,
            Leaves::Nothing => return only(from.clone()),
            Leaves::Unknown => return lost(),
        };
        let Some(at) = self.geometry.after(&from.at, query, change, way) else { return lost() };
        let mut next = Situation { at, ..from.clone() };
        match (change, query) {
            (Change::Gone, MotionQuery::GoTo(target)) => {
                if from.at.key != next.at.key {
                    next.stands_since = Some(id);
                }
                match self.ends_at(call, def) {
                    Some(Ok(place)) if place != *target => return self.going_on(id, &place, next),
                    Some(Err(why)) => return Ways::lost(why),
                    Some(Ok(_)) | None => {}
                }
            }
            (Change::Taken, _) => next.held_since = Some(id),
            (Change::Put | Change::Given, MotionQuery::Put(object, _) | MotionQuery::Offer(object, _)) => {
                next.held_since = None;
                next.changed.push((object.clone(), id));
            }
            (Change::Travelled, MotionQuery::Pull(what) | MotionQuery::Push(what)) => {
                if from.at.world.robot != next.at.world.robot {
                    next.stands_since = Some(id);
                }
                next.changed.push((what.clone(), id));
            }
            (Change::Gone | Change::Put | Change::Given | Change::Travelled, _) => {}
        }
        only(next)
    }

    /// A motion of the base that goes on to where the robot serves what it found.
    fn going_on(&self, id: StepId, place: &SmolStr, from: Situation) -> Ways {
        let query = MotionQuery::GoTo(place.clone());
        let answer = self.geometry.answer(&from.at, &query);
        let after = match &*answer {
            MotionAnswer::Feasible(way) => self.geometry.after(&from.at, &query, Change::Gone, way),
            MotionAnswer::Infeasible(_) | MotionAnswer::Unknown(_) => None,
        };
        match after {
            Some(at) => only(Situation { at, stands_since: Some(id), ..from }),
            None => Ways::lost(format_smolstr!("where the robot serves `{place}` is not known")),
        }
    }
}

fn only(situation: Situation) -> Ways {
    Ways { known: vec![situation], lost: None }
}

fn in_words(why: &UnknownReason) -> SmolStr {
    match why {
        UnknownReason::Budget => SmolStr::new_static("the search was cut short"),
        UnknownReason::Because(why) => why.as_str().into(),
    }
}

/// A situation at the start.
pub(super) fn at_start(at: Arc<super::ways::Keyed>) -> Situation {
    Situation { at, stands_since: None, held_since: None, changed: Vec::new(), is_certain: true }
}
