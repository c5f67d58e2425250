//! Comparison of a binding with the nodes that DDS discovers.

use super::Report;
use crate::dds::{Endpoint, OwnEndpoint};
use crate::robot::Robot;
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

/// Time in which DDS discovers the nodes of a robot.
const DISCOVERS: Duration = Duration::from_secs(3);

/// Compares with the nodes that DDS discovers.
pub(super) fn compare(robot: &mut Robot, report: &mut Report) {
    let begun = Instant::now();
    while begun.elapsed() < DISCOVERS {
        let message = robot.received.recv_timeout(Duration::from_millis(50));
        let heard = message.map(|message| robot.hear(&message, &|_| false));
        drop(heard);
        robot.tick();
    }
    report.title("the network");
    let [readers, writers] = robot.graph();
    for (name, endpoints) in robot.endpoints() {
        let others = |own: &OwnEndpoint| if own.is_writer { &readers } else { &writers };
        let unheard: Vec<Unheard> = endpoints.iter().filter_map(|own| unheard(own, others(own))).collect();
        match endpoints.as_slice() {
            _ if !unheard.is_empty() => tell(&name, unheard, report),
            [own] => {
                let verb = if own.is_writer { "read" } else { "sent" };
                report.good(&name, &format!("{verb} as {}", ros_type(&own.endpoint.type_name)));
            }
            _ => report.good(&name, "its server is there"),
        }
    }
    match robot.body.base(&robot.binding) {
        Ok(base) => {
            report.good("pose of the base", &format!("({:.2}, {:.2}) m, {:.2} rad", base.x, base.y, base.yaw))
        }
        Err(why) if robot.binding.base.odometry.is_some() => report.wrong("pose of the base", &why),
        Err(_) => {}
    }
}

/// Reason for which nothing passes between an endpoint of the driver and those of others.
enum Unheard {
    /// Nobody has the other side of a topic, or of a part of a server.
    Topic {
        is_writer: bool,
    },
    Part(String),
    /// The other side differs, in words.
    Differs(String),
}

fn tell(name: &str, unheard: Vec<Unheard>, report: &mut Report) {
    let mut parts = BTreeSet::new();
    for one in unheard {
        match one {
            Unheard::Topic { is_writer: true } => report.wrong(name, "nobody reads it"),
            Unheard::Topic { is_writer: false } => report.wrong(name, "nobody sends it"),
            Unheard::Part(part) => {
                parts.insert(part);
            }
            Unheard::Differs(why) => report.wrong(name, &why),
        }
    }
    if !parts.is_empty() {
        let parts: Vec<String> = parts.into_iter().collect();
        report.wrong(name, &format!("nobody serves {}", parts.join(", ")));
    }
}

/// Reason for which nothing passes; `None` if something does. DDS connects a reader with a writer of the same
/// type that offers at least the quality that the reader asks for.
fn unheard(own: &OwnEndpoint, others: &[Endpoint]) -> Option<Unheard> {
    let topic = &own.endpoint.topic;
    let mut found = others.iter().filter(|one| one.topic == *topic).peekable();
    let is_topic = topic.starts_with("rt/") && !topic.contains("/_action/");
    let Some(first) = found.peek().copied() else {
        let is_writer = own.is_writer;
        return Some(if is_topic { Unheard::Topic { is_writer } } else { Unheard::Part(plain(topic)) });
    };
    if found.any(|other| differs(own, other).is_none()) {
        return None;
    }
    let why = differs(own, first)?;
    let lost = if own.is_writer { "nobody hears the driver" } else { "the driver does not hear it" };
    let part = if is_topic { String::new() } else { format!("{} is ", plain(topic)) };
    Some(Unheard::Differs(format!("{part}{why}; {lost}")))
}

