//! What axe finds, and that it finds nothing where the page has no colours of its own.

use crate::screens::{Stage, nothing, rests, run_template, selected};
use crate::words::Words;
use house::{Outcome, Page, Rules, skip};

/// What breaks any rule of axe.
pub(crate) async fn check(page: &Page, place: &str) -> Outcome<Vec<String>> {
    check_by(page, Rules::All, place).await
}

/// What breaks these rules of axe.
pub(crate) async fn check_by(page: &Page, rules: Rules, place: &str) -> Outcome<Vec<String>> {
    let violations = page.axe("", rules).await?;
    let line = |violation: house::Violation| {
        let nodes = violation.nodes.join("\n      ");
        format!("{place}: {} ({}): {}\n      {nodes}", violation.rule, violation.impact, violation.help)
    };
    Ok(violations.into_iter().map(line).collect())
}

/// The lamp and the connector that is chosen, as they are seen where the page has no colours of its own.
const SEEN: &str = "(() => {
    const lamp = getComputedStyle(document.querySelector('.robot-head .lamp'));
    const chip = getComputedStyle(document.querySelector('.chip.selected'));
    const line = style => [style.outlineStyle, style.borderTopStyle].some(one => one !== 'none');
    const ground = getComputedStyle(document.querySelector('.robot-head')).backgroundColor;
    return (line(lamp) || lamp.backgroundColor !== ground) && chip.outlineStyle !== 'none' && parseFloat(chip.outlineWidth) >= 2;
})()";

#[tokio::test]
async fn with_forced_colours_axe_finds_nothing_and_the_lamp_and_what_is_chosen_are_seen() -> Outcome<()> {
    skip::unless!(ready("axe with forced colours"));
    let stage = Stage::set().await?;
    let page = &stage.page;
    page.media("forced-colors", "active").await?;
    let mut found = check(page, "empty-library, forced").await?;
    run_template(page, &Words::english()).await?;
    selected(page, &Words::english(), "Distance").await?;
    rests(page).await?;
    found.extend(check(page, "running, forced").await?);
    page.eval("document.querySelector('.chip').click(), 0").await?;
    page.until("document.querySelector('.chip.selected') !== null", "a connector is chosen").await?;
    rests(page).await?;
    page.until(SEEN, "the lamp and the chosen connector are seen").await?;
    found.extend(check(page, "chip, forced").await?);
    page.screenshot(&house::target().join("looks/forced-colours.png")).await?;
    page.key("Control+k").await?;
    page.find("dialog", "Keys and gestures").await?;
    rests(page).await?;
    found.extend(check(page, "commands, forced").await?);
    page.size(390, 844, true).await?;
    rests(page).await?;
    found.extend(check(page, "commands, phone, forced").await?);
    nothing("findings of axe", &found)?;
    page.no_errors()
}
