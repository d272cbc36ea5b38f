"""The room around the robot, in the frame of the simulation (metres; x ahead, y left, z up), and what can be seen of it.

Who looks sees by geometry alone: the middle must be in the field of view, and five of 13 points of its disc must be
free of people, obstacles and other balls, as in the simulation. The robot's own arms hide nothing here, and a person is a
cylinder with a round head.
"""

import functools
import math

import rays
from space import Pose, length, minus, turn

COLORS = {
    "red": (255, 0, 0), "green": (0, 255, 0), "blue": (0, 0, 255), "yellow": (255, 255, 0), "grey": (128, 128, 128),
}
HEAD_M, WAIST_M = 0.10, 0.12
# Walls behind the edge of the room, and how thick they are.
WALL_M, THICK_M = 2.1, 0.1
AROUND = [(0.0, 0.0)] + [
    (part * math.cos(k * math.pi / 3), part * math.sin(k * math.pi / 3)) for part in (0.5, 0.9) for k in range(6)
]
FREE_POINTS = 5
# A sonar's rays: so many on circles at these parts of its half angle; what they meet too much aslant sends no echo.
CIRCLES = ((1, 0.0), (6, 0.33), (12, 0.67), (18, 1.0))
ECHO_COS = 0.75
# Pictures of marks are read up to 45 degrees aslant.
MARK_COS = math.sqrt(0.5)


def wall(middle, half):
    return [a - b for a, b in zip(middle, half)], [a + b for a, b in zip(middle, half)]


OUT = WALL_M + THICK_M / 2
ROOM = [
    wall((0, 0, -THICK_M / 2), (OUT, OUT, THICK_M / 2)), wall((OUT, 0, 1.5), (THICK_M / 2, OUT, 1.5)),
    wall((-OUT, 0, 1.5), (THICK_M / 2, OUT, 1.5)), wall((0, OUT, 1.5), (OUT, THICK_M / 2, 1.5)),
    wall((0, -OUT, 1.5), (OUT, THICK_M / 2, 1.5)),
]


class World:
    def __init__(self, house):
        self.house = house
        self.seconds = 0.0
        self.balls = {
            "red": {"at": [0.60, 0.15, 0.45], "radius": 0.03, "shape": "ball", "present": True},
            "green": {"at": [0.90, 0.90, 0.45], "radius": 0.04, "shape": "ball", "present": True},
            "blue": {"at": [0.90, -0.90, 0.45], "radius": 0.05, "shape": "ball", "present": True},
        }
        self.people = {
            "person": {"at": [1.6, -0.2], "height": 1.1, "present": False, "number": 1},
            "friend": {"at": [1.8, 0.5], "height": 1.2, "present": False, "number": 2},
        }
        self.obstacles = {
            "box": {"at": [1.0, -0.4], "size": [0.30, 0.30, 0.40], "color": "green", "present": False},
            "block": {"at": [1.0, 0.6], "size": [0.20, 0.60, 0.20], "color": "grey", "present": False},
        }
        self.landmarks = {}
        for number, aside in (("64", 0.2), ("80", -0.2)):
            facing = math.atan2(-aside, -1.0)
            self.landmarks[number] = {"at": [1.0, aside, 0.5], "facing": facing, "radius": 0.06, "present": False}

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

    def _things(self):
        """What rays meet, as (name, ray -> where)."""
        for name, ball in self.balls.items():
            if ball["present"]:
                yield name, functools.partial(rays.sphere, at=self.ball_at(ball), radius=ball["radius"])
        for name, one in self.people.items():
            if one["present"]:
                yield name, functools.partial(rays.pillar, at=one["at"], radius=WAIST_M, height=one["height"] - 2 * HEAD_M)
                yield name, functools.partial(rays.sphere, at=self.head_at(one), radius=HEAD_M)
        for name, one in self.obstacles.items():
            if one["present"]:
                low, high = _box(one)
                yield name, functools.partial(rays.box, low=low, high=high)

    def _free(self, eye, point, things):
        way, far = minus(point, eye), math.dist(point, eye)
        way = [part / far for part in way]
        hits = (thing(eye, way) for thing in things)
        return not any(hit and hit[0] < far for hit in hits)

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
        others = [thing for name, thing in self._things() if name != target]
        free = sum(self._free(camera.at, point, others) for point in disc)
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

    def colored(self, wanted, number=0):
        """The largest box in view that `wanted(name, box)`, as a circle as large."""
        seen = []
        for name, one in self.obstacles.items():
            if one["present"] and wanted(name, one):
                at, radius = (*one["at"], one["size"][2] / 2), sum(one["size"]) / 6
                sight = self.see(at, radius, name, number)
                if sight:
                    seen.append((sight[2], name, sight, at))
        return max(seen)[1:] if seen else None

    def marks(self, sizes, number=0):
        """The printed marks that a camera can read: (number, sighting)."""
        eye, seen = self.house.body.camera(number).at, []
        for name, mark in self.landmarks.items():
            way = minus(eye, mark["at"])
            aslant = (math.cos(mark["facing"]) * way[0] + math.sin(mark["facing"]) * way[1]) / max(length(way), 1e-6)
            sight = mark["present"] and aslant >= MARK_COS and self.see(mark["at"], mark["radius"], None, number)
            if sight and sizes[0] <= 2 * sight[2] <= sizes[1]:
                seen.append((int(name), sight))
        return seen

    # What stands in the way

    def blocks(self, base, place, clear):
        """Whether something stands closer to `place` than the robot may walk, and nearer than from `base`."""
        for one in self.people.values():
            far = math.dist(one["at"], place)
            if one["present"] and far < WAIST_M + clear and far < math.dist(one["at"], base[:2]):
                return True
        for one in self.obstacles.values():
            far = _beside(one, place)
            if one["present"] and far < clear and far <= _beside(one, base[:2]):
                return True
        return max(abs(place[0]), abs(place[1])) > WALL_M - clear and math.hypot(*place) > math.hypot(*base[:2])

    def echo(self, sonar):
        """The nearest echo of a sonar in metres."""
        mount = Pose(sonar["at"], turn((0, 0, 1), sonar["yaw"])) * Pose(rows=turn((0, 1, 0), sonar["pitch_down"]))
        at, nearest = self.house.body.torso() * mount, sonar["max_report"]
        things = [thing for _, thing in self._things()]
        things += [functools.partial(rays.box, low=low, high=high) for low, high in ROOM]
        for count, part in CIRCLES:
            out = turn((0, 1, 0), part * sonar["half_cone"])
            for ray in range(count):
                way = (Pose(rows=at.rows) * Pose(rows=turn((1, 0, 0), 2 * math.pi * ray / count)) * Pose(rows=out)).direction(0)
                # What is met first answers, or turns the ray away.
                hits = [hit for hit in (thing(at.at, way) for thing in things) if hit]
                far, normal = min(hits, default=(math.inf, way))
                if -sum(a * b for a, b in zip(normal, way)) > ECHO_COS:
                    nearest = min(nearest, far)
        return nearest


def _box(one):
    """The lowest and the highest corner of an obstacle."""
    (x, y), (long, wide, high) = one["at"], one["size"]
    return (x - long / 2, y - wide / 2, 0.0), (x + long / 2, y + wide / 2, high)


def _beside(one, place):
    """How far a place on the floor is from an obstacle."""
    low, high = _box(one)
    return math.hypot(*(max(low[i] - place[i], 0.0, place[i] - high[i]) for i in range(2)))
