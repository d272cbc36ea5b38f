//! The program as an indented list: the phone's view and the one for screen readers. Same gestures as the canvas.

mod rows;
mod strip;
mod tree;

use super::empty::EmptyStage;
use super::hold::hold;
use crate::words;
use leptos::prelude::*;
use rows::{ConnectorRow, StreamRow};
use std::time::Duration;
use tree::{Node, What};

/// The program as a list.
#[component]
pub(crate) fn Outline() -> impl IntoView {
    let desk = hold();
    let nodes = Memo::new(move |_| {
        let desk = desk.desk();
        desk.document.revision.track();
        desk.document.stream_ids.track();
        desk.document.connector_ids.track();
        tree::nodes(&desk.document.behaviour())
    });
    let tick = RwSignal::new(0_u32);
    if let Ok(handle) = set_interval(move || tick.update(|tick| *tick += 1), Duration::from_secs(1)) {
        on_cleanup(move || handle.clear());
    }
    let row = move |node: Node| {
        let indent = format!("{}px", node.depth.min(8) * 22);
        let inside = match node.what {
            What::Stream(id) => view! { <StreamRow id again=node.again tick /> }.into_any(),
            What::Connector(id) => view! { <ConnectorRow id /> }.into_any(),
        };
        view! { <li style:padding-left=indent><span class="sr">{words::level(node.depth + 1)}</span>{inside}</li> }
    };
    view! {
        <main class="stage" id="stage" tabindex="-1" aria-label=words::outline_name()>
            <EmptyStage />
            <ul class="outline"><For each=move || nodes.get() key=|node| node.clone() children=row /></ul>
        </main>
    }
}
