//! A URDF with its meshes: each is replaced by the pieces that enclose it.

use indexmap::IndexMap;
use motet_syntax::{Diagnostic, FileId, Source, Span};
use roxmltree::Node;

use super::cover::cover;
use super::errors::{BadMesh, UnreadMesh};
use super::read::{self, Triangle};
use crate::quaternion::compose;
use crate::urdf::{LinkShape, Urdf, UrdfShape, XmlDialect, XmlDocument};

/// What was found for the name of a mesh.
#[derive(Clone, PartialEq, Debug)]
pub enum MeshFile {
    /// Its file.
    Bytes(Vec<u8>),
    /// Nothing at these paths; none where the name says of no path.
    Missing(Vec<String>),
    /// A file, but not below the folder of the card, of the URDF or of a package.
    Outside,
    /// A folder, or what has no end, such as a device.
    NotAFile,
    /// A file of more than [`super::MAX_BYTES`].
    TooLarge,
}

/// Replaces the meshes that links collide with by pieces, see [`cover`], and says what is wrong with the others, each file
/// once. `source` is what the URDF was read from; `find` is asked once a file. What cannot be read stays as it is.
/// O(bytes of all meshes).
#[must_use]
pub fn attach(
    source: &Source,
    file: FileId,
    urdf: Urdf,
    mut find: impl FnMut(&str) -> MeshFile,
) -> (Urdf, Vec<Diagnostic>) {
    let mut meshes: IndexMap<String, Option<Vec<Triangle>>> = IndexMap::new();
    let mut found = Vec::new();
    let solids = urdf.links.iter().flat_map(|link| &link.collisions);
    let names: Vec<String> = solids.filter_map(|solid| name(&solid.shape).map(str::to_owned)).collect();
    if names.is_empty() {
        return (urdf, found);
    }
    let spans = spans(source, file);
    for name in names {
        if meshes.contains_key(&name) {
            continue;
        }
        let span = spans.get(&name).copied().unwrap_or(Span::new(file, 0, 0));
        let mesh = match load(span, &name, find(&name)) {
            Ok(mesh) => Some(mesh),
            Err(problem) => {
                found.push(*problem);
                None
            }
        };
        meshes.insert(name, mesh);
    }
    found.sort_by_key(|diagnostic| diagnostic.span);
    let pieces = |solid: LinkShape| match &solid.shape {
        UrdfShape::Mesh { file, scale } => match meshes.get(file) {
            Some(Some(mesh)) => {
                let placed = |piece: LinkShape| LinkShape {
                    link_from_shape: compose(&solid.link_from_shape, &piece.link_from_shape),
                    ..piece
                };
                cover(mesh, *scale).into_iter().map(placed).collect()
            }
            Some(None) | None => vec![solid],
        },
        UrdfShape::Box(_)
        | UrdfShape::Cylinder { .. }
        | UrdfShape::Capsule { .. }
        | UrdfShape::Sphere { .. } => vec![solid],
    };
    let mut urdf = urdf;
    for link in &mut urdf.links {
        link.collisions = std::mem::take(&mut link.collisions).into_iter().flat_map(pieces).collect();
    }
    (urdf, found)
}

fn name(shape: &UrdfShape) -> Option<&str> {
    match shape {
        UrdfShape::Mesh { file, .. } => Some(file),
        UrdfShape::Box(_)
        | UrdfShape::Cylinder { .. }
        | UrdfShape::Capsule { .. }
        | UrdfShape::Sphere { .. } => None,
    }
}

fn load(span: Span, name: &str, found: MeshFile) -> Result<Vec<Triangle>, Box<Diagnostic>> {
    let bad = |problem: String| Box::new(BadMesh { span, file: name.to_owned(), problem }.into());
    let unread = |problem: &str, help: String| {
        Box::new(UnreadMesh { span, file: name.to_owned(), problem: problem.to_owned(), help }.into())
    };
    match found {
        // A format that is not read is no mistake of the robot's.
        MeshFile::Bytes(_) if !["stl", "obj"].contains(&read::extension(name).as_str()) => {
            Err(unread("only STL and OBJ are", "convert it, or name a shape that encloses it".to_owned()))
        }
        MeshFile::Bytes(bytes) => read::read(name, &bytes).map_err(bad),
        MeshFile::Missing(looked) => Err(unread("there is no such file", help(&looked))),
        MeshFile::Outside => Err(bad(
            "it lies neither below the folder of the card or of the URDF nor below one of `packages`"
                .to_owned(),
        )),
        MeshFile::NotAFile => Err(bad("it is a folder or a device, and no file".to_owned())),
        MeshFile::TooLarge => Err(bad(read::too_large())),
    }
}

fn help(looked: &[String]) -> String {
    if looked.is_empty() {
        return "name the folder that holds the package under `packages` in `[model]` of the card".to_owned();
    }
    let looked: Vec<String> = looked.iter().map(|path| format!("`{}`", path.escape_debug())).collect();
    format!(
        "looked for at {}; `packages` in `[model]` of the card names folders with packages",
        looked.join(", ")
    )
}

/// Where each mesh is first named.
fn spans(source: &Source, file: FileId) -> IndexMap<String, Span> {
    let mut spans = IndexMap::new();
    let Ok(document) = XmlDocument::parse(source, file, XmlDialect::Urdf) else { return spans };
    let meshes = document.root().descendants().filter(|node: &Node<'_, '_>| node.tag_name().name() == "mesh");
    let is_hit = |node: &Node<'_, '_>| node.ancestors().any(|above| above.tag_name().name() == "collision");
    for mesh in meshes.filter(is_hit) {
        if let Some((name, span)) = document.spans.attribute(mesh, "filename") {
            spans.entry(name.trim().to_owned()).or_insert(span);
        }
    }
    spans
}
