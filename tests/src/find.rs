//! Finding things as people and screen readers do: by role and accessible name.

use serde_json::{Value, json};

use crate::page::{Page, truthy};
use crate::{Outcome, Trouble};

/// Names listed in a failure.
const NAMES_MAX: usize = 20;

/// Says what is on top at a point: an empty text when it is (part of) `this`, else what covers it.
const COVER: &str = "function (x, y) {
    const element = this.nodeType === Node.TEXT_NODE ? this.parentElement : this;
    let top = document.elementFromPoint(x, y);
    while (top?.shadowRoot?.elementFromPoint(x, y) && top.shadowRoot.elementFromPoint(x, y) !== top)
        top = top.shadowRoot.elementFromPoint(x, y);
    if (!top) return 'it is outside the window';
    for (let node = top; node; node = node.parentNode ?? node.host) {
        if (node === element || (node.control && node.control === element)) return '';
    }
    return 'it is covered by ' + top.cloneNode(false).outerHTML.slice(0, 160);
}";

/// Returns the text of an element: the value of a field, else its visible text.
const TEXT: &str = "function () {
    const element = this.nodeType === Node.TEXT_NODE ? this.parentElement : this;
    const field = element.matches('input, textarea, select, output');
    return field ? element.value : (element.innerText ?? element.textContent);
}";

/// A rectangle in CSS pixels from the window's upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// The left edge.
    pub x: f64,
    /// The upper edge.
    pub y: f64,
    /// From left to right.
    pub width: f64,
    /// From top to bottom.
    pub height: f64,
}

impl Rect {
    /// The point in the middle.
    pub fn centre(&self) -> (f64, f64) {
        (self.x + self.width / 2.0, self.y + self.height / 2.0)
    }

    fn around(quad: &[f64]) -> Rect {
        let (xs, ys): (Vec<f64>, Vec<f64>) = quad.chunks_exact(2).map(|point| (point[0], point[1])).unzip();
        let least = |numbers: &[f64]| numbers.iter().copied().fold(f64::INFINITY, f64::min);
        let most = |numbers: &[f64]| numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (x, y) = (least(&xs), least(&ys));
        Rect { x, y, width: most(&xs) - x, height: most(&ys) - y }
    }

    fn with(self, other: Rect) -> Rect {
        let (x, y) = (self.x.min(other.x), self.y.min(other.y));
        let right = (self.x + self.width).max(other.x + other.width);
        let bottom = (self.y + self.height).max(other.y + other.height);
        Rect { x, y, width: right - x, height: bottom - y }
    }
}

/// A visible element as it was when it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Chromium's number for the element (`backendNodeId`).
    pub id: i64,
    /// The accessible name of the element.
    pub name: String,
    /// True if it says that it is disabled.
    pub disabled: bool,
    /// All of it.
    pub rect: Rect,
    /// A point on it: the centre of its first box (a link may run over several lines).
    pub point: (f64, f64),
}

/// The element to look inside of, by role and name: a dialog, a toolbar. None is all of the page.
pub(crate) type Inside<'a> = Option<(&'a str, &'a str)>;

impl Page {
    /// The visible elements with this ARIA `role` and accessible `name`, now.
    /// The name is exact; one that ends with `*` matches as a beginning; an empty one matches any.
    pub async fn find_all(&self, role: &str, name: &str) -> Outcome<Vec<Node>> {
        self.find_all_in(None, role, name).await
    }

    pub(crate) async fn find_all_in(&self, inside: Inside<'_>, role: &str, name: &str) -> Outcome<Vec<Node>> {
        let mut nodes = Vec::new();
        for found in self.query(inside, role, name).await? {
            nodes.extend(self.visible(&found).await);
        }
        Ok(nodes)
    }

    /// Counts the visible elements that have this role and name, now.
    pub async fn count(&self, role: &str, name: &str) -> Outcome<usize> {
        Ok(self.find_all(role, name).await?.len())
    }

    /// Waits until exactly one visible element has this role and name.
    pub async fn find(&self, role: &str, name: &str) -> Outcome<Node> {
        self.find_in(None, role, name).await
    }

