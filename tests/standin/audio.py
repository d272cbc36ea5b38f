"""ALAudioPlayer and ALAudioDevice. A file plays for one second, if it is among those of the robot or of a set of sounds.

Read: sets of sounds, and a sound of one by the names of both.
"""

from service import Refused, Service, api

FILES = ["/usr/share/naoqi/wav/random.wav", "/home/nao/sounds/bell.wav", "/opt/aldebaran/share/naoqi/wav/start_jingle.wav"]
SETS = {"Aldebaran": ["sfx_confirmation_1", "sfx_validation_1", "sfx_warning_1"]}
FILE_MS = 1_000


class AudioPlayer(Service):
    name = "ALAudioPlayer"

    def __init__(self, house):
        super().__init__(house)
        self.sounding, self.sounded, self.volume = [], [], 1.0
        self.loaded = {}

    @api("v::(s)", "playFile")
    def _file(self, path):
        return self._sound(path)

    @api("v::(sff)", "playFile")
    def _file_at(self, path, _volume, _pan):
        return self._sound(path)

    @api("v::(sff)", "playFileInLoop")
    def _loop(self, path, _volume, _pan):
        self._there(path)
        return self._begin(path, float("inf"))

    @api("[s]::()")
    def getInstalledSoundSetsList(self):
        return sorted(SETS)

    @api("[s]::(s)")
    def getSoundSetFileNames(self, name):
        if name not in SETS:
            raise Refused("no set of sounds is called %s" % name)
        return SETS[name]

    @api("v::(s)", "playSoundSetFile")
    def _set_file(self, file):
        return self._of_set(next((name for name in SETS if file in SETS[name]), ""), file)

    @api("v::(ss)", "playSoundSetFile")
    def _set_file_of(self, name, file):
        return self._of_set(name, file)

    @api("v::(ssfffb)", "playSoundSetFile")
    def _set_file_at(self, name, file, _position, _volume, _pan, _loop):
        return self._of_set(name, file)

    @api("i::(s)")
    def loadFile(self, path):
        self._there(path)
        self.loaded[len(self.loaded) + 1] = path
        return len(self.loaded)

    @api("v::(i)", "play")
    def _play(self, number):
        if number not in self.loaded:
            raise Refused("no file was loaded as %d" % number)
        return self._sound(self.loaded[number])

    @api("v::(iiff)")
    def playSine(self, hertz, _gain, _pan, seconds):
        return self._begin("%d Hz" % hertz, seconds * 1e3)

    @api("v::()")
    def stopAll(self):
        self.house.release("audio")

    @api("v::(f)")
    def setMasterVolume(self, volume):
        self.volume = volume

    @api("f::()")
    def getMasterVolume(self):
        return self.volume

    def _there(self, path):
        if path not in FILES:
            raise Refused("cannot open %s" % path)

    def _of_set(self, name, file):
        if file not in SETS.get(name, []):
            raise Refused("%s has no sound %s" % (name, file))
        return self._begin("%s/%s" % (name, file), FILE_MS)

    def _sound(self, path):
        self._there(path)
        return self._begin(path, FILE_MS)

    def _begin(self, name, ms):
        self.sounding.append(name)
        self.sounded.append(name)
        return self.house.wait("audio", ms, lambda whole: self.sounding.remove(name))

    def _state(self):
        return {"sounding": self.sounding, "sounded": self.sounded}


class AudioDevice(Service):
    name = "ALAudioDevice"

    def __init__(self, house):
        super().__init__(house)
        self.percent, self.muted = 60, False

    @api("v::(i)")
    def setOutputVolume(self, percent):
        if not 0 <= percent <= 100:
            raise Refused("the volume must be from 0 to 100: %d" % percent)
        self.percent = percent

    @api("i::()")
    def getOutputVolume(self):
        return self.percent

    @api("v::(b)")
    def muteAudioOut(self, muted):
        self.muted = muted

    @api("b::()")
    def isAudioOutMuted(self):
        return self.muted

    def _state(self):
        return {"volume": self.percent, "muted": self.muted}