/// Difference that keeps DDS from connecting two endpoints, in words.
fn differs(own: &OwnEndpoint, other: &Endpoint) -> Option<String> {
    let verb = if own.is_writer { "read" } else { "sent" };
    if other.type_name != own.endpoint.type_name {
        let [is_type, bound] = [&other.type_name, &own.endpoint.type_name].map(|name| ros_type(name));
        return Some(format!("{verb} as {is_type}, and bound as {bound}"));
    }
    let lacks =
        |own_part: bool, part: bool| if own.is_writer { part && !own_part } else { own_part && !part };
    let qualities = [
        (own.endpoint.reliable, other.reliable, "reliable", "best effort"),
        (own.endpoint.latched, other.latched, "transient local", "volatile"),
    ];
    let (_, _, asked, offered) = qualities.into_iter().find(|(own, other, ..)| lacks(*own, *other))?;
    Some(match own.is_writer {
        true => format!("{verb} as {asked}, and the driver sends {offered}"),
        false => format!("{verb} as {offered}, and the driver asks for {asked}"),
    })
}

/// Name of a service or topic of an action as ROS has it, without the marks of DDS.
fn plain(topic: &str) -> String {
    let name = topic.split_once('/').map_or(topic, |(_, name)| name);
    let end = if topic.starts_with("rq/") { "Request" } else { "Reply" };
    name.strip_suffix(end).filter(|_| !topic.starts_with("rt/")).unwrap_or(name).to_owned()
}

/// Name of a type as ROS has it: `geometry_msgs/Twist` for `geometry_msgs::msg::dds_::Twist_`.
fn ros_type(name: &str) -> String {
    let parts: Vec<&str> = name.split("::").collect();
    match parts.as_slice() {
        [package, _, "dds_", own] => format!("{package}/{}", own.trim_end_matches('_')),
        _ => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dds::{Quality, dds_type};

    fn check(own: (&str, Quality, bool), other: (&str, bool, bool)) -> Option<String> {
        let own = OwnEndpoint::new("rt/topic", &dds_type(own.0, "msg", ""), own.1, own.2);
        let (type_name, reliable, latched) = other;
        let type_name = dds_type(type_name, "msg", "");
        match unheard(&own, &[Endpoint { topic: "rt/topic".to_owned(), type_name, reliable, latched }]) {
            Some(Unheard::Differs(why)) => Some(why),
            Some(Unheard::Topic { .. } | Unheard::Part(_)) => Some("nobody".to_owned()),
            None => None,
        }
    }

    #[test]
    fn live_types_and_qualities_have_to_fit() {
        let (one, two) = ("geometry_msgs/Twist", "geometry_msgs/TwistStamped");
        let said = check((one, Quality::Reliable, true), (two, true, false));
        let text = "read as geometry_msgs/TwistStamped, and bound as geometry_msgs/Twist; \
                    nobody hears the driver";
        assert_eq!(said.as_deref(), Some(text));
        let said = check((one, Quality::Reliable, false), (one, false, false));
        let text = "sent as best effort, and the driver asks for reliable; the driver does not hear it";
        assert_eq!(said.as_deref(), Some(text));
        let said = check((one, Quality::Latched, false), (one, true, false));
        assert!(said.is_some_and(|said| {
            said.starts_with("sent as volatile, and the driver asks for transient local")
        }));
        let said = check((one, Quality::Reliable, true), (one, true, true));
        assert!(
            said.is_some_and(
                |said| said.starts_with("read as transient local, and the driver sends volatile")
            )
        );
        // More than is asked for is enough.
        assert_eq!(check((one, Quality::Sensor, false), (one, true, true)), None);
        assert_eq!(check((one, Quality::Reliable, true), (one, false, false)), None);
    }

    #[test]
    fn live_names_are_those_of_ros() {
        assert_eq!(plain("rq/arm/_action/send_goalRequest"), "arm/_action/send_goal");
        assert_eq!(plain("rr/arm/_action/send_goalReply"), "arm/_action/send_goal");
        assert_eq!(plain("rt/arm/_action/status"), "arm/_action/status");
        assert_eq!(
            ros_type("nav2_msgs::action::dds_::NavigateToPose_Goal_"),
            "nav2_msgs/NavigateToPose_Goal"
        );
    }
}
