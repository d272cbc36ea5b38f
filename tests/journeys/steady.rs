//! Nothing that can be pressed moves while values flow: a hand that is on its way still meets what it was meant for.

use house::{Outcome, Page, skip};

use crate::steps::*;

/// Notes at each frame where everything that can be pressed in the chosen part of the page stands, and what it shows.
const WATCH: &str = "globalThis.steady = { stood: new Map(), moved: [], showed: new Set() };
    const look = () => {
        const part = document.querySelector(PART);
        steady.showed.add(part?.querySelector(LIVE)?.innerText);
        for (const one of part?.querySelectorAll('button, input, select, textarea, a, summary') ?? []) {
            const { x, y } = one.getBoundingClientRect();
            const [at, before] = [`${x} ${y}`, steady.stood.get(one)];
            if (before && before !== at) steady.moved.push(`${one.ariaLabel ?? one.innerText}: ${before} -> ${at}`);
            steady.stood.set(one, at);
        }
        requestAnimationFrame(look);
    };
    look()";

async fn watch(page: &Page, part: &str, live: &str) -> Outcome<()> {
    let quoted = |text: &str| serde_json::Value::from(text).to_string();
    page.eval(&format!("{{ {} }}", WATCH.replace("PART", &quoted(part)).replace("LIVE", &quoted(live)))).await.map(drop)
}

async fn showed(page: &Page) -> Outcome<u64> {
    Ok(page.eval("steady.showed.size").await?.as_u64().unwrap_or_default())
}

#[tokio::test]
async fn what_can_be_pressed_stays_where_it_is_while_values_flow() -> Outcome<()> {
    skip::unless!(ready("journey: a steady page"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Steady").await?;
    add_sense(&aiko, "Red ball").await?;
    thunderbolt(&aiko, "Red ball", "map").await?;
    aiko.within("dialog", "Operation").fill("textbox", "Procedure", "redBall.size").await?;
    save(&aiko, "Operation").await?;
    start(&aiko).await?;
    shows_value(&aiko, "Red ball.size").await?;

    // One is in the dialog, the other looks at the connector and moves the ball.
    let ben = stage.beside(&aiko, "ben").await?;
    let chip = "map (redBall.size), connector*";
    aiko.press("button", chip).await?;
    next(&aiko, "map", "More…").await?;
    says(&aiko, "now x").await?;
    ben.press("button", chip).await?;
    says(&ben, "worked, ").await?;
    watch(&aiko, ".dialog", ".trials").await?;
    watch(&ben, ".panel", ".values tbody").await?;
    ben.eval("document.querySelector('.room .movable:has(.ball-red)').focus()").await?;
    for key in ["ArrowUp", "ArrowRight", "ArrowUp", "ArrowLeft", "ArrowLeft", "ArrowUp", "ArrowRight"] {
        let before = [showed(&aiko).await?, showed(&ben).await?];
        ben.key(key).await?;
        for (page, before) in [&aiko, &ben].into_iter().zip(before) {
            page.until(&format!("steady.showed.size > {before}"), "the ball is seen somewhere else").await?;
        }
    }
    for (page, rows) in [(&aiko, ".trials > span"), (&ben, ".values tbody tr")] {
        page.until(&format!("document.querySelectorAll('{rows}').length === 5"), "five values are shown").await?;
        let stood = page.eval("steady.stood.size").await?.as_u64().unwrap_or_default();
        assert!(stood > 1, "only {stood} things to press were found");
        let moved = page.eval("steady.moved").await?;
        assert_eq!(moved, serde_json::json!([]), "what moved while values came");
    }
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Operation").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&aiko)?;
    calm(&ben)
}
