//! Sentences over the graph: read, pointed at, changed in place, and typed where things are found.

use house::{Outcome, Page};

use crate::hints::{ball, connector, device, file, with_open};
use crate::steps::{picture, rests, stage};

const BALLS: Option<&str> = Some("Track far and close balls");

async fn reads(page: &Page, at: usize, sentence: &str) -> Outcome<()> {
    let js = format!(
        "[...(document.querySelectorAll('.told .sentence')[{at}]?.querySelectorAll('.words, .inline:not(.choice), .inline.choice > span') ?? [])]
            .map(one => one.textContent).join('').replace(/\\s+/g, ' ').trim() === {}",
        serde_json::json!(sentence)
    );
    page.until(&js, &format!("sentence {at} reads: {sentence}")).await.map(drop)
}

#[tokio::test]
async fn a_sentence_says_what_happens_and_its_number_is_changed_in_it() -> Outcome<()> {
    let stage = stage!("sentences");
    let program = stage.wire.make("Told", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    reads(&aiko, 0, "When the red ball is at least 0.5 m away, the head follows it.").await?;
    reads(&aiko, 1, "Otherwise the whole body follows it.").await?;
    let before = rests(&aiko, "Distance, stream").await?;
    aiko.press("button", "Change: 0.5 m").await?;
    aiko.until("document.activeElement.closest('.inline.open')", "the number is a field").await?;
    aiko.type_text("0.7").await?;
    picture(&aiko, "told-field").await?;
    aiko.key("Enter").await?;
    reads(&aiko, 0, "When the red ball is at least 0.7 m away, the head follows it.").await?;
    aiko.until("document.activeElement.classList.contains('inline')", "the keyboard is on the number").await?;
    aiko.key("ArrowUp").await?;
    aiko.until("document.activeElement.value === '0.75'", "an arrow goes one step on").await?;
    aiko.key("Escape").await?;
    aiko.until("document.activeElement.classList.contains('inline')", "and is taken back").await?;
    aiko.key("Control+z").await?;
    reads(&aiko, 0, "When the red ball is at least 0.5 m away, the head follows it.").await?;
    let after = rests(&aiko, "Distance, stream").await?;
    assert_eq!((before.x, before.y), (after.x, after.y), "the graph does not move");
    aiko.no_errors()
}

#[tokio::test]
async fn a_choice_is_changed_where_the_sentence_says_it() -> Outcome<()> {
    let stage = stage!("a choice in a sentence");
    let program = stage.wire.make("Chosen in words", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    reads(&aiko, 0, "When the red ball is at least 0.5 m away, the head follows it.").await?;
    let choose =
        "function () { this.value = 'WholeBody'; this.dispatchEvent(new Event('change', { bubbles: true })); }";
    aiko.within("region", "What it does").find("combobox", "Change: head").await?;
    aiko.on("combobox", "Change: head", choose).await?;
    reads(&aiko, 0, "When the red ball is at least 0.5 m away, the whole body follows it.").await?;
    aiko.key("Control+z").await?;
    reads(&aiko, 0, "When the red ball is at least 0.5 m away, the head follows it.").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn of_many_sentences_those_of_what_is_selected_are_read() -> Outcome<()> {
    let stage = stage!("many sentences");
    let eyes = |id: &str, name: &str| device(id, "actuator", name, "EyeLedColor");
    let streams = [ball(), eyes("a", "First"), eyes("b", "Second"), eyes("c", "Third"), eyes("d", "Fourth")];
    let connectors = ["a", "b", "c", "d"].map(|to| connector(&format!("to-{to}"), "subscribe", "ball", to));
    let aiko = with_open(&stage, &file("Many", &streams, &connectors)).await?;
    let says =
        |words: &str| format!("document.querySelector('.told').innerText.includes({})", serde_json::json!(words));
    let shown = |count: usize| format!("document.querySelectorAll('.told .sentence').length === {count}");
    aiko.until(&says("4 sentences. Select a part of the graph to read its own."), "they are counted").await?;
    aiko.until(&shown(0), "none is in the way").await?;
    aiko.press("button", "Third, *").await?;
    aiko.until(&says("Third is in 1 of 4 sentences."), "what is selected has its own").await?;
    aiko.until(&shown(1), "which is read").await?;
    aiko.press("button", "Show all").await?;
    aiko.until(&shown(4), "all are read").await?;
    aiko.press("button", "Show fewer").await?;
    aiko.until(&shown(1), "and fewer again").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn the_sentence_that_happens_says_now() -> Outcome<()> {
    let stage = stage!("the sentence that happens");
    let program = stage.wire.make("Happens", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    reads(&aiko, 1, "Otherwise the whole body follows it.").await?;
    aiko.press("button", "Start").await?;
    let now = "[...document.querySelectorAll('.told .sentence')].map(one => one.querySelector('.now')?.innerText ?? '-').join()";
    aiko.until(&format!("{now} === 'now,-'"), "the far ball is followed with the head").await?;
    aiko.press("button", "Stop").await?;
    aiko.until(&format!("{now} === '-,-'"), "after Stop nothing happens").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_phrase_lights_its_part_and_leads_there() -> Outcome<()> {
    let stage = stage!("phrases");
    let program = stage.wire.make("Lit", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    reads(&aiko, 1, "Otherwise the whole body follows it.").await?;
    aiko.hover("button", "Otherwise*").await?;
    aiko.until("document.querySelector('.lit-region .way')?.getAttribute('d')?.length > 10", "its part is lit").await?;
    picture(&aiko, "told-lit").await?;
    aiko.press("button", "Otherwise*").await?;
    aiko.until("!!document.querySelector('.chip.selected')", "its connector is selected").await?;
    aiko.until("!!document.querySelector('.phrase.selected')", "and its phrase shows that").await?;
    aiko.move_to((700.0, 860.0)).await?;
    aiko.key("Escape").await?;
    aiko.until("!document.querySelector('.lit-region')", "nothing is lit any more").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_typed_sentence_is_shown_and_added_as_one() -> Outcome<()> {
    let stage = stage!("typed sentences");
    let program = stage.wire.make("Typed", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Distance, stream").await?;
    aiko.key("Control+f").await?;
    aiko.until("document.activeElement.id === 'find'", "the field that finds has the keyboard").await?;
    aiko.type_text("When the head is toched, the eyes turn green.").await?;
    aiko.find("button", "touched").await?;
    aiko.until("document.querySelector('.mirror mark')?.textContent.includes('toched')", "what is not known is marked")
        .await?;
    aiko.key("Enter").await?;
    aiko.until(
        "document.querySelector('#find').value === 'When the head is touched, the eyes turn green.'",
        "the best is taken",
    )
    .await?;
    aiko.until("!document.querySelector('.typed .doubt')", "nothing is in doubt").await?;
    aiko.until("document.querySelectorAll('.stream.ghost').length === 3", "a preview stands beside the graph").await?;
    aiko.until(
        "document.querySelector('.understood').textContent === 'When the head is touched, the eyes turn green.'",
        "what was understood is told",
    )
    .await?;
    picture(&aiko, "typed").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "Green eyes,*").await?;
    aiko.until(
        "document.querySelectorAll('[data-node]').length === 9 && !document.querySelector('.ghost')",
        "it is in the graph",
    )
    .await?;
    aiko.key("Escape").await?;
    aiko.press("button", "Undo").await?;
    aiko.until("document.querySelectorAll('[data-node]').length === 6", "one undo takes all of it back").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn what_is_said_in_other_words_is_understood_or_said_to_be_impossible() -> Outcome<()> {
    let stage = stage!("spoken sentences");
    let program = stage.wire.make("Spoken", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Distance, stream").await?;
    aiko.key("Control+f").await?;
    aiko.type_text("say 'well done' whenever somebody pats your head").await?;
    aiko.until(
        "document.querySelector('.understood')?.textContent === 'When the head is touched, the robot says “well done”.'",
        "it is understood and told",
    )
    .await?;
    aiko.key("Escape").await?;
    aiko.key("Control+f").await?;
    aiko.type_text("When the child cries, wave.").await?;
    aiko.until(
        "document.querySelector('.typed .doubt')?.textContent.startsWith('The robot cannot notice crying.')",
        "what no sense tells is said",
    )
    .await?;
    aiko.key("Enter").await?;
    aiko.until("document.querySelector('#find').value === 'When the child cries, wave.'", "nothing is guessed").await?;
    aiko.no_errors()
}

/// Returns a script that is true if the field that finds has `text`.
fn typed_is(text: &str) -> String {
    format!("document.querySelector('#find').value === {}", serde_json::json!(text))
}

/// Returns a script that is true if `text` is what was understood of what is typed.
fn understood_is(text: &str) -> String {
    format!("document.querySelector('.understood')?.textContent === {}", serde_json::json!(text))
}

#[tokio::test]
async fn lines_that_are_pasted_are_sentences_and_a_vague_word_shows_its_number() -> Outcome<()> {
    let stage = stage!("pasted lines");
    let program = stage.wire.make("Pasted", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Distance, stream").await?;
    aiko.key("Control+f").await?;
    aiko.until("document.activeElement.id === 'find'", "the field that finds has the keyboard").await?;
    aiko.eval(
        "(() => { const data = new DataTransfer();
        data.setData('text/plain', 'When the head is touched, wave\\nWhen I approach, say hello\\n');
        document.activeElement.dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }));
        return 0; })()",
    )
    .await?;
    aiko.until(&typed_is("When the head is touched, wave. When I approach, say hello."), "each line is a sentence")
        .await?;
    let told = "When the head is touched, the robot waves. When the nearest person is nearer than 1 m, the robot says “hello”.";
    aiko.until(&understood_is(told), "both are understood").await?;
    aiko.until("document.querySelector('.vague input')?.value === '1'", "the number of a vague word is shown").await?;
    picture(&aiko, "typed-vague").await?;
    aiko.fill("spinbutton", "approach", "0.8").await?;
    aiko.key("Tab").await?;
    let text = "When the head is touched, wave. When I come closer than 0.8 m, say hello.";
    aiko.until(&typed_is(text), "and the text says it").await?;
    aiko.until(&understood_is(&told.replace("1 m", "0.8 m")), "it is understood").await?;
    aiko.press("button", "Add to the graph").await?;
    aiko.until("document.querySelectorAll('[data-node]').length > 8", "all of it is in the graph").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_sentence_is_added_with_fingers() -> Outcome<()> {
    let stage = stage!("a sentence by finger");
    let program = stage.wire.make("Fingers", BALLS).await?;
    let aiko = stage.fingers("aiko", &program).await?;
    rests(&aiko, "Ball, sensor stream").await?;
    aiko.key("Control+f").await?;
    let dialog = aiko.within("dialog", "Find or add*");
    dialog.fill("searchbox", "Or say what it does", "Please wave at everyone you know!").await?;
    aiko.until(&understood_is("When a known face is seen, the robot waves."), "it is understood").await?;
    dialog.tap("button", "Add to the graph").await?;
    aiko.gone("dialog", "Find or add*").await?;
    aiko.until("document.querySelectorAll('[data-node]').length === 9", "it is in the graph").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_japanese_sentence_is_read_too() -> Outcome<()> {
    let stage = stage!("Japanese sentences");
    let program = stage.wire.make("Japanese", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    reads(&aiko, 1, "Otherwise the whole body follows it.").await?;
    aiko.press("button", "日本語").await?;
    reads(&aiko, 0, "赤いボールが 0.5 m 以上離れているとき、頭で追いかけます。").await?;
    aiko.key("Control+f").await?;
    aiko.type_text("頭に手が触れたとき、目が緑に光ります。").await?;
    aiko.until(
        "document.querySelectorAll('.stream.ghost').length >= 2 && !document.querySelector('.typed .doubt')",
        "it is understood",
    )
    .await?;
    aiko.key("Escape").await?;
    aiko.until(
        "!document.querySelector('.typed, .ghost') && document.querySelector('#find').value === ''",
        "Escape takes it away",
    )
    .await?;
    aiko.no_errors()
}

#[tokio::test]
async fn the_right_button_and_a_long_press_open_the_menu_of_what_is_there() -> Outcome<()> {
    let stage = stage!("menus");
    let program = stage.wire.make("Menus", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Far ball, stream").await?;
    aiko.press_right("button", "Far ball, stream").await?;
    aiko.find("menu", "What can be done with Far ball").await?;
    picture(&aiko, "menu").await?;
    aiko.press("menuitem", "Duplicate").await?;
    aiko.find("button", "Far ball 2, stream").await?;
    let ben = stage.fingers("ben", &program).await?;
    let at = rests(&ben, "Close ball, stream").await?.centre();
    ben.touch_down(at).await?;
    ben.find("menu", "What can be done with Close ball").await?;
    ben.touch_up().await?;
    ben.until(
        "new Promise(done => setTimeout(() => done(!!document.querySelector('.context')), 300))",
        "the finger that is lifted presses nothing in the menu",
    )
    .await?;
    ben.tap("menuitem", "Rename").await?;
    ben.until("document.activeElement.className === 'rename'", "its name can be typed").await?;
    ben.no_errors()?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_number_that_somebody_types_is_theirs_until_they_leave_it() -> Outcome<()> {
    let stage = stage!("two at one number");
    let program = stage.wire.make("Two", BALLS).await?;
    let (aiko, ben) = (stage.person("aiko", &program).await?, stage.person("ben", &program).await?);
    reads(&ben, 0, "When the red ball is at least 0.5 m away, the head follows it.").await?;
    reads(&aiko, 0, "When the red ball is at least 0.5 m away, the head follows it.").await?;
    aiko.press("button", "Change: 0.5 m").await?;
    aiko.until("document.activeElement.closest('.inline.open')", "the number is a field").await?;
    aiko.type_text("0.9").await?;
    let at = ben.boxed("button", "0.5 m, *").await?.centre();
    ben.press_at(at).await?;
    ben.until("!document.querySelector('.inline.open')", "Ben cannot type there").await?;
    aiko.key("Enter").await?;
    reads(&ben, 0, "When the red ball is at least 0.9 m away, the head follows it.").await?;
    ben.press("button", "Change: 0.9 m").await?;
    ben.until("document.activeElement.closest('.inline.open')", "now it is free for Ben").await?;
    aiko.no_errors()?;
    ben.no_errors()
}
