//! The form of one tile, and where it stands among the others.

use super::draft::{HAND, MOMENT, PRETEND, SPAN, TileDraft, WORD, senses};
use super::{TilesShared, focused, picture};
use crate::dialogs::Refused;
use crate::fields::{Choice, ChoiceOptions, ParamFields, Select, TextField};
use crate::operate::words;
use crate::robots::{ToldParts, ValueFields};
use behaviour::{StreamKind, TILE_KEYS, TILE_MAX_CHARS, Tile};
use leptos::prelude::*;

/// The state of the form. A copy is the same form.
#[derive(Clone, Copy)]
struct TileEditing {
    shared: TilesShared,
    draft: TileDraft,
    /// The place of the tile, which others can move.
    key: RwSignal<u8>,
    /// The tile as this person saw it.
    seen: RwSignal<Option<Tile>>,
    /// The tile that is there now.
    now: Memo<Option<Tile>>,
    refusal: RwSignal<Option<String>>,
    busy: RwSignal<bool>,
}

impl TileEditing {
    fn new(shared: TilesShared, key: u8) -> Self {
        let tile = shared.pad.with_untracked(|pad| pad.tiles.get(&key).cloned());
        let draft = TileDraft::new(shared.desk, tile.as_ref());
        draft.word_itself();
        let key = RwSignal::new(key);
        let now = Memo::new(move |_| shared.pad.with(|pad| pad.tiles.get(&key.get()).cloned()));
        let (refusal, busy) = (RwSignal::new(None), RwSignal::new(false));
        Self { shared, draft, key, seen: RwSignal::new(tile), now, refusal, busy }
    }

    /// True if somebody else made something else of the tile meanwhile. Reactive.
    fn is_another(self) -> bool {
        !self.busy.get() && self.now.get() != self.seen.get()
    }

    /// Goes with the tile where somebody moves it.
    fn follow_moves(self) {
        Effect::new(move |_| {
            let (now, seen) = (self.now.get(), self.seen.get());
            // While one's own is being saved the tile is another one here already.
            if self.busy.get() || now == seen || seen.is_none() {
                return;
            }
            let at = self
                .shared
                .pad
                .with(|pad| pad.tiles.iter().find(|(_, tile)| Some(*tile) == seen.as_ref()).map(|(key, _)| *key));
            if let Some(at) = at {
                self.key.set(at);
                let label = seen.map(|tile| tile.label).unwrap_or_default();
                self.shared.said.set(words::tile_is_saved(&label, at));
            }
        });
    }

    /// While this form is open and not being saved, no comparison takes its place.
    fn hold_words(self) {
        let desk = self.shared.desk;
        Effect::new(move |_| {
            let is_written = !self.busy.get();
            desk.desk().writes_tile.set(is_written);
        });
        on_cleanup(move || desk.desk().writes_tile.set(false));
    }

    fn save(self) {
        if untrack(|| self.is_another()) {
            return self.refusal.set(Some(words::decide_tile_first().to_owned()));
        }
        match untrack(|| self.draft.tile()) {
            Ok(tile) => self.put(Some(tile)),
            Err(why) => self.refusal.set(Some(words::unfilled(&why))),
        }
    }

    /// Puts this tile, or none, in its place.
    fn put(self, tile: Option<Tile>) {
        let (key, seen, desk) = (self.key.get_untracked(), self.seen.get_untracked(), self.shared.desk.desk());
        let said = match &tile {
            Some(tile) => words::tile_is_saved(&tile.label, key),
            None => words::tile_is_away(key),
        };
        let waiting = said.clone();
        self.refusal.set(None);
        self.busy.set(true);
        let waits = !desk.document.can_save();
        let document = desk.document.clone();
        document.put_tile(key, (seen, tile), move |answer| match answer {
            // Whoever left the form meanwhile is elsewhere.
            answer if self.busy.try_set(false).is_some() => desk.say_refusal(answer),
            Ok(()) => self.shared.back(key, said),
            Err(no) => {
                self.refusal.set(Some(words::told_by(&no)));
                desk.notice.set(None);
            }
        });
        if waits {
            self.shared.back(key, waiting);
        }
    }

