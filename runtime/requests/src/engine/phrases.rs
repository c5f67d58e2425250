//! Lists of phrases, compiled: the longest phrase of a list that stands at a place among the tokens.
//!
//! The files under `english/` are parsed once, at first use. Each list becomes a deterministic automaton over
//! words at its first use, by subset construction; matching then takes one look-up a word, whatever the size
//! of the list.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::sync::{LazyLock, OnceLock};

use rustc_hash::FxHashMap;

use crate::engine::effort;
use crate::engine::template::{self, Lists, Part, Template};
use crate::engine::token::Token;

/// A list of phrases by its name in the files.
pub(crate) struct Phrases {
    name: &'static str,
    automaton: OnceLock<Automaton>,
}

/// A list of the files.
pub(crate) enum List {
    Phrases(Phrases),
    /// Rules, with slots, for [`crate::engine::rule`].
    Rules(&'static [Template]),
}

/// A list by its name.
pub(crate) fn list(name: &str) -> Option<&'static List> {
    static LISTS: LazyLock<FxHashMap<&'static str, List>> = LazyLock::new(|| {
        let list = |(name, templates): (&&'static str, &'static Vec<Template>)| {
            let is_rule = templates.iter().any(|template| is_rule(&template.part));
            (*name, if is_rule { List::Rules(templates) } else { List::Phrases(Phrases::new(name)) })
        };
        ENGLISH.iter().map(list).collect()
    });
    LISTS.get(name)
}

/// True if a part is more than words.
fn is_rule(part: &Part) -> bool {
    match part {
        Part::Word(word) => matches!(*word, "," | "."),
        Part::List(name) => ENGLISH.get(name).into_iter().flatten().any(|template| is_rule(&template.part)),
        Part::Sequence(parts) | Part::Choice(parts) => parts.iter().any(is_rule),
        Part::Repeat(part) => is_rule(part),
        Part::Slot(..) | Part::Read(..) | Part::Look(..) => true,
    }
}

/// A deterministic automaton over words. State 0 is the first.
#[derive(Default, Debug)]
struct Automaton {
    words: FxHashMap<&'static str, u32>,
    /// For each state the next one by word, in the order of words.
    next: Vec<Vec<(u32, u32)>>,
    /// For each state whether a phrase ends there, and the value it stands for.
    ends: Vec<Option<Option<&'static str>>>,
}

/// The lists of English.
static ENGLISH: LazyLock<Lists> = LazyLock::new(|| {
    let mut lists = Lists::new();
    for (file, text) in super::english::FILES {
        // The test `english_files_parse` holds the files.
        let read = template::read(text, &mut lists);
        debug_assert!(read.is_ok(), "{file}: {read:?}");
    }
    lists
});

impl Phrases {
    pub(crate) const fn new(name: &'static str) -> Self {
        Self { name, automaton: OnceLock::new() }
    }

    /// The number of tokens of the longest phrase that stands at a place.
    pub(crate) fn longest(&self, tokens: &[Token], at: usize) -> Option<usize> {
        self.find(tokens, at).map(|(count, _)| count)
    }

    /// The same, with the value of the phrase.
    pub(crate) fn valued(&self, tokens: &[Token], at: usize) -> Option<(usize, &'static str)> {
        self.find(tokens, at).map(|(count, value)| (count, value.unwrap_or_default()))
    }

