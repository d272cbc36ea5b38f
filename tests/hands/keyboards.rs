//! Other keyboards and other ways to write: layouts without Latin letters, the Enter that only ends a word of Japanese in
//! Safari, and a keyboard that is on the canvas after what had it was removed.

use house::{Outcome, Page};
use serde_json::json;

use crate::hints::{ball, connector, file, with_open};
use crate::steps::{rests, stage};

/// A red ball and what passes a test.
fn program() -> serde_json::Value {
    let mut test = connector("test", "filter", "ball", "mid");
    test["body"] = "redBall.x < 0.5".into();
    let stream = |id: &str, name: &str| json!({ "id": id, "kind": "ordinary", "name": name });
    file("Keyboards", &[ball(), stream("mid", "Mid"), stream("end", "End")], &[test])
}

/// Presses a key as a keyboard of another layout reports it.
async fn press(page: &Page, key: &str, code: &str, control: bool) -> Outcome<()> {
    let how = json!({ "key": key, "code": code, "ctrlKey": control, "bubbles": true, "cancelable": true });
    page.eval(&format!("document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {how})), 0")).await.map(drop)
}

/// The Enter or Escape that ends a word, as Safari reports it: after the end of writing it.
async fn end_word(page: &Page, key: &str) -> Outcome<()> {
    let how = json!({ "key": key, "keyCode": 229, "bubbles": true, "cancelable": true });
    let js = format!(
        "(() => {{ const at = document.activeElement;
        at.dispatchEvent(new CompositionEvent('compositionend', {{ bubbles: true, data: '近い' }}));
        at.dispatchEvent(new KeyboardEvent('keydown', {how})); return 0; }})()"
    );
    page.eval(&js).await.map(drop)
}

async fn are(page: &Page, count: u64) -> Outcome<()> {
    let js = format!("document.querySelectorAll('[data-node]').length === {count}");
    page.until(&js, &format!("there are {count} streams")).await.map(drop)
}

const ON_CANVAS: &str = "!!document.activeElement.closest('#stage')";

#[tokio::test]
async fn keys_of_the_program_work_on_every_layout() -> Outcome<()> {
    let stage = stage!("keys of other layouts");
    let aiko = with_open(&stage, &program()).await?;
    rests(&aiko, "Mid, stream").await?;
    // Russian, Greek, Arabic and Hebrew: D doubles, Z takes back.
    for (double, undo) in [("в", "я"), ("δ", "ζ"), ("ي", "ئ"), ("ג", "ז")] {
        aiko.press("button", "Mid, stream").await?;
        press(&aiko, double, "KeyD", true).await?;
        are(&aiko, 4).await?;
        press(&aiko, undo, "KeyZ", true).await?;
        are(&aiko, 3).await?;
    }
    press(&aiko, "ф", "KeyA", true).await?;
    aiko.until("document.querySelectorAll('.stream.selected').length === 3", "all are chosen").await?;
    press(&aiko, "т", "KeyN", false).await?;
    aiko.until("document.activeElement.matches('.note-field')", "a note begins").await?;
    aiko.key("Escape").await?;
    // On a French keyboard what is written on a key counts, and digits need no Shift.
    aiko.press("button", "Mid, stream").await?;
    press(&aiko, "à", "Digit0", false).await?;
    press(&aiko, "z", "KeyW", true).await?;
    aiko.no_errors()
}

#[tokio::test]
async fn an_enter_that_ends_a_word_saves_nothing() -> Outcome<()> {
    let stage = stage!("japanese in Safari");
    let aiko = with_open(&stage, &program()).await?;
    rests(&aiko, "Mid, stream").await?;
    aiko.press("button", "Mid, stream").await?;
    aiko.key("F2").await?;
    aiko.until("document.activeElement.className === 'rename'", "its name is typed").await?;
    aiko.type_text("近い").await?;
    end_word(&aiko, "Enter").await?;
    aiko.until("document.activeElement.value === '近い'", "the field stays open").await?;
    // Nor does the Escape that ends one take back, or count for Esc Esc.
    end_word(&aiko, "Escape").await?;
    end_word(&aiko, "Escape").await?;
    aiko.until("document.activeElement.value === '近い'", "the field stays open").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "近い, stream").await?;

    aiko.press("button", "filter (*").await?;
    aiko.press("button", "More…").await?;
    aiko.within("dialog", "Operation").fill("textbox", "Procedure", "redBall.x < 0.7").await?;
    end_word(&aiko, "Enter").await?;
    aiko.within("dialog", "Operation").press("button", "Save").await?;
    aiko.find("button", "filter (redBall.x < 0.7), *").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn an_enter_that_ends_a_word_adds_no_sentence() -> Outcome<()> {
    let stage = stage!("a Japanese sentence in Safari");
    let aiko = with_open(&stage, &program()).await?;
    rests(&aiko, "Mid, stream").await?;
    aiko.key("Control+f").await?;
    aiko.until("document.activeElement.id === 'find'", "the field that finds has the keyboard").await?;
    aiko.type_text("頭をなでられたら、子どもに手を振ってね").await?;
    let understood = "document.querySelector('.understood')?.textContent === '頭に触られたとき、手を振ります。'";
    aiko.until(understood, "it is understood").await?;
    end_word(&aiko, "Enter").await?;
    end_word(&aiko, "Enter").await?;
    aiko.until("document.querySelector('#find').value.endsWith('振ってね')", "it is still typed").await?;
    are(&aiko, 3).await?;
    aiko.key("Enter").await?;
    are(&aiko, 6).await?;
    aiko.no_errors()
}

#[tokio::test]
async fn what_is_cut_is_pasted_without_a_click_in_between() -> Outcome<()> {
    let stage = stage!("cut, then paste");
    let aiko = with_open(&stage, &program()).await?;
    rests(&aiko, "End, stream").await?;
    let keep =
        "globalThis.was = ''; document.execCommand = () => { was = document.activeElement.value; return true; }; 0";
    aiko.eval(keep).await?;
    aiko.press("button", "End, stream").await?;
    aiko.key("Control+x").await?;
    are(&aiko, 2).await?;
    aiko.until(ON_CANVAS, "the keyboard is on the canvas").await?;
    // A browser pastes where the keyboard is.
    let paste = "(() => { const data = new DataTransfer(); data.setData('text/plain', was);
        document.activeElement.dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }));
        return 0; })()";
    aiko.eval(paste).await?;
    are(&aiko, 3).await?;
    aiko.find("button", "End, stream").await?;

    aiko.press("button", "End, stream").await?;
    aiko.key("Control+a").await?;
    aiko.key("Delete").await?;
    are(&aiko, 0).await?;
    aiko.until(ON_CANVAS, "and after all are removed").await?;
    aiko.no_errors()
}
