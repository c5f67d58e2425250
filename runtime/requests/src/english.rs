//! The lists of English, by the names that they have in the files of the folder `english/`.

use super::phrases::Phrases;

/// The files, by name.
pub(crate) const FILES: &[(&str, &str)] = &[
    ("answers", include_str!("../english/answers.phrases")),
    ("asking", include_str!("../english/asking.phrases")),
    ("commands", include_str!("../english/commands.phrases")),
    ("courtesy", include_str!("../english/courtesy.phrases")),
    ("frames", include_str!("../english/frames.phrases")),
    ("knowledge", include_str!("../english/knowledge.phrases")),
    ("nouns", include_str!("../english/nouns.phrases")),
    ("places", include_str!("../english/places.phrases")),
    ("remarks", include_str!("../english/remarks.phrases")),
    ("rewrites", include_str!("../english/rewrites.phrases")),
    ("tokens", include_str!("../english/tokens.phrases")),
    ("verbs", include_str!("../english/verbs.phrases")),
    ("wishes", include_str!("../english/wishes.phrases")),
];

macro_rules! lists {
    ($($name:ident)*) => {
        $(pub(crate) static $name: Phrases = Phrases::new(stringify!($name));)*
        /// The names of all lists that the reader uses.
        #[cfg(test)]
        pub(crate) const USED: &[&str] = &[$(stringify!($name)),*];
    };
}

lists! {
    ADVICE AGAIN AGREES AGREES_AS_CLAUSE AGREES_PLAINLY ALL_OF_THEM ANY_OF_THEM APART_VERBS ARE_YOU_ABLE
    ASKED_PERSON ASKS_IF ASKS_SOMEBODY BEFORE_CURT BEFORE_REPORT BEHIND_REPORT BESIDE_LASTS
    BESIDE_REASON BESIDE_THE_POINT BESIDE_WHO CANDIDATES_OPEN CAUTION_DO_NOT_YOU_DARE
    CAUTION_PUTTING_IT_DOWN CONTRACTIONS CONTRASTS CURT_WISHES DENIAL_WORDS DOUBTS FAVOUR FINDS
    FORBIDDEN_NOT FORBIDDEN_UNTIL GIVES_UP GOES_ON_AT_HITHER GOES_ON_DO_NOT HAD HAS_TIME HEDGE HOLDS_CAN
    IF_SO IS_BOUNDARY_AND IS_DETERMINED_THE IS_HABIT_ALWAYS IS_NO_THING_DONE IS_NO_THING_HELP
    IS_NO_THING_RID IS_NO_THING_YOUR IS_OPEN_IF IS_QUESTION_LEFT IS_QUESTION_WHOSE IS_RHETORICAL_ASKS
    IS_RHETORICAL_WHO IS_RHETORICAL_WOULD IS_SOMEWHERE IS_SOMEWHERE_HOW IS_TAG_ASKS IS_TELLING_IS
    KEEPS_SO KEPT_HOLD KEPT_OPEN KEPT_SHUT KEPT_THERE KIN LEADS LETTING_GO LOOK_THERE MAY MAY_BE
    MAY_HAVE MINDING MISHAPS MODALS MODALS_BEHIND MODALS_OF_DUTY MODAL_CAN NARROWED_IS NARROWED_LIKED
    NEED_NOT NEGATES_NO NEXT_PLACE NOUN_ENDS NOUN_OLD NOUN_PLACE NO_LEADS NO_REPORTER NUMBERED_THE ONTO
    OPEN_QUESTIONS ORDINARY_WORDS OUT_OF_SIGHT OVERTURES PACKAGES PARTICIPLES PART_FOLLOWS_OVER
    PART_FOR_ME PART_FROM_OFF PART_GO PART_ON_TOP PART_RUBBISH PART_TO_WHERE_IT_BELONGS PART_UP PART_WAS
    PART_WITH_ME PASTS PHRASE_SOMETHING PLAIN_AND PLAIN_WORDS PLURALS PREDICATES PREPOSITIONS_OF_PLACE
    PREPOSITIONS_OF_WAY PROHIBITIONS PRONOUNS PURPOSE_DOES_2 PURPOSE_IN_ORDER_TO PURPOSE_TOMORROW
    PUTS_PAST PUT_SOMEWHERE QUOTES_ME QUOTING_VERBS REASONS REPORTED_SAYS REPORTER REPORTER_ARTICLE
    REPORTER_HAS REPORT_DENIALS REPORT_WORDS RETRY_WORDS SAID_LIVES SAID_SEEN SAID_THERE SAME SHALL_WE
    SIDE_THE SKIP_SOFT_SOFT SOFTENERS SOUNDS SPEAKER SPOKEN_I_MEAN SPOTS_GOES_ON STAYS_PUT_AWAITS
    STAYS_PUT_LEFT STAYS_PUT_STAY STAYS_PUT_THERE STAYS_PUT_WHAT_FOR STOPS_THERE SUBJECTS SURELY
    TAKE_HOLD TELLING_VERBS THANKS THINGS TOLD_SUBJECTS TOLD_THERE TOPICS TRIES_AGAIN USES VAGUE_VERBS
    VERB WANTED_LATER WHERE_IT_BELONGS WHETHER WISH WISH_HAVE
}

