"""What all services share: one lock, the clock, the log of calls, faults on command, and work that takes time.

Blocking calls of the robot take no thread here: they return a future, and every 20 ms it is looked whether it is due.
"""

import collections
import json
import threading
import time
import traceback

import qi

from service import Refused

CYCLE_MS = 20
CALLS_MAX = 200_000
# Polled so often that nobody wants to read them.
QUIET = {"getData", "getListData", "getAngles", "ping", "getBatteryCharge", "getStiffnesses", "robotIsWakeUp"}


def plain(value):
    """A value as JSON can hold it; floats of four bytes without the noise of their conversion."""
    if isinstance(value, float):
        return float("%.7g" % value) if value == value and abs(value) != float("inf") else str(value)
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (bool, int, str)) or value is None:
        return value
    return repr(value)


class Job:
    """A call that has not been answered yet."""

    def __init__(self, kind, call, due, ended):
        self.kind, self.call, self.due, self.ended = kind, call, due, ended
        self.promise = qi.Promise()


class House:
    def __init__(self, aloud=False):
        self.lock = threading.RLock()
        self.born = time.monotonic()
        self.aloud = aloud
        self.log = collections.deque(maxlen=CALLS_MAX)
        self.seq = 0
        self.calling = ("", "")
        self.faults = []
        self.never = []
        self.jobs = []
        self.services = {}
        self.violations = []
        self.memory = self.body = self.world = None

    def now(self):
        """Milliseconds since the start."""
        return (time.monotonic() - self.born) * 1e3

    def answer(self, service, method, do, arguments):
        """Logs a call and does it, or what a fault wants instead."""
        if service == "StandIn":
            return self.done(service, method, do)
        with self.lock:
            self.note(service, method, arguments)
            fault = self.fault(service, method)
            if fault.get("do") == "error":
                return failed(fault.get("text", "%s::%s\n\tnot today" % (service, method)))
            if fault.get("do") == "never":
                self.never.append(qi.Promise())
                return self.never[-1].future()
            if fault.get("do") == "answer":
                return fault.get("value")
            result = self.done(service, method, do)
        return late(result, fault["ms"]) if fault.get("do") == "delay" else result

    def done(self, service, method, do):
        with self.lock:
            self.calling = (service, method)
            try:
                return do()
            except Refused as refused:
                return failed("%s::%s\n\t%s" % (service, method, refused))
            except Exception:
                traceback.print_exc()
                return failed("%s::%s\n\tthe stand-in has a fault: %s" % (service, method, traceback.format_exc()))

    def note(self, service, method, arguments):
        self.seq += 1
        call = {"seq": self.seq, "t_ms": int(self.now()), "service": service, "method": method}
        call["args"] = plain(arguments)
        self.log.append(call)
        if self.aloud and method not in QUIET:
            words = ", ".join(json.dumps(word, ensure_ascii=False) for word in call["args"])
            print("%8.2f s  %s.%s(%s)" % (call["t_ms"] / 1e3, service, method, words), flush=True)

    def fault(self, service, method):
        """The fault that waits for this call, used up by one."""
        for fault in self.faults:
            if fault.get("service", "*") in ("*", service) and fault.get("method", "*") in ("*", method):
                fault["times"] = fault.get("times", 1) - 1
                if fault["times"] <= 0:
                    self.faults.remove(fault)
                return fault
        return {}

    def block(self, kind, due, ended=None):
        """A call that is answered once `due(now)`, or released; `ended(whole)` is told and gives the answer."""
        job = Job(kind, self.calling, due, ended)
        self.jobs.append(job)
        return job.promise.future()

    def wait(self, kind, ms, ended=None):
        """A call that is answered after so many milliseconds."""
        until = self.now() + ms
        return self.block(kind, lambda now: now >= until, ended)

    def release(self, *kinds):
        """Answers the calls of these kinds at once."""
        for job in [job for job in self.jobs if job.kind in kinds]:
            self.end(job, False)

    def end(self, job, whole):
        if job in self.jobs:
            self.jobs.remove(job)
            job.promise.setValue(job.ended(whole) if job.ended else None)

    def busy(self, *kinds):
        return any(job.kind in kinds for job in self.jobs)

    def run(self):
        """One step every 20 ms, for ever."""
        following = time.monotonic()
        while True:
            following = max(following + CYCLE_MS / 1e3, time.monotonic() - 0.5)
            time.sleep(max(0.0, following - time.monotonic()))
            with self.lock:
                try:
                    self.step()
                except Exception:
                    traceback.print_exc()

    def step(self):
        now = self.now()
        self.body.step(CYCLE_MS / 1e3)
        self.world.step(now / 1e3)
        for job in list(self.jobs):
            if job.due(now):
                self.end(job, True)
        for service in list(self.services.values()):
            service._tick(now)


def failed(text):
    promise = qi.Promise()
    promise.setError(text)
    return promise.future()


def late(result, ms):
    """An answer that was ready and comes `ms` later."""
    promise = qi.Promise()

    def answer():
        try:
            promise.setValue(result.value() if hasattr(result, "hasError") else result)
        except RuntimeError as error:
            promise.setError(str(error))

    timer = threading.Timer(ms / 1e3, answer)
    timer.daemon = True
    timer.start()
    return promise.future()
