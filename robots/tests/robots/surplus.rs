//! Parts of a URDF that are not read: reported where the author may have meant something by them, ignored
//! where another tool reads them.

use motet_robots::urdf::{self, Urdf};
use motet_syntax::{Diagnostic, FileId, Source};

fn read(text: &str) -> (Option<Urdf>, Vec<Diagnostic>, Source) {
    let source = Source::new("robot.urdf", text);
    let (robot, found) = urdf::read(&source, FileId(0));
    (robot, found, source)
}

/// `CODE [text under the span] message / help`.
fn told_of(found: &Diagnostic, source: &Source) -> String {
    let help = found.help.as_ref().map(|help| format!(" / {help}")).unwrap_or_default();
    format!("{} [{}] {}{help}", found.code, source.slice(found.span), found.message)
}

/// A robot of one joint with `from` replaced by `to` says exactly this, and is read where that is no error.
fn check(from: &str, to: &str, expected: &[&str]) {
    const ROBOT: &str = "<robot name='a'><link name='a'><collision><origin xyz='0 0 1'/><geometry><box \
        size='1 1 1'/></geometry>
        </collision></link><link name='b'/><joint name='j' type='revolute'><origin xyz='0 0 0.3'/><parent \
            link='a'/><child link='b'/>
        <axis xyz='0 0 1'/><limit lower='-1' upper='1'/></joint></robot>";
    assert_eq!(ROBOT.matches(from).count(), 1, "`{from}` must stand once in the robot");
    let (robot, found, source) = read(&ROBOT.replacen(from, to, 1));
    let told: Vec<String> = found.iter().map(|found| told_of(found, &source)).collect();
    assert_eq!(told, expected, "{to}");
    assert_eq!(robot.is_some(), !told.iter().any(|line| line.starts_with("M0473")), "{to}");
}

#[test]
fn surplus_check_reports_repeated_elements() {
    let twice = |part: &str, element: &str| {
        let under = part.split(' ').next().unwrap();
        let message = format!("M0473 [{under}] joint `j` has two `{under}>` / remove one");
        check(part, &format!("{part}{element}"), &[&message]);
    };
    twice("<parent link='a'/>", "<parent link='b'/>");
    twice("<child link='b'/>", "<child link='a'/>");
    twice("<axis xyz='0 0 1'/>", "<axis xyz='1 0 0'/>");
    twice("<limit lower='-1' upper='1'/>", "<limit lower='0' upper='1'/>");
    twice("<origin xyz='0 0 0.3'/>", "<origin xyz='0 0 5'/>");
    let (one, other) = ("<box size='1 1 1'/>", "<sphere radius='9'/>");
    check(
        one,
        &format!("{one}{other}"),
        &["M0473 [<sphere] geometry has two shapes / remove one, or give each a `<collision>` of its own"],
    );
    check(
        one,
        &format!("{one}</geometry><geometry>{other}"),
        &["M0473 [<geometry] collision has two `<geometry>` / remove one"],
    );
}

#[test]
fn surplus_check_reports_misspelt_names() {
    let passed = |name: &str, near: &str| {
        format!("M0474 [<{name}] unknown element `<{name}>` is ignored / did you mean `<{near}>`?")
    };
    check("<origin xyz='0 0 0.3'/>", "<orgin xyz='0 0 0.3'/>", &[&passed("orgin", "origin")]);
    check("<link name='b'/>", "<link name='b'/><lnik name='c'/>", &[&passed("lnik", "link")]);
    check("<link name='b'/>", "<link name='b'><colision/></link>", &[&passed("colision", "collision")]);
    check(
        "<link name='b'/>",
        "<link name='b'><shade/></link>",
        &["M0474 [<shade] unknown element `<shade>` is ignored"],
    );
    let named = |element: &str, name: &str, help: &str| {
        format!("M0475 [0 0 1] unknown attribute `{name}` of `<{element}>` is ignored / {help}")
    };
    check("<axis xyz=", "<axis xy=", &[&named("axis", "xy", "did you mean `xyz`?")]);
    check(
        "<origin xyz='0 0 1'/>",
        "<origin xzy='0 0 1'/>",
        &[&named("origin", "xzy", "did you mean `xyz`?")],
    );
    check("<axis xyz=", "<axis direction=", &[&named("axis", "direction", "possible here: `xyz`")]);
    check(
        "lower='-1'",
        "loower='-1'",
        &["M0475 [-1] unknown attribute `loower` of `<limit>` is ignored / did you mean `lower`?"],
    );
}

#[test]
fn surplus_check_skips_parts_of_other_tools() {
    for foreign in [
        "<transmission name='t'><joint name='j'><orgin/></joint></transmission>",
        "<gazebo reference='a'><selfCollide>true</selfCollide></gazebo>",
        "<ros2_control name='c' type='system'><joint name='j'/></ros2_control>",
        "<sensor name='s'><parent link='a'/><parent link='b'/></sensor>",
        "<material name='m'><color rgba='1 1 1 1'/></material>",
        "<mine:colision xmlns:mine='http://example.org/'/>",
    ] {
        check("<link name='b'/>", &format!("<link name='b'/>{foreign}"), &[]);
    }
    for foreign in [
        "<dynamics damping='1'/>",
        "<safety_controller k_velocity='1'/>",
        "<calibration rising='0'/>",
        "<mine:axis xmlns:mine='http://example.org/' xy='1'/>",
    ] {
        check("<axis xyz='0 0 1'/>", &format!("<axis xyz='0 0 1'/>{foreign}"), &[]);
    }
    check("upper='1'", "upper='1' command_effort='3' current='2' gear_velocity='4'", &[]);
    check("<link name='b'/>", "<link name='b' mine:nmae='x' xmlns:mine='http://example.org/'/>", &[]);
    // The namespace of all is no prefix of any.
    check("name='a'><link name='a'>", "name='a' xmlns='http://example.org/'><link name='a'>", &[]);
}

#[test]
fn surplus_check_reports_mimic_of_joint_without_one_position() {
    for (kind, more) in [("fixed", &[][..]), ("planar", &[]), ("floating", &["M0468"])] {
        let joint = format!("type='{kind}'><mimic joint='other'/>");
        let text = format!(
            "<robot><link name='a'/><link name='b'/><joint name='j' {joint}<parent link='a'/><child \
                link='b'/></joint></robot>"
        );
        let (robot, found, source) = read(&text);
        let (mimic, others): (Vec<_>, Vec<_>) = found.iter().partition(|found| found.code.0 == "M0476");
        assert!(robot.is_some());
        let told: Vec<String> = mimic.into_iter().map(|found| told_of(found, &source)).collect();
        let said =
            format!("M0476 [<mimic] joint `j` is {kind} and cannot mimic another: its `<mimic>` is ignored");
        assert_eq!(
            told,
            [format!("{said} / remove the `<mimic>`, or make the joint revolute, continuous or prismatic")]
        );
        assert_eq!(others.iter().map(|found| found.code.0).collect::<Vec<_>>(), more);
    }
}
