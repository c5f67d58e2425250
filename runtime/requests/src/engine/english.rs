//! The lists of English, by the names that they have in the files of the folder `english/`.

use crate::engine::phrases::Phrases;

/// The files, by name.
pub(crate) const FILES: &[(&str, &str)] = &[
    ("answers", include_str!("../../english/answers.phrases")),
    ("asking", include_str!("../../english/asking.phrases")),
    ("commands", include_str!("../../english/commands.phrases")),
    ("named_steps", include_str!("../../english/named_steps.phrases")),
    ("courtesy", include_str!("../../english/courtesy.phrases")),
    ("indirect_requests", include_str!("../../english/indirect_requests.phrases")),
    ("knowledge", include_str!("../../english/knowledge.phrases")),
    ("nouns", include_str!("../../english/nouns.phrases")),
    ("places", include_str!("../../english/places.phrases")),
    ("questions", include_str!("../../english/questions.phrases")),
    ("remarks", include_str!("../../english/remarks.phrases")),
    ("rewrites", include_str!("../../english/rewrites.phrases")),
    ("tokens", include_str!("../../english/tokens.phrases")),
    ("verbs", include_str!("../../english/verbs.phrases")),
    ("wishes", include_str!("../../english/wishes.phrases")),
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
    ADDITIONS ADVICE AGAIN AGREEING_SOUNDS AGREES AGREES_AS_CLAUSE AGREES_PLAINLY ALL_OF_THEM
    ANSWER_COURTESY ANSWER_LEADS ANY_OF_THEM APART_VERBS ASKED_TO_STOP ASKS_SOMEBODY BEFORE_CURT
    BEFORE_REPORT BEHIND_REPORT BESIDE_THE_POINT BINS BUT_DO_NOT CANDIDATES_OPEN CARRYING CHOICE_FILLERS
    CLAUSE_JOINTS CONTRACTIONS CONTRASTS CURT_WISHES DEICTICS DENIAL_WORDS DENIES_REQUEST DETERMINERS
    DOUBTS ELSEWHERE ENDS_AT_CAN FAVOUR FORBIDDEN_NOT FORBIDDEN_UNTIL FORMER GIVES_UP GOES_NOWHERE
    GOES_ON_AT_HITHER GOES_ON_DO_NOT HANDS HOLDS_CAN HOLDS_STILL IGNORANT IS_HABIT_ALWAYS IS_TAG_ASKS IT
    KINDS_OF LATTER LEADS LIKES LOOK_THERE MAY_HAVE MINDING MODAL_CAN MOMENT NARROWED_IS NARROWED_LIKED
    NEEDS_TO NEED_NOT NEGATES_NO NEXT_PLACE NO NOUN_ENDS NO_LEADS NO_THING NUMBERED_THE NUMBERS OFFERS
    OF_IT ONE_OF_THEM ONTO OPEN_NOUNS ORDINALS ORDINARY_WORDS OVERTURES PACKAGES PARTICIPLES
    PARTS_OF_THINGS PART_FOLLOWS_OVER PART_GO PASTS PHRASE_SOMETHING PLACE_AFTER_STOP PLAIN_AND
    PLAIN_WORDS PLURALS PREDICATES PREPOSITIONS_OF_DIRECTION PREPOSITIONS_OF_PLACE PROCEEDS PRONOUNS
    REFUSALS REFUSE REPLACES REPORT_DENIALS REPORT_WORDS RETRY_WORDS SAME SEEKS SAYS_WHERE SERIES SIDES
    SIDE_THE SKIP_SOFT_SOFT SOFTENERS SOUNDS SPEAKERS SPOKEN_I_MEAN SPOTS_GOES_ON STATES STEPS_DOING
    STEPS_DONE STOPS STOPS_ALONE SUPERLATIVES TAKE_HOLD TELLING_BE THANKS THAT_IS THE_OTHER THINGS
    TOLD_THERE TRIES_AGAIN TURNS TURNS_BY LOOKS_ASIDE USES USE_ENDS VAGUE_VERBS VERB WANTED_LATER
    WHERE_IT_BELONGS WISH WISH_HAVE WITHDRAWALS YES
}

