//! Drawing of a scene from above: its entities, the robot at the start and at the end of each path, the path
//! of its base, the doors that it moves, and a legend of all answers.

use std::collections::BTreeSet;
use std::fmt::Write;

use motet_geometry::planning::{
    Articulation, Configuration, MotionAnswer, MotionQuery, QueryContext, SceneState, UnknownReason,
};
use motet_robots::scene::Scene;

/// Pixels per metre.
const SCALE: f64 = 120.0;
/// Margin around the drawing, in m.
const MARGIN: f64 = 0.5;
/// Width of the legend and height of its lines, in pixels.
const LEGEND: [f64; 2] = [330.0, 18.0];
const STYLE: &str = ".thing{fill:#d9d4c7;stroke:#8a8576}.start{fill:#8a8a8a;fill-opacity:.35}\
                     .end{fill-opacity:.18;stroke-opacity:.5}.way{fill:none;stroke-width:2.5}\
                     .zone{fill:#e8c46a;fill-opacity:.25;stroke:#b08a2e;stroke-dasharray:4 3}\
                     .moved{fill-opacity:.12;stroke-width:1.5}.mark{fill:none;stroke:#444;stroke-width:1.5}\
                     .number{font-weight:bold;text-anchor:middle}.none{fill:#777}";
/// Colours for all kinds of colour vision (Okabe and Ito 2008), without the yellow, which is faint on white.
const COLOURS: [&str; 7] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"];
/// Dashes of the paths that share a colour.
const DASHES: [&str; 5] = ["none", "8 4", "2 3", "12 3 2 3", "5 2 1 2 1 2"];

/// Polygon with its CSS class and its line style.
struct Patch {
    class: &'static str,
    ink: Option<Ink>,
    points: Vec<[f64; 2]>,
}

/// Line style of an answer.
#[derive(Clone, Copy)]
struct Ink {
    colour: &'static str,
    dash: &'static str,
}

impl Ink {
    /// Style of the answer with this index among those with a path.
    fn of(at: usize) -> Self {
        let colour = COLOURS.get(at % COLOURS.len()).copied().unwrap_or("#000000");
        let dash = DASHES.get(at / COLOURS.len() % DASHES.len()).copied().unwrap_or("none");
        Self { colour, dash }
    }

    fn stroke(self) -> String {
        format!("stroke=\"{}\" stroke-dasharray=\"{}\"", self.colour, self.dash)
    }
}

/// Draws the scene as SVG: 120 pixels per metre, x to the right, y up, answers numbered from 1 in their
/// order.
pub(crate) fn top_view(
    room: &QueryContext<'_>,
    scene: &Scene,
    world: &SceneState,
    answers: &[(MotionQuery, MotionAnswer)],
) -> String {
    let inks = inks(answers);
    let patches = patches(room, scene, world, answers, &inks);
    let marks = marks(room, scene, world);
    let frame = Frame::around(
        patches.iter().flat_map(|patch| &patch.points).chain(marks.iter().map(|(_, place)| place)),
    );
    let [wide, high] = frame.size();
    let [legend, row] = LEGEND;
    let (width, height) = (wide + legend, high.max(row * (answers.len() as f64 + 2.0)));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n<style>{STYLE}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#faf9f6\"/>\n"
    );
    // Writing to a string does not fail.
    for Patch { class, ink, points } in &patches {
        // A robot is of many pieces, whose dashes would tell nothing.
        let stroke = |ink: Ink| if *class == "end" { Ink { dash: "none", ..ink } } else { ink }.stroke();
        let ink = ink.map(|ink| format!(" fill=\"{}\" {}", ink.colour, stroke(ink))).unwrap_or_default();
        let _ = writeln!(svg, "<polygon class=\"{class}\"{ink} points=\"{}\"/>", frame.line(points));
    }
    let mut named = BTreeSet::new();
    for (id, solid) in room.obstacles() {
        let [x, y] = frame.place([solid.centre.x, solid.centre.y]);
        if named.insert(id.clone()) {
            let _ = writeln!(
                svg,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{}</text>",
                escaped(&id)
            );
        }
    }
    for (id, place) in &marks {
        let [x, y] = frame.place(*place);
        let _ = writeln!(
            svg,
            "<path class=\"mark\" d=\"M{:.1},{y:.1}h10M{x:.1},{:.1}v10\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            x - 5.0,
            y - 5.0,
            x + 7.0,
            y - 4.0,
            escaped(id)
        );
    }
    for (((query, answer), ink), number) in answers.iter().zip(&inks).zip(1..) {
        if let (MotionAnswer::Feasible(witness), Some(ink)) = (answer, ink) {
            path(&mut svg, &frame, (number, query), &witness.path, *ink);
        }
    }
    listed(&mut svg, wide, answers, &inks);
    svg + "</svg>\n"
}

/// Line style of each answer; `None` without a path.
fn inks(answers: &[(MotionQuery, MotionAnswer)]) -> Vec<Option<Ink>> {
    let mut next = 0..;
    let ink =
        |answer: &MotionAnswer| matches!(answer, MotionAnswer::Feasible(_)).then(|| next.next().map(Ink::of));
    answers.iter().map(|(_, answer)| answer).map(ink).map(Option::flatten).collect()
}

