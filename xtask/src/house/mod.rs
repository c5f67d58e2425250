//! Measures of the code, each held to a limit in `xtask/house.toml`.
//!
//! The measures read text, not types: they look for declarations at the beginning of a line, as rustfmt
//! leaves them.

mod codes;
mod docs;
mod files;
mod imports;
mod layers;
mod library;
mod names;
mod repeats;

use std::collections::BTreeMap;
use std::path::Path;

use files::SourceFile;
use serde::Deserialize;

/// The contents of `xtask/house.toml`.
#[derive(Deserialize)]
struct House {
    layers: Vec<String>,
    stages: Vec<String>,
    measures: BTreeMap<String, Bounds>,
}

/// The bounds of one figure: `limit` must hold now, `aim` is where it goes.
#[derive(Deserialize)]
struct Bounds {
    limit: f64,
    aim: f64,
}

/// One figure, with the places that it counts.
struct Measure {
    name: &'static str,
    figure: f64,
    places: Vec<String>,
}

impl Measure {
    fn count(name: &'static str, places: Vec<String>) -> Self {
        Self { name, figure: places.len() as f64, places }
    }

    fn figure(name: &'static str, figure: f64) -> Self {
        Self { name, figure, places: Vec::new() }
    }

    /// Whether the figure is within `limit`: below it, or above it for a measure named `…-at-least`.
    fn holds(&self, limit: f64) -> bool {
        if self.name.ends_with("-at-least") { self.figure >= limit } else { self.figure <= limit }
    }
}

/// Measures the workspace at `root` and prints each figure beside its limit. Returns whether all limits hold.
///
/// # Errors
///
/// A message where a file cannot be read, git does not answer, or an option is unknown.
pub(crate) fn run(root: &Path, options: &[&str]) -> Result<bool, String> {
    let (mut list, mut under) = (None, None);
    let mut rest = options.iter();
    while let Some(option) = rest.next() {
        let value = rest.next().ok_or_else(|| format!("`{option}` needs a value"))?;
        match *option {
            "--list" => list = Some(*value),
            "--under" => under = Some(*value),
            _ => return Err(format!("unknown option `{option}`\n{}", super::USAGE)),
        }
    }
    let text = std::fs::read_to_string(root.join("xtask/house.toml")).map_err(|error| error.to_string())?;
    let house: House = toml::from_str(&text).map_err(|error| format!("xtask/house.toml: {error}"))?;
    let mut files = files::tracked(root)?;
    let mut upward = layers::upward(root, &house.layers)?;
    let mut measures = Vec::new();
    // Circles and shared names need the whole workspace; the folder then selects among the places found.
    let mut whole = vec![names::shared(&files, &house.stages)];
    whole.extend(imports::circles(&files));
    whole.push(Measure::count("equal-places", repeats::equal(&files)));
    let table = std::fs::read_to_string(root.join("ARCHITECTURE.md")).map_err(|error| error.to_string())?;
    whole.push(codes::misplaced(&files, &table));
    whole.push(library::spelled(&files, &library::declared(root)?));
    if let Some(under) = under {
        files.retain(|file| file.path.starts_with(under));
        upward.retain(|place| place.starts_with(under));
        for measure in &mut whole {
            measure.places.retain(|place| place.contains(under));
            measure.figure = measure.places.len() as f64;
        }
    }
    measures.extend(docs::measures(&files));
    measures.extend(whole);
    measures.extend(files::measures(&files));
    measures.push(Measure::count("upward-arrows", upward));

    if let Some(list) = list {
        let measure = measures
            .iter()
            .find(|measure| measure.name == list)
            .ok_or_else(|| format!("no measure `{list}`; there are {}", known(&measures)))?;
        measure.places.iter().for_each(|place| println!("{place}"));
    }
    let mut holds = true;
    for measure in &measures {
        let figure = (measure.figure * 10.0).round() / 10.0;
        match house.measures.get(measure.name).filter(|_| under.is_none()) {
            Some(Bounds { limit, aim }) => {
                let mark = if measure.holds(*limit) { "   " } else { "!! " };
                holds &= measure.holds(*limit);
                println!("{mark}{:36} {figure:>9}   limit {limit:>7}   aim {aim:>6}", measure.name);
            }
            None => println!("   {:36} {figure:>9}", measure.name),
        }
    }
    Ok(holds)
}

fn known(measures: &[Measure]) -> String {
    measures.iter().map(|measure| measure.name).collect::<Vec<_>>().join(", ")
}

/// Whether `file` counts as source: part of a crate that ships, not one of its tests.
fn is_source(file: &SourceFile) -> bool {
    !file.is_test
}
