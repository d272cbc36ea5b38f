"""What the cameras find: red ball, blobs of a colour, landmarks. Angles in radians, left and down positive.

Read: the shapes of the values; nothing is raised when a ball is lost, and the circle of the last blob stays; its x and
radius are in parts of the picture's rows, its y in parts of the columns; a landmark is found from 2 to 23 degrees large and
turned up to 45. Assumed: pictures are those of a pinhole, so that a place in the picture is the tangent of its angle.
"""

import math

from service import Extractor, Refused, api, stamp
from space import Pose, length
from world import COLORS

MARK_SIZES = (math.radians(2.0), math.radians(23.0))


class Seeing(Extractor):
    """An extractor on a camera; the upper one at first."""

    period_ms = 33

    def __init__(self, house):
        super().__init__(house)
        self.camera = 0

    @api("b::(i)")
    def setActiveCamera(self, number):
        if number not in (0, 1):
            raise Refused("there is no camera %d" % number)
        self.camera = number
        return True

    @api("i::()")
    def getActiveCamera(self):
        return self.camera

    @api("b::(i)")
    def setResolution(self, resolution):
        return 0 <= resolution <= 3

    @api("b::(i)")
    def setFrameRate(self, rate):
        return 1 <= rate <= 30

    def _poses(self):
        """The camera in the frames of the torso and of the robot, and which it is."""
        body = self.house.body
        camera, robot = body.camera(self.camera), Pose((*body.base[:2], 0.0), body.torso().rows)
        return [(body.torso().inverse() * camera).six(), (robot.inverse() * camera).six(), self.camera]


class RedBall(Seeing):
    name = "ALRedBallDetection"
    outputs = ("redBallDetected",)

    def _extract(self):
        seen = self.house.world.ball(lambda name, ball: ball.get("color", name) == "red" and ball["shape"] == "ball", self.camera)
        if seen:
            _, (x, y, size), _ = seen
            self.house.memory.put("redBallDetected", [stamp(), [x, y, size, size], *self._poses()])


class Blob(Seeing):
    name = "ALColorBlobDetection"
    outputs = ("ALTracker/ColorBlobDetected",)

    def __init__(self, house):
        super().__init__(house)
        self.color, self.threshold, self.shape = None, 0, "Unknown"
        self.smallest_px, self.span, self.circle, self.exposure = 0, 0.1, [], True

    @api("v::(iiii)")
    def setColor(self, red, green, blue, threshold):
        if not all(0 <= part <= 255 for part in (red, green, blue, threshold)):
            raise Refused("colours are from 0 to 255")
        self.color, self.threshold = (red, green, blue), threshold

    @api("m::()")
    def getColor(self):
        return [*(self.color or (0, 0, 0)), self.threshold]

    @api("v::(if)", "setObjectProperties")
    def _properties(self, smallest_px, span):
        self.smallest_px, self.span, self.shape = smallest_px, span, "Unknown"

    @api("v::(ifs)", "setObjectProperties")
    def _properties_shape(self, smallest_px, span, shape):
        if shape not in ("Circle", "Unknown"):
            raise Refused("unknown shape: %s" % shape)
        self.smallest_px, self.span, self.shape = smallest_px, span, shape

    @api("m::()")
    def getObjectProperties(self):
        return [self.smallest_px, self.span, self.shape]

    @api("[f]::()")
    def getCircle(self):
        return self.circle

    @api("v::(b)")
    def setAutoExposure(self, on):
        self.exposure = on

    @api("b::()")
    def getAutoExposure(self):
        return self.exposure

    def _wanted(self, name, ball):
        if self.color is None or self.shape == "Circle" and ball["shape"] != "ball":
            return False
        color = COLORS.get(ball.get("color", name), (128, 128, 128))
        return all(abs(a - b) <= self.threshold for a, b in zip(color, self.color))

    def _boxes(self, name, box):
        return self.shape != "Circle" and self._wanted(name, dict(box, shape="box"))

    def _extract(self):
        world = self.house.world
        found = [world.ball(self._wanted, self.camera), world.colored(self._boxes, self.camera)]
        seen = max((one for one in found if one), key=lambda one: one[1][2], default=None)
        row = self.house.body.table.camera_table[self.camera]
        wide, high = (2 * math.tan(row[field] / 2) for field in ("hfov", "vfov"))
        # Pixels in a picture of 320 x 240.
        if not seen or math.pi * (320 * math.tan(seen[1][2]) / wide) ** 2 < self.smallest_px:
            return
        _, (x, y, size), at = seen
        columns, rows = 320 * (0.5 - math.tan(x) / wide), 240 * (0.5 + math.tan(y) / high)
        self.circle = [columns / 240, rows / 320, 320 * math.tan(size) / wide / 240]
        # As far away as a thing of the span that was told would be.
        camera, torso = self.house.body.camera(self.camera), self.house.body.torso()
        far = self.span / 2 / math.sin(size)
        here = camera.into(at)
        place = camera.out([part * far / length(here) for part in here])
        robot = Pose((*self.house.body.base[:2], 0.0), torso.rows)
        poses = [Pose(torso.into(place)).six(), Pose(robot.into(place)).six()]
        self.house.memory.put("ALTracker/ColorBlobDetected", [*poses, stamp(), 0])

    def _state(self):
        return {"blob": {"color": self.color, "threshold": self.threshold, "shape": self.shape, "span": self.span}}


class Landmark(Seeing):
    name = "ALLandMarkDetection"
    outputs = ("LandmarkDetected",)
    period_ms = 100

    def __init__(self, house):
        super().__init__(house)
        self.seen = False

    def _extract(self):
        marks = [
            [[1, x, y, 2 * size, 2 * size, 0.0], [number]]
            for number, (x, y, size) in self.house.world.marks(MARK_SIZES, self.camera)
        ]
        if marks:
            camera = ["CameraTop", "CameraBottom"][self.camera]
            self.house.memory.put("LandmarkDetected", [stamp(), marks, *self._poses()[:2], camera])
        elif self.seen:
            self.house.memory.put("LandmarkDetected", [])
        self.seen = bool(marks)
