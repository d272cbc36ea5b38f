//! The icon set: simple strokes on a field of 24, drawn in the colour of the text around them.

use behaviour::connectors;
use leptos::prelude::*;

/// One icon by name; an unknown name draws a small ring, so that nothing is ever empty.
#[component]
pub(crate) fn Icon(name: &'static str) -> impl IntoView {
    let paths = paths(name);
    view! {
        <svg
            viewBox="0 0 24 24"
            width="18"
            height="18"
            fill="none"
            stroke="currentColor"
            stroke-width="1.75"
            stroke-linecap="round"
            stroke-linejoin="round"
            aria-hidden="true"
            focusable="false"
        >
            {paths.iter().map(|path| view! { <path d=*path /> }).collect_view()}
        </svg>
    }
}

const RING: &str = "M12 4a8 8 0 1 0 0 16a8 8 0 1 0 0-16";

fn paths(name: &str) -> &'static [&'static str] {
    device_paths(name)
        .or_else(|| connector_paths(name))
        .or_else(|| tool_paths(name))
        .unwrap_or(&["M12 8a4 4 0 1 0 0 8a4 4 0 1 0 0-8"])
}

fn device_paths(name: &str) -> Option<&'static [&'static str]> {
    Some(match name {
        "ball" => &[RING, "M8 10a4.5 4.5 0 0 1 3-3"],
        "blob" => &["M12 4c5 0 8 3 8 7.5S17 20 12.5 20S4 17.5 4 12.5S7 4 12 4", "M12 9v6", "M9 12h6"],
        "face" => &[RING, "M9 10h.01", "M15 10h.01", "M8.5 14.5c2 2 5 2 7 0"],
        "touch" => &["M9 12V5.5a1.5 1.5 0 0 1 3 0V11l5 1.2a2 2 0 0 1 1.5 2.2L18 20H10l-4-5.5a1.4 1.4 0 0 1 2-2L9 13.5"],
        "joint" => {
            &["M7 14.5a2.5 2.5 0 1 0 0 5a2.5 2.5 0 1 0 0-5", "M17 4.5a2.5 2.5 0 1 0 0 5a2.5 2.5 0 1 0 0-5", "M9 15l6-6"]
        }
        "clock" => &[RING, "M12 7.5V12l3 2"],
        "target" => &[RING, "M12 9a3 3 0 1 0 0 6a3 3 0 1 0 0-6", "M12 2v4", "M12 18v4", "M2 12h4", "M18 12h4"],
        "speech" => &["M4 5h16v11H9l-5 4z"],
        "light" => &["M12 3a6 6 0 0 1 3.5 10.9V17h-7v-3.1A6 6 0 0 1 12 3", "M10 20.5h4"],
        "brightness" => &[
            "M12 8a4 4 0 1 0 0 8a4 4 0 1 0 0-8",
            "M12 2v2.5M12 19.5V22M2 12h2.5M19.5 12H22M5 5l1.7 1.7M17.3 17.3L19 19M5 19l1.7-1.7M17.3 6.7L19 5",
        ],
        "remember" => &["M12 4a4 4 0 1 0 0 8a4 4 0 1 0 0-8", "M4.5 20c.8-4 4-5.5 7.5-5.5", "M15 18l2 2l4-4.5"],
        "word" => &["M4 5h16v10H9l-5 4z", "M8 9h8", "M8 12h5"],
        "hand" => &[
            "M8 13V6.5a1.4 1.4 0 0 1 2.8 0V11V5a1.4 1.4 0 0 1 2.8 0v6V6.5a1.4 1.4 0 0 1 2.8 0V14a6 6 0 0 1-11 3l-2-4a1.4 1.4 0 0 1 2.4-1.4z",
        ],
        "bumper" => &["M4 17h9a4 4 0 0 0 4-4v-3", "M4 17v-3l5-2V5", "M20 6v11", "M4 20h13"],
        "sonar" => &["M6 12h.01", "M10 8a6 6 0 0 1 0 8", "M13.5 5.5a10 10 0 0 1 0 13", "M17 3a14 14 0 0 1 0 18"],
        "ear" => &["M7 10a5 5 0 0 1 10 0c0 4-4 4.5-4 8a2.5 2.5 0 0 1-5 0", "M10 10.5a2 2 0 0 1 4-.5"],
        "people" => &[
            "M9 5a3 3 0 1 0 0 6a3 3 0 1 0 0-6",
            "M3 19c.6-3.2 3-4.5 6-4.5s5.4 1.3 6 4.5",
            "M16 5.5a2.7 2.7 0 0 1 0 5.3",
            "M17.5 14.8c2 .6 3.1 2 3.5 4.2",
        ],
        "landmark" => &[RING, "M12 12V4.5", "M12 12l6 4.5", "M12 12l-6 4.5"],
        "battery" => &["M3 8h15v8H3z", "M21 11v2", "M6 11v2M9.5 11v2"],
        "posture" => &["M12 3a2 2 0 1 0 0 4a2 2 0 1 0 0-4", "M12 8.5V14", "M8 10.5h8", "M12 14l-3 6", "M12 14l3 6"],
        "fall" => &["M5 7a2 2 0 1 0 0 4a2 2 0 1 0 0-4", "M9 10.5l6 2l5-1", "M15 12.5l5 5", "M3 20h18"],
        "button" => &["M5 14h14v5H5z", "M8 14v-3a4 4 0 0 1 8 0v3"],
        "sound" => &["M4 10v4h3.5L12 18V6l-4.5 4z", "M15.5 9a4 4 0 0 1 0 6", "M18 6.5a8 8 0 0 1 0 11"],
        "animation" => &[
            "M12 3a2 2 0 1 0 0 4a2 2 0 1 0 0-4",
            "M12 8.5V15",
            "M12 10l-5-4",
            "M12 10l5 2",
            "M12 15l-3 5.5",
            "M12 15l3 5.5",
        ],
        "behavior" => &["M4 5h16v14H4z", "M10 9l5 3l-5 3z"],
        "tablet" => &["M6 3.5h12v17H6z", "M11 17.5h2"],
        "voice" => &[
            "M12 4a2.5 2.5 0 0 0-2.5 2.5v5a2.5 2.5 0 0 0 5 0v-5A2.5 2.5 0 0 0 12 4",
            "M6.5 11.5a5.5 5.5 0 0 0 11 0",
            "M12 17v3",
        ],
        "lights" => &["M12 8a4 4 0 1 0 0 8a4 4 0 1 0 0-8", "M12 3v2M12 19v2M3 12h2M19 12h2"],
        "walk" => &[
            "M13 3a2 2 0 1 0 0 4a2 2 0 1 0 0-4",
            "M12.5 8.5L11 14l-4 6",
            "M11 14l4 2l1 4.5",
            "M8 12l1.5-3l3-.5l2 3l3 .5",
        ],
        "print" => &["M4 5h16v14H4z", "M7.5 9.5h9", "M7.5 13h9", "M7.5 16h5"],
        "down" => &["M12 5v13", "M6.5 13L12 18.5L17.5 13"],
        _ => return None,
    })
}

