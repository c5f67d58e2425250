//! Rooms in SDF: models of static or movable solids, nested, each with poses relative to its frame.
//!
//! Boxes, cylinders, spheres and capsules of collisions are read. Meshes, planes, includes and joints are
//! reported, not followed.

use motet_stdlib::lang::kinds;
use motet_syntax::{Diagnostic, FileId, Severity, Source, Span};
use roxmltree::Node;
use smol_str::{SmolStr, format_smolstr};

use super::diagnostics::{BadSdf, NotImported, TooManySolids};
use super::solid::{self, MAX_SOLIDS};
use crate::quaternion::{compose, to_rpy};
use crate::scene::{EntityShape, Placement, Scene};
use crate::urdf::{
    BadNumber, ImpossibleNumber, Pose, XmlDialect, XmlDocument, XmlPart, XmlSpans, child, children, from_rpy,
    numbers,
};

/// Greatest coordinate or length in m.
const FURTHEST_M: f64 = 1000.0;
/// Greatest number of frames that a pose may go through.
const MAX_FRAMES: usize = 64;

/// Reads the solids of an SDF world or model as a scene; `None` if there is an error. O(bytes), with an
/// additional factor of the siblings where a pose has `relative_to`.
///
/// A solid of a static model is a `Surface` that does not move. A model that moves and has one solid is an
/// `Object` with its mass.
///
/// ```
/// use motet_robots::import::read_sdf;
/// use motet_syntax::{FileId, Source};
///
/// let text = r#"<sdf version="1.9"><model name="desk"><static>true</static><pose>1 0 0 0 0 0</pose>
///     <link name="top"><collision name="c"><pose>0 0 0.35 0 0 0</pose>
///     <geometry><box><size>0.6 1.2 0.7</size></box></geometry></collision></link></model></sdf>"#;
/// let (scene, diagnostics) = read_sdf(&Source::new("room.sdf", text), FileId(0));
/// assert_eq!(diagnostics, []);
/// assert_eq!(scene.unwrap().entities["desk"].pose.unwrap().xyz, [1.0, 0.0, 0.35]);
/// ```
#[must_use]
pub fn read_sdf(source: &Source, file: FileId) -> (Option<Scene>, Vec<Diagnostic>) {
    let document = match XmlDocument::parse(source, file, XmlDialect::Sdf) {
        Ok(document) => document,
        Err(problem) => return (None, vec![*problem]),
    };
    let root = document.root();
    let mut reader = Reader { spans: document.spans, found: Vec::new(), solids: Vec::new() };
    if root.tag_name().name() == "sdf" {
        let mut scopes: Vec<_> = children(root, "world").collect();
        scopes.push(root);
        for scope in scopes {
            reader.models(scope, &Pose::IDENTITY, "", false);
        }
    } else {
        let problem =
            format!("the root element is `<{}>`, an SDF starts with `<sdf>`", root.tag_name().name());
        reader.found.push(BadSdf { span: reader.spans.tag(root), problem }.into());
    }
    if reader.solids.len() > MAX_SOLIDS {
        let mistake = TooManySolids { span: reader.spans.tag(root), count: reader.solids.len() };
        reader.found.push(mistake.into());
    }
    reader.found.sort_by_key(|said| said.span);
    let is_wrong = reader.found.iter().any(|said| said.severity == Severity::Error);
    let scene = (!is_wrong).then(|| scene(reader.solids));
    (scene, reader.found)
}

/// Solid of a collision, in the frame of the world.
struct Solid {
    /// Names of its model, link and collision.
    names: [String; 3],
    kind: &'static str,
    fixed: bool,
    mass_kg: Option<f64>,
    pose: Pose,
    shape: EntityShape,
}

/// Names each solid by its model, or by as many of model, link and collision as distinguish it.
fn scene(solids: Vec<Solid>) -> Scene {
    let mut scene = Scene::default();
    let count = |parts: usize, of: &Solid| {
        let same = |other: &&Solid| other.names.iter().take(parts).eq(of.names.iter().take(parts));
        solids.iter().filter(same).take(2).count()
    };
    for it in &solids {
        let parts = (1..3).find(|parts| count(*parts, it) == 1).unwrap_or(3);
        let name = plain(&it.names.iter().take(parts).map(String::as_str).collect::<Vec<_>>().join("_"));
        let mut id = name.clone();
        let mut number = 2;
        while id == "robot" || scene.entities.contains_key(&id) {
            id = format_smolstr!("{name}_{number}");
            number += 1;
        }
        let placement = Placement { xyz: it.pose.xyz, rpy: to_rpy(it.pose.quaternion_xyzw) };
        let mut entity = solid::entity(id.clone(), it.kind, placement, it.shape.clone());
        entity.fixed = it.fixed;
        entity.mass_kg = it.mass_kg;
        scene.entities.insert(id, entity);
    }
    scene
}

