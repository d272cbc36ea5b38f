"""ALBattery and ALBodyTemperature."""

from service import Service, api

LOW, EMPTY = 15, 5


class Battery(Service):
    name = "ALBattery"

    def __init__(self, house):
        super().__init__(house)
        self.charge, self.plugged = 80, False

    @api("i::()")
    def getBatteryCharge(self):
        return self.charge

    @api("v::(b)")
    def enablePowerMonitoring(self, on):
        self.monitored = on

    def _set(self, charge=None, plugged=None):
        memory, was = self.house.memory, self.charge
        if plugged is not None and plugged != self.plugged:
            self.plugged = plugged
            memory.put("BatteryPowerPluggedChanged", plugged)
        if charge is not None and charge != was:
            self.charge = charge
            memory.put("BatteryChargeChanged", charge)
            for key, limit in (("BatteryLowDetected", LOW), ("BatteryNearlyEmpty", EMPTY)):
                if (charge <= limit) != (was <= limit):
                    memory.put(key, charge <= limit)

    def _state(self):
        return {"battery": self.charge, "plugged": self.plugged}


class Temperature(Service):
    name = "ALBodyTemperature"

    @api("m::()")
    def getTemperatureDiagnosis(self):
        hot = self.house.body.hot()
        return [1, hot] if hot else [0, []]

    @api("v::(b)")
    def setEnableNotifications(self, on):
        self.told = on
