//! The quiet parts: words that are heard and not seen, words in passing, and a screen that stays on.

use super::OperateShared;
use crate::browser;
use crate::operate::words;
use js_sys::{Function, Reflect};
use leptos::prelude::*;
use wasm_bindgen::{JsCast, JsValue};

/// The time for which a sentence stays, in milliseconds; a refusal stays longer.
const STAYS_MS: i32 = 4_000;
const REFUSAL_STAYS_MS: i32 = 12_000;

/// The last sentence for the person.
#[component]
pub(super) fn Said(op: OperateShared) -> impl IntoView {
    let desk = op.desk;
    let notice = Memo::new(move |_| desk.desk().notice.get());
    Effect::new(move |_| {
        if let Some(shown) = notice.get() {
            let signal = desk.desk().notice.clone();
            browser::after(if shown.bad { REFUSAL_STAYS_MS } else { STAYS_MS }, move || {
                if signal.get_untracked().is_some_and(|now| now.number == shown.number) {
                    signal.set(None);
                }
            });
        }
    });
    view! {
        <p class="sr" role="status">{move || desk.desk().whisper.get()}</p>
        <div class="op-said" role="status">
            {move || notice.get().map(|notice| view! {
                <p class="notice" class:bad=notice.bad>
                    <span>{notice.text}</span>
                    <button class="button small" type="button" on:click=move |_| desk.desk().notice.set(None)>{words::close()}</button>
                </p>
            })}
        </div>
    }
}

/// Keeps the screen on for as long as the page is seen: a lock ends whenever the page is hidden.
pub(super) fn stay_awake(_: OperateShared) {
    keep_on();
    if let Some(document) = browser::window().and_then(|window| window.document()) {
        browser::hear(&document, "visibilitychange", |_| {
            if !browser::is_hidden() {
                keep_on();
            }
        });
    }
}

/// Asks for the lock; a browser that has none, or gives none on a low battery, lets the screen go off as ever.
fn keep_on() {
    let ask = || -> Result<js_sys::Promise, JsValue> {
        let navigator = browser::window().ok_or(JsValue::NULL)?.navigator();
        let lock = Reflect::get(&navigator, &"wakeLock".into())?;
        let request: Function = Reflect::get(&lock, &"request".into())?.dyn_into()?;
        request.call1(&lock, &"screen".into())?.dyn_into()
    };
    if let Ok(asked) = ask() {
        leptos::task::spawn_local(async move {
            let _ = wasm_bindgen_futures::JsFuture::from(asked).await;
        });
    }
}