/// Name as an id that a policy can write without quotes.
fn plain(name: &str) -> SmolStr {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let id: String = name.chars().map(letter).collect();
    if id.starts_with(|c: char| c.is_ascii_alphabetic()) { id.into() } else { format_smolstr!("solid_{id}") }
}

struct Reader {
    spans: XmlSpans,
    found: Vec<Diagnostic>,
    solids: Vec<Solid>,
}

impl Reader {
    fn skipped(&mut self, node: Node<'_, '_>, reason: &str) {
        let name =
            node.attribute("name").map(|name| format!(" `{}`", name.escape_debug())).unwrap_or_default();
        let part = format!("`<{}>`{name}", node.tag_name().name());
        self.found.push(NotImported { span: self.spans.tag(node), part, reason: reason.to_owned() }.into());
    }

    /// Reads the models of a world or of a model. The depth is that of the elements, which is limited.
    fn models(&mut self, scope: Node<'_, '_>, map_from_scope: &Pose, prefix: &str, is_static: bool) {
        for include in children(scope, "include") {
            self.skipped(include, "other files are not followed; expand them first with `gz sdf -p`");
        }
        for model in children(scope, "model") {
            let Some((name, _)) = self.spans.required(model, "name", &mut self.found) else { continue };
            let Some(scope_from_model) = self.pose(scope, model, 0) else { continue };
            let map_from_model = compose(map_from_scope, &scope_from_model);
            let name = if prefix.is_empty() { name.to_owned() } else { format!("{prefix}_{name}") };
            let word = child(model, "static").and_then(|node| node.text()).map(str::trim);
            let is_static = is_static || matches!(word, Some("true" | "1"));
            self.model(model, &map_from_model, &name, is_static);
            self.models(model, &map_from_model, &name, is_static);
        }
    }

    fn model(&mut self, model: Node<'_, '_>, map_from_model: &Pose, name: &str, is_static: bool) {
        let first = self.solids.len();
        for link in children(model, "link") {
            let Some((link_name, _)) = self.spans.required(link, "name", &mut self.found) else { continue };
            let Some(model_from_link) = self.pose(model, link, 0) else { continue };
            let map_from_link = compose(map_from_model, &model_from_link);
            let mass = child(link, "inertial").and_then(|inertial| child(inertial, "mass"));
            let mass = mass.and_then(|mass| self.numbers::<1>(mass, "mass"));
            for collision in children(link, "collision") {
                let Some(link_from_solid) = self.pose(link, collision, 0) else { continue };
                let Some(shape) = self.shape(collision) else { continue };
                let collision_name = collision.attribute("name").unwrap_or("solid");
                self.solids.push(Solid {
                    names: [name.to_owned(), link_name.to_owned(), collision_name.to_owned()],
                    kind: if is_static { kinds::SURFACE } else { kinds::OBJECT },
                    fixed: is_static,
                    mass_kg: mass.map(|[mass]| mass).filter(|mass| !is_static && *mass > 0.0),
                    pose: compose(&map_from_link, &link_from_solid),
                    shape,
                });
            }
        }
        let solids = self.solids.get_mut(first..).unwrap_or_default();
        if !is_static && solids.len() > 1 {
            for solid in solids {
                (solid.kind, solid.fixed, solid.mass_kg) = (kinds::SURFACE, true, None);
            }
            self.skipped(
                model,
                "its solids move together, which a scene cannot say; they stay where they are",
            );
        }
    }

    fn shape(&mut self, collision: Node<'_, '_>) -> Option<EntityShape> {
        let Some(geometry) = child(collision, "geometry") else {
            self.found.push(self.spans.missing(collision, "geometry", XmlPart::Element));
            return None;
        };
        let shape = geometry.children().find(Node::is_element)?;
        let mut length = |part: &'static str| self.part::<1>(shape, part).map(|[length]| length);
        match shape.tag_name().name() {
            "box" => self.part::<3>(shape, "size").map(EntityShape::Box),
            "cylinder" => {
                let (radius, height) = (length("radius"), length("length"));
                radius.zip(height).map(|(radius, height)| EntityShape::Cylinder { radius, height })
            }
            "capsule" => {
                let (radius, height) = (length("radius"), length("length"));
                radius.zip(height).map(|(radius, height)| EntityShape::Capsule { radius, height })
            }
            "sphere" => length("radius").map(|radius| EntityShape::Sphere { radius }),
            "plane" => {
                self.skipped(shape, "the floor of a scene is at z = 0");
                None
            }
            _ => {
                self.skipped(shape, "a scene has boxes, cylinders, spheres and capsules");
                None
            }
        }
    }

