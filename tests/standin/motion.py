"""ALMotion: joints, stiffness, walking, waking and resting.

`setAngles` answers at once, `angleInterpolation…` when the joints have arrived or `killAll` came, which leaves the
targets of `setAngles` alone. Read: `stopMove` answers when both feet are on the ground; whoever kills the walk before that,
as `killMove` and `killAll` do, makes it fall, and so does who sets the legs; a new `moveTo` takes the place of the one that
runs; the gait is the caller's (`MaxStepX`, `MaxStepY`, `MaxStepTheta`, of Pepper `MaxVelXY`, `MaxVelTheta`); no walk begins
without the ground under a foot or with legs of a stiffness up to 0.6. Assumed: a walk that is stopped or replaced answers
`moveTo` with false; a sideways step and a turn take two steps; `wakeUp` ends in StandInit.
"""

import math

from body import STEP_S
from service import Refused, Service, api


def numbers(value, count):
    """One number for all, or a list of as many."""
    values = list(value) if isinstance(value, (list, tuple)) else [value] * count
    if len(values) != count:
        raise Refused("%d values for %d joints" % (len(values), count))
    if not all(isinstance(one, (int, float)) and math.isfinite(one) for one in values):
        raise Refused("not a number: %s" % (values,))
    return values


# Names of the gait, with the lowest and highest value that is documented.
GAIT = {"MaxStepX": (0.001, 0.08), "MaxStepY": (0.101, 0.16), "MaxStepTheta": (0.001, 0.524), "MaxStepFrequency": (0.0, 1.0),
        "StepHeight": (0.005, 0.04), "TorsoWx": (-0.122, 0.122), "TorsoWy": (-0.122, 0.122)}
WHEELS = {"MaxVelXY": (0.1, 0.55), "MaxVelTheta": (0.2, 2.0), "MaxAccXY": (0.1, 0.55), "MaxAccTheta": (0.1, 3.0)}
# What both feet are apart in any step to the side, in metres.
APART_M = 0.1
STIFF_MIN = 0.6


