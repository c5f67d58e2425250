//! Maps of occupied cells as ROS map servers write them: a YAML file beside an image. The YAML is one flat
//! mapping; anything else in it is a mistake with its line.

use motet_stdlib::lang::kinds;
use motet_syntax::{Diagnostic, FileId, Severity, Source, Span, suggest};
use smol_str::format_smolstr;

use super::diagnostics::{MapImage, MapValue, NotImported, TooManySolids};
use super::solid::{MAX_SOLIDS, entity};
use super::{raster, rectangle};
use crate::scene::{EntityShape, Placement, Scene};

/// Keys that a map has to have, in the order of the map servers' documentation.
const NEEDED: [&str; 6] = ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"];
/// Greatest edge of a cell and greatest distance of the map's corner, in m.
const FURTHEST_M: f64 = 1000.0;
/// Number of wrong lines after which no more are read.
const MAX_FINDINGS: usize = 100;

/// Meaning of the grey values between both thresholds.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum MapMode {
    /// Each cell is occupied, free or unknown.
    #[default]
    Trinary,
    /// As `Trinary` for what counts as occupied; cells that are not opaque are unknown.
    Scale,
    /// The grey value is the occupancy in per cent; what is above 100 is unknown.
    Raw,
}

/// Use of cells that are neither occupied nor free.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum UnknownCells {
    /// Nothing stands there.
    #[default]
    Free,
    /// Something may stand there.
    Occupied,
}

/// Options of the conversion of a map to a scene.
#[derive(Clone, PartialEq, Debug)]
pub struct MapOptions {
    /// Height of the walls in m.
    pub height_m: f64,
    /// Use of cells that are neither occupied nor free.
    pub unknown: UnknownCells,
    /// Edge, in cells, of the squares that count as one cell, occupied if any of them is.
    pub coarsen: usize,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self { height_m: 2.0, unknown: UnknownCells::Free, coarsen: 1 }
    }
}

/// YAML file of a map. The resolution is above zero and the thresholds are from 0 to 1.
#[derive(Clone, PartialEq, Debug)]
pub struct MapFile {
    /// File of the image, as seen from the folder of the YAML.
    pub image: String,
    /// Span of the name of the image.
    pub image_span: Span,
    /// Edge of a cell in m.
    pub resolution_m: f64,
    /// Pose of the lower left corner: x, y in m and yaw in rad.
    pub origin: [f64; 3],
    /// True where white is occupied.
    pub is_negated: bool,
    /// Occupancy above which a cell is occupied.
    pub occupied_threshold: f64,
    /// Occupancy below which a cell is free.
    pub free_threshold: f64,
    pub mode: MapMode,
}

/// Reads the YAML of a map; `None` if there is an error. O(bytes).
#[must_use]
pub fn read_map(source: &Source, file: FileId) -> (Option<MapFile>, Vec<Diagnostic>) {
    let mut reader = Reader { entries: Vec::new(), found: Vec::new() };
    reader.lines(&source.text, file);
    let end = Span::new(file, source.text.len(), source.text.len());
    for key in NEEDED {
        if !reader.entries.iter().any(|entry| entry.key == key) && reader.found.is_empty() {
            reader
                .found
                .push(MapValue { span: end, problem: format!("the map has no `{key}`"), near: None }.into());
        }
    }
    let map = reader.map();
    let is_wrong = reader.found.iter().any(|said| said.severity == Severity::Error);
    (map.filter(|_| !is_wrong), reader.found)
}

/// Value of a key; a list has one text per part.
struct Entry<'t> {
    key: &'t str,
    values: Vec<&'t str>,
    span: Span,
}

struct Reader<'t> {
    entries: Vec<Entry<'t>>,
    found: Vec<Diagnostic>,
}

impl<'t> Reader<'t> {
    fn wrong(&mut self, span: Span, problem: String, near: Option<&str>) {
        self.found.push(MapValue { span, problem, near: near.map(str::to_owned) }.into());
    }

