"""Trails: the targets through which the robot came, so that it can go back the way that it came."""

import numpy as np

# Difference in m or rad between two points of a trail, and the most points that it has.
SPACING, MOST = 0.1, 200
# Ways back in m or rad after which a motion is tried: the sum of the greatest differences between points.
STATIONS = (0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0)


class Trail:
    """The last targets of the actuators, without those of the hand."""

    def __init__(self, grips):
        self.points, self.grips = [], list(grips)

    def add(self, target):
        """Notes targets, where they are no longer near to the last ones."""
        if not self.points or self.far(self.points[-1], target) > SPACING:
            self.points.append(target.copy())
            del self.points[:-MOST]

    def clear(self):
        """Forgets the way: what was moved since would be in it."""
        self.points.clear()

    def far(self, one, other):
        """Greatest difference of two targets."""
        off = np.abs(one - other)
        off[self.grips] = 0.0
        return float(off.max())

    def back(self, target):
        """Ways back from targets, each with the number of points that it leaves: to where the way is as long as each
        of the stations, and the last one to the beginning."""
        way, length, stations = [target.copy()], 0.0, list(STATIONS)
        for left in range(len(self.points) - 1, -1, -1):
            point = self.points[left].copy()
            point[self.grips] = target[self.grips]
            length += self.far(point, way[-1])
            way.append(point)
            if not stations or left > 0 and length < stations[0]:
                continue
            while stations and stations[0] <= length:
                stations.pop(0)
            yield left, list(way)
