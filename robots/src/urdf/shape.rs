//! The shapes of a link.

use motet_syntax::suggest;
use roxmltree::Node;

use super::document::{XmlPart, child, children};
use super::errors::BadShape;
use super::model::{Link, LinkShape, UrdfShape};
use super::number::UrdfReader;

/// The elements that a `<geometry>` may hold.
pub(super) const WORDS: [&str; 5] = ["box", "cylinder", "sphere", "capsule", "mesh"];

impl UrdfReader {
    /// A link and its shapes; a shape that is wrong is left out.
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
                let near = suggest::closest(other, WORDS).map(str::to_owned);
                let span = self.spans.tag(node);
                self.found.push(BadShape { span, found: other.to_owned(), near }.into());
                None
            }
        }
    }
}