    /// Changes places with the tile before or after it.
    fn change_place(self, to: Option<u8>) {
        let Some(to) = to.filter(|to| TILE_KEYS.contains(to)) else { return };
        let document = self.shared.desk.desk().document.clone();
        let from = self.key.get_untracked();
        document.swap_tiles(from, to, move |answer| {
            if let Err(no) = answer {
                let _ = self.refusal.try_set(Some(words::told_by(&no)));
                // The tile stays where it was, and so does what is written of it.
                self.key.try_update(|key| *key = if *key == to { from } else { *key });
            }
        });
    }
}

/// The form.
#[component]
pub(super) fn TileForm(shared: TilesShared, key: u8) -> impl IntoView {
    let editing = TileEditing::new(shared, key);
    let draft = editing.draft;
    editing.follow_moves();
    editing.hold_words();
    shared.save.set_value(Some(Callback::new(move |()| editing.save())));
    let kinds = [(HAND, words::tile_by_hand()), (PRETEND, words::tile_pretends()), (WORD, words::tile_marks())];
    let does = move || match draft.kind.read().as_str() {
        PRETEND => view! { <PretendFields draft /> }.into_any(),
        WORD => view! { <WordFields draft /> }.into_any(),
        _ => view! { <HandFields draft /> }.into_any(),
    };
    let asks = move || {
        (*draft.kind.read() != WORD).then(|| {
            view! {
                <label class="radio">
                    <input type="checkbox" prop:checked=move || draft.asks.get()
                        on:change:target=move |event| draft.asks.set(event.target().checked()) />
                    {words::tile_asks()}
                </label>
            }
        })
    };
    view! {
        <div class="dialog-body" node_ref=focused()>
            <Top editing />
            <Meanwhile editing />
            <Choice label=words::tile_does() options=options(&kinds) value=draft.kind side_by_side=true />
            {does}
            <div on:input=move |_| draft.is_worded.set(true)>
                <TextField label=words::tile_words() value=draft.label max_chars=TILE_MAX_CHARS hint=words::at_most_chars(TILE_MAX_CHARS) />
            </div>
            {asks}
            <Refused why=editing.refusal />
        </div>
        <FormFeet editing />
    }
}

fn options(all: &[(&str, &str)]) -> ChoiceOptions {
    all.iter().map(|(key, words)| ((*key).to_owned(), (*words).to_owned())).collect()
}

/// The tile as the operator will see it, and the ways to another place.
#[component]
fn Top(editing: TileEditing) -> impl IntoView {
    let draft = editing.draft;
    let (first, last) = (*TILE_KEYS.start(), *TILE_KEYS.end());
    let shown = move || {
        let tile = draft.tile().ok().or_else(|| editing.seen.get());
        tile.map(|tile| picture(editing.shared.desk, &tile, editing.key.get()))
    };
    let is_there = move || editing.now.read().is_some();
    let ends = move |end: u8| (editing.key.get() == end).then_some("true");
    view! {
        <div class="tile-top">
            <div class="tile" class:empty=move || draft.tile().is_err()>{shown}</div>
            <div class="tile-place">
                <p class="second">{move || words::tile_place(editing.key.get(), last)}</p>
                <Show when=is_there>
                    <div class="row">
                        <button class="button small" type="button" aria-disabled=move || ends(first)
                            on:click=move |_| editing.change_place(editing.key.get_untracked().checked_sub(1))>{words::tile_earlier()}</button>
                        <button class="button small" type="button" aria-disabled=move || ends(last)
                            on:click=move |_| editing.change_place(editing.key.get_untracked().checked_add(1))>{words::tile_later()}</button>
                    </div>
                </Show>
            </div>
        </div>
    }
}

