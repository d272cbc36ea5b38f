//! Recording a run: chosen before Start, seen while it runs, there to download afterwards.

use house::{Outcome, skip};

use crate::steps::*;

#[tokio::test]
async fn a_run_is_recorded_if_somebody_wants_it() -> Outcome<()> {
    skip::unless!(ready("journey: recording"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Watcher").await?;
    add_sense(&aiko, "Red ball").await?;
    saved(&aiko).await?;
    aiko.press("checkbox", "Record the next run").await?;
    start(&aiko).await?;
    shows_value(&aiko, "Red ball").await?;
    aiko.fill("textbox", "What happens now?", "She smiles.").await?;
    aiko.press("button", "Mark").await?;
    says(&aiko, "Marked in the recording.").await?;
    aiko.press("button", "End the recording").await?;
    aiko.gone("button", "End the recording").await?;
    aiko.find("button", "Running").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&aiko)?;
    // One press leads to all of them, beside this page; from there the same tab leads back.
    let way = aiko.on("link", "Recordings", "function () { return this.target + ' ' + this.href; }").await?;
    let way = way.as_str().and_then(|way| way.strip_prefix("_blank ")).ok_or("it opens beside the page")?.to_owned();
    aiko.goto(&way).await?;
    aiko.press("link", "no code *").await?;
    aiko.find("link", ".jsonl").await?;
    let read = "fetch(document.querySelector('.downloads a').href).then(answer => answer.text())\
        .then(text => { const lines = text.trim().split('\\n').map(JSON.parse); \
        return lines[0].format === 'rrp-recording/2' && lines.some(line => line.stream) && \
        lines.some(line => line.mark === 'note' && line.note === 'She smiles.' && line.by.startsWith('Guest')) && \
        lines.at(-1).why === 'the recording was ended'; })";
    assert_eq!(aiko.eval(read).await?, true);
    aiko.press("link", "Report").await?;
    aiko.until("document.querySelector('footer')?.innerText.includes('Replay: same as recorded')", "it is the same")
        .await?;
    aiko.until("document.querySelector('main').innerText.includes('“She smiles.” (P1)')", "the note is told").await?;
    aiko.press("link", "Back to the recordings").await?;
    aiko.press("link", "Operator’s page").await?;
    aiko.until("location.pathname.startsWith('/operate')", "one press to the operator’s page").await?;
    aiko.no_errors()
}
