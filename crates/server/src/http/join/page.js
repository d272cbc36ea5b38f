// Puts the token of the link, which stands behind its #, where the button sends it from.
const form = document.querySelector("#come-in");
if (!form.hidden) {
  const token = location.hash.slice(1);
  form.elements.token.value = token;
  form.querySelector("button").disabled = token === "";
  document.querySelector("#broken").hidden = token !== "";
  // What was used does not stay in the history.
  form.addEventListener("submit", () => history.replaceState(null, "", location.pathname));
  // Who invites, and what for; or that the link lets nobody in, before it is pressed.
  const says = document.querySelector("#says");
  const why = async (answer) => {
    if (!answer.ok && answer.status !== 403 && answer.status !== 429) return;
    says.textContent = await answer.text();
    form.hidden = !answer.ok;
  };
  if (token !== "" && !("atOnce" in form.dataset)) {
    fetch("/come-in/invitation", { method: "POST", body: new URLSearchParams({ token }) }).then(why).catch(() => {});
  }
  // The link of a terminal is opened by nobody but its reader: opening it is the press.
  if ("atOnce" in form.dataset && token !== "") form.requestSubmit();
} else {
  // Who is in and came here by a link of another site: the browser kept the cookie back that one time.
  fetch("/", { method: "HEAD" }).then((answer) => {
    if (answer.ok) location.replace("/");
  }, () => {});
}
