"""A stand-in for a NAO on the real libqi: services named like NAOqi's with a body, a room and faults on command.

    python nao.py [--port 0] [--host 127.0.0.1] [--body h25|h21|pepper] [--without SERVICE,...] [--stay]

Prints `listening tcp://HOST:PORT`, and runs until its input closes or SIGTERM comes; `--stay` ignores the input and
prints the calls. What a test can do with it is described in `standin.py`.

Real here is the protocol: the directory, signatures, overloads, objects, signals and errors are those of libqi. The
robot behind it is ours, after the documentation of NAOqi 2.8; each file says what was measured, read or assumed.
"""

import argparse
import os
import signal
import sys
import threading

import qi

from audio import AudioDevice, AudioPlayer
from body import Body
from faces import Faces, People
from hearing import Localization, Recognition
from house import House
from leds import Leds
from life import Awareness, Background, Blinking, Life, Listening, Speaking
from memory import Memory, first
from motion import Motion
from near import Sonar
from network import Connections
from players import Animations, Behaviors
from posture import Posture
from power import Battery, Temperature
from speech import AnimatedVoice, Voice
from standin import StandIn
from system import Model, System
from table import Table
from tablet import Tablet
from tracker import Tracker
from video import Video
from vision import Blob, Landmark, RedBall
from world import World

SERVICES = [
    Memory, Motion, Posture, Voice, AnimatedVoice, Leds, RedBall, Blob, Faces, People, Landmark, Recognition, Localization,
    Sonar, Battery, Temperature, Tracker, Animations, Behaviors, AudioPlayer, AudioDevice, Life, Background, Listening,
    Speaking, Blinking, Awareness, Connections, System, Model, Video,
]


class Directory:
    """Which services are registered, and under which id."""

    def __init__(self, session, services):
        self.session, self.services, self.ids = session, services, {}

    def enter(self, name):
        if name not in self.ids:
            self.ids[name] = self.session.registerService(name, self.services[name])

    def leave(self, name):
        if name in self.ids:
            self.session.unregisterService(self.ids.pop(name))


def build(body, aloud, name, serial):
    house = House(aloud)
    house.world = World(house)
    house.body = Body(house, Table(body))
    house.memory = Memory(house)
    first(house.memory, house.body.table)
    made = [house.memory] + [kind(house) for kind in SERVICES[1:]]
    if house.body.table.kind == "pepper":
        made.append(Tablet(house))
    house.services = {service.name: service for service in made}
    house.services["ALSystem"].called = name
    # A simulated NAOqi has no such key.
    if serial:
        house.memory.values["Device/DeviceList/ChestBoard/BodyId"] = serial
    return house


def asked():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--port", type=int, default=0)
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--body", choices=["h25", "h21", "pepper"], default="h25")
    parser.add_argument("--name", default="nao-standin", help="what it calls itself")
    parser.add_argument("--serial", default="ALDR0000N000001", help="the number of its body")
    parser.add_argument("--without", default="", help="services that this robot lacks, with commas between")
    parser.add_argument("--stay", action="store_true", help="ignore the input and print the calls")
    return parser.parse_args()


def main():
    # libqi writes its log where a line of ours is waited for.
    qi.logging.setLevel(qi.logging.SILENT)
    wanted = asked()
    house = build(wanted.body, wanted.stay, wanted.name, wanted.serial)
    session = qi.Session()
    session.listenStandalone("tcp://%s:%d" % (wanted.host, wanted.port))
    directory = Directory(session, {**house.services, "StandIn": StandIn(house, None)})
    directory.services["StandIn"].directory = directory
    for name in directory.services:
        if name not in wanted.without.split(","):
            directory.enter(name)
    threading.Thread(target=house.run, daemon=True).start()
    done = threading.Event()
    for ending in (signal.SIGTERM, signal.SIGINT):
        signal.signal(ending, lambda *_: done.set())
    if not wanted.stay:
        threading.Thread(target=lambda: (sys.stdin.read(), done.set()), daemon=True).start()
    print("listening " + session.endpoints()[0], flush=True)
    while not done.wait(0.5):
        pass
    # Threads of libqi may wait for calls that are never answered.
    os._exit(0)


main()
