//! "Did you mean": the known name that a misspelt one is closest to.

/// Candidate closest to `name`, where one is close enough to suggest.
///
/// Case, `_`, `-` and spaces do not count, and a candidate that is a whole word of `name` (`pick` in
/// `pick_up`) or with which it begins (`holding` and `hold`), or the other way round, is close. Ties go to
/// the earlier candidate. O(candidates × length²), within [`MAX_WORK`].
///
/// ```
/// use motet_syntax::suggest::closest;
///
/// assert_eq!(closest("pick_up", ["place", "pick"]), Some("pick"));
/// assert_eq!(closest("fly", ["place", "pick"]), None);
/// ```
#[must_use]
pub fn closest<'c>(name: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    if name.len() > MAX_NAME {
        return None;
    }
    let folded = fold(name);
    let mut best: Option<(usize, &'c str)> = None;
    let mut work = 0;
    for candidate in candidates.into_iter().filter(|candidate| candidate.len() <= MAX_NAME) {
        let Some(distance) = distance(name, &folded, candidate, &mut work) else { continue };
        if best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Longest name that has a closest one, in bytes: longer ones are nobody's misspelling.
const MAX_NAME: usize = 200;
/// Most pairs of letters that are compared for one name.
const MAX_WORK: usize = 1_000_000;

/// Distance of a candidate, in hundredths of a misspelling; `None` where it is too far.
fn distance(name: &str, folded: &str, candidate: &str, work: &mut usize) -> Option<usize> {
    let known = fold(candidate);
    if known == folded {
        return Some(0);
    }
    let (letters, others) = (folded.chars().count(), known.chars().count());
    let longer = letters.max(others);
    // One edit in short words, a third of the letters in long ones.
    let most = (longer / 3).max(1);
    if longer >= 2 && letters.abs_diff(others) <= most && *work < MAX_WORK {
        *work += letters * others;
        let edits = strsim::osa_distance(folded, &known);
        if edits <= most && edits < longer {
            return Some(edits * 100);
        }
    }
    let is_part =
        |part: &str, whole: &str| whole.split(['_', '-', ' ']).any(|word| word.eq_ignore_ascii_case(part));
    let begins = |part: &str, whole: &str| part.len() >= 4 && whole.starts_with(part);
    let shares = candidate.len() >= 3 && is_part(candidate, name)
        || name.len() >= 3 && is_part(name, candidate)
        || begins(folded, &known)
        || begins(&known, folded);
    shares.then(|| 250 + longer)
}

fn fold(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, '_' | '-' | ' ')).flat_map(char::to_lowercase).collect()
}

/// Lists names in back-quotes with commas and a final "or": "`a`, `b` or `c`".
#[must_use]
pub fn one_of<'c>(names: impl IntoIterator<Item = &'c str>) -> String {
    let quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    listed(&quoted)
}

/// Lists parts of a sentence with commas and a final "or".
#[must_use]
pub fn listed(parts: &[String]) -> String {
    match parts.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::closest;

    fn check(name: &str, candidates: &[&str], expected: Option<&str>) {
        assert_eq!(closest(name, candidates.iter().copied()), expected, "{name}");
    }

    #[test]
    fn closest_finds_close_names() {
        check("pick_up", &["place", "pick", "push"], Some("pick"));
        check("Pick", &["place", "pick"], Some("pick"));
        check("hand_over", &["hold", "handover"], Some("handover"));
        check("detcet", &["detect", "detect_all"], Some("detect"));
        check("detectall", &["detect", "detect_all"], Some("detect_all"));
        check("mug", &["red_mug", "table"], Some("red_mug"));
        check("hold", &["on", "holding"], Some("holding"));
    }

    #[test]
    fn closest_ignores_far_names() {
        check("fly", &["place", "pick", "go"], None);
        check("x", &["y"], None);
        check("", &["a", "go"], None);
        check("to", &["go", "object"], Some("go"));
    }
}
