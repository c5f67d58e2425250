//! Readers of the elements of a URDF: the shapes of a link, and one joint with kind, axis, limits and mimic
//! rule. [`super::tree`] resolves the names of joints.

use motet_syntax::{Span, suggest};
use roxmltree::Node;

use super::diagnostics::{BadShape, EmptyLimits, HeldJoint, IdleMimic, UnknownJointType, XmlPart, ZeroAxis};
use super::document::{UrdfReader, child, children};
use super::model::{JointKind, JointLimits, Link, LinkShape, Pose, UrdfShape};

/// Name with its span.
pub(super) type SpannedName<'a> = (&'a str, Span);

/// Joint with unresolved names.
pub(super) struct RawJoint<'a> {
    pub(super) name: SpannedName<'a>,
    pub(super) kind: JointKind,
    pub(super) parent: SpannedName<'a>,
    pub(super) child: SpannedName<'a>,
    pub(super) parent_from_joint: Pose,
    pub(super) axis: [f64; 3],
    pub(super) limits: Option<JointLimits>,
    pub(super) velocity: Option<f64>,
    pub(super) mimic: Option<RawMimic<'a>>,
}

/// Mimic rule with an unresolved leader.
pub(super) struct RawMimic<'a> {
    pub(super) leader: SpannedName<'a>,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
}

impl UrdfReader {
    /// Reads a joint; `None` if an essential part is missing.
    pub(super) fn joint<'a>(&mut self, node: Node<'a, '_>, name: SpannedName<'a>) -> Option<RawJoint<'a>> {
        let kind = self.kind(node);
        let parent = self.end(node, "parent");
        let child_link = self.end(node, "child");
        let parent_from_joint = self.origin(node);
        let (kind, parent, child_link) = (kind?, parent?, child_link?);
        let axis = self.axis(node, name.0, kind);
        let (limits, velocity) = self.limits(node, name.0, kind);
        let mimic = child(node, "mimic");
        if let Some(mimic) = mimic.filter(|_| !kind.has_one_position()) {
            let word =
                JointKind::WORDS.iter().find(|(_, known)| *known == kind).map_or("", |(word, _)| *word);
            let span = self.spans.tag(mimic);
            self.found.push(IdleMimic { span, joint: name.0.to_owned(), kind: word }.into());
        }
        let mimic = mimic.filter(|_| kind.has_one_position()).and_then(|mimic| self.mimic(mimic));
        if kind == JointKind::Floating {
            self.found.push(HeldJoint { span: name.1, joint: name.0.to_owned() }.into());
        }
        Some(RawJoint {
            name,
            kind,
            parent,
            child: child_link,
            parent_from_joint,
            axis,
            limits,
            velocity,
            mimic,
        })
    }

    fn kind(&mut self, node: Node<'_, '_>) -> Option<JointKind> {
        let (word, span) = self.spans.required(node, "type", &mut self.found)?;
        let known = JointKind::WORDS.iter().find(|(known, _)| *known == word);
        if known.is_none() {
            let known: Vec<_> = JointKind::WORDS.iter().map(|(known, _)| *known).collect();
            let near = suggest::closest(word, known.iter().copied()).map(str::to_owned);
            self.found.push(UnknownJointType { span, word: word.to_owned(), near, known }.into());
        }
        known.map(|(_, kind)| *kind)
    }

    fn end<'a>(&mut self, node: Node<'a, '_>, part: &'static str) -> Option<SpannedName<'a>> {
        let Some(end) = child(node, part) else {
            self.found.push(self.spans.missing(node, part, XmlPart::Element));
            return None;
        };
        self.spans.required(end, "link", &mut self.found)
    }

    /// Axis with length 1; x if the file gives none, as URDF says.
    fn axis(&mut self, node: Node<'_, '_>, joint: &str, kind: JointKind) -> [f64; 3] {
        const X: [f64; 3] = [1.0, 0.0, 0.0];
        if matches!(kind, JointKind::Fixed | JointKind::Floating) {
            return X;
        }
        let Some(axis) = child(node, "axis") else { return X };
        let xyz = self.triple(axis, "xyz", X);
        let norm = xyz.iter().map(|value| value * value).sum::<f64>().sqrt();
        if norm < 1e-9 {
            let span = self.spans.attribute(axis, "xyz").map_or(self.spans.tag(axis), |(_, span)| span);
            self.found.push(ZeroAxis { span, joint: joint.to_owned() }.into());
            return X;
        }
        xyz.map(|value| value / norm)
    }

    /// Position limits and greatest speed, from `<limit>`. `<safety_controller>` is skipped: its soft limits
    /// belong to a controller, and files leave them at zero.
    fn limits(
        &mut self,
        node: Node<'_, '_>,
        joint: &str,
        kind: JointKind,
    ) -> (Option<JointLimits>, Option<f64>) {
        let needed = matches!(kind, JointKind::Revolute | JointKind::Prismatic);
        let Some(limit) = child(node, "limit") else {
            if needed {
                self.found.push(self.spans.missing(node, "limit", XmlPart::Element));
            }
            return (None, None);
        };
        let velocity =
            self.limit(limit, "velocity").map(|(velocity, _)| velocity).filter(|speed| *speed > 0.0);
        if !needed {
            return (None, velocity);
        }
        // A missing bound counts as 0 in URDF.
        let (lower, upper) = (self.limit(limit, "lower"), self.limit(limit, "upper"));
        let span = lower.or(upper).map_or(self.spans.tag(limit), |(_, span)| span);
        let (lower, upper) = (lower.map_or(0.0, |(value, _)| value), upper.map_or(0.0, |(value, _)| value));
        if lower > upper {
            self.found
                .push(EmptyLimits { span, joint: joint.to_owned(), lower, upper, is_followed: false }.into());
            return (None, velocity);
        }
        (Some(JointLimits { lower, upper }), velocity)
    }

    fn mimic<'a>(&mut self, node: Node<'a, '_>) -> Option<RawMimic<'a>> {
        let leader = self.spans.required(node, "joint", &mut self.found)?;
        let multiplier = self.scalar(node, "multiplier").unwrap_or(1.0);
        let offset = self.scalar(node, "offset").unwrap_or(0.0);
        Some(RawMimic { leader, multiplier, offset })
    }
}

