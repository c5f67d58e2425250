//! Reader of COLLADA meshes (`.dae`), from XML to triangles.
//!
//! The unit of the file scales its coordinates to m. The axis that it calls up is not applied, as in RViz and
//! MoveIt: URDFs of ROS expect that. Materials, lights, cameras, skins and animations are skipped.

use motet_syntax::xml::{CrowdedElement, crowded};
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::HashMap;

use super::triangle::{MAX_TRIANGLES, Triangle, too_many};

/// Greatest number of XML nodes, and depth of nodes of the scene.
const MAX_NODES: u32 = 500_000;
const MAX_DEPTH: usize = 64;
/// Greatest number of shapes that the scene places.
const MAX_SHAPES: usize = 10_000;

/// Affine map: three rows of four numbers.
type Matrix = [[f64; 4]; 3];

const IDENTITY: Matrix = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// Reads the triangles of a file, in m.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not UTF-8".to_owned())?;
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, entity_resolver: None };
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if let Some(CrowdedElement { what, limit, .. }) = crowded(text) {
        return Err(format!("it has more than {limit} {what}"));
    }
    let xml =
        Document::parse_with_options(text, options).map_err(|error| format!("it is no XML: {error}"))?;
    let root = xml.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err("it is no COLLADA document".to_owned());
    }
    let unit =
        child(root, "asset").and_then(|asset| child(asset, "unit")).and_then(|unit| unit.attribute("meter"));
    let unit: f64 =
        unit.map_or(Ok(1.0), |text| text.trim().parse().map_err(|_| format!("its unit is `{text}`")))?;
    if !unit.is_finite() || unit <= 0.0 {
        return Err(format!("its unit is {unit} m"));
    }
    let ids = root.descendants().filter_map(|node| Some((node.attribute("id")?, node)));
    let mut reader = Reader { ids: ids.collect(), triangles: Vec::new(), shapes: 0 };
    let scale = scaling([unit; 3]);
    let scene = child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene"));
    match scene.and_then(|scene| reader.target(scene, "url")) {
        Some(scene) => {
            for node in children(scene, "node") {
                reader.node(node, &scale, 0)?;
            }
        }
        // Without a scene every geometry is where it is.
        None => {
            for geometry in root.descendants().filter(|node| node.tag_name().name() == "geometry") {
                reader.geometry(geometry, &scale)?;
            }
        }
    }
    Ok(reader.triangles)
}

struct Reader<'a, 't> {
    ids: HashMap<&'a str, Node<'a, 't>>,
    triangles: Vec<Triangle>,
    shapes: usize,
}

impl<'a, 't> Reader<'a, 't> {
    /// Element that an attribute `#ID` names.
    fn target(&self, node: Node<'a, 't>, attribute: &str) -> Option<Node<'a, 't>> {
        self.ids.get(node.attribute(attribute)?.strip_prefix('#')?).copied()
    }

