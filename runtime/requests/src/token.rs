//! A request as words: lower case, contractions opened, sentence marks kept as marks.

/// A word or a mark.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Token {
    /// A word in lower case.
    Word(String),
    /// `,`
    Comma,
    /// The end of a sentence: `.`, `!`, `?`, `;`, a line break.
    Stop,
}

impl Token {
    /// The word; empty for a mark.
    pub fn word(&self) -> &str {
        match self {
            Self::Word(word) => word,
            Self::Comma | Self::Stop => "",
        }
    }
}

/// What is written together and meant as several words.
const CONTRACTIONS: &[(&str, &[&str])] = &[
    ("i'd", &["i", "would"]),
    ("i'll", &["i", "will"]),
    ("i'm", &["i", "am"]),
    ("i've", &["i", "have"]),
    ("it's", &["it", "is"]),
    ("that's", &["that", "is"]),
    ("there's", &["there", "is"]),
    ("let's", &["let", "us"]),
    ("don't", &["do", "not"]),
    ("doesn't", &["does", "not"]),
    ("can't", &["can", "not"]),
    ("won't", &["will", "not"]),
    ("wouldn't", &["would", "not"]),
    ("shouldn't", &["should", "not"]),
    ("aren't", &["are", "not"]),
    ("where's", &["where", "is"]),
    ("what's", &["what", "is"]),
    ("you're", &["you", "are"]),
    ("you'd", &["you", "would"]),
    ("you'll", &["you", "will"]),
    ("we'd", &["we", "would"]),
    ("we'll", &["we", "will"]),
    ("we're", &["we", "are"]),
    ("they're", &["they", "are"]),
    ("d'you", &["do", "you"]),
    ("isn't", &["is", "not"]),
    ("wasn't", &["was", "not"]),
    ("weren't", &["were", "not"]),
    ("hasn't", &["has", "not"]),
    ("haven't", &["have", "not"]),
    ("hadn't", &["had", "not"]),
    ("didn't", &["did", "not"]),
    ("couldn't", &["could", "not"]),
    ("mustn't", &["must", "not"]),
    ("cannot", &["can", "not"]),
    ("he's", &["he", "is"]),
    ("she's", &["she", "is"]),
    ("we've", &["we", "have"]),
    ("they've", &["they", "have"]),
    ("you've", &["you", "have"]),
    ("somebody's", &["somebody", "has"]),
    ("someone's", &["someone", "has"]),
    ("it'll", &["it", "will"]),
    ("it'd", &["it", "would"]),
    ("that'd", &["that", "would"]),
    ("that'll", &["that", "will"]),
    ("there'd", &["there", "would"]),
    ("nobody's", &["nobody", "is"]),
    ("everyone's", &["everyone", "is"]),
    ("everybody's", &["everybody", "is"]),
    ("everything's", &["everything", "is"]),
    ("something's", &["something", "is"]),
    ("here's", &["here", "is"]),
    ("why's", &["why", "is"]),
    ("how's", &["how", "is"]),
    ("who's", &["who", "is"]),
    ("when's", &["when", "is"]),
    ("he'd", &["he", "would"]),
    ("she'd", &["she", "would"]),
    ("they'd", &["they", "would"]),
    ("they'll", &["they", "will"]),
    ("he'll", &["he", "will"]),
    ("she'll", &["she", "will"]),
    ("who'd", &["who", "would"]),
    ("needn't", &["need", "not"]),
    ("ain't", &["is", "not"]),
    ("dont", &["do", "not"]),
    ("cant", &["can", "not"]),
    ("im", &["i", "am"]),
    ("gonna", &["going", "to"]),
    ("gotta", &["got", "to"]),
    ("shoulda", &["should", "have"]),
    ("c'mon", &["come", "on"]),
    ("g'day", &["hello"]),
    ("y'know", &["you", "know"]),
    ("o'clock", &["oclock"]),
    ("ya", &["you"]),
    ("u", &["you"]),
    ("thx", &["thanks"]),
    ("gimme", &["give", "me"]),
    ("lemme", &["let", "me"]),
    ("wanna", &["want", "to"]),
    ("must've", &["must", "have"]),
    ("should've", &["should", "have"]),
    ("could've", &["could", "have"]),
    ("would've", &["would", "have"]),
    ("might've", &["might", "have"]),
    ("may've", &["may", "have"]),
    ("mightn't", &["might", "not"]),
    ("oughtn't", &["ought", "not"]),
    ("shan't", &["shall", "not"]),
    ("what're", &["what", "are"]),
    ("where're", &["where", "are"]),
    ("that're", &["that", "are"]),
    ("there're", &["there", "are"]),
    ("how'd", &["how", "would"]),
    ("what'd", &["what", "would"]),
    ("what'll", &["what", "will"]),
    ("anyone's", &["anyone", "is"]),
    ("anybody's", &["anybody", "is"]),
    ("one's", &["one", "is"]),
    ("em", &["them"]),
    ("outta", &["out", "of"]),
    ("dunno", &["do", "not", "know"]),
    ("didnt", &["did", "not"]),
    ("doesnt", &["does", "not"]),
    ("isnt", &["is", "not"]),
    ("wont", &["will", "not"]),
    ("thats", &["that", "is"]),
    ("whats", &["what", "is"]),
    ("wheres", &["where", "is"]),
    ("lets", &["let", "us"]),
    ("ive", &["i", "have"]),
    ("youre", &["you", "are"]),
    ("pls", &["please"]),
    ("plz", &["please"]),
];

