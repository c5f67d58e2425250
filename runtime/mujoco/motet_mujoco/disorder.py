"""Disorder: things that do not stand where the robot was told, and people who walk and speak by themselves."""

import numpy as np

# Distance in m that a thing keeps from others, greatest distance of a walk, the distance it keeps, its speed in m/s.
APART, STROLL, KEEPS, SPEED = 0.005, 1.0, 0.15, 0.6
# Distance in m of the middle of a thing from the rim of what it stands on.
RIM = 0.03
# Spots that are tried for a thing on another surface.
SPOTS = 40


def displace(world, room, chance):
    """Moves what stands on something a little on it, or onto another surface, as a profile says."""
    entities = world.model.entities
    surfaces = [one for one, entity in entities.items() if entity["kind"] == "Surface" and "shape" in entity]
    held = world.model.scene["robot"].get("holding")
    for thing in world.model.free:
        support = entities[thing].get("on")
        if support not in entities or thing == held:
            continue
        others = [one for one in surfaces if one != support and one in world.model.body_of]
        if others and chance.comes(room["misplaced"], "misplaced", thing):
            lay(world, thing, others[int(chance.random("surface", thing).integers(len(others)))], chance)
        else:
            before = world.pose(thing)[0]
            off = chance.error(room["shift_m"], "shift", thing)
            if off.any() and not moved(world, thing, before + [*off, 0.0], support):
                moved(world, thing, before, None)


def lay(world, thing, surface, chance):
    """Puts a thing on a surface, at a free spot; it stays where it is if there is none."""
    low, high = world.bounds(surface)
    before, random = world.pose(thing)[0], chance.random("spot", thing)
    below = before[2] - world.bounds(thing)[0][2]
    for _ in range(SPOTS):
        x, y = random.uniform(low[:2], high[:2])
        if moved(world, thing, np.array([x, y, high[2] + below + 1e-3]), surface):
            return
    moved(world, thing, before, None)


def moved(world, thing, place, support):
    """Puts a thing at a place. False where it is not on the support there, or too near to something else."""
    world.place(thing, place)
    world.refresh()
    if support is None:
        return True
    low, high = world.bounds(support)
    is_on = bool(np.all(place[:2] >= low[:2] + RIM) and np.all(place[:2] <= high[:2] - RIM))
    return is_on and not any(gap < APART for other, gap in world.gaps(thing, APART) if other != support)


class People:
    """What people do by themselves: walks that were asked for and others, and words."""

    def __init__(self, world, walks, says, per_minute, chance):
        self.world, self.walks, self.says = world, list(walks), sorted(says, key=lambda one: one[2])
        self.per_minute, self.chance = per_minute, chance
        self.second = 0

    def tick(self):
        """Moves people on, and answers what was said since the tick before: (person, text)."""
        world, now = self.world, self.world.now
        while self.second < now:
            self.second += 1
            for person in world.model.people:
                self.chance.next()
                is_busy = any(walk[0] == person for walk in self.walks)
                if not is_busy and self.chance.comes(self.per_minute / 60.0, "walks", person):
                    self.stroll(person)
        for walk in list(self.walks):
            person, target, start, speed = walk
            at = world.model.people.get(person)
            if at is None or now < start:
                continue
            off = np.array(target) - world.data.mocap_pos[at, :2]
            far = float(np.linalg.norm(off))
            if far > 1e-6:
                world.data.mocap_pos[at, :2] += off * min(1.0, speed * world.tick / far)
            else:
                self.walks.remove(walk)
        said = [one for one in self.says if one[2] <= now]
        self.says = self.says[len(said) :]
        return [(person, text) for person, text, _ in said]

    def stroll(self, person):
        """Sends a person off in some direction, unless something stands there."""
        world = self.world
        at = world.model.people[person]
        start = world.data.mocap_pos[at].copy()
        off = self.chance.error(STROLL / 2.0, "stroll", person)
        is_free = True
        for step in range(1, 11):
            world.data.mocap_pos[at, :2] = start[:2] + off * step / 10.0
            world.refresh()
            if any(gap < KEEPS for other, gap in world.gaps(person, KEEPS) if other != "floor"):
                is_free = False
                break
        world.data.mocap_pos[at] = start
        world.refresh()
        if is_free:
            self.walks.append((person, tuple(start[:2] + off), world.now, SPEED))
