// What the harness's own page does: it counts what happens to it.
globalThis.seen = { clicks: 0, touches: 0, pinch: 1, keys: [], kinds: new Set() };
const box = document.getElementById("box"), stage = document.getElementById("stage");
document.getElementById("one").onclick = () => { seen.clicks++; document.getElementById("said").textContent = "run " + seen.clicks; };
document.getElementById("far").onclick = () => { seen.far = true; };
document.addEventListener("keydown", (e) => seen.keys.push((e.ctrlKey ? "^" : "") + e.key));
const at = new Map();
let start = 0;
const apart = () => { const [a, b] = [...at.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
stage.addEventListener("pointerdown", (e) => {
  seen.kinds.add(e.pointerType);
  at.set(e.pointerId, { x: e.clientX, y: e.clientY, target: e.target });
  if (at.size === 2) start = apart();
});
addEventListener("pointermove", (e) => {
  const last = at.get(e.pointerId);
  if (!last) return;
  if (at.size === 1 && last.target === box) {
    box.style.left = box.offsetLeft + e.clientX - last.x + "px";
    box.style.top = box.offsetTop + e.clientY - last.y + "px";
  }
  at.set(e.pointerId, { ...last, x: e.clientX, y: e.clientY });
  if (at.size === 2) seen.pinch = apart() / start;
});
for (const end of ["pointerup", "pointercancel"]) addEventListener(end, (e) => at.delete(e.pointerId));
