//! Reader of robot cards: from the text of `robot.toml` to a [`Robot`], with diagnostics. Every
//! named resource is declared, hands and cameras are among them, and none contains itself.

use indexmap::IndexMap;
use motet_syntax::unit::{Dimension, Unit};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Span, suggest};
use smol_str::SmolStr;
use toml::de::DeTable;

use super::diagnostics::{
    BadName, ListedTwice, NotAResource, NotToml, ResourceCycle, TakenName, TakenNumber, UnknownResource,
};
use super::model::{
    BaseSpec, BoundSpan, CameraSpec, CardSpans, Drive, HandSpec, MannerSpec, Manners, Range, Robot,
};
use super::quantity::{Greatest, QuantityReader, Sign};
use super::wire::{TomlSpanned, WrittenQuantity};
use super::{model, shape, wire};
use crate::clearance::{Clearance, ClearanceOverride};

/// Seconds within which a base reaches its speed, where its card gives no acceleration.
const BASE_RAMP: f64 = 1.0;

/// Reads the card of a robot. `declarations` is the text of its `primitives.motet`, which is kept for the
/// compiler. `None` for the robot if there is an error. O(bytes).
///
/// ```
/// use motet_robots::{builtin, card};
/// use motet_syntax::{FileId, Source};
///
/// let hsr = builtin::robot_texts("hsr").unwrap();
/// let (robot, diagnostics) = card::read(&Source::new("hsr/robot.toml", hsr.card), FileId(0), None);
/// assert_eq!(diagnostics, []);
/// assert_eq!(robot.unwrap().hands.len(), 1);
/// ```
#[must_use]
pub fn read(toml: &Source, file: FileId, declarations: Option<&str>) -> (Option<Robot>, Vec<Diagnostic>) {
    let document = match DeTable::parse(&toml.text) {
        Ok(document) => document,
        Err(problem) => return (None, vec![not_toml(&problem, file)]),
    };
    let found = shape::check(&document, file);
    if !found.is_empty() {
        return (None, sorted(found));
    }
    let card = match toml::from_str::<wire::CardTable>(&toml.text) {
        Ok(card) => card,
        Err(problem) => return (None, vec![not_toml(&problem, file)]),
    };
    let mut reader = CardReader { numbers: QuantityReader { file, found: Vec::new() } };
    let mut robot = reader.robot(&card, declarations.unwrap_or_default());
    robot.spans = reader.spans(&card, &document, &toml.name);
    let found = sorted(reader.numbers.found);
    let wrong = found.iter().any(|diagnostic| diagnostic.severity == Severity::Error);
    ((!wrong).then_some(robot), found)
}

fn sorted(mut found: Vec<Diagnostic>) -> Vec<Diagnostic> {
    found.sort_by_key(|diagnostic| diagnostic.span);
    found
}

fn not_toml(problem: &toml::de::Error, file: FileId) -> Diagnostic {
    let span = problem.span().unwrap_or_default();
    NotToml { span: Span::new(file, span.start, span.end), problem: problem.message().to_owned() }.into()
}

pub(super) struct CardReader {
    pub(super) numbers: QuantityReader,
}

impl CardReader {
    fn robot(&mut self, card: &wire::CardTable, declarations: &str) -> Robot {
        self.name(card.name.get(), self.numbers.span(&card.name));
        let base = self.base(&card.base);
        let hands: IndexMap<_, _> =
            card.hands.iter().map(|(name, hand)| (SmolStr::new(name), self.hand(name, hand.get()))).collect();
        let cameras =
            card.cameras.iter().map(|(name, camera)| (SmolStr::new(name), self.camera(name, camera.get())));
        let cameras = cameras.collect();
        let resources = self.resources(card);
        let numbers = self.named_numbers(card, &base, hands.values().next());
        let observe_within_secs =
            self.numbers.of("observe_within", &card.observe_within, Dimension::DURATION, Sign::Positive);
        Robot {
            name: card.name.get().into(),
            title: card.title.get().clone(),
            base,
            hands,
            cameras,
            model: card.model.as_ref().map(|model| self.model(model)),
            postures: card
                .postures
                .iter()
                .map(|(name, joints)| {
                    (name.into(), self.positions(&format!("postures.{name}"), joints.get()))
                })
                .collect(),
            resources,
            observes: self.observes(&card.observes),
            observe_within_secs,
            clearance: self.clearance(card),
            manners: self.manners(&card.manners),
            primitives: self.primitives(card),
            numbers,
            initially: card.initially.iter().map(|fact| fact.get().clone()).collect(),
            declarations: declarations.to_owned(),
            spans: CardSpans::default(),
        }
    }

