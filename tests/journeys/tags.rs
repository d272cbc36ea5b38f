//! The library: a program is renamed and tagged without opening it, found by its tag, and its drawing saved as a picture.

use house::{Outcome, skip};

use crate::library::{make, open_library};
use crate::steps::*;
use crate::visitor::Visitor;

const NAMES: &str = "[...document.querySelectorAll('.program-open b')].map(b => b.textContent).join()";

#[tokio::test]
async fn a_program_is_renamed_and_tagged_in_the_library_and_found_by_its_tag() -> Outcome<()> {
    skip::unless!(ready("journey: tags"));
    let stage = Stage::set().await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    make(&mut visitor, "Follow", Some("Track far and close balls")).await?;
    make(&mut visitor, "Shine", Some("Distance to brightness")).await?;
    let (aiko, ben) = (stage.person("aiko").await?, stage.person("ben").await?);
    open_library(&aiko).await?;
    open_library(&ben).await?;
    aiko.press("button", "More about Shine").await?;
    let dialog = aiko.within("dialog", "Load program");

    // In place, with Enter and Escape; the dialog stays.
    dialog.press("button", "Rename “Shine”").await?;
    aiko.type_text("x").await?;
    aiko.key("Escape").await?;
    dialog.press("button", "Rename “Shine”").await?;
    aiko.type_text("Shine for Yuki").await?;
    aiko.key("Enter").await?;
    dialog.find("button", "Rename “Shine for Yuki”").await?;
    ben.until(&format!("{NAMES}.includes('Shine for Yuki')"), "the other person sees the name").await?;

    dialog.fill("combobox", "Add a tag", "group b").await?;
    aiko.key("Enter").await?;
    dialog.find("button", "Take the tag “group b” away").await?;
    dialog.fill("combobox", "Add a tag", "Group B").await?;
    aiko.key("Enter").await?;
    says(&aiko, "There is already a “Group B”. Choose another name.").await?;
    dialog.fill("combobox", "Add a tag", "eyes").await?;
    dialog.press("button", "Add").await?;
    dialog.find("button", "Take the tag “eyes” away").await?;

    // The other one sees chips, and finds the program by them.
    ben.until("[...document.querySelectorAll('.tag')].map(x => x.textContent).join() === 'group b,eyes'", "chips")
        .await?;
    let theirs = ben.within("dialog", "Load program");
    theirs.fill("searchbox", "Search in names, streams and procedures", "eyes").await?;
    ben.until(&format!("{NAMES} === 'Shine for Yuki'"), "tags are searched").await?;
    theirs.fill("searchbox", "Search in names, streams and procedures", "f").await?;
    ben.eval(
        "(() => { const tag = document.querySelector('.tag-choice'); tag.value = 'group b';
            tag.dispatchEvent(new Event('change', { bubbles: true })); })()",
    )
    .await?;
    ben.until(&format!("{NAMES} === 'Shine for Yuki'"), "the tag and the word together").await?;
    dialog.press("button", "Take the tag “group b” away").await?;
    aiko.gone("button", "Take the tag “group b” away").await?;
    says(&ben, "Nothing fits “f”.").await?;

    // It is an edit of the program: where it is open, it is taken back.
    dialog.press("button", "Open").await?;
    aiko.gone("dialog", "Load program").await?;
    aiko.find("button", "Shine for Yuki").await?;
    aiko.key("Control+z").await?;
    ben.until(&format!("{NAMES} === 'Shine for Yuki'"), "the tag is back").await?;
    calm(&aiko)?;
    calm(&ben)
}

#[tokio::test]
async fn the_drawing_is_saved_as_a_picture_of_twice_its_size() -> Outcome<()> {
    skip::unless!(ready("journey: picture"));
    let stage = Stage::set().await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    make(&mut visitor, "Drawing", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko").await?;
    aiko.press("button", "Drawing*").await?;
    aiko.find("button", "Head tracker, *").await?;
    aiko.press("button", "Load program").await?;
    aiko.press("menuitem", "Save as file …").await?;
    aiko.eval(
        "URL.createObjectURL = blob => { globalThis.made = blob; return '#'; };
        HTMLAnchorElement.prototype.click = function () { globalThis.saved = this.download; }; 0",
    )
    .await?;
    aiko.within("dialog", "Save as file").press("button", "Picture (PNG)*").await?;
    says(&aiko, "The picture is in your downloads.").await?;
    assert_eq!(aiko.eval("[saved, made.type].join()").await?, "Drawing.png,image/png");
    let right = aiko
        .eval(
            "(async () => {
                const svg = await (await fetch(document.querySelector('[role=dialog] a[href*=\".svg\"]').href)).text();
                const [width, height] = ['width', 'height'].map(of => Number(svg.match(new RegExp(` ${of}=\"(\\\\d+)\"`))[1]));
                const picture = await createImageBitmap(made);
                const pen = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
                pen.drawImage(picture, 0, 0);
                const colours = new Set(new Uint32Array(pen.getImageData(0, 0, picture.width, picture.height).data.buffer));
                return picture.width === 2 * width && picture.height === 2 * height && colours.size > 5;
            })()",
        )
        .await?;
    assert_eq!(right, true);
    aiko.eval("HTMLCanvasElement.prototype.toBlob = function (then) { then(null); }; 0").await?;
    aiko.within("dialog", "Save as file").press("button", "Picture (PNG)*").await?;
    says(&aiko, "This browser could not make the picture.").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_program_is_copied_saved_and_removed_from_its_details_and_escape_goes_back_step_by_step() -> Outcome<()> {
    skip::unless!(ready("journey: details of a program"));
    let stage = Stage::set().await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    make(&mut visitor, "Follow", Some("Track far and close balls")).await?;
    make(&mut visitor, "Shine", Some("Distance to brightness")).await?;
    let aiko = stage.person("aiko").await?;
    open_library(&aiko).await?;
    let dialog = aiko.within("dialog", "Load program");
    dialog.fill("searchbox", "Search in names, streams and procedures", "shine").await?;
    says(&aiko, "1 found").await?;
    dialog.press("button", "More about Shine").await?;
    let file = dialog.find("link", "Save as file*").await?;
    assert!(!file.disabled);
    escape(&aiko).await?;
    aiko.gone("button", "Back to the list").await?;
    aiko.find("dialog", "Load program").await?;
    aiko.eval("document.querySelector('#program-search').focus(), 0").await?;
    escape(&aiko).await?;
    aiko.until("document.querySelector('#program-search').value === ''", "what is looked for goes next").await?;
    aiko.find("dialog", "Load program").await?;
    escape(&aiko).await?;
    aiko.gone("dialog", "Load program").await?;

    open_library(&aiko).await?;
    dialog.press("button", "More about Shine").await?;
    dialog.press("button", "Make a copy").await?;
    aiko.gone("dialog", "Load program").await?;
    aiko.find("button", "Copy of Shine").await?;
    open_library(&aiko).await?;
    dialog.press("button", "More about Follow").await?;
    dialog.press("button", "Remove").await?;
    aiko.until(&format!("!{NAMES}.split(',').includes('Follow')"), "it is gone from the list").await?;
    calm(&aiko)
}

/// Escape, which something open uses: only one that nothing used is the first of the two of Stop.
async fn escape(page: &house::Page) -> Outcome<()> {
    page.key("Escape").await?;
    page.settled().await
}
