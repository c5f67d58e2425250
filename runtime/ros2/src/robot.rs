//! The robot behind its topics: everything that a binding names, open over DDS.

mod hear;

use crate::action::{ActionClient, GoalEvent, SOURCES};
use crate::bind::{Binding, Call, CallKind, Observation, StepKind};
use crate::cdr::{Message, decode, encode};
use crate::dds::{Dds, OwnEndpoint, Quality, Received, Source, Writer, dds_topic, dds_type};
use crate::layout::Layouts;
use crate::observe::{Expression, Found};
use crate::perceive::{CameraFeed, Feed};
use crate::service::{Client, Interface, Ticket};
use crate::state::{Body, Parts};
use bytes::Bytes;
use crossbeam_channel::{Receiver, Sender, bounded};
use motet_host::remote::protocol::DetectedThing;
use serde_json::Value;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::time::{Duration, Instant};

/// Messages that wait to be read. Beyond that DDS keeps the last ones of each topic.
const WAITING: usize = 4_096;
/// Time between two looks at which endpoints DDS knows.
const LOOKS: Duration = Duration::from_millis(200);

/// Meaning of a source.
#[derive(Clone, Debug)]
enum Channel {
    Action(usize),
    Service(usize),
    Joints,
    Odometry,
    Localization,
    Frames(bool),
    /// Topic whose last message is kept.
    Kept(String),
    Camera(usize, Feed),
    /// Detections in space, or in the pictures of the camera of this number.
    Detections(Option<usize>),
}

/// Something that a message told.
#[derive(Clone, Debug)]
pub(crate) enum RobotEvent {
    /// News of a goal of the action of this number.
    Goal(usize, GoalEvent),
    /// Response to a call of the service of this number.
    Response(usize, Ticket, Message),
    /// Things that were detected.
    Detected(Vec<DetectedThing>),
    /// A message that is kept has come.
    Kept,
}

/// The robot behind its topics, services and actions.
pub(crate) struct Robot {
    pub(crate) binding: Binding,
    pub(crate) layouts: Layouts,
    pub(crate) body: Body,
    pub(crate) actions: Vec<ActionClient>,
    pub(crate) services: Vec<Client>,
    /// Messages of ROS, for the main loop.
    pub(crate) received: Receiver<Received>,
    messages: Sender<Received>,
    /// Participants of the robot's nodes.
    peers: HashSet<String>,
    dds: Dds,
    channels: Vec<Channel>,
    service_names: Vec<String>,
    /// Topics that are read and written.
    topics: Vec<OwnEndpoint>,
    writers: HashMap<String, (Writer, String)>,
    cameras: Vec<CameraFeed>,
    kept: HashMap<String, (Bytes, Instant, String)>,
    expressions: HashMap<String, Expression>,
    /// Endpoints that each action lacks, and when DDS was asked.
    missing: Vec<Vec<String>>,
    looked: Option<Instant>,
    /// Reasons that were reported, so that each is reported once.
    told: std::collections::BTreeSet<String>,
}

impl Robot {
    /// Opens everything that the binding names.
    ///
    /// # Errors
    ///
    /// A type without a layout, an expression that is wrong, or why DDS does not start.
    pub(crate) fn open(binding: Binding, layouts: Layouts) -> Result<Self, String> {
        Self::join(binding, layouts, bounded(WAITING))
    }

    fn join(
        binding: Binding,
        layouts: Layouts,
        (sender, received): (Sender<Received>, Receiver<Received>),
    ) -> Result<Self, String> {
        let messages = sender.clone();
        let dds = Dds::join(binding.domain(), &binding.ros.networks, sender)?;
        let cameras = binding.cameras.iter().map(|_| CameraFeed::default()).collect();
        let mut robot = Self {
            binding,
            layouts,
            body: Body::default(),
            actions: Vec::new(),
            services: Vec::new(),
            received,
            messages,
            peers: HashSet::new(),
            dds,
            channels: Vec::new(),
            service_names: Vec::new(),
            topics: Vec::new(),
            writers: HashMap::new(),
            cameras,
            kept: HashMap::new(),
            expressions: HashMap::new(),
            missing: Vec::new(),
            looked: None,
            told: std::collections::BTreeSet::new(),
        };
        robot.open_body()?;
        robot.open_perception()?;
        robot.open_primitives()?;
        robot.missing = robot.actions.iter().map(|_| vec!["DDS has not looked yet".to_owned()]).collect();
        Ok(robot)
    }

