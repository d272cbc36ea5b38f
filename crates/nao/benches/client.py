"""The same work as the benchmark of `nao`, with the Python client of libqi.

    python client.py tcp://HOST:PORT

Each line of the input is one order as JSON; each is answered by one line of JSON:

    {"do": "calls", "what": "setAngles", "count": 1000}     microseconds that each of them took, from call to answer
    {"do": "calls", "what": "ping", "count": 1000}          the same, of an empty function in Python
    {"do": "calls", "what": "machineId", "count": 1000}     the same, answered by libqi itself
    {"do": "react", "with": "setAngles" | "say"}            from now on called for every touch
    {"do": "rest"}                                          no more
"""

import json
import sys
import time

import qi

qi.logging.setLevel(qi.logging.SILENT)
KEY, NAMES, SPEED = "FrontTactilTouched", ["HeadYaw"], 0.3

session = qi.Session()
session.connect(sys.argv[1])
motion, memory = session.service("ALMotion"), session.service("ALMemory")
voice, directory = session.service("ALTextToSpeech"), session.service("ServiceDirectory")
subscriber = memory.subscriber(KEY)
reaction, count = [], 0


def angle(number):
    return number % 7 / 10.0


CALLS = {
    "setAngles": lambda number: motion.setAngles(NAMES, [angle(number)], SPEED),
    "ping": lambda number: motion.ping(),
    "machineId": lambda number: directory.machineId(),
    "say": lambda number: voice.say(str(number), _async=True),
}


def timed(what, times):
    do, taken = CALLS[what], []
    for number in range(times):
        began = time.perf_counter_ns()
        do(number)
        taken.append((time.perf_counter_ns() - began) / 1e3)
    return taken


def react(what):
    do = CALLS[what]

    def touched(value):
        global count
        if value > 0.5:
            count += 1
            do(count)

    return subscriber.signal.connect(touched)


def rest():
    while reaction:
        subscriber.signal.disconnect(reaction.pop())


for line in sys.stdin:
    order = json.loads(line)
    said = True
    if order["do"] == "calls":
        said = timed(order["what"], order["count"])
    else:
        rest()
        if order["do"] == "react":
            reaction.append(react(order["with"]))
    print(json.dumps(said), flush=True)
