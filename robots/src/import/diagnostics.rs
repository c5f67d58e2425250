//! Diagnostics of the import of rooms (M0484 to M0488).

use super::solid::MAX_SOLIDS;

motet_syntax::mistakes! {
    pub const CODES;

    /// A line or a value of the YAML of a map that a map server would not accept.
    MapValue("M0484", Error) { problem: String, near: Option<String> }
    message(m) { m.problem.clone() }
    help(m) {
        Some(m.near.as_ref().map_or_else(
            || {
                "a map has `image`, `resolution`, `origin`, `negate`, `occupied_thresh`, `free_thresh` and \
                 perhaps `mode`, each on a line `key: value`"
                    .to_owned()
            },
            |near| format!("did you mean `{near}`?"),
        ))
    }

    /// An image that is no whole PGM or PNG of a sane size.
    MapImage("M0485", Error) { image: String, problem: String }
    message(m) { format!("the image `{}` cannot be read: {}", m.image.escape_debug(), m.problem) }
    help(_m) { Some("the import reads PGM (P2 and P5) and PNG".to_owned()) }

    /// More solids than an imported scene may have.
    TooManySolids("M0486", Error) { count: usize }
    message(m) { format!("the scene would have {} solids, more than the limit of {MAX_SOLIDS}", m.count) }
    help(_m) {
        let help = "merge cells of a map with `--coarsen 2` or more, or leave out distant parts";
        Some(help.to_owned())
    }

    /// A part of a world that a scene cannot hold.
    NotImported("M0487", Warning) { part: String, reason: String }
    message(m) { format!("{} is not imported: {}", m.part, m.reason) }

    /// XML that is no SDF, or a frame that it does not have.
    BadSdf("M0488", Error) { problem: String }
    message(m) { m.problem.clone() }
    help(_m) {
        Some("an SDF starts with `<sdf>`; `relative_to` names a frame of the same world or model".to_owned())
    }
}