    fn lines(&mut self, text: &'t str, file: FileId) {
        let mut at = 0;
        for (number, whole) in text.split_inclusive('\n').enumerate() {
            let start = at + (whole.len() - whole.trim_start().len());
            at += whole.len();
            let line = without_comment(whole).trim();
            let span = Span::new(file, start.min(at), (start + line.len()).min(at));
            if self.found.len() >= MAX_FINDINGS {
                let problem =
                    format!("more than {MAX_FINDINGS} lines are wrong; those from here on are not read");
                return self.wrong(span, problem, None);
            }
            if line.is_empty() || line == "---" || line == "..." || line.starts_with('%') {
                continue;
            }
            // A list with one part on a line, under its key.
            if let Some(part) = line.strip_prefix("- ") {
                match self.entries.last_mut() {
                    Some(entry) if entry.values.last().is_none_or(|value| !value.is_empty()) => {
                        entry.values.push(unquoted(part));
                    }
                    _ => self.wrong(span, format!("line {} is a part of no list", number + 1), None),
                }
                continue;
            }
            let Some((key, value)) = line.split_once(':') else {
                self.wrong(span, format!("line {} is not `key: value`", number + 1), None);
                continue;
            };
            let (key, value) = (unquoted(key), value.trim());
            let list = value.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
            let values = match list {
                Some(parts) => parts.split(',').map(unquoted).collect(),
                None if value.is_empty() => Vec::new(),
                None => vec![unquoted(value)],
            };
            let is_known = NEEDED.contains(&key) || key == "mode";
            let keys = NEEDED.into_iter().chain(["mode"]);
            let near = if is_known { None } else { suggest::closest(key, keys) };
            match near {
                _ if self.entries.iter().any(|entry| entry.key == key) => {
                    self.wrong(span, format!("`{}` is there twice", key.escape_debug()), None);
                }
                Some(near) if !self.entries.iter().any(|entry| entry.key == near) => {
                    self.wrong(span, format!("a map has no key `{}`", key.escape_debug()), Some(near));
                }
                _ if !is_known => {
                    let part = format!("the key `{}`", key.escape_debug());
                    let reason = "map servers do not use it".to_owned();
                    self.found.push(NotImported { span, part, reason }.into());
                }
                _ => self.entries.push(Entry { key, values, span }),
            }
        }
    }

    fn entry(&self, key: &str) -> Option<(Span, Vec<&'t str>)> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        Some((entry.span, entry.values.clone()))
    }

    fn word(&mut self, key: &str) -> Option<(Span, &'t str)> {
        let (span, values) = self.entry(key)?;
        if let [word] = values.as_slice()
            && !word.is_empty()
        {
            return Some((span, word));
        }
        self.wrong(span, format!("`{key}` has {} values, but needs one", values.len()), None);
        None
    }

    fn numbers<const N: usize>(&mut self, key: &str) -> Option<(Span, [f64; N])> {
        let (span, values) = self.entry(key)?;
        let numbers: Option<Vec<f64>> = values.iter().map(|word| word.parse().ok()).collect();
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        let numbers = numbers.filter(|numbers| numbers.iter().all(|number| number.abs() <= FURTHEST_M));
        if numbers.is_none() {
            let text = values.join(", ");
            let wanted = if N == 1 { "one number" } else { "three numbers `[x, y, yaw]`" };
            let problem =
                format!("`{key}` is `{}`, but must be {wanted} up to {FURTHEST_M}", text.escape_debug());
            self.wrong(span, problem, None);
        }
        numbers.map(|numbers| (span, numbers))
    }

    fn threshold(&mut self, key: &str) -> Option<f64> {
        let (span, [value]) = self.numbers(key)?;
        if !(0.0..=1.0).contains(&value) {
            self.wrong(span, format!("`{key}` is {value}, but must be from 0 to 1"), None);
        }
        Some(value)
    }

    fn map(&mut self) -> Option<MapFile> {
        let image = self.word("image");
        let resolution = self.numbers::<1>("resolution");
        let origin = self.numbers::<3>("origin");
        let negate = self.word("negate");
        let (occupied, free) = (self.threshold("occupied_thresh"), self.threshold("free_thresh"));
        let mode = self.word("mode");
        let (span, [resolution_m]) = resolution?;
        if resolution_m < 1e-3 {
            self.wrong(span, format!("`resolution` is {resolution_m} m, but must be at least 0.001 m"), None);
        }
        let (span, negate) = negate?;
        let is_negated = match negate {
            "0" | "false" => false,
            "1" | "true" => true,
            other => {
                self.wrong(span, format!("`negate` is `{}`, but must be 0 or 1", other.escape_debug()), None);
                return None;
            }
        };
        let mode = match mode {
            None | Some((_, "trinary")) => MapMode::Trinary,
            Some((_, "scale")) => MapMode::Scale,
            Some((_, "raw")) => MapMode::Raw,
            Some((span, other)) => {
                let near = suggest::closest(other, ["trinary", "scale", "raw"]);
                let other = other.escape_debug();
                self.wrong(span, format!("`mode` is `{other}`, but must be trinary, scale or raw"), near);
                return None;
            }
        };
        let ((image_span, image), (occupied_threshold, free_threshold)) = (image?, (occupied?, free?));
        if free_threshold > occupied_threshold {
            let problem =
                format!("`free_thresh` is {free_threshold}, above `occupied_thresh` {occupied_threshold}");
            self.wrong(span, problem, None);
        }
        Some(MapFile {
            image: image.to_owned(),
            image_span,
            resolution_m,
            origin: origin?.1,
            is_negated,
            occupied_threshold,
            free_threshold,
            mode,
        })
    }
}