fn connector_paths(name: &str) -> Option<&'static [&'static str]> {
    connectors::ALL.iter().map(|spec| spec.icon).find(|icon| icon.name == name).map(|icon| icon.strokes)
}

fn tool_paths(name: &str) -> Option<&'static [&'static str]> {
    Some(match name {
        "fx" => &["M5 19c3 0 3-3 3.6-6.5S9.5 5 13 5", "M5.5 11h6", "M14 12.5l5.5 6.5", "M19.5 12.5L14 19"],
        "folder" => &["M3.5 6.5h6l2 2.5h9v9.5h-17z"],
        "plus" => &["M12 5v14", "M5 12h14"],
        "connect" => &[
            "M7 4.5a2.5 2.5 0 1 0 0 5a2.5 2.5 0 1 0 0-5",
            "M17 14.5a2.5 2.5 0 1 0 0 5a2.5 2.5 0 1 0 0-5",
            "M7 9.5c0 5.5 4 3 7.5 7",
        ],
        "row" => &["M4 8h6v8H4z", "M14 8h6v8h-6z", "M2 12h2", "M10 12h4", "M20 12h2"],
        "column" => &["M8 4v6h8V4z", "M8 14v6h8v-6z", "M12 2v2", "M12 10v4", "M12 20v2"],
        "group" => &["M4 7h16v13H4z", "M4 7V4h8v3", "M8 12h3", "M13 15h3"],
        "ungroup" => &["M4 7h7", "M4 7v13h16v-9", "M14 4l6 6", "M20 4l-6 6"],
        "fold" => &["M5 12h14", "M12 3v5", "M9.5 6L12 8.5L14.5 6", "M12 21v-5", "M9.5 18L12 15.5L14.5 18"],
        "unfold" => &["M5 12h14", "M12 8.5V3", "M9.5 5.5L12 3l2.5 2.5", "M12 15.5V21", "M9.5 18.5L12 21l2.5-2.5"],
        "note" => &["M5 4h14v11l-5 5H5z", "M19 15h-5v5", "M8.5 9h7", "M8.5 12.5h4"],
        "duplicate" => &["M8 8h11v11H8z", "M5 15V5h10", "M13.5 11v5", "M11 13.5h5"],
        "minus" => &["M5 12h14"],
        "trash" => &["M4.5 7h15", "M9.5 7V4.5h5V7", "M6.5 7l1 13h9l1-13", "M10.5 11v5.5", "M13.5 11v5.5"],
        "bolt" => &["M13 3L5.5 13.5H11L10 21l8-11h-5.5z"],
        "pencil" => &["M5 19l1-4L16.5 4.5l3 3L9 18z", "M14 7l3 3"],
        "undo" => &["M8.5 5L4.5 9l4 4", "M4.5 9H14a5 5 0 0 1 0 10h-3"],
        "redo" => &["M15.5 5l4 4l-4 4", "M19.5 9H10a5 5 0 0 0 0 10h3"],
        "play" => &["M8 5.5v13l10.5-6.5z"],
        "stop" => &["M6 6h12v12H6z"],
        "search" => &["M10.5 4a6.5 6.5 0 1 0 0 13a6.5 6.5 0 1 0 0-13", "M15.5 15.5L20.5 20.5"],
        "close" => &["M6 6l12 12", "M18 6L6 18"],
        "warn" => &["M12 4L2.5 20h19z", "M12 10v4.5", "M12 17.3h.01"],
        "menu" => &["M4 7h16", "M4 12h16", "M4 17h16"],
        "fit" => &["M4 9V4h5", "M15 4h5v5", "M20 15v5h-5", "M9 20H4v-5"],
        "eye" => &[
            "M2.5 12S6 5.5 12 5.5S21.5 12 21.5 12S18 18.5 12 18.5S2.5 12 2.5 12",
            "M12 9.2a2.8 2.8 0 1 0 0 5.6a2.8 2.8 0 1 0 0-5.6",
        ],
        "lock" => &["M5.5 11h13v9h-13z", "M8.5 11V8a3.5 3.5 0 0 1 7 0v3"],
        "user" => &["M12 4a4 4 0 1 0 0 8a4 4 0 1 0 0-8", "M4.5 20c.8-4 4-5.5 7.5-5.5s6.7 1.5 7.5 5.5"],
        "invite" => &[
            "M10 4a4 4 0 1 0 0 8a4 4 0 1 0 0-8",
            "M2.5 20c.8-4 4-5.5 7.5-5.5c1.5 0 2.900.3 4 .9",
            "M18.5 14v6",
            "M15.5 17h6",
        ],
        "check" => &["M5 12.5l4.5 4.5L19 7.5"],
        "chevron" => &["M7 10l5 5l5-5"],
        "reset" => &["M5 5v5h5", "M5.5 10a7.5 7.5 0 1 1-1 4"],
        "save" => &["M12 4v10", "M7.5 10L12 14.5L16.5 10", "M5 19.5h14"],
        "open" => &["M12 15V4.5", "M7.5 9L12 4.5L16.5 9", "M5 19.5h14"],
        "more" => &["M5.5 12h.01", "M12 12h.01", "M18.5 12h.01"],
        "help" => &[RING, "M9.7 9.5a2.4 2.4 0 1 1 3.3 2.2c-.7.3-1 .8-1 1.6", "M12 16.3h.01"],
        "history" => &["M4.5 5v4.5H9", "M4.8 9.5a8 8 0 1 1-.6 4.5", "M12 8v4.5l3 1.8"],
        "globe" => &[RING, "M4 12h16", "M12 4c3 2.5 3.8 5 3.8 8s-.8 5.5-3.8 8c-3-2.5-3.8-5-3.8-8s.8-5.5 3.8-8"],
        "flag" => &["M6 21V4", "M6 4.5h11l-2.5 4L17 12.5H6"],
        "copy" => &["M8.5 8.5h11v11h-11z", "M5 15.5H4.5V4.5h11V5.5"],
        "offline" => &["M4 9.5a12 12 0 0 1 16 0", "M7 13a7.5 7.5 0 0 1 10 0", "M12 17.5h.01"],
        "up" => &["M12 19V6", "M6.5 11L12 5.5L17.5 11"],
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::{connector_paths, device_paths, paths, tool_paths};
    use behaviour::connectors;

    #[test]
    fn every_connector_and_device_has_an_icon_of_its_own_kind() {
        for spec in connectors::ALL {
            let name = spec.icon.name;
            assert!(paths(name) == spec.icon.strokes && connector_paths(name).is_some(), "{name}");
            assert!(device_paths(name).is_none() && tool_paths(name).is_none(), "{name}");
        }
        for device in robot::sensors().chain(robot::actuators()) {
            assert!(device_paths(device.icon).is_some(), "{}", device.name);
        }
    }
}