/// Somebody else made something else of this tile: what is written here stays until this person decides.
#[component]
fn Meanwhile(editing: TileEditing) -> impl IntoView {
    let another = Memo::new(move |_| editing.is_another());
    let says = move || match editing.now.get() {
        Some(tile) => words::tile_changed_meanwhile(&tile.label),
        None => words::tile_taken_meanwhile().to_owned(),
    };
    let keep = move |_| {
        editing.refusal.set(None);
        editing.seen.set(editing.now.get_untracked());
    };
    let take = move |_| {
        let now = editing.now.get_untracked();
        editing.refusal.set(None);
        editing.draft.fill(now.as_ref());
        editing.seen.set(now);
    };
    view! {
        <div role="status">
            <Show when=move || another.get()>
                <div class="held">
                    <p>{says}</p>
                    <div class="row">
                        <button class="button" type="button" on:click=keep>{words::keep_mine()}</button>
                        <button class="button" type="button" on:click=take>{words::take_theirs()}</button>
                    </div>
                </div>
            </Show>
        </div>
    }
}

/// An action of the robot: which one, and its parameters as everywhere.
#[component]
fn HandFields(draft: TileDraft) -> impl IntoView {
    let chosen = RwSignal::new(draft.device.get_untracked());
    Effect::new(move |before: Option<String>| {
        let name = chosen.get();
        if before.is_some_and(|before| before != name) {
            draft.choose_action(&name);
        }
        name
    });
    let all = robot::actuators().map(|action| (action.name.to_owned(), words::device(action).to_owned())).collect();
    let device = Memo::new(move |_| robot::device(StreamKind::Actuator, &draft.device.read()).ok());
    let says = move || device.get().map(words::device_says);
    let params = Memo::new(move |_| draft.chosen_params().ok());
    let told = move || {
        let (device, params) = (device.get()?, params.get()?);
        Some(view! { <ToldParts device params told=draft.told /> })
    };
    view! {
        <div class="field">
            <Select label=words::tile_action() options=Signal::stored(all) value=chosen />
            <span class="faint">{says}</span>
        </div>
        {move || draft.params.get().map(|form| view! { <ParamFields form /> })}
        {told}
    }
}

/// A sense that is pretended: which one, and what it tells.
#[component]
fn PretendFields(draft: TileDraft) -> impl IntoView {
    let all = senses(&draft.behaviour());
    let now = draft.stream.get_untracked();
    let is_there = all.iter().any(|(id, _)| *id.as_str() == now);
    let mut options: ChoiceOptions = all.into_iter().map(|(id, name)| (id.to_string(), name)).collect();
    if !is_there && !now.is_empty() {
        options.insert(0, (now.clone(), words::sense_is_gone().to_owned()));
    }
    let none = options.is_empty();
    let chosen = RwSignal::new(now);
    Effect::new(move |before: Option<String>| {
        let id = chosen.get();
        if before.is_some_and(|before| before != id) {
            draft.choose_sense(&id);
        }
        id
    });
    let fields = move || {
        let (device, params) = draft.chosen_sense()?;
        let pressed = Callback::new(|()| {});
        Some(view! { <ValueFields device=Some(device) params told=draft.pretended send=pressed /> })
    };
    if none {
        return view! { <p class="second">{words::no_sense_here()}</p> }.into_any();
    }
    view! {
        <Select label=words::tile_sense() options=Signal::stored(options) value=chosen />
        {fields}
    }
    .into_any()
}

/// A word that marks.
#[component]
fn WordFields(draft: TileDraft) -> impl IntoView {
    let kinds = [(MOMENT, words::mark_moment()), (SPAN, words::mark_span())];
    view! {
        <TextField label=words::tile_word() value=draft.word max_chars=TILE_MAX_CHARS first=true />
        <Choice label=words::mark_lasts() options=options(&kinds) value=draft.lasts side_by_side=true />
    }
}

#[component]
fn FormFeet(editing: TileEditing) -> impl IntoView {
    let back = move |_| editing.shared.back(editing.key.get_untracked(), String::new());
    let waits = move || editing.busy.get();
    view! {
        <div class="dialog-feet">
            <Show when=move || editing.now.read().is_some()>
                <button class="button danger apart" type="button" disabled=waits
                    on:click=move |_| { editing.seen.set(editing.now.get_untracked()); editing.put(None); }>{words::take_tile_away()}</button>
            </Show>
            <button class="button" type="button" data-back="" on:click=back>{words::back_to_tiles()}</button>
            <button class="button primary" type="submit" disabled=waits>{words::save()}</button>
        </div>
    }
}
