"""ALConnectionManager: the networks that the robot knows, each a list of pairs, as its documentation shows them.

A test says what it is in by "network" of the world: {"wifi": 86} with the strength, {"ethernet": 0}, or {}.
"""

from service import Service, api


class Connections(Service):
    name = "ALConnectionManager"

    def __init__(self, house):
        super().__init__(house)
        self.used = {"wifi": 86}

    @api("m::()")
    def services(self):
        idle = [[["ServiceId", "wifi_other"], ["Name", "other"], ["State", "idle"], ["Type", "wifi"], ["Strength", 99]]]
        return idle + [
            [["ServiceId", kind], ["Name", "ward"], ["State", "online"], ["Type", kind], ["Strength", strength]]
            for kind, strength in self.used.items()
        ]

    @api("s::()")
    def state(self):
        return "online" if self.used else "offline"
