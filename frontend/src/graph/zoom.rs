//! Smaller, real size, larger, everything, tidy.

use super::Stage;
use super::bounds::bounds;
use super::view::CanvasBounds;
use crate::desk::{Desk, use_desk};
use crate::graph::words;
use crate::icons::Icon;
use crate::later::{SecondPiece, second_piece};
use leptos::prelude::*;
use protocol::Role;

const STEP: f64 = 1.25;

/// The buttons at the bottom right of the stage.
#[component]
pub(super) fn Zoom() -> impl IntoView {
    let stage = expect_context::<Stage>();
    let desk = use_desk();
    let [smaller, real, shown, larger, whole] = [(); 5].map(|()| stage.clone());
    let drawing = {
        let desk = desk.clone();
        ArcMemo::new(move |_| {
            (desk.document.open.with(Option::is_some) || desk.is_then())
                && !desk.document.stream_ids.with(Vec::is_empty)
        })
    };
    let may = desk.clone();
    let piece = second_piece();
    let to_real = move |_| real.to_real_size();
    view! {
        <div class="zoom" role="group" hidden=move || !drawing.get() aria-label=words::zoom_group()>
            <button type="button" class="plain" title=words::tidy() disabled=move || !may.may(Role::Editor)
                on:click=move |_| tidy(&piece, &desk, &stage)>
                {words::tidy()}
            </button>
            <button type="button" aria-label=words::zoom_out() title=words::zoom_out()
                on:click=move |_| smaller.zoom_by(1.0 / STEP)>
                <Icon name="minus" />
            </button>
            <button type="button" class="plain percent" title=words::real_size() on:click=to_real>
                {move || shown.view.with(|view| words::percent(view.zoom))}
            </button>
            <button type="button" aria-label=words::zoom_in() title=words::zoom_in()
                on:click=move |_| larger.zoom_by(STEP)>
                <Icon name="plus" />
            </button>
            <button type="button" aria-label=words::fit() title=words::fit() on:click=move |_| whole.fit()>
                <Icon name="fit" />
            </button>
        </div>
    }
}

impl Stage {
    /// Shows things in real size, with what is selected in view, else with what is nearest to the middle.
    pub(super) fn to_real_size(&self) {
        let chosen = self.desk.document.selected.get_untracked();
        let chosen = chosen.and_then(|selected| bounds(&self.desk, selected.id()));
        let (view, size) = (self.view.get_untracked(), self.size.get_untracked());
        self.glide(self.shapes.with_untracked(|shapes| {
            let all: Vec<CanvasBounds> =
                chosen.map_or_else(|| shapes.iter().map(|(_, at)| *at).collect(), |at| vec![at]);
            view.real_size(&all, size, self.above())
        }));
    }
}

/// Lays everything out, as soon as what can do that is here.
fn tidy(piece: &SecondPiece, desk: &Desk, stage: &Stage) {
    let (desk, stage) = (desk.clone(), stage.clone());
    piece.when_here(move |rest| match rest {
        Some(rest) => {
            desk.document.tidy(rest.tidy);
            refit(&stage);
        }
        None => desk.say(words::not_loaded(), true),
    });
}

/// Shows everything once the streams are at their new places.
fn refit(stage: &Stage) {
    let stage = stage.clone();
    crate::browser::after(250, move || stage.fit());
}
