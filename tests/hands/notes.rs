//! Notes beside the graph: written in place, moved, copied, taken back; by mouse, by finger and by keys.

use house::Outcome;

use crate::steps::{picture, rests, stage};

const BALLS: Option<&str> = Some("Track far and close balls");
/// The start of the accessible name of any note.
const NOTE: &str = "Note by *";

#[tokio::test]
async fn a_note_is_written_in_place_and_everybody_reads_it() -> Outcome<()> {
    let stage = stage!("a note");
    let program = stage.wire.make("Noted", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    let ben = stage.person("ben", &program).await?;
    let ball = rests(&aiko, "Far ball, stream").await?;
    let left =
        aiko.eval("document.querySelector('#stage').getBoundingClientRect().left").await?.as_f64().unwrap_or_default();
    aiko.move_to((left + 140.0, ball.y + 200.0)).await?;
    aiko.eval("document.querySelector('#stage').focus(), 0").await?;
    aiko.key("n").await?;
    aiko.until("document.activeElement.matches('textarea.note-field')", "the note is written").await?;
    aiko.type_text("Ask Yuki\nbefore group B").await?;
    aiko.key("Control+Enter").await?;
    let note = rests(&aiko, NOTE).await?;
    assert!(note.width <= 248.0 && (note.y - ball.y - 200.0).abs() < 30.0, "{note:?} {ball:?}");
    ben.find("button", NOTE).await?;
    ben.until("document.querySelector('.note-text').textContent === 'Ask Yuki\\nbefore group B'", "ben reads it")
        .await?;
    picture(&aiko, "note").await?;

    let (x, y) = note.centre();
    aiko.drag((x, y), (x, y + 80.0), 6).await?;
    let moved = rests(&aiko, NOTE).await?;
    assert!((moved.y - note.y - 80.0).abs() < 12.0, "{note:?} {moved:?}");
    aiko.key("Control+z").await?;
    let back = format!("Math.abs(document.querySelector('.note').getBoundingClientRect().y - {}) < 3", note.y);
    aiko.until(&back, "one step takes the drag back").await?;
    aiko.key("Control+z").await?;
    aiko.gone("button", NOTE).await?;
    ben.gone("button", NOTE).await?;
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn a_note_is_opened_taken_back_doubled_and_removed_by_keys() -> Outcome<()> {
    let stage = stage!("a note by keys");
    let program = stage.wire.make("Note keys", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Far ball, stream").await?;
    aiko.eval("document.querySelector('#stage').focus(), 0").await?;
    aiko.key("n").await?;
    aiko.until("document.activeElement.matches('textarea.note-field')", "the note is written").await?;
    aiko.type_text("One").await?;
    aiko.key("Control+Enter").await?;
    aiko.until("document.activeElement.matches('[data-note]')", "the note has the keyboard").await?;
    aiko.key("Enter").await?;
    aiko.until("document.activeElement.matches('textarea.note-field')", "it is open again").await?;
    aiko.type_text(" and more").await?;
    aiko.key("Escape").await?;
    aiko.until("document.querySelector('.note-text').textContent === 'One'", "Escape takes it back").await?;
    aiko.until("document.activeElement.matches('[data-note]')", "the note has the keyboard again").await?;
    aiko.key("Space").await?;
    aiko.key("Control+d").await?;
    aiko.until("document.querySelectorAll('[data-note]').length === 2", "there are two").await?;
    let js = "(() => { const [one, other] = [...document.querySelectorAll('[data-note]')].map(note => note.getBoundingClientRect());
        return one.right <= other.left || other.right <= one.left || one.bottom <= other.top || other.bottom <= one.top; })()";
    assert_eq!(aiko.eval(js).await?, true, "one covers the other");
    aiko.eval("document.querySelector('[data-note][aria-pressed=true]').focus(), 0").await?;
    aiko.key("Delete").await?;
    aiko.until("document.querySelectorAll('[data-note]').length === 1", "one is left").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_finger_moves_a_note_and_leaving_it_saves() -> Outcome<()> {
    let stage = stage!("a note by finger");
    let program = stage.wire.make("Note finger", BALLS).await?;
    let aiko = stage.fingers("aiko", &program).await?;
    let ball = rests(&aiko, "Far ball, stream").await?;
    aiko.eval("document.querySelector('#stage').focus(), 0").await?;
    aiko.key("n").await?;
    aiko.until("document.activeElement.matches('textarea.note-field')", "the note is written").await?;
    aiko.type_text("Left").await?;
    aiko.tap("button", "Far ball, stream").await?;
    let note = rests(&aiko, NOTE).await?;
    let (x, y) = note.centre();
    aiko.touch_drag((x, y), (x + 40.0, y + 60.0), 6).await?;
    let moved = rests(&aiko, NOTE).await?;
    assert!(
        (moved.y - note.y - 60.0).abs() < 16.0 && (moved.x - note.x - 40.0).abs() < 16.0,
        "{note:?} {moved:?} {ball:?}"
    );
    aiko.no_errors()
}
