"""ALSpeechRecognition and ALSoundLocalization: words that somebody says in the room, and where a sound comes from.

Read in public projects: a vocabulary cannot be set while it listens ("modifiable_grammar already exists"), unless it is
paused. Assumed: the empty value after a word is `["", -3.0]`; the robot hears its own voice (`hears_itself` of the world).
"""

import math
import re

from service import Extractor, Refused, api, stamp
from space import length
from speech import LANGUAGES

MISHEARD = 0.45
# At this distance a sound has half its energy, as in the simulation.
HALF_M = 2.0


def starts(whole, part):
    return bool(part) and whole[:len(part)] == part


class Recognition(Extractor):
    name = "ALSpeechRecognition"
    outputs = ("WordRecognized", "WordRecognizedAndGrammar")

    def __init__(self, house):
        super().__init__(house)
        self.vocabulary, self.spotting, self.language = [], False, "English"
        self.hears_itself = True
        self.parameters = {}

    @api("v::(s)")
    def setLanguage(self, language):
        if language not in LANGUAGES:
            raise Refused("%s is not installed" % language)
        self.language = language

    @api("s::()")
    def getLanguage(self):
        return self.language

    @api("[s]::()")
    def getAvailableLanguages(self):
        return LANGUAGES

    @api("v::([s]b)")
    def setVocabulary(self, words, spotting):
        if self.subscribers and not self.paused:
            raise Refused("A grammar named \"modifiable_grammar\" already exists.")
        self.vocabulary, self.spotting = list(words), spotting

    @api("v::(sf)")
    def setParameter(self, name, value):
        self.parameters[name] = value

    @api("v::(b)")
    def setAudioExpression(self, on):
        self.parameters["AudioExpression"] = on

    @api("v::(b)")
    def setVisualExpression(self, on):
        self.parameters["VisualExpression"] = on

    @api("v::()")
    def removeAllContext(self):
        self.vocabulary = []

    def _began(self):
        self.house.memory.put("WordRecognized", ["", -3.0])

    def _spot(self, said, confidence=None):
        """Somebody says it: the first word of the vocabulary in it, as sure as the simulation is."""
        pieces = re.findall(r"\w+", said.lower())
        for start in range(len(pieces)):
            here = [word for word in self.vocabulary if starts(pieces[start:], re.findall(r"\w+", word.lower()))]
            if here:
                word = max(here, key=len)
                alone = len(re.findall(r"\w+", word)) == len(pieces)
                self._hear(word, (0.8 if alone else 0.6) if confidence is None else confidence)
                return

    def _hear(self, word, confidence):
        if not self.subscribers or self.paused:
            return
        heard = "<...> %s <...>" % word if self.spotting else word
        self.house.memory.put("WordRecognizedAndGrammar", [heard, confidence, "modifiable_grammar"])
        self.house.memory.put("WordRecognized", [heard, confidence])
        self.house.memory.put("WordRecognized", ["", -3.0])

    def _hear_itself(self, text):
        if self.hears_itself:
            self._spot(text, MISHEARD)

    def _state(self):
        listening = bool(self.subscribers) and not self.paused
        return {"vocabulary": self.vocabulary, "spotting": self.spotting, "listening": listening,
                "heard_language": self.language}


class Localization(Extractor):
    name = "ALSoundLocalization"
    outputs = ("ALSoundLocalization/SoundLocated",)

    def __init__(self, house):
        super().__init__(house)
        self.sensitivity = 0.9

    @api("v::(sm)")
    def setParameter(self, name, value):
        if name not in ("Sensitivity", "EnergyComputation"):
            raise Refused("unknown parameter: %s" % name)
        if name == "Sensitivity":
            self.sensitivity = float(value)

    def _heard(self, at, loudness):
        """A sound somewhere in the room; angles from the head, left and up positive."""
        if not self.subscribers or self.paused:
            return
        head = self.house.body.head()
        x, y, z = head.into(at)
        energy = loudness / (1 + (length((x, y, z)) / HALF_M) ** 2)
        if energy <= 1 - self.sensitivity:
            return
        angles = [math.atan2(y, x), math.atan2(z, math.hypot(x, y)), 0.5 + energy / 2, energy]
        torso = self.house.body.torso()
        value = [stamp(), angles, (torso.inverse() * head).six(), head.six()]
        self.house.memory.put("ALSoundLocalization/SoundLocated", value)

    def _state(self):
        return {"sensitivity": self.sensitivity}
