// Stop, in every browser: in the grammar of 2009 (ES5), and alone, so that nothing else of the page can break it. A press
// is kept from the browser's own way, which is the form's, only once a request of ours is surely on its way.
(function () {
  "use strict";

  var STOP_WAIT_MS = 4000;
  var SAID_MS = 4000;
  var ESCAPES_WITHIN_MS = 600;
  var CLICK_WITHIN_MS = 1000;
  var NUMBER = "rrp-stops";

  function form() {
    return document.getElementById("stop-form");
  }

  // ---- What is said ---------------------------------------------------------------------------------------------------

  var quietLater = 0;

  function say(state, sentence) {
    clearTimeout(quietLater);
    form().setAttribute("data-state", state);
    document.getElementById("stop-said").textContent = sentence;
    if (state === "stopped") quietLater = setTimeout(function () { say("", ""); }, SAID_MS);
  }

  // Only the newest press says what became of it.
  var tries = 0;

  function tell(mine, state) {
    if (mine === tries) say(state, form().getAttribute("data-" + state));
  }

  // ---- Requests -------------------------------------------------------------------------------------------------------

  // The number of this Stop is left for the program: what is pressed from now on was pressed after it.
  function leave(number) {
    if (number) window.rrpStops = +number;
  }

  // Goes on where the page ends meanwhile.
  function byFetch(address, answered, failed) {
    var how = { method: "POST", headers: { accept: "application/json" }, keepalive: true, cache: "no-store" };
    var sent = window.fetch(address, how);
    sent.then(function (answer) {
      answered(answer.ok);
      leave(answer.headers.get(NUMBER));
    }, failed);
    return true;
  }

  function byRequest(address, answered, failed) {
    var request = new XMLHttpRequest();
    var isSent = false;
    request.onloadstart = function () { isSent = true; };
    request.onload = function () {
      answered(request.status === 200);
      leave(request.getResponseHeader(NUMBER));
    };
    request.onerror = failed;
    request.onabort = failed;
    request.open("POST", address, true);
    request.setRequestHeader("Accept", "application/json");
    request.send(null);
    return isSent;
  }

  var WAYS = [byFetch, byRequest];

  // The first of the ways from one on that works; whether any does.
  function attempt(mine, address, way) {
    function answered(isStopped) { tell(mine, isStopped ? "stopped" : "failed"); }
    function failed() { if (mine !== tries || !attempt(mine, address, way + 1)) answered(false); }
    for (; way < WAYS.length; way += 1) {
      try {
        if (WAYS[way](address, answered, failed)) return true;
      } catch (error) { /* The next one. */ }
    }
    return false;
  }

  // Sends a Stop; whether it is surely on its way.
  function send() {
    var mine = tries += 1;
    var isSent = attempt(mine, form().getAttribute("action"), 0);
    if (isSent) saySoon(mine);
    return isSent;
  }

  // What is said may fail, and keeps nothing back.
  function saySoon(mine) {
    try {
      tell(mine, "stopping");
      setTimeout(function () { if (form().getAttribute("data-state") === "stopping") tell(mine, "failed"); }, STOP_WAIT_MS);
    } catch (error) { /* It is sent all the same. */ }
  }

  // ---- Presses --------------------------------------------------------------------------------------------------------

  function isButton(element) {
    while (element && element.id !== "stop") element = element.parentNode;
    return !!element;
  }

  // Stop is heard as a finger or a mouse comes down: what comes of that later, a browser may keep for itself, as while
  // something still glides under another finger. The click of a pointer that follows is the same press; that of a key is
  // one of its own, however soon.
  var pressed = -Infinity;

  document.addEventListener("pointerdown", function (event) {
    if (event.button === 0 && isButton(event.target) && send()) pressed = event.timeStamp;
  }, true);

  document.addEventListener("click", function (event) {
    var isSamePress = event.detail > 0 && event.timeStamp - pressed < CLICK_WITHIN_MS;
    if (isSamePress && isButton(event.target)) event.preventDefault();
  }, true);

  document.addEventListener("submit", function (event) {
    if (event.target === form() && send()) event.preventDefault();
  }, true);

  // ---- Escape twice ---------------------------------------------------------------------------------------------------

  // It counts where there was nothing to close, to clear or to take back at the first time: the program keeps the browser
  // from doing something more with an Escape that it used, and a browser itself clears fields. Where the program has
  // failed, it uses none.
  var first = null;

  function isSecond(event) {
    if (!first || event.timeStamp - first.event.timeStamp >= ESCAPES_WITHIN_MS) return false;
    return !!document.getElementById("panic") || !(first.event.defaultPrevented || first.isTyped);
  }

  // Whether something is typed in the field that has the keyboard.
  function isTyped(element) {
    var isField = /^(INPUT|TEXTAREA)$/.test(element.tagName) && !/^(checkbox|radio|range|button|submit)$/.test(element.type);
    return !!element.isContentEditable || (isField && !element.readOnly && element.value !== "");
  }

  function hear(event) {
    if ((event.key !== "Escape" && event.keyCode !== 27) || event.repeat) return;
    // It takes back what is being composed of several keys.
    if (event.isComposing || event.keyCode === 229) {
      first = null;
    } else if (isSecond(event)) {
      first = null;
      if (!send()) form().submit();
    } else {
      first = { event: event, isTyped: isTyped(event.target) };
    }
  }

  // boot.js hears every Escape after this, and takes over where it was not heard to the end here.
  window.addEventListener("keydown", function (event) {
    hear(event);
    window.rrpHeard = event;
  }, true);
  window.rrpHeard = null;

  // ---- A page that does not open ----------------------------------------------------------------------------------------

  // By now the program's own script has run, or is missing, or this browser cannot read it.
  window.addEventListener("load", function () {
    if (window.rrpBegan) return;
    document.getElementById("unopened").hidden = false;
    document.getElementById("loading").hidden = true;
  });
})();
