//! Documents of the model surface's JSON form that are nearly right: each differs from a canonical line in
//! one place.

/// Lines made wrong, each with what is wrong. The line must call `go` with an entity, and end in `]}`.
#[must_use]
pub fn near_misses(line: &str) -> Vec<(&'static str, String)> {
    let change = |what, from: &str, to: &str| {
        let changed = line.replacen(from, to, 1);
        (changed != line).then_some((what, changed))
    };
    let found = [
        change("a version that is none", r#"{"motet":1,"#, r#"{"motet":2,"#),
        change("another robot", r#""robot":""#, r#""robot":"not_"#),
        change("a primitive that is none", r#"{"do":"go""#, r#"{"do":"fly""#),
        change("a parameter that is none", r#"{"do":"go","to""#, r#"{"do":"go","of""#),
        change("an entity that is none", r#"{"do":"go","to":""#, r#"{"do":"go","to":"no_"#),
        change("a number for an entity", r#"{"do":"go","to":""#, r#"{"do":"go","to":1,"_":""#),
        change("keys in another order", r#""policy":"#, r#""steps":[],"policy":"#),
        change("a key that is missing", r#","achieves":"#, r#","goal":"#),
        change("a step without its first key", r#""steps":[{"#, r#""steps":[{},{"#),
        change("an ending that is none", r#"]}"#, r#",{"end":"stop"}]}"#),
        Some(("something behind the end", format!("{line},"))),
        Some(("no end", line.get(..line.len() - 1).unwrap_or("").to_owned())),
    ];
    found.into_iter().flatten().collect()
}
