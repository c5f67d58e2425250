//! Colours of things in pictures: the one that a name of a thing says, else one of a palette.

use std::hash::Hasher as _;

use fnv::FnvHasher;

use super::model::Entity;

/// Red, green, blue.
pub type Colour = [u8; 3];

/// Colours by the words for them.
const WORDS: &[(&str, Colour)] = &[
    ("red", [200, 38, 38]),
    ("green", [64, 150, 60]),
    ("blue", [40, 84, 190]),
    ("yellow", [232, 200, 48]),
    ("orange", [236, 134, 32]),
    ("purple", [128, 62, 160]),
    ("violet", [128, 62, 160]),
    ("pink", [232, 130, 170]),
    ("brown", [122, 82, 48]),
    ("wooden", [168, 124, 76]),
    ("black", [36, 36, 40]),
    ("white", [240, 240, 238]),
    ("grey", [130, 132, 136]),
    ("gray", [130, 132, 136]),
    ("silver", [188, 192, 198]),
];
/// Colours of things in whose names there is none.
const THINGS: &[Colour] = &[
    [176, 58, 46],
    [46, 120, 130],
    [196, 152, 60],
    [92, 70, 140],
    [70, 130, 84],
    [204, 110, 76],
    [60, 96, 150],
    [150, 84, 110],
];
/// Colours of furniture.
const FURNITURE: &[Colour] =
    &[[176, 138, 96], [150, 112, 74], [194, 166, 128], [134, 120, 108], [206, 194, 172], [122, 96, 72]];

/// Colour of every person.
pub const PERSON_COLOUR: Colour = [86, 104, 142];

/// Palette for those whose names say no colour.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Palette {
    Things,
    Furniture,
}

/// Colour of an entity by its names, else one of a palette by its id, the same everywhere.
///
/// ```
/// use motet_robots::builtin;
/// use motet_robots::scene::{Palette, colour};
///
/// let kitchen = builtin::scene("kitchen").unwrap();
/// assert_eq!(colour("mug_1", kitchen.entities.get("mug_1"), Palette::Things), [200, 38, 38]);
/// ```
#[must_use]
pub fn colour(id: &str, entity: Option<&Entity>, palette: Palette) -> Colour {
    let names = entity.into_iter().flat_map(|entity| &entity.names).map(|name| name.as_str());
    let said = names.chain([id]).find_map(|name| {
        let mut words = name.split(|letter: char| !letter.is_alphanumeric());
        words.find_map(|word| WORDS.iter().find(|(known, _)| word.eq_ignore_ascii_case(known)))
    });
    if let Some((_, colour)) = said {
        return *colour;
    }
    let colours = match palette {
        Palette::Things => THINGS,
        Palette::Furniture => FURNITURE,
    };
    let mut hasher = FnvHasher::default();
    hasher.write(id.as_bytes());
    let hash = hasher.finish();
    let count = u64::try_from(colours.len()).unwrap_or(1).max(1);
    let at = usize::try_from(hash % count).unwrap_or_default();
    colours.get(at).copied().unwrap_or(PERSON_COLOUR)
}
