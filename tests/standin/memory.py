"""ALMemory: keys, events, and an object to listen to each of them.

Measured on the real libqi: each registration gets its own copy of an event, and events that follow each other closely may
arrive in another order. An object of Python that is handed out while somebody registers at it may lock libqi for good (seen
in qi 3.1.5: one thread has the signal and wants Python, another has Python and wants the signal); so everybody gets one of
their own. Here numbers inside values travel as 8 bytes; a robot sends 4.
"""

import qi

from near import sonar_key
from service import Refused, Service, api


class Key:
    """What `subscriber` answers with."""

    def __init__(self):
        self.listened = self.was_listened = False
        self.signal = qi.Signal("m", self._listened)

    def _listened(self, some):
        self.listened = bool(some)
        self.was_listened = True

    _listened.__qi_signature__ = "DONOTBIND"


class Memory(Service):
    name = "ALMemory"

    def __init__(self, house):
        super().__init__(house)
        self.values, self.keys = {}, {}

    @api("o::(s)")
    def subscriber(self, key):
        # Those that nobody listens to any more go.
        known = [one for one in self.keys.get(key, []) if one.listened or not one.was_listened]
        self.keys[key] = [*known, Key()]
        return self.keys[key][-1]

    @api("m::(s)")
    def getData(self, key):
        value = self._look(key)
        if value is None:
            raise Refused("Data not found: %s" % key)
        return value

    @api("m::(m)")
    def getListData(self, keys):
        return [self._look(key) for key in keys]

    @api("[s]::()")
    def getDataListName(self):
        return sorted(self.values)

    @api("[s]::(s)")
    def getDataList(self, part):
        return sorted(key for key in self.values if part in key)

    @api("[s]::()")
    def getEventList(self):
        return sorted(self.keys)

    @api("v::(sm)")
    def insertData(self, key, value):
        self.values[key] = value

    @api("v::(sm)")
    def raiseEvent(self, key, value):
        self.put(key, value)

    @api("v::(sm)")
    def raiseMicroEvent(self, key, value):
        self.put(key, value)

    @api("v::(s)")
    def removeData(self, key):
        self.values.pop(key, None)

    def put(self, key, value):
        """Raises an event: the value is kept, and told to those who listen."""
        self.values[key] = value
        for one in list(self.keys.get(key, [])):
            one.signal(value)

    def _look(self, key):
        """Joints are measured at the moment they are asked for."""
        parts = key.split("/")
        if key.startswith("Device/SubDeviceList/") and key.endswith("/Position/Sensor/Value"):
            return self.house.body.angles.get(parts[2])
        return self.values.get(key)

    def _state(self):
        return {"listened": sorted(key for key, all in self.keys.items() if any(one.listened for one in all))}


def first(memory, table):
    """What a robot has in its memory from the beginning."""
    for key in table.touches:
        memory.values[key] = 0.0
    for name in table.body:
        memory.values["Device/SubDeviceList/%s/Position/Sensor/Value" % name] = 0.0
        memory.values["Device/SubDeviceList/%s/Temperature/Sensor/Value" % name] = 38.0
    for sonar in table.sonars:
        memory.values[sonar_key(table, sonar["name"][len("Sonar"):])] = 2.55
    memory.values.update({
        "TouchChanged": [], "redBallDetected": [], "FaceDetected": [], "WordRecognized": ["", -3.0],
        "LandmarkDetected": [], "PeoplePerception/PeopleList": [], "ALSoundLocalization/SoundLocated": [],
        "BatteryChargeChanged": 80, "BatteryPowerPluggedChanged": False, "BatteryLowDetected": False,
        "BatteryNearlyEmpty": False, "ALMotion/RobotIsFalling": False, "robotHasFallen": False,
        "ALMotion/RobotIsStand": True, "robotIsWakeUp": True, "PostureFamilyChanged": "Standing",
        "PostureChanged": "StandInit", "AutonomousLife/State": "solitary", "HotDeviceDetected": [],
        "footContact": 1.0,
        "ALTextToSpeech/TextDone": 1, "ALTextToSpeech/Status": [0, "done"], "RobotConfig/Body/Type": table.model,
    })