    fn open_body(&mut self) -> Result<(), String> {
        let binding = self.binding.clone();
        self.listen(&binding.joints.topic, "sensor_msgs/JointState", Quality::Sensor, Channel::Joints)?;
        if let Some(topic) = &binding.base.odometry {
            self.listen(topic, "nav_msgs/Odometry", Quality::Sensor, Channel::Odometry)?;
        }
        if let Some(topic) = &binding.base.localization {
            let type_name = "geometry_msgs/PoseWithCovarianceStamped";
            // AMCL sends a pose only when it has a new one, and keeps the last one for who comes later. A
            // reader that asks for it hears no other writers; the second one hears all.
            for quality in [Quality::Latched, Quality::Sensor] {
                self.listen(topic, type_name, quality, Channel::Localization)?;
            }
        }
        self.listen(&binding.frames.tf, "tf2_msgs/TFMessage", Quality::Reliable, Channel::Frames(false))?;
        self.listen(
            &binding.frames.tf_static,
            "tf2_msgs/TFMessage",
            Quality::Latched,
            Channel::Frames(true),
        )?;
        for controller in &binding.controllers {
            self.action(&controller.action, "control_msgs/FollowJointTrajectory")?;
        }
        if let Some(navigation) = &binding.navigation {
            self.action(&navigation.action, "nav2_msgs/NavigateToPose")?;
            if let Some(stop) = &navigation.stop {
                self.writer(stop, &navigation.stop_type)?;
            }
        }
        if let Some(bound) = &binding.move_group {
            self.action(&bound.action, "moveit_msgs/MoveGroup")?;
        }
        if let Some(gripper) = &binding.gripper {
            self.action(&gripper.action, &gripper.type_name)?;
        }
        Ok(())
    }

    fn open_perception(&mut self) -> Result<(), String> {
        let binding = self.binding.clone();
        for (at, camera) in binding.cameras.iter().enumerate() {
            let image = "sensor_msgs/Image";
            let source = Channel::Camera(at, Feed::Image);
            self.listen(&camera.image, camera.image_type(), Quality::Sensor, source)?;
            if let Some(depth) = &camera.depth {
                self.listen(depth, image, Quality::Sensor, Channel::Camera(at, Feed::Depth))?;
            }
            let info = "sensor_msgs/CameraInfo";
            self.listen(&camera.info, info, Quality::Sensor, Channel::Camera(at, Feed::Info))?;
        }
        if let Some(topic) = &binding.detections {
            let camera = topic.camera.as_ref();
            let camera = camera.and_then(|name| binding.cameras.iter().position(|own| own.name == *name));
            let kind = if camera.is_some() { "Detection2DArray" } else { "Detection3DArray" };
            let channel = Channel::Detections(camera);
            self.listen(&topic.topic, &format!("vision_msgs/{kind}"), Quality::Sensor, channel)?;
        }
        for observation in binding.facts.values().chain(binding.measures.values()) {
            self.keep(&observation.topic, &observation.type_name)?;
            self.expression(&observation.value)?;
        }
        Ok(())
    }

    fn open_primitives(&mut self) -> Result<(), String> {
        let binding = self.binding.clone();
        let names = binding.primitives.keys();
        let steps = names.flat_map(|name| binding.steps(name).unwrap_or_default());
        for kind in steps.map(|step| step.kind) {
            match kind {
                StepKind::Call(call) => self.open_call(&call)?,
                StepKind::Require(text) => self.expression(&text)?,
                StepKind::Answer { topic, type_name, value, .. } => {
                    self.keep(&topic, &type_name)?;
                    self.expression(&value)?;
                }
                StepKind::Motion(_) | StepKind::Posture(_) | StepKind::Go(_) | StepKind::Gripper(_) => {}
                StepKind::Wait(_) | StepKind::Look | StepKind::Detect | StepKind::Search => {}
            }
        }
        for call in &binding.stop {
            if call.kind == CallKind::Action {
                return Err(format!("a stop is a service or a topic, not the action `{}`", call.name));
            }
            self.open_call(call)?;
        }
        Ok(())
    }

