//! Replies without a policy: a question or a refusal in prose is for the person, and no mistake to repair.

/// Maximum number of characters of such a reply.
const MAX_CHARS: usize = 1_000;

/// The words of a reply that asks something or refuses, without thoughts. `None` for a reply that has a
/// policy, or that says neither.
pub(super) fn for_person(reply: &str) -> Option<String> {
    let words = crate::reply_verdict::without_thoughts(reply).trim();
    let opens = |line: &str| line.trim_start().starts_with("policy ");
    if words.contains(['{', '}']) || words.lines().any(opens) || words.chars().count() > MAX_CHARS {
        return None;
    }
    let asks = words.contains('?') && words.contains(char::is_alphabetic);
    (asks || motet_requests::refuses(words)).then(|| words.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests {
    use super::for_person;

    #[test]
    fn prose_that_asks_or_refuses_is_for_the_person() {
        for (reply, words) in [
            ("Which mug do you mean,\nthe red one?", Some("Which mug do you mean, the red one?")),
            (
                "<think>no?</think> I\u{2019}m sorry, I can\u{2019}t do that.",
                Some("I\u{2019}m sorry, I can\u{2019}t do that."),
            ),
            ("I am unable to lift it.", Some("I am unable to lift it.")),
            ("Sure, I will bring the coke.", None),
            ("???", None),
            ("", None),
            ("<think>Which mug?", None),
            ("Shall I? {\"motet\": 1, \"policy\": \"p\", \"steps\": []}", None),
            ("I cannot. policy p", Some("I cannot. policy p")),
            ("policy p for hsr\ncannot?", None),
        ] {
            assert_eq!(for_person(reply).as_deref(), words, "{reply}");
        }
    }

    #[test]
    fn prose_without_end_is_not_for_the_person() {
        assert_eq!(for_person(&"Is it here? ".repeat(200)), None);
    }
}
