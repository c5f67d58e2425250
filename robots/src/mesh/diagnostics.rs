//! Diagnostics of meshes that cannot be used (M0448, M0449).

motet_syntax::mistakes! {
    pub const CODES;

    /// A mesh of which nothing is known: no file, one in a format that is not read, or that of a scene.
    UnreadMesh("M0448", Warning) { file: String, problem: String, help: String }
    message(m) {
        format!(
            "the mesh `{}` cannot be read, so no motion is computed: {}",
            m.file.escape_debug(),
            m.problem
        )
    }
    help(m) { Some(m.help.clone()) }

    /// A mesh that is broken, too large, or where none may be.
    BadMesh("M0449", Error) { file: String, problem: String }
    message(m) { format!("the mesh `{}` cannot be used: {}", m.file.escape_debug(), m.problem) }
}
