//! A list of actions as its items: numbers, bullets and marks at the ends taken away.

/// The items of a list of actions, in order: by lines, commas, semicolons, numbers, and `then`; commas
/// between parentheses
/// do not count. O(bytes).
pub(super) fn items(text: &str) -> Vec<String> {
    let text = without_numbers(text);
    let mut items = vec![String::new()];
    let mut depth = 0_usize;
    for letter in text.chars() {
        match letter {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let ends = matches!(letter, '\n' | ';' | '\u{2192}') || (letter == ',' && depth == 0);
        if ends {
            items.push(String::new());
        } else if let Some(item) = items.last_mut() {
            item.push(letter);
        }
    }
    let split = items.iter().flat_map(|item| item.split(" then ")).map(bare);
    split.filter(|item| !item.is_empty()).collect()
}

/// `1. go to table 2) pick coke`: a number with a mark behind it begins an item.
fn without_numbers(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut is_start = true;
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        if !(is_start && letter.is_ascii_digit()) {
            is_start = letter.is_whitespace() || letter == ',';
            out.push(letter);
            continue;
        }
        let mut number = String::from(letter);
        while let Some(digit) = letters.next_if(char::is_ascii_digit) {
            number.push(digit);
        }
        let mark = letters.next_if(|mark| matches!(mark, '.' | ')' | ':'));
        match mark {
            Some(_) if letters.peek().is_none_or(|next| next.is_whitespace()) => out.push('\n'),
            Some(mark) => {
                out.push_str(&number);
                out.push(mark);
            }
            None => out.push_str(&number),
        }
        is_start = false;
    }
    out
}

/// An item without bullets, quotes, a point at its end, and what joins it to the one before.
fn bare(item: &str) -> String {
    let marks = |letter: char| {
        letter.is_whitespace() || matches!(letter, '-' | '*' | '.' | '"' | '\'' | '`' | '[' | ']')
    };
    let mut bare = item.trim_matches(marks).to_lowercase();
    for lead in ["and then ", "and ", "then ", "finally ", "next "] {
        if let Some(rest) = bare.strip_prefix(lead) {
            bare = rest.trim().to_owned();
        }
    }
    bare
}

#[cfg(test)]
mod tests {
    use super::items;

    #[test]
    fn lists_in_many_layouts_are_the_same_list() {
        let wanted = ["go to table", "pick coke", "place coke on 2nd shelf"];
        for text in [
            "go to table, pick coke, place coke on 2nd shelf",
            "1. Go to table\n2. Pick coke\n3. Place coke on 2nd shelf.",
            "1) go to table 2) pick coke 3) place coke on 2nd shelf",
            "- go to table\n- pick coke\n- and place coke on 2nd shelf",
            "go to table; pick coke; then place coke on 2nd shelf",
            "[\"go to table\", \"pick coke\", \"place coke on 2nd shelf\"]",
        ] {
            assert_eq!(items(text), wanted, "{text}");
        }
        assert_eq!(items("pick(coke), place(coke, table)"), ["pick(coke)", "place(coke, table)"]);
        assert!(items(" ,;\n").is_empty());
    }
}
