//! What a household knows: what things are, what they are good for, and what belongs to what someone says they want. Short
//! on purpose: common nouns of a kitchen and a living room, no wordings. A scene's own categories count beside it.

/// What a thing with this name is.
const IS: &[(&str, &[&str])] = &[
    // Drinks, by what is in them.
    ("water", &["drink", "hydrating"]),
    ("coke", &["cola", "soda", "drink", "sugary", "can", "caffeinated"]),
    ("cola", &["soda", "drink", "sugary", "can", "caffeinated"]),
    ("pepsi", &["cola", "soda", "drink", "sugary", "can", "caffeinated"]),
    ("sprite", &["soda", "drink", "sugary", "can"]),
    ("fanta", &["soda", "drink", "sugary", "can"]),
    ("7up", &["soda", "drink", "sugary", "can"]),
    ("lemonade", &["soda", "drink", "sugary"]),
    ("soda", &["drink", "sugary", "can"]),
    ("redbull", &["energy drink", "drink", "sugary", "can", "caffeinated"]),
    ("energy drink", &["drink", "sugary", "can", "caffeinated"]),
    ("sports drink", &["drink", "hydrating"]),
    ("tea", &["drink", "caffeinated"]),
    ("coffee", &["drink", "caffeinated"]),
    ("juice", &["drink", "sugary"]),
    ("milk", &["drink"]),
    ("beer", &["drink", "can"]),
    ("wine", &["drink"]),
    ("smoothie", &["drink"]),
    // Food.
    ("apple", &["fruit", "food", "healthy"]),
    ("banana", &["fruit", "food", "healthy"]),
    ("orange", &["fruit", "food", "healthy"]),
    ("pear", &["fruit", "food", "healthy"]),
    ("peach", &["fruit", "food", "healthy"]),
    ("plum", &["fruit", "food", "healthy"]),
    ("grape", &["fruit", "food", "healthy"]),
    ("lemon", &["fruit", "food"]),
    ("lime", &["fruit", "food"]),
    ("kiwi", &["fruit", "food", "healthy"]),
    ("mango", &["fruit", "food", "healthy"]),
    ("strawberry", &["fruit", "food", "healthy"]),
    ("fruit", &["food", "healthy"]),
    ("carrot", &["vegetable", "food", "healthy"]),
    ("tomato", &["vegetable", "food", "healthy"]),
    ("cucumber", &["vegetable", "food", "healthy"]),
    ("chip", &["crisp", "snack", "food", "bag", "salty"]),
    ("crisp", &["chip", "snack", "food", "bag", "salty"]),
    ("pretzel", &["snack", "food", "salty"]),
    ("cracker", &["snack", "food", "salty"]),
    ("popcorn", &["snack", "food"]),
    ("nut", &["snack", "food"]),
    ("cookie", &["biscuit", "snack", "food", "sugary", "sweet"]),
    ("biscuit", &["cookie", "snack", "food", "sugary", "sweet"]),
    ("chocolate", &["candy", "sweet", "snack", "food", "sugary"]),
    ("candy", &["sweet", "snack", "food", "sugary"]),
    ("energy bar", &["snack", "food"]),
    ("granola bar", &["snack", "food"]),
    ("protein bar", &["snack", "food"]),
    ("snack", &["food"]),
    ("bread", &["food"]),
    ("sandwich", &["food", "snack"]),
    ("cheese", &["food"]),
    ("yogurt", &["food"]),
    ("yoghurt", &["food"]),
    ("cereal", &["food"]),
    ("soup", &["food"]),
    ("cake", &["food", "sweet"]),
    // Things of the house.
    ("sponge", &["cleaning"]),
    ("cloth", &["cleaning"]),
    ("towel", &["cleaning"]),
    ("rag", &["cleaning"]),
    ("brush", &["cleaning"]),
    ("mop", &["cleaning"]),
    ("wipe", &["cleaning"]),
    ("napkin", &["cleaning"]),
    ("tissue", &["cleaning"]),
    ("mug", &["cup", "drinkware", "dishes"]),
    ("cup", &["drinkware", "dishes"]),
    ("glass", &["drinkware", "dishes"]),
    ("plate", &["dishes"]),
    ("bowl", &["dishes"]),
    ("fork", &["cutlery"]),
    ("knife", &["cutlery", "cutting"]),
    ("spoon", &["cutlery"]),
    ("scissors", &["cutting", "tool"]),
    ("pen", &["writing"]),
    ("pencil", &["writing"]),
    ("marker", &["writing"]),
    ("book", &["reading"]),
    ("magazine", &["reading"]),
    ("newspaper", &["paper", "reading"]),
    ("blanket", &["warm"]),
    ("ball", &["toy"]),
    ("doll", &["toy"]),
    ("teddy", &["toy"]),
    ("remote", &["remote control"]),
    ("remote control", &["remote", "controller"]),
    ("screwdriver", &["tool"]),
    ("hammer", &["tool"]),
    ("wrench", &["tool", "spanner"]),
    // Furniture.
    ("counter", &["countertop", "worktop"]),
    ("worktop", &["counter"]),
    ("cupboard", &["cabinet"]),
    ("cabinet", &["cupboard"]),
    ("fridge", &["refrigerator"]),
    ("refrigerator", &["fridge"]),
    ("sofa", &["couch"]),
    ("couch", &["sofa"]),
    (
        "trash",
        &["bin", "garbage", "rubbish", "waste", "trash can", "garbage can", "can", "wastebasket", "dustbin"],
    ),
    ("bin", &["trash", "garbage", "rubbish", "waste", "trash can", "garbage can", "wastebasket", "dustbin"]),
    ("trash can", &["bin", "trash", "garbage", "rubbish", "waste", "garbage can", "wastebasket", "dustbin"]),
    ("dock", &["charger", "charging station"]),
    ("shelf", &["rack", "bookshelf"]),
];