    fn open_call(&mut self, call: &Call) -> Result<(), String> {
        match call.kind {
            CallKind::Action => self.action(&call.name, &call.type_name).map(|_| ()),
            CallKind::Service => self.service(&call.name, &call.type_name).map(|_| ()),
            CallKind::Topic => self.writer(&call.name, &call.type_name),
        }
    }

    fn listen(
        &mut self,
        topic: &str,
        type_name: &str,
        quality: Quality,
        channel: Channel,
    ) -> Result<(), String> {
        self.known(type_name, "message")?;
        let own =
            OwnEndpoint::new(&dds_topic("rt", topic, ""), &dds_type(type_name, "msg", ""), quality, false);
        let source = self.next();
        self.dds.subscribe(&own.endpoint.topic, &own.endpoint.type_name, quality, source)?;
        // Of two readers of a topic the later one asks for less: nothing that it hears is missed.
        let names = |own: &OwnEndpoint| [own.endpoint.topic.clone(), own.endpoint.type_name.clone()];
        self.topics.retain(|before| names(before) != names(&own));
        self.topics.push(own);
        self.channels.push(channel);
        Ok(())
    }

    fn keep(&mut self, topic: &str, type_name: &str) -> Result<(), String> {
        let is_open = |channel: &Channel| matches!(channel, Channel::Kept(own) if own == topic);
        if self.channels.iter().any(is_open) {
            return Ok(());
        }
        self.listen(topic, type_name, Quality::Sensor, Channel::Kept(topic.to_owned()))
    }

    fn expression(&mut self, text: &str) -> Result<(), String> {
        let compiled = Expression::compile(text)?;
        self.expressions.insert(text.to_owned(), compiled);
        Ok(())
    }

    /// Refuses a type without a layout.
    fn known(&self, type_name: &str, what: &str) -> Result<(), String> {
        let kind = self.layouts.kind(type_name).map(|kind| format!("{kind:?}").to_lowercase());
        match kind {
            Some(kind) if kind == what => Ok(()),
            Some(kind) => Err(format!("`{type_name}` is the layout of a {kind}, not of a {what}")),
            None => {
                Err(format!("no layout of `{type_name}`; write one into a folder that `[ros] layouts` names"))
            }
        }
    }

    fn next(&self) -> Source {
        Source::try_from(self.channels.len()).unwrap_or(Source::MAX)
    }

    /// Number of an action, which is opened if it is not.
    fn action(&mut self, name: &str, type_name: &str) -> Result<usize, String> {
        if let Some(at) = self.actions.iter().position(|action| action.name == name) {
            return Ok(at);
        }
        self.known(type_name, "action")?;
        let (first, at) = (self.next(), self.actions.len());
        self.actions.push(ActionClient::new(&self.dds, self.binding.ros.middleware, name, type_name, first)?);
        self.channels.extend((0..SOURCES).map(|_| Channel::Action(at)));
        Ok(at)
    }

    fn service(&mut self, name: &str, type_name: &str) -> Result<usize, String> {
        if let Some(at) = self.service_names.iter().position(|own| own == name) {
            return Ok(at);
        }
        self.known(type_name, "service")?;
        let (source, at) = (self.next(), self.services.len());
        let interface = Interface { name: type_name, kind: "srv", end: "" };
        self.services.push(Client::new(&self.dds, self.binding.ros.middleware, name, interface, source)?);
        self.service_names.push(name.to_owned());
        self.channels.push(Channel::Service(at));
        Ok(at)
    }

    fn writer(&mut self, topic: &str, type_name: &str) -> Result<(), String> {
        self.known(type_name, "message")?;
        if !self.writers.contains_key(topic) {
            let (name, dds_name) = (dds_topic("rt", topic, ""), dds_type(type_name, "msg", ""));
            let writer = self.dds.publish(&name, &dds_name, Quality::Reliable)?;
            self.topics.push(OwnEndpoint::new(&name, &dds_name, Quality::Reliable, true));
            self.writers.insert(topic.to_owned(), (writer, type_name.to_owned()));
        }
        Ok(())
    }

    /// Number of an action that is open.
    #[must_use]
    pub(crate) fn action_at(&self, name: &str) -> Option<usize> {
        self.actions.iter().position(|action| action.name == name)
    }

