//! Accessibility rules, checked by axe-core (MPL-2.0, in `tests/vendor`).

use serde_json::Value;

use crate::Outcome;
use crate::page::Page;

const AXE: &str = include_str!("../vendor/axe.min.js");

/// The rules whose answer hangs on colours.
const COLOURS: &str = "['color-contrast', 'link-in-text-block']";

/// The rules that axe is asked. Those about colours are half of its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rules {
    /// Every rule.
    All,
    /// The rules that another theme can break: contrast, and links that only their colour tells from the text around
    /// them.
    Colours,
    /// The rules that no theme changes: names, roles, order.
    AllButColours,
}

impl Rules {
    /// Returns the option as axe takes it.
    fn option(self) -> String {
        match self {
            Rules::All => "{}".to_owned(),
            Rules::Colours => format!("{{ runOnly: {COLOURS} }}"),
            Rules::AllButColours => {
                format!("{{ rules: Object.fromEntries({COLOURS}.map(rule => [rule, {{ enabled: false }}])) }}")
            }
        }
    }
}

/// A broken rule and the elements that break it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// The rule's name, such as `color-contrast`.
    pub rule: String,
    /// `minor`, `moderate`, `serious` or `critical`.
    pub impact: String,
    /// The demand of the rule.
    pub help: String,
    /// CSS selectors of the elements, each with the reason.
    pub nodes: Vec<String>,
}

impl Page {
    /// Checks what matches the CSS selector `scope` (all of the page when it is empty) in its present state.
    pub async fn axe(&self, scope: &str, rules: Rules) -> Outcome<Vec<Violation>> {
        if self.eval("typeof globalThis.axe").await? != "object" {
            self.eval(&format!("{AXE}\n;0")).await?;
        }
        let scope = if scope.is_empty() { "document".to_owned() } else { Value::from(scope).to_string() };
        // Nothing is fetched again for rules that are off by themselves.
        let options = format!("{{ resultTypes: ['violations'], preload: false, ...{} }}", rules.option());
        let script = format!("axe.run({scope}, {options}).then(found => found.violations)");
        let found = self.eval(&script).await?;
        Ok(found.as_array().into_iter().flatten().map(violation).collect())
    }
}

fn violation(found: &Value) -> Violation {
    let word = |name: &str| found[name].as_str().unwrap_or_default().to_owned();
    let nodes = found["nodes"].as_array().into_iter().flatten();
    Violation { rule: word("id"), impact: word("impact"), help: word("help"), nodes: nodes.map(node).collect() }
}

fn node(found: &Value) -> String {
    let why = found["failureSummary"].as_str().unwrap_or_default();
    let why = why.split_whitespace().collect::<Vec<_>>().join(" ");
    format!("{}: {why}", found["target"])
}