class Motion(Service):
    name = "ALMotion"

    def __init__(self, house):
        super().__init__(house)
        self.breath, self.idle, self.protection = {}, {}, {}

    def _joints(self, names):
        joints = self.house.body.table.named(names)
        if joints is None:
            raise Refused("unknown joint or group: %s" % (names,))
        return joints

    def _aim(self, names, angles, fraction):
        if not 0 < fraction <= 1:
            raise Refused("the fraction of the speed must be from 0 to 1: %s" % fraction)
        joints = self._joints(names)
        if any(joint.startswith("Wheel") for joint in joints):
            raise Refused("wheels are moved by moveTo, move and moveToward only: %s" % (names,))
        if any(joint in self.house.body.table.groups["Legs"] for joint in joints):
            self.house.body.legs_set("legs set")
        for joint, angle in zip(joints, numbers(angles, len(joints))):
            self.house.body.aim(joint, angle, fraction)
        return joints

    # What the body is

    @api("[s]::(s)")
    def getBodyNames(self, name):
        return self._joints(name)

    @api("[s]::(s)")
    def getJointNames(self, name):
        return self._joints(name)

    @api("m::(s)")
    def getLimits(self, name):
        return [[*self.house.body.table.joints[joint], 1.5] for joint in self._joints(name)]

    @api("i::()")
    def getMotionCycleTime(self):
        return 20

    @api("m::()")
    def getRobotConfig(self):
        kind = self.house.body.table.kind
        return [["Model Type", "Head Version"], [self.house.body.table.model, "VERSION_60"], [kind]]

    @api("s::()")
    def getSummary(self):
        body = self.house.body
        lines = ["%-16s %5.2f %8.4f" % (name, body.stiffness[name], body.angles[name]) for name in body.table.body]
        return "Joint, stiffness, sensor\n" + "\n".join(lines)

    # Joints

    @api("[f]::(mb)")
    def getAngles(self, names, _sensors):
        return [self.house.body.angles[joint] for joint in self._joints(names)]

    @api("v::(mmf)")
    def setAngles(self, names, angles, fraction):
        self._aim(names, angles, fraction)

    @api("v::(mmf)")
    def changeAngles(self, names, changes, fraction):
        joints = self._joints(names)
        now = self.house.body.angles
        changes = numbers(changes, len(joints))
        self._aim(joints, [now[joint] + change for joint, change in zip(joints, changes)], fraction)

    @api("v::(mmf)")
    def angleInterpolationWithSpeed(self, names, angles, fraction):
        joints = self._aim(names, angles, fraction)
        return self._task(joints)

    @api("v::(mmmb)")
    def angleInterpolation(self, names, angles, times, absolute):
        joints, body = self._joints(names), self.house.body
        # The last of the points of each joint, as quickly as its time asks.
        last = lambda value: value[-1] if isinstance(value, (list, tuple)) else value
        listed = isinstance(angles, (list, tuple)) and (len(joints) > 1 or isinstance(angles[0], (list, tuple)))
        ends = [last(one) for one in angles] if listed else [last(angles)] * len(joints)
        times = [last(one) for one in times] if isinstance(times, (list, tuple)) else [times]
        for joint, end in zip(joints, numbers(ends, len(joints))):
            end = end if absolute else body.angles[joint] + end
            rate = abs(end - body.angles[joint]) / max(max(times), 0.02)
            body.aim(joint, end, rate / body.table.joints[joint][2])
        return self._task(joints)

    def _task(self, joints):
        def ended(whole):
            if not whole:
                self.house.body.freeze(joints)

        future = self.house.block("task", lambda now: self.house.body.arrived(joints), ended)
        self.house.jobs[-1].joints = joints
        return future

    @api("v::(s)")
    def openHand(self, name):
        return self._task(self._aim(name, 1.0, 0.8))

    @api("v::(s)")
    def closeHand(self, name):
        return self._task(self._aim(name, 0.0, 0.8))

    @api("v::()")
    def killAll(self):
        self.house.body.legs_set("killAll")
        self.house.release("task", "walk", "stop", "posture")
        self.house.body.halt(at_once=True)

    @api("v::([s])")
    def killTasksUsingResources(self, names):
        """Those that hold one of these joints."""
        joints = set(self._joints(names))
        for job in [job for job in self.house.jobs if job.kind == "task" and joints & set(getattr(job, "joints", joints))]:
            self.house.end(job, False)

    # Motors

    @api("v::(mm)")
    def setStiffnesses(self, names, stiffnesses):
        joints, body = self._joints(names), self.house.body
        standing = not body.lying and self.house.services["ALRobotPosture"]._family() == "Standing"
        for joint, stiffness in zip(joints, numbers(stiffnesses, len(joints))):
            body.stiffen([joint], stiffness)
        if standing and body.stiff_legs() == 0:
            self.house.violations.append("stiffness off while standing")
            body.push()

    @api("[f]::(m)")
    def getStiffnesses(self, names):
        return [self.house.body.stiffness[joint] for joint in self._joints(names)]

    @api("v::(mmm)")
    def stiffnessInterpolation(self, names, stiffnesses, times):
        joints = self._joints(names)
        last = lambda value: value[-1] if isinstance(value, (list, tuple)) else value
        self.house.body.stiffen(joints, last(stiffnesses))
        return self.house.wait("task", last(times) * 1e3)

    @api("b::()")
    def wakeUp(self):
        body = self.house.body
        body.stiffen(body.table.body, 1.0)
        if body.awake and not body.lying:
            return True
        body.awake = True
        self.house.memory.put("robotIsWakeUp", True)
        return self.house.services["ALRobotPosture"]._go("StandInit", 0.5, "wake")

    @api("v::()", "rest")
    def _rest(self):
        def ended(whole):
            body = self.house.body
            if whole:
                body.awake = False
                body.stiffen(body.table.body, 0.0)
                self.house.memory.put("robotIsWakeUp", False)

        self.house.body.halt()
        self.house.release("task", "walk", "stop", "posture", "wake")
        return self.house.services["ALRobotPosture"]._go("Crouch", 0.5, "wake", ended)

    @api("v::(s)", "rest")
    def _rest_chain(self, chain):
        self.house.body.stiffen(self._joints(chain), 0.0)

    @api("b::()")
    def robotIsWakeUp(self):
        return self.house.body.awake

    # Walking

    def _may_walk(self):
        """Whether the robot's own protection lets a walk begin."""
        body = self.house.body
        legs = [body.stiffness[joint] for joint in body.table.groups["Legs"]]
        stands = self.house.services["ALRobotPosture"]._family() not in ("Sitting", "SittingOnChair", "LyingBelly", "LyingBack")
        if not stands:
            self.house.violations.append("told to walk while it sits or lies")
        return stands and body.on_ground and min(legs) > STIFF_MIN

    def _walk(self, ahead, left, around):
        self.house.release("walk")
        if self._may_walk():
            self.house.body.walk(*numbers([ahead, left, around], 3))

    @api("v::(fff)", "move")
    def _move(self, ahead, left, around):
        self._walk(ahead, left, around)

    @api("v::(fffm)", "move")
    def _move_with(self, ahead, left, around, _config):
        Motion._move.__wrapped__(self, ahead, left, around)

    @api("v::(fff)", "moveToward")
    def _toward(self, ahead, left, around):
        top = self.house.body.table.top_speed
        self._walk(*[part * most for part, most in zip(numbers([ahead, left, around], 3), top)])

    @api("v::(fffm)", "moveToward")
    def _toward_with(self, ahead, left, around, _config):
        Motion._toward.__wrapped__(self, ahead, left, around)

    @api("b::(fff)", "moveTo")
    def _to(self, ahead, left, around):
        return self._go_to(numbers([ahead, left, around], 3), {})

    @api("b::(fffm)", "moveTo")
    def _to_with(self, ahead, left, around, config):
        known = WHEELS if self.house.body.table.kind == "pepper" else GAIT
        for name, value in config:
            if name not in known or not known[name][0] - 1e-6 <= value <= known[name][1] + 1e-6:
                raise Refused("no such gait: %s %s" % (name, value))
        return self._go_to(numbers([ahead, left, around], 3), dict(config))

    def _caps(self, gait):
        """How fast a gait is, on each axis."""
        if self.house.body.table.kind == "pepper":
            across = gait.get("MaxVelXY", 0.35)
            return [across, across, gait.get("MaxVelTheta", 1.0)]
        return [gait.get("MaxStepX", 0.04) / STEP_S, (gait.get("MaxStepY", 0.14) - APART_M) / (2 * STEP_S),
                gait.get("MaxStepTheta", 0.349) / (2 * STEP_S)]

    def _go_to(self, way, gait):
        body = self.house.body
        self.house.release("walk")
        if not self._may_walk():
            return False
        body.walk_to(*way, self._caps(gait))
        goal = body.goal

        def ended(_whole):
            near = math.dist(goal[:2], body.base[:2]) < 0.02
            return near and abs(math.remainder(goal[2] - body.base[2], 2 * math.pi)) < 0.05

        return self.house.block("walk", lambda now: body.goal is not goal and not body.moving(), ended)

    @api("v::()")
    def stopMove(self):
        """Answers when it stands on both feet."""
        self.house.body.halt()
        self.house.release("walk")
        return self.house.block("stop", lambda now: not self.house.body.moving()) if self.house.body.moving() else None

    @api("v::()")
    def killMove(self):
        body = self.house.body
        if not body.lying and self.house.services["ALRobotPosture"]._family() == "Standing":
            self.house.violations.append("killMove while standing")
        body.legs_set("killMove")
        body.halt(at_once=True)
        self.house.release("walk", "stop")

    @api("b::()")
    def moveIsActive(self):
        return self.house.body.moving()

    @api("v::()")
    def waitUntilMoveIsFinished(self):
        return self.house.block("walking", lambda now: not self.house.body.moving())

    @api("[f]::(b)")
    def getRobotPosition(self, _sensors):
        return self.house.body.base

    @api("[f]::()")
    def getRobotVelocity(self):
        return self.house.body.speed

    # What it does by itself

    @api("v::(sb)")
    def setBreathEnabled(self, chain, enabled):
        self._joints(chain)
        self.breath[chain] = enabled

    @api("b::(s)")
    def getBreathEnabled(self, chain):
        return self.breath.get(chain, False)

    @api("v::(sb)")
    def setIdlePostureEnabled(self, chain, enabled):
        self._joints(chain)
        self.idle[chain] = enabled

    @api("b::(s)")
    def getIdlePostureEnabled(self, chain):
        return self.idle.get(chain, False)

    @api("v::(sb)")
    def setExternalCollisionProtectionEnabled(self, name, enabled):
        self.protection[name] = enabled
        if not enabled:
            self.house.violations.append("collision protection off: %s" % name)

    @api("v::(b)")
    def setFallManagerEnabled(self, enabled):
        if not enabled:
            self.house.violations.append("fall manager off")
            raise Refused("it may not be disabled without the owner's consent")

    @api("b::()")
    def getFallManagerEnabled(self):
        return True

    def _state(self):
        body = self.house.body
        return {
            "joints": body.angles, "targets": {name: target for name, (target, _) in body.targets.items()},
            "stiffness": body.stiffness, "pose": body.base, "velocity": body.speed, "moving": body.moving(),
            "in_the_air": body.in_the_air(),
            "awake": body.awake, "fallen": body.fallen, "hot": body.hot(), "celsius": body.celsius,
            "breath": self.breath, "idle": self.idle,
        }