    pub(super) fn name(&mut self, name: &str, span: Span) {
        let mut letters = name.chars();
        let starts = letters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
        if !starts || !letters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
            self.numbers.found.push(BadName { span, name: name.to_owned() }.into());
        }
    }

    fn manners(&mut self, manners: &wire::MannersTable) -> Manners {
        let default = Manners::default();
        let mut manner = |word: &str, table: Option<&wire::MannerTable>, default: MannerSpec| {
            table.map_or(default, |table| MannerSpec {
                speed: self.numbers.part(&format!("manners.{word}.speed"), &table.speed),
                acceleration: self.numbers.part(&format!("manners.{word}.acceleration"), &table.acceleration),
            })
        };
        Manners {
            slowly: manner("slowly", manners.slowly.as_ref(), default.slowly),
            gently: manner("gently", manners.gently.as_ref(), default.gently),
        }
    }

    /// Clearance of the card, or the one that its errors ask for: the base may be off in the map and off its
    /// path, the arm off its path.
    fn clearance(&mut self, card: &wire::CardTable) -> Clearance {
        let (given, errors) = (&card.clearance, &card.errors);
        let mut of = |key: &str, at: &Option<TomlSpanned<WrittenQuantity>>, greatest: Greatest| {
            at.as_ref().map(|at| self.numbers.up_to(key, at, greatest))
        };
        let localisation = of("errors.localisation", &errors.localisation, Greatest::ERROR);
        let tracking = of("errors.tracking", &errors.tracking, Greatest::ERROR).unwrap_or(0.0);
        let base_m = of("clearance.base", &given.base, Greatest::CLEARANCE);
        let arm_m = of("clearance.arm", &given.arm, Greatest::CLEARANCE);
        let derived = Clearance { base_m: localisation.unwrap_or(0.0) + tracking, arm_m: tracking };
        ClearanceOverride { base_m, arm_m }.over(derived)
    }

    fn base(&mut self, base: &wire::BaseTable) -> BaseSpec {
        let (drive, sign) = match base.drive {
            wire::DriveWord::Fixed => (Drive::Fixed, Sign::NotNegative),
            wire::DriveWord::Omnidirectional => (Drive::Omnidirectional, Sign::Positive),
            wire::DriveWord::Differential => (Drive::Differential, Sign::Positive),
            wire::DriveWord::Legged => (Drive::Legged, Sign::Positive),
        };
        let numbers = &mut self.numbers;
        let speed_m_per_s = numbers.of("base.speed", &base.speed, Dimension::SPEED, sign);
        let turn_rad_per_s = numbers.plain("base.turn", &base.turn, sign);
        let mut within = |key, given: &Option<TomlSpanned<f64>>, speed| {
            given.as_ref().map_or(speed / BASE_RAMP, |given| numbers.plain(key, given, sign))
        };
        BaseSpec {
            drive,
            speed_m_per_s,
            turn_rad_per_s,
            acceleration_m_per_s2: within("base.acceleration", &base.acceleration, speed_m_per_s),
            turn_acceleration_rad_per_s2: within(
                "base.turn_acceleration",
                &base.turn_acceleration,
                turn_rad_per_s,
            ),
            radius_m: self.numbers.of("base.radius", &base.radius, Dimension::LENGTH, Sign::Positive),
        }
    }

    fn hand(&mut self, name: &str, hand: &wire::HandTable) -> HandSpec {
        let key = |field: &str| format!("hands.{name}.{field}");
        let (points, closes) = self.directions(name, hand);
        let open = self.positions(&key("open"), &hand.open);
        let numbers = &mut self.numbers;
        HandSpec {
            payload_kg: numbers.of(&key("payload"), &hand.payload, Dimension::MASS, Sign::Positive),
            opening_m: numbers.of(&key("opening"), &hand.opening, Dimension::LENGTH, Sign::Positive),
            reach_m: numbers.of(&key("reach"), &hand.reach, Dimension::LENGTH, Sign::Positive),
            heights_m: numbers.range(&key("heights"), hand.heights.get(), Some(Dimension::LENGTH)),
            tip: hand.tip.as_ref().map(|tip| tip.get().into()),
            points,
            closes,
            open,
        }
    }

    fn camera(&mut self, name: &str, camera: &wire::CameraTable) -> CameraSpec {
        let key = |field: &str| format!("cameras.{name}.{field}");
        CameraSpec {
            range_m: self.numbers.of(&key("range"), &camera.range, Dimension::LENGTH, Sign::Positive),
            view_rad: self.numbers.of(&key("view"), &camera.view, Dimension::ANGLE, Sign::Positive),
            frame: camera.frame.as_ref().map(|frame| frame.get().into()),
        }
    }

    fn observes(&mut self, listed: &[TomlSpanned<String>]) -> Vec<SmolStr> {
        let mut first: IndexMap<&str, Span> = IndexMap::new();
        for name in listed {
            let span = self.numbers.span(name);
            self.name(name.get(), span);
            if let Some(first) = first.get(name.get().as_str()).copied() {
                self.numbers.found.push(ListedTwice { span, name: name.get().clone(), first }.into());
            } else {
                first.insert(name.get(), span);
            }
        }
        first.keys().map(SmolStr::new).collect()
    }

    fn primitives(&mut self, card: &wire::CardTable) -> IndexMap<SmolStr, IndexMap<SmolStr, Range>> {
        let mut primitives = IndexMap::new();
        for (name, bounds) in &card.primitives {
            self.name(name, self.numbers.span(bounds));
            let bounds = bounds.get().iter().map(|(param, range)| {
                let key = format!("{name}.{param}");
                (SmolStr::new(param), self.numbers.range(&key, range.get(), None))
            });
            primitives.insert(SmolStr::new(name), bounds.collect());
        }
        primitives
    }

    /// Spans of what only the compiler can check.
    fn spans(
        &mut self,
        card: &wire::CardTable,
        document: &toml::Spanned<DeTable<'_>>,
        name: &str,
    ) -> CardSpans {
        let mut found =
            CardSpans { declarations: model::beside(name, card.name.get()), ..CardSpans::default() };
        for name in &card.observes {
            found.observes.entry(name.get().into()).or_insert_with(|| self.numbers.span(name));
        }
        for (primitive, (span, params)) in model::primitives(document, self.numbers.file) {
            let bounds = card.primitives.get(primitive.as_str()).map(TomlSpanned::get);
            for (param, span) in params {
                let bound = bounds.and_then(|bounds| bounds.get(param.as_str())).map(TomlSpanned::get);
                let dimension = bound.and_then(|bound| self.numbers.written(bound));
                found.bounds.insert((primitive.clone(), param), BoundSpan { span, dimension });
            }
            found.primitives.insert(primitive, span);
        }
        found.initially = card.initially.iter().map(|fact| self.numbers.span(fact)).collect();
        found
    }

    /// Numbers that every robot has, and those of the card.
    fn named_numbers(
        &mut self,
        card: &wire::CardTable,
        base: &BaseSpec,
        hand: Option<&HandSpec>,
    ) -> IndexMap<SmolStr, (f64, SmolStr)> {
        let mut numbers: IndexMap<SmolStr, (f64, SmolStr)> = IndexMap::new();
        let mut add = |name: &'static str, value: f64, ty: &'static str| {
            numbers.insert(SmolStr::new_static(name), (value, SmolStr::new_static(ty)));
        };
        if let Some(hand) = hand {
            add("payload", hand.payload_kg, "Mass");
            add("opening", hand.opening_m, "Length");
            add("reach", hand.reach_m, "Length");
            add("lowest", hand.heights_m.least, "Length");
            add("highest", hand.heights_m.greatest, "Length");
        }
        add("speed", base.speed_m_per_s, "Speed");
        for (name, number) in &card.numbers {
            let span = self.numbers.span(number);
            self.name(name, span);
            let place = match name.as_str() {
                "payload" | "opening" | "reach" | "lowest" | "highest" => Some("hands"),
                "speed" => Some("base"),
                _ => None,
            };
            if let Some(place) = place {
                self.numbers.found.push(TakenNumber { span, name: name.clone(), place }.into());
                continue;
            }
            let Some((value, unit)) = self.numbers.any(&format!("numbers.{name}"), number) else { continue };
            let value = self.numbers.checked(&format!("numbers.{name}"), span, value, Sign::Any);
            let ty =
                unit.map_or(Some("Number"), |unit: Unit| unit.dimension().type_name()).unwrap_or("Number");
            numbers.insert(name.into(), (value, SmolStr::new_static(ty)));
        }
        numbers
    }
}