/// The names of the lists of rules that the reader begins with.
#[cfg(test)]
pub(crate) const RULES: &[&str] = &[
    "addressed",
    "asks_for_it",
    "clauses",
    "courtesy",
    "dropped",
    "elliptic",
    "favours",
    "in_another_form",
    "leads",
    "met",
    "possessed",
    "proves_it",
    "sentences",
    "speaker",
    "task",
    "unwrapped",
    "verb",
    "wants_state",
    "whereto",
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{FILES, RULES, USED};
    use crate::phrases::{self, List, Phrases};
    use crate::rule::Rules;
    use crate::template::{self, Lists, Part};
    use crate::token::{self, Token};

    fn lists() -> Lists {
        let mut lists = Lists::new();
        for (file, text) in FILES {
            if let Err(error) = template::read(text, &mut lists) {
                panic!("{file}: {error}");
            }
        }
        lists
    }

    fn references(part: &Part, found: &mut BTreeSet<&'static str>) {
        match part {
            Part::Word(_) => {}
            Part::List(name) => {
                found.insert(name);
            }
            Part::Sequence(parts) | Part::Choice(parts) => {
                parts.iter().for_each(|part| references(part, found));
            }
            Part::Repeat(part) | Part::Slot(_, part) | Part::Look(_, _, part) => references(part, found),
            Part::Read(_, argument) => found.extend(argument.filter(|name| phrases::list(name).is_some())),
        }
    }

    /// The first phrase of a part: first alternatives, each optional and repeated part once.
    fn phrase(part: &Part, lists: &Lists) -> String {
        match part {
            Part::Word(word) => (*word).to_owned(),
            Part::List(name) => phrase(&lists[name][0].part, lists),
            Part::Sequence(parts) => {
                let said: Vec<_> = parts.iter().map(|part| phrase(part, lists)).collect();
                said.into_iter().filter(|said| !said.is_empty()).collect::<Vec<_>>().join(" ")
            }
            Part::Choice(parts) => parts.first().map(|part| phrase(part, lists)).unwrap_or_default(),
            Part::Repeat(part) => phrase(part, lists),
            Part::Slot(..) | Part::Read(..) | Part::Look(..) => String::new(),
        }
    }

    #[test]
    fn english_lists_are_defined_and_reached() {
        let lists = lists();
        let used = USED.iter().map(|name| &*name.to_ascii_lowercase().leak());
        let mut reached: BTreeSet<&str> = used.chain(RULES.iter().copied()).collect();
        lists.values().flatten().for_each(|template| references(&template.part, &mut reached));
        let defined: BTreeSet<&str> = lists.keys().copied().collect();
        assert_eq!(reached.difference(&defined).collect::<Vec<_>>(), Vec::<&&str>::new(), "not defined");
        assert_eq!(defined.difference(&reached).collect::<Vec<_>>(), Vec::<&&str>::new(), "not reached");
    }

    #[test]
    fn english_templates_are_read_once() {
        let lists = lists();
        for (name, templates) in &lists {
            let Some(List::Phrases(phrases)) = phrases::list(name) else { continue };
            for (index, template) in templates.iter().enumerate() {
                let said = phrase(&template.part, &lists);
                assert!(phrases.has(&said), "{name}: `{said}` is not read");
                let is_again = templates[..index].iter().any(|other| other.part == template.part);
                assert!(!is_again, "{name}: `{said}` stands twice");
            }
        }
    }

    #[test]
    fn english_examples_are_read() {
        let examples: Vec<_> = FILES.iter().flat_map(|(_, text)| template::examples(text)).collect();
        for (list, example, becomes) in &examples {
            match becomes {
                None => assert!(Phrases::new(list).has(example), "{list}: `{example}`"),
                Some(becomes) => {
                    let found = rewritten(list, example);
                    assert!(found.contains(becomes), "{list}: `{example}` becomes `{found}`");
                }
            }
        }
        // What is composed of other lists is best understood by an example.
        for (name, templates) in &lists() {
            let mut parts = BTreeSet::new();
            templates.iter().for_each(|template| references(&template.part, &mut parts));
            let is_sum = templates.iter().all(|template| matches!(template.part, Part::List(_)));
            let is_inner = matches!(phrases::list(name), Some(List::Rules(_))) && !RULES.contains(name);
            let has_example = examples.iter().any(|(list, ..)| list == name);
            assert!(parts.is_empty() || is_sum || is_inner || has_example, "{name} has no example");
        }
    }

    /// An example with the first rule applied that fits anywhere.
    fn rewritten(list: &'static str, example: &str) -> String {
        let tokens: Vec<Token> = example.split(' ').flat_map(token::tokens).collect();
        let found = (0..tokens.len()).find_map(|at| Some((at, Rules(list).at(&tokens, at)?)));
        let Some((at, found)) = found else { return format!("no rule of {list} fits `{example}`") };
        let said = [&tokens[..at], &found.words, &tokens[found.end..]].concat();
        let word = |token: &Token| match token {
            Token::Comma => ",".to_owned(),
            Token::Stop => ".".to_owned(),
            Token::Word(word) => word.clone(),
        };
        said.iter().map(word).collect::<Vec<_>>().join(" ")
    }
}