/// Splits a request. Anything that is neither a letter, a digit nor a mark separates words; an apostrophe belongs to its
/// word. O(bytes).
pub(super) fn tokens(text: &str) -> Vec<Token> {
    let mut tokens: Vec<Token> = Vec::new();
    let mut begin = 0;
    for (token, end) in pieces(text) {
        let is_stop = token == Token::Stop;
        // `want the coke?` offers it, `want the coke!` asks for it.
        let asks = is_stop && text.get(..end).is_some_and(|said| said.ends_with('?'));
        if asks && tokens.get(begin).is_some_and(|first| matches!(first.word(), "want" | "need" | "fancy")) {
            let you = ["do", "you"].map(|word| Token::Word(word.to_owned()));
            tokens.splice(begin..begin, you);
        }
        tokens.push(token);
        if is_stop {
            begin = tokens.len();
        }
    }
    tokens
}

/// The same, each with the offset in bytes behind it; what is written together ends together.
pub fn pieces(text: &str) -> Vec<(Token, usize)> {
    let mut pieces = Vec::new();
    let mut word = String::new();
    let mut was_blank = true;
    let mut letters = text.char_indices().peekable();
    while let Some((at, letter)) = letters.next() {
        // A point between digits or letters without a blank belongs to the word: `1.5`.
        let joins = letter == '.'
            && !word.is_empty()
            && letters.peek().is_some_and(|(_, next)| next.is_alphanumeric());
        if matches!(letter, '\'' | '\u{2019}' | '\u{2018}') {
            word.push('\'');
            was_blank = false;
            continue;
        }
        if letter.is_alphanumeric() || joins {
            word.extend(letter.to_lowercase());
            was_blank = false;
            continue;
        }
        push(&mut pieces, &mut word, at);
        // A dash between blanks is a pause.
        let is_pause = matches!(letter, '\u{2013}' | '\u{2014}')
            || (letter == '-'
                && was_blank
                && letters.peek().is_none_or(|(_, next)| next.is_whitespace() || *next == '-'));
        was_blank = letter.is_whitespace();
        let mark = match letter {
            _ if is_pause => Some(Token::Comma),
            ',' | ':' => Some(Token::Comma),
            '.' | '!' | '?' | ';' | '\n' => Some(Token::Stop),
            _ => None,
        };
        if let Some(mark) = mark {
            pieces.push((mark, at + letter.len_utf8()));
        }
    }
    push(&mut pieces, &mut word, text.len());
    pieces
}

fn push(pieces: &mut Vec<(Token, usize)>, word: &mut String, end: usize) {
    let taken = std::mem::take(word);
    let bare = taken.trim_matches('\'');
    if bare.is_empty() {
        return;
    }
    match CONTRACTIONS.iter().find(|(short, _)| *short == bare) {
        Some((_, words)) => {
            pieces.extend(words.iter().map(|word| (Token::Word((*word).to_owned()), end)));
        }
        None => pieces.push((Token::Word(bare.to_owned()), end)),
    }
}

/// A noun in the singular, by the common rules: `cookies` → `cookie`, `glasses` → `glass`, `berries` → `berry`,
/// `knives` → `knife`. What does not look like a plural stays.
pub(super) fn singular(word: &str) -> String {
    const IRREGULAR: &[(&str, &str)] = &[
        ("knives", "knife"),
        ("shelves", "shelf"),
        ("loaves", "loaf"),
        ("scissors", "scissors"),
        ("people", "person"),
        ("glasses", "glass"),
        ("potatoes", "potato"),
        ("tomatoes", "tomato"),
        ("mangoes", "mango"),
        ("cookies", "cookie"),
        ("keys", "key"),
    ];
    if let Some((_, one)) = IRREGULAR.iter().find(|(many, _)| *many == word) {
        return (*one).to_owned();
    }
    if let Some(stem) = word.strip_suffix("ies").filter(|stem| stem.len() > 2) {
        return format!("{stem}y");
    }
    for end in ["ches", "shes", "xes", "sses"] {
        if let (true, Some(stem)) = (word.ends_with(end), word.strip_suffix("es")) {
            return stem.to_owned();
        }
    }
    let keeps = ["ss", "us", "is"].iter().any(|end| word.ends_with(end)) || word.len() < 4;
    match word.strip_suffix('s').filter(|_| !keeps) {
        Some(stem) => stem.to_owned(),
        None => word.to_owned(),
    }
}

/// How many tokens words take at a place; none where they do not stand there.
pub(super) fn stands(tokens: &[Token], at: usize, words: &str) -> Option<usize> {
    // Most of a table begins with another word.
    if !words.starts_with(tokens.get(at)?.word()) {
        return None;
    }
    let mut count = 0;
    for word in words.split(' ') {
        if tokens.get(at + count)?.word() != word {
            return None;
        }
        count += 1;
    }
    Some(count)
}

/// The same of the longest of several that stands there.
pub(super) fn longest(tokens: &[Token], at: usize, table: &[&str]) -> Option<usize> {
    table.iter().filter_map(|words| stands(tokens, at, words)).max()
}

/// How many tokens those of several take that stand there one behind another.
pub(super) fn run(tokens: &[Token], at: usize, table: &[&str]) -> usize {
    std::iter::successors(Some(at), |end| Some(end + longest(tokens, *end, table)?)).last().unwrap_or(at) - at
}
