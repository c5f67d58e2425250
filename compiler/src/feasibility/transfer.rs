//! Transfer function of a call: the answers of its motion in all possible worlds, and the worlds after it.

use std::sync::Arc;

use motet_geometry::planning::{MotionAnswer, MotionQuery, UnknownReason};
use smol_str::{SmolStr, format_smolstr};

use super::MotionVerdict;
use super::geometry::SceneChange;
use super::motion::{MotionEffect, motion_effect, moves_blindly};
use super::walk::Walk;
use super::witness::kept;
use super::worlds::{PossibleWorld, Worlds};
use crate::declare::PrimitiveDef;
use crate::ir::{Call, StepId};

impl Walk<'_> {
    /// Worlds after a call that succeeds.
    pub(super) fn call(&mut self, id: StepId, call: &Call, before: Worlds) -> Worlds {
        let Some(def) = self.library.primitive(call.primitive) else { return before };
        let Some((kind, _)) = &def.motion else {
            if !moves_blindly(self.library, def) {
                self.caught(&before);
                return before;
            }
            let lost = Worlds::lost(format_smolstr!("where things are after `{}` is not known", def.name));
            self.caught(&lost);
            return lost;
        };
        let before = self.possible(id, before);
        let query = match self.query(call, def) {
            Ok(query) => query,
            Err(why) => {
                self.found(id, Some(MotionVerdict::Deferred(Some(why.clone()))), None);
                return self.blind(def, before, why);
            }
        };
        let moves = kind.moves();
        if moves {
            self.caught(&Worlds::lost(format_smolstr!("where `{}` stopped is not known", def.name)));
        } else {
            self.caught(&before);
        }
        let mut after = Worlds { known: Vec::new(), lost: before.lost.clone() };
        let (mut witness, mut unknown, mut refused, mut is_refused) = (None, before.lost.clone(), None, true);
        let mut warned = None;
        for possible in before.known {
            let answer = self.geometry.answer(&possible.at, &query);
            match &*answer {
                MotionAnswer::Feasible(way) => {
                    is_refused = false;
                    if witness.is_none() {
                        witness = Some(Box::new(kept(self.geometry.machine(), way)));
                    }
                    after.join(self.following(id, call, def, &query, &possible, &answer));
                }
                MotionAnswer::Unknown(why) => {
                    is_refused = false;
                    unknown = unknown.or(Some(in_words(why)));
                    let why = format_smolstr!("how `{}` ends is not known", def.name);
                    after.join(if moves { Worlds::lost(why) } else { only(possible) });
                }
                // The search found nothing and proves nothing: the run will see.
                MotionAnswer::Infeasible(why) if !why.certified => {
                    is_refused = false;
                    warned = warned.or_else(|| self.refusal(id, &def.name, &query, why, &possible));
                    unknown = unknown
                        .or_else(|| Some(format_smolstr!("the search found no motion: {}", why.reason)));
                    let why = format_smolstr!("how `{}` ends is not known", def.name);
                    after.join(if moves { Worlds::lost(why) } else { only(possible) });
                }
                MotionAnswer::Infeasible(why) => {
                    let told = self.refusal(id, &def.name, &query, why, &possible);
                    // After a failure it is not certain that this world is met at all.
                    match (&refused, possible.is_certain) {
                        (None, certain) => refused = told.map(|told| (told, certain)),
                        (Some((_, false)), true) => refused = told.map(|told| (told, true)),
                        (Some(_), _) => {}
                    }
                    let why = format_smolstr!("`{}` cannot be done", def.name);
                    after.join(if moves { Worlds::lost(why) } else { only(possible) });
                }
            }
        }
        let is_error = |certain: bool| certain || (is_refused && before.lost.is_none());
        let verdict = match (unknown, witness, &refused) {
            (None, Some(witness), None) => MotionVerdict::Feasible(witness),
            (unknown, ..) => MotionVerdict::Deferred(unknown),
        };
        let refused = refused.filter(|(_, certain)| is_error(*certain)).map(|(told, _)| told);
        self.found(id, Some(verdict), refused.or(warned));
        after
    }

    /// Worlds after a call whose motion query is unknown.
    fn blind(&mut self, def: &PrimitiveDef, before: Worlds, why: SmolStr) -> Worlds {
        let moves = def.motion.as_ref().is_some_and(|(kind, _)| kind.moves());
        let after = if moves { Worlds::lost(why) } else { before };
        self.caught(&after);
        after
    }

    /// Worlds after a motion that was found in a possible world.
    fn following(
        &self,
        id: StepId,
        call: &Call,
        def: &PrimitiveDef,
        query: &MotionQuery,
        from: &PossibleWorld,
        answer: &MotionAnswer,
    ) -> Worlds {
        let lost = || Worlds::lost(format_smolstr!("how `{}` ends is not known", def.name));
        let MotionAnswer::Feasible(way) = answer else { return lost() };
        let change = match motion_effect(self.library, def, query) {
            MotionEffect::Changed(change) => change,
            MotionEffect::Nothing => return only(from.clone()),
            MotionEffect::Unknown => return lost(),
        };
        let Some(at) = self.geometry.after(&from.at, query, change, way) else { return lost() };
        let mut next = PossibleWorld { at, ..from.clone() };
        match (change, query) {
            (SceneChange::Gone, MotionQuery::GoTo(target)) => {
                if from.at.key != next.at.key {
                    next.stands_since = Some(id);
                }
                match self.ends_at(call, def) {
                    Some(Ok(place)) if place != *target => return self.going_on(id, &place, next),
                    Some(Err(why)) => return Worlds::lost(why),
                    Some(Ok(_)) | None => {}
                }
            }
            (SceneChange::Taken, _) => next.held_since = Some(id),
            (
                SceneChange::Put | SceneChange::Given,
                MotionQuery::Put(object, _) | MotionQuery::Offer(object, _),
            ) => {
                next.held_since = None;
                next.changed.push((object.clone(), id));
            }
            (SceneChange::Travelled, MotionQuery::Pull(what) | MotionQuery::Push(what)) => {
                if from.at.world.robot != next.at.world.robot {
                    next.stands_since = Some(id);
                }
                next.changed.push((what.clone(), id));
            }
            (SceneChange::Gone | SceneChange::Put | SceneChange::Given | SceneChange::Travelled, _) => {}
        }
        only(next)
    }

    /// Worlds after a motion of the base that continues to the place where the robot serves what it found.
    fn going_on(&self, id: StepId, place: &SmolStr, from: PossibleWorld) -> Worlds {
        let query = MotionQuery::GoTo(place.clone());
        let answer = self.geometry.answer(&from.at, &query);
        let after = match &*answer {
            MotionAnswer::Feasible(way) => self.geometry.after(&from.at, &query, SceneChange::Gone, way),
            MotionAnswer::Infeasible(_) | MotionAnswer::Unknown(_) => None,
        };
        match after {
            Some(at) => only(PossibleWorld { at, stands_since: Some(id), ..from }),
            None => Worlds::lost(format_smolstr!("where the robot serves `{place}` is not known")),
        }
    }
}

fn only(possible: PossibleWorld) -> Worlds {
    Worlds { known: vec![possible], lost: None }
}

fn in_words(why: &UnknownReason) -> SmolStr {
    match why {
        UnknownReason::Budget => SmolStr::new_static("the search was cut short"),
        UnknownReason::Because(why) => why.as_str().into(),
    }
}

/// Possible world at the start.
pub(super) fn at_start(at: Arc<super::worlds::Fingerprinted>) -> PossibleWorld {
    PossibleWorld { at, stands_since: None, held_since: None, changed: Vec::new(), is_certain: true }
}
