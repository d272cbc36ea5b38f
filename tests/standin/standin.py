"""`StandIn`: the service beside those of the robot by which a test moves the world, sees the body and makes faults.

    world(s json)           changes the world; any of the fields below together, applied in this order
    state() -> s json       what the robot does now
    calls() -> s json       every call of the other services since `clear`, oldest first
    calls_since(i seq) -> s the calls with a greater `seq`
    clear()                 forgets calls, spoken texts, played things, violations and faults that wait
    fault(s json)           one fault or a list of them; see below

A mistake in the JSON is an error of the call, and then nothing has changed after the field that is wrong.

**world**: metres in the frame of the simulation (x ahead, y left, z up), radians, percent. What is not named stays.

    {"balls":     {"red": {"at": [x, y, z], "radius": 0.03, "color": "red", "shape": "ball" | "block", "present": true,
                           "path": {"amplitude": [x, y, z], "hz": [x, y, z], "phase": [x, y, z]} | null}},
     "people":    {"person": {"at": [x, y], "height": 1.1, "present": true}},
     "landmarks": {"64": {"at": [x, y, z], "facing": 3.14, "radius": 0.06, "present": true} | null},
     "obstacles": {"box": {"at": [x, y], "size": [x, y, z], "color": "grey", "present": true} | null},
     "touch":     {"part": "FrontTactilTouched", "down": true},
     "word":      {"word": "oh yes", "confidence": 0.6, "at": [x, y, z]},   sureness and place may be left out
     "sound":     {"at": [x, y, z], "loudness": 0.9},
     "battery":   80,  "plugged": true,
     "heat":      {"LKneePitch": 80.0},
     "push":      "belly" | "back",        pushed over
     "carried":   true,                    lifted from the ground, or set on its feet; a lifted one ends its walk
     "stiffness": {"LKneePitch": 0.3},     of these joints
     "upright":   true,                    set on its feet by somebody; the motors stay as they are
     "life":      "disabled" | "solitary" | "interactive" | "safeguard",
     "pose":      [x, y, heading],         carried there
     "joints":    {"HeadYaw": 0.3},        there at once
     "posture":   "StandInit",             there at once
     "awake":     true,                    and its motors stiff, or not
     "learned":   {"1": "Aiko"},           faces that it knows, by the number of the person; all of them
     "network":   {"wifi": 86},            or {"ethernet": 0}, or {} without one
     "face_unknown_ms": 8000,              so long it looks at a face before it tells that it does not know it
     "speech_ms_per_char": 55, "hears_itself": true, "life_disabled_rests": true}

At first there is what the simulation has: the balls red, green and blue; absent the people person (1) and friend (2), the
obstacles box and block and the landmarks 64 and 80. New names add some. `facing` is the heading that a mark's front looks.
A ball swings about `at` by amplitude * sin(2 pi hz t + phase) on each axis.

**state**: {"t_ms": since "born_us" of the computer's monotonic clock, "joints": {name: rad}, "targets": {name: rad},
"stiffness": {name: 0..1}, "celsius": {name: C},
"pose": [x, y, heading], "velocity": [x, y, turn], "moving", "posture", "family", "awake", "fallen", "hot": [joint],
"breath": {chain: on}, "idle", "speaking": text | null, "waiting_texts": [], "spoken": [text], "language",
"voice_volume", "voice": {"speed", "pitchShift"}, "vocabulary": [], "spotting", "listening", "heard_language",
"sensitivity", "blob": {"color", "threshold", "shape", "span"}, "learned": {"1": name}, "leds": {group: [r, g, b]},
"battery", "plugged", "tracking": {"target", "mode", "effector", "lost"} | null, "registered": [target],
"playing": [animation], "played": [], "behaviors": [], "behaviors_run": [], "sounding": [], "sounded": [], "volume",
"muted", "life", "abilities": {name: on}, "ALBackgroundMovement": on, "ALListeningMovement", "ALSpeakingMovement",
"ALAutonomousBlinking", "ALBasicAwareness", "cameras": [handle], "listened": [key],
"subscribers": {service: {name: period_ms}}, "paused": [service], "blocked": ["Service.method"],
"violations": [text], "in_the_air": a foot is, "last_ms": {"moved", "spoke", "sounded", "played": when it did last},
"balls": {name: {"at": [x, y, z], "seen": [x, y, size] | null}}}

**calls**: [{"seq": 1, "t_ms": 1234, "monotonic_us": 5678901234, "service": "ALMotion", "method": "setAngles",
"args": ["HeadYaw", 0.5, 0.3]}]; a call is noted when it comes, whatever becomes of it; `monotonic_us` is that moment on the
computer's monotonic clock. `ServiceDirectory` and `StandIn` are not noted.

**fault**: the first four wait for a call of "service" and "method" ("*" or left out: any), "times" times (once).

    {"do": "error",  "service": "ALLeds", "method": "fadeRGB", "text": "ALLeds::fadeRGB\\n\\tno"}   nothing is done
    {"do": "delay",  "service": .., "method": .., "ms": 500}      done at once, answered later
    {"do": "never",  "service": .., "method": ..}                 nothing is done and never answered
    {"do": "answer", "service": .., "method": .., "value": 3}     nothing is done, and this is the answer
    {"do": "unregister", "service": "ALTracker"}                  away from the directory
    {"do": "register",   "service": "ALTracker"}                  there again, under a new id
    {"do": "restart",    "service": "ALMotion"}                   both
    {"do": "raise",  "key": "FaceDetected", "value": any}         an event of any shape; "hex": "ff00" for bytes
    {"do": "burst",  "key": "..", "count": 1000, "hz": 1000}      numbers from 0, the key's value besides if given
    {"do": "freeze", "seconds": 10}                               the whole process stops 50 ms later: connections
                                                                  stay and nothing answers
    {"do": "exit",   "code": 1}                                   the process ends 50 ms later
"""

