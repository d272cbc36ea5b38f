//! A therapist chooses the tiles of the operator's page, with keys alone and with a finger alone; an operator presses one. Two
//! people choose at once.

use house::{GAME, Outcome, Page, Switch, Within, skip};

use crate::by_keyboard::Hands;
use crate::by_touch::Fingers;
use crate::operate::{operates, operates_tiles, shows, starts};
use crate::steps::*;
use crate::visitor::Visitor;

/// The dialog's name.
const DIALOG: &str = "Tiles of the operator’s page";
/// The words of the tiles in the dialog, with their keys.
const CHOSEN: &str = "[...document.querySelectorAll('button.tile:not(.empty)')].map(tile => tile.querySelector('kbd').innerText + ' ' + tile.querySelector('b').innerText).join('|')";
/// The words of the tiles on the operator's page, with their keys.
const SHOWN: &str = "[...document.querySelectorAll('.op-tile')].map(tile => tile.querySelector('.op-key').innerText + ' ' + tile.querySelector('b').innerText).join('|')";

/// Waits until the tiles are these.
async fn are(page: &Page, which: &str, tiles: &str) -> Outcome<()> {
    page.until(&format!("({which}).startsWith('{tiles}')"), &format!("the tiles are {tiles}")).await.map(drop)
}

fn in_dialog(page: &Page) -> Within<'_> {
    page.within("dialog", DIALOG)
}

/// Opens the dialog, out of the list of commands.
async fn opens_tiles(page: &Page) -> Outcome<()> {
    page.key("Control+k").await?;
    page.find("dialog", "Keys and gestures").await?;
    page.type_text("tiles of").await?;
    page.key("Enter").await?;
    page.find("dialog", DIALOG).await.map(drop)
}

#[tokio::test]
async fn tiles_are_chosen_with_keys_alone_and_pressed_by_an_operator() -> Outcome<()> {
    skip::unless!(ready("journey: tiles by keyboard"));
    let stage = Stage::set().await?;
    let aiko = &stage.nobody("aiko").await?;
    let ben = &stage.nobody("ben").await?;
    operates(&stage, ben).await?;
    aiko.goto(&format!("{}operate", stage.server.url())).await?;
    usable(aiko).await?;
    aiko.press("button", GAME).await?;
    says(aiko, "Ready to start").await?;
    // From here on nothing but keys.
    let hands = Hands::of(aiko);
    hands.goes_to("Tab", "Change the tiles …").await?;
    hands.press("Enter").await?;
    hands.in_dialog(DIALOG).await?;
    are(aiko, CHOSEN, "1 Go on|2 “Well done!”|3 “That tickles!”|4 Waving").await?;
    says(aiko, "Nobody chose tiles yet").await?;

    // Another text, whose words the tile follows.
    hands.goes_to("Tab", "“Well done!”").await?;
    hands.press("Enter").await?;
    hands.comes_to("Text").await?;
    hands.press("Control+a").await?;
    hands.types("Good job").await?;
    hands.press("Enter").await?;
    hands.comes_to("“Good job”").await?;
    are(aiko, CHOSEN, "1 Go on|2 “Good job”|3 “That tickles!”").await?;
    are(ben, SHOWN, "1 Go on|2 “Good job”|3 “That tickles!”").await?;

    // One place earlier, and asking first.
    hands.press("Enter").await?;
    hands.comes_to("Text").await?;
    hands.goes_to("Tab", "Ask first").await?;
    hands.press("Space").await?;
    hands.press("Control+Enter").await?;
    hands.comes_to("“Good job”").await?;
    hands.press("Enter").await?;
    hands.comes_to("Text").await?;
    hands.goes_to("Shift+Tab", "Earlier").await?;
    hands.press("Enter").await?;
    says(aiko, "Key 1 of 9").await?;
    // Escape goes back to all of them, and once more closes.
    hands.press("Escape").await?;
    hands.comes_to("“Good job”").await?;
    are(aiko, CHOSEN, "1 “Good job”|2 Go on|3 “That tickles!”").await?;

    // A word that marks, in place of the third.
    hands.goes_to("Tab", "“That tickles!”").await?;
    hands.press("Enter").await?;
    hands.comes_to("Text").await?;
    hands.goes_to("Shift+Tab", "has the robot do something").await?;
    hands.key("ArrowDown").await?;
    hands.key("ArrowDown").await?;
    hands.goes_to("Tab", "Word of the mark").await?;
    hands.types("laughs").await?;
    hands.press("Enter").await?;
    are(aiko, CHOSEN, "1 “Good job”|2 Go on|3 laughs|4 Waving").await?;
    hands.comes_to("laughs").await?;
    hands.press("Escape").await?;
    aiko.gone("dialog", DIALOG).await?;
    saved(aiko).await?;
    calm(aiko)?;

    // An operator presses: once it asks, twice it is done, by the robot and in the recording.
    are(ben, SHOWN, "1 “Good job”|2 Go on|3 laughs|4 Waving").await?;
    says(ben, "asks first").await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    starts(ben, "P-07").await?;
    ben.key("1").await?;
    ben.until(&format!("{} === 'asks'", shows("“Good job”")), "it asks").await?;
    // It rests for a moment after a press.
    let press = format!("{} === 'going' || (document.querySelector('.op-tile').click(), false)", shows("“Good job”"));
    ben.until(&press, "it is done").await?;
    visitor.scene("the robot says it", |scene| scene.body.saying == "Good job").await?;
    ben.key("3").await?;
    says(ben, "Add a note …").await?;
    stop(ben).await?;
    says(ben, "Ready to start").await?;
    let list = ben.on("link", "Recordings", "function () { return this.href; }").await?;
    ben.goto(list.as_str().unwrap_or_default()).await?;
    ben.press("link", "P-07 *").await?;
    ben.find("link", ".jsonl").await?;
    let read = "fetch(document.querySelector('.downloads a').href).then(answer => answer.text())\
        .then(text => text.trim().split('\\n').map(JSON.parse).filter(line => line.hand).map(line => line.hand + ': ' + line.params.text).join())";
    assert_eq!(ben.eval(read).await?, "SayParameter: Good job");
    ben.no_errors()
}

