"""ALAutonomousLife and what the robot does by itself besides.

Read: the four states, and that abilities are on again after a change of state. Assumed: solitary and interactive wake the
robot, disabled lets it rest (`life_disabled_rests` of the world) and stops what speaks, moves and runs.
"""

from service import Refused, Service, api

STATES = ("disabled", "solitary", "interactive", "safeguard")
ABILITIES = ("AutonomousBlinking", "BackgroundMovement", "BasicAwareness", "ListeningMovement", "SpeakingMovement")


class Life(Service):
    name = "ALAutonomousLife"

    def __init__(self, house):
        super().__init__(house)
        self.state, self.abilities = "solitary", {name: True for name in ABILITIES}
        self.rests = True

    @api("s::()")
    def getState(self):
        return self.state

    @api("v::(s)")
    def setState(self, state):
        if state not in STATES[:3]:
            raise Refused("unknown state: %s" % state)
        return self._set(state)

    @api("b::(s)")
    def getAutonomousAbilityEnabled(self, name):
        self._known(name)
        return self.abilities[name]

    @api("v::(sb)")
    def setAutonomousAbilityEnabled(self, name, on):
        if name == "All":
            self.abilities = {one: on for one in ABILITIES}
        else:
            self._known(name)
            self.abilities[name] = on

    @api("m::()")
    def getAutonomousAbilitiesStatus(self):
        return [{"name": name, "enabled": on, "running": on and self.state != "disabled"} for name, on in self.abilities.items()]

    @api("s::()")
    def focusedActivity(self):
        return ""

    @api("v::()")
    def stopAll(self):
        behaviors = self.house.services["ALBehaviorManager"]
        behaviors.stopAllBehaviors.__wrapped__(behaviors)

    @api("v::()")
    def stopFocus(self):
        behaviors = self.house.services["ALBehaviorManager"]
        behaviors.stopAllBehaviors.__wrapped__(behaviors)

    def _known(self, name):
        if name not in ABILITIES:
            raise Refused("unknown ability: %s" % name)

    def _set(self, state):
        if state == self.state:
            return None
        self.state = state
        self.abilities = {name: True for name in ABILITIES}
        services, motion = self.house.services, self.house.services["ALMotion"]
        self.house.memory.put("AutonomousLife/State", state)
        if state == "disabled":
            services["ALTextToSpeech"].stopAll.__wrapped__(services["ALTextToSpeech"])
            Life.stopAll.__wrapped__(self)
            self.house.release("animation")
            if self.rests and not self.house.body.lying:
                return type(motion)._rest.__wrapped__(motion)
        elif state in ("solitary", "interactive") and not self.house.body.awake:
            result = type(motion).wakeUp.__wrapped__(motion)
            self.house.jobs[-1].ended = self._quiet(self.house.jobs[-1].ended)
            return result
        return None

    def _quiet(self, ended):
        """An end whose answer nobody wants."""
        return lambda whole: ended(whole) and None

    def _fell(self):
        if self.state in ("solitary", "interactive"):
            self._set("safeguard")

    def _state(self):
        return {"life": self.state, "abilities": self.abilities}


class Switch(Service):
    """Something that is on or off."""

    on = True

    @api("v::(b)")
    def setEnabled(self, on):
        self.on = on

    @api("b::()")
    def isEnabled(self):
        return self.on

    def _state(self):
        return {self.name: self.on}


class Background(Switch):
    name = "ALBackgroundMovement"


class Listening(Switch):
    name = "ALListeningMovement"


class Speaking(Switch):
    name = "ALSpeakingMovement"


class Blinking(Switch):
    name = "ALAutonomousBlinking"


class Awareness(Switch):
    name = "ALBasicAwareness"

    @api("v::()")
    def startAwareness(self):
        self.on = True

    @api("v::()")
    def stopAwareness(self):
        self.on = False

    @api("v::()")
    def pauseAwareness(self):
        self.on = False

    @api("v::()")
    def resumeAwareness(self):
        self.on = True

    @api("b::()")
    def isAwarenessRunning(self):
        return self.on

    @api("v::(s)")
    def setTrackingMode(self, mode):
        self.mode = mode

    @api("v::(s)")
    def setEngagementMode(self, mode):
        self.engagement = mode
