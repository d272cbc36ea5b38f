//! A field in which a sentence can be typed, beside names that are looked for.

use crate::browser::{self, clip};
use leptos::prelude::*;
use wasm_bindgen::JsCast;

/// A field in which a sentence can be typed.
#[derive(Clone, Copy)]
pub(crate) struct SentenceField {
    pub(crate) text: RwSignal<String>,
    /// True if the text is read as a sentence.
    pub(crate) open: RwSignal<bool>,
    /// The number of times that Enter was pressed.
    pub(crate) entered: RwSignal<u32>,
    /// The pixels by which the text is scrolled in its field.
    pub(crate) scrolled: RwSignal<i32>,
}

impl SentenceField {
    pub(crate) fn new() -> Self {
        let (entered, scrolled) = (RwSignal::new(0), RwSignal::new(0));
        Self { text: RwSignal::default(), open: RwSignal::new(false), entered, scrolled }
    }

    /// Several lines that are pasted are several sentences: a field of one line would run them together.
    pub(crate) fn paste(self, event: &web_sys::Event) {
        let Some(text) = clip(event).filter(|text| text.trim().contains('\n')) else { return };
        let Some(field) = event.target().and_then(|field| field.dyn_into::<web_sys::HtmlInputElement>().ok()) else {
            return;
        };
        event.prevent_default();
        let _ = field.set_range_text(&one_line(&text));
        self.text.set(field.value());
    }

    /// Sees how far the text is scrolled after something happened to its field.
    pub(crate) fn follow(self, event: &web_sys::Event) {
        let field = event.target().and_then(|target| target.dyn_into::<web_sys::HtmlElement>().ok());
        browser::after(0, move || {
            let scrolled = field.map_or(0, |field| field.scroll_left());
            if self.scrolled.try_get_untracked().is_some_and(|known| known != scrolled) {
                self.scrolled.set(scrolled);
            }
        });
    }
}

/// Lines as sentences of one line.
fn one_line(text: &str) -> String {
    let mut all = String::new();
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        all.push_str(line);
        if line.ends_with(|c: char| c.is_alphanumeric() || "\"”’'」』)".contains(c)) {
            all.push(if line.ends_with(|c| c > '\u{2e80}') { '。' } else { '.' });
        }
        all.push(' ');
    }
    all.truncate(all.trim_end().len());
    all
}

#[cfg(test)]
mod tests {
    use super::one_line;

    #[test]
    fn lines_become_sentences() {
        let text = "When the head is touched, wave\n\n  Every minute, say \"hi\"\r\nNod when you see me!\n";
        let one = "When the head is touched, wave. Every minute, say \"hi\". Nod when you see me!";
        assert_eq!(one_line(text), one);
        assert_eq!(
            one_line("頭を触ったら手を振る\n「やあ」と言われたら「やあ」と言う。"),
            "頭を触ったら手を振る。 「やあ」と言われたら「やあ」と言う。"
        );
    }
}
