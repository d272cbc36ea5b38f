"""The room around the robot, in the frame of the simulation (metres; x ahead, y left, z up), and what can be seen of it.

Who looks sees by geometry alone: the middle must be in the field of view, and five of 13 points of its disc must be
free of people, obstacles and other balls, as in the simulation. The robot's own arms hide nothing here.
"""

import math

from space import length, minus

COLORS = {"red": (255, 0, 0), "green": (0, 255, 0), "blue": (0, 0, 255), "yellow": (255, 255, 0)}
HEAD_M, WAIST_M = 0.10, 0.12
AROUND = [(0.0, 0.0)] + [
    (part * math.cos(k * math.pi / 3), part * math.sin(k * math.pi / 3)) for part in (0.5, 0.9) for k in range(6)
]
FREE_POINTS = 5


class World:
    def __init__(self, house):
        self.house = house
        self.seconds = 0.0
        self.balls = {
            "red": {"at": [0.60, 0.15, 0.45], "radius": 0.03, "shape": "ball", "present": True},
            "green": {"at": [0.90, 0.90, 0.45], "radius": 0.04, "shape": "ball", "present": True},
            "blue": {"at": [0.90, -0.90, 0.45], "radius": 0.05, "shape": "ball", "present": True},
        }
        self.people = {"person": {"at": [1.6, -0.2], "height": 1.1, "present": False, "number": 1}}
        self.landmarks = {}
        self.obstacles = {}

    def step(self, seconds):
        self.seconds = seconds

    # Where things are

    def ball_at(self, ball):
        """Where it is; one with a path swings around its place: amplitudes in metres, Hz and phases in radians a axis."""
        path = ball.get("path")
        if not path:
            return tuple(ball["at"])
        since = self.seconds - path["since"]
        phases = path.get("phase", [0, 0, 0])
        swings = zip(ball["at"], path["amplitude"], path["hz"], phases)
        return tuple(at + most * math.sin(2 * math.pi * hz * since + phase) for at, most, hz, phase in swings)

    def head_at(self, person):
        return (*person["at"], person["height"] - HEAD_M)

    # What hides

    def _round(self):
        return [(name, self.ball_at(ball), ball["radius"]) for name, ball in self.balls.items() if ball["present"]]

    def upright(self):
        """People and obstacles as (name, (x, y), radius, height)."""
        people = [(name, one["at"], WAIST_M, one["height"]) for name, one in self.people.items() if one["present"]]
        return people + [(name, one["at"], one["radius"], one["height"]) for name, one in self.obstacles.items()]

    def _free(self, eye, point, target):
        way = minus(point, eye)
        for name, at, radius in self._round():
            if name != target and _near(eye, way, at) < radius:
                return False
        for name, at, radius, height in self.upright():
            if name != target and _crosses(eye, way, at, radius, height):
                return False
        return True

    def see(self, at, radius, target, number=0):
        """(x, y, size) of a round thing in a camera, left and down positive, or nothing."""
        camera = self.house.body.camera(number)
        row = self.house.body.table.camera_table[number]
        here = camera.into(at)
        if here[0] <= 0 or length(here) <= radius:
            return None
        x, y = math.atan2(here[1], here[0]), math.atan2(-here[2], here[0])
        if abs(x) > row["hfov"] / 2 or abs(y) > row["vfov"] / 2:
            return None
        left, up = camera.direction(1), camera.direction(2)
        disc = [tuple(at[i] + (left[i] * a + up[i] * b) * radius for i in range(3)) for a, b in AROUND]
        free = sum(self._free(camera.at, point, target) for point in disc)
        return (x, y, math.asin(radius / length(here))) if free >= FREE_POINTS else None

    def ball(self, wanted, number=0):
        """The largest thing in view that `wanted(name, ball)`: its name, sighting and place."""
        seen = []
        for name, ball in self.balls.items():
            if ball["present"] and wanted(name, ball):
                at = self.ball_at(ball)
                sight = self.see(at, ball["radius"], name, number)
                if sight:
                    seen.append((sight[2], name, sight, at))
        return max(seen)[1:] if seen else None

    def faces(self, far, number=0):
        """People whose face is in view up to `far` metres, largest first: (person, sighting, distance)."""
        eye, seen = self.house.body.camera(number).at, []
        for name, person in self.people.items():
            head = self.head_at(person)
            distance = length(minus(head, eye))
            sight = person["present"] and distance <= far and self.see(head, HEAD_M, name, number)
            if sight:
                seen.append((person, sight, distance))
        return sorted(seen, key=lambda one: -one[1][2])

    # What stands in the way

    def blocks(self, base, place, clear):
        """Whether something stands closer to `place` than the robot may walk, and nearer than from `base`."""
        for _, at, radius, _ in self.upright():
            far = math.dist(at, place)
            if far < radius + clear and far < math.dist(at, base[:2]):
                return True
        return False

    def echo(self, sonar):
        """What a sonar measures in metres."""
        body, nearest = self.house.body, sonar["max_report"]
        eye = body.torso().out(sonar["at"])
        ahead = body.base[2] + sonar["yaw"]
        things = [(at, radius, 0.0, height) for _, at, radius, height in self.upright()]
        things += [(at[:2], radius, at[2] - radius, at[2] + radius) for _, at, radius in self._round()]
        for at, radius, low, high in things:
            over, aside = at[0] - eye[0], at[1] - eye[1]
            far = math.hypot(over, aside)
            off = abs(math.remainder(math.atan2(aside, over) - ahead, 2 * math.pi))
            wide = math.asin(min(1.0, radius / far)) if far > 0 else math.pi
            reach = math.tan(sonar["half_cone"]) * far
            if off <= sonar["half_cone"] + wide and low <= eye[2] + reach and high >= eye[2] - reach:
                nearest = min(nearest, max(far - radius, 0.0))
        return nearest


def _near(eye, way, at):
    """How near a line of sight passes a point."""
    to, whole = minus(at, eye), sum(part * part for part in way)
    part = min(max(sum(a * b for a, b in zip(to, way)) / whole, 0.0), 1.0) if whole else 0.0
    return length(minus(to, [step * part for step in way]))


def _crosses(eye, way, at, radius, height):
    """Whether a line of sight passes through a pillar that stands on the floor."""
    to = (at[0] - eye[0], at[1] - eye[1])
    whole = way[0] ** 2 + way[1] ** 2
    part = min(max((to[0] * way[0] + to[1] * way[1]) / whole, 0.0), 1.0) if whole else 0.0
    beside = math.hypot(to[0] - way[0] * part, to[1] - way[1] * part)
    return beside < radius and eye[2] + way[2] * part < height
