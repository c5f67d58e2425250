//! A thing in a neighbourhood as the smallest box along its own directions.

use nalgebra::Vector3;
use pulp::Simd;

use super::FAR;
use super::aabb::{Aabb, AabbRows};
use super::lanes::{Lanes, Lanes3};
use crate::collision::{Shape, Solid};

/// A box that holds a thing, in m from the origin of a neighbourhood.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Obb {
    /// Index of the entity in the scene.
    pub(crate) entity: usize,
    pub(super) centre: [f32; 3],
    pub(super) axes: [[f32; 3]; 3],
    pub(super) half: [f32; 3],
    /// The box around it along the directions of the map.
    pub(super) bound: Aabb,
    /// Whether the thing is that box, and so small and near that a tenth of a millimetre is more than it is rounded by.
    pub(super) is_exact: bool,
}

/// What stands around.
#[derive(Clone, Debug, Default)]
pub(crate) struct ObbSet {
    pub(super) all: Vec<Obb>,
    pub(super) bounds: AabbRows,
}

impl FromIterator<Obb> for ObbSet {
    fn from_iter<I: IntoIterator<Item = Obb>>(obbs: I) -> Self {
        let all: Vec<Obb> = obbs.into_iter().collect();
        Self { bounds: all.iter().map(|obb| obb.bound).collect(), all }
    }
}

impl Obb {
    /// Positive where a point is farther than `wanted` for certain: by the box along the directions of the map.
    #[inline(always)]
    pub(super) fn aside<S: Simd>(&self, simd: S, point: Lanes3<S>, wanted: Lanes<S>) -> Lanes<S> {
        let (Lanes3([x, y, z]), Lanes3([a, b, c]), Lanes3([d, e, f])) =
            (point, Lanes3::splat(simd, self.bound.low), Lanes3::splat(simd, self.bound.high));
        let x = (a - x).max(x - d).max_zero();
        let y = (b - y).max(y - e).max_zero();
        let z = (c - z).max(z - f).max_zero();
        x * x + y * y + z * z - wanted * wanted
    }

    /// The box of a solid; `None` for what has no end.
    pub(crate) fn new(entity: usize, solid: &Solid, [x, y]: [f64; 2]) -> Option<Self> {
        let half = sides(&solid.shape)?;
        let centre = solid.centre - Vector3::new(x, y, 0.0);
        // What is large or far is rounded more, by as much as that is of 3 m.
        let size = centre.norm() + half.norm();
        let half = half.add_scalar(size / FAR * 1e-6);
        let extent = solid
            .axes
            .iter()
            .zip(half.iter())
            .fold(Vector3::zeros(), |sum: Vector3<f64>, (axis, half)| sum + axis.abs() * *half);
        let (low, high) = (centre - extent, centre + extent);
        Some(Self {
            entity,
            centre: single(&centre),
            axes: [0, 1, 2].map(|at: usize| solid.axes.get(at).map_or([0.0; 3], single)),
            half: single(&half),
            bound: Aabb { low: single(&low.add_scalar(-1e-5)), high: single(&high.add_scalar(1e-5)) },
            is_exact: matches!(solid.shape, Shape::Box(_)) && size < 50.0,
        })
    }
}

/// Half of the sides of the box that holds a shape.
pub(super) fn sides(shape: &Shape) -> Option<Vector3<f64>> {
    Some(match *shape {
        Shape::Box(half) => half,
        Shape::Cylinder { radius, half } => Vector3::new(radius, radius, half),
        Shape::Capsule { radius, half } => Vector3::new(radius, radius, half + radius),
        Shape::HalfSpace => return None,
    })
}

pub(super) fn single(vector: &Vector3<f64>) -> [f32; 3] {
    [vector.x as f32, vector.y as f32, vector.z as f32]
}
