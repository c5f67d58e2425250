"""A robot that speaks ROS 2 over Cyclone DDS, for tests: FollowJointTrajectory, NavigateToPose, a gripper, joint states,
odometry, tf, pictures and detections, in front of a body without physics or of the world of MuJoCo.

Faults of all its action servers: `reject`, `ignore-cancel` (goes on after a cancel that it promised to heed), `deaf`
(a new trajectory does not stop the old one either), `die` (ends in the middle of a motion), `silent` (never answers
a goal), `mute` (and never tells its state), `late` (answers after 3 s), `twice` (answers everything twice, the second
time otherwise), `other-goal` (answers calls that nobody made), `early` (says that a trajectory has succeeded in the middle of it).
MoveGroup finds no plan with `no-plan`, and a navigation ends 0.2 m beside its goal with `beside`.

Faults of its topics: `labels` (detections without ids), `volatile` (the localisation is sent again and again, and not
kept for who comes later), `late-tf` (transforms come 2 s late, and steadily), `rolls` (the base rolls on for 3 s when the
arm's goal is canceled).
"""

import argparse
import json
import math
import os
import signal
import sys
import time
import tomllib

from cyclone import ABORTED, CANCELED, RELIABLE, LATCHED, SUCCEEDED, ActionServer, Node, Types, stamp

# Where the joints of a body without physics begin, apart from 0.
START = {"arm_roll_joint": -1.57, "wrist_flex_joint": -1.57, "hand_motor_joint": 0.0, "panda_joint2": -0.785,
         "panda_joint4": -2.356, "panda_joint6": 1.571, "panda_joint7": 0.785}


def spline(points, names, time_now):
    """Positions and speeds of joints at a time of a trajectory, by cubic splines."""
    at = next((i for i, point in enumerate(points) if point[0] >= time_now), len(points) - 1)
    before, after = points[max(at - 1, 0)], points[at]
    span = after[0] - before[0]
    if span <= 0.0 or time_now >= points[-1][0]:
        return dict(zip(names, after[1])), dict.fromkeys(names, 0.0)
    t = min(max((time_now - before[0]) / span, 0.0), 1.0)
    a, b, c, d = 2 * t**3 - 3 * t**2 + 1, t**3 - 2 * t**2 + t, 3 * t**2 - 2 * t**3, t**3 - t**2
    places = [a * p + b * span * v + c * q + d * span * w for p, v, q, w in zip(before[1], before[2], after[1], after[2])]
    e, f, g = 6 * t**2 - 6 * t, 3 * t**2 - 4 * t + 1, 3 * t**2 - 2 * t
    speeds = [(e * p - e * q) / span + f * v + g * w for p, v, q, w in zip(before[1], before[2], after[1], after[2])]
    return dict(zip(names, places)), dict(zip(names, speeds))


class Still:
    """A body without physics: joints are where they are told to be."""

    def __init__(self, joints, base):
        self.joints, self.speeds, self.base, self.moves = dict(joints), {}, list(base), [0.0, 0.0, 0.0]
        self.held = None

    def aim(self, positions, speeds):
        for name, value in positions.items():
            self.joints[name], self.speeds[name] = value, speeds.get(name, 0.0)

    def drive(self, place, speed):
        self.base, self.moves = list(place), list(speed)

    def step(self, _now):
        pass

    def grip(self, closed):
        self.joints["hand_motor_joint"] = 0.0 if closed else 1.0
        return closed

    def things(self):
        return []

    def holds(self):
        return []

    def given(self):
        return {}