import json
import os
import signal
import subprocess
import threading
import time

from change import apply
from house import plain
from service import Extractor, Refused, Service, api

SOON_S = 0.05
WAITING = ("error", "delay", "never", "answer")


class StandIn(Service):
    name = "StandIn"

    def __init__(self, house, directory):
        super().__init__(house)
        self.directory = directory

    @api("v::(s)")
    def world(self, text):
        try:
            apply(self.house, json.loads(text))
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise Refused("%s: %s" % (type(error).__name__, error))

    @api("s::()")
    def state(self):
        house, state = self.house, {"t_ms": int(self.house.now()), "born_us": int(self.house.born * 1e6)}
        for service in house.services.values():
            state.update(service._state())
        extractors = [service for service in house.services.values() if isinstance(service, Extractor)]
        state["subscribers"] = {
            service.name: {name: period for name, (period, _) in service.subscribers.items()}
            for service in extractors if service.subscribers
        }
        state["paused"] = [service.name for service in extractors if service.paused]
        state["blocked"] = [".".join(job.call) for job in house.jobs if job.kind != "fall"]
        state["violations"] = house.violations
        state["last_ms"] = house.last
        state["balls"] = {
            name: {"at": house.world.ball_at(ball), "seen": house.world.see(house.world.ball_at(ball), ball["radius"], name)}
            for name, ball in house.world.balls.items()
        }
        return json.dumps(plain(state))

    @api("s::()")
    def calls(self):
        return json.dumps(self.house.calls())

    @api("s::(i)")
    def calls_since(self, seq):
        return json.dumps(self.house.calls(seq))

    @api("v::()")
    def clear(self):
        self.house.log.clear()
        self.house.faults.clear()
        for service in self.house.services.values():
            for noted in ("spoken", "played", "sounded"):
                getattr(service, noted, []).clear()
        self.house.violations.clear()

    @api("v::(s)")
    def fault(self, text):
        faults = json.loads(text)
        for fault in faults if isinstance(faults, list) else [faults]:
            try:
                self._fault(fault)
            except (KeyError, TypeError, ValueError) as error:
                raise Refused("%s: %s" % (type(error).__name__, error))

    def _fault(self, fault):
        do = fault["do"]
        if do in WAITING:
            if do == "delay":
                float(fault["ms"])
            self.house.faults.append(fault)
        elif do in ("unregister", "register", "restart"):
            self._directory(do, fault["service"])
        elif do == "raise":
            value = bytes.fromhex(fault["hex"]) if "hex" in fault else fault["value"]
            self.house.memory.put(fault["key"], value)
        elif do == "burst":
            self._burst(fault["key"], int(fault["count"]), float(fault["hz"]), fault.get("value"))
        elif do == "freeze":
            later(lambda: freeze(float(fault["seconds"])))
        elif do == "exit":
            later(lambda: os._exit(int(fault.get("code", 1))))
        else:
            raise ValueError("unknown fault: %s" % do)

    def _directory(self, do, name):
        """In a thread of its own: the directory may call back before it answers."""
        if name not in self.house.services:
            raise ValueError("there is no %s" % name)
        steps = {"unregister": ["out"], "register": ["in"], "restart": ["out", "in"]}[do]
        failed = []

        def run():
            for step in steps:
                try:
                    (self.directory.leave if step == "out" else self.directory.enter)(name)
                except RuntimeError as error:
                    failed.append(str(error))

        threading.Thread(target=run, daemon=True).start()

    def _burst(self, key, count, hz, value):
        def run():
            began = time.monotonic()
            for number in range(count):
                with self.house.lock:
                    self.house.memory.put(key, number if value is None else value)
                time.sleep(max(0.0, began + (number + 1) / hz - time.monotonic()))

        threading.Thread(target=run, daemon=True).start()


def later(do):
    timer = threading.Timer(SOON_S, do)
    timer.daemon = True
    timer.start()


def freeze(seconds):
    """Stops this whole process; another one wakes it."""
    wake = "import os, signal, time; time.sleep(%f); os.kill(%d, signal.SIGCONT)" % (seconds, os.getpid())
    subprocess.Popen([os.sys.executable, "-S", "-c", wake], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    os.kill(os.getpid(), signal.SIGSTOP)
