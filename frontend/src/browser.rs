//! What the page asks of its browser. Outside of one (host tests) everything answers with nothing.

use std::cell::RefCell;
use std::collections::HashMap;
use wasm_bindgen::{JsCast, JsValue, closure::Closure};
use wasm_bindgen_futures::JsFuture;
use web_sys::{
    CanvasRenderingContext2d, Element, HtmlCanvasElement, HtmlTextAreaElement, ResizeObserver, Storage, Window,
};

/// The window; none in tests on the host.
pub(crate) fn window() -> Option<Window> {
    if cfg!(target_arch = "wasm32") { web_sys::window() } else { None }
}

/// The text that the server has at an address; none if it has none, or is not there.
pub(crate) async fn text_at(address: &str) -> Option<String> {
    let answer = JsFuture::from(window()?.fetch_with_str(address)).await.ok()?;
    let answer: web_sys::Response = answer.dyn_into().ok()?;
    if !answer.ok() {
        return None;
    }
    JsFuture::from(answer.text().ok()?).await.ok()?.as_string()
}

/// Calls `seen` whenever the element has another size, and once soon. It is watched as long as it is in the page, or until
/// the answer is disconnected; no answer where the browser cannot watch.
pub(crate) fn watch_size(element: &Element, seen: impl FnMut() + 'static) -> Option<ResizeObserver> {
    let seen = Closure::<dyn FnMut()>::new(seen).into_js_value();
    let observer = ResizeObserver::new(seen.unchecked_ref()).ok()?;
    observer.observe(element);
    Some(observer)
}

/// Whether this person wants little motion.
pub(crate) fn is_calm() -> bool {
    let query = window().and_then(|window| window.match_media("(prefers-reduced-motion: reduce)").ok().flatten());
    query.is_some_and(|query| query.matches())
}

/// A whole number that the plain part of the page left for the program.
pub(crate) fn global_number(name: &str) -> Option<u64> {
    window()?;
    js_sys::Reflect::get(&js_sys::global(), &name.into()).ok()?.as_f64().map(|number| number as u64)
}

/// Milliseconds since the page was loaded.
pub(crate) fn now_ms() -> f64 {
    window().and_then(|window| window.performance()).map_or(0.0, |clock| clock.now())
}

/// Milliseconds since 1970 by this computer's clock.
pub(crate) fn today_ms() -> f64 {
    if cfg!(target_arch = "wasm32") { js_sys::Date::now() } else { 0.0 }
}

/// In which language days and times are said.
fn locale() -> &'static str {
    crate::words::language::spoken().locale
}

/// A time since 1970 as a day, in words: `12 Mar 2026`.
pub(crate) fn day_words(ms: f64) -> String {
    let options = js_sys::Object::new();
    for (part, shape) in [("day", "numeric"), ("month", "short"), ("year", "numeric")] {
        let _ = js_sys::Reflect::set(&options, &part.into(), &shape.into());
    }
    js_sys::Date::new(&ms.into()).to_locale_date_string(locale(), &options).into()
}

/// A time since 1970 as a day of the year, in words: `12 March`.
pub(crate) fn date_words(ms: f64) -> String {
    let options = js_sys::Object::new();
    for (part, shape) in [("day", "numeric"), ("month", "long")] {
        let _ = js_sys::Reflect::set(&options, &part.into(), &shape.into());
    }
    js_sys::Date::new(&ms.into()).to_locale_date_string(locale(), &options).into()
}

/// How much the clock on the wall here was ahead of UTC at a time since 1970, in milliseconds.
pub(crate) fn ahead_ms(ms: f64) -> f64 {
    if cfg!(target_arch = "wasm32") { -60_000.0 * js_sys::Date::new(&ms.into()).get_timezone_offset() } else { 0.0 }
}

/// A time since 1970 as the time of day, in words: `14:20`.
pub(crate) fn clock_words(ms: f64) -> String {
    let options = js_sys::Object::new();
    for part in ["hour", "minute"] {
        let _ = js_sys::Reflect::set(&options, &part.into(), &"2-digit".into());
    }
    js_sys::Date::new(&ms.into()).to_locale_time_string_with_options(locale(), &options).into()
}

/// A time since 1970 as the time of day with seconds, by the clock on the wall here: `14:20:05`.
pub(crate) fn clock_seconds(ms: f64) -> String {
    let seconds = ((ms + ahead_ms(ms)).rem_euclid(86_400_000.0) / 1_000.0) as u64;
    format!("{:02}:{:02}:{:02}", seconds / 3_600, seconds / 60 % 60, seconds % 60)
}

