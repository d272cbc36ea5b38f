//! Bad edits: each is answered by one clear sentence and changes nothing.

use behaviour::{Behaviour, Change, Connector, Id, Kind, Procedure, Record, RecordId, Stream, StreamKind, connectors};
use house::{Outcome, Page, Trouble, skip};

use crate::steps::*;
use crate::visitor::{Opened, Visitor, id};

#[tokio::test]
async fn a_bad_edit_is_answered_and_changes_nothing() -> Outcome<()> {
    skip::unless!(ready("journey: bad edits"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Edits").await?;
    ball_to_tracker(&aiko).await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    let before = visitor.open_newest().await?;

    let sentence = bad_body(&aiko).await?;
    assert!(sentence.starts_with("This procedure cannot run"), "{sentence}");
    assert_eq!(visitor.open(&before.id).await?, before);
    let sentence = bad_name(&aiko, &"x".repeat(9_000)).await?;
    assert!(sentence.contains("is too long"), "{sentence}");
    assert_eq!(visitor.open(&before.id).await?, before);
    let sentence = bad_name(&aiko, "Tracker").await?;
    assert!(sentence.starts_with("There is already a “Tracker”"), "{sentence}");
    assert_eq!(visitor.open(&before.id).await?, before);

    let shown = names_in(&aiko).await?;
    for (what, change, says) in not_offered(&before)? {
        let sentence = visitor.refused(&before.id, change).await?;
        assert!(sentence.contains(says) && is_clear(&sentence), "{what}: {sentence}");
        assert_eq!(visitor.open(&before.id).await?, before, "{what}");
    }
    assert_eq!(names_in(&aiko).await?, shown);
    calm(&aiko)
}

/// Red ball, distance, Tracker, by the suggestions.
async fn ball_to_tracker(page: &Page) -> Outcome<()> {
    add_sense(page, "Red ball").await?;
    next(page, "Red ball", "Distance in cm").await?;
    page.find("button", "Distance, stream").await?;
    next(page, "Distance", "Tracker").await?;
    page.find("button", "Tracker, *").await?;
    saved(page).await
}

/// Saves a body that is no procedure; answers with what the dialog says.
async fn bad_body(page: &Page) -> Outcome<String> {
    thunderbolt(page, "Red ball", "map").await?;
    let dialog = page.within("dialog", "Operation");
    dialog.fill("textbox", "Procedure", "redBall.size +").await?;
    dialog.fill("textbox", "Output stream name", "Larger").await?;
    refused(page, "Operation").await
}

/// Saves a bad name of the stream; answers with what the dialog says.
async fn bad_name(page: &Page, name: &str) -> Outcome<String> {
    select(page, "Distance").await?;
    next(page, "Distance", "Edit").await?;
    page.find("dialog", "Stream settings").await?;
    // The box takes no more than a name may have, so it is filled past its limit.
    let js = format!(
        "function () {{ this.value = {}; this.dispatchEvent(new Event('input', {{ bubbles: true }})); }}",
        serde_json::Value::from(name)
    );
    page.on("textbox", "Name", &js).await?;
    refused(page, "Stream settings").await
}

/// Presses Save, reads why not, and closes the dialog.
async fn refused(page: &Page, dialog: &str) -> Outcome<String> {
    page.within("dialog", dialog).press("button", "Save").await?;
    let sentence = page.until("document.querySelector('.dialog .refusal')?.innerText", "it says why not").await?;
    let sentence = sentence.as_str().unwrap_or_default().to_owned();
    if !is_clear(&sentence) {
        return Err(Trouble(format!("this is no clear sentence: {sentence}")));
    }
    page.key("Escape").await?;
    page.gone("dialog", dialog).await?;
    Ok(sentence)
}

/// Short, with a beginning and an end, and without inner words of the program.
fn is_clear(sentence: &str) -> bool {
    let begins = sentence.starts_with(|letter: char| letter.is_uppercase() || letter == '“');
    begins && sentence.ends_with('.') && sentence.chars().count() < 300 && !sentence.contains("::")
}

/// The streams and connectors in view.
async fn names_in(page: &Page) -> Outcome<Vec<String>> {
    let js = "[...document.querySelectorAll('[data-node], [data-chip]')].map(e => e.ariaLabel).sort().join('|')";
    let names = page.eval(js).await?;
    Ok(names.as_str().unwrap_or_default().split('|').map(str::to_owned).collect())
}

type Bad = (&'static str, Change, &'static str);

/// Edits that the page does not offer, and a part of the answer to each.
fn not_offered(now: &Opened) -> Outcome<[Bad; 4]> {
    let (ball, distance, tracker) = (now.stream("Red ball")?, now.stream("Distance")?, now.stream("Tracker")?);
    let change = |name: &str| Ok::<_, Trouble>(Change::of(id(name)?, "Visitor", name));
    let (new, way) = (id("new")?, id("way")?);
    let records = &now.records;
    let cycle = with_stream(change("cycle")?, records, &new, None);
    let cycle = with_way(cycle, records, &way, (&distance, &new));
    let cycle = with_way(cycle, records, &into(records, &distance)?, (&new, &distance));
    let second = with_way(change("second")?, records, &way, (&ball, &distance));
    let out = with_stream(change("out")?, records, &new, None);
    let out = with_way(out, records, &way, (&tracker, &new));
    let unknown = with_stream(change("unknown")?, records, &new, Some("Nose"));
    Ok([
        ("a cycle", cycle, "in a circle"),
        ("a second input", second, "already gets its values"),
        ("out of an action", out, "nothing can come out of it"),
        ("an unknown device", unknown, "Nose"),
    ])
}

fn with_stream(change: Change, records: &Behaviour, id: &Id, sense: Option<&str>) -> Change {
    let kind = if sense.is_some() { StreamKind::Sensor } else { StreamKind::Ordinary };
    let device = sense.map(str::to_owned);
    let name = "New one".to_owned();
    let stream =
        Stream { kind, name, device, params: [].into(), order: 99, resources: None, priority: None, hold_ms: None };
    change.put(records, RecordId::new(Kind::Stream, id), Record::Stream(stream))
}

fn with_way(change: Change, records: &Behaviour, id: &Id, (from, to): (&Id, &Id)) -> Change {
    let operation = connectors::map::SPEC.with(Procedure::body("1"));
    let way = Connector { operation, inputs: vec![from.clone()], output: to.clone(), order: 99 };
    change.put(records, RecordId::new(Kind::Connector, id), Record::Connector(way))
}

/// The connector that leads to a stream.
fn into(records: &Behaviour, stream: &Id) -> Outcome<Id> {
    let found = records.connectors().find(|(_, connector)| connector.output == *stream);
    Ok(found.map(|(id, _)| id.clone()).ok_or("nothing leads there")?)
}
