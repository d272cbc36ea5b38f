"""ALVideoDevice: a small picture of what the camera sees, grey with the balls in it.

Measured on the real libqi: bytes of Python travel in a dynamic as a text (`s`), where a robot sends raw bytes (`r`).
"""

import math
import time

from service import Refused, Service, api
from world import COLORS

SIZES = {7: (80, 60), 8: (40, 30), 0: (160, 120), 1: (320, 240), 2: (640, 480)}
LAYERS = {0: 1, 9: 2, 11: 3, 13: 3}
NAMES_MAX = 6


class Video(Service):
    name = "ALVideoDevice"

    def __init__(self, house):
        super().__init__(house)
        self.handles = {}

    @api("s::(siiii)")
    def subscribeCamera(self, name, camera, size, color, rate):
        if camera not in (0, 1) or size not in SIZES or color not in LAYERS or not 1 <= rate <= 30:
            raise Refused("no such picture: camera %d, size %d, colour %d, %d a second" % (camera, size, color, rate))
        for number in range(NAMES_MAX):
            handle = "%s_%d" % (name, number)
            if handle not in self.handles:
                self.handles[handle] = (camera, size, color)
                return handle
        raise Refused("%s is subscribed %d times" % (name, NAMES_MAX))

    @api("b::(s)")
    def unsubscribe(self, handle):
        return self.handles.pop(handle, None) is not None

    @api("[s]::()")
    def getSubscribers(self):
        return sorted(self.handles)

    @api("b::(s)")
    def releaseImage(self, handle):
        return handle in self.handles

    @api("m::(s)")
    def getImageRemote(self, handle):
        if handle not in self.handles:
            return None
        camera, size, color = self.handles[handle]
        width, height = SIZES[size]
        now, row = time.time(), self.house.body.table.camera_table[camera]
        half = [row["hfov"] / 2, row["vfov"] / 2]
        pixels = bytes(self._paint(camera, width, height, LAYERS[color]))
        angles = [half[0], -half[1], -half[0], half[1]]
        return [width, height, LAYERS[color], color, int(now), int(now % 1 * 1e6), pixels, camera, *angles]

    def _paint(self, camera, width, height, layers):
        world, row = self.house.world, self.house.body.table.camera_table[camera]
        pixels = bytearray(b"\x60" * (width * height * layers))
        wide, high = (2 * math.tan(row[field] / 2) for field in ("hfov", "vfov"))
        for name, ball in world.balls.items():
            sight = ball["present"] and world.see(world.ball_at(ball), ball["radius"], name, camera)
            if not sight:
                continue
            x, y, size = sight
            over, down = (0.5 - math.tan(x) / wide) * width, (0.5 + math.tan(y) / high) * height
            radius = math.tan(size) / wide * width
            paint = bytes(COLORS.get(ball.get("color", name), (128, 128, 128)))[:layers]
            for line in range(max(0, int(down - radius)), min(height, int(down + radius) + 1)):
                reach = math.sqrt(max(radius ** 2 - (line - down) ** 2, 0.0))
                first, last = max(0, int(over - reach)), min(width, int(over + reach) + 1)
                if last > first:
                    start = (line * width + first) * layers
                    pixels[start:start + (last - first) * layers] = paint * (last - first)
        return pixels

    def _state(self):
        return {"cameras": sorted(self.handles)}
