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
    aiko.eval("document.querySelector('.recordings summary').click()").await?;
    aiko.find("link", "Download the recording of Watcher").await?;
    let read = "fetch(document.querySelector('.recordings li a').href).then(answer => answer.text())\
        .then(text => { const lines = text.trim().split('\\n').map(JSON.parse); \
        return lines[0].format === 'rrp-recording/2' && lines.some(line => line.stream) && \
        lines.some(line => line.mark === 'note' && line.note === 'She smiles.' && line.by.startsWith('Guest')) && \
        lines.at(-1).why === 'the recording was ended'; })";
    assert_eq!(aiko.eval(read).await?, true);
    calm(&aiko)?;
    aiko.find("link", "All recordings, to find, name and compare").await?;
    let report = aiko.eval("document.querySelector('[aria-label=\"Report of Watcher\"]').href").await?;
    aiko.goto(report.as_str().unwrap_or_default()).await?;
    aiko.until("document.querySelector('footer')?.innerText.includes('Replay: same as recorded')", "it is the same")
        .await?;
    aiko.until("document.querySelector('main').innerText.includes('“She smiles.” (P1)')", "the note is told").await?;
    aiko.no_errors()
}
