"""The body: joints that move towards their targets every 20 ms, where it stands, walks and lies, and how warm it is."""

import math

from space import Pose, turn

# From standing to full speed, a second squared; as the simulation walks.
AHEAD_MPS2, TURN_RPS2 = 0.20, 1.50
# Nothing is walked into nearer than this, in metres from the middle of the robot to its edge.
CLEAR_M = 0.12
# A sole in the frame of its foot: the box of the table.
SOLE = [(x, y, -0.04519) for x in (0.1, -0.05) for y in (0.044, -0.044)]
FALL_MS = 300
# A step, and how much of it has a foot in the air: the shortest that is documented, a third of it on both feet.
STEP_S, AIR_S = 0.42, 0.28
# A walk has arrived when this much is left, in metres and radians.
THERE_M, THERE_RAD = 0.002, 0.005


def nearer(now, to, step):
    return now + min(max(to - now, -step), step)


class Body:
    def __init__(self, house, table):
        self.house, self.table = house, table
        self.angles = dict(table.postures["StandInit"])
        self.targets = {}
        self.posture = "StandInit"
        self.stiffness = {name: 1.0 for name in table.body}
        self.celsius = {name: 38.0 for name in table.body}
        self.awake = True
        self.fallen = False
        self.lying = ""
        self.base = [0.0, 0.0, 0.0]
        self.speed = [0.0, 0.0, 0.0]
        self.wanted = [0.0, 0.0, 0.0]
        self.goal = None
        # How long the step that is being made has lasted, in seconds; none when it stands.
        self.step_s = None
        # Whether a foot feels the ground.
        self.on_ground = True
        self.height = self._height()

    def aim(self, name, angle, fraction):
        """Sends a joint somewhere at a fraction of its top speed; without stiffness it is accepted and nothing moves."""
        name = self.table.coupled.get(name, name)
        lowest, highest, _ = self.table.joints[name]
        if self.stiffness[name] > 0:
            self.targets[name] = (min(max(angle, lowest), highest), min(max(fraction, 0.01), 1.0))
            self.posture = ""

    def freeze(self, names):
        for name in names:
            self.targets.pop(name, None)

    def arrived(self, names):
        return not any(self.table.coupled.get(name, name) in self.targets for name in names)

    def stiffen(self, names, stiffness):
        for name in names:
            self.stiffness[name] = min(max(stiffness, 0.0), 1.0)
            if self.stiffness[name] == 0:
                self.targets.pop(name, None)

    def stiff_legs(self):
        legs = self.table.groups["Legs"]
        return sum(self.stiffness[name] for name in legs) / len(legs)

    def step(self, seconds):
        for name, (target, fraction) in list(self.targets.items()):
            lowest, highest = self._range(name)
            inside = min(max(target, lowest), highest)
            most = self.table.joints[name][2] * fraction * seconds
            self.angles[name] = nearer(self.angles[name], inside, most)
            # A pitch that waits for the head to turn goes on when there is more room.
            if self.angles[name] == inside and (inside == target or "HeadYaw" not in self.targets):
                del self.targets[name]
        for follower, leader in self.table.coupled.items():
            self.angles[follower] = self.angles[leader]
        self._walk(seconds)
        self.height = self._height()

    def _range(self, name):
        """The limits of a joint now; the head's pitch has less room the further it is turned."""
        lowest, highest, _ = self.table.joints[name]
        if name != "HeadPitch" or self.table.kind == "pepper":
            return lowest, highest
        yaw, rows = abs(self.angles["HeadYaw"]), self.table.nao["head_pitch_by_yaw"]
        for one, other in zip(rows, rows[1:]):
            if yaw <= other[0]:
                part = (yaw - one[0]) / (other[0] - one[0])
                bounds = [a + (b - a) * part for a, b in zip(one[1:], other[1:])]
                return max(lowest, bounds[0]), min(highest, bounds[1])
        return rows[-1][1], rows[-1][2]

    # Walking

    def walk(self, ahead, left, around):
        top = self.table.top_speed
        self.goal = None
        self.wanted = [min(max(part, -most), most) for part, most in zip((ahead, left, around), top)]

    def walk_to(self, ahead, left, around, caps=None):
        """To a place seen from here, no faster than `caps`."""
        x, y, heading = self.base
        sin, cos = math.sin(heading), math.cos(heading)
        self.goal = [x + cos * ahead - sin * left, y + sin * ahead + cos * left, heading + around]
        self.caps = [min(one, other) for one, other in zip(caps or self.table.top_speed, self.table.top_speed)]

    def halt(self, at_once=False):
        """It stands once its step is over; `at_once` with a foot in the air is for who knows that."""
        self.goal, self.wanted = None, [0.0, 0.0, 0.0]
        if at_once:
            self.speed, self.step_s = [0.0, 0.0, 0.0], None

    def wants(self):
        return self.goal is not None or any(abs(part) > 1e-6 for part in self.wanted)

    def moving(self):
        return self.wants() or self.step_s is not None or any(abs(part) > 1e-6 for part in self.speed)

    def in_the_air(self):
        """Whether a step has a foot in the air: whoever sets the legs now makes it fall."""
        return self.step_s is not None and self.step_s < AIR_S

    def legs_set(self, what):
        """Somebody sets the legs."""
        if self.in_the_air():
            self.house.violations.append("%s in mid-step" % what)
            self.push()

    def _walk(self, seconds):
        if self.goal is not None:
            self._towards(self.goal)
        if self.fallen or not self.awake or self.stiff_legs() == 0:
            self.halt(at_once=True)
            return
        self._feet(seconds)
        most = [AHEAD_MPS2 * seconds, AHEAD_MPS2 * seconds, TURN_RPS2 * seconds]
        self.speed = [nearer(now, to, step) for now, to, step in zip(self.speed, self.wanted, most)]
        x, y, heading = self.base
        sin, cos = math.sin(heading), math.cos(heading)
        ahead, left, around = (part * seconds for part in self.speed)
        place = [x + cos * ahead - sin * left, y + sin * ahead + cos * left]
        if (ahead or left) and self.house.world.blocks(self.base, place, CLEAR_M):
            self.speed[:2] = [0.0, 0.0]
            self.goal = None
            place = [x, y]
        self.base = [*place, math.remainder(heading + around, 2 * math.pi)]

    def _feet(self, seconds):
        """One step after the other for as long as it wants to go on; the last one brings it to rest. Pepper has wheels."""
        if self.table.kind == "pepper":
            return
        if self.step_s is None:
            self.step_s = 0.0 if self.wants() else None
            return
        self.step_s += seconds
        if not self.wants() and not self.in_the_air():
            self.step_s, self.speed = None, [0.0, 0.0, 0.0]
        elif self.step_s >= STEP_S:
            self.step_s = 0.0

    def _towards(self, goal):
        x, y, heading = self.base
        sin, cos = math.sin(heading), math.cos(heading)
        over, aside = goal[0] - x, goal[1] - y
        left = [cos * over + sin * aside, cos * aside - sin * over, math.remainder(goal[2] - heading, 2 * math.pi)]
        if abs(left[0]) < THERE_M and abs(left[1]) < THERE_M and abs(left[2]) < THERE_RAD:
            self.halt()
            self.speed = [0.0, 0.0, 0.0]
            return
        # So fast that it can still stop there.
        rates = [AHEAD_MPS2, AHEAD_MPS2, TURN_RPS2]
        self.wanted = [
            math.copysign(min(most, math.sqrt(2 * rate * abs(way)) * 0.95 + 1e-3), way)
            for way, most, rate in zip(left, self.caps, rates)
        ]

    # Where things are

    def torso(self):
        x, y, heading = self.base
        return Pose((x, y, self.height), turn((0, 0, 1), heading))

    def _link(self, wanted, joints=None):
        """The pose of a link in the torso's frame."""
        path, child = [], wanted
        while child != "Torso":
            row = next(row for row in self.table.chain if row["child"] == child)
            path.append(row)
            child = row["parent"]
        pose = Pose()
        for row in reversed(path):
            pose = pose * Pose(row["at"], turn(row["axis"], (joints or self.angles)[row["name"]]))
        return pose

    def _height(self):
        """The torso stays level, and the lower foot stands on the floor."""
        if self.table.kind == "pepper":
            return 0.82
        feet = [self._link("LFoot"), self._link("RFoot")]
        return -min(foot.out(corner)[2] for foot in feet for corner in SOLE)

    def head(self):
        return self.torso() * self._link("Head")

    def camera(self, number=0):
        """The pose of a camera in the room: it looks ahead."""
        row = self.table.camera_table[number]
        return self.head() * Pose(row["at"], turn((0, 1, 0), row["pitch_down"]))

    # Carrying, falling and heat

    def carry(self, carried):
        """Somebody lifts it, which ends its walk, or sets it on its feet."""
        self.on_ground = not carried
        if carried:
            self.halt(at_once=True)
            self.house.release("walk", "stop")
        self.house.memory.values["footContact"] = float(self.on_ground)
        self.house.memory.put("footContactChanged", self.on_ground)

    def push(self, onto="belly"):
        """Pushed over: its fall manager ends everything and lets the motors go."""
        if self.lying or self.table.kind == "pepper":
            return
        memory = self.house.memory
        self.lying = "LyingBack" if onto == "back" else "LyingBelly"
        self.fallen = True
        memory.put("ALMotion/RobotIsFalling", True)
        memory.put("ALMotion/RobotIsStand", False)
        self.halt(at_once=True)
        self.house.release("task", "walk", "stop", "posture", "wake")
        self.stiffen(self.table.body, 0.0)
        self.house.wait("fall", FALL_MS, lambda whole: self._landed())

    def _landed(self):
        memory = self.house.memory
        memory.put("ALMotion/RobotIsFalling", False)
        memory.put("robotHasFallen", True)
        self.posture = self.lying
        self.house.services["ALRobotPosture"]._told()
        self.house.services["ALAutonomousLife"]._fell()

    def upright(self):
        """Stands again, by itself or in somebody's hands."""
        if self.lying:
            self.lying, self.fallen = "", False
            self.house.memory.put("robotHasFallen", False)
            self.house.memory.put("ALMotion/RobotIsStand", True)

    def heat(self, joint, celsius):
        self.celsius[joint] = celsius
        hot = self.hot()
        self.house.memory.put("Device/SubDeviceList/%s/Temperature/Sensor/Value" % joint, float(celsius))
        self.house.memory.put("HotDeviceDetected", hot)

    def hot(self):
        return [name for name, celsius in self.celsius.items() if celsius >= 75.0]