#[tokio::test]
async fn tiles_are_chosen_with_a_finger_alone_and_taken_back() -> Outcome<()> {
    skip::unless!(ready("journey: tiles by touch"));
    let stage = Stage::set().await?;
    let page = &stage.nobody("aiko").await?;
    page.size(390, 844, true).await?;
    operates_tiles(&stage, page).await?;
    are(page, SHOWN, "1 Hello|4 Wave|7 laughs|9 looks away").await?;
    let fingers = Fingers { page, on_phone: true };
    fingers.tap("link", "Change the tiles …").await?;
    page.find("dialog", DIALOG).await?;
    let dialog = page.within("dialog", DIALOG);
    are(page, CHOSEN, "1 Hello|4 Wave|7 laughs|9 looks away").await?;

    // A sense that is pretended, at the first empty place.
    fingers.tap_in(dialog, "button", "Add a tile Key 2").await?;
    page.tap("radio", "pretends a sense").await?;
    page.find("combobox", "Sense").await?;
    fingers.tap_in(dialog, "button", "Save").await?;
    page.until(&format!("({CHOSEN}).startsWith('1 Hello|2 As if: ')"), "it is there").await?;
    // One is moved, another one taken away.
    fingers.tap_in(dialog, "button", "Hello*").await?;
    fingers.tap_in(dialog, "button", "Later").await?;
    says(page, "Key 2 of 9").await?;
    fingers.tap_in(dialog, "button", "Later").await?;
    says(page, "Key 3 of 9").await?;
    fingers.tap_in(dialog, "button", "All tiles").await?;
    fingers.tap_in(dialog, "button", "laughs*").await?;
    fingers.tap_in(dialog, "button", "Take away").await?;
    page.until(&format!("/^1 As if: [^|]*.3 Hello.4 Wave.9 looks away$/.test({CHOSEN})"), "they stand there").await?;
    // Nothing can be saved without words; what was written stays.
    fingers.tap_in(dialog, "button", "Wave*").await?;
    in_dialog(page).fill("textbox", "Words on the tile", "").await?;
    fingers.tap_in(dialog, "button", "Save").await?;
    says(page, "Write the words that the tile shows.").await?;
    in_dialog(page).fill("textbox", "Words on the tile", "Big wave").await?;
    fingers.tap_in(dialog, "button", "Save").await?;
    page.until(&format!("({CHOSEN}).includes('4 Big wave')"), "it is called so").await?;

    // Back to the usual ones, and undone like every change.
    fingers.tap_in(dialog, "button", "Back to the usual ones").await?;
    are(page, CHOSEN, "1 Go on|2 “Well done!”").await?;
    let close = "(() => { const at = document.querySelector('.dialog-feet .button:last-child').getBoundingClientRect(); \
        return [at.x + at.width / 2, at.y + at.height / 2]; })()";
    let close: (f64, f64) = serde_json::from_value(page.eval(close).await?)?;
    page.touch_down(close).await?;
    page.touch_up().await?;
    page.gone("dialog", DIALOG).await?;
    saved(page).await?;
    page.key("Control+z").await?;
    page.goto(&format!("{}operate", stage.server.url())).await?;
    usable(page).await?;
    page.until(&format!("({SHOWN}).includes('4 Big wave')"), "they are back").await?;
    calm(page)
}

