//! The second piece of the page as everything else sees it: dialogs, the history and what else nobody needs at first. It is
//! fetched quietly once the page is usable, and at once when something of it is wanted before.
//!
//! A new dialog is in it by itself, as `LazyViews::dialog` makes them all. Something else that shall come later gets a field of
//! `LazyViews`, which `pieces` fills, and `<Later show=|rest| (rest.field)() />` where it stands.

use crate::browser;
use crate::desk::{Desk, Dialog, LinkState, Selected};
use crate::fields::SentenceField;
use crate::layout::Tidy;
use crate::words;
use behaviour::{Id, Place};
use editor::commands::On;
use leptos::prelude::*;
use protocol::{Exercise, Recorded};
use std::cell::Cell;
use std::pin::Pin;
use web_sys::KeyboardEvent;

/// How long a browser that does not say when it is idle is left alone, in milliseconds.
const QUIET_MS: i32 = 1_000;

/// Fetches the second piece; nothing if it does not come.
pub(crate) type FetchRest = fn() -> Pin<Box<dyn Future<Output = Option<LazyViews>>>>;

thread_local! {
    /// The way to fetch the second piece, which the top of the page knows: it alone names what is in it.
    static FETCH_REST: Cell<Option<FetchRest>> = const { Cell::new(None) };
}

/// The menus whose items come with the second piece.
#[derive(Clone, Copy)]
pub(crate) enum ToolMenu {
    Programs,
    Senses,
    Helpers,
}

/// The graph on the screen, as what is pasted finds it.
pub(crate) trait PasteTarget {
    /// Returns the place for what is pasted.
    fn paste_place(&self) -> Place;
    /// Returns what brings into view what is chosen then.
    fn reveal(&self) -> Box<dyn FnOnce()>;
}

/// The ways into the second piece.
#[derive(Clone, Copy)]
pub(crate) struct LazyViews {
    /// What stands in the frame of an open dialog, and the frame.
    pub(crate) dialog: fn(Dialog) -> AnyView,
    /// In the right column, the panel of this name.
    pub(crate) panel: fn(&str) -> AnyView,
    /// On the graph, what one of two compared versions has and the graph has not.
    pub(crate) shadows: fn() -> AnyView,
    /// Lays out a whole behaviour.
    pub(crate) tidy: Tidy,
    /// A connector as a control, with the ways to its dialog and to the bin or without.
    pub(crate) control: fn(Id, bool) -> AnyView,
    /// What can come after a stream, where a wire was dropped or on an edge.
    pub(crate) offer: fn() -> AnyView,
    /// On the graph, the frames of open groups, and the boxes of folded ones.
    pub(crate) frames: fn() -> AnyView,
    pub(crate) boxes: fn() -> AnyView,
    /// On the graph, notes.
    pub(crate) notes: fn() -> AnyView,
    /// In the right column, several things that are chosen.
    pub(crate) chosen: fn() -> AnyView,
    /// What can be done with several things together, a note or a group.
    pub(crate) several: fn() -> AnyView,
    /// What the open program does, in sentences.
    pub(crate) sentences_panel: fn() -> AnyView,
    /// On the graph, the parts that some words mean.
    pub(crate) lit: fn() -> AnyView,
    /// What is made of a sentence that is typed.
    pub(crate) typed: fn(SentenceField) -> AnyView,
    /// On the graph, what that would add.
    pub(crate) ghost: fn() -> AnyView,
    /// The goal of the exercise that the open program is of.
    pub(crate) exercise: fn(Exercise) -> AnyView,
    /// The tour.
    pub(crate) tour: fn() -> AnyView,
    /// The program as a list, in place of the graph.
    pub(crate) outline: fn() -> AnyView,
    /// Under what is selected on the graph, the next steps or the connector as a control.
    pub(crate) strip: fn() -> AnyView,
    /// In the right column, all problems.
    pub(crate) problems: fn() -> AnyView,
    /// The menu of what lies under the pointer.
    pub(crate) context: fn() -> AnyView,
    /// The same menu under a row of the list in place of the graph.
    pub(crate) row_menu: fn(On) -> AnyView,
    /// Keys with Control or Command on the graph, or on the list in its place; whether it was one.
    pub(crate) chord: fn(&KeyboardEvent, &Desk, Option<&dyn PasteTarget>) -> bool,
    /// Puts a pasted text in if it is a part of a program; whether it was.
    pub(crate) paste: fn(&Desk, Option<&dyn PasteTarget>, &str) -> bool,
    /// On the graph, what is wrong with what is selected, or has just become wrong.
    pub(crate) bubble: fn() -> AnyView,
    /// What is carried from the left list to the graph.
    pub(crate) carry: fn() -> AnyView,
    /// The whole graph in small.
    pub(crate) minimap: fn() -> AnyView,
    /// Whose changes the robot does not use yet, and the button that lets it.
    pub(crate) apply: fn() -> AnyView,
    /// In the menu of robots, all of them, and what can be done with the one that is looked at.
    pub(crate) robot_list: fn() -> AnyView,
    /// Shows how a run's recording goes, with the field for marks; without a recording only that field, which rests.
    pub(crate) recorded: fn(Option<Recorded>, RwSignal<String>) -> AnyView,
    /// The items of a menu of the bar.
    pub(crate) tool_items: fn(ToolMenu) -> AnyView,
    /// In the robot box, what runs together.
    pub(crate) running: fn() -> AnyView,
    /// What may happen in the simulated room.
    pub(crate) room_tools: fn() -> AnyView,
    /// What the robot's camera sees.
    pub(crate) camera: fn() -> AnyView,
    /// The texts and numbers that the robot was told to show.
    pub(crate) printed: fn() -> AnyView,
    /// On the graph, the field for another name of what stands there.
    pub(crate) name_field: fn(Id) -> AnyView,
    /// The field for one's name, which others see.
    pub(crate) asks_name: fn() -> AnyView,
    /// Which robot is meant, while another one answers.
    pub(crate) stranger: fn() -> AnyView,
    /// What is known of a selected stream or connector, and what can be done with it.
    pub(crate) selected: fn(Selected) -> AnyView,
}