    /// The value of a whole phrase; empty where it has none.
    pub(crate) fn value(&self, phrase: &str) -> Option<&'static str> {
        let mut state = 0;
        for word in phrase.split(' ') {
            state = self.automaton().step(state, word)?;
        }
        self.automaton().end(state).map(Option::unwrap_or_default)
    }

    /// True if a phrase, such as a single word, is one of the list.
    pub(crate) fn has(&self, phrase: &str) -> bool {
        self.value(phrase).is_some()
    }

    /// The number of tokens of the phrases that stand at a place one behind another.
    pub(crate) fn run(&self, tokens: &[Token], at: usize) -> usize {
        let next = |end: &usize| Some(end + self.longest(tokens, *end)?);
        std::iter::successors(Some(at), next).last().unwrap_or(at) - at
    }

    /// True if a phrase begins with this word.
    pub(crate) fn begins_with(&self, word: &str) -> bool {
        self.automaton().step(0, word).is_some()
    }

    /// The values of the list.
    pub(crate) fn values(&self) -> impl Iterator<Item = &'static str> {
        self.automaton().ends.iter().flatten().copied().flatten()
    }

    /// Every word of the list.
    pub(crate) fn words(&self) -> impl Iterator<Item = &'static str> {
        self.automaton().words.keys().copied()
    }

    fn find(&self, tokens: &[Token], at: usize) -> Option<(usize, Option<&'static str>)> {
        if !effort::step() {
            return None;
        }
        let automaton = self.automaton();
        let (mut state, mut found) = (0, None);
        for (index, token) in tokens.get(at..)?.iter().enumerate() {
            let Some(next) = automaton.step(state, token.word()) else { break };
            state = next;
            if let Some(value) = automaton.end(state) {
                found = Some((index + 1, value));
            }
        }
        found
    }

    fn automaton(&self) -> &Automaton {
        self.automaton.get_or_init(|| Automaton::compile(self.name, &ENGLISH))
    }
}

impl Automaton {
    fn compile(name: &'static str, lists: &Lists) -> Self {
        let mut builder = Builder { lists, edges: vec![Vec::new()], ends: BTreeMap::new() };
        for template in lists.get(name.to_ascii_lowercase().as_str()).into_iter().flatten() {
            let end = builder.state();
            builder.part(&template.part, 0, end);
            builder.ends.insert(end, template.value);
        }
        builder.determine()
    }

    fn step(&self, state: u32, word: &str) -> Option<u32> {
        let word = self.words.get(word)?;
        let next = self.next.get(usize::try_from(state).ok()?)?;
        next.binary_search_by_key(word, |(word, _)| *word).ok().and_then(|at| next.get(at)).map(|(_, to)| *to)
    }

    fn end(&self, state: u32) -> Option<Option<&'static str>> {
        *self.ends.get(usize::try_from(state).ok()?)?
    }
}

/// True if a word stands in a template of any list.
pub(crate) fn is_word_of_lists(word: &str) -> bool {
    static WORDS: LazyLock<HashSet<&'static str>> = LazyLock::new(|| {
        let mut words = HashSet::new();
        ENGLISH.values().flatten().for_each(|template| add_words(&template.part, &mut words));
        words
    });
    WORDS.contains(word)
}

fn add_words(part: &Part, words: &mut HashSet<&'static str>) {
    match part {
        Part::Word(word) => {
            words.insert(word);
        }
        Part::List(_) | Part::Read(..) => {}
        Part::Sequence(parts) | Part::Choice(parts) => parts.iter().for_each(|part| add_words(part, words)),
        Part::Repeat(part) | Part::Slot(_, part) | Part::Look(_, _, part) => add_words(part, words),
    }
}

/// A nondeterministic automaton while it grows; an edge without a word is an epsilon transition.
struct Builder<'a> {
    lists: &'a Lists,
    edges: Vec<Vec<(Option<&'static str>, usize)>>,
    ends: BTreeMap<usize, Option<&'static str>>,
}

