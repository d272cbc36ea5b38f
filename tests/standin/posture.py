"""ALRobotPosture. Assumed: a robot whose motors are off answers false at once, one that lies needs three seconds to get up."""

from service import Refused, Service, api

FAMILIES = {
    "Stand": "Standing", "StandInit": "Standing", "StandZero": "Standing", "Crouch": "Crouching", "Sit": "Sitting",
    "SitRelax": "SittingOnChair", "LyingBelly": "LyingBelly", "LyingBack": "LyingBack",
}
GETTING_UP_MS = 3_000


class Posture(Service):
    name = "ALRobotPosture"

    def __init__(self, house):
        super().__init__(house)
        self.family, self.last = "Standing", "StandInit"

    @api("b::(sf)")
    def goToPosture(self, posture, speed):
        if posture not in self.house.body.table.postures:
            raise Refused("unknown posture: %s" % posture)
        if not 0 < speed <= 1:
            raise Refused("the speed must be from 0 to 1: %s" % speed)
        if not self.house.body.awake:
            return False
        return self._go(posture, speed, "posture")

    @api("b::(sf)")
    def applyPosture(self, posture, speed):
        return Posture.goToPosture.__wrapped__(self, posture, speed)

    @api("v::()")
    def stopMove(self):
        self.house.release("posture")

    @api("s::()")
    def getPosture(self):
        return self._now()

    @api("s::()")
    def getPostureFamily(self):
        return self._family()

    @api("[s]::()")
    def getPostureList(self):
        return sorted(self.house.body.table.postures)

    @api("[s]::()")
    def getPostureFamilyList(self):
        return sorted(set(FAMILIES.values()))

    def _go(self, posture, speed, kind, told=None):
        """Moves every joint there; answers whether it arrived, or what `told` of that gives."""
        body, house = self.house.body, self.house
        house.release("posture")
        rising = house.now() + GETTING_UP_MS if body.lying else 0
        body.stiffen(body.table.body, 1.0)
        body.halt()

        def due(now):
            if rising and now < rising:
                return False
            if rising and body.lying and not posture.startswith("Lying"):
                body.upright()
                aim()
            return body.arrived(body.table.body)

        def aim():
            for name, angle in body.table.postures[posture].items():
                body.aim(name, angle, speed)

        def ended(whole):
            if whole:
                body.posture = posture
            else:
                body.freeze(body.table.body)
            answer = told(whole) if told else whole
            self._told()
            return answer

        if not rising:
            aim()
        return house.block(kind, due, ended)

    def _now(self):
        """The posture that the joints are in."""
        body = self.house.body
        if body.lying:
            return body.lying
        near = {
            name: max(abs(body.angles[joint] - angle) for joint, angle in angles.items() if joint in self._legs())
            for name, angles in body.table.postures.items() if not name.startswith("Lying")
        }
        closest = body.posture if body.posture in near else min(near, key=near.get)
        return closest if near[closest] < 0.3 or closest == body.posture else "Unknown"

    def _legs(self):
        return self.house.body.table.groups["Legs"]

    def _family(self):
        return FAMILIES.get(self._now(), "Unknown")

    def _told(self):
        """Raises what has changed."""
        posture, family = self._now(), self._family()
        if posture != self.last:
            self.last = posture
            self.house.memory.put("PostureChanged", posture)
        if family != self.family:
            self.family = family
            self.house.memory.put("PostureFamilyChanged", family)
            self.house.memory.put("ALMotion/RobotIsStand", family == "Standing")

    def _tick(self, now):
        self._told()

    def _state(self):
        return {"posture": self._now(), "family": self._family()}
