//! Motion of the base and of people: along straight lines at constant speed.

use crate::body::{BasePose, UprightBody, turned};
use motet_robots::card::{BaseSpec, Drive};
use motet_runtime::Time;

/// A motion of the base: legs one after the other, each along a straight line at constant speed.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct BaseMotion {
    /// At least one.
    legs: Vec<BaseLeg>,
    start: Time,
}

/// A leg of a motion. The headings tell how often the base turns round.
#[derive(Clone, Copy, PartialEq, Debug)]
struct BaseLeg {
    from: BasePose,
    to: BasePose,
    span: Time,
}

impl BaseLeg {
    /// A drive, which takes the shorter way round; none where the base is bolted down and would have to move.
    fn drive(base: &BaseSpec, from: BasePose, to: BasePose) -> Option<Self> {
        let turn = turned(to.heading - from.heading);
        let to = BasePose { heading: from.heading + turn, ..to };
        let (distance, angle) = (from.distance_to(to.x, to.y), turn.abs());
        let driving = distance / base.speed_m_per_s.max(1e-3);
        let turning = angle / base.turn_rad_per_s.max(1e-3);
        let secs = match base.drive {
            Drive::Fixed if distance > 1e-6 || angle > 1e-6 => return None,
            Drive::Fixed => 0.0,
            Drive::Omnidirectional | Drive::Legged => driving.max(turning),
            // It turns to its way, drives, and turns to its goal: at least as long as the two turns in one.
            Drive::Differential => driving + turning,
        };
        Some(Self { from, to, span: Time::from_secs(secs) })
    }

    /// Position of the base that long after the start of the leg.
    fn after(&self, time: Time) -> BasePose {
        if time >= self.span {
            return self.to;
        }
        let done = time.secs() / self.span.secs();
        BasePose {
            x: self.from.x + done * (self.to.x - self.from.x),
            y: self.from.y + done * (self.to.y - self.from.y),
            heading: self.from.heading + done * (self.to.heading - self.from.heading),
        }
    }
}

impl BaseMotion {
    /// A motion through stances one after the other; none where the base cannot move or there is no stance.
    pub(crate) fn through(
        base: &BaseSpec,
        from: BasePose,
        stances: &[BasePose],
        start: Time,
    ) -> Option<Self> {
        let mut at = from;
        let legs = stances.iter().map(|to| {
            let leg = BaseLeg::drive(base, at, *to)?;
            at = leg.to;
            Some(leg)
        });
        let legs = legs.collect::<Option<Vec<_>>>()?;
        (!legs.is_empty()).then_some(Self { legs, start })
    }

    /// A turn on the spot by any angle.
    pub(crate) fn turn(base: &BaseSpec, from: BasePose, by: f64, start: Time) -> Self {
        let to = BasePose { heading: from.heading + by, ..from };
        let span = Time::from_secs(by.abs() / base.turn_rad_per_s.max(1e-3));
        Self { legs: vec![BaseLeg { from, to, span }], start }
    }

    /// Time at which it is over.
    pub(crate) fn end(&self) -> Time {
        self.legs.iter().fold(self.start, |end, leg| end.after(leg.span))
    }

    /// True if the base stays where it is.
    pub(crate) fn is_still(&self) -> bool {
        self.legs.iter().all(|leg| leg.from.distance_to(leg.to.x, leg.to.y) < 1e-6)
    }

    /// The motion with spans that many times as long.
    pub(crate) fn slowed(mut self, factor: f64) -> Self {
        for leg in &mut self.legs {
            leg.span = Time::from_secs(leg.span.secs() * factor);
        }
        self
    }

    /// Position where the base is at a time.
    pub(crate) fn at(&self, now: Time) -> BasePose {
        let Some((leg, since, _)) = self.leg_at(now) else { return BasePose::default() };
        let stance = leg.after(since);
        BasePose { heading: turned(stance.heading), ..stance }
    }

    /// The leg at a time, the time since its start, and the legs behind it; the last leg after the end.
    fn leg_at(&self, now: Time) -> Option<(&BaseLeg, Time, &[BaseLeg])> {
        let mut since = now.since(self.start);
        let mut legs = self.legs.as_slice();
        while let [leg, rest @ ..] = legs {
            if since < leg.span || rest.is_empty() {
                return Some((leg, since, rest));
            }
            since = since.since(leg.span);
            legs = rest;
        }
        None
    }

    /// The same motion from another time on.
    pub(crate) fn begun(self, start: Time) -> Self {
        Self { start, ..self }
    }

    /// Remainder of the motion, beginning at `start`.
    pub(crate) fn rest(&self, now: Time, start: Time) -> Self {
        let Some((leg, since, rest)) = self.leg_at(now) else { return self.clone() };
        let first = BaseLeg { from: leg.after(since), to: leg.to, span: leg.span.since(since) };
        Self { legs: std::iter::once(first).chain(rest.iter().copied()).collect(), start }
    }
}

/// A walk of a person.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct PersonWalk {
    from: [f64; 2],
    to: [f64; 2],
    start: Time,
    speed: f64,
}

