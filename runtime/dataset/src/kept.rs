//! JSON of scenes and images within the rows of a scene that are kept in a file.

/// Scenes by name, each as the text of its file.
pub(crate) mod scenes {
    use indexmap::IndexMap;
    use motet_robots::scene::{self, Scene};
    use motet_syntax::{FileId, Source};
    use serde::de::Error as _;
    use serde::{Deserialize as _, Deserializer, Serializer};
    use smol_str::SmolStr;

    pub(crate) fn serialize<S: Serializer>(
        scenes: &IndexMap<SmolStr, Scene>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.collect_map(scenes.iter().map(|(name, scene)| (name, scene::write(scene))))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<IndexMap<SmolStr, Scene>, D::Error> {
        let texts = IndexMap::<SmolStr, String>::deserialize(from)?;
        let read = |(name, text): (SmolStr, String)| {
            let scene = scene::read(&Source::new("scene.json", text), FileId(0)).0;
            scene.map(|scene| (name, scene)).ok_or_else(|| D::Error::custom("a scene cannot be read"))
        };
        texts.into_iter().map(read).collect()
    }
}

/// Images by path, in base64.
pub(crate) mod images {
    use std::collections::BTreeMap;

    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use serde::de::Error as _;
    use serde::{Deserialize as _, Deserializer, Serializer};
    use smol_str::SmolStr;

    use crate::picture::Picture;

    pub(crate) fn serialize<S: Serializer>(
        images: &BTreeMap<SmolStr, Picture>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.collect_map(images.iter().map(|(path, image)| (path, STANDARD.encode(&image.0))))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<BTreeMap<SmolStr, Picture>, D::Error> {
        let texts = BTreeMap::<SmolStr, String>::deserialize(from)?;
        let read = |(path, text): (SmolStr, String)| {
            let bytes = STANDARD.decode(text).map_err(D::Error::custom)?;
            Ok((path, Picture(bytes.into())))
        };
        texts.into_iter().map(read).collect()
    }
}