impl UrdfReader {
    /// Reads a link and its shapes; a wrong shape is left out.
    pub(super) fn link(&mut self, node: Node<'_, '_>, name: &str) -> Link {
        let mut solids = |part| children(node, part).filter_map(|part| self.solid(part)).collect();
        Link { name: name.into(), collisions: solids("collision"), visuals: solids("visual") }
    }

    fn solid(&mut self, node: Node<'_, '_>) -> Option<LinkShape> {
        let Some(geometry) = child(node, "geometry") else {
            self.found.push(self.spans.missing(node, "geometry", XmlPart::Element));
            return None;
        };
        let link_from_shape = self.origin(node);
        let Some(shape) = geometry.children().find(Node::is_element) else {
            let span = self.spans.tag(geometry);
            self.found.push(BadShape { span, found: String::new(), near: None }.into());
            return None;
        };
        Some(LinkShape { link_from_shape, shape: self.shape(shape)? })
    }

    fn shape(&mut self, node: Node<'_, '_>) -> Option<UrdfShape> {
        match node.tag_name().name() {
            "box" => self.lengths(node, "size").map(UrdfShape::Box),
            "cylinder" => {
                let (radius, length) = (self.lengths(node, "radius"), self.lengths(node, "length"));
                radius.zip(length).map(|([radius], [length])| UrdfShape::Cylinder { radius, length })
            }
            "capsule" => {
                let (radius, length) = (self.lengths(node, "radius"), self.lengths(node, "length"));
                radius.zip(length).map(|([radius], [length])| UrdfShape::Capsule { radius, length })
            }
            "sphere" => self.lengths(node, "radius").map(|[radius]| UrdfShape::Sphere { radius }),
            "mesh" => {
                let (file, _) = self.spans.required(node, "filename", &mut self.found)?;
                Some(UrdfShape::Mesh { file: file.trim().to_owned(), scale: self.factors(node, "scale") })
            }
            other => {
                let near = suggest::closest(other, UrdfShape::ELEMENTS).map(str::to_owned);
                let span = self.spans.tag(node);
                self.found.push(BadShape { span, found: other.to_owned(), near }.into());
                None
            }
        }
    }
}
