"""The bodies: joints with limits and speeds, groups, postures and cameras.

The NAO is read from the table of the simulation, so that both stand, look and reach alike. `h21` is the NAO without
wrists and hands. Of Pepper only names and limits are from its documentation; where its camera is and its postures are assumed.
"""

import os

try:
    import tomllib
except ImportError:
    # Python below 3.11; every environment has pip, and pip brings it along.
    from pip._vendor import tomli as tomllib

HERE = os.path.dirname(os.path.abspath(__file__))
NAO = os.path.join(HERE, "..", "..", "crates", "simulation", "src", "nao_body.toml")

TOUCHES = ["FrontTactilTouched", "MiddleTactilTouched", "RearTactilTouched", "ChestButtonPressed"]
BUMPERS = ["LeftBumperPressed", "RightBumperPressed"]
HANDS = ["Hand%s%sTouched" % (hand, part) for hand in ("Left", "Right") for part in ("Back", "Left", "Right")]


class Table:
    """A body; `joints` are name -> (lowest, highest, speed), in NAOqi's order of `Body`."""

    def __init__(self, kind):
        self.kind = kind
        with open(NAO, "rb") as file:
            self.nao = tomllib.load(file)
        self.camera_table = self.nao["cameras"]
        self.sonars = self.nao["sonars"]
        (self._pepper if kind == "pepper" else self._nao)(kind)

    def _nao(self, kind):
        nao = self.nao
        rows = {row["name"]: (*row["limits"], row["vmax"]) for row in nao["joints"]}
        rows.update({row["name"]: (*row["range"], row["vmax"]) for row in nao["hands"]})
        order = [row["name"] for row in nao["joints"]] + [row["name"] for row in nao["hands"]]
        self.postures = {name: dict(zip(order, angles)) for name, angles in nao["postures"].items()}
        # Nobody lies on purpose; the simulation has no angles for it either.
        for name in ("LyingBelly", "LyingBack"):
            self.postures[name] = self.postures["StandZero"]
        left = [name for name in order if name[0] == "L" and name in rows]
        arm = ["ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw", "Hand"]
        leg = [name[1:] for name in left if name[1:] not in arm]
        if kind == "h21":
            arm = arm[:4]
        self.groups = {
            "Head": ["HeadYaw", "HeadPitch"],
            "LArm": ["L" + part for part in arm],
            "LLeg": ["L" + part for part in leg],
            "RLeg": ["R" + part for part in leg],
            "RArm": ["R" + part for part in arm],
        }
        self.coupled = {"RHipYawPitch": "LHipYawPitch"}
        self.top_speed = nao["walk"]["max_v"]
        self.chain = nao["joints"]
        self.touches = TOUCHES + BUMPERS + (HANDS if kind == "h25" else [])
        self.model = "Nao"
        self._finish(rows)

    def _pepper(self, _kind):
        rows = {row["name"]: (*row["limits"], row["vmax"]) for row in self.nao["joints"]}
        rows.update({row["name"]: (*row["range"], row["vmax"]) for row in self.nao["hands"]})
        rows.update({
            "HeadPitch": (-0.7068, 0.4451, 7.19), "LShoulderRoll": (0.0087, 1.5620, 7.19),
            "RShoulderRoll": (-1.5620, -0.0087, 7.19), "LElbowRoll": (-1.5620, -0.0087, 7.19),
            "RElbowRoll": (0.0087, 1.5620, 7.19), "HipRoll": (-0.5149, 0.5149, 2.27),
            "HipPitch": (-1.0385, 1.0385, 2.93), "KneePitch": (-0.5149, 0.5149, 2.93),
        })
        arm = ["ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw", "Hand"]
        self.groups = {
            "Head": ["HeadYaw", "HeadPitch"], "LArm": ["L" + part for part in arm],
            "Leg": ["HipRoll", "HipPitch", "KneePitch"], "RArm": ["R" + part for part in arm],
            # In `Body`, and no joints: they only roll.
            "Wheels": ["WheelFL", "WheelFR", "WheelB"],
        }
        rows.update({wheel: (-1000.0, 1000.0, 10.0) for wheel in self.groups["Wheels"]})
        # One ahead and one behind, as high as its base.
        self.sonars = [dict(self.sonars[0], name="Sonar%s" % name, at=[at, 0.0, -0.6], yaw=yaw, pitch_down=0.0)
                       for name, at, yaw in (("Front", 0.2, 0.0), ("Back", -0.2, 3.14159))]
        stand = {"LShoulderPitch": 1.57, "RShoulderPitch": 1.57, "LShoulderRoll": 0.12, "RShoulderRoll": -0.12,
                 "LElbowYaw": -1.22, "RElbowYaw": 1.22, "LElbowRoll": -0.52, "RElbowRoll": 0.52, "LHand": 0.6, "RHand": 0.6}
        crouch = dict(stand, HeadPitch=0.35, HipPitch=-0.9, KneePitch=0.45)
        self.postures = {"Stand": stand, "StandInit": stand, "StandZero": {}, "Crouch": crouch}
        self.coupled = {}
        self.top_speed = [0.55, 0.55, 2.0]
        # The neck stands 0.99 m high; torso to neck to camera as far as known.
        self.chain = [
            {"name": "HeadYaw", "parent": "Torso", "child": "Neck", "at": [-0.038, 0, 0.1699], "axis": [0, 0, 1]},
            {"name": "HeadPitch", "parent": "Neck", "child": "Head", "at": [0, 0, 0], "axis": [0, 1, 0]},
        ]
        self.camera_table = [
            {"id": 0, "at": [0.0868, 0, 0.1631], "pitch_down": 0.0, "hfov": 0.98262, "vfov": 0.76271},
            {"id": 1, "at": [0.0934, 0, 0.0616], "pitch_down": 0.6929, "hfov": 0.98262, "vfov": 0.76271},
        ]
        self.touches = TOUCHES + BUMPERS + ["BackBumperPressed"] + [name for name in HANDS if "Back" in name]
        self.model = "Juliette"
        self._finish(rows)

    def _finish(self, rows):
        self.body = [name for group in self.groups.values() for name in group]
        self.joints = {name: rows[name] for name in self.body}
        middle = {name: min(max(0.0, lowest), highest) for name, (lowest, highest, _) in self.joints.items()}
        for name, angles in self.postures.items():
            self.postures[name] = {joint: angles.get(joint, middle[joint]) for joint in self.body}
        revolute = [name for name in self.body if not name.endswith("Hand") and not name.startswith("Wheel")]
        legs = self.groups.get("LLeg", []) + self.groups.get("RLeg", []) + self.groups.get("Leg", [])
        self.groups.update({
            "Body": self.body, "Joints": revolute, "JointActuators": revolute, "Actuators": self.body,
            "Arms": self.groups["LArm"] + self.groups["RArm"], "Legs": legs,
        })

    def named(self, names):
        """The joints behind a name, a group or a list of both."""
        names = [names] if isinstance(names, str) else list(names)
        found = []
        for name in names:
            if name in self.groups:
                found += self.groups[name]
            elif name in self.joints:
                found.append(name)
            else:
                return None
        return found