impl Builder<'_> {
    fn state(&mut self) -> usize {
        self.edges.push(Vec::new());
        self.edges.len() - 1
    }

    fn edge(&mut self, from: usize, word: Option<&'static str>, to: usize) {
        if let Some(edges) = self.edges.get_mut(from) {
            edges.push((word, to));
        }
    }

    /// Adds a part between two states.
    fn part(&mut self, part: &Part, from: usize, to: usize) {
        match part {
            Part::Word(word) => self.edge(from, Some(word), to),
            Part::Sequence(parts) => {
                let Some((last, before)) = parts.split_last() else { return self.edge(from, None, to) };
                let mut at = from;
                for part in before {
                    let next = self.state();
                    self.part(part, at, next);
                    at = next;
                }
                self.part(last, at, to);
            }
            Part::Choice(parts) => parts.iter().for_each(|part| self.part(part, from, to)),
            // A state of its own keeps what is repeated apart from what stands around it.
            Part::Repeat(part) => {
                let again = self.state();
                self.edge(from, None, again);
                self.part(part, again, again);
                self.edge(again, None, to);
            }
            // Only rules have these, and they are not compiled.
            Part::Slot(..) | Part::Read(..) | Part::Look(..) => {}
            Part::List(name) => {
                let lists = self.lists;
                let templates = lists.get(name).into_iter().flatten();
                templates.for_each(|template| self.part(&template.part, from, to));
            }
        }
    }

    /// All states that epsilon transitions lead to.
    fn closure(&self, states: impl IntoIterator<Item = usize>) -> BTreeSet<usize> {
        let mut open: Vec<usize> = states.into_iter().collect();
        let mut closed = BTreeSet::new();
        while let Some(state) = open.pop() {
            if closed.insert(state) {
                let edges = self.edges.get(state).into_iter().flatten();
                open.extend(edges.filter(|(word, _)| word.is_none()).map(|(_, to)| *to));
            }
        }
        closed
    }

    fn determine(&self) -> Automaton {
        let mut automaton = Automaton::default();
        let mut known: BTreeMap<BTreeSet<usize>, u32> = BTreeMap::new();
        let first = self.closure([0]);
        known.insert(first.clone(), 0);
        let mut open = std::collections::VecDeque::from([first]);
        while let Some(states) = open.pop_front() {
            let end = states.iter().filter_map(|state| self.ends.get(state)).next().copied();
            automaton.ends.push(end);
            let mut targets: BTreeMap<u32, BTreeSet<usize>> = BTreeMap::new();
            for (word, to) in states.iter().filter_map(|state| self.edges.get(*state)).flatten() {
                let Some(word) = word else { continue };
                let count = u32::try_from(automaton.words.len()).unwrap_or(u32::MAX);
                let word = *automaton.words.entry(word).or_insert(count);
                targets.entry(word).or_default().insert(*to);
            }
            let mut next = Vec::with_capacity(targets.len());
            for (word, to) in targets {
                let to = self.closure(to);
                let count = u32::try_from(known.len()).unwrap_or(u32::MAX);
                let state = *known.entry(to.clone()).or_insert_with(|| {
                    open.push_back(to);
                    count
                });
                next.push((word, state));
            }
            automaton.next.push(next);
        }
        automaton
    }
}

#[cfg(test)]
mod tests {
    use super::Automaton;
    use crate::engine::template::{Lists, read};

    fn automaton(text: &'static str) -> Automaton {
        let mut lists = Lists::new();
        assert_eq!(read(text, &mut lists), Ok(()));
        Automaton::compile("it", &lists)
    }

    fn reads(automaton: &Automaton, phrase: &str) -> Option<Option<&'static str>> {
        let state = phrase.split(' ').try_fold(0, |state, word| automaton.step(state, word))?;
        automaton.end(state)
    }

    #[test]
    fn automaton_reads_the_phrases_of_a_list_and_no_others() {
        let it = automaton("it:\n  [so] <very>* (good|fine)\nvery:\n  very [very] | ever so\n");
        for phrase in ["good", "so fine", "very good", "so very very ever so fine"] {
            assert!(reads(&it, phrase).is_some(), "{phrase}");
        }
        for phrase in ["so", "good fine", "ever good", "very"] {
            assert!(reads(&it, phrase).is_none(), "{phrase}");
        }
    }

    #[test]
    fn automaton_gives_the_value_of_the_first_template() {
        let it = automaton("it:\n  brought => bring\n  (brought|took) => take\n");
        assert_eq!(reads(&it, "brought"), Some(Some("bring")));
        assert_eq!(reads(&it, "took"), Some(Some("take")));
    }
}
