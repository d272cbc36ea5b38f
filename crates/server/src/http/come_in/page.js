// Puts the token of the link, which stands behind its #, where the button sends it from.
const form = document.querySelector("form");
if (!form.hidden) {
  const token = location.hash.slice(1);
  form.elements.token.value = token;
  form.querySelector("button").disabled = token === "";
  document.querySelector("#broken").hidden = token !== "";
  // What was used does not stay in the history.
  form.addEventListener("submit", () => history.replaceState(null, "", location.pathname));
} else {
  // Who is in and came here by a link of another site: the browser kept the cookie back that one time.
  fetch("/", { method: "HEAD" }).then((answer) => {
    if (answer.ok) location.replace("/");
  }, () => {});
}
