"""ALTracker: the head, and in the mode Move the legs, follow a registered target.

Assumed: how quickly (30 % of the way and at most half the top speed, 50 times a second), and that it walks until 0.3 m are left.
"""

import math

from service import Refused, Service, api

TARGETS = ("RedBall", "Face", "LandMark", "LandMarks", "People", "Sound")
MODES = ("Head", "WholeBody", "Move", "Navigate")
EFFECTORS = ("None", "LArm", "RArm", "Arms")
GAIN, NEAR_M, TURN_GAIN = 0.3, 0.3, 1.0


class Tracker(Service):
    name = "ALTracker"

    def __init__(self, house):
        super().__init__(house)
        self.registered, self.target, self.event = {}, None, None
        self.mode, self.effector, self.far, self.lost, self.walks = "Head", "None", 2.0, True, False

    @api("v::(sm)")
    def registerTarget(self, target, parameters):
        if target not in TARGETS:
            raise Refused("unknown target: %s" % target)
        self.registered[target] = parameters

    @api("v::(s)")
    def unregisterTarget(self, target):
        self.registered.pop(target, None)
        if target == self.target:
            self._stop()

    @api("v::([s])")
    def unregisterTargets(self, targets):
        for target in targets:
            Tracker.unregisterTarget.__wrapped__(self, target)

    @api("v::()")
    def unregisterAllTargets(self):
        self.registered = {}
        self._stop()

    @api("[s]::()")
    def getRegisteredTargets(self):
        return sorted(self.registered)

    @api("v::(s)")
    def track(self, target):
        if target not in self.registered:
            raise Refused("%s is not registered" % target)
        self._follow(target, None)

    @api("v::(s)")
    def trackEvent(self, key):
        self._follow(key, key)

    @api("v::()")
    def stopTracker(self):
        self._stop()

    @api("v::(s)")
    def setMode(self, mode):
        if mode not in MODES:
            raise Refused("unknown mode: %s" % mode)
        self.mode = mode

    @api("s::()")
    def getMode(self):
        return self.mode

    @api("v::(s)")
    def setEffector(self, effector):
        if effector not in EFFECTORS:
            raise Refused("unknown effector: %s" % effector)
        self.effector = effector

    @api("s::()")
    def getEffector(self):
        return self.effector

    @api("v::(f)")
    def setMaximumDistanceDetection(self, metres):
        self.far = metres

    @api("v::(m)")
    def setRelativePosition(self, place):
        self.relative = place

    @api("v::(b)")
    def toggleSearch(self, on):
        self.searches = on

    @api("b::()")
    def isActive(self):
        return self.target is not None

    @api("b::()")
    def isTargetLost(self):
        return self.lost

    @api("s::()")
    def getActiveTarget(self):
        return self.target or ""

    @api("[s]::()")
    def getSupportedTargets(self):
        return list(TARGETS)

    @api("[s]::()")
    def getAvailableModes(self):
        return list(MODES)

    @api("[f]::(i)")
    def getTargetPosition(self, _frame):
        seen = self._see()
        return self.house.body.torso().into(seen[1]) if seen else []

    def _follow(self, target, event):
        self.target, self.event, self.lost = target, event, True
        self.house.memory.put("ALTracker/ActiveTargetChanged", target)

    def _stop(self):
        if self.target is not None:
            self.target, self.event, self.lost = None, None, True
            if self.walks:
                self.house.body.halt()
            self.walks = False
            self.house.memory.put("ALTracker/ActiveTargetChanged", "")

    def _see(self):
        """Where the target is in the picture and in the room."""
        world = self.house.world
        if self.target in ("Face", "People"):
            faces = world.faces(min(self.far, 3.0))
            return (faces[0][1], world.head_at(faces[0][0])) if faces else None
        if self.target == "RedBall":
            seen = world.ball(lambda name, ball: ball.get("color", name) == "red")
        elif self.event == "ALTracker/ColorBlobDetected":
            blob = self.house.services["ALColorBlobDetection"]
            seen = world.ball(blob._wanted) if blob.subscribers else None
        else:
            seen = None
        return seen[1:] if seen else None

    def _tick(self, now):
        if self.target is None:
            return
        seen = self._see()
        if not seen:
            if not self.lost:
                self.lost = True
                self.house.memory.put("ALTracker/TargetLost", self.target)
            return
        if self.lost:
            self.lost = False
            self.house.memory.put("ALTracker/TargetDetected", self.target)
        (x, y, _), place = seen
        body = self.house.body
        body.aim("HeadYaw", body.angles["HeadYaw"] + GAIN * x, 0.5)
        body.aim("HeadPitch", body.angles["HeadPitch"] + GAIN * y, 0.5)
        if self.effector != "None":
            self._point(place)
        if self.mode in ("Move", "Navigate"):
            self._near(place)
        elif self.mode == "WholeBody":
            self._turn(place)

    def _point(self, place):
        """Stretches an arm that way."""
        body = self.house.body
        for side, sign in (("L", 1), ("R", -1)):
            if self.effector in (side + "Arm", "Arms"):
                x, y, z = (a - b for a, b in zip(body.torso().into(place), (0.0, 0.098 * sign, 0.1)))
                body.aim(side + "ShoulderPitch", -math.atan2(z, math.hypot(x, y)), 0.5)
                body.aim(side + "ShoulderRoll", math.atan2(y, x), 0.5)
                body.aim(side + "ElbowRoll", -0.0349 * sign, 0.5)

    def _near(self, place):
        body = self.house.body
        x, y, _ = body.torso().into(place)
        off, far = math.atan2(y, x), math.hypot(x, y)
        self.walks = True
        body.walk(max(far - NEAR_M, 0.0) if abs(off) < 0.5 else 0.0, 0.0, TURN_GAIN * off if abs(off) > 0.1 else 0.0)
        if far < NEAR_M + 0.02:
            self.house.memory.put("ALTracker/TargetReached", self.target)

    def _turn(self, place):
        body = self.house.body
        x, y, _ = body.torso().into(place)
        off = math.atan2(y, x)
        self.walks = True
        body.walk(0.0, 0.0, TURN_GAIN * off if abs(off) > 0.5 else 0.0)

    def _state(self):
        tracking = {"target": self.target, "mode": self.mode, "effector": self.effector, "lost": self.lost}
        return {"tracking": tracking if self.target else None, "registered": sorted(self.registered)}
