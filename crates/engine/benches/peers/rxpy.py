"""The graphs of the benchmark on RxPY: every stream a Subject, every procedure made from its text.

Argument: the graph, a file of the benchmark. Each line on standard input is one order, each answer one line of JSON.
"""
import json
import sys
import time

import reactivex
from reactivex import operators as ops
from reactivex.subject import Subject


def procedure(graph, connector):
    """The function of a connector's body or helper, made from its text."""
    if "py" in connector:
        return eval(f"lambda {', '.join(connector['args'])}: {connector['py']}")
    for helper in graph["helpers"]:
        if helper["name"] == connector.get("helper"):
            return eval(f"lambda {', '.join(helper['params'])}: {helper['py']}")
    return None


class Peer:
    """One graph, built once, and the orders of the benchmark."""

    def __init__(self, graph):
        self.graph, self.at, self.now, self.outputs, self.kept = graph, 0, 0, 0, None
        self.streams = {stream["id"]: Subject() for stream in graph["streams"]}
        for leaf in graph["leaves"]:
            self.streams[leaf].subscribe(self.listener(leaf))
        for connector in graph["connectors"]:
            self.connect(connector).subscribe(self.streams[connector["output"]])

    def listener(self, leaf):
        def hear(value):
            self.outputs += 1
            if self.kept is not None:
                self.kept.setdefault(leaf, []).append(value)

        return hear

    def connect(self, connector):
        inputs = [self.streams[name] for name in connector["inputs"]]
        made = procedure(self.graph, connector)
        match connector["type"]:
            case "map":
                return inputs[0].pipe(ops.map(made))
            case "filter":
                return inputs[0].pipe(ops.filter(made))
            case "timestamp":
                return inputs[0].pipe(ops.map(lambda value: {"v": value, "t": self.now}))
            case "combineLatest":
                return reactivex.combine_latest(*inputs).pipe(ops.map(lambda values: made(*values)))
            case "merge":
                return reactivex.merge(*inputs)
            case "subscribe":
                return inputs[0]
        raise ValueError(connector["type"])

    def next(self):
        stream, value = self.graph["readings"][self.at % len(self.graph["readings"])]
        self.at += 1
        self.now = self.at
        self.streams[stream].on_next(value)

    def run(self, count, _expected):
        """Readings one after the other, as fast as it goes."""
        before, heard = time.process_time_ns(), self.outputs
        for _ in range(count):
            self.next()
        return {"cpu_ns": time.process_time_ns() - before, "outputs": self.outputs - heard}

    def check(self, count):
        """What the leaves hear of the first readings."""
        self.kept = {}
        for _ in range(count):
            self.next()
        heard, self.kept = self.kept, None
        return heard

    def paced(self, count):
        """A reading a millisecond; how long each took, in nanoseconds."""
        took = []
        for _ in range(count):
            time.sleep(0.001)
            before = time.perf_counter_ns()
            self.next()
            took.append(time.perf_counter_ns() - before)
        return took


def main():
    with open(sys.argv[1], encoding="utf8") as file:
        peer = Peer(json.load(file))
    for line in sys.stdin:
        order, *numbers = line.split()
        print(json.dumps(getattr(peer, order)(*map(int, numbers))), flush=True)


main()
