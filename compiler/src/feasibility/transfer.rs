//! Transfer function of a call: the answers of its motion in all possible worlds, and the worlds after it.

use motet_geometry::planning::{
    Configuration, GraspSide, InfeasibleReason, MapPose, MotionAnswer, MotionLimits, MotionQuery,
    MotionWitness, RobotModel, SceneState, SpeedShare, UnknownReason, components,
};
use motet_graph as graph;
use motet_stdlib::lang;
use motet_syntax::{Diagnostic, Severity};
use smol_str::{SmolStr, format_smolstr};

use super::diagnostics::TooSlow;
use super::domain::{MotionChecker, PossibleWorld, Worlds};
use super::geometry::SceneChange;
use super::motion::{
    MotionArg, MotionEffect, failures, makes, motion_effect, motion_query, moves_blindly, side_of,
};
use super::verdict::MotionVerdict;
use crate::analysis::{Domain, Enclosing};
use crate::declare::PrimitiveDef;
use crate::ir::{Call, Entity, MotionKind, ROBOT, START, StepId, Term};
use crate::prove::NeedVerdict;

impl MotionChecker<'_> {
    /// Leads to the worlds after a call that succeeds.
    pub(super) fn call(&mut self, id: StepId, call: &Call) {
        let Some(def) = self.library.primitive(call.primitive) else { return };
        let Some((kind, _)) = &def.motion else {
            if moves_blindly(self.library, def) {
                self.worlds =
                    Worlds::lost(format_smolstr!("the positions of things after `{}` are unknown", def.name));
            }
            return self.throw_all(&def.fails);
        };
        if self.proof.needs.get(id.index()).is_some_and(|needs| needs.contains(&NeedVerdict::Caught)) {
            let why = SmolStr::new_static("a need is false, which a handler catches");
            self.found(id, Some(MotionVerdict::Caught(why)), None);
            self.throw_all(&def.fails);
            return self.stop();
        }
        let before = std::mem::take(&mut self.worlds);
        let before = self.possible(id, before);
        let moves = kind.moves();
        let query = match self.query(call, def) {
            Ok(query) => query,
            Err(why) => {
                self.found(id, Some(MotionVerdict::Deferred(Some(why.clone()))), None);
                self.worlds = if moves { Worlds::lost(why) } else { before };
                return self.throw_all(&def.fails);
            }
        };
        let stopped = || Worlds::lost(format_smolstr!("the pose in which `{}` stopped is unknown", def.name));
        self.throw_in(if moves { stopped() } else { before.clone() }, &def.fails);
        let mut after = Worlds { known: Vec::new(), lost: before.lost.clone() };
        let unplaced = || self.geometry.unplaced();
        let unknown = before.lost.clone().or_else(unplaced);
        let (mut witness, mut unknown, mut refused, mut is_refused) = (None, unknown, None, true);
        let (mut warned, mut slow, mut is_all_caught) = (None, None, before.lost.is_none());
        for mut possible in before.known {
            let (regions, unplaced) = self.kept(id, call, &possible);
            unknown = unknown.or(unplaced);
            possible.at = self.geometry.keeping(&possible.at, regions);
            let answer = self.geometry.answer(&possible.at, &query);
            match &*answer {
                MotionAnswer::Feasible(motion) => {
                    (is_refused, is_all_caught) = (false, false);
                    let next = self.following(id, call, def, &query, &possible, &answer);
                    if witness.is_none() {
                        let machine = self.geometry.machine();
                        let found = graph_witness(machine, &possible.at.world, motion, call.manner);
                        slow = slow.or_else(|| self.too_slow(id, call, def, &found));
                        let end = next.known.first().filter(|_| next.lost.is_none());
                        let leaves = end.map(|end| leaves(machine, &found, motion, &end.at.world.robot));
                        witness = Some((Box::new(found), leaves.map(Box::new)));
                    }
                    after.join(next);
                }
                MotionAnswer::Unknown(why) => {
                    (is_refused, is_all_caught) = (false, false);
                    unknown = unknown.or(Some(in_words(why)));
                    let why = format_smolstr!("the outcome of `{}` is unknown", def.name);
                    after.join(if moves { Worlds::lost(why) } else { Worlds::only(possible) });
                }
                // The search found nothing and proves nothing: the run will see.
                MotionAnswer::Infeasible(why) if !why.certified => {
                    (is_refused, is_all_caught) = (false, false);
                    warned = warned.or_else(|| self.refusal(id, &def.name, &query, why, &possible));
                    unknown = unknown
                        .or_else(|| Some(format_smolstr!("the search found no motion: {}", why.reason)));
                    let why = format_smolstr!("the outcome of `{}` is unknown", def.name);
                    after.join(if moves { Worlds::lost(why) } else { Worlds::only(possible) });
                }
                MotionAnswer::Infeasible(why) => {
                    let told = self.refusal(id, &def.name, &query, why, &possible);
                    if self.is_caught(def, &why.reason) {
                        // The policy says what then happens, so the run follows its handler.
                        warned = warned.or(told.map(caught));
                        is_refused = false;
                        unknown = unknown.or_else(|| {
                            Some(format_smolstr!("it is infeasible, which a handler catches: {}", why.reason))
                        });
                        continue;
                    }
                    is_all_caught = false;
                    // After a failure it is not certain that this world is met at all.
                    match (&refused, possible.is_certain) {
                        (None, certain) => refused = told.map(|told| (told, certain)),
                        (Some((_, false)), true) => refused = told.map(|told| (told, true)),
                        (Some(_), _) => {}
                    }
                    let why = format_smolstr!("`{}` cannot be done", def.name);
                    after.join(if moves { Worlds::lost(why) } else { Worlds::only(possible) });
                }
            }
        }
        let is_error = |certain: bool| certain || (is_refused && before.lost.is_none());
        let verdict = match (unknown, witness, &refused) {
            (None, Some((witness, leaves)), None) => MotionVerdict::Feasible(witness, leaves),
            (Some(why), None, None) if is_all_caught => MotionVerdict::Caught(why),
            (unknown, ..) => MotionVerdict::Deferred(unknown),
        };
        let refused = refused.filter(|(_, certain)| is_error(*certain)).map(|(told, _)| told);
        // The next step has its own rules.
        for possible in &mut after.known {
            possible.at = self.geometry.keeping(&possible.at, Vec::new());
        }
        self.found(id, Some(verdict), refused.or(warned).or(slow));
        self.worlds = after;
    }

    /// Warning if a witness takes longer than its step may.
    fn too_slow(
        &self,
        id: StepId,
        call: &Call,
        def: &PrimitiveDef,
        found: &graph::Witness,
    ) -> Option<Diagnostic> {
        let (takes, within) = (found.path.last()?.at, call.deadline_secs(def.takes));
        let span = self.program.step(id)?.span;
        let mistake = || TooSlow { span, callee: def.name.clone(), takes: takes.ceil(), within };
        (takes > within).then(|| mistake().into())
    }

    /// Returns true if a handler around this step catches the failure that an infeasible motion leads to.
    fn is_caught(&mut self, def: &PrimitiveDef, reason: &InfeasibleReason) -> bool {
        let mut failures = failures(self.library, reason).into_iter().flatten();
        let Some(failure) = failures.find(|failure| def.fails.contains(failure)) else { return false };
        let around = self.enclosing().iter().rev();
        let inside = around.take_while(|around| !matches!(around, Enclosing::Cleanup(_)));
        inside.into_iter().any(|around| around.handles(failure))
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
        let lost = || Worlds::lost(format_smolstr!("the outcome of `{}` is unknown", def.name));
        let MotionAnswer::Feasible(motion) = answer else { return lost() };
        let change = match motion_effect(self.library, def, query) {
            MotionEffect::Changed(change) => change,
            MotionEffect::Nothing => return Worlds::only(from.clone()),
            MotionEffect::Unknown => return lost(),
        };
        let Some(at) = self.geometry.after(&from.at, query, change, motion) else { return lost() };
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
            (SceneChange::Gone, MotionQuery::StandAt(_)) => next.stands_since = Some(id),
            (SceneChange::Taken, _) => next.held_since = Some(id),
            (
                SceneChange::Put | SceneChange::Given,
                MotionQuery::Put(object, ..) | MotionQuery::Offer(object, _),
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
        Worlds::only(next)
    }

    /// Worlds after a motion of the base that continues to the place where the robot serves what it found.
    fn going_on(&self, id: StepId, place: &SmolStr, from: PossibleWorld) -> Worlds {
        let query = MotionQuery::GoTo(place.clone());
        let answer = self.geometry.answer(&from.at, &query);
        let after = match &*answer {
            MotionAnswer::Feasible(motion) => {
                self.geometry.after(&from.at, &query, SceneChange::Gone, motion)
            }
            MotionAnswer::Infeasible(_) | MotionAnswer::Unknown(_) => None,
        };
        match after {
            Some(at) => Worlds::only(PossibleWorld { at, stands_since: Some(id), ..from }),
            None => {
                Worlds::lost(format_smolstr!("the pose from which the robot serves `{place}` is unknown"))
            }
        }
    }

    /// Motion query of a call.
    ///
    /// # Errors
    ///
    /// The reason why its arguments are unknown.
    pub(super) fn query(&self, call: &Call, def: &PrimitiveDef) -> Result<MotionQuery, SmolStr> {
        let Some((name, args)) = &def.motion else { return Err(SmolStr::new_static("it has no motion")) };
        let mut args: Vec<_> = args.iter().map(|arg| self.motion_arg(arg, call)).collect();
        // What makes a thing impossible to grasp anywhere needs no point.
        if *name == MotionKind::ReachAt {
            args.truncate(1 + usize::from(args.get(1).is_some_and(Result::is_ok)));
        }
        let args = args.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(motion_query(*name, &args, self.side(call)))
    }

    /// Value of an argument of a motion at a call.
    fn motion_arg(&self, term: &Term, call: &Call) -> Result<MotionArg, SmolStr> {
        let given = if let Term::Param(index) = term { call.args.get(usize::from(*index)) } else { None };
        Ok(match given.unwrap_or(term) {
            Term::Number(value) => MotionArg::Number(*value),
            Term::Bool(value) => MotionArg::Truth(*value),
            Term::Pose { xyz, yaw } => MotionArg::Pose(MapPose::new(*xyz, *yaw)),
            _ => MotionArg::Name(self.named(term, call)?),
        })
    }

    /// Side of a grasp that an argument of the call asks for.
    fn side(&self, call: &Call) -> Option<GraspSide> {
        let approach = self.library.lang_items.approach?;
        call.args.iter().find_map(|arg| match arg {
            Term::Case(of, case) if *of == approach => side_of(self.library.case_name(approach, *case)),
            _ => None,
        })
    }

    /// Name, in the scene, of an argument of a contract at a call.
    ///
    /// # Errors
    ///
    /// The reason why it is unknown.
    pub(super) fn named(&self, term: &Term, call: &Call) -> Result<SmolStr, SmolStr> {
        let entity = |entity: Entity| match entity {
            ROBOT => Err(SmolStr::new_static("the robot itself is not a target")),
            START => Ok(SmolStr::new_static(lang::entities::START)),
            entity if self.symbols.get(entity).is_some() => {
                let bound = self.symbols.binding_of(entity);
                let name = bound.and_then(|index| self.program.bindings.get(index));
                let name = name.map_or("it", |binding| binding.name.as_str());
                Err(format_smolstr!("only the run determines which thing `{name}` is"))
            }
            entity => Ok(self.environment.name(entity)),
        };
        let unknown = || SmolStr::new_static("an argument is known only at run time");
        match term {
            Term::Entity(id) => entity(*id),
            Term::Case(of, case) => Ok(self.library.case_name(*of, *case).into()),
            Term::Binding(id) => entity(self.symbols.of_binding(id.index()).ok_or_else(unknown)?),
            Term::Param(index) => match call.args.get(usize::from(*index)) {
                Some(Term::Param(_)) | None => Err(unknown()),
                Some(term) => self.named(term, call),
            },
            Term::First(list) => {
                let param = if let Term::Param(index) = **list { Some(index) } else { None };
                let list = param.map_or(Some(&**list), |index| call.args.get(usize::from(index)));
                let Some(Term::List(items)) = list else { return Err(unknown()) };
                self.named(items.first().ok_or_else(unknown)?, call)
            }
            Term::Result => {
                let bound = call.binds.and_then(|id| self.symbols.of_binding(id.index()));
                entity(bound.ok_or_else(unknown)?)
            }
            _ => Err(unknown()),
        }
    }

    /// Place where a call leaves the robot beyond the target of its motion: `search` ends where the robot can
    /// serve what it found.
    pub(super) fn ends_at(&self, call: &Call, def: &PrimitiveDef) -> Option<Result<SmolStr, SmolStr>> {
        let effect = makes(self.library.lang_items.at, def, true)?;
        match effect.fact.args.as_slice() {
            [Some(robot), Some(place)] if *robot == Term::Entity(ROBOT) => Some(self.named(place, call)),
            _ => None,
        }
    }
}

