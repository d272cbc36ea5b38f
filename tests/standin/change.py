"""What `StandIn.world` can change, a function a field; `standin.py` says what each means."""

import math

from near import touch
from service import Refused

# How loud somebody speaks and claps, as in the simulation.
SPOKEN, LOUD = 0.6, 0.95


def balls(house, wanted):
    for name, fields in wanted.items():
        ball = house.world.balls.setdefault(name, {"at": [1.0, 0.0, 0.45], "radius": 0.03, "shape": "ball", "present": True})
        path = fields.get("path", ball.get("path"))
        ball.update(fields)
        ball["at"] = [float(part) for part in ball["at"]]
        ball["path"] = dict(path, since=house.now() / 1e3) if path and "path" in fields else path


def people(house, wanted):
    for name, fields in wanted.items():
        new = {"at": [1.6, -0.2], "height": 1.1, "present": True, "number": len(house.world.people) + 1}
        person = house.world.people.setdefault(name, new)
        person.update(fields)
        person["at"] = [float(part) for part in person["at"]]


def landmarks(house, wanted):
    for name, fields in wanted.items():
        int(name)
        kept(house.world.landmarks, name, fields, {"radius": 0.06, "facing": math.pi, "present": True})


def obstacles(house, wanted):
    for name, fields in wanted.items():
        kept(house.world.obstacles, name, fields, {"size": [0.3, 0.3, 0.4], "color": "grey", "present": True})


def kept(things, name, fields, at_first):
    if fields is None:
        things.pop(name, None)
    else:
        thing = {**at_first, **things.get(name, {}), **fields}
        thing["at"] = [float(part) for part in thing["at"]]
        things[name] = thing


def word(house, wanted):
    house.services["ALSpeechRecognition"]._spot(wanted["word"], wanted.get("confidence"))
    if "at" in wanted:
        house.services["ALSoundLocalization"]._heard(wanted["at"], SPOKEN)


def sound(house, wanted):
    house.services["ALSoundLocalization"]._heard(wanted["at"], float(wanted.get("loudness", LOUD)))


def heat(house, wanted):
    for joint, celsius in wanted.items():
        if joint not in house.body.celsius:
            raise ValueError("this body has no %s" % joint)
        house.body.heat(joint, float(celsius))


def joints(house, wanted):
    for joint, angle in wanted.items():
        if joint not in house.body.angles:
            raise ValueError("this body has no %s" % joint)
        house.body.angles[joint] = float(angle)
        house.body.targets.pop(joint, None)


def posture(house, wanted):
    house.body.angles.update(house.body.table.postures[wanted])
    house.body.targets.clear()
    house.body.posture = wanted


def awake(house, wanted):
    house.body.awake = wanted
    house.body.stiffen(house.body.table.body, 1.0 if wanted else 0.0)
    house.memory.put("robotIsWakeUp", wanted)


def life(house, wanted):
    house.services["ALAutonomousLife"]._set(wanted)


def pose(house, wanted):
    house.body.halt(at_once=True)
    house.body.base = [float(part) for part in wanted]


def network(house, wanted):
    house.services["ALConnectionManager"].used = {str(kind): int(strength) for kind, strength in wanted.items()}


def learned(house, wanted):
    house.services["ALFaceDetection"].learned = {int(number): name for number, name in wanted.items()}


FIELDS = {
    "balls": balls,
    "people": people,
    "landmarks": landmarks,
    "obstacles": obstacles,
    "learned": learned,
    "network": network,
    "hears_itself": lambda house, on: setattr(house.services["ALSpeechRecognition"], "hears_itself", on),
    "face_unknown_ms": lambda house, ms: setattr(house.services["ALFaceDetection"], "unknown_ms", float(ms)),
    "speech_ms_per_char": lambda house, ms: setattr(house.services["ALTextToSpeech"], "ms_per_char", float(ms)),
    "life_disabled_rests": lambda house, on: setattr(house.services["ALAutonomousLife"], "rests", on),
    "touch": lambda house, wanted: touch(house, wanted["part"], wanted["down"]),
    "word": word,
    "sound": sound,
    "battery": lambda house, percent: house.services["ALBattery"]._set(charge=int(percent)),
    "plugged": lambda house, on: house.services["ALBattery"]._set(plugged=on),
    "heat": heat,
    "pose": pose,
    "joints": joints,
    "posture": posture,
    "awake": awake,
    "push": lambda house, onto: house.body.push(onto),
    "carried": lambda house, carried: house.body.carry(carried),
    "stiffness": lambda house, wanted: [house.body.stiffen([joint], part) for joint, part in wanted.items()],
    "upright": lambda house, _: house.body.upright(),
    "life": life,
}


def apply(house, wanted):
    unknown = set(wanted) - set(FIELDS)
    if unknown:
        raise Refused("unknown field: %s" % ", ".join(sorted(unknown)))
    for field, change in FIELDS.items():
        if field in wanted:
            change(house, wanted[field])
