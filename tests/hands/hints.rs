//! What is wrong is told without a press, and mended with one.

use house::{Outcome, Page};
use serde_json::{Value, json};

use crate::steps::{Stage, picture, rests, stage, text};

/// A stream that connectors make.
fn ordinary(id: &str, name: &str) -> Value {
    json!({ "id": id, "kind": "ordinary", "name": name })
}

/// A sense or an action.
pub(crate) fn device(id: &str, kind: &str, name: &str, device: &str) -> Value {
    json!({ "id": id, "kind": kind, "name": name, "device": device })
}

pub(crate) fn ball() -> Value {
    device("ball", "sensor", "Red ball", "RedBall")
}

pub(crate) fn connector(id: &str, word: &str, from: &str, to: &str) -> Value {
    json!({ "id": id, "type": word, "inputs": [from], "output": to })
}

fn by_helper(id: &str, from: &str, to: &str, helper: &str) -> Value {
    let mut made = connector(id, "map", from, to);
    made["helper"] = helper.into();
    made
}

fn by_body(id: &str, word: &str, from: &str, to: &str, body: &str) -> Value {
    let mut made = connector(id, word, from, to);
    made["body"] = body.into();
    made
}

pub(crate) fn file(name: &str, streams: &[Value], connectors: &[Value]) -> Value {
    json!({ "format": "rrp-behaviour/1", "name": name, "helpers": [], "streams": streams, "connectors": connectors })
}

/// A person with this program open.
pub(crate) async fn with_open(stage: &Stage, file: &Value) -> Outcome<Page> {
    let program = stage.wire.make("Right", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    let file = json!(file.to_string());
    let made = format!(
        "fetch('/api/import?mode=copy&by=Aiko', {{ method: 'POST', body: {file} }}).then(answer => answer.json()).then(made => made.id)"
    );
    let id = aiko.eval(&made).await?;
    aiko.eval(&format!("location.hash = '#/b/{}', 0", text(&id))).await?;
    let name = json!(file_name(&file));
    aiko.until(&format!("document.title.includes({name})"), "the program is open").await?;
    aiko.until("document.querySelector('.told .sentence, .tabs .number')", "what comes later is here").await?;
    Ok(aiko)
}

fn file_name(file: &Value) -> String {
    let file: Value = serde_json::from_str(text(file)).unwrap_or_default();
    text(&file["name"]).to_owned()
}

/// The only fix of the only problem is there without a press; one press mends it, and one undo takes that back.
async fn is_mended(aiko: &Page, fix: &str) -> Outcome<()> {
    let list = aiko.within("region", "Problems");
    let fix = format!("Mend it: {fix}*");
    list.find("button", &fix).await?;
    list.press("button", &fix).await?;
    aiko.until("!document.querySelector('.problem')", "nothing is wrong any more").await?;
    let stays = "document.activeElement.matches('[data-node], [data-chip]')";
    aiko.until(stays, "the keyboard is on what had the problem").await?;
    let said = "[...document.querySelectorAll('[role=status]')].some(one => one.textContent.startsWith('Mended: '))";
    aiko.until(said, "it is said").await?;
    aiko.press("button", "Undo").await?;
    list.find("button", &fix).await?;
    aiko.no_errors()
}

/// A ball's distance in centimetres goes to a brightness that wants metres.
fn wrong_unit() -> Value {
    let eyes = device("eyes", "actuator", "Eyes", "EyeBrightness");
    file(
        "Wrong unit",
        &[ball(), ordinary("distance", "Distance"), ordinary("brightness", "Brightness"), eyes],
        &[
            by_helper("c1", "ball", "distance", "distance"),
            by_helper("c2", "distance", "brightness", "distance_to_brightness"),
            connector("c3", "subscribe", "brightness", "eyes"),
        ],
    )
}

/// A ball’s distance in centimetres goes to a helper of one's own, of which one said that it takes metres.
fn own_helper() -> Value {
    let body = "if how_far < 1.0 { 1.0 } else { 0.0 }";
    let warm = json!({ "name": "warm", "params": ["how_far"], "body": body, "takes": ["m"], "gives": "fraction" });
    let mut made = wrong_unit();
    made["helpers"] = json!([warm]);
    made["connectors"][1]["helper"] = "warm".into();
    made
}

/// The words of the first phrase with a wave, with the keyboard on them.
const WAVE: &str = "(() => {
    const stop = document.querySelector('.told .phrase.warned [data-stop]');
    if (!stop) return false;
    stop.focus();
    return getComputedStyle(stop.closest('.phrase').querySelector('.words, .inline')).textDecorationStyle === 'wavy';
})()";

