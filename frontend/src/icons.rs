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
            "M2.5 20c.8-4 4-5.5 7.5-5.5c1.500 0 2.900.3 4 .9",
            "M18.500 14v6",
            "M15.500 17h6",
        ],
        "check" => &["M5 12.5l4.5 4.5L19 7.5"],
        "chevron" => &["M7 10l5 5l5-5"],
        "reset" => &["M5 5v5h5", "M5.5 10a7.5 7.5 0 1 1-1 4"],
        "save" => &["M12 4v10", "M7.5 10L12 14.5L16.5 10", "M5 19.5h14"],
        "open" => &["M12 15V4.5", "M7.5 9L12 4.5L16.5 9", "M5 19.5h14"],
        "more" => &["M5.5 12h.01", "M12 12h.01", "M18.5 12h.01"],
        "help" => &[RING, "M9.7 9.5a2.4 2.4 0 1 1 3.3 2.2c-.7.3-1 .8-1 1.6", "M12 16.3h.01"],
        "history" => &["M4.5 5v4.5H9", "M4.8 9.500a8 8 0 1 1-.6 4.500", "M12 8v4.500l3 1.800"],
        "flag" => &["M6 21V4", "M6 4.500h11l-2.500 4L17 12.500H6"],
        "copy" => &["M8.5 8.5h11v11h-11z", "M5 15.5H4.500V4.500h11V5.500"],
        "offline" => &["M4 9.500a12 12 0 0 1 16 0", "M7 13a7.500 7.500 0 0 1 10 0", "M12 17.500h.01"],
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
