"""ALSonar, and touches: what is near and what touches it.

Read: sonars measure only while somebody subscribed; touches and bumpers are always told, as 1.0 and 0.0.
"""

from service import Extractor

CLOSE_M = 0.5
PLACES = {
    "FrontTactilTouched": "Head/Touch/Front", "MiddleTactilTouched": "Head/Touch/Middle",
    "RearTactilTouched": "Head/Touch/Rear", "ChestButtonPressed": "ChestBoard/Button",
    "LeftBumperPressed": "LFoot/Bumper/Left", "RightBumperPressed": "RFoot/Bumper/Right",
    "BackBumperPressed": "Platform/BumperBack",
}


def place(event):
    """Where a touch is, as `TouchChanged` names it."""
    if event in PLACES:
        return PLACES[event]
    hand = "L" if event.startswith("HandLeft") else "R"
    part = event[len("HandLeft" if hand == "L" else "HandRight"):-len("Touched")]
    return "%sHand/Touch/%s" % (hand, part)


def touch(house, event, down):
    """A touch begins or ends."""
    if event not in house.body.table.touches:
        raise ValueError("this body has no %s" % event)
    house.memory.put(event, 1.0 if down else 0.0)
    house.memory.put("TouchChanged", [[place(event), down]])


def sonar_key(table, side):
    """Where a measured distance stands: Pepper's sonars are in its base."""
    where = "Platform/%s/Sonar" if table.kind == "pepper" else "US/%s"
    return "Device/SubDeviceList/%s/Sensor/Value" % (where % side)


class Sonar(Extractor):
    name = "ALSonar"
    outputs = ("SonarLeftDetected", "SonarRightDetected", "SonarLeftNothingDetected", "SonarRightNothingDetected")
    period_ms = 100

    def __init__(self, house):
        super().__init__(house)
        self.close = {}

    def _extract(self):
        memory = self.house.memory
        for sonar in self.house.body.table.sonars:
            side = sonar["name"][len("Sonar"):]
            metres = self.house.world.echo(sonar)
            memory.values[sonar_key(self.house.body.table, side)] = metres
            close = metres < CLOSE_M
            if close:
                memory.put("Sonar%sDetected" % side, metres)
            elif self.close.get(side, True):
                memory.put("Sonar%sNothingDetected" % side, metres)
            self.close[side] = close

    def _ended(self):
        self.close = {}