    /// Number of a service that is open.
    #[must_use]
    pub(crate) fn service_at(&self, name: &str) -> Option<usize> {
        self.service_names.iter().position(|own| own == name)
    }

    /// Endpoints of an action that DDS has not discovered.
    #[must_use]
    pub(crate) fn missing(&self, action: usize) -> &[String] {
        self.missing.get(action).map_or(&[], Vec::as_slice)
    }

    /// Interfaces of other participants: topics that they read, and topics that they write.
    #[must_use]
    pub(crate) fn graph(&self) -> [Vec<crate::dds::Endpoint>; 2] {
        [self.dds.readers(), self.dds.writers()]
    }

    /// Endpoints of the binding's actions, services and topics, by their names in ROS.
    pub(crate) fn endpoints(&self) -> Vec<(String, Vec<OwnEndpoint>)> {
        let actions = self.actions.iter().map(|action| (action.name.clone(), action.endpoints()));
        let services = self.service_names.iter().zip(&self.services);
        let services = services.map(|(name, service)| (name.clone(), service.endpoints().to_vec()));
        let mut topics = self.topics.clone();
        topics.sort_by(|one, other| one.endpoint.cmp(&other.endpoint));
        let name = |own: &OwnEndpoint| own.endpoint.topic.trim_start_matches("rt").to_owned();
        let topics = topics.into_iter().map(|own| (name(&own), vec![own]));
        actions.chain(services).chain(topics).collect()
    }

    /// Lets time pass for all actions.
    pub(crate) fn tick(&mut self) -> Vec<RobotEvent> {
        if self.dds.has_lost(&self.peers) {
            self.tell("a node of the robot was not heard of for its lease time: DDS is joined anew");
            self.join_again().unwrap_or_else(|wrong| self.tell(&wrong));
        }
        if self.looked.is_none_or(|looked| looked.elapsed() > LOOKS) {
            self.look_for_servers();
        }
        let mut heard = Vec::new();
        for (at, action) in self.actions.iter_mut().enumerate() {
            let is_there = self.missing[at].is_empty();
            let news = action.tick(&self.layouts, is_there);
            heard.extend(news.into_iter().map(|news| RobotEvent::Goal(at, news)));
        }
        heard
    }

    /// Joins DDS as a new participant, and keeps what is known of the robot and its goals. Calls of services
    /// that are not answered yet end by their time.
    fn join_again(&mut self) -> Result<(), String> {
        let channel = (self.messages.clone(), self.received.clone());
        let mut fresh = Self::join(self.binding.clone(), self.layouts.clone(), channel)?;
        for (own, before) in fresh.actions.iter_mut().zip(&mut self.actions) {
            own.adopt(before);
        }
        std::mem::swap(&mut fresh.body, &mut self.body);
        std::mem::swap(&mut fresh.cameras, &mut self.cameras);
        std::mem::swap(&mut fresh.kept, &mut self.kept);
        std::mem::swap(&mut fresh.told, &mut self.told);
        *self = fresh;
        Ok(())
    }

    fn look_for_servers(&mut self) {
        self.looked = Some(Instant::now());
        self.missing = self.actions.iter().map(|action| action.missing(&self.dds)).collect();
        let topics = self.actions.iter().map(ActionClient::status_topic);
        let joints = dds_topic("rt", &self.binding.joints.topic, "");
        let topics: Vec<String> = topics.chain([joints]).collect();
        self.peers.extend(self.dds.peers(&topics));
    }

    /// Answer to a bound fact or measure; `None` without a message that is fresh, or where the expression has
    /// no value for it.
    pub(crate) fn observe(&mut self, observation: &Observation, args: &[String]) -> Option<Found> {
        let fresh = Duration::from_secs_f64(observation.age_secs.clamp(0.0, 1e6));
        self.evaluate(&observation.topic, &observation.value, args, fresh)
    }

    /// Value of an expression over the last message of a topic.
    pub(crate) fn evaluate(
        &mut self,
        topic: &str,
        text: &str,
        args: &[String],
        fresh: Duration,
    ) -> Option<Found> {
        let (bytes, at, type_name) = self.kept.get(topic)?;
        if at.elapsed() > fresh {
            return None;
        }
        let message = decode(&self.layouts, type_name, bytes);
        let joints = self.body.positions();
        let expression = self.expressions.get(text)?;
        let found = message.and_then(|message| expression.evaluate(Some(&message), args, &joints));
        found.map_err(|wrong| self.tell(&wrong)).ok()
    }

