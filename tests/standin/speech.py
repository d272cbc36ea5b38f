"""ALTextToSpeech and ALAnimatedSpeech: one voice, texts in a queue, a call that is answered when its text was spoken.

A text takes 55 ms a character (`speech_ms_per_char` of the world). `stopAll` answers all that wait; cancelling a call
does not end it, as measured. Assumed: a stopped call is answered like one that was spoken.
"""

from service import Refused, Service, api

LANGUAGES = ["English", "French", "German", "Japanese"]


class Voice(Service):
    name = "ALTextToSpeech"

    def __init__(self, house):
        super().__init__(house)
        self.queue, self.spoken, self.ids = [], [], 0
        self.language, self.volume, self.parameters = "English", 0.7, {"speed": 100.0, "pitchShift": 1.0}
        self.ms_per_char, self.until, self.word = 55.0, 0.0, 0
        self.voice = "naoenu"

    @api("v::(s)", "say")
    def _say(self, text):
        return self._speak(text)

    @api("v::(ss)", "say")
    def _say_in(self, text, language):
        self._known(language)
        return self._speak(text)

    @api("v::()")
    def stopAll(self):
        waiting, self.queue = self.queue, []
        for at, (number, _) in enumerate(waiting):
            if at == 0:
                self.house.memory.put("ALTextToSpeech/TextInterrupted", 1)
            self.house.memory.put("ALTextToSpeech/Status", [number, "stopped"])
        self.house.release("say")

    @api("v::(s)")
    def setLanguage(self, language):
        self._known(language)
        self.language = language

    @api("s::()")
    def getLanguage(self):
        return self.language

    @api("[s]::()")
    def getAvailableLanguages(self):
        return LANGUAGES

    @api("[s]::()")
    def getSupportedLanguages(self):
        return LANGUAGES

    @api("v::(f)")
    def setVolume(self, volume):
        if not 0 <= volume <= 1:
            raise Refused("the volume must be from 0 to 1: %s" % volume)
        self.volume = volume

    @api("f::()")
    def getVolume(self):
        return self.volume

    @api("v::(sf)")
    def setParameter(self, name, value):
        self.parameters[name] = value

    @api("f::(s)")
    def getParameter(self, name):
        if name not in self.parameters:
            raise Refused("unknown parameter: %s" % name)
        return self.parameters[name]

    @api("v::(s)")
    def setVoice(self, voice):
        self.voice = voice

    @api("s::()")
    def getVoice(self):
        return self.voice

    @api("[s]::()")
    def getAvailableVoices(self):
        return ["naoenu", "naofrf", "naogeg", "maki_n16"]

    def _known(self, language):
        if language not in LANGUAGES:
            raise Refused("%s is not installed" % language)

    def _speak(self, text):
        self.ids += 1
        number = self.ids
        self.queue.append((number, text))
        self.house.memory.put("ALTextToSpeech/Status", [number, "enqueued"])
        if len(self.queue) == 1:
            self._begin()
        return self.house.block("say", lambda now: all(one != number for one, _ in self.queue))

    def _begin(self):
        number, text = self.queue[0]
        memory = self.house.memory
        speed = max(self.parameters["speed"], 20.0) / 100.0
        self.until, self.word = self.house.now() + len(text) * self.ms_per_char / speed, 0
        self.spoken.append(text)
        memory.put("ALTextToSpeech/TextStarted", 1)
        memory.put("ALTextToSpeech/Status", [number, "started"])
        self.house.services["ALSpeechRecognition"]._hear_itself(text)

    def _tick(self, now):
        if not self.queue:
            return
        number, text = self.queue[0]
        words = text.split()
        spoken = int(len(words) * (1 - max(self.until - now, 0) / max(len(text) * self.ms_per_char, 1)))
        if self.word < min(spoken, len(words)):
            self.house.memory.put("ALTextToSpeech/CurrentWord", words[self.word])
            self.word += 1
        if now >= self.until:
            self.queue.pop(0)
            self.house.memory.put("ALTextToSpeech/TextDone", 1)
            self.house.memory.put("ALTextToSpeech/Status", [number, "done"])
            if self.queue:
                self._begin()

    def _state(self):
        return {
            "speaking": self.queue[0][1] if self.queue else None, "waiting_texts": [text for _, text in self.queue[1:]],
            "spoken": self.spoken, "language": self.language, "voice_volume": self.volume, "voice": self.parameters,
        }


class AnimatedVoice(Service):
    name = "ALAnimatedSpeech"

    def __init__(self, house):
        super().__init__(house)
        self.mode = 2

    @api("v::(s)", "say")
    def _say(self, text):
        return self.house.services["ALTextToSpeech"]._speak(text)

    @api("v::(sm)", "say")
    def _say_with(self, text, _config):
        return self.house.services["ALTextToSpeech"]._speak(text)

    @api("v::(i)")
    def setBodyLanguageMode(self, mode):
        self.mode = mode

    @api("i::()")
    def getBodyLanguageMode(self):
        return self.mode

    @api("v::()")
    def stopAll(self):
        """Assumed: older robots have none, and `ALTextToSpeech.stopAll` ends these too."""
        self.house.services["ALTextToSpeech"].stopAll.__wrapped__(self.house.services["ALTextToSpeech"])
