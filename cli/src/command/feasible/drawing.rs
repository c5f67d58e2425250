//! The room from above: what stands in it, the robot at the start and at the end of each path, and the way of its base.

use std::collections::BTreeSet;
use std::fmt::Write;

use motet_geometry::query::{Query, Room, State, Witness};

/// Pixels a metre.
const SCALE: f64 = 120.0;
/// Room around everything, in m.
const MARGIN: f64 = 0.5;
const STYLE: &str = ".thing{fill:#d9d4c7;stroke:#8a8576}.start{fill:#7f9fc0;fill-opacity:.35}\
                     .end{fill:#4f8a4e;fill-opacity:.35}.way{fill:none;stroke:#c0503c;stroke-width:2}";

/// A polygon with its class.
type Patch = (&'static str, Vec<[f64; 2]>);

/// The drawing as SVG: 120 pixels a metre, x to the right, y up.
pub(super) fn top_view(room: &Room<'_>, found: &[(Query, Witness)]) -> String {
    let mut patches: Vec<Patch> = room.obstacles().map(|(_, solid)| ("thing", solid.outline())).collect();
    let ends = found.iter().filter_map(|(_, witness)| Some(("end", witness.path.last()?)));
    for (class, state) in std::iter::once(("start", room.start())).chain(ends) {
        patches.extend(room.robot_at(state).iter().map(|solid| (class, solid.outline())));
    }
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in patches.iter().flat_map(|(_, points)| points) {
        for ((low, high), at) in low.iter_mut().zip(&mut high).zip(point) {
            (*low, *high) = (low.min(*at), high.max(*at));
        }
    }
    let ([left, bottom], [right, top]) = (low.map(|low| low - MARGIN), high.map(|high| high + MARGIN));
    let place = |[x, y]: [f64; 2]| format!("{:.1},{:.1}", (x - left) * SCALE, (top - y) * SCALE);
    let line = |points: &[[f64; 2]]| points.iter().map(|point| place(*point)).collect::<Vec<_>>().join(" ");
    let (width, height) = ((right - left) * SCALE, (top - bottom) * SCALE);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" \
         font-size=\"11\">\n<style>{STYLE}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#faf9f6\"/>\n"
    );
    for (class, points) in &patches {
        // Writing to a string does not fail.
        let _ = writeln!(svg, "<polygon class=\"{class}\" points=\"{}\"/>", line(points));
    }
    let mut named = BTreeSet::new();
    for (id, solid) in room.obstacles() {
        let at = place([solid.centre.x, solid.centre.y]);
        if let (true, Some((x, y))) = (named.insert(id.clone()), at.split_once(',')) {
            let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{}</text>", escaped(&id));
        }
    }
    for (query, witness) in found {
        let plane = |state: &State| {
            let [x, y, _] = state.base;
            [x, y]
        };
        let points: Vec<[f64; 2]> = witness.path.iter().map(plane).collect();
        let title = escaped(&query.to_string());
        let _ = writeln!(
            svg,
            "<polyline class=\"way\" points=\"{}\"><title>{title}</title></polyline>",
            line(&points)
        );
    }
    svg + "</svg>\n"
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