/// What someone does with a thing, and what it then is.
const FOR: &[(&str, &str)] = &[
    ("eat", "food"),
    ("nibble", "snack"),
    ("munch", "snack"),
    ("drink", "drink"),
    ("sip", "drink"),
    ("clean", "cleaning"),
    ("wipe", "cleaning"),
    ("mop", "cleaning"),
    ("scrub", "cleaning"),
    ("dry", "cleaning"),
    ("read", "reading"),
    ("write", "writing"),
    ("cut", "cutting"),
    ("play", "toy"),
];

/// Words that say how a thing is packed and not what it is.
const PACKAGES: &[&str] = &[
    "can", "bottle", "bag", "pack", "packet", "package", "box", "carton", "cup", "glass", "tin", "jar",
    "piece", "bar",
];

/// Words that a category goes by beside its own.
const SAME: &[(&str, &str)] = &[
    ("beverage", "drink"),
    ("refreshment", "drink"),
    ("fizzy drink", "soda"),
    ("soft drink", "soda"),
    ("pop", "soda"),
    ("treat", "snack"),
    ("bite", "snack"),
    ("sweetened", "sugary"),
    ("thirst quenching", "hydrating"),
    ("silverware", "cutlery"),
    ("crockery", "dishes"),
    ("dish", "dishes"),
    ("cleaner", "cleaning"),
    ("meal", "food"),
];

/// What a thing with a name is, beside what it is called: `coke` is a `drink`. The longest ending of the name counts: an
/// `energy bar` is not any bar, and a `lime soda` is no lime.
pub(super) fn is(name: &[String]) -> &'static [&'static str] {
    for start in 0..name.len() {
        let ending = name.get(start..).unwrap_or_default().join(" ");
        if let Some((_, what)) = IS.iter().find(|(known, _)| *known == ending) {
            return what;
        }
    }
    // `water bottle`: what is in it.
    match name {
        [rest @ .., last] if !rest.is_empty() && is_package(last) => is(rest),
        _ => &[],
    }
}

/// What a thing is that someone eats, drinks, cleans with.
pub(super) fn good_for(verb: &str) -> Option<&'static str> {
    FOR.iter().find(|(known, _)| *known == verb).map(|(_, what)| *what)
}

/// Whether a word says how a thing is packed.
pub(super) fn is_package(word: &str) -> bool {
    PACKAGES.contains(&word)
}

/// Whether something that is called so has in it what the words before say: a `water bottle`, but not a `water glass`.
pub(super) fn holds(word: &str) -> bool {
    matches!(word, "can" | "bottle" | "bag" | "pack" | "packet" | "carton" | "tin" | "jar")
}

/// Words that mean what they say and are no slip of a name that is near: `cold` is not `cola`.
const ORDINARY: &[&str] = &[
    "back", "bad", "bare", "best", "better", "bit", "black", "blank", "blue", "bold", "broken", "brown",
    "call", "calm", "card", "care", "case", "charge", "cheap", "clean", "clear", "close", "closed", "coat",
    "code", "coin", "cold", "color", "colour", "cook", "cool", "cord", "core", "corn", "cost", "cover",
    "damp", "dark", "dirty", "door", "dry", "empty", "face", "fast", "fat", "fine", "fire", "flat", "floor",
    "food", "foot", "fork", "free", "fresh", "front", "full", "game", "glad", "gold", "gray", "green",
    "grey", "half", "hand", "hard", "head", "heat", "heavy", "help", "here", "high", "hot", "house", "huge",
    "ice", "iced", "job", "key", "kind", "lamp", "large", "last", "late", "left", "lid", "light", "like",
    "line", "list", "little", "lock", "long", "loose", "lot", "low", "main", "mark", "mess", "metal",
    "middle", "most", "name", "near", "neat", "new", "next", "nice", "noise", "note", "odd", "old", "only",
    "orange", "other", "page", "paint", "pale", "pan", "part", "phone", "pink", "place", "plain", "point",
    "pot", "purple", "rest", "rich", "right", "ring", "road", "roll", "room", "rope", "round", "same",
    "sharp", "sheet", "shelf", "ship", "shirt", "shoe", "short", "side", "sign", "silver", "size", "slow",
    "small", "smell", "smooth", "soap", "sock", "soft", "some", "song", "sore", "sour", "spare", "spot",
    "square", "stain", "step", "stick", "still", "stone", "store", "straight", "strong", "stuff", "sweet",
    "tail", "tall", "tape", "team", "thick", "thin", "thing", "time", "tiny", "toe", "top", "town", "trip",
    "true", "wall", "warm", "wash", "wet", "white", "whole", "wide", "wild", "wind", "window", "wine",
    "wire", "wise", "wood", "wooden", "word", "work", "wrong", "yellow", "young",
];

/// Whether a word is an ordinary one.
pub(super) fn is_ordinary(word: &str) -> bool {
    ORDINARY.binary_search(&word).is_ok()
}

/// A category by its usual word.
pub(super) fn usual(words: &str) -> Option<&'static str> {
    SAME.iter().find(|(known, _)| *known == words).map(|(_, what)| *what)
}

/// Every word of the tables, for the reader of misspelt words.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let things = IS.iter().flat_map(|(name, what)| std::iter::once(*name).chain(what.iter().copied()));
    things.chain(SAME.iter().map(|(word, _)| *word)).flat_map(|name| name.split(' '))
}
