"""A session of the real libqi with services that exercise the protocol; says READY and its address, ends with its input."""

import sys
import threading
import time

import qi

TEXT = "h\u00e9\u4f60"


@qi.multiThreaded()
class Everything:
    def __init__(self):
        self.told = qi.Signal("(s)")
        self.measured = qi.Signal("(fi[f])")
        self.anything = qi.Signal("m")
        self.listened = qi.Signal("(s)", self._counted)
        self.level = qi.Property("i")
        self.level.setValue(3)
        self.angles = {}
        self.done = 0
        self.listening = None

    def _counted(self, some):
        self.listening = some

    @qi.bind(qi.String, (qi.Int32,), "pick")
    def pick_int(self, value):
        return "int %d" % value

    @qi.bind(qi.String, (qi.Float,), "pick")
    def pick_float(self, value):
        return "float %.1f" % value

    @qi.bind(qi.String, (qi.String,), "pick")
    def pick_text(self, value):
        return "text " + value

    @qi.bind(qi.String, (qi.List(qi.Float),), "pick")
    def pick_list(self, value):
        return "list %d" % len(value)

    @qi.bind(qi.String, (qi.String, qi.Int32), "pick")
    def pick_two(self, text, number):
        return "two %s %d" % (text, number)

    @qi.bind(qi.Void, (qi.String, qi.Float, qi.Float))
    def setAngles(self, name, angle, speed):
        self.angles[name] = angle

    @qi.bind(qi.Float, (qi.String,))
    def angle(self, name):
        return self.angles[name]

    @qi.bind(qi.Map(qi.String, qi.Int32), (qi.Map(qi.String, qi.Int32),))
    def mapped(self, value):
        return value

    @qi.bind(qi.Buffer, (qi.Int32,))
    def raw(self, size):
        return bytes(i % 256 for i in range(size))

    def echo(self, value):
        return value

    def nested(self):
        return [[1, 2], {"a": [0.5, (True, TEXT)]}, None]

    def anyone(self, *values):
        return len(values)

    def fail(self):
        raise RuntimeError("Everything::fail\n\tnot today")

    @qi.bind(qi.Int32, (qi.Float,))
    def slow(self, seconds):
        time.sleep(seconds)
        self.done += 1
        return self.done

    def subscriber(self, key):
        return Key(key)

    def is_listened(self):
        return bool(self.listening)

    @qi.bind(qi.Void, (qi.String,))
    def tell(self, text):
        self.told(text)

    @qi.bind(qi.Void, ())
    def measure(self):
        self.measured(0.5, 7, [1.0, 2.0])

    @qi.bind(qi.Void, ())
    def any(self):
        self.anything({"a": [1, "b"]})

    @qi.bind(qi.Void, (qi.Int32,))
    def burst(self, count):
        def run():
            start = time.monotonic()
            for i in range(count):
                self.told(str(i))
                pause = start + (i + 1) / 1000 - time.monotonic()
                if pause > 0:
                    time.sleep(pause)
        threading.Thread(target=run, daemon=True).start()


class Key:
    def __init__(self, key):
        self.key = key
        self.signal = qi.Signal("m")

    def name(self):
        return self.key

    def raise_it(self, value):
        self.signal(value)


class Comings:
    def __init__(self, session):
        self.session = session
        self.id = None

    def come(self):
        self.id = self.session.registerService("Guest", Everything())

    def go(self):
        self.session.unregisterService(self.id)


def calls(address, count):
    """What this client of libqi takes for calls like setAngles, in microseconds: the middle and the slowest hundredth."""
    session = qi.Session()
    session.connect(address)
    service = session.service("Everything")
    taken = []
    for i in range(count):
        began = time.perf_counter()
        service.setAngles("HeadYaw", i / count, 0.1)
        taken.append((time.perf_counter() - began) * 1e6)
    taken.sort()
    print("%.1f %.1f" % (taken[count // 2], taken[count * 99 // 100]), flush=True)
    session.close()


def main():
    if sys.argv[1] == "calls":
        calls(sys.argv[2], int(sys.argv[3]))
        return
    session = qi.Session()
    if sys.argv[1] == "join":
        # Another process of the same host, with an address of its own.
        session.connect(sys.argv[2])
        session.listen("tcp://127.0.0.1:0")
        session.registerService("Neighbour", Everything())
    else:
        session.listenStandalone("tcp://127.0.0.1:0")
        session.registerService("Everything", Everything())
        session.registerService("Comings", Comings(session))
    print("READY " + session.endpoints()[0], flush=True)
    sys.stdin.read()
    session.close()


main()
