//! What else stands in the room: boxes in the way, and printed marks.

use super::HeldThing;
use super::map::RoomMap;
use super::movable::Movable;
use crate::parts::hold;
use crate::robots::words;
use leptos::prelude::*;
use leptos::svg::Svg;
use robot::SceneEdit;

/// The smallest radius of a mark, in units of the picture.
const MARK_MIN: f32 = 7.0;

/// The boxes.
#[component]
pub(super) fn Obstacles(map: Memo<RoomMap>, held: HeldThing, svg: NodeRef<Svg>) -> impl IntoView {
    let desk = hold();
    let ids = Memo::new(move |_| {
        let desk = desk.desk();
        let scene = desk.robots.scene.read();
        let here = scene.obstacles.iter().filter(|one| one.present);
        here.map(|one| (one.id.clone(), one.color.clone(), [one.size[0], one.size[1]])).collect::<Vec<_>>()
    });
    let one = move |(id, color, size): (String, String, [f32; 2])| {
        let key = format!("obstacle {id}");
        let wanted = id.clone();
        let at = Signal::derive(move || {
            let desk = desk.desk();
            let scene = desk.robots.scene.read();
            let found = scene.obstacles.iter().find(|one| one.id == wanted);
            found.map_or([0.0; 3], |one| [one.at[0], one.at[1], 0.0])
        });
        let edit = Callback::new(move |at: [f32; 3]| {
            desk.desk().robots.scene_edit(SceneEdit::MoveObstacle { id: id.clone(), at: [at[0], at[1]] });
            id.clone()
        });
        // Ahead is up in the picture.
        let (wide, deep) = (move || map.get().length(size[1]), move || map.get().length(size[0]));
        view! {
            <Movable label=words::obstacle() key map held svg at edit>
                <rect class=format!("obstacle ball-{color}") rx="3" x=move || -wide() / 2.0 y=move || -deep() / 2.0 width=wide height=deep />
            </Movable>
        }
    };
    view! { <For each=move || ids.get() key=|one| one.0.clone() children=one /> }
}

/// The marks, with a line where their front is.
#[component]
pub(super) fn Landmarks(map: Memo<RoomMap>, held: HeldThing, svg: NodeRef<Svg>) -> impl IntoView {
    let desk = hold();
    let ids = Memo::new(move |_| {
        let desk = desk.desk();
        let scene = desk.robots.scene.read();
        let here = scene.landmarks.iter().filter(|mark| mark.present);
        here.map(|mark| (mark.id.clone(), mark.number, mark.seen)).collect::<Vec<_>>()
    });
    let one = move |(id, number, seen): (String, u16, bool)| {
        let key = format!("mark {id}");
        let wanted = id.clone();
        let mark = Memo::new(move |_| {
            let desk = desk.desk();
            let scene = desk.robots.scene.read();
            scene.landmarks.iter().find(|mark| mark.id == wanted).map(|mark| (mark.at, mark.facing, mark.radius))
        });
        let at = Signal::derive(move || mark.get().map_or([0.0; 3], |mark| mark.0));
        let edit = Callback::new(move |at| {
            let facing = mark.get_untracked().map_or(0.0, |mark| mark.1);
            desk.desk().robots.scene_edit(SceneEdit::MoveLandmark { id: id.clone(), at, facing });
            id.clone()
        });
        let radius = move || mark.get().map_or(0.0, |mark| map.get().length(mark.2)).max(MARK_MIN);
        let turned = move || format!("rotate({:.1})", -mark.get().map_or(0.0, |mark| mark.1).to_degrees());
        view! {
            <Movable label=words::printed_mark() key map held svg at edit>
                <circle class="landmark" class:seen=seen r=radius />
                <line class="landmark" y2=move || -radius() transform=turned />
                <text y=move || radius() + 11.0>{number}</text>
            </Movable>
        }
    };
    view! { <For each=move || ids.get() key=Clone::clone children=one /> }
}