class Physics:
    """The world of MuJoCo."""

    def __init__(self, robot, scene, motet):
        from motet_mujoco.model import load
        from motet_mujoco.world import World
        self.world = World(load(robot, scene, motet))
        self.model = self.world.model
        self.goal = self.world.target.copy()
        self.held, self.grips, self.begun = None, None, None
        self.world.wait(0.3)
        self.started = self.world.now

    @property
    def joints(self):
        qpos = self.world.data.qpos[self.model.control_qpos]
        return {name: float(qpos[at]) for name, at in self.model.controls.items()}

    @property
    def speeds(self):
        qvel = {}
        for name, at in self.model.controls.items():
            joint = self.model.mj.actuator_trnid[at][0]
            qvel[name] = float(self.world.data.qvel[self.model.mj.jnt_dofadr[joint]])
        return qvel

    @property
    def base(self):
        return [float(part) for part in self.world.base()]

    @property
    def moves(self):
        names = sorted(self.model.controls, key=self.model.controls.get)[:3]
        return [self.speeds[name] for name in names]

    def aim(self, positions, _speeds):
        for name, value in positions.items():
            if self.model.controls.get(name) not in self.model.grips:
                self.goal[self.model.controls[name]] = value

    def drive(self, place, _speed):
        self.goal[:3] = place

    def grip(self, closed):
        """Begins to close or open the hand. Answers nothing: `step` ends it."""
        start = {at: float(self.world.data.qpos[self.model.control_qpos[at]]) for at in self.model.grips}
        if not closed:
            self.give()
        self.grips = (closed, self.world.now, start)

    def is_gripping(self):
        return self.grips is not None

    def give(self):
        """A person takes what is held out to them."""
        world = self.world
        for thing in world.held():
            for person, at in self.model.people.items():
                far = math.dist(world.tip()[0][:2], world.data.mocap_pos[at][:2])
                if far < 1.0:
                    world.carried_by[thing] = (person, world.pose(thing)[0] - world.data.mocap_pos[at])

    def step(self, now):
        """Lets the world go on to a time in s since the start."""
        end = min(now, self.world.now - self.started + 0.1)
        while self.world.now - self.started < end:
            if self.grips is not None:
                closed, since, start = self.grips
                share = min((self.world.now - since) / 0.4, 1.0)
                for at, (opened, shut) in self.model.grips.items():
                    self.goal[at] = start[at] + ((shut if closed else opened) - start[at]) * share
                if self.world.now - since > 0.9:
                    self.grips = None
            self.world.step(self.goal)
        return now - end

    def things(self):
        """Things in view with their poses: (id, position, quaternion w x y z, sides)."""
        found = []
        for thing in self.model.free:
            if self.world.is_visible(thing):
                position, quaternion = self.world.pose(thing)
                low, high = self.world.bounds(thing)
                found.append((thing, [float(x) for x in position], [float(x) for x in quaternion], [float(x) for x in high - low]))
        return found

    def name(self, thing):
        """What a detector calls a thing."""
        return self.model.entities[thing]["names"][0]

    def holds(self):
        """Things in the hand, by the truth of the world."""
        return self.world.held()

    def given(self):
        """Things that people have taken, with the person."""
        return {thing: person for thing, (person, _) in self.world.carried_by.items()}


class Ramp:
    """A camera at the base whose pictures have a ramp of bytes, with a depth of 1.25 m in the left half."""

    def __init__(self, is_compressed):
        self.is_compressed = is_compressed

    def take(self, _body, frame):
        data = bytes(at % 251 for at in range(3 * 64 * 48))
        image = {"width": 64, "height": 48, "step": 192, "encoding": "rgb8", "data": data}
        if self.is_compressed:
            image = compressed(data, 64, 48)
        depth = b"".join(([1250, 0][at % 64 >= 32]).to_bytes(2, "little") for at in range(64 * 48))
        return {"image": image, "info": {"width": 64, "height": 48, "k": [60.0, 0.0, 32.0, 0.0, 60.0, 24.0, 0.0, 0.0, 1.0]},
                "depth": {"width": 64, "height": 48, "step": 128, "encoding": "16UC1", "data": depth}}, (frame, None, None)


def compressed(pixels, width, height, kind="jpeg"):
    """A `sensor_msgs/CompressedImage` of red, green and blue bytes."""
    import io

    from PIL import Image
    file = io.BytesIO()
    Image.frombytes("RGB", (width, height), pixels).save(file, kind, quality=95, subsampling=0)
    return {"format": "rgb8; %s compressed bgr8" % kind, "data": file.getvalue()}


