//! Rules of where the robot may not go: their regions in a possible world, the blocks that begin inside one,
//! and the motions for which nothing but a rule leaves no way.

use motet_geometry::planning::{KeptRegion, MotionAnswer, MotionQuery};
use motet_syntax::Related;
use smol_str::{SmolStr, format_smolstr};

use super::diagnostics::BrokenAtStart;
use super::domain::{MotionChecker, PossibleWorld, Worlds};
use crate::ir::{BlockSlot, Call, Condition, Entity, Keep, StepId, StepKind, Term, When};

/// Regions that rules forbid in a possible world, and the reason why the region of one is left to the run.
pub(super) type KeptRegions = (Vec<KeptRegion>, Option<SmolStr>);

impl MotionChecker<'_> {
    /// Regions that the rules around a step forbid in a possible world.
    pub(super) fn kept(&self, id: StepId, call: &Call, at: &PossibleWorld) -> KeptRegions {
        let (mut regions, mut unplaced) = (Vec::new(), None);
        for keep in self.program.kept(id) {
            let (Keep::OutOf(to) | Keep::Distance { to, .. }) = keep;
            let region = self.named(to, call).and_then(|name| {
                let entity = self.geometry.scene().entities.get(&name);
                let region = entity.and_then(|entity| match keep {
                    Keep::OutOf(_) => at.at.world.kept_out_of(entity),
                    Keep::Distance { at_least, .. } => at.at.world.kept_from(entity, at_least?),
                });
                region.ok_or_else(|| format_smolstr!("it is not known where to keep away from `{name}`"))
            });
            match region {
                Ok(region) => regions.push(region),
                Err(why) => unplaced = unplaced.or(Some(why)),
            }
        }
        (regions, unplaced)
    }

    /// Names of the rules without which a motion that is infeasible under them would be feasible: of the one
    /// that alone is in its way, or else of all.
    pub(super) fn only_because_of(&self, possible: &PossibleWorld, query: &MotionQuery) -> Option<String> {
        let regions = &possible.at.world.kept;
        let is_feasible = |kept: Vec<KeptRegion>| {
            let at = self.geometry.keeping(&possible.at, kept);
            matches!(&*self.geometry.answer(&at, query), MotionAnswer::Feasible(_))
        };
        if regions.is_empty() || !is_feasible(Vec::new()) {
            return None;
        }
        let without =
            |region: &KeptRegion| regions.iter().filter(|other| *other != region).cloned().collect();
        let alone = regions.iter().find(|region| regions.len() > 1 && is_feasible(without(region)));
        let names = |regions: &[KeptRegion]| {
            let names = regions.iter().map(|region| format!("`keep {}`", region.rule()));
            names.collect::<Vec<_>>().join(" and ")
        };
        Some(alone.map_or_else(|| names(regions), |region| names(std::slice::from_ref(region))))
    }

    /// Refuses the block of a `keep` that begins where one of its rules is certainly broken. Then the worlds
    /// inside are unknown, so that nothing that only follows is reported.
    pub(super) fn check_entry(&mut self, id: StepId, whens: &[When], body: &[StepId]) {
        let slot = |id: &StepId| self.program.step(*id).map(|step| step.position.slot);
        if !matches!(body.first().and_then(slot), Some(BlockSlot::Kept | BlockSlot::KeptWhole)) {
            return;
        }
        let broken = whens.iter().find_map(|when| {
            let mut worlds = self.worlds.known.iter().filter(|possible| possible.is_certain);
            worlds.find_map(|possible| self.broken(id, when, possible))
        });
        if let Some(broken) = broken {
            self.found(id, None, Some(broken.into()));
            self.worlds = Worlds::lost(SmolStr::new_static("the block begins where its rule forbids"));
        }
    }

    /// The mistake of a block that begins in a world where a rule is broken.
    fn broken(&self, id: StepId, when: &When, possible: &PossibleWorld) -> Option<BrokenAtStart> {
        let keep = Keep::new(&when.condition)?;
        let (Keep::OutOf(to) | Keep::Distance { to, .. }) = keep;
        let Term::Entity(entity) = to else { return None };
        let name = self.environment.name(*entity);
        let known = self.geometry.scene().entities.get(&name)?;
        let world = &possible.at.world;
        let (region, at_least) = match keep {
            Keep::OutOf(_) => (world.kept_out_of(known)?, None),
            Keep::Distance { at_least, .. } => (world.kept_from(known, 0.0)?, Some(at_least?)),
        };
        let distance = self.geometry.distance(world, &region);
        // Half a millimetre is for the tolerance of the distance.
        let is_broken = at_least.map_or(distance <= 0.0, |at_least| distance + 5e-4 < at_least);
        if !is_broken || self.is_tested(id, *entity) {
            return None;
        }
        let since = possible.stands_since;
        let rule = match at_least {
            None => format!("out of {name}"),
            Some(at_least) => format!("distance({name}) >= {at_least} m"),
        };
        let place = at_least.map_or_else(
            || format!("is in `{name}`"),
            |_| format!("is {:.2} m from `{name}`", distance.max(0.0)),
        );
        Some(BrokenAtStart {
            span: when.span,
            rule,
            place,
            came: since.map(|step| self.call_name(step)),
            related: since
                .and_then(|step| Some(Related::new("the robot came here", self.program.step(step)?.span))),
        })
    }

    /// Returns true if a step before another one tests the distance to a thing that moves by itself: a person
    /// may have gone away by then.
    fn is_tested(&self, id: StepId, entity: Entity) -> bool {
        let person = self.library.lang_items.person;
        let walks = person.is_some_and(|person| {
            self.symbols.kind(self.environment, entity).is_some_and(|kind| self.library.is_kind(kind, person))
        });
        let mut steps = self.program.steps.iter().take(id.index());
        walks
            && steps.any(|step| {
                let waits = matches!(step.kind, StepKind::Delay { .. });
                waits || step.kind.conditions().any(|condition| asks_distance(condition, entity))
            })
    }
}

/// Returns true if a condition compares a measure of an entity.
fn asks_distance(condition: &Condition, entity: Entity) -> bool {
    let measures =
        |term: &Term| matches!(term, Term::Measure(_, args) if args.contains(&Term::Entity(entity)));
    match condition {
        Condition::Compare(_, left, right) => measures(left) || measures(right),
        Condition::Not(inner) => asks_distance(inner, entity),
        Condition::All(parts) | Condition::AnyOf(parts) => {
            parts.iter().any(|part| asks_distance(part, entity))
        }
        Condition::Fact(_)
        | Condition::Literal(_)
        | Condition::MonitoredMeasure(_)
        | Condition::MonitoredFluent(_)
        | Condition::Unknown => false,
    }
}
