//! Diagnostics of SRDFs (M0471, M0472, M0477, M0478), beside those of any XML.

use motet_syntax::{Related, Span};

motet_syntax::mistakes! {
    pub const CODES;

    /// XML, but of something else.
    NotSrdf("M0471", Error) { found: String }
    message(m) { format!("the root element is `<{}>`, an SRDF starts with `<robot>`", m.found) }

    /// A link, joint or group that is not there.
    UnknownPart("M0472", Error) { what: &'static str, name: String, near: Option<String> }
    message(m) { format!("there is no {} `{}`", m.what, m.name.escape_debug()) }
    help(m) { m.near.as_ref().map(|near| format!("did you mean `{near}`?")) }

    /// Two groups, or two end effectors, of one name.
    TakenPart("M0477", Error) { what: &'static str, name: String, first: Span }
    message(m) { format!("there are two {}s `{}`", m.what, m.name.escape_debug()) }
    help(m) { Some(format!("give each {} a name of its own", m.what)) }
    related(m) { vec![Related::new("the first is here", m.first)] }

    /// Groups that contain each other.
    GroupCycle("M0478", Error) { chain: Vec<String> }
    message(m) {
        let chain: Vec<String> = m.chain.iter().map(|name| format!("`{}`", name.escape_debug())).collect();
        format!("a group contains itself: {}", chain.join(" contains "))
    }
    help(_m) { Some("let the larger group contain the smaller, and not the other way round".to_owned()) }
}
