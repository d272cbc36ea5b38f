//! A look at one state of the page, in every window, in light and dark: axe, what is too small to be pressed, what is cut.

use crate::axe::check_by;
use crate::rules::broken;
use crate::screens::rests;
use crate::targets::small;
use house::{Outcome, Page, Rules};
use std::path::PathBuf;

/// A window: its name, width and height, and whether it is a touch screen.
pub(crate) type Window = (&'static str, u32, u32, bool);

/// Where most people sit, and where every look begins and ends.
pub(crate) const DESKTOP: Window = ("desktop", 1440, 900, false);
pub(crate) const TABLET: Window = ("tablet", 1180, 820, true);
pub(crate) const PHONE: Window = ("phone", 390, 844, true);
/// A phone that is held sideways: as wide as a tablet, and very low.
pub(crate) const SIDEWAYS: Window = ("sideways", 844, 390, true);
/// The four of the design.
pub(crate) const WINDOWS: [Window; 4] = [DESKTOP, TABLET, PHONE, SIDEWAYS];
/// These, and a desktop and a tablet at 200 %.
pub(crate) const SIZES: [Window; 6] =
    [DESKTOP, TABLET, PHONE, SIDEWAYS, ("desktop-200", 720, 450, false), ("tablet-200", 590, 410, false)];
/// Those in which the graph is a drawing: in the others it is a list.
pub(crate) const DRAWN: [Window; 3] = [DESKTOP, TABLET, SIDEWAYS];

/// Looks at a state in all four windows.
pub(crate) async fn look(page: &Page, state: &str) -> Outcome<Vec<String>> {
    look_in(page, state, &WINDOWS).await
}

/// Looks at a state in these windows, and leaves the page on a desktop.
pub(crate) async fn look_in(page: &Page, state: &str, windows: &[Window]) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for window in windows {
        set(page, window).await?;
        found.extend(colours(page, &format!("{state}-{}", window.0)).await?);
        found.extend(measures(page, window, state).await?);
    }
    page.theme(false).await?;
    set(page, &DESKTOP).await?;
    Ok(found)
}

/// Makes the window that large.
pub(crate) async fn set(page: &Page, (_, width, height, touch): &Window) -> Outcome<()> {
    page.size(*width, *height, *touch).await?;
    let fingers = if *touch { "fingers point" } else { "no fingers point" };
    page.until(&format!("matchMedia('(pointer: coarse)').matches === {touch}"), fingers).await?;
    rests(page).await
}

/// What axe finds in light, and what in dark.
pub(crate) async fn colours(page: &Page, state: &str) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for (dark, theme, rules) in [(false, "light", Rules::All), (true, "dark", Rules::Colours)] {
        page.theme(dark).await?;
        rests(page).await?;
        let place = format!("{state}-{theme}");
        found.extend(check_by(page, rules, &place).await?);
        picture(page, &place).await?;
    }
    Ok(found)
}

/// What is too small to be pressed, what is cut or scrolls sideways, and what covers Stop.
pub(crate) async fn measures(page: &Page, (window, _, _, touch): &Window, state: &str) -> Outcome<Vec<String>> {
    let place = format!("{state}, {window}");
    let mut found = broken(page, &place).await?;
    found.extend(small(page, *touch, &place).await?);
    Ok(found)
}

/// Keeps a picture where `LOOKS_PICTURES` says, if it says so.
pub(crate) async fn picture(page: &Page, name: &str) -> Outcome<()> {
    match std::env::var_os("LOOKS_PICTURES") {
        Some(folder) => page.screenshot(&PathBuf::from(folder).join(format!("{name}.png"))).await,
        None => Ok(()),
    }
}

/// Whether the pictures of every screen are kept in `target/looks`: not in CI, where nobody looks at them.
pub(crate) fn keeps_pictures() -> bool {
    std::env::var("CI").as_deref() != Ok("true")
}