    /// Takes in a node of the scene with all below it.
    fn node(&mut self, node: Node<'a, 't>, above: &Matrix, depth: usize) -> Result<(), String> {
        if depth > MAX_DEPTH {
            return Err(format!("its nodes are nested more than {MAX_DEPTH} deep"));
        }
        let mut own = *above;
        for part in node.children().filter(Node::is_element) {
            match part.tag_name().name() {
                "matrix" | "translate" | "rotate" | "scale" => own = then(&own, &transform(part)?),
                "node" => self.node(part, &own, depth + 1)?,
                "instance_node" => {
                    if let Some(other) = self.target(part, "url") {
                        self.node(other, &own, depth + 1)?;
                    }
                }
                "instance_geometry" => {
                    let geometry = self.target(part, "url").ok_or("it places a geometry that it lacks")?;
                    self.geometry(geometry, &own)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn geometry(&mut self, geometry: Node<'a, 't>, place: &Matrix) -> Result<(), String> {
        self.shapes += 1;
        if self.shapes > MAX_SHAPES {
            return Err(format!("it places more than {MAX_SHAPES} geometries"));
        }
        let Some(mesh) = child(geometry, "mesh") else { return Ok(()) };
        for shape in mesh.children().filter(Node::is_element) {
            let corners = match shape.tag_name().name() {
                "triangles" => self.polygons(shape, None)?,
                "polylist" => {
                    let counts =
                        child(shape, "vcount").map_or("", |counts| counts.text().unwrap_or_default());
                    let counts: Option<Vec<usize>> =
                        counts.split_ascii_whitespace().map(|word| word.parse().ok()).collect();
                    self.polygons(shape, Some(counts.ok_or("a `vcount` has a word that is no number")?))?
                }
                "polygons" => {
                    let lists = children(shape, "p").map(|list| self.corners(shape, list));
                    lists.collect::<Result<Vec<_>, _>>()?
                }
                _ => continue,
            };
            for polygon in corners {
                let placed: Vec<[f64; 3]> = polygon.iter().map(|corner| apply(place, *corner)).collect();
                let [first, rest @ ..] = placed.as_slice() else { continue };
                for (one, next) in rest.iter().zip(rest.iter().skip(1)) {
                    if self.triangles.len() >= MAX_TRIANGLES {
                        return Err(too_many());
                    }
                    self.triangles.push([*first, *one, *next]);
                }
            }
        }
        Ok(())
    }

    /// Polygons of one list of indices: with so many corners each, or three.
    fn polygons(
        &self,
        shape: Node<'a, 't>,
        counts: Option<Vec<usize>>,
    ) -> Result<Vec<Vec<[f64; 3]>>, String> {
        let Some(list) = child(shape, "p") else { return Ok(Vec::new()) };
        let corners = self.corners(shape, list)?;
        let Some(counts) = counts else { return Ok(corners.chunks_exact(3).map(<[_]>::to_vec).collect()) };
        let mut rest = corners.as_slice();
        let mut polygons = Vec::new();
        for count in counts {
            let (polygon, others) = rest.split_at_checked(count).ok_or("a `polylist` has too few corners")?;
            polygons.push(polygon.to_vec());
            rest = others;
        }
        Ok(polygons)
    }

    /// Corners that a list of indices names.
    fn corners(&self, shape: Node<'a, 't>, list: Node<'a, 't>) -> Result<Vec<[f64; 3]>, String> {
        let number = |node: Node<'_, '_>, name: &str| {
            node.attribute(name).and_then(|text| text.trim().parse::<usize>().ok())
        };
        let inputs: Vec<Node<'a, 't>> = children(shape, "input").collect();
        let stride = inputs.iter().map(|input| number(*input, "offset").unwrap_or(0) + 1).max().unwrap_or(1);
        if stride > 64 {
            return Err(format!("its corners have {stride} indices each"));
        }
        let vertex = inputs.iter().find(|input| input.attribute("semantic") == Some("VERTEX"));
        let vertex = *vertex.ok_or("a shape has no vertices")?;
        let offset = number(vertex, "offset").unwrap_or(0);
        let vertices = self.target(vertex, "source").ok_or("a shape has vertices that are nowhere")?;
        let position =
            children(vertices, "input").find(|input| input.attribute("semantic") == Some("POSITION"));
        let source =
            position.and_then(|input| self.target(input, "source")).ok_or("vertices have no positions")?;
        let array = child(source, "float_array").ok_or("positions have no `float_array`")?;
        let places = numbers(array)?;
        let accessor = child(source, "technique_common").and_then(|common| child(common, "accessor"));
        let step = accessor.and_then(|accessor| number(accessor, "stride")).unwrap_or(3).max(3);
        let indices = list.text().unwrap_or_default().split_ascii_whitespace();
        let mut corners = Vec::new();
        for (at, word) in indices.enumerate() {
            if at % stride != offset {
                continue;
            }
            if corners.len() > 8 * MAX_TRIANGLES {
                return Err(too_many());
            }
            let index: usize = word.parse().map_err(|_| format!("`{word}` is no index"))?;
            let place = index.checked_mul(step).and_then(|from| places.get(from..from + 3));
            let place: [f64; 3] = place
                .and_then(|place| place.try_into().ok())
                .ok_or_else(|| format!("it names the vertex {index}, which it lacks"))?;
            corners.push(place);
        }
        Ok(corners)
    }
}

fn child<'a, 't>(node: Node<'a, 't>, name: &str) -> Option<Node<'a, 't>> {
    children(node, name).next()
}

fn children<'a, 't, 'n>(
    node: Node<'a, 't>,
    name: &'n str,
) -> impl Iterator<Item = Node<'a, 't>> + use<'a, 't, 'n> {
    node.children().filter(move |child| child.is_element() && child.tag_name().name() == name)
}

fn numbers(node: Node<'_, '_>) -> Result<Vec<f64>, String> {
    let words = node.text().unwrap_or_default().split_ascii_whitespace();
    words.map(|word| word.parse().map_err(|_| format!("`{word}` is no number"))).collect()
}

fn transform(node: Node<'_, '_>) -> Result<Matrix, String> {
    let given = numbers(node)?;
    let name = node.tag_name().name();
    match (name, given.as_slice()) {
        ("matrix", [a, b, c, d, e, f, g, h, i, j, k, l, _, _, _, _]) => {
            Ok([[*a, *b, *c, *d], [*e, *f, *g, *h], [*i, *j, *k, *l]])
        }
        ("translate", [x, y, z]) => Ok([[1.0, 0.0, 0.0, *x], [0.0, 1.0, 0.0, *y], [0.0, 0.0, 1.0, *z]]),
        ("scale", [x, y, z]) => Ok(scaling([*x, *y, *z])),
        ("rotate", [x, y, z, angle]) => Ok(rotation([*x, *y, *z], angle.to_radians())),
        (_, given) => Err(format!("a `{name}` has {} numbers", given.len())),
    }
}

fn scaling([x, y, z]: [f64; 3]) -> Matrix {
    [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]]
}

/// Rotation about an axis. A null axis rotates nothing.
fn rotation(axis: [f64; 3], angle: f64) -> Matrix {
    let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
    if length < 1e-12 {
        return IDENTITY;
    }
    let [x, y, z] = axis.map(|part| part / length);
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let rest = 1.0 - cos;
    [
        [cos + x * x * rest, x * y * rest - z * sin, x * z * rest + y * sin, 0.0],
        [y * x * rest + z * sin, cos + y * y * rest, y * z * rest - x * sin, 0.0],
        [z * x * rest - y * sin, z * y * rest + x * sin, cos + z * z * rest, 0.0],
    ]
}

/// One map after another one within it.
fn then(outer: &Matrix, [first, second, third]: &Matrix) -> Matrix {
    outer.map(|[a, b, c, moved]| {
        let columns = first.iter().zip(second).zip(third);
        let mut row = [0.0; 4];
        for (cell, ((x, y), z)) in row.iter_mut().zip(columns) {
            *cell = a * x + b * y + c * z;
        }
        let [x, y, z, offset] = row;
        [x, y, z, offset + moved]
    })
}

fn apply(map: &Matrix, [x, y, z]: [f64; 3]) -> [f64; 3] {
    map.map(|[a, b, c, moved]| a * x + b * y + c * z + moved)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: &str = r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema">
<asset><unit meter="0.001"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">0 0 0 1000 0 0 1000 1000 0 0 1000 0</float_array>
<technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="NORMAL" source="#n" offset="1"/>
<vcount>4</vcount><p>0 9 1 9 2 9 3 9</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node><translate>0 0 500</translate><node><rotate>0 0 1 90</rotate>
<instance_geometry url="#g"/></node></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"##;

    #[test]
    fn polygon_is_placed_by_its_nodes_in_metres() {
        let triangles = read(TRIANGLE.as_bytes()).unwrap();
        assert_eq!(triangles.len(), 2);
        let corner = triangles[0][1];
        let expected = [0.0, 1.0, 0.5];
        assert!(corner.iter().zip(expected).all(|(is, wanted)| (is - wanted).abs() < 1e-9), "{corner:?}");
    }

    #[test]
    fn wrong_files_are_refused_with_a_reason() {
        let wrong = |from: &str, to: &str| read(TRIANGLE.replace(from, to).as_bytes()).unwrap_err();
        assert_eq!(wrong("0 9 1 9 2 9 3 9", "0 9 1 9 2 9 7 9"), "it names the vertex 7, which it lacks");
        assert_eq!(wrong("<vcount>4", "<vcount>5"), "a `polylist` has too few corners");
        assert_eq!(wrong("meter=\"0.001\"", "meter=\"0\""), "its unit is 0 m");
        assert_eq!(wrong("1000 1000", "far 1000"), "`far` is no number");
        assert_eq!(wrong("url=\"#g\"", "url=\"#h\""), "it places a geometry that it lacks");
        assert!(read(b"solid x").unwrap_err().starts_with("it is no XML"));
        let crowded: String = (0..300).map(|n| format!(" a{n}=''")).collect();
        let crowded = read(format!("<COLLADA{crowded}/>").as_bytes());
        assert_eq!(crowded.unwrap_err(), "it has more than 256 attributes of an element");
        assert_eq!(read(b"<robot/>").unwrap_err(), "it is no COLLADA document");
        let circle =
            TRIANGLE.replace("<node><translate>", "<node id=\"n\"><instance_node url=\"#n\"/><translate>");
        assert_eq!(read(circle.as_bytes()).unwrap_err(), "its nodes are nested more than 64 deep");
    }
}
