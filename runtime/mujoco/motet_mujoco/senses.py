"""The room as the robot knows it: by the joints of its hand, by its beliefs, and by what its cameras show.

It answers the questions that `World` answers about itself. None means that the robot cannot know.
"""

import numpy as np

from .model import turned
from .sight import is_visible

# Seconds for which the fingers have to be closed on nothing before the hand counts as empty.
EMPTY = 0.05
# Height in m by which the hand has risen since a grasp once it bears the thing alone.
RAISED = 0.01
# Distance in m of a bump from where something is believed to be up to which that is what was met, and from the middle
# of what the hand holds up to which that touches the arm.
TOUCHES, ABOUT_HELD = 0.1, 0.15


class Senses:
    """A room by the senses of the robot."""

    def __init__(self, world, beliefs):
        self.world, self.beliefs, self.gripped = world, beliefs, 0.0

    def tick(self):
        """Notes what the joints of the hand feel: fingers that close on nothing have lost what they held."""
        held, now = self.beliefs.hand, self.world.now
        if held is None or self.world.is_gripping():
            self.gripped = now
        elif now - self.gripped > EMPTY:
            self.beliefs.forget(held)

    def held(self):
        """The thing that the robot has grasped, as long as its fingers meet something."""
        return self.beliefs.in_hand()

    def holds(self, thing):
        """True if the hand holds a thing."""
        return thing in self.held()

    def is_lifted(self, thing):
        """True if the hand holds a thing higher than where it grasped it."""
        since = self.beliefs.grasped_at
        return self.holds(thing) and (since is None or self.world.tip()[0][2] - since >= RAISED)

    def grasps(self, _thing):
        """True if the hand, told to close, has closed around something: its fingers meet it before their end."""
        return self.world.is_gripping()

    def is_touched(self, _thing):
        """True if something presses on a finger."""
        return self.world.feels_touch()

    def bumped(self, allowed=()):
        """What is believed to be where something presses on the robot, apart from those allowed; None if nothing
        does."""
        for point in self.world.bumps():
            held = [one for one in self.held() if one in allowed]
            if any(np.linalg.norm(self.beliefs.held_pose(one)[0] - point) < ABOUT_HELD for one in held):
                continue
            for person in self.world.model.people:
                self.beliefs.scan(person)
            gaps = {one: self.beliefs.gap(one, point) for one in self.beliefs.entities}
            near = {one: gap for one, gap in gaps.items() if gap is not None and gap < TOUCHES}
            met = min(near, key=near.get, default="something")
            if met not in allowed:
                return met
        return None

    def pose(self, entity):
        """Position and rotation of an entity; None if it is not known, or the entity has no body."""
        world, model = self.world, self.world.model
        if self.holds(entity):
            return self.beliefs.held_pose(entity)
        if entity in self.beliefs.things():
            known = self.beliefs.entities.get(entity, {}).get("pose")
            return None if known is None else (np.array(known["xyz"], dtype=float), turned(known))
        if entity in model.people:
            self.beliefs.scan(entity)
            known = self.beliefs.entities.get(entity, {}).get("pose")
            return None if known is None else (np.array(known["xyz"], dtype=float), turned(known))
        return world.pose(entity)

    def support(self, thing):
        """(relation, support) of a thing, (None, None) where it is believed to be on and in nothing, or None if nobody
        knows where it is."""
        known = self.beliefs.entities.get(thing)
        if known is None:
            return None
        if self.holds(thing) or thing in self.beliefs.given:
            return None, None
        found = next(((relation, known[relation]) for relation in ("on", "in") if known.get(relation)), None)
        return found or (None if "pose" not in known else (None, None))

    def supports(self, thing):
        """What a thing is on or in."""
        _, support = self.support(thing) or (None, None)
        return [] if support is None else [support]

    def rests(self, thing, relation, on):
        """True if a thing is on or in something."""
        support = self.support(thing)
        if support is None:
            # It is not where it was looked for.
            return False if on in self.beliefs.gone.get(thing, ()) else None
        return support == (relation, on)

    def is_on(self, thing, support):
        """True if a thing stands on another."""
        return self.rests(thing, "on", support)

    def is_in(self, thing, container):
        """True if a thing lies in a container."""
        return self.rests(thing, "in", container)

    def is_given(self, thing, person):
        """True if a person has a thing that the robot has given them, or of which it was told so."""
        if thing in self.beliefs.given:
            return self.beliefs.given[thing] == person
        return None if self.support(thing) is None else False

    def is_open(self, container):
        """True if a drawer or a door is open; None where nobody knows, or without one."""
        if container not in self.world.model.doors:
            return None
        return self.beliefs.entities.get(container, {}).get("open")

    def is_locked(self, container):
        """True if a lock keeps a drawer or a door shut."""
        return bool(self.beliefs.entities.get(container, {}).get("locked", False))

    def is_visible(self, one):
        """True if a camera could see an entity where it is believed to be, past what is believed to be before it."""
        if self.pose(one) is None:
            return False
        model, base = self.world.model, self.world.base()
        return is_visible(model, self.beliefs.room(), base, one)

    def is_located(self, thing):
        """True if a thing was seen or felt where it is believed to be."""
        return thing in self.beliefs.seen or self.holds(thing)
