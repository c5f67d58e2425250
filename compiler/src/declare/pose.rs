//! Poses that are written out: `pose(1.2 m, 0.5 m, 90 deg)`, with a height `pose(1.2 m, 0.5 m, 0.8 m, 90
//! deg)`. A declaration of a measure with this name replaces them.

use motet_syntax::Span;
use motet_syntax::ast::{Call, Expr, POSE};
use smol_str::SmolStr;

use super::diagnostics::{
    MissingArgument, NotConstant, OutOfRange, POSE_NUMBER, TooManyArguments, UnknownParameter,
};
use super::elaborator::{Elaborator, Expected, ValueRole};
use crate::ir::{Base, Term, Ty};

/// Greatest coordinate in m and angle in rad of a pose, as in a scene.
const GREATEST: f64 = 1000.0;
/// Numbers of a pose in order.
const NAMES: [&str; 4] = ["x", "y", "z", "yaw"];

impl Elaborator<'_> {
    /// Elaborates a pose; `None` for a call with another name.
    pub(super) fn of_pose(&mut self, call: &Call) -> Option<(Term, Ty)> {
        if call.name.text != POSE {
            return None;
        }
        if let Some(name) = call.args.iter().find_map(|arg| arg.name.as_ref()) {
            let (span, callee) = (name.span, SmolStr::new_static(POSE));
            let known = "none, its numbers stand in order".to_owned();
            self.report(UnknownParameter { span, name: name.text.clone(), callee, near: None, known });
            return Some((Term::Unknown, Ty::plain(Base::Pose)));
        }
        let numbers: Vec<&Expr> = call.args.iter().map(|arg| &arg.value).collect();
        Some(self.pose(&numbers, call.span))
    }

    /// Elaborates the numbers of a pose.
    pub(super) fn pose(&mut self, numbers: &[&Expr], span: Span) -> (Term, Ty) {
        let ty = Ty::plain(Base::Pose);
        let callee = SmolStr::new_static(POSE);
        let [x, y, z, yaw] = NAMES;
        let names: &[&'static str] = if numbers.len() == 4 { &[x, y, z, yaw] } else { &[x, y, yaw] };
        if let Some(other) = numbers.get(4) {
            self.report(TooManyArguments { span: other.span, callee, most: 4, twice: None });
            return (Term::Unknown, ty);
        }
        if let Some(missing) = names.get(numbers.len()) {
            let (param, ty_name) =
                (SmolStr::new_static(missing), if *missing == yaw { "Angle" } else { "Length" });
            self.report(MissingArgument { span, callee, param, ty: ty_name.to_owned() });
            return (Term::Unknown, ty);
        }
        let mut values = [0.0; 4];
        for (number, name) in numbers.iter().zip(names) {
            let Some(value) = self.coordinate(number, name) else { return (Term::Unknown, ty) };
            let slot = NAMES.iter().position(|known| known == name).and_then(|at| values.get_mut(at));
            slot.into_iter().for_each(|slot| *slot = value);
        }
        let [x, y, z, yaw] = values;
        (Term::Pose { xyz: [x, y, z], yaw }, ty)
    }

    /// A number of a pose in m or rad; `None` after an error.
    fn coordinate(&mut self, number: &Expr, name: &'static str) -> Option<f64> {
        let (ty, unit) = if name == "yaw" { (Ty::ANGLE, "rad") } else { (Ty::LENGTH, "m") };
        let place = ValueRole::Param(name, POSE);
        match self.term_of(number, Expected { ty, place }) {
            Term::Number(value) if value.abs() <= GREATEST => Some(value),
            Term::Number(value) => {
                self.report(OutOfRange {
                    span: number.span,
                    place: place.to_string(),
                    least: format!("-{GREATEST} {unit}"),
                    greatest: format!("{GREATEST} {unit}"),
                    actual: format!("{value} {unit}"),
                    meant: None,
                });
                None
            }
            Term::Unknown => None,
            _ => {
                self.report(NotConstant { span: number.span, place: POSE_NUMBER });
                None
            }
        }
    }
}
