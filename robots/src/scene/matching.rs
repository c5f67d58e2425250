//! Which entities a description means, and how wide a thing is.

use super::model::{Entity, EntityShape, Scene};

impl Scene {
    /// The entities that a description such as `"the red mug"` fits, in the order of the file.
    ///
    /// It fits by id, a name, the class or a category, as a whole; letter case, leading articles, and the difference of
    /// `_`, `-` and a space do not count. An empty description fits none. O(entities).
    #[must_use]
    pub fn matches(&self, description: &str) -> Vec<&Entity> {
        let wanted = normal(description);
        if wanted.is_empty() {
            return Vec::new();
        }
        self.entities.values().filter(|entity| entity.descriptions().any(|name| name == wanted)).collect()
    }
}

impl Entity {
    /// How far a hand has to open for it, in m: the width that the scene gives, else the smallest horizontal extent of
    /// the shape in its own frame. `None` where neither is known, as for a mesh.
    #[must_use]
    pub fn width(&self) -> Option<f64> {
        if let Some(width) = self.fields.get("width") {
            return Some(*width);
        }
        match self.shape.as_ref()? {
            EntityShape::Box([x, y, _]) => Some(x.min(*y)),
            EntityShape::Cylinder { radius, .. }
            | EntityShape::Sphere { radius }
            | EntityShape::Capsule { radius, .. } => Some(2.0 * radius),
            EntityShape::Mesh { .. } => None,
        }
    }

    /// Everything that it is called, as [`normal`] writes it; the same may come twice.
    pub fn descriptions(&self) -> impl Iterator<Item = String> {
        let names = [&self.id, &self.class].into_iter().chain(&self.names).chain(&self.categories);
        names.map(|name| normal(name)).filter(|name| !name.is_empty())
    }
}

/// A description as it is compared: words in lower case with single spaces between them, without leading articles.
#[must_use]
pub fn normal(text: &str) -> String {
    let is_gap = |letter: char| letter.is_whitespace() || matches!(letter, '_' | '-');
    let words = text.split(is_gap).filter(|word| !word.is_empty()).map(str::to_lowercase);
    let words: Vec<_> = words.skip_while(|word| matches!(word.as_str(), "a" | "an" | "the")).collect();
    words.join(" ")
}