/// A number from 0 to 1.
pub(crate) fn random() -> f64 {
    if cfg!(target_arch = "wasm32") { js_sys::Math::random() } else { 0.5 }
}

/// Sets an attribute of an element outside of the program, if it is there.
pub(crate) fn set_attribute(id: &str, name: &str, value: &str) {
    let document = window().and_then(|window| window.document());
    if let Some(element) = document.and_then(|document| document.get_element_by_id(id)) {
        let _ = element.set_attribute(name, value);
    }
}

/// Whether the page is behind another one, or its window is away.
pub(crate) fn is_hidden() -> bool {
    window().and_then(|window| window.document()).is_some_and(|document| document.hidden())
}

/// Does something once, later.
pub(crate) fn after(ms: i32, act: impl FnOnce() + 'static) {
    let Some(window) = window() else { return };
    let act = Closure::once_into_js(act);
    let _ = window.set_timeout_with_callback_and_timeout_and_arguments_0(act.unchecked_ref(), ms);
}

/// Does something once what is being rendered is in the page: in the task after the one in which all effects of it run.
pub(crate) fn rendered(act: impl FnOnce() + 'static) {
    after(0, act);
}

/// Does something before the browser draws next, whatever becomes of the component that asked.
pub(crate) fn next_frame(act: impl FnOnce() + 'static) {
    if let Some(window) = window() {
        let _ = window.request_animation_frame(Closure::once_into_js(act).unchecked_ref());
    }
}

/// Does something again and again for as long as the page lives.
pub(crate) fn every(ms: i32, act: impl FnMut() + 'static) {
    let Some(window) = window() else { return };
    let act = Closure::<dyn FnMut()>::new(act).into_js_value();
    let _ = window.set_interval_with_callback_and_timeout_and_arguments_0(act.unchecked_ref(), ms);
}

/// Hears an event of the window or the document for as long as the page lives.
pub(crate) fn hear(target: &web_sys::EventTarget, event: &str, act: impl FnMut(JsValue) + 'static) {
    let act = Closure::<dyn FnMut(JsValue)>::new(act).into_js_value();
    let _ = target.add_event_listener_with_callback(event, act.unchecked_ref());
}

/// Something that is heard until this is dropped.
pub(crate) struct ListenerHandle {
    event: String,
    act: Closure<dyn FnMut(web_sys::Event)>,
}

/// Hears an event of the window before anybody else, and may keep it from them and from the browser.
pub(crate) fn hear_first(event: &str, act: impl FnMut(web_sys::Event) + 'static) -> ListenerHandle {
    let act = Closure::<dyn FnMut(web_sys::Event)>::new(act);
    if let Some(window) = window() {
        let how = web_sys::AddEventListenerOptions::new();
        how.set_capture(true);
        how.set_passive(false);
        let hears = act.as_ref().unchecked_ref();
        let _ = window.add_event_listener_with_callback_and_add_event_listener_options(event, hears, &how);
    }
    ListenerHandle { event: event.to_owned(), act }
}

impl Drop for ListenerHandle {
    fn drop(&mut self) {
        if let Some(window) = window() {
            let hears = self.act.as_ref().unchecked_ref();
            let _ = window.remove_event_listener_with_callback_and_bool(&self.event, hears, true);
        }
    }
}

/// Which drawer something is kept in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Drawer {
    /// As long as this tab.
    Tab,
    /// In this browser.
    Browser,
}

impl Drawer {
    fn storage(self) -> Option<Storage> {
        let window = window()?;
        let storage = match self {
            Self::Tab => window.session_storage(),
            Self::Browser => window.local_storage(),
        };
        storage.ok().flatten()
    }

    /// What is kept under a key.
    pub(crate) fn get(self, key: &str) -> Option<String> {
        self.storage()?.get_item(key).ok().flatten()
    }

    /// Keeps a text under a key.
    pub(crate) fn put(self, key: &str, text: &str) {
        if let Some(storage) = self.storage() {
            let _ = storage.set_item(key, text);
        }
    }

    /// Keeps nothing under a key any more.
    pub(crate) fn drop(self, key: &str) {
        if let Some(storage) = self.storage() {
            let _ = storage.remove_item(key);
        }
    }
}

/// The text that is pasted, unless it goes into a field.
pub(crate) fn pasted(event: &web_sys::Event) -> Option<String> {
    let target = event.target()?.dyn_into::<Element>().ok()?;
    if target.closest("input, textarea").ok().flatten().is_some() {
        return None;
    }
    clip(event)
}