class Rendered:
    """The first camera of the world of MuJoCo. Of its pictures, every fourth row and column is sent."""

    EVERY = 4

    def __init__(self, world):
        from motet_mujoco.camera import Camera
        self.world, self.camera = world, Camera(world)

    def take(self, body, _frame):
        import numpy as np
        from motet_mujoco.camera import quaternion
        picture = self.last = self.camera.look(self.world.model.cameras[0])
        colour = np.ascontiguousarray(picture.colour[::self.EVERY, ::self.EVERY])
        depth = np.ascontiguousarray(picture.depth[::self.EVERY, ::self.EVERY]).astype("<f4")
        height, width = depth.shape
        (cx, cy), focal = [part / self.EVERY for part in picture.centre], picture.focal / self.EVERY
        x, y, yaw = body.base
        turned = np.array([[math.cos(yaw), math.sin(yaw), 0.0], [-math.sin(yaw), math.cos(yaw), 0.0], [0.0, 0.0, 1.0]])
        position = turned @ (picture.position - np.array([x, y, 0.0]))
        return {"image": {"width": width, "height": height, "step": 3 * width, "encoding": "rgb8", "data": colour.tobytes()},
                "depth": {"width": width, "height": height, "step": 4 * width, "encoding": "32FC1", "data": depth.tobytes()},
                "info": {"width": width, "height": height, "k": [focal, 0.0, cx, 0.0, focal, cy, 0.0, 0.0, 1.0]},
                }, ("camera_optical", [float(part) for part in position], quaternion(turned @ picture.rotation))


    def boxes(self, body):
        """Boxes in the last picture around the things in view: name, middle and sides in pixels."""
        import itertools

        import numpy as np
        picture, (cx, cy) = self.last, self.last.centre
        for thing, position, _, sides in body.things():
            corners = [np.array(position) + np.array(signs) * sides / 2.0 for signs in itertools.product((-1.0, 1.0), repeat=3)]
            seen = [picture.rotation.T @ (corner - picture.position) for corner in corners]
            if min(z for _, _, z in seen) > 0.1:
                pixels = np.array([(x / z * picture.focal + cx, y / z * picture.focal + cy) for x, y, z in seen]) / self.EVERY
                low, high = pixels.min(axis=0), pixels.max(axis=0)
                yield body.name(thing), [float(part) for part in (low + high) / 2.0], [float(part) for part in high - low]


