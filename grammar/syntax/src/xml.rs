//! Guard of the readers of XML, whose parser compares each attribute of an element with all others: a look
//! through the tags before the file is parsed. It is no parser: of a file that is not well-formed it may find
//! nothing.

/// Greatest number of attributes of an element, declarations of namespaces among them.
pub const MAX_ATTRIBUTES: usize = 256;
/// Greatest number of declarations of namespaces on an element and those around it.
pub const MAX_NAMESPACES: usize = 64;

/// Element with more than a reader takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct CrowdedElement {
    /// Byte of its `<`.
    pub at: usize,
    pub what: &'static str,
    pub limit: usize,
}

/// The first element with too many attributes or namespaces. O(bytes).
#[must_use]
pub fn crowded(text: &str) -> Option<CrowdedElement> {
    let (mut at, mut open, mut namespaces) = (0, Vec::new(), 0);
    loop {
        at += text.get(at..)?.find('<')?;
        let rest = text.get(at..)?;
        let aside = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("</", ">")];
        if let Some((begin, end)) = aside.into_iter().find(|(begin, _)| rest.starts_with(begin)) {
            if begin == "</" {
                namespaces -= open.pop().unwrap_or(0);
            }
            at += begin.len() + rest.get(begin.len()..)?.find(end)? + end.len();
            continue;
        }
        let tag = Tag::read(rest)?;
        namespaces += tag.namespaces;
        let crowd = [
            (tag.attributes, "attributes of an element", MAX_ATTRIBUTES),
            (namespaces, "namespaces", MAX_NAMESPACES),
        ];
        if let Some((_, what, limit)) = crowd.into_iter().find(|(count, _, limit)| count > limit) {
            return Some(CrowdedElement { at, what, limit });
        }
        if tag.is_empty {
            namespaces -= tag.namespaces;
        } else {
            open.push(tag.namespaces);
        }
        at += tag.bytes;
    }
}

/// Tag that begins an element.
struct Tag {
    bytes: usize,
    attributes: usize,
    namespaces: usize,
    is_empty: bool,
}

impl Tag {
    fn read(text: &str) -> Option<Self> {
        let (mut attributes, mut namespaces, mut at) = (0, 0, 0);
        loop {
            let rest = text.get(at..)?;
            let next = rest.find(['"', '\'', '>'])?;
            let (before, quote) = (rest.get(..next)?, rest.get(next..next + 1)?);
            if quote == ">" {
                let is_empty = before.ends_with('/');
                return Some(Self { bytes: at + next + 1, attributes, namespaces, is_empty });
            }
            // Before the first attribute stands the name of the element.
            let name = before.split_whitespace().nth(usize::from(attributes == 0)).unwrap_or_default();
            attributes += 1;
            namespaces += usize::from(name.starts_with("xmlns"));
            at += next + 1 + rest.get(next + 1..)?.find(quote)? + 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{MAX_ATTRIBUTES, MAX_NAMESPACES, crowded};

    fn many(name: &str, count: usize) -> String {
        (0..count).map(|number| format!(" {name}{number} = '>\"'")).collect()
    }

    #[test]
    fn crowded_finds_the_element_with_too_many_attributes() {
        let most = many("a", MAX_ATTRIBUTES);
        let more = many("a", MAX_ATTRIBUTES + 1);
        let valid = format!(
            "<?xml version='1.0'?><!-- <x{more}> --><r b=\"<?'\"><?p <x{more}> ?><x{most}/>\
             <![CDATA[<x{more}>]]><y {most}>''\"\"</y></r>"
        );
        assert_eq!(crowded(&valid), None);
        let found = crowded(&valid.replace("</r>", &format!("<z{more}/></r>"))).unwrap();
        assert_eq!((found.at, found.limit), (valid.len() - "</r>".len(), MAX_ATTRIBUTES));
    }

    #[test]
    fn crowded_counts_the_namespaces_of_open_elements() {
        let namespaces = many("xmlns:n", MAX_NAMESPACES / 2);
        let siblings = format!("<r><x{namespaces}/><y{namespaces}></y><z{namespaces}/></r>");
        assert_eq!(crowded(&siblings), None);
        let nested = format!("<r{namespaces}><x{namespaces}><y xmlns='b'/></x></r>");
        assert_eq!(crowded(&nested).map(|found| found.what), Some("namespaces"));
        assert_eq!(crowded("<r <!-- '").or(crowded("")).or(crowded("<")).or(crowded("</r></r>")), None);
    }
}
