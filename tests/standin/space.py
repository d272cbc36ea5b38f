"""Poses in space: x ahead, y to the left, z up, in metres; turns as three rows."""

import math

LEVEL = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def turn(axis, angle):
    """A turn by `angle` radians about an axis."""
    length = math.sqrt(sum(part * part for part in axis))
    x, y, z = (part / length for part in axis)
    sin, cos = math.sin(angle), math.cos(angle)
    rest = 1.0 - cos
    return (
        (cos + x * x * rest, x * y * rest - z * sin, x * z * rest + y * sin),
        (y * x * rest + z * sin, cos + y * y * rest, y * z * rest - x * sin),
        (z * x * rest - y * sin, z * y * rest + x * sin, cos + z * z * rest),
    )


class Pose:
    def __init__(self, at=(0.0, 0.0, 0.0), rows=LEVEL):
        self.at, self.rows = tuple(at), rows

    def __mul__(self, inner):
        columns = list(zip(*inner.rows))
        rows = tuple(tuple(sum(a * b for a, b in zip(row, column)) for column in columns) for row in self.rows)
        return Pose(self.out(inner.at), rows)

    def out(self, point):
        """A point of this frame, seen from outside."""
        return tuple(sum(a * b for a, b in zip(row, point)) + at for row, at in zip(self.rows, self.at))

    def into(self, point):
        """A point from outside, seen in this frame."""
        from_here = [a - b for a, b in zip(point, self.at)]
        return tuple(sum(self.rows[j][i] * from_here[j] for j in range(3)) for i in range(3))

    def direction(self, axis):
        """An axis of this frame (0 ahead, 1 left, 2 up), seen from outside."""
        return tuple(row[axis] for row in self.rows)

    def inverse(self):
        return Pose(self.into((0.0, 0.0, 0.0)), tuple(zip(*self.rows)))

    def six(self):
        """As NAOqi's Position6D: x, y, z, and turns about x, y, z."""
        rows = self.rows
        pitch = math.atan2(-rows[2][0], math.hypot(rows[0][0], rows[1][0]))
        return [*self.at, math.atan2(rows[2][1], rows[2][2]), pitch, math.atan2(rows[1][0], rows[0][0])]


def length(vector):
    return math.sqrt(sum(part * part for part in vector))


def minus(one, other):
    return tuple(a - b for a, b in zip(one, other))
