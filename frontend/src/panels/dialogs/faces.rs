//! Forgetting faces: asked about first, as they are gone for good.

use super::frame::{Feet, Frame, close};
use crate::panels::hold::hold;
use crate::words;
use leptos::prelude::*;
use robot::Control;

/// The robot that this tab looks at forgets all faces that it remembers.
#[component]
pub(super) fn ForgetFaces() -> impl IntoView {
    let desk = hold();
    let robot = desk.desk().robots.chosen.get_untracked();
    let count = robot.as_ref().and_then(|robot| robot.condition.faces).unwrap_or_default();
    let says = robot.as_ref().map(|robot| words::forget_faces_of(&robot.name, count));
    let asked = robot.map(|robot| robot.robot);
    let done = Callback::new(move |()| {
        // Whatever this tab looks at meanwhile, it is the robot that was asked about.
        if asked.is_some() && asked == desk.desk().robots.chosen_id() {
            desk.desk().robots.control(Control::ForgetFaces);
        }
        close(desk);
    });
    view! {
        <Frame title=words::forget_faces() narrow=true save=done>
            <div class="dialog-body"><p>{says}</p></div>
            <Feet save=words::forget() leave=words::keep() />
        </Frame>
    }
}
