//! A preview of what a typed sentence would add, dashed and pale beside the graph.

use super::Stage;
use super::curve::{chip_place, curves};
use super::view::{CanvasBounds, View};
use crate::desk::{Desk, Ghost, GhostConnector, GhostStream, use_desk};
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::{STREAM_HEIGHT, chip_width, chip_words, stream_width, what_it_is};
use crate::parts::kind_class;
use behaviour::{Id, Place, StreamKind};
use leptos::prelude::*;

/// The height at the top of the stage that is covered while a sentence is typed, in pixels.
const TYPED: f64 = 216.0;

/// The preview, as a view.
pub(crate) fn ghost() -> AnyView {
    view! { <Preview /> }.into_any()
}

#[component]
fn Preview() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let shown = desk.document.ghost.clone();
    bring_into_view(&stage, &desk);
    move || {
        shown.get().map(|ghost| {
            let place = |id: &Id| place(&stage, &ghost, id);
            let ways: Vec<GhostWay> = ghost.connectors.iter().filter_map(|connector| way(connector, place)).collect();
            let path: String = ways.iter().map(|way| way.path.as_str()).collect();
            let first = ghost.streams.first().map(|stream| stream.id.clone());
            let streams = ghost.streams.iter().map(|stream| node(stream, first.as_ref() == Some(&stream.id)));
            view! {
                <div class="ghosts" aria-hidden="true">
                    <svg class="edges" width="1" height="1" focusable="false"><path class="ghost-edge" d=path /></svg>
                    {ways.iter().map(chip).collect_view()}
                    {streams.collect_view()}
                </div>
            }
        })
    }
}

/// A preview out of view is brought into view with the rest of the graph, and the view goes back if nothing comes of it.
fn bring_into_view(stage: &Stage, desk: &Desk) {
    let before = StoredValue::new(None::<(View, View)>);
    let (moved, ghost) = (stage.clone(), desk.document.ghost.clone());
    Effect::new(move |_| {
        let own = |stream: &GhostStream| CanvasBounds {
            left: stream.place.x - stream_width(&stream.stream) / 2.0,
            top: stream.place.y,
            right: stream.place.x + stream_width(&stream.stream) / 2.0,
            bottom: stream.place.y + STREAM_HEIGHT,
        };
        let all = ghost.with(|ghost| CanvasBounds::around(ghost.iter().flat_map(|ghost| &ghost.streams).map(own)));
        let Some(all) = all.filter(|_| before.get_value().is_none()) else { return };
        let view = moved.view.get_untracked();
        if let Some(new) = moved.showing_too(all, TYPED) {
            before.set_value(Some((view, new)));
            moved.glide(new);
        }
    });
    let (back, ghost) = (stage.clone(), desk.document.clone());
    on_cleanup(move || {
        let Some((view, new)) = before.try_get_value().flatten() else { return };
        let added = ghost.several.with_untracked(|several| !several.is_empty());
        if !added && back.view.get_untracked() == new {
            back.glide(view);
        }
    });
}

/// The way of a connector of the preview.
struct GhostWay {
    path: String,
    chip: Place,
    words: crate::layout::ChipWords,
    icon: &'static str,
    doubtful: bool,
}

fn place(stage: &Stage, ghost: &Ghost, id: &Id) -> Option<(Place, StreamKind)> {
    let new = ghost.streams.iter().find(|stream| stream.id == *id);
    new.map(|stream| (stream.place, stream.stream.kind)).or_else(|| {
        let signals = stage.desk.document.stream(id)?;
        Some((signals.place.get(), signals.record.with(|stream| stream.kind)))
    })
}

fn way(ghost: &GhostConnector, place: impl Fn(&Id) -> Option<(Place, StreamKind)>) -> Option<GhostWay> {
    let connector = &ghost.connector;
    let inputs: Vec<Place> = connector.inputs.iter().filter_map(|id| Some(place(id)?.0)).collect();
    let (output, kind) = place(&connector.output)?;
    let chip = chip_place(&inputs, output, kind, None);
    let icon = connector.operation.spec().icon.name;
    Some(GhostWay {
        path: curves(&inputs, chip, output),
        chip,
        words: chip_words(connector),
        icon,
        doubtful: ghost.doubtful,
    })
}

fn chip(way: &GhostWay) -> impl IntoView + use<> {
    let at = format!("translate({:.1}px,{:.1}px) translateX(-50%)", way.chip.x, way.chip.y);
    let width = format!("{:.0}px", chip_width(&way.words));
    view! {
        <div class="at of-chip" style:transform=at>
            <div class="chip connector ghost" style:min-width=width>
                <span class="icon"><Icon name=way.icon /></span>
                <span class="word">{way.words.word.clone()}</span>
                <span class="detail" class:plain=way.words.plain>{way.words.detail.clone()}</span>
            </div>
            {way.doubtful.then(|| view! { <span class="badge"><Icon name="help" /></span> })}
        </div>
    }
}

fn node(ghost: &GhostStream, first: bool) -> impl IntoView + use<> {
    let at = format!("translate({:.1}px,{:.1}px) translateX(-50%)", ghost.place.x, ghost.place.y);
    let width = format!("{:.0}px", stream_width(&ghost.stream));
    let kind = kind_class(ghost.stream.kind);
    let icon = ghost.stream.device.as_deref().and_then(|name| robot::device(ghost.stream.kind, name).ok());
    view! {
        <div class=format!("at {kind}") style:transform=at>
            <div class=format!("stream ghost {kind}") style:min-width=width>
                {icon.map(|device| view! { <span class="icon"><Icon name=device.icon /></span> })}
                <span class="texts">
                    <span class="name">{ghost.stream.name.clone()}</span>
                    " "
                    <span class="second">{what_it_is(&ghost.stream)}</span>
                </span>
            </div>
            {first.then(|| view! { <span class="ghost-tag">{words::preview()}</span> })}
        </div>
    }
}
