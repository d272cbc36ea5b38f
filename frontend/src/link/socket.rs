//! One WebSocket of the browser with its three events.

use wasm_bindgen::{JsCast, closure::Closure};
use web_sys::{CloseEvent, Event, MessageEvent, WebSocket};

/// An open or opening socket; dropped, it is closed and silent.
pub(super) struct Socket {
    web: WebSocket,
    opened: Closure<dyn FnMut(Event)>,
    heard: Closure<dyn FnMut(MessageEvent)>,
    closed: Closure<dyn FnMut(CloseEvent)>,
}

impl Socket {
    pub(super) fn open(
        url: &str,
        on_open: impl Fn() + 'static,
        on_text: impl Fn(&str) + 'static,
        on_close: impl Fn(u16) + 'static,
    ) -> Option<Self> {
        let web = WebSocket::new(url).ok()?;
        let opened = Closure::new(move |_: Event| on_open());
        let heard = Closure::new(move |event: MessageEvent| {
            if let Some(text) = event.data().as_string() {
                on_text(&text);
            }
        });
        let closed = Closure::new(move |event: CloseEvent| on_close(event.code()));
        web.set_onopen(Some(opened.as_ref().unchecked_ref()));
        web.set_onmessage(Some(heard.as_ref().unchecked_ref()));
        web.set_onclose(Some(closed.as_ref().unchecked_ref()));
        Some(Self { web, opened, heard, closed })
    }

    /// Whether it could be sent.
    pub(super) fn send(&self, text: &str) -> bool {
        self.web.ready_state() == WebSocket::OPEN && self.web.send_with_str(text).is_ok()
    }
}

impl Drop for Socket {
    fn drop(&mut self) {
        self.web.set_onopen(None);
        self.web.set_onmessage(None);
        self.web.set_onclose(None);
        let _ = self.web.close();
        // A closure that is running now (a socket is dropped in its own close event) must outlive its call.
        let late = (
            Self::take(&mut self.opened),
            std::mem::replace(&mut self.heard, Closure::new(|_| {})),
            std::mem::replace(&mut self.closed, Closure::new(|_| {})),
        );
        crate::browser::after(0, move || drop(late));
    }
}

impl Socket {
    fn take(closure: &mut Closure<dyn FnMut(Event)>) -> Closure<dyn FnMut(Event)> {
        std::mem::replace(closure, Closure::new(|_| {}))
    }
}
