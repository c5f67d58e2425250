//! Diagnostics of behaviour trees (M0141 to M0143).

motet_syntax::mistakes! {
    pub const CODES;

    /// A part of a policy that a tree of BehaviorTree.CPP cannot say.
    NotInTree("M0141", Error) { part: String, reason: String }
    message(m) { format!("a behaviour tree cannot say {}: {}", m.part, m.reason) }

    /// XML that is no tree of BehaviorTree.CPP 4.
    WrongTree("M0142", Error) { problem: String }
    message(m) { m.problem.clone() }
    help(_m) {
        let help = "a file of trees is `<root BTCPP_format=\"4\"> <BehaviorTree ID=\"…\"> … </BehaviorTree> </root>`";
        Some(help.to_owned())
    }

    /// A part of a tree that a policy cannot say.
    NotInPolicy("M0143", Error) { part: String, reason: String }
    message(m) { format!("{} cannot be imported: {}", m.part, m.reason) }
}
