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
# Calls that end when they are cancelled; a cancelled `say` goes on, as measured.
CANCELLED = ("animation",)
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

    def __init__(self, kind, call, due, ended, cancelled):
        self.kind, self.call, self.due, self.ended = kind, call, due, ended
        self.promise = qi.Promise(cancelled) if cancelled else qi.Promise()


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
        # When it moved, spoke, sounded and played last, in milliseconds.
        self.last = {}
        self.memory = self.body = self.world = None

    def now(self):
        """Milliseconds since the start."""
        return (time.monotonic() - self.born) * 1e3

    def answer(self, service, method, do, arguments):
        """Logs a call and does it, or what a fault wants instead."""
        if service.name == "StandIn":
            return self.done(service, method, do, arguments)
        with self.lock:
            self.note(service, method, arguments)
            fault = self.fault(service, method) if self.faults else {}
            wanted = fault.get("do")
            if wanted == "error":
                return failed(fault.get("text", "%s::%s\n\tnot today" % (service.name, method)))
            if wanted == "never":
                self.never.append(qi.Promise())
                return self.never[-1].future()
            if wanted == "answer":
                return fault.get("value")
            result = self.done(service, method, do, arguments)
        return late(result, fault["ms"]) if wanted == "delay" else result

    def done(self, service, method, do, arguments):
        with self.lock:
            self.calling = (service.name, method)
            try:
                return do(service, *arguments)
            except Refused as refused:
                return failed("%s::%s\n\t%s" % (service.name, method, refused))
            except Exception:
                traceback.print_exc()
                why = traceback.format_exc()
                return failed("%s::%s\n\tthe stand-in has a fault: %s" % (service.name, method, why))

    def note(self, service, method, arguments):
        """As quick as it can be: others measure how long a call takes."""
        self.seq += 1
        self.log.append((self.seq, self.now(), service.name, method, arguments))
        if self.aloud and method not in QUIET:
            words = ", ".join(json.dumps(word, ensure_ascii=False) for word in plain(arguments))
            print("%8.2f s  %s.%s(%s)" % (self.now() / 1e3, service.name, method, words), flush=True)

    def calls(self, after=0):
        """What was noted after the call of that number, for JSON."""
        return [
            {"seq": seq, "t_ms": int(at), "monotonic_us": int((self.born * 1e3 + at) * 1e3), "service": service,
             "method": method, "args": plain(arguments)}
            for seq, at, service, method, arguments in self.log if seq > after
        ]

    def fault(self, service, method):
        """The fault that waits for this call, used up by one."""
        for fault in self.faults:
            if fault.get("service", "*") in ("*", service.name) and fault.get("method", "*") in ("*", method):
                fault["times"] = fault.get("times", 1) - 1
                if fault["times"] <= 0:
                    self.faults.remove(fault)
                return fault
        return {}

    def block(self, kind, due, ended=None):
        """A call that is answered once `due(now)`, or released; `ended(whole)` is told and gives the answer."""
        cancelled = (lambda promise: self.cancel(job)) if kind in CANCELLED else None
        job = Job(kind, self.calling, due, ended, cancelled)
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

    def cancel(self, job):
        """The caller does not want it any more."""
        with self.lock:
            self.end(job, False)

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

    def note_activity(self, now):
        body, services = self.body, self.services
        doing = {
            "moved": body.targets or body.moving(), "spoke": services["ALTextToSpeech"].queue,
            "sounded": services["ALAudioPlayer"].sounding,
            "played": services["ALAnimationPlayer"].playing or services["ALBehaviorManager"].playing,
        }
        self.last.update({what: now for what, on in doing.items() if on})

    def step(self):
        now = self.now()
        self.note_activity(now)
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