/// The names of the lists of rules that the reader begins with.
#[cfg(test)]
pub(crate) const RULES: &[&str] = &[
    "act",
    "addressed",
    "asks",
    "asks_for_it",
    "asks_whether",
    "beside",
    "boundary",
    "carrying",
    "caution",
    "clauses",
    "conditions",
    "courtesy",
    "dropped",
    "elliptic",
    "excluded",
    "favours",
    "fetch",
    "go",
    "guidance",
    "guided_search",
    "hearsay",
    "hedged",
    "in_another_form",
    "in_order",
    "leads",
    "met",
    "no_remarks",
    "onto",
    "parts",
    "possessed",
    "prefers",
    "proves_it",
    "questions",
    "remarks",
    "reported",
    "reported_in_answer",
    "room_questions",
    "sentences",
    "sets_out",
    "speaker",
    "stays_put",
    "steps_by_name",
    "task",
    "unwrapped",
    "verb",
    "watches",
    "wants_state",
    "whereto",
    "wish",
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{FILES, RULES, USED};
    use crate::engine::phrases::{self, List};
    use crate::engine::rule::Rules;
    use crate::engine::rule::tests::FITTING;
    use crate::engine::template::{self, Lists, Part};
    use crate::engine::token::{self, Token};
    use crate::engine::verb::Act;

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
            Part::Read(_, argument) => {
                found.extend(Some(*argument).filter(|name| phrases::list(name).is_some()))
            }
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
    fn english_templates_are_reached() {
        let lists = lists();
        for (name, templates) in &lists {
            let Some(List::Phrases(phrases)) = phrases::list(name) else { continue };
            for (index, template) in templates.iter().enumerate() {
                let said = phrase(&template.part, &lists);
                let value = Some(template.value.unwrap_or_default());
                assert_eq!(phrases.value(&said), value, "{name}: `{said}` is read by another template");
                let is_again = templates[..index].iter().any(|other| other.part == template.part);
                assert!(!is_again, "{name}: `{said}` stands twice");
            }
        }
    }

    #[test]
    fn english_examples_are_read() {
        let examples: Vec<_> = FILES.iter().flat_map(|(_, text)| template::examples(text)).collect();
        let mut reached = BTreeSet::new();
        for (list, example, becomes) in &examples {
            if let Some(List::Phrases(phrases)) = phrases::list(list) {
                assert!(phrases.has(example), "{list}: `{example}`");
                continue;
            }
            let Some(applied) = applied(list, example) else { panic!("no rule of {list} fits `{example}`") };
            let said = &applied.said;
            assert!(becomes.is_none_or(|becomes| said == becomes), "{list}: `{example}` becomes `{said}`");
            reached.insert((*list, applied.index));
            reached.extend(applied.inner);
        }
        // A rule needs an example of its own, a list that is composed of other lists one of them all.
        let mut bare = Vec::new();
        for (name, templates) in &lists() {
            if let Some(List::Rules(_)) = phrases::list(name) {
                let missing = (0..templates.len()).filter(|index| !reached.contains(&(*name, *index)));
                bare.extend(missing.map(|index| format!("{name}, rule {}", index + 1)));
                continue;
            }
            let mut parts = BTreeSet::new();
            templates.iter().for_each(|template| references(&template.part, &mut parts));
            let is_sum = templates.iter().all(|template| matches!(template.part, Part::List(_)));
            if !(parts.is_empty() || is_sum || examples.iter().any(|(list, ..)| list == name)) {
                bare.push((*name).to_owned());
            }
        }
        assert!(bare.is_empty(), "without an example:\n{}", bare.join("\n"));
    }

    /// An example with the first rule applied that fits.
    struct Applied {
        index: usize,
        said: String,
        /// Rules of other lists that took part.
        inner: Vec<(&'static str, usize)>,
    }

    /// Applies the first rule of a list that fits anywhere in an example. `take out: it` is an example behind
    /// a command, with its act and its facts; without them, each act is tried.
    fn applied(list: &'static str, example: &str) -> Option<Applied> {
        let (head, text) = example.split_once(": ").unwrap_or(("", example));
        let mut facts: Vec<&str> = head.split(' ').collect();
        let act = Act::named(facts.remove(0));
        let tokens: Vec<Token> = text.split(' ').flat_map(token::tokens).collect();
        let acts = ["go", "pick", "take", "put", "open", "close"].map(Act::named);
        let acts = if head.is_empty() { [None].iter().chain(&acts).copied().collect() } else { vec![act] };
        FITTING.take();
        let rules = Rules(list);
        let (at, end, words) = if list == "task" {
            (0, tokens.len(), rules.search(&tokens)?)
        } else {
            let found = (0..tokens.len()).find_map(|at| {
                let apply = |act: &Option<Act>| match act {
                    Some(act) => rules.given(&tokens, at, *act, &facts),
                    None => rules.knowing(&tokens, at, &facts),
                };
                Some((at, acts.iter().find_map(apply)?))
            });
            let (at, found) = found?;
            (at, found.end, found.words)
        };
        let mut inner = FITTING.take();
        let (_, index) = inner.pop()?;
        let said = [&tokens[..at], &words, &tokens[end..]].concat();
        let word = |token: &Token| match token {
            Token::Comma => ",".to_owned(),
            Token::Stop => ".".to_owned(),
            Token::Word(word) => word.clone(),
        };
        Some(Applied { index, said: said.iter().map(word).collect::<Vec<_>>().join(" "), inner })
    }
}
