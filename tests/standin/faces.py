"""ALFaceDetection and ALPeoplePerception: who is there, and who was met before.

Read: shapes, ranges, that the last of the faces is what was recognised, and that a name is told again only after four
seconds without. Assumed: a lost face is told once by an empty list; a face is seen up to 3 m and learned up to 2 m, as
in the simulation; learning takes half a second.
"""

from service import Refused, api, stamp
from vision import Seeing

FACE_M, LEARN_M, LEARN_MS = 3.0, 2.0, 500
PEOPLE_M, NEAREST_M = 3.5, 0.5
AGAIN_MS = 4_000


def eye(x, y):
    """Seven points of an eye."""
    return [x, y] * 7


class Faces(Seeing):
    name = "ALFaceDetection"
    outputs = ("FaceDetected",)
    period_ms = 100

    def __init__(self, house):
        super().__init__(house)
        self.learned, self.recognises, self.tracks = {}, True, False
        self.seen, self.since, self.last, self.unknown_ms = False, 0.0, {}, 8_000.0

    @api("b::(s)")
    def learnFace(self, name):
        if not name:
            return False

        def ended(whole):
            near = self.house.world.faces(LEARN_M, self.camera)
            if whole and near and name not in self.learned.values():
                self.learned[near[0][0]["number"]] = name
                return True
            return False

        return self.house.wait("learn", LEARN_MS, ended)

    @api("b::(s)")
    def reLearnFace(self, name):
        self._forget(name)
        return Faces.learnFace.__wrapped__(self, name)

    @api("b::(s)")
    def forgetPerson(self, name):
        return self._forget(name)

    @api("b::()")
    def clearDatabase(self):
        self.learned.clear()
        return True

    @api("[s]::()")
    def getLearnedFacesList(self):
        return sorted(self.learned.values())

    @api("v::(b)")
    def setRecognitionEnabled(self, on):
        self.recognises = on

    @api("b::()")
    def isRecognitionEnabled(self):
        return self.recognises

    @api("v::(b)")
    def setTrackingEnabled(self, on):
        self.tracks = on

    @api("v::(f)")
    def setRecognitionConfidenceThreshold(self, threshold):
        if not 0 <= threshold <= 1:
            raise Refused("from 0 to 1: %s" % threshold)

    def _forget(self, name):
        known = [number for number, label in self.learned.items() if label == name]
        for number in known:
            del self.learned[number]
        return bool(known)

    def _extract(self):
        now, faces = self.house.now(), self.house.world.faces(FACE_M, self.camera)
        if not faces:
            if self.seen:
                self.house.memory.put("FaceDetected", [])
            self.seen = False
            return
        if not self.seen:
            self.since, self.seen = now, True
        found, again = [], []
        for person, (x, y, size), _ in faces:
            label = self.learned.get(person["number"], "") if self.recognises else ""
            if label:
                if now - self.last.get(label, -AGAIN_MS) >= AGAIN_MS:
                    again.append(label)
                self.last[label] = now
            points = [eye(x + size / 3, y - size / 4), eye(x - size / 3, y - size / 4), [], [], [x, y] * 3, [x, y + size / 2] * 8]
            found.append([[0, x, y, 1.6 * size, 2 * size], [person["number"], 0.6 if label else 0.0, label, *points]])
        unknown = not any(self.learned.get(person["number"]) for person, _, _ in faces)
        found.append(self._recognised(again, unknown and now - self.since >= self.unknown_ms))
        self.house.memory.put("FaceDetected", [stamp(), found, *self._poses()])

    def _recognised(self, labels, unknown):
        if not self.recognises or not labels:
            return [4] if unknown and self.recognises else []
        return [2 if len(labels) == 1 else 3, labels]

    def _state(self):
        return {"learned": {str(number): name for number, name in self.learned.items()}}


class People(Seeing):
    name = "ALPeoplePerception"
    outputs = ("PeoplePerception/PeopleDetected", "PeoplePerception/PeopleList", "PeoplePerception/JustArrived",
               "PeoplePerception/JustLeft")
    period_ms = 100

    def __init__(self, house):
        super().__init__(house)
        self.known, self.far = [], PEOPLE_M

    @api("v::(f)")
    def setMaximumDetectionRange(self, far):
        self.far = far

    @api("f::()")
    def getMaximumDetectionRange(self):
        return self.far

    @api("v::()")
    def resetPopulation(self):
        self.known = []

    def _extract(self):
        memory, seen = self.house.memory, self.house.world.faces(self.far, self.camera)
        seen = [one for one in seen if one[2] >= NEAREST_M]
        numbers = [person["number"] for person, _, _ in seen]
        for person, (x, y, _), distance in seen:
            key = "PeoplePerception/Person/%d/" % person["number"]
            memory.values[key + "Distance"] = distance
            memory.values[key + "AnglesYawPitch"] = [x, y]
            memory.values[key + "IsVisible"] = True
            memory.values[key + "RealHeight"] = person["height"]
        if sorted(numbers) != sorted(self.known):
            arrived = [number for number in numbers if number not in self.known]
            left = [number for number in self.known if number not in numbers]
            self.known = numbers
            memory.put("PeoplePerception/PeopleList", numbers)
            for number in arrived:
                memory.put("PeoplePerception/JustArrived", number)
            for number in left:
                memory.put("PeoplePerception/JustLeft", number)
        if seen:
            people = [[person["number"], distance, y, x] for person, (x, y, _), distance in seen]
            memory.put("PeoplePerception/PeopleDetected", [stamp(), people, *self._poses()])
