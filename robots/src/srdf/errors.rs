//! What can be wrong with a SRDF (M0471 and M0472), beside what can be wrong with any XML.

motet_syntax::mistakes! {
    pub const CODES;

    /// XML, but of something else.
    NotSrdf("M0471", Error) { found: String }
    message(m) { format!("the root element is `<{}>`, a SRDF starts with `<robot>`", m.found) }

    /// A link, joint or group that is not there.
    UnknownPart("M0472", Error) { what: &'static str, name: String, near: Option<String> }
    message(m) { format!("there is no {} `{}`", m.what, m.name.escape_debug()) }
    help(m) { m.near.as_ref().map(|near| format!("did you mean `{near}`?")) }
}
