"""ALAnimationPlayer and ALBehaviorManager. Names are those of a NAO with the standard packages; each takes two seconds.

Documented: ALAnimationPlayer is a wrapper of ALBehaviorManager. Taken from that: the manager ends what either has begun.
Assumed: an animation that is stopped is answered like one that ended; an arm moves meanwhile, so that one sees something.
"""

from service import Refused, Service, api

LASTS_MS = 2_000
GESTURES = ["Hey_1", "Hey_6", "Yes_1", "Yes_2", "No_3", "BowShort_1", "Me_1", "Me_2", "Explain_1", "Explain_2",
            "Applause_1", "Enthusiastic_4", "Please_1", "IDontKnow_1", "YouKnowWhat_1", "Thinking_1"]
MOODS = ["Happy_4", "Happy_1", "Laugh_1", "Winner_1"]
ANIMATIONS = ["animations/Stand/Gestures/" + name for name in GESTURES]
ANIMATIONS += ["animations/Stand/Emotions/Positive/" + name for name in MOODS]
ANIMATIONS += ["animations/Stand/Emotions/Negative/Surprise_1", "animations/Stand/Waiting/FunnyDancer_1"]
TAGS = {"hello": "Hey_1", "hey": "Hey_1", "affirmative": "Yes_1", "yes": "Yes_1", "negative": "No_3", "no": "No_3",
        "bow": "BowShort_1", "me": "Me_1", "explain": "Explain_1", "happy": "Happy_4", "joy": "Happy_4"}
BEHAVIORS = ["boot-config", "run_dialog_dev/.", "standard/taichi", "games/hide_and_seek", ".lastUploadedChoregrapheBehavior/behavior_1"]


class Player(Service):
    """What plays one thing after another by name."""

    def __init__(self, house):
        super().__init__(house)
        self.playing, self.played = [], []

    def _play(self, name, kind):
        self.playing.append(name)
        self.played.append(name)

        def ended(_whole):
            if name in self.playing:
                self.playing.remove(name)

        future = self.house.wait(kind, LASTS_MS, ended)
        self.house.jobs[-1].plays = name
        return future

    def _end(self, *names):
        for job in [job for job in self.house.jobs if getattr(job, "plays", None) in names]:
            self.house.end(job, False)


class Animations(Player):
    name = "ALAnimationPlayer"

    @api("v::(s)", "run")
    def _run(self, name):
        if name not in ANIMATIONS:
            raise Refused("animation not found: %s" % name)
        body = self.house.body
        body.aim("RShoulderPitch", 0.2, 0.4)

        def ended(whole):
            playing(whole)
            body.aim("RShoulderPitch", body.table.postures["StandInit"]["RShoulderPitch"], 0.4)

        future = self._play(name, "animation")
        playing, self.house.jobs[-1].ended = self.house.jobs[-1].ended, ended
        return future

    @api("v::(s)")
    def runTag(self, tag):
        if tag not in TAGS:
            raise Refused("no animation has the tag %s" % tag)
        name = next(one for one in ANIMATIONS if one.endswith(TAGS[tag]))
        return Animations._run.__wrapped__(self, name)

    @api("v::()")
    def reset(self):
        self.house.release("animation")

    @api("v::()")
    def stopAll(self):
        """Assumed: there on newer robots only; cancelling `run` ends one elsewhere."""
        self.house.release("animation")

    def _state(self):
        return {"playing": self.playing, "played": self.played}


class Behaviors(Player):
    name = "ALBehaviorManager"

    @api("[s]::()")
    def getInstalledBehaviors(self):
        return BEHAVIORS + ANIMATIONS

    @api("[s]::()")
    def getBehaviorNames(self):
        return BEHAVIORS + ANIMATIONS

    @api("[s]::()")
    def getRunningBehaviors(self):
        return self.playing

    @api("b::(s)")
    def isBehaviorInstalled(self, name):
        return name in BEHAVIORS + ANIMATIONS

    @api("b::(s)")
    def isBehaviorPresent(self, name):
        return name in BEHAVIORS + ANIMATIONS

    @api("b::(s)")
    def isBehaviorRunning(self, name):
        return name in self.playing

    @api("v::(s)")
    def runBehavior(self, name):
        return self._begin(name)

    @api("v::(s)")
    def startBehavior(self, name):
        self._begin(name)

    @api("v::(s)")
    def stopBehavior(self, name):
        self._end(name)

    @api("v::()")
    def stopAllBehaviors(self):
        self._end(*BEHAVIORS, *ANIMATIONS)

    def _begin(self, name):
        if name not in BEHAVIORS + ANIMATIONS:
            raise Refused("behavior not found: %s" % name)
        if name in self.playing:
            raise Refused("%s is already running" % name)
        return self._play(name, "behavior " + name)

    def _state(self):
        return {"behaviors": self.playing, "behaviors_run": self.played}
