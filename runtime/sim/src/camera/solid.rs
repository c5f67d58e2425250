//! Upright solids, and where a ray meets them first.

use motet_robots::scene::EntityShape;

use super::lens::minus;

/// A solid that stands upright, turned about the vertical.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Solid {
    /// Its middle in the frame `map`, in m.
    pub(super) centre: [f64; 3],
    /// Its turn about the vertical, in rad.
    pub(super) yaw: f64,
    pub(super) form: Form,
}

/// A shape about its middle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Form {
    /// Half extents along its axes.
    Box([f64; 3]),
    /// About the vertical.
    Cylinder {
        radius: f64,
        half: f64,
    },
    Sphere {
        radius: f64,
    },
}

/// Intersection of a ray with a solid: distance in lengths of the ray, and surface normal in the frame `map`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Hit {
    pub(super) at: f64,
    pub(super) normal: [f64; 3],
}

impl Solid {
    /// The radius of the ball about its middle that holds it.
    pub(super) fn radius(&self) -> f64 {
        match self.form {
            Form::Box([x, y, z]) => x.hypot(y).hypot(z),
            Form::Cylinder { radius, half } => radius.hypot(half),
            Form::Sphere { radius } => radius,
        }
    }

    /// First intersection with a ray from outside, in front of the ray's origin.
    pub(super) fn hit(&self, origin: [f64; 3], ray: [f64; 3]) -> Option<Hit> {
        let (sin, cos) = self.yaw.sin_cos();
        let inward = |[x, y, z]: [f64; 3]| [cos * x + sin * y, cos * y - sin * x, z];
        let (from, along) = (inward(minus(origin, self.centre)), inward(ray));
        let Hit { at, normal: [x, y, z] } = match self.form {
            Form::Box(half) => slabs(half, from, along),
            Form::Cylinder { radius, half } => round(radius, half, from, along),
            Form::Sphere { radius } => ball(radius, from, along),
        }?;
        (at > 1e-6).then_some(Hit { at, normal: [cos * x - sin * y, sin * x + cos * y, z] })
    }
}

impl Form {
    /// A scene's shape, a capsule as the cylinder about it; none where only a file has it.
    pub(super) fn of(shape: &EntityShape) -> Option<Self> {
        Some(match shape {
            EntityShape::Box(extents) => Self::Box(extents.map(|extent| extent / 2.0)),
            EntityShape::Cylinder { radius, height } => {
                Self::Cylinder { radius: *radius, half: height / 2.0 }
            }
            EntityShape::Sphere { radius } => Self::Sphere { radius: *radius },
            EntityShape::Capsule { radius, height } => {
                Self::Cylinder { radius: *radius, half: height / 2.0 + radius }
            }
            EntityShape::Mesh { .. } => return None,
        })
    }
}

/// A box, by the slabs between its faces: Kay and Kajiya, Ray tracing complex scenes, SIGGRAPH 1986.
fn slabs(half: [f64; 3], from: [f64; 3], along: [f64; 3]) -> Option<Hit> {
    let (mut enters, mut leaves, mut normal) = (f64::NEG_INFINITY, f64::INFINITY, [0.0; 3]);
    for (axis, ((half, from), along)) in half.into_iter().zip(from).zip(along).enumerate() {
        if along.abs() < 1e-12 {
            if from.abs() > half {
                return None;
            }
            continue;
        }
        let (one, other) = ((-half - from) / along, (half - from) / along);
        if one.min(other) > enters {
            enters = one.min(other);
            normal = [0.0; 3];
            if let Some(part) = normal.get_mut(axis) {
                *part = -along.signum();
            }
        }
        leaves = leaves.min(one.max(other));
    }
    (enters <= leaves).then_some(Hit { at: enters, normal })
}

/// An upright cylinder: its caps, or its side.
fn round(radius: f64, half: f64, [x, y, z]: [f64; 3], [dx, dy, dz]: [f64; 3]) -> Option<Hit> {
    let cap = (dz.abs() > 1e-12).then(|| (-half * dz.signum() - z) / dz);
    if let Some(at) = cap.filter(|at| (x + at * dx).hypot(y + at * dy) <= radius) {
        return Some(Hit { at, normal: [0.0, 0.0, -dz.signum()] });
    }
    let at = nearer(dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - radius * radius)?;
    let height = z + at * dz;
    let normal = [(x + at * dx) / radius, (y + at * dy) / radius, 0.0];
    (height.abs() <= half).then_some(Hit { at, normal })
}

fn ball(radius: f64, from: [f64; 3], along: [f64; 3]) -> Option<Hit> {
    let dot = super::lens::dot;
    let at = nearer(dot(along, along), dot(from, along), dot(from, from) - radius * radius)?;
    let mut normal = [0.0; 3];
    for ((out, from), along) in normal.iter_mut().zip(from).zip(along) {
        *out = (from + at * along) / radius;
    }
    Some(Hit { at, normal })
}

/// The lesser solution of `a t² + 2 b t + c = 0`.
fn nearer(a: f64, b: f64, c: f64) -> Option<f64> {
    let inner = b * b - a * c;
    (a > 1e-12 && inner >= 0.0).then(|| (-b - inner.sqrt()) / a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn met(form: Form, yaw: f64, origin: [f64; 3], ray: [f64; 3]) -> Option<(f64, [f64; 3])> {
        let solid = Solid { centre: [2.0, 0.0, 1.0], yaw, form };
        let rounded = |part: f64| (part * 1e6).round() / 1e6 + 0.0;
        solid.hit(origin, ray).map(|hit| (rounded(hit.at), hit.normal.map(rounded)))
    }

    #[test]
    fn solid_rays_meet_the_near_side() {
        let ahead = [1.0, 0.0, 0.0];
        let cube = Form::Box([0.5; 3]);
        let can = Form::Cylinder { radius: 0.5, half: 0.5 };
        let (eye, above) = ([0.0, 0.0, 1.0], [2.0, 0.1, 3.0]);
        let down = [0.0, 0.0, -1.0];
        for form in [cube, can, Form::Sphere { radius: 0.5 }] {
            assert_eq!(met(form, 0.0, eye, ahead), Some((1.5, [-1.0, 0.0, 0.0])), "{form:?}");
            assert_eq!(met(form, 0.0, [4.0, 0.0, 1.0], ahead), None, "{form:?}: behind");
            assert_eq!(met(form, 0.0, [0.0, 0.6, 1.0], ahead), None, "{form:?}: beside");
            assert_eq!(met(form, 0.0, [0.0, 0.0, 1.6], ahead), None, "{form:?}: above");
        }
        assert_eq!(met(cube, 0.0, above, down), Some((1.5, [0.0, 0.0, 1.0])));
        assert_eq!(met(can, 0.0, above, down), Some((1.5, [0.0, 0.0, 1.0])));
        let corner = met(cube, std::f64::consts::FRAC_PI_4, eye, ahead);
        assert!(corner.is_some_and(|(at, _)| (at - (2.0 - 0.5_f64.sqrt())).abs() < 1e-5), "{corner:?}");
    }

    #[test]
    fn solid_from_within_nothing_is_met() {
        assert_eq!(met(Form::Sphere { radius: 0.5 }, 0.0, [2.0, 0.0, 1.0], [1.0, 0.0, 0.0]), None);
        assert_eq!(met(Form::Box([0.5; 3]), 0.0, [2.0, 0.0, 1.0], [1.0, 0.0, 0.0]), None);
    }
}