fn patches(
    room: &QueryContext<'_>,
    scene: &Scene,
    world: &SceneState,
    answers: &[(MotionQuery, MotionAnswer)],
    inks: &[Option<Ink>],
) -> Vec<Patch> {
    let plain = |class| move |points| Patch { class, ink: None, points };
    let mut patches: Vec<Patch> = scene
        .entities
        .values()
        .filter_map(|it| world.zone(it))
        .map(|it| it.outline())
        .map(plain("zone"))
        .collect();
    let things = room.obstacles().map(|(_, solid)| solid.outline()).map(plain("thing"));
    patches.extend(things);
    patches.extend(room.robot_at(room.start()).iter().map(|solid| solid.outline()).map(plain("start")));
    for ((query, answer), ink) in answers.iter().zip(inks) {
        let MotionAnswer::Feasible(witness) = answer else { continue };
        let drawn = |class| move |points| Patch { class, ink: *ink, points };
        // A door or a drawer as it is afterwards.
        if let MotionQuery::Pull(id) | MotionQuery::Push(id) = query
            && let Some(entity) = scene.entities.get(id)
            && let Some(opening) = Articulation::new(entity, world)
        {
            let part = if world.is_open(entity) { 0.0 } else { 1.0 };
            patches.extend(opening.moving(part).iter().map(|solid| solid.outline()).map(drawn("moved")));
        }
        if let Some(last) = witness.path.last() {
            patches.extend(room.robot_at(last).iter().map(|solid| solid.outline()).map(drawn("end")));
        }
    }
    patches
}

/// Positions of the entities without a shape.
fn marks(room: &QueryContext<'_>, scene: &Scene, world: &SceneState) -> Vec<(String, [f64; 2])> {
    let solid: BTreeSet<_> = room.obstacles().map(|(id, _)| id).collect();
    let others = scene.entities.values().filter(|it| !solid.contains(&it.id) && !world.holds(&it.id));
    let place = |it: &motet_robots::scene::Entity| {
        let at = world.pose(it)?.translation.vector;
        Some((it.id.to_string(), [at.x, at.y]))
    };
    others.filter_map(place).collect()
}

/// Path of the base, with the number of its answer at the end.
fn path(
    svg: &mut String,
    frame: &Frame,
    (number, query): (usize, &MotionQuery),
    states: &[Configuration],
    ink: Ink,
) {
    let points: Vec<[f64; 2]> = states.iter().map(|state| [state.base[0], state.base[1]]).collect();
    let _ = writeln!(
        svg,
        "<polyline class=\"way\" {} points=\"{}\"><title>{}</title></polyline>",
        ink.stroke(),
        frame.line(&points),
        escaped(&query.to_string())
    );
    if let Some([x, y]) = points.last().map(|last| frame.place(*last)) {
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"8\" fill=\"#fff\" stroke=\"{0}\"/>\
             <text class=\"number\" x=\"{x:.1}\" y=\"{1:.1}\" fill=\"{0}\">{number}</text>",
            ink.colour,
            y + 4.0
        );
    }
}

/// Legend: number, line sample, motion and verdict of each answer.
fn listed(svg: &mut String, left: f64, answers: &[(MotionQuery, MotionAnswer)], inks: &[Option<Ink>]) {
    let [_, row] = LEGEND;
    for (((query, answer), ink), number) in answers.iter().zip(inks).zip(1..) {
        let y = row * (f64::from(number) + 0.5);
        if let Some(ink) = ink {
            let _ = writeln!(
                svg,
                "<path class=\"way\" {} d=\"M{:.1},{:.1}h30\"/>",
                ink.stroke(),
                left + 26.0,
                y - 4.0
            );
        }
        let verdict = match answer {
            MotionAnswer::Feasible(_) => "feasible",
            MotionAnswer::Infeasible(why) => why.reason.name(),
            MotionAnswer::Unknown(UnknownReason::Budget) => "unknown, cut short",
            MotionAnswer::Unknown(UnknownReason::Because(_)) => "unknown",
        };
        let class = if ink.is_some() { "" } else { " class=\"none\"" };
        let _ = writeln!(
            svg,
            "<text{class} x=\"{:.1}\" y=\"{y:.1}\" text-anchor=\"end\">{number}</text>\
             <text{class} x=\"{:.1}\" y=\"{y:.1}\">{}: {verdict}</text>",
            left + 20.0,
            left + 62.0,
            escaped(&query.to_string())
        );
    }
}

/// Transforms a point from the map to the drawing.
struct Frame {
    low: [f64; 2],
    high: [f64; 2],
}

impl Frame {
    fn around<'p>(points: impl Iterator<Item = &'p [f64; 2]>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for ((low, high), at) in low.iter_mut().zip(&mut high).zip(point) {
                (*low, *high) = (low.min(*at), high.max(*at));
            }
        }
        // Without anything to draw, where the robot could be.
        let [low, high] =
            if low.iter().chain(&high).all(|at| at.is_finite()) { [low, high] } else { [[0.0; 2]; 2] };
        Self { low: low.map(|low| low - MARGIN), high: high.map(|high| high + MARGIN) }
    }

    fn size(&self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]].map(|side| side * SCALE)
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.low[0]) * SCALE, (self.high[1] - y) * SCALE]
    }

    fn line(&self, points: &[[f64; 2]]) -> String {
        let places = points.iter().map(|point| self.place(*point));
        places.map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