    /// True if an expression over the joints holds.
    ///
    /// # Errors
    ///
    /// Why it has no truth.
    pub(crate) fn holds(&self, text: &str, args: &[String]) -> Result<bool, String> {
        let expression = self.expressions.get(text).ok_or("an expression was not compiled")?;
        let joints: BTreeMap<String, f64> = self.body.positions();
        match expression.evaluate(None, args, &joints)? {
            Found::Truth(truth) => Ok(truth),
            _ => Err(format!("the expression `{text}` is neither true nor false")),
        }
    }

    /// Forgets the last message of a topic, so that the next one is new.
    pub(crate) fn forget(&mut self, topic: &str) {
        self.kept.remove(topic);
    }

    /// Publishes a message.
    ///
    /// # Errors
    ///
    /// The field that the layout lacks, or why DDS did not take it.
    pub(crate) fn publish(&self, topic: &str, message: &Value) -> Result<(), String> {
        let (writer, type_name) = self.writers.get(topic).ok_or_else(|| format!("`{topic}` is not open"))?;
        writer.write(encode(&self.layouts, type_name, message)?, None).map(|_| ())
    }

    /// Sends what stops the robot beside its trajectories: zero speeds, and the calls that the binding names.
    pub(crate) fn send_stops(&mut self) {
        let stops = self.binding.stop.clone();
        let navigation = self.binding.navigation.clone().and_then(|navigation| navigation.stop);
        if let Some(topic) = navigation
            && let Err(wrong) = self.publish(&topic, &Value::Null)
        {
            self.tell(&wrong);
        }
        for call in stops {
            let sent = match (call.kind, self.service_at(&call.name)) {
                (CallKind::Service, Some(at)) => {
                    self.services[at].call(&self.layouts, &call.message).map(|_| ())
                }
                _ => self.publish(&call.name, &call.message),
            };
            sent.unwrap_or_else(|wrong| self.tell(&wrong));
        }
    }

    /// Picture of a camera; of the first one without a name.
    ///
    /// # Errors
    ///
    /// Why there is none.
    pub(crate) fn look(
        &self,
        camera: Option<&str>,
    ) -> Result<motet_host::remote::protocol::LookResult, String> {
        let cameras = &self.binding.cameras;
        let at = match camera {
            Some(name) => cameras.iter().position(|own| own.name == name),
            None => (!cameras.is_empty()).then_some(0),
        };
        let at = at.ok_or_else(|| format!("no camera `{}` is bound", camera.unwrap_or_default()))?;
        self.cameras[at].look(&cameras[at], &self.binding, &self.layouts, &self.body.frames)
    }

    /// Joints of all controllers, and the base if the robot drives.
    #[must_use]
    pub(crate) fn parts(&self) -> Parts {
        let joints = self.binding.controllers.iter().flat_map(|controller| controller.joints.iter().cloned());
        Parts { joints: joints.collect(), drives: self.binding.base.odometry.is_some(), all: false }
    }

    /// Cancels all goals of all actions, whoever sent them.
    pub(crate) fn cancel_all(&mut self) {
        self.actions.iter_mut().for_each(|action| action.cancel_all(&self.layouts));
    }

    /// True if everything stands still.
    #[must_use]
    pub(crate) fn is_still(&self) -> bool {
        self.body.is_still(&Parts { all: true, ..Parts::default() }, &self.binding)
    }

    /// True if everything stands still, and no action server that is there says that it carries a goal out.
    #[must_use]
    pub(crate) fn is_at_rest(&self) -> bool {
        let idle = |(action, missing): (&ActionClient, &Vec<String>)| !missing.is_empty() || action.is_idle();
        self.is_still() && self.actions.iter().zip(&self.missing).all(idle)
    }

    /// Prints a problem once.
    pub(crate) fn tell(&mut self, text: &str) {
        if self.told.len() < 1_000 && self.told.insert(text.to_owned()) {
            crate::lines::note(text);
        }
    }
}
