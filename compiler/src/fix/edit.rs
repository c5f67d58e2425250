//! Application of edits to a text.

use motet_syntax::{FileId, Fix};

/// Applies all edits of a fix. `None` if an edit is about another file, lies outside the text or within a
/// character, or overlaps another. O(text + edits).
#[must_use]
pub fn apply(text: &str, file: FileId, fix: &Fix) -> Option<String> {
    let mut edits: Vec<_> = fix.edits.iter().collect();
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let mut done = String::with_capacity(text.len());
    let mut at = 0;
    for edit in edits {
        if edit.span.file != file {
            return None;
        }
        let range = edit.span.range();
        // An overlap is a range that ends before it begins, of which there is no text.
        done.push_str(text.get(at..range.start)?);
        text.get(range.clone())?;
        done.push_str(&edit.text);
        at = range.end;
    }
    done.push_str(text.get(at..)?);
    Some(done)
}

#[cfg(test)]
mod tests {
    use motet_syntax::{Edit, FileId, Fix, Span};

    fn check(edits: &[(usize, usize, &str)], expected: Option<&str>) {
        let edit = |(start, end, text): &(usize, usize, &str)| Edit {
            span: Span::new(FileId(0), *start, *end),
            text: (*text).to_owned(),
        };
        let fix = Fix { title: String::new(), edits: edits.iter().map(edit).collect() };
        assert_eq!(super::apply("añb", FileId(0), &fix).as_deref(), expected);
    }

    #[test]
    fn edits_are_made_together_or_not_at_all() {
        check(&[(3, 4, "c"), (0, 0, "x")], Some("xañc"));
        check(&[(0, 3, ""), (3, 3, "y")], Some("yb"));
        check(&[(0, 3, ""), (1, 4, "")], None);
        check(&[(0, 2, "")], None);
        check(&[(0, 9, "")], None);
        assert!(super::apply("ab", FileId(1), &Fix { title: String::new(), edits: Vec::new() }).is_some());
    }
}
