//! Ranges of lines that an editor can fold: blocks in brackets, and comments on several lines.

use motet_syntax::text::lexer::{TokenKind, tokens};

use crate::lines::LineIndex;

/// Lines that fold into their first one.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Fold {
    pub(crate) first: u32,
    pub(crate) last: u32,
    pub(crate) is_comment: bool,
}

/// Folds of a text in either syntax, in order. O(bytes).
pub(crate) fn folds(lines: &LineIndex) -> Vec<Fold> {
    let line = |offset: usize| lines.position(offset).line;
    let mut folds = Vec::new();
    let mut open = Vec::new();
    let mut comment: Option<(u32, u32)> = None;
    for token in tokens(lines.text(), 0) {
        let at = line(token.start);
        if matches!(token.kind, TokenKind::Comment | TokenKind::Doc) {
            comment = match comment {
                Some((first, last)) if last + 1 == at => Some((first, at)),
                before => {
                    end_comment(before, &mut folds);
                    Some((at, at))
                }
            };
            continue;
        }
        end_comment(comment.take(), &mut folds);
        match token.text {
            "{" | "[" | "(" => open.push(at),
            "}" | "]" | ")" => {
                // The line of the closing bracket stays in view.
                if let Some(first) = open.pop()
                    && at > first + 1
                {
                    folds.push(Fold { first, last: at - 1, is_comment: false });
                }
            }
            _ => {}
        }
    }
    end_comment(comment, &mut folds);
    folds.sort_unstable();
    folds.dedup_by_key(|fold| fold.first);
    folds
}

fn end_comment(comment: Option<(u32, u32)>, folds: &mut Vec<Fold>) {
    if let Some((first, last)) = comment.filter(|(first, last)| last > first) {
        folds.push(Fold { first, last, is_comment: true });
    }
}

#[cfg(test)]
mod tests {
    use crate::lines::LineIndex;

    fn check(text: &str, expected: &[(u32, u32, bool)]) {
        let folds = super::folds(&LineIndex::new(text));
        let folds: Vec<_> = folds.iter().map(|fold| (fold.first, fold.last, fold.is_comment)).collect();
        assert_eq!(folds, expected);
    }

    #[test]
    fn folds_are_blocks_and_comments() {
        check(
            "// a\n// b\npolicy p {\n  if x {\n    go(a)\n  }\n}",
            &[(0, 1, true), (2, 5, false), (3, 4, false)],
        );
        check("policy p {\n}\n// one", &[]);
        check("{\"steps\": [\n  1,\n  2\n]}", &[(0, 2, false)]);
        check("policy p {\n say(\"{\")\n go(\n", &[]);
        check("} ) ]", &[]);
    }
}
