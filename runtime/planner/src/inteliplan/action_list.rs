//! Lists of actions in words, split into their items.

use motet_robots::scene::Scene;

/// Mark before the number of an entity that stands for its name, where the name has marks in it.
pub(super) const NUMBERED: char = '\u{1}';

/// Items of a list of actions in order: separated by lines, commas, full stops, semicolons, numbers and
/// `then`. Commas in parentheses and in the names of a scene do not count. O(bytes · names).
pub(super) fn items(text: &str, scene: &Scene) -> Vec<String> {
    let text = without_numbers(text);
    let names = scene.entities.values().enumerate().flat_map(|(index, entity)| {
        entity.names.iter().chain([&entity.id]).map(move |name| (name.as_str(), index))
    });
    let marked: Vec<(&str, usize)> = names.filter(|(name, _)| name.contains([',', ';', '.'])).collect();
    let mut items = vec![String::new()];
    let mut depth = 0_usize;
    let mut letters = text.char_indices();
    while let Some((at, letter)) = letters.next() {
        let (before, rest) = text.split_at_checked(at).unwrap_or_default();
        let begins = !before.ends_with(char::is_alphanumeric);
        let starts = |(name, _): &&(&str, usize)| {
            begins && rest.get(..name.len()).is_some_and(|start| start.eq_ignore_ascii_case(name))
        };
        if let Some((name, index)) = marked.iter().filter(starts).max_by_key(|(name, _)| name.len()) {
            if let Some(item) = items.last_mut() {
                item.push_str(&format!("{NUMBERED}{index}"));
            }
            for _ in name.chars().skip(1) {
                let _ = letters.next();
            }
            continue;
        }
        match letter {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let after = rest.chars().nth(1);
        let stops = matches!(letter, '.' | '!') && after.is_none_or(char::is_whitespace);
        let ends = matches!(letter, '\n' | ';' | '\u{2192}') || (depth == 0 && (letter == ',' || stops));
        if ends {
            items.push(String::new());
        } else if let Some(item) = items.last_mut() {
            item.push(letter);
        }
    }
    let split = items.iter().flat_map(|item| item.split(" then ")).map(bare);
    split.filter(|item| !item.is_empty()).collect()
}

/// Splits `1. go to table 2) pick coke`: a number with a mark after it begins an item.
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

/// An item without bullets, quotes, a final point, and the conjunction before it.
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
    use motet_robots::scene::Scene;

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
            assert_eq!(items(text, &Scene::default()), wanted, "{text}");
        }
        let items = |text| items(text, &Scene::default());
        assert_eq!(items("pick(coke), place(coke, table)"), ["pick(coke)", "place(coke, table)"]);
        assert_eq!(
            items("Pick coke. Go to counter. Place coke."),
            ["pick coke", "go to counter", "place coke"]
        );
        assert!(items(" ,;\n").is_empty());
    }
}