impl CardReader {
    /// Reads the resources and reports mistakes.
    pub(super) fn resources(&mut self, card: &wire::CardTable) -> IndexMap<SmolStr, Vec<SmolStr>> {
        let mut resources = IndexMap::new();
        for (name, contains) in &card.resources {
            self.name(name, self.numbers.span(contains));
            for inner in contains.get().iter().filter(|inner| !card.resources.contains_key(inner.get())) {
                let near = suggest::closest(inner.get(), card.resources.keys().map(String::as_str));
                let (span, near) = (self.numbers.span(inner), near.map(str::to_owned));
                self.numbers.found.push(UnknownResource { span, resource: inner.get().clone(), near }.into());
            }
            let contains = contains.get().iter().map(|inner| SmolStr::new(inner.get())).collect();
            resources.insert(SmolStr::new(name), contains);
        }
        for (name, span) in
            card.hands.iter().map(|(name, hand)| (name, self.numbers.span(hand))).collect::<Vec<_>>()
        {
            self.is_resource(card, "hand", name, span);
            if card.cameras.contains_key(name) {
                self.numbers.found.push(TakenName { span, name: name.clone() }.into());
            }
        }
        for (name, camera) in &card.cameras {
            self.is_resource(card, "camera", name, self.numbers.span(camera));
        }
        if let Some(chain) = cycle(&resources) {
            let first = chain.first().and_then(|name| card.resources.get(name.as_str()));
            let span = first.map(|contains| self.numbers.span(contains)).unwrap_or_default();
            let chain = chain.iter().map(ToString::to_string).collect();
            self.numbers.found.push(ResourceCycle { span, chain }.into());
        }
        resources
    }

    fn is_resource(&mut self, card: &wire::CardTable, what: &'static str, name: &str, span: Span) {
        if !card.resources.contains_key(name) {
            self.numbers.found.push(NotAResource { span, what, name: name.to_owned() }.into());
        }
    }
}

/// Finds a chain of resources that ends where it begins, by removing, again and again, those that contain no
/// remaining one.
fn cycle(resources: &IndexMap<SmolStr, Vec<SmolStr>>) -> Option<Vec<SmolStr>> {
    let mut left = resources.clone();
    loop {
        let before = left.len();
        let names: Vec<SmolStr> = left.keys().cloned().collect();
        left.retain(|_, contains| contains.iter().any(|inner| names.contains(inner)));
        if left.len() == before {
            break;
        }
    }
    // Every remaining resource contains a remaining one, so following the first of these comes back.
    let mut chain = vec![left.keys().next()?.clone()];
    loop {
        let last = left.get(chain.last()?)?;
        let next = last.iter().find(|inner| left.contains_key(*inner))?.clone();
        if let Some(at) = chain.iter().position(|seen| *seen == next) {
            let mut chain = chain.split_off(at);
            chain.push(next);
            return Some(chain);
        }
        chain.push(next);
    }
}