class Robot:
    """Topics and action servers of a robot that a binding names."""

    def __init__(self, binding, body, faults, domain, log, sigma=0.0, turns=0, seen=(), pictures=None):
        ros = binding.get("ros", {})
        self.types = Types(ros.get("distribution", "jazzy"))
        self.node, self.body, self.faults, self.log = Node(self.types, domain), body, set(faults), log
        self.map, self.frame = binding.get("frames", {}).get("map", "map"), binding["frames"]["base"]
        self.begun, self.last = time.monotonic(), {}
        publish = self.node.publisher
        self.joint_states = publish(binding["joints"]["topic"], "sensor_msgs/JointState")
        base = binding.get("base", {})
        self.odometry = publish(base["odometry"], "nav_msgs/Odometry") if "odometry" in base else None
        self.tf, self.tf_static = publish("/tf", "tf2_msgs/TFMessage"), publish("/tf_static", "tf2_msgs/TFMessage", LATCHED)
        self.localization = None
        if "localization" in base:
            quality = RELIABLE if "volatile" in self.faults else LATCHED
            self.localization = publish(base["localization"], "geometry_msgs/PoseWithCovarianceStamped", quality)
        self.sigma, self.is_localized = sigma, False
        # Things that a detector sees besides: class and position. End of the time in which the base rolls.
        self.seen, self.rolling = seen, None
        # Axes of the base with how often they have gone round, which only joint states tell.
        axes = [controller["base"] for controller in binding.get("controllers", []) if "base" in controller]
        self.axis, self.turns = (axes[0][2] if axes else None), turns
        self.detections = self.boxes = None
        if "detections" in binding:
            # In space, or in the pictures of a camera.
            kind = "vision_msgs/Detection2DArray" if "camera" in binding["detections"] else "vision_msgs/Detection3DArray"
            writer = publish(binding["detections"]["topic"], kind)
            self.detections, self.boxes = (None, writer) if "camera" in binding["detections"] else (writer, None)
        self.camera = None
        if binding.get("cameras"):
            camera = binding["cameras"][0]
            self.pictures = pictures or Ramp(camera["image"].endswith("/compressed"))
            kind = "sensor_msgs/CompressedImage" if camera["image"].endswith("/compressed") else "sensor_msgs/Image"
            self.camera = {"image": (publish(camera["image"], kind), kind),
                           "info": (publish(camera["info"], "sensor_msgs/CameraInfo"), "sensor_msgs/CameraInfo")}
            if "depth" in camera:
                self.camera["depth"] = (publish(camera["depth"], "sensor_msgs/Image"), "sensor_msgs/Image")
        self.servers, self.trajectories, self.twists = [], {}, None
        for controller in binding.get("controllers", []):
            self.serve_trajectories(controller)
        if "navigation" in binding:
            self.serve_navigation(binding["navigation"]["action"])
        if "move_group" in binding:
            self.serve_move_group(binding["move_group"].get("action", "/move_action"))
        if "gripper" in binding:
            self.serve_gripper(binding["gripper"])
        self.hand = None

    def note(self, event, **values):
        if self.log:
            self.log.write(json.dumps({"at": time.time(), "event": event, **values}) + "\n")
            self.log.flush()

    # Trajectories.

    def serve_trajectories(self, controller):
        names = controller.get("base") or controller["joints"]
        is_base, key = "base" in controller, controller["action"]

        def accept(goal):
            return "reject" not in self.faults and sorted(goal.trajectory.joint_names) == sorted(names)

        def begin(goal):
            points = [(one.time_from_start.sec + one.time_from_start.nanosec * 1e-9, list(one.positions),
                       list(one.velocities) or [0.0] * len(one.positions)) for one in goal.goal.trajectory.points]
            own = list(goal.goal.trajectory.joint_names)
            self.note("trajectory", action=key, id=list(goal.id), joints=own, points=points)
            running = self.trajectories.get(key)
            if running and "deaf" in self.faults:
                server.end(goal, ABORTED, error_code=-1, error_string="deaf")
                return
            if running:
                server.end(running[0], ABORTED, error_code=-4, error_string="another goal took its place")
            start = [self.body.base[at] for at in range(3)] if is_base else [self.body.joints[name] for name in own]
            if points[0][0] > 0.0:
                points.insert(0, (0.0, start, [0.0] * len(start)))
            self.trajectories[key] = (goal, points, own, is_base, time.monotonic())

        def cancel(goal):
            self.note("cancel", action=key, id=list(goal.id), base=list(self.body.base))
            running = self.trajectories.get(key)
            if running and running[0] is goal:
                del self.trajectories[key]
                self.halt(running)
            if "rolls" in self.faults and not is_base:
                self.rolling = time.monotonic() + 3.0
            server.end(goal, CANCELED)

        server = ActionServer(self.node, key, "control_msgs/FollowJointTrajectory", accept, begin, cancel, self.faults)
        self.servers.append(server)
        server.finish = lambda goal: server.end(goal, SUCCEEDED)

    def halt(self, running):
        _, _, own, is_base, _ = running
        if is_base:
            self.body.drive(self.body.base, [0.0] * 3)
        else:
            self.body.aim({name: self.body.joints[name] for name in own}, {})

    def roll(self):
        """Lets the base roll on its own."""
        if self.rolling:
            x, y, yaw = self.body.base
            is_over = time.monotonic() > self.rolling
            self.rolling = None if is_over else self.rolling
            self.body.drive([x + 0.0002, y, yaw], [0.0 if is_over else 0.1, 0.0, 0.0])

    def follow(self):
        now = time.monotonic()
        for key, running in list(self.trajectories.items()):
            goal, points, own, is_base, begun = running
            places, speeds = spline(points, own, now - begun)
            if is_base:
                x, y, yaw = [places[name] for name in own]
                self.body.drive([x, y, yaw - 2.0 * math.pi * self.turns], [speeds[name] for name in own])
            else:
                self.body.aim(places, speeds)
            if "early" in self.faults and 2.0 * (now - begun) > points[-1][0] and goal.status < SUCCEEDED:
                self.note("early")
                next(server for server in self.servers if server.name == key).finish(goal)
            if "die" in self.faults and now - begun > 0.4:
                os.kill(os.getpid(), signal.SIGKILL)
            if now - begun >= points[-1][0] + self.settles(places, own, is_base, now - begun - points[-1][0]):
                del self.trajectories[key]
                self.note("done", action=key, id=list(goal.id))
                if goal.status < SUCCEEDED:
                    next(server for server in self.servers if server.name == key).finish(goal)

    def settles(self, places, own, is_base, late):
        """Seconds that a body still needs to arrive."""
        if late < 0.0:
            return 0.0
        off = [abs(places[name] - (self.body.base[at] if is_base else self.body.joints[name])) for at, name in enumerate(own)]
        return late + 1.0 if max(off) > 0.01 and late < 3.0 else 0.0

    # Navigation and hand.

    def serve_navigation(self, key):
        def begin(goal):
            pose = goal.goal.pose.pose
            yaw = 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)
            beside = 0.2 if "beside" in self.faults else 0.0
            end, start = [pose.position.x, pose.position.y + beside, yaw], list(self.body.base)
            secs = max(math.dist(end[:2], start[:2]) / 0.3, 0.5)
            self.note("navigate", id=list(goal.id), goal=end)
            self.trajectories[key] = (goal, [(0.0, start, [0.0] * 3), (secs, end, [0.0] * 3)], ["x", "y", "yaw"], True, time.monotonic())

        def cancel(goal):
            running = self.trajectories.pop(key, None)
            if running:
                self.halt(running)
            server.end(goal, CANCELED)

        server = ActionServer(self.node, key, "nav2_msgs/NavigateToPose", lambda _: "reject" not in self.faults, begin, cancel, self.faults)
        server.finish = lambda goal: server.end(goal, SUCCEEDED)
        self.servers.append(server)
        self.twists = self.node.subscription("/cmd_vel", "geometry_msgs/Twist")

    def serve_move_group(self, key):
        """MoveGroup: joints of a goal go straight to where it wants them; a pose has one solution."""
        def begin(goal):
            request, options = goal.goal.request, goal.goal.planning_options
            wanted = [{one.joint_name: one.position for one in goals.joint_constraints} for goals in request.goal_constraints]
            poses = [[goals.position_constraints[0].link_name, goals.position_constraints[0].header.frame_id,
                      *vars(goals.position_constraints[0].constraint_region.primitive_poses[0].position).values(),
                      *vars(goals.orientation_constraints[0].orientation).values()]
                     for goals in request.goal_constraints if goals.position_constraints]
            self.note("move_group", id=list(goal.id), group=request.group_name, joints=wanted, poses=poses,
                      speed=request.max_velocity_scaling_factor, keeps=options.planning_scene_diff.is_diff
                      and options.planning_scene_diff.robot_state.is_diff and request.start_state.is_diff)
            if "no-plan" in self.faults:
                server.end(goal, ABORTED, error_code={"val": -1, "message": "no plan"})
                return
            end = wanted[0] or {"arm_lift_joint": 0.25}
            start = [self.body.joints[name] for name in end]
            still = [0.0] * len(end)
            self.trajectories[key] = (goal, [(0.0, start, still), (1.5, list(end.values()), still)], list(end), False, time.monotonic())

        def cancel(goal):
            self.note("cancel", action=key, id=list(goal.id))
            running = self.trajectories.pop(key, None)
            if running:
                self.halt(running)
            server.end(goal, CANCELED, error_code={"val": -7})

        server = ActionServer(self.node, key, "moveit_msgs/MoveGroup", lambda _: "reject" not in self.faults, begin, cancel, self.faults)
        server.finish = lambda goal: server.end(goal, SUCCEEDED, error_code={"val": 1})
        self.servers.append(server)

    def heed_twists(self):
        """A base that is told to stop by its speeds stops, whatever its navigation does."""
        for twist in self.twists.take(16) if self.twists else ():
            if hasattr(twist, "linear"):
                self.note("twist", x=twist.linear.x)
                for key in [key for key, running in self.trajectories.items() if running[3]]:
                    self.halt(self.trajectories.pop(key))

    def serve_gripper(self, gripper):
        def begin(goal):
            closed = goal.goal.command.position < 0.5
            self.note("gripper", closed=closed)
            self.body.grip(closed)
            self.hand = (goal, time.monotonic())

        server = ActionServer(self.node, gripper["action"], gripper["type"], lambda _: True, begin, lambda goal: server.end(goal, CANCELED))
        self.servers.append(server)
        self.gripper = server

    def serve_hand(self):
        if self.hand is None:
            return
        goal, begun = self.hand
        is_done = not self.body.is_gripping() if hasattr(self.body, "is_gripping") else time.monotonic() - begun > 0.1
        if is_done:
            self.hand = None
            self.note("gripped", held=self.body.holds(), given=self.body.given())
            self.gripper.end(goal, SUCCEEDED, position=0.0, stalled=True, reached_goal=True)

    # Topics.

    def is_due(self, key, period):
        now = time.monotonic()
        if now - self.last.get(key, 0.0) < period:
            return False
        self.last[key] = now
        return True

    def tell(self):
        zero, body = self.types.zero, self.body
        header = {"stamp": stamp(), "frame_id": "odom"}
        framed = {"stamp": stamp(time.time() - 2.0), "frame_id": "odom"} if "late-tf" in self.faults else header
        if self.is_due("joints", 0.01):
            names = list(body.joints)
            joints, speeds = dict(body.joints), body.speeds
            if self.axis and self.turns:
                names.append(self.axis)
                joints[self.axis] = body.base[2] + 2.0 * math.pi * self.turns
            self.joint_states.write(zero("sensor_msgs/JointState", header=header, name=names, position=[joints[name] for name in names],
                                         velocity=[speeds.get(name, 0.0) for name in names]))
        if self.odometry and self.is_due("base", 0.02):
            x, y, yaw = body.base
            turn = {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)}
            vx, vy, wz = body.moves
            self.odometry.write(zero("nav_msgs/Odometry", header=header, child_frame_id=self.frame,
                                     pose={"pose": {"position": {"x": x, "y": y}, "orientation": turn}},
                                     twist={"twist": {"linear": {"x": vx, "y": vy}, "angular": {"z": wz}}}))
            self.tf.write(zero("tf2_msgs/TFMessage", transforms=[{"header": framed, "child_frame_id": self.frame, "transform": {
                "translation": {"x": x, "y": y}, "rotation": turn}}]))
        if self.is_due("slow", 0.5):
            still = {"translation": {}, "rotation": {"w": 1.0}}
            self.tf_static.write(zero("tf2_msgs/TFMessage", transforms=[{"header": {"frame_id": self.map}, "child_frame_id": "odom", "transform": still}]))
            if self.localization and ("volatile" in self.faults or not self.is_localized):
                # As AMCL does, once: nothing moves it.
                self.is_localized = True
                covariance = [0.0] * 36
                # Along the diagonal the place is as uncertain as sigma says, and across it certain.
                covariance[0] = covariance[1] = covariance[6] = covariance[7] = self.sigma**2 / 2.0
                self.localization.write(zero("geometry_msgs/PoseWithCovarianceStamped", header=header, pose={"covariance": covariance}))
        if self.detections and self.is_due("detections", 0.2):
            found = []
            for thing, position, (w, x, y, z), sides in body.things():
                words = [body.name(thing), ""] if "labels" in self.faults else [thing, thing]
                found.append((words, dict(zip("xyz", position)), {"x": x, "y": y, "z": z, "w": w}, dict(zip("xyz", sides))))
            for label, *position in self.seen:
                found.append(([label, ""], dict(zip("xyz", map(float, position))), {"w": 1.0}, dict.fromkeys("xyz", 0.08)))
            found = [{"results": [{"hypothesis": {"class_id": label, "score": 0.9}}], "id": own, "bbox": {
                "center": {"position": position, "orientation": turn}, "size": sides}} for (label, own), position, turn, sides in found]
            self.detections.write(zero("vision_msgs/Detection3DArray", header={"stamp": stamp(), "frame_id": self.map}, detections=found))
        if self.camera and self.is_due("camera", 0.5):
            self.take_pictures()

    def take_pictures(self):
        messages, (frame, position, turn) = self.pictures.take(self.body, self.frame)
        head = {"stamp": stamp(), "frame_id": frame}
        if position is not None:
            seen_from = {"header": {"stamp": head["stamp"], "frame_id": self.frame}, "child_frame_id": frame,
                         "transform": {"translation": dict(zip("xyz", position)), "rotation": dict(zip("wxyz", turn))}}
            self.tf.write(self.types.zero("tf2_msgs/TFMessage", transforms=[seen_from]))
        for name, (writer, kind) in self.camera.items():
            writer.write(self.types.zero(kind, header=head, **messages[name]))
        if self.boxes:
            found = [{"results": [{"hypothesis": {"class_id": label, "score": 0.9}}],
                      "bbox": {"center": {"position": {"x": x, "y": y}}, "size_x": width, "size_y": height}}
                     for label, (x, y), (width, height) in self.pictures.boxes(self.body)]
            self.boxes.write(self.types.zero("vision_msgs/Detection2DArray", header=head, detections=found))

    def run(self):
        while True:
            now = time.monotonic()
            self.follow()
            self.roll()
            behind = self.body.step(now - self.begun)
            if behind:
                # Time of a world that does not keep up stands still meanwhile.
                self.begun += behind
                self.trajectories = {key: (*one[:4], one[4] + behind) for key, one in self.trajectories.items()}
            for server in self.servers:
                server.step()
            self.serve_hand()
            self.heed_twists()
            self.tell()
            time.sleep(max(0.0, 0.002 - (time.monotonic() - now)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("binding")
    parser.add_argument("--scene", default="kitchen")
    parser.add_argument("--robot", default="hsr")
    parser.add_argument("--physics", action="store_true")
    parser.add_argument("--motet", default="motet")
    parser.add_argument("--fault", action="append", default=[])
    parser.add_argument("--domain", type=int, default=0)
    parser.add_argument("--log", help="file for what happens, one JSON object a line")
    parser.add_argument("--base", type=float, nargs=3, default=[0.0, 0.0, 0.0], help="pose of the base at the start")
    parser.add_argument("--sigma", type=float, default=0.005, help="standard deviation of the localisation in m")
    parser.add_argument("--turns", type=int, default=0, help="how often the axis of the base's yaw has gone round")
    parser.add_argument("--see", nargs=4, action="append", default=[], metavar=("CLASS", "X", "Y", "Z"),
                        help="something that the detector sees, without an id")
    parser.add_argument("--render", action="store_true", help="pictures are those of the camera in MuJoCo, with depth")
    args = parser.parse_args()
    with open(args.binding, "rb") as file:
        binding = tomllib.load(file)
    if args.physics:
        body = Physics(args.robot, args.scene, args.motet)
    else:
        names = [name for one in binding.get("controllers", []) for name in one.get("joints", [])]
        body = Still({**dict.fromkeys(names, 0.0), **START}, args.base)
    log = open(args.log, "a") if args.log else None
    pictures = Rendered(body.world) if args.render else None
    robot = Robot(binding, body, args.fault, args.domain, log, args.sigma, args.turns, args.see, pictures)
    print("ready", flush=True)
    robot.run()


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(0)
