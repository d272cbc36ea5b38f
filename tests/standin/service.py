"""How a service of the stand-in is written: methods with the signatures of a robot, and extractors.

Measured on the real libqi: a method that returns a future answers when that has a value, calls of one service come in
the order they were sent, and an error set on a future reaches the caller with its text alone.
"""

import time


def api(signature, name=None):
    """Publishes a method as `RETURN::(ARGUMENTS)`; several with one `name` are overloads."""
    returns, _, takes = signature.partition("::")

    def publish(method):
        public = name or method.__name__

        def call(self, *arguments):
            return self.house.answer(self, public, method, arguments)

        call.__name__ = method.__name__
        call.__wrapped__ = method
        call.__qi_name__ = public
        call.__qi_signature__ = takes
        call.__qi_return_signature__ = returns
        return call

    return publish


class Refused(Exception):
    """What a service of the robot answers with an error; told as `Service::method` and the reason below it."""


class Service:
    """A service of the house; what has no `api` is not published."""

    name = ""

    def __init_subclass__(cls):
        for member in vars(cls).values():
            if callable(member) and not hasattr(member, "__qi_signature__"):
                member.__qi_signature__ = "DONOTBIND"

    def __init__(self, house):
        self.house = house

    @api("b::()")
    def ping(self):
        return True

    @api("s::()")
    def version(self):
        return "2.8.5.10"

    def _state(self):
        """What `StandIn.state` tells of it."""
        return {}

    def _tick(self, now):
        """Every 20 ms; `now` in milliseconds since the start."""


for member in (Service._state, Service._tick):
    member.__qi_signature__ = "DONOTBIND"


def stamp():
    """A moment as NAOqi writes it: seconds and microseconds."""
    now = time.time()
    return [int(now), int(now % 1 * 1e6)]


class Extractor(Service):
    """A service that raises its events only while somebody subscribed, at the shortest period asked for.

    Assumed: the period when none is given, and that leaving without having subscribed is no error.
    """

    period_ms = 100
    outputs = ()

    def __init__(self, house):
        super().__init__(house)
        self.subscribers = {}
        self.paused = False
        self.due = 0

    @api("v::(s)", "subscribe")
    def _subscribe(self, name):
        self._open(name, self.period_ms, 0.0)

    @api("v::(sif)", "subscribe")
    def _subscribe_at(self, name, period_ms, precision):
        self._open(name, max(int(period_ms), 20), precision)

    @api("v::(s)")
    def unsubscribe(self, name):
        if self.subscribers.pop(name, None) and not self.subscribers:
            self._ended()

    @api("v::(si)")
    def updatePeriod(self, name, period_ms):
        if name not in self.subscribers:
            raise Refused("%s is no subscriber" % name)
        self.subscribers[name] = (max(int(period_ms), 20), self.subscribers[name][1])

    @api("v::(sf)")
    def updatePrecision(self, name, precision):
        if name not in self.subscribers:
            raise Refused("%s is no subscriber" % name)
        self.subscribers[name] = (self.subscribers[name][0], precision)

    @api("m::()")
    def getSubscribersInfo(self):
        return [[name, period, precision] for name, (period, precision) in self.subscribers.items()]

    @api("i::()")
    def getCurrentPeriod(self):
        return self._period()

    @api("[s]::()")
    def getOutputNames(self):
        return list(self.outputs)

    @api("[s]::()")
    def getEventList(self):
        return list(self.outputs)

    @api("v::(b)")
    def pause(self, paused):
        self.paused = paused

    @api("b::()")
    def isPaused(self):
        return self.paused

    def _open(self, name, period_ms, precision):
        first = not self.subscribers
        self.subscribers[name] = (period_ms, precision)
        self.due = self.house.now()
        if first:
            self._began()

    def _period(self):
        return min((period for period, _ in self.subscribers.values()), default=self.period_ms)

    def _tick(self, now):
        if not self.subscribers or self.paused or now < self.due:
            return
        # A beat that was missed is left out.
        self.due = max(self.due + self._period(), now - self._period())
        self._extract()

    def _began(self):
        """The first one subscribed."""

    def _ended(self):
        """The last one left."""

    def _extract(self):
        """Looks at the world and raises what there is."""
