"""ALSystem and ALRobotModel: who it is."""

from service import Service, api


class System(Service):
    name = "ALSystem"

    def __init__(self, house):
        super().__init__(house)
        self.called = "nao-standin"

    @api("s::()")
    def robotName(self):
        return self.called

    @api("v::(s)")
    def setRobotName(self, name):
        self.called = name

    @api("s::()")
    def systemVersion(self):
        return "2.8.5.10"

    @api("s::()")
    def robotIcon(self):
        return ""


class Model(Service):
    name = "ALRobotModel"

    @api("s::()")
    def getRobotType(self):
        return self.house.body.table.model

    @api("b::()")
    def hasArms(self):
        return True

    @api("b::()")
    def hasHands(self):
        return "LHand" in self.house.body.table.joints

    @api("b::()")
    def hasLegs(self):
        return "LLeg" in self.house.body.table.groups