/// A piece did not come, and another try.
#[component]
pub(crate) fn Failed(again: Callback<()>) -> impl IntoView {
    view! {
        <p>{words::not_loaded()}</p>
        <button class="button" type="button" data-first="" on:click=move |_| again.run(())>{words::try_again()}</button>
    }
}

/// Returns the second piece once it is here; nothing if it cannot be fetched.
async fn fetched() -> Option<LazyViews> {
    FETCH_REST.get()?().await
}

/// Does something once the second piece is here, a moment later if it is; works everywhere. Nothing if it cannot be fetched.
pub(crate) fn once_here(act: impl FnOnce() + 'static) {
    leptos::task::spawn_local(async move {
        if fetched().await.is_some() {
            act();
        }
    });
}

/// How fetching the second piece goes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fetching {
    /// Not begun, or over.
    Rests,
    Goes,
    /// It could not be fetched; it is tried again when it is wanted, or when the server is heard again.
    Failed,
}

/// The second piece of the page. A clone is the same.
#[derive(Clone)]
pub(crate) struct SecondPiece {
    rest: ArcRwSignal<Option<LazyViews>>,
    fetching: ArcRwSignal<Fetching>,
}

/// The second piece of this page; works where components are made.
pub(crate) fn second_piece() -> SecondPiece {
    expect_context::<SecondPiece>()
}

impl SecondPiece {
    /// A piece that is not fetched yet, and how it is fetched.
    pub(crate) fn new(how: FetchRest) -> Self {
        FETCH_REST.set(Some(how));
        Self { rest: ArcRwSignal::new(None), fetching: ArcRwSignal::new(Fetching::Rests) }
    }

    /// Fetches it quietly as soon as the page is usable, and again whenever the server is heard again; what nobody placed
    /// is laid out once it is here.
    pub(crate) fn serve(&self, desk: &Desk) {
        let (rest, document) = (self.rest.clone(), desk.document.clone());
        Effect::new(move |_| {
            if let Some(rest) = rest.get() {
                document.lay_out_with(rest.tidy);
            }
        });
        let (me, desk) = (self.clone(), desk.clone());
        Effect::new(move |_| {
            if desk.is_usable() && desk.online.get() == LinkState::Online {
                let me = me.clone();
                when_idle(move || me.fetch());
            }
        });
    }

    /// The ways into it, once it is here. Reactive.
    pub(crate) fn get(&self) -> Option<LazyViews> {
        self.rest.get()
    }

    /// The ways into it, if it is here.
    pub(crate) fn now(&self) -> Option<LazyViews> {
        self.rest.get_untracked()
    }

    /// Does something with it once it is here, at once if it is; with nothing if it cannot be fetched.
    pub(crate) fn when_here(&self, act: impl FnOnce(Option<LazyViews>) + 'static) {
        let me = self.clone();
        leptos::task::spawn_local(async move {
            let fetched = fetched().await;
            me.keep(fetched);
            act(fetched);
        });
    }

    /// Fetches it now, unless it is here or on its way.
    fn fetch(&self) {
        if self.rest.with_untracked(Option::is_some) || self.fetching.get_untracked() == Fetching::Goes {
            return;
        }
        self.fetching.set(Fetching::Goes);
        let me = self.clone();
        leptos::task::spawn_local(async move {
            let fetched = fetched().await;
            me.fetching.set(if fetched.is_some() { Fetching::Rests } else { Fetching::Failed });
            me.keep(fetched);
        });
    }

    /// Tells everybody who waits, once.
    fn keep(&self, fetched: Option<LazyViews>) {
        if fetched.is_some() && self.rest.with_untracked(Option::is_none) {
            self.rest.set(fetched);
        }
    }
}

/// Shows something of the second piece: nothing until that is here, and a sentence if it does not come.
#[component]
pub(crate) fn Later(show: impl Fn(LazyViews) -> AnyView + Send + 'static) -> impl IntoView {
    let piece = second_piece();
    move || piece.get().map_or_else(|| view! { <NotHere /> }.into_any(), &show)
}

/// In the place of something that is not here: fetches it; nothing while it comes, then why it does not, and another try.
#[component]
pub(crate) fn NotHere() -> impl IntoView {
    let piece = second_piece();
    piece.fetch();
    let failed = piece.fetching.clone();
    let again = Callback::new(move |()| piece.fetch());
    let sentence = move || (failed.get() == Fetching::Failed).then(|| view! { <Failed again /> });
    view! { <div class="not-here" role="alert">{sentence}</div> }
}

/// Does something once the browser has nothing else to do.
fn when_idle(act: impl FnOnce() + Clone + 'static) {
    if request_idle_callback(act.clone()).is_err() {
        browser::after(QUIET_MS, act);
    }
}
