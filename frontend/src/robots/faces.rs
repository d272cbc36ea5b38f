//! Forgetting faces, all or one: asked about first, as they are gone for good.

use crate::dialogs::{Feet, Frame, close};
use crate::fields::Select;
use crate::parts::hold;
use crate::robots::words;
use leptos::prelude::*;
use robot::Control;

/// The robot that this tab looked at when the question was asked forgets faces, whatever this tab looks at meanwhile.
#[component]
pub(crate) fn ForgetFaces() -> impl IntoView {
    let desk = hold();
    let robot = StoredValue::new(desk.desk().robots.chosen.get_untracked());
    let (names, which) = (RwSignal::new(Vec::<String>::new()), RwSignal::new(String::new()));
    if let Some(robot) = robot.get_value() {
        desk.desk().robots.faces(&robot.robot, move |known| {
            names.try_set(known);
        });
    }
    let is_gone = Signal::derive(move || {
        let all = desk.desk().robots.all.read();
        robot.with_value(|asked| asked.as_ref().is_none_or(|asked| all.iter().all(|known| known.robot != asked.robot)))
    });
    let name = move || robot.with_value(|robot| robot.as_ref().map(|robot| robot.name.clone())).unwrap_or_default();
    let count = move || robot.with_value(|robot| robot.as_ref()?.condition.faces).unwrap_or_default();
    let says = move || match which.get().as_str() {
        "" => words::forget_faces_of(&name(), count()),
        face => words::forget_face_of(&name(), face),
    };
    let options = Signal::derive(move || {
        let one = |face: String| (face.clone(), face);
        std::iter::once((String::new(), words::all_faces().to_owned()))
            .chain(names.get().into_iter().map(one))
            .collect()
    });
    let done = Callback::new(move |()| {
        let Some(robot) = robot.get_value().filter(|_| !is_gone.get_untracked()) else { return };
        let face = which.get_untracked();
        let control = if face.is_empty() { Control::ForgetFaces } else { Control::ForgetFace(face) };
        desk.desk().robots.control_of(robot, control);
        close(desk);
    });
    view! {
        <Frame title=words::forget_faces() narrow=true save=done>
            <div class="dialog-body">
                <Show when=move || !names.read().is_empty()>
                    <Select label=words::whose_face() options value=which />
                </Show>
                <p>{says}</p>
                {move || is_gone.get().then(|| view! { <p class="refusal" role="alert">{words::robot_removed(&name())}</p> })}
            </div>
            <Feet save=words::forget() leave=words::keep() nothing=is_gone />
        </Frame>
    }
}