fn without_comment(line: &str) -> &str {
    let starts = |at: &usize| {
        let before = line.get(..*at).unwrap_or_default();
        before.is_empty() || before.ends_with(char::is_whitespace)
    };
    let comment = line.match_indices('#').map(|(at, _)| at).find(starts);
    line.get(..comment.unwrap_or(line.len())).unwrap_or_default()
}

fn unquoted(text: &str) -> &str {
    let text = text.trim();
    let within = |quote: char| text.strip_prefix(quote)?.strip_suffix(quote);
    within('"').or_else(|| within('\'')).unwrap_or(text)
}

impl MapFile {
    /// Makes a scene whose walls cover the occupied cells, each cell once.
    ///
    /// # Errors
    ///
    /// The image is no whole PGM or PNG, or there are more than [`MAX_SOLIDS`] walls. Both have the span of
    /// the image's name in the YAML.
    pub fn scene(&self, image: &[u8], options: &MapOptions) -> Result<Scene, Box<Diagnostic>> {
        let span = self.image_span;
        let raster = raster::read(image)
            .map_err(|problem| Box::new(MapImage { span, image: self.image.clone(), problem }.into()))?;
        let size = options.coarsen.clamp(1, raster.width.max(raster.height));
        let (width, height) = (raster.width.div_ceil(size), raster.height.div_ceil(size));
        let mut occupied = vec![false; width * height];
        // Rows are counted from the bottom, where the origin is.
        for (cell, grey) in raster.grey.iter().enumerate() {
            let is_opaque = !raster.transparent.get(cell).copied().unwrap_or_default();
            let row = (raster.height - 1 - cell / raster.width) / size;
            let at = row * width + cell % raster.width / size;
            if self.is_occupied(*grey, is_opaque, options.unknown)
                && let Some(it) = occupied.get_mut(at)
            {
                *it = true;
            }
        }
        let walls = rectangle::cover(&occupied, width);
        if walls.len() > MAX_SOLIDS {
            return Err(Box::new(TooManySolids { span, count: walls.len() }.into()));
        }
        let edge_m = self.resolution_m * f64::from(u32::try_from(size).unwrap_or(u32::MAX));
        let mut scene = Scene::default();
        for (number, wall) in walls.iter().enumerate() {
            let id = format_smolstr!("wall_{}", number + 1);
            let wall = self.wall(wall, edge_m, options.height_m);
            scene.entities.insert(id.clone(), entity(id, kinds::ENTITY, wall.0, EntityShape::Box(wall.1)));
        }
        Ok(scene)
    }

    /// Pose and extents of a wall.
    fn wall(&self, wall: &rectangle::Rectangle, edge_m: f64, height_m: f64) -> (Placement, [f64; 3]) {
        let along = |[first, last]: [usize; 2]| {
            let [first, last] = [first, last].map(|at| f64::from(u32::try_from(at).unwrap_or(u32::MAX)));
            ((first + last) / 2.0 * edge_m, (last - first) * edge_m)
        };
        let ((x, length), (y, depth)) = (along(wall.columns), along(wall.rows));
        let [from_x, from_y, yaw] = self.origin;
        let (sin, cos) = libm::sincos(yaw);
        let xyz = [from_x + cos * x - sin * y, from_y + sin * x + cos * y, height_m / 2.0];
        (
            Placement { xyz: xyz.map(micrometres), rpy: [0.0, 0.0, yaw] },
            [length, depth, height_m].map(micrometres),
        )
    }

    /// Checks if a cell counts as occupied: its occupancy is above the threshold, or it is unknown and
    /// unknown cells count.
    fn is_occupied(&self, grey: u8, is_opaque: bool, unknown: UnknownCells) -> bool {
        let occupancy = match self.mode {
            MapMode::Raw if grey > 100 => None,
            MapMode::Raw => Some(f64::from(grey) / 100.0),
            MapMode::Scale if !is_opaque => None,
            MapMode::Trinary | MapMode::Scale => {
                let white = f64::from(grey) / 255.0;
                Some(if self.is_negated { white } else { 1.0 - white })
            }
        };
        match occupancy {
            Some(occupancy) if occupancy > self.occupied_threshold => true,
            Some(occupancy) if occupancy < self.free_threshold => false,
            Some(_) | None => unknown == UnknownCells::Occupied,
        }
    }
}

/// Rounds to micrometres, so that sums of resolutions are written short.
fn micrometres(length_m: f64) -> f64 {
    (length_m * 1e6).round() / 1e6
}
