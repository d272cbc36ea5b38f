"""ALLeds. A colour is there at once and the call is answered after its time (assumed: on a robot the fade may block).

Read: a group has lamps of three colours, and an intensity that is set for it is that of each of them: red turns grey.
"""

from service import Refused, Service, api

NAMED = {"white": 0xFFFFFF, "red": 0xFF0000, "green": 0x00FF00, "blue": 0x0000FF, "yellow": 0xFFFF00,
         "magenta": 0xFF00FF, "cyan": 0x00FFFF}
FACE = ["FaceLed%d" % number for number in range(8)]
SIDES = ["%sFaceLed%d" % (side, number) for side in ("Left", "Right") for number in range(1, 9)]
GROUPS = ["AllLeds", "FaceLeds", "LeftFaceLeds", "RightFaceLeds", "EarLeds", "LeftEarLeds", "RightEarLeds", "ChestLeds"]
NAO = ["BrainLeds", "FeetLeds", "LeftFootLeds", "RightFootLeds"]
PEPPER = ["ShoulderLeds"]


class Leds(Service):
    name = "ALLeds"

    def __init__(self, house):
        super().__init__(house)
        self.groups = GROUPS + (PEPPER if house.body.table.kind == "pepper" else NAO)
        self.rgb = {group: [1.0, 1.0, 1.0] for group in self.groups if group != "AllLeds"}

    @api("v::(sif)", "fadeRGB")
    def _number(self, name, rgb, seconds):
        return self._fade(name, [(rgb >> shift & 255) / 255 for shift in (16, 8, 0)], seconds)

    @api("v::(ssf)", "fadeRGB")
    def _named(self, name, color, seconds):
        if color not in NAMED:
            raise Refused("unknown colour: %s" % color)
        return Leds._number.__wrapped__(self, name, NAMED[color], seconds)

    @api("v::(sffff)", "fadeRGB")
    def _parts(self, name, red, green, blue, seconds):
        return self._fade(name, [red, green, blue], seconds)

    @api("v::(sff)")
    def fade(self, name, intensity, seconds):
        return self._fade(name, [intensity] * 3, seconds)

    @api("v::(sf)")
    def setIntensity(self, name, intensity):
        if not 0 <= intensity <= 1:
            raise Refused("the intensity must be from 0 to 1: %s" % intensity)
        self._set(name, [intensity] * 3)

    @api("f::(s)")
    def getIntensity(self, name):
        self._known(name)
        return max(self.rgb.get(name, [1.0]))

    @api("v::(s)")
    def on(self, name):
        self._set(name, [1.0] * 3)

    @api("v::(s)")
    def off(self, name):
        self._set(name, [0.0] * 3)

    @api("v::(s)")
    def reset(self, name):
        self._set(name, [1.0] * 3)

    @api("[s]::()")
    def listGroups(self):
        return self.groups

    @api("[s]::()")
    def listLEDs(self):
        return FACE + SIDES

    def _known(self, name):
        if name not in self.groups + FACE + SIDES:
            raise Refused("unknown group: %s" % name)

    def _set(self, name, rgb):
        self._known(name)
        rgb = [min(max(part, 0.0), 1.0) for part in rgb]
        if name == "AllLeds":
            self.rgb.update({group: rgb for group in self.rgb})
        self.rgb[name] = rgb
        for part in {"FaceLeds": ["LeftFaceLeds", "RightFaceLeds"], "FeetLeds": ["LeftFootLeds", "RightFootLeds"]}.get(name, []):
            self.rgb[part] = rgb

    def _fade(self, name, rgb, seconds):
        self._set(name, rgb)
        return self.house.wait("fade", seconds * 1e3) if seconds > 0 else None

    def _state(self):
        return {"leds": self.rgb}