impl PersonWalk {
    pub(crate) const fn new(from: [f64; 2], to: [f64; 2], start: Time, speed: f64) -> Self {
        Self { from, to, start, speed }
    }

    fn length(&self) -> f64 {
        (self.to[0] - self.from[0]).hypot(self.to[1] - self.from[1])
    }

    pub(crate) fn end(&self) -> Time {
        self.start.after(Time::from_secs(self.length() / self.speed.max(1e-3)))
    }

    /// Position where the person is at a time.
    pub(crate) fn at(&self, now: Time) -> [f64; 2] {
        let (length, gone) = (self.length(), now.since(self.start).secs() * self.speed.max(1e-3));
        let done = if now >= self.end() || length < 1e-9 { 1.0 } else { gone / length };
        [self.from[0] + done * (self.to[0] - self.from[0]), self.from[1] + done * (self.to[1] - self.from[1])]
    }
}

/// Of stances about a thing, the best: one that is free of `others`, then one before the middle of
/// its `front` if it has one, then one that serves most of `wanted` within `reach`, then the nearest.
pub(crate) fn standing_place(
    (target, front): (&UprightBody, Option<[f64; 2]>),
    clearance: f64,
    reach: f64,
    from: BasePose,
    wanted: &[[f64; 2]],
    others: &[UprightBody],
    radius: f64,
) -> Option<BasePose> {
    let cost = |stance: &BasePose| {
        let hits = others.iter().filter(|other| other.gap(stance.x, stance.y) < radius).count();
        let missed = wanted.iter().filter(|[x, y]| stance.distance_to(*x, *y) > reach).count();
        // The middle of the front is where neither the door nor a wall hides what is in it.
        let aside = front.map_or(0.0, |[x, y]| {
            let faces = x * stance.heading.cos() + y * stance.heading.sin() < -0.7;
            let off = (stance.y - target.y()) * x - (stance.x - target.x()) * y;
            if faces { 10.0 * off.abs() } else { 1e5 }
        });
        hits as f64 * 1e6 + aside + missed as f64 * 1e3 + stance.distance_to(from.x, from.y)
    };
    let stances = target.stances(clearance).into_iter();
    stances.map(|stance| (cost(&stance), stance)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, stance)| stance)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASE: BaseSpec = BaseSpec {
        drive: Drive::Omnidirectional,
        speed_m_per_s: 0.5,
        turn_rad_per_s: 1.0,
        acceleration_m_per_s2: 0.5,
        turn_acceleration_rad_per_s2: 1.0,
        radius_m: 0.2,
    };

    #[test]
    fn motion_base_keeps_its_speed() {
        let to = BasePose { x: 2.0, y: 0.0, heading: 1.0 };
        let motion = BaseMotion::through(&BASE, BasePose::default(), &[to], Time::from_secs(1.0)).unwrap();
        assert_eq!(motion.end(), Time::from_secs(5.0));
        assert_eq!(motion.at(Time::from_secs(3.0)), BasePose { x: 1.0, y: 0.0, heading: 0.5 });
        assert_eq!(motion.rest(Time::from_secs(3.0), Time::from_secs(9.0)).end(), Time::from_secs(11.0));
        let fixed = BaseSpec { drive: Drive::Fixed, ..BASE };
        assert_eq!(BaseMotion::through(&fixed, BasePose::default(), &[to], Time::ZERO), None);
    }

    #[test]
    fn motion_base_goes_through_its_stances() {
        let corner = BasePose { x: 1.0, y: 0.0, heading: 0.0 };
        let to = BasePose { x: 1.0, y: 1.0, heading: 0.0 };
        let motion = BaseMotion::through(&BASE, BasePose::default(), &[corner, to], Time::ZERO).unwrap();
        assert_eq!(motion.end(), Time::from_secs(4.0));
        assert_eq!(motion.at(Time::from_secs(2.0)), corner);
        let rest = motion.rest(Time::from_secs(1.0), Time::from_secs(10.0));
        assert_eq!(rest.at(Time::from_secs(12.0)), BasePose { x: 1.0, y: 0.5, heading: 0.0 });
        assert_eq!((rest.end(), rest.at(Time::from_secs(99.0))), (Time::from_secs(13.0), to));
    }

    #[test]
    fn motion_turn_may_go_all_round() {
        let turn = BaseMotion::turn(&BASE, BasePose::default(), std::f64::consts::TAU, Time::ZERO);
        assert!((turn.end().secs() - std::f64::consts::TAU).abs() < 1e-6);
        assert!((turn.at(Time::from_secs(2.0)).heading - 2.0).abs() < 1e-6);
    }

    #[test]
    fn motion_person_walks_and_stops() {
        let walk = PersonWalk::new([0.0, 0.0], [3.0, 4.0], Time::from_secs(2.0), 1.0);
        assert_eq!(walk.at(Time::ZERO), [0.0, 0.0]);
        assert_eq!(walk.at(Time::from_secs(4.5)), [1.5, 2.0]);
        assert_eq!(walk.at(Time::from_secs(60.0)), [3.0, 4.0]);
    }
}