    pub(crate) async fn find_in(&self, inside: Inside<'_>, role: &str, name: &str) -> Outcome<Node> {
        let what = format!("one {role} \"{name}\" in view{}", place(inside));
        self.patiently(&what, async || self.one(inside, role, name).await).await
    }

    /// Waits until no visible element has this role and name.
    pub async fn gone(&self, role: &str, name: &str) -> Outcome<()> {
        let look = async || match self.count(role, name).await {
            Ok(0) => Ok(()),
            Ok(count) => Err(format!("there are {count}")),
            Err(trouble) => Err(trouble.0),
        };
        self.patiently(&format!("no {role} \"{name}\" in view"), look).await
    }

    /// Returns the box of the one element with this role and name, in the window.
    pub async fn boxed(&self, role: &str, name: &str) -> Outcome<Rect> {
        Ok(self.find(role, name).await?.rect)
    }

    /// Returns the text of the one element with this role and name: a field's value, else its visible text.
    pub async fn text(&self, role: &str, name: &str) -> Outcome<String> {
        self.text_in(None, role, name).await
    }

    pub(crate) async fn text_in(&self, inside: Inside<'_>, role: &str, name: &str) -> Outcome<String> {
        let node = self.find_in(inside, role, name).await?;
        let text = self.ask(node.id, TEXT, json!([])).await?;
        Ok(text.as_str().unwrap_or_default().to_owned())
    }

    /// Calls the function `js` with the one element as `this`.
    pub async fn on(&self, role: &str, name: &str, js: &str) -> Outcome<Value> {
        let node = self.find(role, name).await?;
        self.ask(node.id, js, json!([])).await
    }

    /// Waits until the function `js`, called with the one element as `this`, answers with something truthy.
    /// `what` says it in words, for the failure.
    pub async fn until_on(&self, role: &str, name: &str, js: &str, what: &str) -> Outcome<Value> {
        let look = async || {
            let node = self.one(None, role, name).await?;
            let value = self.ask(node.id, js, json!([])).await.map_err(|trouble| trouble.0)?;
            if truthy(&value) { Ok(value) } else { Err(format!("the {role} \"{name}\" says {value}")) }
        };
        self.patiently(what, look).await
    }

    /// Waits until the one element rests in view with nothing over it, and answers with a point on it.
    pub(crate) async fn reach(&self, role: &str, name: &str) -> Outcome<(f64, f64)> {
        self.reach_in(None, role, name).await
    }

    pub(crate) async fn reach_in(&self, inside: Inside<'_>, role: &str, name: &str) -> Outcome<(f64, f64)> {
        let what = format!("the {role} \"{name}\"{} can be pressed", place(inside));
        self.patiently(&what, async || self.reachable(inside, role, name).await).await
    }

    async fn reachable(&self, inside: Inside<'_>, role: &str, name: &str) -> Result<(f64, f64), String> {
        let found = self.one(inside, role, name).await?;
        if found.disabled {
            return Err("it is disabled".to_owned());
        }
        let scroll = json!({ "backendNodeId": found.id });
        self.call("DOM.scrollIntoViewIfNeeded", scroll).await.map_err(|trouble| trouble.0)?;
        let (before, now) = (self.one(inside, role, name).await?, self.one(inside, role, name).await?);
        if now != before {
            return Err("it keeps moving".to_owned());
        }
        let (x, y) = now.point;
        let asked = json!([{ "value": x }, { "value": y }]);
        let cover = self.ask(now.id, COVER, asked).await.map_err(|trouble| trouble.0)?;
        match cover.as_str() {
            Some("") => Ok((x, y)),
            Some(cover) => Err(cover.to_owned()),
            None => Err("the page does not say what is on top of it".to_owned()),
        }
    }

    /// The one visible element, or why there is not one.
    async fn one(&self, inside: Inside<'_>, role: &str, name: &str) -> Result<Node, String> {
        let mut nodes = self.find_all_in(inside, role, name).await.map_err(|trouble| trouble.0)?;
        match nodes.len() {
            1 => Ok(nodes.remove(0)),
            0 => Err(format!("there is none; {}", self.alternatives(inside, role).await)),
            count => Err(format!("there are {count}: {:?}", nodes.iter().map(|node| node.rect).collect::<Vec<_>>())),
        }
    }

