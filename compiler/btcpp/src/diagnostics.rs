//! Mistakes in behaviour trees, and parts of them that are not imported (M014x).

motet_syntax::mistakes! {
    pub const CODES;

    /// A file that is not a document of BehaviorTree.CPP 4.
    NotTree("M0141", Error) { problem: String }
    message(m) { m.problem.clone() }
    help(_m) {
        let help = "a document is `<root BTCPP_format=\"4\">` with a `<BehaviorTree ID=\"…\">` in it";
        Some(help.to_owned())
    }

    /// A part of a behaviour tree that has no equal in a policy.
    NoEqual("M0142", Error) { what: String, help: Option<String> }
    message(m) { m.what.clone() }
    help(m) { m.help.clone() }

    /// A leaf or a port that the library does not have, or a value that its type does not have.
    WrongLeaf("M0143", Error) { what: String, help: Option<String> }
    message(m) { m.what.clone() }
    help(m) { m.help.clone() }
}