/// The text of the clipboard that an event brings.
pub(crate) fn clip(event: &web_sys::Event) -> Option<String> {
    let data = js_sys::Reflect::get(event, &"clipboardData".into()).ok()?;
    let get = js_sys::Reflect::get(&data, &"getData".into()).ok()?.dyn_into::<js_sys::Function>().ok()?;
    get.call1(&data, &"text/plain".into()).ok()?.as_string()
}

/// Puts a text on the clipboard, also where the page came over plain HTTP; whether that worked. The keyboard stays where it
/// is.
pub(crate) fn copy(text: &str) -> bool {
    let Some(document) = window().and_then(|window| window.document()) else { return false };
    let before = document.active_element().and_then(|active| active.dyn_into::<web_sys::HtmlElement>().ok());
    let field = document.create_element("textarea").ok().and_then(|field| field.dyn_into::<HtmlTextAreaElement>().ok());
    let (Some(field), Some(body)) = (field, document.body()) else { return false };
    field.set_value(text);
    field.set_class_name("sr");
    let _ = body.append_child(&field);
    field.select();
    let command = js_sys::Reflect::get(&document, &"execCommand".into()).ok();
    let command = command.and_then(|command| command.dyn_into::<js_sys::Function>().ok());
    let done = command.and_then(|command| command.call1(&document, &"copy".into()).ok());
    field.remove();
    if let Some(before) = before {
        let _ = before.focus();
    }
    done.and_then(|done| done.as_bool()).unwrap_or_default()
}

/// The part of the address between `?` and `#`.
pub(crate) fn search() -> String {
    window().and_then(|window| window.location().search().ok()).unwrap_or_default()
}

/// Takes a part out of what stands between `?` and `#`, without a step that Back undoes.
pub(crate) fn drop_from_search(part: &str) {
    let search = search();
    let kept: Vec<&str> = search.trim_start_matches('?').split('&').filter(|other| *other != part).collect();
    let address = format!("?{}{}", kept.join("&"), hash());
    if let Some(history) = window().and_then(|window| window.history().ok()) {
        let _ = history.replace_state_with_url(&wasm_bindgen::JsValue::NULL, "", Some(&address));
    }
}

/// The part of the address after `#`.
pub(crate) fn hash() -> String {
    window().and_then(|window| window.location().hash().ok()).unwrap_or_default()
}

/// Changes the part after `#`, as a step that Back undoes.
pub(crate) fn set_hash(hash: &str) {
    if let Some(window) = window()
        && window.location().hash().is_ok_and(|now| now != hash && !(now.is_empty() && hash == "#/"))
    {
        let _ = window.location().set_hash(hash);
    }
}

/// The address of the socket on the server this page came from.
pub(crate) fn socket_url() -> Option<String> {
    let location = window()?.location();
    let scheme = if location.protocol().ok()? == "https:" { "wss" } else { "ws" };
    Some(format!("{scheme}://{}{}", location.host().ok()?, protocol::PATH))
}

/// How many measured texts are remembered.
const MEASURED_MAX: usize = 8_192;

thread_local! {
    static PEN: Option<CanvasRenderingContext2d> = pen();
    static MEASURED: RefCell<HashMap<(String, u32, u32), f64>> = RefCell::default();
}

fn pen() -> Option<CanvasRenderingContext2d> {
    let canvas = window()?.document()?.create_element("canvas").ok()?.dyn_into::<HtmlCanvasElement>().ok()?;
    canvas.get_context("2d").ok()??.dyn_into().ok()
}

/// How wide a text is in the page's own letters of some weight, at a size in pixels; none in tests on the host.
pub(crate) fn text_width(text: &str, weight: u32, size: u32) -> Option<f64> {
    window()?;
    let key = (text.to_owned(), weight, size);
    if let Some(known) = MEASURED.with(|measured| measured.borrow().get(&key).copied()) {
        return Some(known);
    }
    let width = PEN.with(|pen| measure(pen.as_ref()?, text, weight, size))?;
    MEASURED.with(|measured| {
        let mut measured = measured.borrow_mut();
        if measured.len() >= MEASURED_MAX {
            measured.clear();
        }
        measured.insert(key, width);
    });
    Some(width)
}

fn measure(pen: &CanvasRenderingContext2d, text: &str, weight: u32, size: u32) -> Option<f64> {
    let window = window()?;
    let body = window.document()?.body()?;
    let letters = window.get_computed_style(&body).ok()??.get_property_value("font-family").ok()?;
    pen.set_font(&format!("{weight} {size}px {letters}"));
    Some(pen.measure_text(text).ok()?.width())
}
