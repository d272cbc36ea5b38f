//! How notes and groups look: open, folded, chosen, while a note is written; on the canvas and in the outline of a phone.

use crate::look::colours;
use crate::screens::{Stage, nothing, run_template};
use crate::words::Words;
use house::{Outcome, skip};

#[tokio::test]
async fn axe_finds_nothing_on_notes_and_groups() -> Outcome<()> {
    skip::unless!(ready("axe on notes and groups"));
    let stage = Stage::set().await?;
    let page = &stage.page;
    run_template(page, &Words::english()).await?;
    let mut found = Vec::new();
    page.eval("document.querySelector('#stage').focus(), 0").await?;
    page.key("n").await?;
    page.until("document.activeElement.matches('textarea.note-field')", "the note is written").await?;
    page.type_text("Ask Yuki whether the children liked it.").await?;
    found.extend(colours(page, "note-written").await?);
    page.key("Control+Enter").await?;
    page.until("document.activeElement.matches('[data-note]')", "the note is saved").await?;
    page.key("Space").await?;
    page.find("toolbar", "Note").await?;
    found.extend(colours(page, "note").await?);
    page.eval("document.querySelector('[data-node][aria-label^=Far]').focus(), 0").await?;
    page.key("Space").await?;
    page.key("Control+g").await?;
    page.find("toolbar", "Group").await?;
    found.extend(colours(page, "group").await?);
    page.press("button", "Fold Group").await?;
    page.find("button", "Unfold Group").await?;
    found.extend(colours(page, "group-folded").await?);
    page.size(390, 844, true).await?;
    page.until("document.querySelector('.group-row') !== null", "the outline has the group").await?;
    found.extend(colours(page, "outline").await?);
    nothing("findings about notes and groups", &found)?;
    page.no_errors()
}
