//! Other ways through a graph that is there: into an edge, to an action, to a connector, and out of a way.

use house::{Outcome, Page};

use crate::steps::{picture, rests, stage, text};

const BALLS: Option<&str> = Some("Track far and close balls");

/// The names of all streams and connectors, in the order of the page.
pub(crate) async fn names(page: &Page) -> Outcome<String> {
    let js =
        "[...document.querySelectorAll('[data-node],[data-chip]')].map(x => x.getAttribute('aria-label')).join(' | ')";
    Ok(text(&page.eval(js).await?).to_owned())
}

/// The handle of the selected stream: where its wires begin.
pub(crate) async fn handle(page: &Page) -> Outcome<(f64, f64)> {
    let js = "(() => { const at = document.querySelector('[data-handle]')?.getBoundingClientRect();
        return at && [at.x + at.width / 2, at.y + at.height / 2]; })()";
    let at = page.until(js, "there is a handle").await?;
    Ok((at[0].as_f64().unwrap_or_default(), at[1].as_f64().unwrap_or_default()))
}

#[tokio::test]
async fn two_presses_put_a_connector_into_an_edge_and_one_undo_takes_it_out() -> Outcome<()> {
    let stage = stage!("plus on an edge");
    let program = stage.wire.make("Edges", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    let ben = stage.person("ben", &program).await?;
    let far = rests(&aiko, "Far ball, stream").await?;
    let before = names(&aiko).await?;
    aiko.move_to((far.centre().0, far.y + far.height + 14.0)).await?;
    aiko.move_to((far.centre().0, far.y + far.height + 16.0)).await?;
    aiko.press("button", "Insert between Far ball and subscribe").await?;
    picture(&aiko, "offer").await?;
    aiko.press("menuitem", "sample every second").await?;
    aiko.find("button", "sample (every 1 second), connector from Far ball to Far ball every second").await?;
    aiko.find("button", "subscribe, connector from Far ball every second to Head tracker").await?;
    ben.find("button", "subscribe, connector from Far ball every second to Head tracker").await?;
    let [above, made, below] =
        ["Far ball, stream", "Far ball every second, stream", "Head tracker, red ball · head, actuator stream"];
    let (above, made, below) = (rests(&aiko, above).await?, rests(&aiko, made).await?, rests(&aiko, below).await?);
    assert!(above.y < made.y && made.y < below.y, "{above:?} {made:?} {below:?}");
    aiko.key("Control+z").await?;
    aiko.gone("button", "Far ball every second, stream").await?;
    assert_eq!(names(&aiko).await?, before);
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn a_wire_is_drawn_by_hand_to_an_action_and_to_free_ground() -> Outcome<()> {
    let stage = stage!("wires");
    let program = stage.wire.make("Wires", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", "Far ball, stream").await?;
    let to = rests(&aiko, "Head and body tracker, red ball · whole body, actuator stream").await?.centre();
    aiko.drag(handle(&aiko).await?, to, 8).await?;
    aiko.find("button", "subscribe, connector from Far ball to Head and body tracker").await?;
    aiko.press("button", "Ball, sensor stream").await?;
    aiko.until("document.querySelector('.strip') !== null", "its next steps are offered").await?;
    let ball = rests(&aiko, "Ball, sensor stream").await?;
    aiko.drag(handle(&aiko).await?, (ball.x - 160.0, ball.y + 40.0), 8).await?;
    aiko.press("menuitem", "changed only when it changes").await?;
    let made = rests(&aiko, "Ball changed, stream").await?;
    assert!(
        (made.centre().0 - ball.x + 160.0).abs() < 14.0 && (made.y - ball.y - 40.0).abs() < 14.0,
        "{made:?} {ball:?}"
    );
    aiko.no_errors()
}

#[tokio::test]
async fn keys_alone_draw_a_wire_and_hear_where_it_ends() -> Outcome<()> {
    let stage = stage!("wires by keyboard");
    let program = stage.wire.make("Wires", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", "Far ball, stream").await?;
    aiko.key("c").await?;
    aiko.until(
        "document.querySelector('#stage > [role=status]').textContent.startsWith('Connect Far ball:')",
        "what may be",
    )
    .await?;
    let said = "document.querySelector('#stage > [role=status]').textContent";
    for _ in 0..9 {
        aiko.key("ArrowDown").await?;
        if text(&aiko.eval(said).await?).contains("eads to Head and body tracker") {
            break;
        }
    }
    picture(&aiko, "wire").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "subscribe, connector from Far ball to Head and body tracker").await?;
    aiko.key("c").await?;
    aiko.key("Escape").await?;
    aiko.until("document.querySelector('.wiring') === null", "the wire is gone").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_way_goes_on_without_a_stream_that_is_taken_out() -> Outcome<()> {
    let stage = stage!("healing");
    let program = stage.wire.make("Heal", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    let before = {
        rests(&aiko, "Distance, stream").await?;
        names(&aiko).await?
    };
    aiko.press("button", "Distance, stream").await?;
    aiko.key("Delete").await?;
    aiko.press("menuitem", "Remove it, and go on from Ball").await?;
    aiko.find("button", "filter (ball < 0.5), connector from Ball to Close ball").await?;
    // A ball is no number: that is told at once, with the parts of it that are.
    aiko.within("note", "Problems").find("button", "Mend it: Use “ball.size”*").await?;
    aiko.gone("button", "Distance, stream").await?;
    aiko.key("Control+z").await?;
    aiko.find("button", "Distance, stream").await?;
    let mut now: Vec<String> = names(&aiko).await?.split(" | ").map(str::to_owned).collect();
    let mut was: Vec<String> = before.split(" | ").map(str::to_owned).collect();
    now.sort();
    was.sort();
    assert_eq!(now, was);
    aiko.no_errors()
}
