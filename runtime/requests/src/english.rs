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
    ("tokens", include_str!("../english/tokens.phrases")),
    ("verbs", include_str!("../english/verbs.phrases")),
    ("wishes", include_str!("../english/wishes.phrases")),
];

macro_rules! lists {
    ($($name:ident $list:literal)*) => {
        $(pub(crate) static $name: Phrases = Phrases::new($list);)*
        /// The names of all lists that the reader uses.
        #[cfg(test)]
        pub(crate) const USED: &[&str] = &[$($list),*];
    };
}

lists! {
    BESIDE_WHO "beside_who"
    PERSON_DOES "person_does"
    ADVICE "advice"
    AGAIN "again"
    AGREES "agrees"
    AGREES_AS_CLAUSE "agrees_as_clause"
    AGREES_PLAINLY "agrees_plainly"
    AIM_BACK "aim_back"
    AIM_CAN "aim_can"
    AIM_GO "aim_go"
    AIM_HAVE "aim_have"
    AIM_LEFT "aim_left"
    AIM_PLEASE "aim_please"
    AIM_THEN "aim_then"
    AIM_WILL "aim_will"
    ALL_OF_THEM "all_of_them"
    AND_PUT "and_put"
    ANOTHER_WANTS "another_wants"
    ANY_OF_THEM "any_of_them"
    ANYONE_ASKED "anyone_asked"
    APART_TAGS "apart_tags"
    APART_VERBS "apart_verbs"
    ARE_YOU_ABLE "are_you_able"
    ASIDE_LIKE "aside_like"
    ASIDES "asides"
    ASKED_FOR_SHOW_ME "asked_for_show_me"
    ASKED_FOR_WILL_NOT "asked_for_will_not"
    ASKED_FOR_WITH_THIS "asked_for_with_this"
    ASKED_PERSON "asked_person"
    ASKING_WORDS "asking_words"
    ASKS_FOR_GERUND "asks_for_gerund"
    ASKS_IF "asks_if"
    ASKS_SOMEBODY "asks_somebody"
    AT_SPEAKER_HOW "at_speaker_how"
    AT_SPEAKER_OVER_HERE_WITH_ME "at_speaker_over_here_with_me"
    AT_SPEAKER_WHERE_I_AM "at_speaker_where_i_am"
    BARE_BINS "bare_bins"
    BARE_PLEASE "bare_please"
    BARE_WAYS "bare_ways"
    BECOMES "becomes"
    BEFORE_CURT "before_curt"
    BEFORE_REPORT "before_report"
    BEHIND_DO_IT "behind_do_it"
    BEHIND_REPORT "behind_report"
    BESIDE_LASTS "beside_lasts"
    BESIDE_REASON "beside_reason"
    BESIDE_THE_POINT "beside_the_point"
    CALLED_FOR_HERE "called_for_here"
    CALLED_FOR_HITHER "called_for_hither"
    CALLED_FOR_PLEASE "called_for_please"
    CALLED_HONEY "called_honey"
    CALLED_I "called_i"
    CALLS "calls"
    CANDIDATES_OPEN "candidates_open"
    CAUSATIVES "causatives"
    CAUTION_DO_NOT_YOU_DARE "caution_do_not_you_dare"
    CAUTION_PUTTING_IT_DOWN "caution_putting_it_down"
    CONTRACTIONS "contractions"
    CONTRASTS "contrasts"
    CURT_WISHES "curt_wishes"
    DEADLINE_COUNTS "deadline_counts"
    DEADLINE_NEEDS "deadline_needs"
    DEADLINE_SECOND "deadline_second"
    DENIAL_WORDS "denial_words"
    DESTINATION_DESTINATION "destination_destination"
    DESTINATION_FOR_YOU "destination_for_you"
    DESTINATION_IS "destination_is"
    DESTINATION_NEXT "destination_next"
    DESTINATION_YOUR "destination_your"
    DO_IT "do_it"
    DOES_GOOD "does_good"
    DOUBTS "doubts"
    ELLIPTIC_CANNOT "elliptic_cannot"
    ELLIPTIC_COULD_YOU "elliptic_could_you"
    ELLIPTIC_PLEASE "elliptic_please"
    ENDEARMENTS "endearments"
    FAVOUR "favour"
    FAVOUR_BEGINS "favour_begins"
    FAVOUR_I "favour_i"
    FAVOUR_WHO "favour_who"
    FAVOUR_WORDS "favour_words"
    FAVOUR_WOULD "favour_would"
    FILLERS "fillers"
    FINDS "finds"
    FORBIDDEN_NOT "forbidden_not"
    FORBIDDEN_UNTIL "forbidden_until"
    FRONTED_IS_THE_PLACE_FOR "fronted_is_the_place_for"
    GIVES_UP "gives_up"
    GOES_FOR "goes_for"
    GOES_ON_AT_HITHER "goes_on_at_hither"
    GOES_ON_DO_NOT "goes_on_do_not"
    GRATEFUL_WORDS "grateful_words"
    HABIT_WORDS "habit_words"
    HAD "had"
    HAS_ITS_PLACE "has_its_place"
    HAS_TIME "has_time"
    HAS_TO_BE_MUST "has_to_be_must"
    HAS_TO_DO "has_to_do"
    HASTE "haste"
    HEADED_NOW "headed_now"
    HEADED_OVER "headed_over"
    HEADED_PLEASE "headed_please"
    HEDGE "hedge"
    HELPING_WORDS "helping_words"
    HOLDS_CAN "holds_can"
    IF_SO "if_so"
    IN_ANOTHER_FORM_AM "in_another_form_am"
    IN_ANOTHER_FORM_SEE_TO "in_another_form_see_to"
    IN_ANOTHER_FORM_TO "in_another_form_to"
    IN_HAND "in_hand"
    INNER_WORDS "inner_words"
    IS_BOUNDARY_AND "is_boundary_and"
    IS_DETERMINED_THE "is_determined_the"
    IS_HABIT_ALWAYS "is_habit_always"
    IS_NO_THING_DONE "is_no_thing_done"
    IS_NO_THING_HELP "is_no_thing_help"
    IS_NO_THING_RID "is_no_thing_rid"
    IS_NO_THING_YOUR "is_no_thing_your"
    IS_OPEN_IF "is_open_if"
    IS_PRONOUN_ME "is_pronoun_me"
    IS_QUESTION_LEFT "is_question_left"
    IS_QUESTION_WHOSE "is_question_whose"
    IS_RHETORICAL_ASKS "is_rhetorical_asks"
    IS_RHETORICAL_WHO "is_rhetorical_who"
    IS_RHETORICAL_WOULD "is_rhetorical_would"
    IS_SOMEWHERE "is_somewhere"
    IS_SOMEWHERE_HOW "is_somewhere_how"
    IS_TAG_ASKS "is_tag_asks"
    IS_TELLING_IS "is_telling_is"
    IS_WANTED_PLEASE "is_wanted_please"
    IS_WHERE "is_where"
    KEEPS_SO "keeps_so"
    KEPT_HOLD "kept_hold"
    KEPT_OPEN "kept_open"
    KEPT_SHUT "kept_shut"
    KEPT_THERE "kept_there"
    KIN "kin"
    LASTING_VERBS "lasting_verbs"
    LEADS "leads"
    LEISURE_ARE_DONE "leisure_are_done"
    LEISURE_HAVE "leisure_have"
    LEISURE_STARTS "leisure_starts"
    LEISURE_WORDS "leisure_words"
    LETTING_GO "letting_go"
    LOOK_THERE "look_there"
    LYING_ABOUT "lying_about"
    MADE_ROOM_THERE "made_room_there"
    MANNER_AND "manner_and"
    MANNER_AS_YOU_CAN "manner_as_you_can"
    MANNER_HOW "manner_how"
    MANNER_NICE_AND "manner_nice_and"
    MAY "may"
    MAY_BE "may_be"
    MAY_HAVE "may_have"
    MET_AHEAD "met_ahead"
    MET_MEETS "met_meets"
    MINDING "minding"
    MISHAPS "mishaps"
    MODALS "modals"
    MODALS_BEHIND "modals_behind"
    MODALS_OF_DUTY "modals_of_duty"
    NARROWED_IS "narrowed_is"
    NARROWED_LIKED "narrowed_liked"
    NEED_NOT "need_not"
    NEGATES_NO "negates_no"
    NEGATIONS "negations"
    NEXT_PLACE "next_place"
    NICE "nice"
    NICE_BE "nice_be"
    NICE_BEHIND "nice_behind"
    NICE_WOULD "nice_would"
    NO_ADVERBS "no_adverbs"
    NO_LEADS "no_leads"
    NO_REPORTER "no_reporter"
    NOT_FEELING "not_feeling"
    NOUN_ENDS "noun_ends"
    NOUN_OLD "noun_old"
    NOUN_PLACE "noun_place"
    NUMBERED_THE "numbered_the"
    OFF_YOU_GO "off_you_go"
    ONTO "onto"
    OPEN_QUESTIONS "open_questions"
    OPINIONS "opinions"
    ORDINARY_WORDS "ordinary_words"
    OTHERS "others"
    OUT_OF_SIGHT "out_of_sight"
    OVERTURES "overtures"
    PACKAGES "packages"
    PART_FOLLOWS_OVER "part_follows_over"
    PART_FOR_ME "part_for_me"
    PART_FROM_OFF "part_from_off"
    PART_GO "part_go"
    PART_ON_TOP "part_on_top"
    PART_RUBBISH "part_rubbish"
    PART_TO_WHERE_IT_BELONGS "part_to_where_it_belongs"
    PART_UP "part_up"
    PART_WAS "part_was"
    PART_WITH_ME "part_with_me"
    PARTICIPLES "participles"
    PASTS "pasts"
    PHRASE_SOMETHING "phrase_something"
    PLAIN_AND "plain_and"
    PLAIN_WORDS "plain_words"
    PLURALS "plurals"
    POSSESSED_IN "possessed_in"
    POSSESSED_PLACE_IS "possessed_place_is"
    POSSESSED_USUAL "possessed_usual"
    PREDICATE_BIN "predicate_bin"
    PREDICATE_CAN "predicate_can"
    PREDICATE_ME "predicate_me"
    PREDICATE_NEEDS "predicate_needs"
    PREDICATE_REACHES "predicate_reaches"
    PREDICATE_SHOULD_NOT_BE "predicate_should_not_be"
    PREDICATE_TO_ME "predicate_to_me"
    PREDICATES "predicates"
    PREPOSITIONS_OF_PLACE "prepositions_of_place"
    PREPOSITIONS_OF_WAY "prepositions_of_way"
    PROHIBITIONS "prohibitions"
    PRONOUNS "pronouns"
    PURPOSE_DOES "purpose_does"
    PURPOSE_DOES_2 "purpose_does_2"
    PURPOSE_I "purpose_i"
    PURPOSE_IN_ORDER_TO "purpose_in_order_to"
    PURPOSE_NOBODY "purpose_nobody"
    PURPOSE_TOMORROW "purpose_tomorrow"
    PUT_SOMEWHERE "put_somewhere"
    PUTS_PAST "puts_past"
    QUOTES_ME "quotes_me"
    QUOTING_VERBS "quoting_verbs"
    REASONS "reasons"
    RELAYED_I "relayed_i"
    RELAYED_MODALS "relayed_modals"
    RELAYS "relays"
    REPORT_DENIALS "report_denials"
    REPORT_WORDS "report_words"
    REPORTED_SAYS "reported_says"
    REPORTER "reporter"
    REPORTER_ARTICLE "reporter_article"
    REPORTER_HAS "reporter_has"
    RETRY_WORDS "retry_words"
    ROOM_FOR_FIND "room_for_find"
    ROOM_FOR_MAKES "room_for_makes"
    ROOM_FOR_ROOM "room_for_room"
    SAID_BACK "said_back"
    SAID_HAVING "said_having"
    SAID_HAVING_2 "said_having_2"
    SAID_HERE "said_here"
    SAID_LIVES "said_lives"
    SAID_SEEN "said_seen"
    SAID_THERE "said_there"
    SAME "same"
    SAME_PASTS "same_pasts"
    SEE_TO "see_to"
    SELF_MOVED_TAKE "self_moved_take"
    SENT_BE_OVER "sent_be_over"
    SENT_NEEDED "sent_needed"
    SENT_OVER "sent_over"
    SENT_OVER_AT "sent_over_at"
    SENT_STOP "sent_stop"
    SENT_WITH_YOU "sent_with_you"
    SENT_WITH_YOU_2 "sent_with_you_2"
    SETS_OUT "sets_out"
    SHALL_BE "shall_be"
    SHALL_IT "shall_it"
    SHALL_WE "shall_we"
    SIDE_THE "side_the"
    SKIP_SOFT_SOFT "skip_soft_soft"
    SOFTENERS "softeners"
    SOUNDS "sounds"
    SPEAKER "speaker"
    SPOKEN_I_MEAN "spoken_i_mean"
    SPOTS_GOES_ON "spots_goes_on"
    STATE_AND "state_and"
    STATE_POSED "state_posed"
    STATE_RUBBISH "state_rubbish"
    STATE_SKIPPED "state_skipped"
    STAYS_PUT_AWAITS "stays_put_awaits"
    STAYS_PUT_LEFT "stays_put_left"
    STAYS_PUT_STAY "stays_put_stay"
    STAYS_PUT_THERE "stays_put_there"
    STAYS_PUT_WHAT_FOR "stays_put_what_for"
    STOPS_THERE "stops_there"
    STRESSED "stressed"
    SUBJECTS "subjects"
    SURELY "surely"
    TAGS "tags"
    TAKE_HOLD "take_hold"
    TASK_ASIDES "task_asides"
    TELLING_VERBS "telling_verbs"
    THANKS "thanks"
    THINGS "things"
    TO_BE "to_be"
    TOLD_SUBJECTS "told_subjects"
    TOLD_THERE "told_there"
    TOLD_WHEN_DONE_DONE "told_when_done_done"
    TOLD_WHEN_DONE_TELLS "told_when_done_tells"
    TOLD_YOU_FOR_WHOM "told_you_for_whom"
    TOLD_YOU_GO "told_you_go"
    TOPICS "topics"
    TRIES_AGAIN "tries_again"
    TROUBLE "trouble"
    UNLESS_SO_IF "unless_so_if"
    UNLESS_SO_IS_STILL "unless_so_is_still"
    UNWANTED_STATE "unwanted_state"
    UNWRAPPED_AND "unwrapped_and"
    UNWRAPPED_COMING "unwrapped_coming"
    UNWRAPPED_GETS "unwrapped_gets"
    UNWRAPPED_GOT "unwrapped_got"
    UNWRAPPED_HAVE "unwrapped_have"
    UNWRAPPED_LET_ME_INTO "unwrapped_let_me_into"
    UNWRAPPED_ONCE_YOU_HAVE "unwrapped_once_you_have"
    UNWRAPPED_OVER "unwrapped_over"
    UNWRAPPED_RATHER "unwrapped_rather"
    UNWRAPPED_SOMEBODY "unwrapped_somebody"
    UNWRAPPED_THERE "unwrapped_there"
    UNWRAPPED_WITH_YOU "unwrapped_with_you"
    USES "uses"
    VAGUE_VERBS "vague_verbs"
    VERB "verb"
    WANTED_LATER "wanted_later"
    WANTED_TO_BE "wanted_to_be"
    WANTED_WE_KEEP "wanted_we_keep"
    WANTED_YOU "wanted_you"
    WANTS_STATE "wants_state"
    WANTS_YOU_TO "wants_you_to"
    WE "we"
    WHERE_IT_BELONGS "where_it_belongs"
    WHERETO "whereto"
    WHETHER "whether"
    WISH "wish"
    WISH_HAVE "wish_have"
    WISH_SEES_YOU "wish_sees_you"
    WISHED_STATE "wished_state"
    WITH_IT_GOES "with_it_goes"
    WITH_IT_OFF "with_it_off"
    WITH_IT_OUT_IT_GOES "with_it_out_it_goes"
    WITH_IT_OUT_WITH "with_it_out_with"
    WITH_IT_RUBBISH "with_it_rubbish"
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{FILES, USED};
    use crate::phrases::Phrases;
    use crate::template::{self, Lists, Part};

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
            Part::Repeat(part) => references(part, found),
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
        }
    }

    #[test]
    fn english_lists_are_defined_and_reached() {
        let lists = lists();
        let mut reached: BTreeSet<&str> = USED.iter().copied().collect();
        lists.values().flatten().for_each(|template| references(&template.part, &mut reached));
        let defined: BTreeSet<&str> = lists.keys().copied().collect();
        assert_eq!(reached.difference(&defined).collect::<Vec<_>>(), Vec::<&&str>::new(), "not defined");
        assert_eq!(defined.difference(&reached).collect::<Vec<_>>(), Vec::<&&str>::new(), "not reached");
    }

    #[test]
    fn english_templates_are_read_once() {
        let lists = lists();
        for (name, templates) in &lists {
            let phrases = Phrases::new(name);
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
        for (list, example) in &examples {
            assert!(Phrases::new(list).has(example), "{list}: `{example}`");
        }
        // What is composed of other lists is best understood by an example.
        for (name, templates) in &lists() {
            let mut parts = BTreeSet::new();
            templates.iter().for_each(|template| references(&template.part, &mut parts));
            let is_sum = templates.iter().all(|template| matches!(template.part, Part::List(_)));
            let has_example = examples.iter().any(|(list, _)| list == name);
            assert!(parts.is_empty() || is_sum || has_example, "{name} has no example");
        }
    }
}
