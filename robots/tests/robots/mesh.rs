//! Meshes: what is read of STL and OBJ files, and that the pieces of a mesh hold all of it and little more.

use std::f64::consts::TAU;

use motet_robots::mesh::{self, MAX_TRIANGLES, MeshFile, Triangle};
use motet_robots::urdf::{self, LinkShape, UrdfShape};
use motet_syntax::{FileId, Source};
use proptest::prelude::*;

const CORNER: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];

fn binary(triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = b"solid, says the header of a binary file".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(u32::try_from(triangles.len()).unwrap().to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        #[allow(clippy::cast_possible_truncation, reason = "the numbers of the test fit")]
        bytes.extend(triangle.iter().flatten().flat_map(|value| (*value as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn mesh_reader_reads_stl_and_obj() {
    let read = |file: &str, bytes: &[u8]| mesh::read(file, bytes);
    assert_eq!(read("a.stl", &binary(&[CORNER])), Ok(vec![CORNER]));
    let text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2e0 \
        0\nendloop\nendfacet\nendsolid a\n";
    assert_eq!(read("a.STL", text.as_bytes()), Ok(vec![CORNER]));
    let text =
        "# made by hand\nmtllib a.mtl\nv 0 0 0\nv 1 0 0 1\nvt 0 0\nv 0 2 0\nusemtl red\nf 1/1 2/1/1 -1\n";
    assert_eq!(read("a.obj", text.as_bytes()), Ok(vec![CORNER]));
    // Words after a face, letters that are no UTF-8, and capitals.
    let text = b"# f\xfcr\nmtllib f\xfcr.mtl\nv 0 0 0 # first\nv 1 0 0\nv 0 2 0\nf 1 2 3 # comment\nf 1 2 \
        3#comment\n";
    assert_eq!(read("a.obj", text), Ok(vec![CORNER, CORNER]));
    let text = b"SOLID F\xdcR\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 2 \
        0\nENDLOOP\nENDFACET\nENDSOLID\n";
    assert_eq!(read("a.stl", text), Ok(vec![CORNER]));
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    assert_eq!(read("a.obj", square.as_bytes()).unwrap().len(), 2);
}

#[test]
fn mesh_reader_explains_mistakes() {
    let why = |file: &str, bytes: &[u8]| mesh::read(file, bytes).unwrap_err();
    let mut cut = binary(&[CORNER, CORNER]);
    cut.truncate(150);
    assert_eq!(why("a.stl", &cut), "it announces 2 triangles, and has bytes for 1");
    assert_eq!(why("a.stl", b"no"), "it is no STL");
    assert_eq!(why("a.stl", b"solid a\nendsolid a\n"), "it has no triangle");
    assert_eq!(why("a.stl", b"solid a\nvertex 1 2\n"), "line 2 has no three numbers");
    assert_eq!(why("a.stl", b"solid a\nvertex 1 2 3\n"), "it ends within a facet");
    assert_eq!(
        why("a.stl", b"solid a\nvertex 1 2 3\nendfacet"),
        "the facet that ends in line 3 has no three corners"
    );
    assert_eq!(why("a.obj", b"v 0 0 0\nf 1 2 3"), "line 2 names a corner that is not above it");
    assert_eq!(why("a.obj", b"v 0 0 0\nf 0 0 0"), "line 2 names a corner that is not above it");
    assert_eq!(
        why("a.obj", b"v 0 0 nan\nf 1 1 1"),
        "it has a corner that is nowhere: not a finite number, or beyond 1e9"
    );
    assert_eq!(why("a.ply", b""), "`.ply` files are not read, `.stl`, `.obj` and `.dae` are");
    let many = vec![CORNER; MAX_TRIANGLES + 1];
    assert_eq!(why("a.stl", &binary(&many)), "it has more than 200000 triangles");
}

/// The closed surface of a ring around z.
fn ring(wide: f64, thin: f64) -> Vec<Triangle> {
    let at = |along: u32, around: u32| {
        let (along, around) = (TAU * f64::from(along) / 16.0, TAU * f64::from(around) / 8.0);
        let out = wide + thin * around.cos();
        [out * along.cos(), out * along.sin(), thin * around.sin()]
    };
    let squares = (0..16).flat_map(|along| (0..8).map(move |around| (along, around)));
    let corners = squares.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    corners.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

fn turned([x, y, z, w]: [f64; 4], [a, b, c]: [f64; 3]) -> [f64; 3] {
    let (u, v, t) = (2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a));
    [a + w * u + y * t - z * v, b + w * v + z * u - x * t, c + w * t + x * v - y * u]
}

fn holds(piece: &LinkShape, point: [f64; 3]) -> bool {
    let pose = piece.link_from_shape;
    let off = [0, 1, 2].map(|at| point[at] - pose.xyz[at]);
    let [x, y, z, w] = pose.quaternion_xyzw;
    let [a, b, c] = turned([-x, -y, -z, w], off);
    match piece.shape {
        UrdfShape::Box(size) => [a, b, c].iter().zip(size).all(|(at, size)| at.abs() <= size / 2.0),
        UrdfShape::Cylinder { radius, length } => a.hypot(b) <= radius && c.abs() <= length / 2.0,
        UrdfShape::Capsule { radius, length } => {
            a.hypot(b).hypot((c.abs() - length / 2.0).max(0.0)) <= radius
        }
        UrdfShape::Sphere { .. } | UrdfShape::Mesh { .. } => false,
    }
}

fn volume(piece: &LinkShape) -> f64 {
    let disc = |radius: f64| TAU / 2.0 * radius * radius;
    match piece.shape {
        UrdfShape::Box([x, y, z]) => x * y * z,
        UrdfShape::Cylinder { radius, length } => disc(radius) * length,
        UrdfShape::Capsule { radius, length } => disc(radius) * (length + radius * 4.0 / 3.0),
        UrdfShape::Sphere { .. } | UrdfShape::Mesh { .. } => f64::INFINITY,
    }
}

proptest! {
    /// Whatever is within a closed surface is within a piece, however it is turned, stretched or mirrored.
    #[test]
    fn cover_contains_what_the_mesh_encloses(
        (wide, share) in (0.1..2.0, 0.05..0.9), turn in prop::array::uniform4(-1.0..1.0),
        scale in prop::array::uniform3(prop_oneof![0.01..3.0, -2.0..-0.01]),
        inside in prop::collection::vec((0.0..TAU, 0.0..TAU, 0.0..0.9), 64),
    ) {
        let length: f64 = turn.iter().map(|part: &f64| part * part).sum::<f64>().sqrt();
        prop_assume!(length > 0.1);
        let turn = turn.map(|part| part / length);
        let place = |point| turned(turn, point);
        let thin = wide * share;
        let mesh: Vec<Triangle> = ring(wide, thin).iter().map(|corners| corners.map(place)).collect();
        let pieces = mesh::cover(&mesh, scale);
        prop_assert!((1..=6).contains(&pieces.len()));
        // The surface of the polyhedron is as far in as the middle of a side of its 8 and 16 corners.
        let deep = inside.iter().map(|(along, around, depth)| {
            let out = (wide + thin * 0.9 * depth * around.cos()) * 0.98;
            place([out * along.cos(), out * along.sin(), thin * 0.9 * depth * around.sin()])
        });
        for point in mesh.iter().flatten().copied().chain(deep) {
            let scaled = [0, 1, 2].map(|at| point[at] * scale[at]);
            prop_assert!(pieces.iter().any(|piece| holds(piece, scaled)), "{scaled:?} of {pieces:?}");
        }
    }
}

#[test]
fn cover_finds_simple_shapes_and_cuts_bends() {
    let one = |mesh: &[Triangle]| mesh::cover(mesh, [1.0; 3]);
    let tube: Vec<Triangle> = (0..32)
        .flat_map(|step| {
            let at = |step: u32, z: f64| {
                let angle = TAU * f64::from(step) / 32.0;
                [z, 0.05 * angle.cos(), 0.05 * angle.sin()]
            };
            let [a, b, c, d] = [at(step, -0.2), at(step + 1, -0.2), at(step + 1, 0.2), at(step, 0.2)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let pieces = one(&tube);
    assert!(matches!(pieces[..], [LinkShape { shape: UrdfShape::Cylinder { .. }, .. }]), "{pieces:?}");
    // Two bars in the shape of an L: far less than the box around both.
    let bar = |[x, y, z]: [f64; 3]| -> Vec<Triangle> {
        let corner =
            |at: usize| [x * f64::from(at & 1 != 0), y * f64::from(at & 2 != 0), z * f64::from(at & 4 != 0)];
        let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        faces
            .iter()
            .flat_map(|face| {
                let [a, b, c, d] = face.map(corner);
                [[a, b, c], [a, c, d]]
            })
            .collect()
    };
    let bend: Vec<Triangle> = bar([0.4, 0.05, 0.05]).into_iter().chain(bar([0.05, 0.4, 0.05])).collect();
    let pieces = one(&bend);
    assert!(pieces.iter().map(volume).sum::<f64>() < 0.4 * (0.4 * 0.4 * 0.05), "{pieces:?}");
    assert!(one(&[]).is_empty());
}

const URDF: &str = "<robot name='stand'><link name='base'>
    <visual><geometry><mesh filename='seen.dae'/></geometry></visual>
    <collision><origin xyz='0 0 1'/><geometry><mesh filename='a.obj' scale='2 2 2'/></geometry></collision>
    <collision><geometry><mesh filename='a.obj'/></geometry></collision>
    <collision><geometry><mesh filename='b.stl'/></geometry></collision></link></robot>";

fn attached(find: impl FnMut(&str) -> MeshFile) -> (Vec<LinkShape>, Vec<String>) {
    let source = Source::new("robot.urdf", URDF);
    let urdf = urdf::read(&source, FileId(0)).0.unwrap();
    let (urdf, found) = mesh::attach(&source, FileId(0), urdf, find);
    let told = found.iter().map(|found| {
        format!(
            "{} [{}] {} / {}",
            found.code,
            source.slice(found.span),
            found.message,
            found.help.as_deref().unwrap_or("")
        )
    });
    (urdf.links[0].collisions.clone(), told.collect())
}

#[test]
fn attach_replaces_meshes_by_solids() {
    let text = "v -1 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
    let mut asked = Vec::new();
    let (solids, told) = attached(|name| {
        asked.push(name.to_owned());
        MeshFile::Bytes(if name == "a.obj" { text.into() } else { binary(&[CORNER]) })
    });
    assert_eq!((asked, told), (vec!["a.obj".to_owned(), "b.stl".to_owned()], vec![]));
    assert!(!solids.iter().any(|solid| matches!(solid.shape, UrdfShape::Mesh { .. })));
    assert!(solids.iter().any(|solid| holds(solid, [-2.0, 0.0, 1.0])));
    assert!(solids.iter().any(|solid| holds(solid, [0.0, 2.0, 0.0])));
}

#[test]
fn attach_reports_mistakes_at_the_name_of_the_mesh() {
    let (solids, told) = attached(|name| match name {
        "a.obj" => MeshFile::Missing(vec!["/r/a.obj".to_owned()]),
        _ => MeshFile::Outside,
    });
    assert_eq!(solids.len(), 3);
    assert_eq!(
        told,
        [
            "M0448 [a.obj] the mesh `a.obj` cannot be read, so no motion is computed: there is no such file \
                / looked for at `/r/a.obj`; `packages` in `[model]` of the card names folders with packages",
            "M0449 [b.stl] the mesh `b.stl` cannot be used: it lies neither below the folder of the card or \
                of the URDF nor below one of `packages` / "
        ]
    );
    let (_, told) = attached(|_| MeshFile::TooLarge);
    assert_eq!(told[0], "M0449 [a.obj] the mesh `a.obj` cannot be used: it is larger than 32 MiB / ");
}
