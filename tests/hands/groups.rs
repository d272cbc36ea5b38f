//! Groups of streams: gathered, dragged by the title, folded to a box, unfolded, taken apart; by mouse and by keys.

use house::{Outcome, Page};

use crate::several::{are, lasso};
use crate::steps::{Stage, picture, rests, stage};

const BALLS: Option<&str> = Some("Track far and close balls");
const FAR: &str = "Far ball, stream";
const CLOSE: &str = "Close ball, stream";

/// Somebody with a program in which far and close balls are chosen.
async fn chosen(stage: &Stage, program: &str) -> Outcome<Page> {
    let aiko = stage.person("aiko", program).await?;
    let (far, close) = (rests(&aiko, FAR).await?, rests(&aiko, CLOSE).await?);
    lasso(&aiko, (far.x - 70.0, far.y - 4.0), (close.x + close.width + 60.0, close.y + close.height + 6.0)).await?;
    aiko.find("toolbar", "2 selected").await?;
    Ok(aiko)
}

#[tokio::test]
async fn chosen_streams_become_a_group_that_is_dragged_by_its_title() -> Outcome<()> {
    let stage = stage!("a group");
    let program = stage.wire.make("Grouped", BALLS).await?;
    let aiko = chosen(&stage, &program).await?;
    let ben = stage.person("ben", &program).await?;
    aiko.within("toolbar", "2 selected").press("button", "Group").await?;
    let title = rests(&aiko, "Group, group, 2 streams").await?;
    ben.find("button", "Group, group, 2 streams").await?;
    aiko.find("toolbar", "Group").await?;
    picture(&aiko, "group").await?;
    let (far, close) = (rests(&aiko, FAR).await?, rests(&aiko, CLOSE).await?);
    let (x, y) = title.centre();
    aiko.drag((x, y), (x, y + 60.0), 6).await?;
    let (far2, close2) = (rests(&aiko, FAR).await?, rests(&aiko, CLOSE).await?);
    assert!((far2.y - far.y - 60.0).abs() < 12.0 && (close2.y - close.y - 60.0).abs() < 12.0, "{far2:?} {close2:?}");
    aiko.key("Control+z").await?;
    let back = |node: &str, y: f64| {
        format!(
            "Math.abs(document.querySelector('[data-node][aria-label^={node}]').getBoundingClientRect().y - {y}) < 3"
        )
    };
    aiko.until(&back("Far", far.y), "one step takes the whole drag back").await?;
    aiko.until(&back("Close", close.y), "of both streams").await?;
    aiko.key("Control+z").await?;
    aiko.gone("button", "Group, group, 2 streams").await?;
    ben.gone("button", "Group, group, 2 streams").await?;
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn a_folded_group_is_one_box_for_everybody_and_unfolds_where_it_is() -> Outcome<()> {
    let stage = stage!("a folded group");
    let program = stage.wire.make("Folded", BALLS).await?;
    let aiko = chosen(&stage, &program).await?;
    let ben = stage.person("ben", &program).await?;
    aiko.key("Control+g").await?;
    let far = rests(&aiko, FAR).await?;
    aiko.press("button", "Fold Group").await?;
    for person in [&aiko, &ben] {
        person.find("button", "Group, folded group, 2 streams").await?;
        person.gone("button", FAR).await?;
        are(person, 4).await?;
    }
    let chips = aiko.eval("document.querySelectorAll('[data-chip]').length").await?;
    let edges =
        aiko.eval("[...document.querySelectorAll('path.edge')].filter(edge => edge.getAttribute('d')).length").await?;
    assert_eq!(
        (chips.as_u64(), edges.as_u64()),
        (Some(3), Some(5)),
        "what leads in has no chip, and all edges are drawn"
    );
    picture(&aiko, "folded").await?;
    let (x, y) = rests(&aiko, "Group, folded group, 2 streams").await?.centre();
    aiko.drag((x - 60.0, y), (x - 20.0, y + 40.0), 6).await?;
    aiko.press("button", "Unfold Group").await?;
    let far2 = rests(&aiko, FAR).await?;
    assert!((far2.x - far.x - 40.0).abs() < 12.0 && (far2.y - far.y - 40.0).abs() < 12.0, "{far:?} {far2:?}");
    ben.find("button", "Group, group, 2 streams").await?;
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn a_group_is_made_renamed_folded_and_taken_apart_by_keys() -> Outcome<()> {
    let stage = stage!("groups by keys");
    let program = stage.wire.make("Group keys", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, FAR).await?;
    aiko.eval("document.querySelector('[data-node][aria-label^=Far]').focus(), 0").await?;
    aiko.key("Space").await?;
    aiko.key("Control+g").await?;
    aiko.find("button", "Group, group, 1 stream").await?;
    aiko.eval("document.querySelector('[data-group]').focus(), 0").await?;
    aiko.key("F2").await?;
    aiko.until("document.activeElement.matches('input.rename')", "the title is typed").await?;
    aiko.key("Control+a").await?;
    aiko.type_text("Near\n").await?;
    aiko.find("button", "Near, group, 1 stream").await?;
    aiko.until("document.activeElement.matches('[data-group]')", "the title has the keyboard").await?;
    aiko.key("f").await?;
    aiko.find("button", "Near, folded group, 1 stream").await?;
    aiko.until("document.activeElement.matches('.group-box')", "the box has the keyboard").await?;
    aiko.key("ArrowUp").await?;
    aiko.until("document.activeElement.matches('[data-node][aria-label^=Distance]')", "up to what feeds it").await?;
    aiko.key("ArrowDown").await?;
    aiko.until("document.activeElement.matches('.group-box')", "down into the box").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "Near, group, 1 stream").await?;
    aiko.find("button", FAR).await?;
    aiko.key("Control+Shift+g").await?;
    aiko.gone("button", "Near, group, 1 stream").await?;
    aiko.find("button", FAR).await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_stream_that_is_carried_into_a_frame_is_in_the_group() -> Outcome<()> {
    let stage = stage!("into a group");
    let program = stage.wire.make("Joined", BALLS).await?;
    let aiko = chosen(&stage, &program).await?;
    let ben = stage.person("ben", &program).await?;
    aiko.key("Control+g").await?;
    aiko.find("button", "Group, group, 2 streams").await?;
    aiko.key("Escape").await?;
    let (far, ball) = (rests(&aiko, FAR).await?, rests(&aiko, "Ball, sensor stream").await?);
    aiko.drag(ball.centre(), (ball.centre().0, far.centre().1), 8).await?;
    ben.find("button", "Group, group, 1 sense, 2 streams").await?;
    aiko.key("Control+z").await?;
    ben.find("button", "Group, group, 2 streams").await?;
    let back = format!(
        "Math.abs(document.querySelector('[data-node][aria-label^=Ball]').getBoundingClientRect().y - {}) < 3",
        ball.y
    );
    aiko.until(&back, "one step takes both back").await?;
    aiko.no_errors()?;
    ben.no_errors()
}
