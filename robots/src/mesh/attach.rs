//! Meshes of a URDF: each is replaced by solids that enclose it.

use indexmap::IndexMap;
use motet_syntax::{Diagnostic, FileId, Source, Span};
use roxmltree::Node;

use super::cover::cover;
use super::diagnostics::{BadMesh, UnreadMesh};
use super::read;
use super::triangle::Triangle;
use crate::quaternion::compose;
use crate::urdf::{LinkShape, Urdf, UrdfShape, XmlDialect, XmlDocument};

/// Result of a search for the file of a mesh.
#[derive(Clone, PartialEq, Debug)]
pub enum MeshFile {
    /// Content of the file.
    Bytes(Vec<u8>),
    /// No file at these paths; no paths if the name gives none.
    Missing(Vec<String>),
    /// A file outside of the folders of the card, of the URDF and of the packages.
    Outside,
    /// A folder or a device.
    NotAFile,
    /// A file of more than [`super::MAX_BYTES`] bytes.
    TooLarge,
}

/// Replaces the collision meshes of links by solids (see [`cover`]) and reports unreadable ones, each file
/// once. `source` is the text of the URDF; `find` is called once for each file. An unreadable mesh stays in
/// the URDF. O(bytes of all meshes).
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
        // An unsupported format is no mistake of the robot.
        MeshFile::Bytes(_) if !["stl", "obj", "dae"].contains(&read::extension(name).as_str()) => {
            Err(unread(
                "only STL, OBJ and COLLADA are",
                "convert it, or name a shape that encloses it".to_owned(),
            ))
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

/// Spans at which each mesh is first named.
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

/// Paths at which a mesh may be, best first; the host takes the first that exists.
///
/// `folder` is that of the URDF. `package://NAME/REST` is `REST` in a folder `NAME` of the search path, and
/// `NAME/REST` in any of its folders; `model://` is read likewise, `file://` is a path, and anything else is
/// a path relative to the URDF. A package path with a part `..` has no paths. Pure: no shell, no environment,
/// no file access.
///
/// ```
/// use motet_robots::mesh;
///
/// let search = ["/opt/ros/share".to_owned()];
/// assert_eq!(
///     mesh::locate("package://arm/meshes/link.stl", "robots/arm", &search),
///     ["/opt/ros/share/arm/meshes/link.stl"]
/// );
/// assert_eq!(mesh::locate("link.stl", "robots/arm", &search), ["robots/arm/link.stl"]);
/// ```
#[must_use]
pub fn locate(file: &str, folder: &str, search: &[String]) -> Vec<String> {
    let join = |folder: &str, rest: &str| {
        if folder.is_empty() { rest.to_owned() } else { format!("{}/{rest}", folder.trim_end_matches('/')) }
    };
    if let Some(inside) = file.strip_prefix("package://").or_else(|| file.strip_prefix("model://")) {
        if inside.split('/').any(|part| part == "..") {
            return Vec::new();
        }
        let (package, rest) = inside.split_once('/').unwrap_or((inside, ""));
        let is_package = |folder: &str| folder.trim_end_matches('/').rsplit('/').next() == Some(package);
        let itself = search.iter().filter(|folder| is_package(folder)).map(|folder| join(folder, rest));
        return itself.chain(search.iter().map(|folder| join(folder, inside))).collect();
    }
    match file.strip_prefix("file://") {
        Some(path) => vec![path.to_owned()],
        None if file.starts_with('/') => vec![file.to_owned()],
        None => vec![join(folder, file)],
    }
}
