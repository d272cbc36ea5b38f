//! How the robot's body is, as plain lights with words.

use crate::parts::hold;
use crate::robots::words;
use leptos::prelude::*;
use robot::Health;

/// The lights of the robot that this tab looks at.
#[component]
pub(crate) fn Lights() -> impl IntoView {
    let desk = hold();
    let lights = Memo::new(move |_| {
        // Who is not heard may have fallen over since, and so may a robot that the server has lost.
        let lost = || matches!(desk.desk().robots.health(), Health::Lost(_) | Health::Connecting);
        if desk.desk().unheard.read().is_some() || lost() {
            return Vec::new();
        }
        let chosen = desk.desk().robots.chosen.read();
        chosen.as_ref().map(|robot| words::condition(&robot.condition)).unwrap_or_default()
    });
    let light = |(look, words): (&'static str, String)| view! { <li data-look=look>{words}</li> };
    view! { <ul class="lights" aria-label=words::robot()>{move || lights.get().into_iter().map(light).collect_view()}</ul> }
}
