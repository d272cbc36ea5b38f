// Loads the program, and says so when it fails. Stop needs nothing of this: it is in stop.js.

const RELOADS_MAX = 3;
const RELOAD_MS = 800;
const HEALTHY_MS = 20_000;
const RELOADS = "rrp-reloads";

const form = document.getElementById("stop-form");
const words = form.dataset;

// ---- Escape twice, where stop.js did not come or fails ---------------------------------------------------------------

const ESCAPES_WITHIN_MS = 600;

let first = null;
// The window hears a key before the document does, and stop.js hears it at the window.
document.addEventListener("keydown", (event) => {
  if (event.key !== "Escape" || event.repeat || event.isComposing || event.keyCode === 229) return;
  const isSecond = first && event.timeStamp - first.timeStamp < ESCAPES_WITHIN_MS && !first.defaultPrevented;
  if (isSecond && window.rrpHeard !== event) form.submit();
  first = isSecond ? null : event;
}, { capture: true });

// ---- The language: as chosen, else as the browser is set; English needs nothing --------------------------------------

const LANGUAGE = "rrp.language";
// The build names the catalogues that there are.
const LANGUAGES = (document.documentElement.dataset.languages ?? "").split(" ");
const WORDS_WAIT_MS = 4_000;

function language() {
  let chosen = null;
  try { chosen = localStorage.getItem(LANGUAGE); } catch { /* Private windows may have no storage. */ }
  return chosen ?? (navigator.language ?? "en").slice(0, 2);
}

// The table of a second language, which the program takes when it starts. Without it the page speaks English.
async function table(code) {
  if (!LANGUAGES.includes(code)) return null;
  try {
    const answer = await fetch("/" + code + ".txt", { signal: AbortSignal.timeout?.(WORDS_WAIT_MS) });
    return answer.ok ? await answer.text() : null;
  } catch {
    return null;
  }
}

// Stop speaks it too.
function sayStop(text, code) {
  const said = new Map(text.split("\n\n").map((block) => block.split("\n").filter((line) => line && !line.startsWith("#"))));
  for (const key of Object.keys(words)) words[key] = said.get("stop." + key) ?? words[key];
  const button = document.getElementById("stop");
  button.title = said.get("stop.title") ?? button.title;
  form.setAttribute("aria-label", said.get("stop.label") ?? form.getAttribute("aria-label"));
  const label = button.querySelector("span");
  label.textContent = said.get("stop.button") ?? label.textContent;
  const loading = document.getElementById("loading");
  if (loading) loading.textContent = said.get("stop.loading") ?? loading.textContent;
  document.documentElement.lang = code;
}

// Both are fetched at once: neither waits for the other.
const spoken = language();
const wanted = table(spoken);
const code = fetch("/app_bg.wasm");
code.catch(() => { /* Said where it is waited for. */ });

// ---- When the program fails ---------------------------------------------------------------------------------------

function reloads() {
  try { return Number(sessionStorage.getItem(RELOADS)) || 0; } catch { return RELOADS_MAX; }
}

function setReloads(count) {
  try { sessionStorage.setItem(RELOADS, String(count)); } catch { /* Private windows may have no storage. */ }
}

function overlay(sentence, detail, button) {
  let box = document.getElementById("panic");
  if (box) return;
  box = document.createElement("div");
  box.id = "panic";
  box.setAttribute("role", "alert");
  const line = document.createElement("p");
  line.textContent = sentence;
  box.append(line);
  if (button) box.append(reloadButton());
  document.body.append(box);
  if (detail) console.error(detail);
}

function reloadButton() {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = words.reload;
  button.addEventListener("click", () => {
    setReloads(0);
    location.reload();
  });
  return button;
}

let panicked = false;
window.rrpPanic = (text) => {
  if (panicked) return;
  panicked = true;
  const count = reloads();
  if (count >= RELOADS_MAX) {
    overlay(words.stuck, text, true);
    return;
  }
  setReloads(count + 1);
  overlay(words.panic, text, false);
  setTimeout(() => location.reload(), RELOAD_MS);
};

// ---- The program --------------------------------------------------------------------------------------------------

function addManifest() {
  const link = document.createElement("link");
  link.rel = "manifest";
  link.href = "/manifest.webmanifest";
  document.head.append(link);
}

// From here on a failure is said below; one before this line, or of reading this file, stop.js sees by this.
window.rrpBegan = true;

try {
  const { default: init } = await import("./app.js");
  window.rrpWords = await wanted;
  if (window.rrpWords) sayStop(window.rrpWords, spoken);
  await init({ module_or_path: code });
  document.getElementById("loading")?.remove();
  setTimeout(() => { if (!panicked) setReloads(0); }, HEALTHY_MS);
  setTimeout(addManifest, HEALTHY_MS / 10);
} catch (error) {
  // What this browser cannot run, it cannot run when it is loaded again either.
  const isTooOld = !window.WebAssembly || error instanceof WebAssembly.CompileError;
  if (isTooOld) document.getElementById("loading")?.remove();
  document.getElementById("unopened").hidden = !isTooOld;
  if (!panicked && !isTooOld) overlay(words.unloaded, error, true);
}