    /// Reads required lengths above zero from a child element.
    fn part<const N: usize>(&mut self, node: Node<'_, '_>, part: &'static str) -> Option<[f64; N]> {
        let Some(node) = child(node, part) else {
            self.found.push(self.spans.missing(node, part, XmlPart::Element));
            return None;
        };
        let numbers = self.numbers::<N>(node, part)?;
        if let Some(actual) = numbers.into_iter().find(|number| *number <= 0.0) {
            let span = self.spans.tag(node);
            self.found.push(ImpossibleNumber { span, key: part, actual, wanted: "above zero" }.into());
            return None;
        }
        Some(numbers)
    }

    fn numbers<const N: usize>(&mut self, node: Node<'_, '_>, key: &'static str) -> Option<[f64; N]> {
        let (span, text) = (self.spans.tag(node), node.text().unwrap_or_default());
        let Some(numbers) = numbers::<N>(text) else {
            let wanted = match N {
                1 => "one number",
                3 => "three numbers",
                _ => "six numbers `x y z roll pitch yaw`, or seven with a quaternion",
            };
            let text = text.chars().take(60).collect();
            self.found.push(BadNumber { span, key, text, wanted }.into());
            return None;
        };
        if let Some(actual) = numbers.into_iter().find(|number| number.is_nan() || number.abs() > FURTHEST_M)
        {
            self.found.push(ImpossibleNumber { span, key, actual, wanted: "at most 1000" }.into());
            return None;
        }
        Some(numbers)
    }

    /// Pose of an element in the frame of the world, model or link around it. `None` where it is wrong.
    fn pose(&mut self, scope: Node<'_, '_>, element: Node<'_, '_>, frames: usize) -> Option<Pose> {
        let Some(pose) = child(element, "pose") else {
            return self.base(scope, element, element.attribute("attached_to"), frames);
        };
        let base = self.base(scope, pose, pose.attribute("relative_to"), frames)?;
        if pose.text().unwrap_or_default().trim().is_empty() {
            return Some(base);
        }
        let own = if pose.attribute("rotation_format") == Some("quat_xyzw") {
            let [x, y, z, qx, qy, qz, qw] = self.numbers::<7>(pose, "pose")?;
            let norm = [qx, qy, qz, qw].iter().map(|part| part * part).sum::<f64>().sqrt();
            if norm < 1e-6 {
                let span = self.spans.tag(pose);
                let wanted = "a rotation of length 1";
                self.found.push(ImpossibleNumber { span, key: "pose", actual: norm, wanted }.into());
                return None;
            }
            Pose { xyz: [x, y, z], quaternion_xyzw: [qx, qy, qz, qw].map(|part| part / norm) }
        } else {
            let [x, y, z, rpy @ ..] = self.numbers::<6>(pose, "pose")?;
            let is_degrees = matches!(pose.attribute("degrees"), Some("true" | "1"));
            let rpy = if is_degrees { rpy.map(f64::to_radians) } else { rpy };
            Pose { xyz: [x, y, z], quaternion_xyzw: from_rpy(rpy) }
        };
        Some(compose(&base, &own))
    }

    /// Pose of a named frame in its scope; the frame of the scope itself without a name.
    fn base(
        &mut self,
        scope: Node<'_, '_>,
        at: Node<'_, '_>,
        frame: Option<&str>,
        frames: usize,
    ) -> Option<Pose> {
        let is_world = scope.tag_name().name() != "model";
        let Some(name) = frame.filter(|name| match *name {
            "" => false,
            "world" => !is_world,
            "__model__" => is_world,
            _ => true,
        }) else {
            return Some(Pose::IDENTITY);
        };
        let span: Span = self.spans.tag(at);
        let named = |node: &Node<'_, '_>| {
            let word = node.tag_name().name();
            matches!(word, "model" | "link" | "frame") && node.attribute("name") == Some(name)
        };
        let problem = match scope.children().find(named) {
            Some(_) if frames >= MAX_FRAMES => {
                format!("the frame `{}` depends on itself", name.escape_debug())
            }
            Some(node) => return self.pose(scope, node, frames + 1),
            None => format!("there is no frame `{}` here", name.escape_debug()),
        };
        self.found.push(BadSdf { span, problem }.into());
        None
    }
}