#[tokio::test]
async fn words_that_mean_something_wrong_have_a_wave_and_mend_it_with_the_keyboard() -> Outcome<()> {
    let stage = stage!("a wave under words");
    let aiko = with_open(&stage, &wrong_unit()).await?;
    aiko.until(WAVE, "the words have a wave").await?;
    let said = aiko.within("group", "Problems");
    said.find("button", "Mend it: Convert to metres*").await?;
    aiko.key("Tab").await?;
    aiko.until("!!document.activeElement.closest('.told-trouble')", "the keyboard is on what mends it").await?;
    aiko.key("Escape").await?;
    aiko.until("!!document.activeElement.closest('.phrase.warned')", "the keyboard is back on the words").await?;
    aiko.until("!document.querySelector('.told-trouble')", "it is put away").await?;
    Ok(())
}

#[tokio::test]
async fn what_ones_own_helper_takes_is_known_as_it_was_said() -> Outcome<()> {
    let stage = stage!("hints of one's own helper");
    let aiko = with_open(&stage, &own_helper()).await?;
    rests(&aiko, "Brightness, stream").await?;
    let list = aiko.within("region", "Problems");
    list.find("button", "Mend it: Convert to metres*").await?;
    list.press("button", "Mend it: Use “Distance in m” instead*").await?;
    aiko.find("button", "map (Distance in m), connector*").await?;
    aiko.until("!document.querySelector('.problem .fix')", "nothing is wrong any more").await?;
    aiko.press("button", "Undo").await?;
    list.find("button", "Mend it: Convert to metres*").await?;

    // The plus on the edge offers the conversion: one step, one undo.
    let chip = rests(&aiko, "map (warm), connector*").await?;
    aiko.move_to((chip.centre().0, chip.y - 8.0)).await?;
    aiko.move_to((chip.centre().0, chip.y - 6.0)).await?;
    aiko.within("main", "The graph").press("button", "Insert between Distance and map (warm)").await?;
    aiko.find("menuitem", "warm converts to m").await?;
    aiko.press("menuitem", "Convert to m*").await?;
    aiko.find("button", "Distance in m, stream").await?;
    aiko.until("!document.querySelector('.problem .fix')", "nothing is wrong any more").await?;
    aiko.press("button", "Undo").await?;
    aiko.until("document.querySelectorAll('[data-node]').length === 4", "one undo takes it back").await?;

    // What was said is said in the dialog, and can be taken back there.
    aiko.press("button", "Edit helper").await?;
    aiko.press("menuitem", "warm*").await?;
    let dialog = aiko.within("dialog", "Edit helper");
    assert_eq!(dialog.text("combobox", "What “how_far” is").await?, "m");
    assert_eq!(dialog.text("combobox", "What it gives").await?, "fraction");
    picture(&aiko, "helper-kinds").await?;
    let cm = "function () { this.value = 'cm'; this.dispatchEvent(new Event('change', { bubbles: true })); }";
    aiko.on("combobox", "What “how_far” is", cm).await?;
    dialog.press("button", "Save").await?;
    aiko.gone("dialog", "Edit helper").await?;
    aiko.until("!document.querySelector('.problem .fix')", "it takes centimetres now").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_wrong_unit_is_told_without_a_press_and_mended_with_one() -> Outcome<()> {
    let stage = stage!("hints");
    let aiko = with_open(&stage, &wrong_unit()).await?;
    rests(&aiko, "Brightness, stream").await?;
    let list = aiko.within("region", "Problems");
    list.find("button", "Mend it: Convert to metres*").await?;
    picture(&aiko, "wrong-unit").await?;
    list.press("button", "Mend it: Convert to metres*").await?;
    aiko.find("button", "Distance in m, stream").await?;
    aiko.until("!document.querySelector('.problem .fix')", "nothing is wrong any more").await?;
    aiko.press("button", "Undo").await?;
    aiko.until("document.querySelectorAll('[data-node]').length === 4", "one undo takes it back").await?;
    let beside = aiko.within("note", "Problems");
    beside.find("button", "Mend it: Convert to metres*").await?;
    picture(&aiko, "wrong-unit-beside").await?;
    beside.press("button", "Mend it: Convert to metres*").await?;
    aiko.find("button", "Distance in m, stream").await?;
    aiko.gone("note", "Problems").await?;
    aiko.press("button", "Start").await?;
    aiko.until(
        "[...document.querySelectorAll('#stage .value')].some(value => /[0-9]\\u00a0cm/.test(value.textContent))",
        "values have their unit",
    )
    .await?;
    aiko.press("button", "Stop").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_name_that_means_nothing_is_underlined_where_it_is_written() -> Outcome<()> {
    let stage = stage!("unknown name");
    let mut joint = device("joint", "actuator", "Turn head", "SetJointPosition");
    joint["params"] = json!({ "joint": "HeadYaw" });
    let streams = [ball(), ordinary("side", "Side"), joint];
    let connectors =
        [by_body("c1", "map", "ball", "side", "siin(redBall.x)"), connector("c2", "subscribe", "side", "joint")];
    let aiko = with_open(&stage, &file("Mistyped", &streams, &connectors)).await?;
    let underlined = "document.querySelector('.chip .unknown-token')?.textContent === 'siin'";
    aiko.until(underlined, "it is underlined on its chip").await?;
    picture(&aiko, "unknown-name").await?;
    is_mended(&aiko, "Use “sin”").await?;
    aiko.press_twice("button", "map (siin(redBall.x)), connector*").await?;
    let dialog = aiko.within("dialog", "Operation");
    aiko.until("document.querySelector('.code .unknown-token')?.textContent === 'siin'", "and in the box").await?;
    picture(&aiko, "unknown-name-in-the-box").await?;
    dialog.press("button", "Use “sin”").await?;
    assert_eq!(dialog.text("textbox", "Procedure").await?, "sin(redBall.x)");
    aiko.until("!document.querySelector('.code .unknown-token')", "nothing is underlined any more").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn what_leads_nowhere_gets_an_action_and_what_gets_nothing_a_source() -> Outcome<()> {
    let stage = stage!("unreachable");
    let streams = [ball(), ordinary("distance", "Distance")];
    let aiko = with_open(&stage, &file("Loose", &streams, &[])).await?;
    aiko.find("tab", "Problems 3").await?;
    aiko.press("button", "Distance, stream").await?;
    aiko.find("tab", "Problems 3").await?;
    let panel = aiko.within("region", "What is selected");
    panel.press("button", "Connect").await?;
    aiko.within("dialog", "Connect to Distance").press("button", "Red ball*").await?;
    aiko.find("button", "merge, connector from Red ball to Distance").await?;
    panel.press("button", "Add an action").await?;
    aiko.find("menu", "After Distance").await?;
    picture(&aiko, "add-an-action").await?;
    aiko.press("menuitem", "Tracker*").await?;
    aiko.find("button", "subscribe, connector from Distance to Tracker").await?;
    aiko.until("!document.querySelector('.problem')", "everything leads somewhere").await?;
    aiko.find("tab", "Problems").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn what_is_left_over_is_marked_only_when_nothing_else_is_missing() -> Outcome<()> {
    let stage = stage!("left over");
    let streams = [ball(), ordinary("distance", "Distance"), device("head", "actuator", "Follow", "Tracker")];
    let connectors = [by_helper("c1", "ball", "distance", "distance"), connector("c2", "subscribe", "ball", "head")];
    let aiko = with_open(&stage, &file("Left", &streams, &connectors)).await?;
    let marked = "function () { return !!this.closest('.at').querySelector('.badge'); }";
    aiko.until_on("button", "Distance, stream", marked, "it is marked").await?;
    picture(&aiko, "left-over").await?;
    aiko.press("button", "Distance, stream").await?;
    let free = "function () { return !this.closest('.at').querySelector('.badge'); }";
    aiko.until_on("button", "Distance, stream", free, "not while somebody works on it").await?;
    aiko.key("Escape").await?;
    aiko.until_on("button", "Distance, stream", marked, "and again then").await?;
    aiko.press("button", "Follow, *").await?;
    aiko.key("Delete").await?;
    aiko.gone("button", "Follow, *").await?;
    aiko.until_on("button", "Distance, stream", free, "not while the rest is being built").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn all_problems_are_listed_while_something_is_selected() -> Outcome<()> {
    let stage = stage!("problems beside");
    let aiko = with_open(&stage, &wrong_unit()).await?;
    rests(&aiko, "Brightness, stream").await?;
    aiko.press("button", "Red ball, sensor stream").await?;
    aiko.find("region", "What is selected").await?;
    aiko.press("tab", "Problems 1").await?;
    aiko.within("region", "Problems").find("button", "Mend it: Convert to metres*").await?;
    aiko.key("ArrowLeft").await?;
    aiko.key("Enter").await?;
    aiko.find("region", "What is selected").await?;
    aiko.press("button", "Eyes, *").await?;
    aiko.find("region", "What is selected").await?;
    aiko.until(WAVE, "its phrase is underlined").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_program_with_nothing_in_it_says_so_at_start() -> Outcome<()> {
    let stage = stage!("empty program");
    let program = stage.wire.make("Empty", None).await?;
    let aiko = stage.person("aiko", &program).await?;
    let start = aiko.find("button", "Start").await?;
    assert!(start.disabled, "there is nothing to run");
    let said = "document.getElementById('robot-line').textContent.includes('There is nothing in it yet.')";
    aiko.until(said, "it says what is missing").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_name_follows_its_test_until_a_person_gives_another() -> Outcome<()> {
    let stage = stage!("names that follow");
    let streams = [
        ball(),
        ordinary("distance", "Distance"),
        ordinary("near", "Distance < 40"),
        device("head", "actuator", "Follow", "Tracker"),
    ];
    let connectors = [
        by_helper("c1", "ball", "distance", "distance"),
        by_body("c2", "filter", "distance", "near", "distance < 40"),
        connector("c3", "subscribe", "near", "head"),
    ];
    let aiko = with_open(&stage, &file("Names", &streams, &connectors)).await?;
    rests(&aiko, "Distance < 40, stream").await?;
    turn(&aiko, "40", "30").await?;
    aiko.find("button", "Distance < 30, stream").await?;
    aiko.find("button", "subscribe, connector from Distance < 30 to Follow").await?;
    aiko.press("button", "Distance < 30, stream").await?;
    aiko.key("F2").await?;
    aiko.until("document.activeElement.className === 'rename'", "the name can be typed").await?;
    aiko.type_text("Near").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "Near, stream").await?;
    turn(&aiko, "30", "20").await?;
    aiko.find("button", "filter (distance < 20), connector from Distance to Near").await?;
    aiko.no_errors()
}

/// Changes the number in the sentence.
async fn turn(page: &Page, from: &str, to: &str) -> Outcome<()> {
    page.press("button", &format!("Change: {from}*")).await?;
    page.until("document.activeElement.closest('.inline.open')", "the number is a field").await?;
    page.key("Control+a").await?;
    page.type_text(to).await?;
    page.key("Enter").await?;
    page.find("button", &format!("filter (distance < {to}), connector*")).await.map(drop)
}
