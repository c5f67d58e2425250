//! Search paths for the file of a mesh. Pure: no shell, no environment, no file access.

/// The paths at which a mesh may be, best first; the host takes the first that exists.
///
/// `folder` is that of the URDF. `package://NAME/REST` is `REST` in a folder of the search path that is
/// called `NAME`, and `NAME/REST` in any; `model://` is read likewise, `file://` is a path, and anything else
/// is a path beside the URDF. A part `..` in a package path is refused: no paths.
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
