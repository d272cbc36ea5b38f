"""ALTabletService of a Pepper: one thing is shown at a time. Read: the methods; assumed: each answers true at once."""

from service import Refused, Service, api


class Tablet(Service):
    name = "ALTabletService"

    def __init__(self, house):
        super().__init__(house)
        self.shown = None

    @api("b::(s)")
    def showWebview(self, address):
        return self._show(address)

    @api("b::(s)")
    def showImage(self, address):
        return self._show(address)

    @api("v::()")
    def hideWebview(self):
        self.shown = None

    @api("v::()")
    def hideImage(self):
        self.shown = None

    def _show(self, address):
        if not address:
            raise Refused("there is no address")
        self.shown = address
        return True

    def _state(self):
        return {"tablet": self.shown}
