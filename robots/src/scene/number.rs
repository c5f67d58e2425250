//! Reader of the numbers of a scene: checks each against the range of its quantity.

use motet_syntax::json::Spanned;
use motet_syntax::{Diagnostic, Span};

use super::errors::{NotPositive, TooFar, ZeroAxis};
use super::quantity::{FURTHEST, SceneQuantity};

/// Checks numbers and collects diagnostics.
#[derive(Debug, Default)]
pub(super) struct NumberReader {
    /// Diagnostics so far.
    pub(super) found: Vec<Diagnostic>,
}

impl NumberReader {
    /// Checks a number; `None` if it is impossible.
    pub(super) fn one(&mut self, number: &Spanned<f64>, quantity: SceneQuantity) -> Option<f64> {
        self.value(number.value, number.span, quantity)
    }

    /// Checks three numbers; reports at most one mistake.
    pub(super) fn three(&mut self, point: &Spanned<[f64; 3]>, quantity: SceneQuantity) -> Option<[f64; 3]> {
        let [x, y, z] = point.value;
        Some([
            self.value(x, point.span, quantity)?,
            self.value(y, point.span, quantity)?,
            self.value(z, point.span, quantity)?,
        ])
    }

    /// Normalises a direction to length 1.
    pub(super) fn axis(&mut self, axis: &Spanned<[f64; 3]>) -> Option<[f64; 3]> {
        let raw = self.three(axis, SceneQuantity::Direction)?;
        // Scaled first, so that the squares lose neither tiny nor huge components.
        let greatest = raw.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        if greatest == 0.0 {
            self.found.push(ZeroAxis { span: axis.span }.into());
            return None;
        }
        let scaled = raw.map(|part| part / greatest);
        let length = scaled.iter().map(|part| part * part).sum::<f64>().sqrt();
        Some(scaled.map(|part| part / length))
    }

    /// The value is finite: JSON has no other numbers, and the reader refuses those too large for a float.
    fn value(&mut self, value: f64, span: Span, quantity: SceneQuantity) -> Option<f64> {
        if quantity.has_to_be_positive() && value <= 0.0 {
            self.found.push(NotPositive { span, quantity, found: value }.into());
        } else if quantity.has_bound() && value.abs() > FURTHEST {
            self.found.push(TooFar { span, quantity, found: value }.into());
        } else {
            return Some(value);
        }
        None
    }
}