/// The diagnostic of an infeasible motion whose failure a handler catches.
fn caught(mut told: Diagnostic) -> Diagnostic {
    told.severity = Severity::Warning;
    let handled = "the step fails, and the `catch` around it runs";
    told.help = Some(told.help.map_or_else(|| handled.to_owned(), |help| format!("{help}; {handled}")));
    told
}

fn in_words(why: &UnknownReason) -> SmolStr {
    match why {
        UnknownReason::Budget => SmolStr::new_static("the search was cut short"),
        UnknownReason::Because(why) => why.as_str().into(),
    }
}

/// Witness of a motion for the graph, with its times in a manner. Holds only the joints that move.
pub(super) fn graph_witness(
    machine: &RobotModel,
    world: &SceneState,
    witness: &MotionWitness,
    manner: Option<graph::Manner>,
) -> graph::Witness {
    let first = witness.path.first();
    let moves = |at: &usize| {
        let value = |joints: &[f64]| joints.get(*at).copied();
        let begin = first.and_then(|state| value(&state.joints));
        witness.path.iter().any(|state| value(&state.joints) != begin)
    };
    let dofs = machine.tree().dofs();
    let moving: Vec<usize> = (0..dofs.len()).filter(moves).collect();
    let share = manner
        .map_or(SpeedShare::FULL, |graph::Manner { speed, acceleration }| SpeedShare { speed, acceleration });
    let limits = MotionLimits::of(machine);
    let times = limits.times_with_load(&witness.path, share, world.held.is_some().then_some(machine));
    let path = witness.path.iter().zip(times).map(|(state, time)| graph::Waypoint {
        base: state.base,
        joints: moving.iter().map(|at| state.joints.get(*at).copied().unwrap_or(0.0)).collect(),
        at: time.at,
        ramp: time.ramp,
    });
    graph::Witness {
        joints: moving.iter().filter_map(|at| Some(dofs.get(*at)?.name.clone())).collect(),
        path: path.collect(),
        grasp: witness.grasp.as_ref().map(|grasp| {
            let pose = |(xyz, quaternion)| graph::Pose { xyz, quaternion };
            let graph::Pose { xyz, quaternion } = pose(components(&grasp.map_from_tip));
            let object = Some(pose(components(&grasp.tip_from_object)));
            graph::Grasp { xyz, quaternion, width: grasp.width, object }
        }),
        clearance: witness.margins.clearance,
        keeps: graph::Clearance {
            base: witness.margins.required.base_m,
            arm: witness.margins.required.arm_m,
        },
        limit: witness.margins.limit,
        payload: witness.margins.payload,
    }
}

/// Configuration of the robot after a motion, for the graph. Holds the joints that its path moves, and those
/// that are elsewhere than at its start.
pub(super) fn leaves(
    machine: &RobotModel,
    found: &graph::Witness,
    motion: &MotionWitness,
    robot: &Configuration,
) -> graph::Configuration {
    let start = motion.path.first();
    let joints = machine.tree().dofs().iter().zip(0..).filter_map(|(dof, at)| {
        let value = *robot.joints.get(at)?;
        let before = start.and_then(|start| start.joints.get(at)).copied();
        (found.joints.contains(&dof.name) || before != Some(value)).then(|| (dof.name.clone(), value))
    });
    graph::Configuration { base: robot.base, joints: joints.collect() }
}
