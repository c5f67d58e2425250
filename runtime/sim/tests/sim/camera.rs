//! What the simulator's camera takes of a room: things where they are, in their colours, and the same bytes
//! of the same world.

use crate::sim;
use motet_robots::card::CameraMount;
use motet_runtime::conformance::check_perception;
use motet_runtime::{Driver, Perception, RgbdView, Time};
use motet_sim::{Sim, SimOptions};
use std::io::Cursor;

/// Red, green and blue of each pixel.
fn pixels(bytes: &[u8]) -> Vec<[u8; 3]> {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut buffer).unwrap();
    assert_eq!((frame.width, frame.height, frame.color_type), (640, 480, png::ColorType::Rgb));
    buffer[..frame.buffer_size()].chunks(3).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}

fn seen(sim: &mut Sim, of: &str) -> RgbdView {
    sim.view(Time::ZERO, of).unwrap()
}

#[test]
fn camera_thing_is_in_the_middle_of_its_picture_in_its_colour_and_as_far_as_it_is() {
    let mut sim = sim(
        "hsr",
        "kitchen",
        SimOptions { eye: Some(CameraMount::free([0.1, 0.0, 1.0])), ..SimOptions::default() },
    );
    for (of, strongest) in [("mug_1", 0), ("apple", 1)] {
        let view = seen(&mut sim, of);
        let middle = 240 * 640 + 320;
        let colour = pixels(&view.image.bytes)[middle];
        let most = (0..3).max_by_key(|at| colour[*at]).unwrap();
        assert_eq!(most, strongest, "{of} is {colour:?}");
        let [x, y, z] = sim.position(of).unwrap();
        let far = ((x - 0.1).powi(2) + y.powi(2) + (z - 1.0).powi(2)).sqrt();
        let depth = f64::from(view.depth.millimetres[middle]) / 1_000.0;
        assert!((far - depth - 0.04).abs() < 0.02, "{of}: {depth} m, its middle {far} m");
        assert_eq!(view.depth.millimetres[0], 0, "nothing is behind the room");
    }
}

#[test]
fn camera_what_is_shut_in_is_not_seen_until_it_is_open() {
    let shut = r#"{"motet_scene": 1, "robot": {"base": [0, 0, 0]}, "entities": [
        {"id": "fridge", "kind": "Container", "pose": {"xyz": [1.5, 0, 0.7], "rpy": [0, 0, 3.14159]},
            "fixed": true,
         "shape": {"box": [0.6, 0.6, 1.4]}, "open": OPEN,
         "travel": {"hinge": {"axis": [0, 0, -1], "at": [0.3, -0.3, 0.0], "angle": 1.57}}},
        {"id": "red_can", "kind": "Object", "pose": {"xyz": [1.5, 0, 0.7]}, "in": "fridge",
         "shape": {"cylinder": {"radius": 0.05, "height": 0.2}}}]}"#;
    let room = |open: &str| crate::scene(&shut.replace("OPEN", open));
    let mut closed = Sim::new(&crate::robot("hsr"), &room("false"), SimOptions::default());
    assert_eq!(closed.view(Time::ZERO, "red_can"), None);
    let mut open = Sim::new(&crate::robot("hsr"), &room("true"), SimOptions::default());
    let view = seen(&mut open, "red_can");
    let [red, green, blue] = pixels(&view.image.bytes)[240 * 640 + 320];
    assert!(red > 2 * green && red > 2 * blue, "through the open door: {red} {green} {blue}");
    assert_ne!(closed.image(Time::ZERO), open.image(Time::ZERO));
}

#[test]
fn camera_turns_to_where_there_is_something_to_see() {
    let room = |y: f64| {
        crate::scene(&format!(
            r#"{{"motet_scene": 1, "robot": {{"base": [0, 0, 0]}}, "entities": [
            {{"id": "red_ball", "kind": "Object", "pose": {{"xyz": [0.5, {y}, 0.6]}},
                "shape": {{"sphere": {{"radius": 0.1}}}}}}]}}"#
        ))
    };
    for y in [-1.0, 0.0, 1.0] {
        let mut eyes = Sim::new(&crate::robot("hsr"), &room(y), SimOptions::default());
        let reds = pixels(&eyes.image(Time::ZERO).unwrap().bytes);
        let count = reds.iter().filter(|[red, green, _]| *red > 100 && *green < 60).count();
        assert!(count > 500, "at {y} m to the left: {count} pixels are red");
    }
}

#[test]
fn camera_pictures_keep_the_laws_and_are_the_same_of_the_same_world() {
    for (robot, room) in [("hsr", "kitchen"), ("anymal_z1", "living_room"), ("panda", "lab")] {
        let mut eyes = sim(robot, room, SimOptions::default());
        assert_eq!(check_perception(&mut eyes, &[Time::ZERO]), [""; 0], "{robot} in {room}");
        let can = eyes.capabilities();
        let view = eyes.look(Time::ZERO, None);
        assert_eq!((can.look, can.detections), (view.is_some(), view.is_some()), "{robot}");
        assert_eq!(eyes.look(Time::ZERO, Some("no camera")), None);
        if let Some(view) = view {
            let name = view.image.camera.clone();
            assert_eq!(eyes.look(Time::ZERO, Some(&name)), Some(view));
        }
        assert_eq!(eyes.image(Time::ZERO), sim(robot, room, SimOptions::default()).image(Time::ZERO));
    }
}