#[tokio::test]
async fn two_people_who_choose_tiles_at_once_lose_nothing() -> Outcome<()> {
    skip::unless!(ready("journey: two people at the tiles"));
    let stage = Stage::set().await?;
    let aiko = &stage.nobody("aiko").await?;
    operates_tiles(&stage, aiko).await?;
    aiko.press("link", "Change the tiles …").await?;
    aiko.find("dialog", DIALOG).await?;
    let yuki = &stage.beside(aiko, "yuki").await?;
    opens_tiles(yuki).await?;
    are(yuki, CHOSEN, "1 Hello|4 Wave").await?;

    // Each writes into another tile; both stand, and neither loses a letter.
    in_dialog(aiko).press("button", "Hello*").await?;
    in_dialog(yuki).press("button", "Wave*").await?;
    in_dialog(aiko).fill("textbox", "Words on the tile", "Hello there").await?;
    in_dialog(yuki).fill("textbox", "Words on the tile", "Big wa").await?;
    in_dialog(aiko).press("button", "Save").await?;
    are(aiko, CHOSEN, "1 Hello there|4 Wave").await?;
    yuki.type_text("ve").await?;
    assert_eq!(in_dialog(yuki).text("textbox", "Words on the tile").await?, "Big wave");
    in_dialog(yuki).press("button", "Save").await?;
    for page in [aiko, yuki] {
        are(page, CHOSEN, "1 Hello there|4 Big wave|7 laughs").await?;
    }

    // On one tile, what is being written stays, and its author decides.
    in_dialog(aiko).press("button", "Hello there*").await?;
    in_dialog(yuki).press("button", "Hello there*").await?;
    in_dialog(yuki).fill("textbox", "Words on the tile", "Good morning").await?;
    in_dialog(aiko).fill("textbox", "Words on the tile", "Welcome").await?;
    in_dialog(aiko).press("button", "Save").await?;
    says(yuki, "Somebody changed this tile meanwhile. Now it is “Welcome”.").await?;
    assert_eq!(in_dialog(yuki).text("textbox", "Words on the tile").await?, "Good morning");
    in_dialog(yuki).press("button", "Save").await?;
    says(yuki, "Choose one of both first.").await?;
    in_dialog(yuki).press("button", "Keep mine").await?;
    in_dialog(yuki).press("button", "Save").await?;
    for page in [aiko, yuki] {
        are(page, CHOSEN, "1 Good morning|4 Big wave|7 laughs").await?;
    }

    // A tile that somebody moves takes the open form along.
    in_dialog(yuki).press("button", "Good morning*").await?;
    in_dialog(aiko).press("button", "Good morning*").await?;
    in_dialog(yuki).fill("textbox", "Words on the tile", "Good evening").await?;
    in_dialog(aiko).press("button", "Later").await?;
    says(yuki, "Key 2 of 9").await?;
    in_dialog(yuki).press("button", "Save").await?;
    are(yuki, CHOSEN, "2 Good evening|4 Big wave|7 laughs").await?;
    aiko.goto(&format!("{}operate", stage.server.url())).await?;
    usable(aiko).await?;
    are(aiko, SHOWN, "2 Good evening|4 Big wave|7 laughs").await?;
    calm(yuki)
}

#[tokio::test]
async fn words_that_are_not_saved_stay_while_their_tile_is_moved_and_somebody_changes_it() -> Outcome<()> {
    skip::unless!(ready("journey: a tile that is moved too late"));
    let stage = Stage::set().await?;
    let aiko = &stage.nobody("aiko").await?;
    operates_tiles(&stage, aiko).await?;
    aiko.press("link", "Change the tiles …").await?;
    aiko.find("dialog", DIALOG).await?;
    let yuki = &stage.nobody("yuki").await?;
    let socket = Switch::install(yuki).await?;
    yuki.goto(&aiko.address().await?).await?;
    usable(yuki).await?;
    opens_tiles(yuki).await?;
    are(yuki, CHOSEN, "1 Hello|4 Wave").await?;
    in_dialog(yuki).press("button", "Hello*").await?;
    in_dialog(yuki).fill("textbox", "Words on the tile", "Good evening").await?;

    // Yuki moves it on a broken link, while Aiko changes it.
    socket.cut().await?;
    says(yuki, "Offline").await?;
    in_dialog(yuki).press("button", "Later").await?;
    says(yuki, "Key 2 of 9").await?;
    in_dialog(aiko).press("button", "Hello*").await?;
    in_dialog(aiko).fill("textbox", "Words on the tile", "Welcome").await?;
    in_dialog(aiko).press("button", "Save").await?;
    are(aiko, CHOSEN, "1 Welcome|4 Wave").await?;
    socket.mend().await?;
    silent(yuki, "Offline").await?;

    // The words stay, it is said what there is now, and Yuki decides.
    says(yuki, "Somebody changed this tile meanwhile. Now it is “Welcome”.").await?;
    says(yuki, "Key 1 of 9").await?;
    assert_eq!(in_dialog(yuki).text("textbox", "Words on the tile").await?, "Good evening");
    in_dialog(yuki).press("button", "Keep mine").await?;
    in_dialog(yuki).press("button", "Save").await?;
    for page in [aiko, yuki] {
        are(page, CHOSEN, "1 Good evening|4 Wave").await?;
    }
    calm(aiko)
}