    /// The names that do exist for a role.
    async fn alternatives(&self, inside: Inside<'_>, role: &str) -> String {
        let nodes = self.find_all_in(inside, role, "").await.unwrap_or_default();
        let names: Vec<String> = nodes.iter().take(NAMES_MAX).map(|node| format!("\"{}\"", node.name)).collect();
        match names.len() {
            0 => format!("nothing in view is a {role}"),
            _ => format!("each {role} in view: {}", names.join(", ")),
        }
    }

    /// Elements of the accessibility tree, visible or not.
    async fn query(&self, inside: Inside<'_>, role: &str, name: &str) -> Outcome<Vec<Value>> {
        let document = self.call("DOM.getDocument", json!({ "depth": 0 })).await?;
        let root = document["root"]["backendNodeId"].clone();
        let Some((outer_role, outer_name)) = inside else { return self.query_under(root, role, name).await };
        let outer = self.query_under(root, outer_role, outer_name).await?;
        match outer.as_slice() {
            [one] => self.query_under(one["backendDOMNodeId"].clone(), role, name).await,
            none_or_many => Err(Trouble(format!("there are {}{}", none_or_many.len(), place(inside)))),
        }
    }

    async fn query_under(&self, root: Value, role: &str, name: &str) -> Outcome<Vec<Value>> {
        let mut asked = json!({ "backendNodeId": root, "role": role });
        let start = name.strip_suffix('*');
        if start.is_none() && !name.is_empty() {
            asked["accessibleName"] = name.into();
        }
        let mut answer = self.call("Accessibility.queryAXTree", asked).await?;
        let Value::Array(mut nodes) = answer["nodes"].take() else {
            return Err(Trouble::of("Accessibility.queryAXTree", "an answer without nodes"));
        };
        nodes.retain(|node| node["ignored"] != true);
        nodes.retain(|node| start.is_none_or(|start| named(node).starts_with(start)));
        Ok(nodes)
    }

    /// The element with its place, if it takes any.
    async fn visible(&self, found: &Value) -> Option<Node> {
        let id = found["backendDOMNodeId"].as_i64()?;
        let quads = self.call("DOM.getContentQuads", json!({ "backendNodeId": id })).await.ok()?;
        let boxes = quads["quads"].as_array()?.iter().map(|quad| Rect::around(&numbers(quad)));
        let boxes: Vec<Rect> = boxes.filter(|area| area.width > 0.0 && area.height > 0.0).collect();
        let first = *boxes.first()?;
        let rect = boxes.iter().copied().fold(first, Rect::with);
        let disabled = property(found, "disabled") == Some(&Value::Bool(true));
        Some(Node { id, name: named(found).to_owned(), disabled, rect, point: first.centre() })
    }

    /// Calls the function `js` with the element as `this`.
    async fn ask(&self, id: i64, js: &str, arguments: Value) -> Outcome<Value> {
        let resolved = self.call("DOM.resolveNode", json!({ "backendNodeId": id })).await?;
        let asked = json!({
            "objectId": resolved["object"]["objectId"], "functionDeclaration": js, "arguments": arguments,
            "returnByValue": true, "awaitPromise": true,
        });
        let mut answer = self.call("Runtime.callFunctionOn", asked).await?;
        match answer.get("exceptionDetails") {
            Some(details) => Err(Trouble(crate::watch::exception(details))),
            None => Ok(answer["result"]["value"].take()),
        }
    }
}

/// In words, for failures.
fn place(inside: Inside<'_>) -> String {
    inside.map_or_else(String::new, |(role, name)| format!(" in the {role} \"{name}\""))
}

fn named(node: &Value) -> &str {
    node["name"]["value"].as_str().unwrap_or_default()
}

fn property<'a>(node: &'a Value, name: &str) -> Option<&'a Value> {
    let property = node["properties"].as_array()?.iter().find(|property| property["name"] == name)?;
    property.pointer("/value/value")
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
}
