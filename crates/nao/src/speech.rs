//! Speaking: a short queue, as the robot's own would pile up. The same text again, while it is said or last in the queue, is not
//! said twice.

use robot::Use;
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Most texts that wait.
const QUEUE_MAX: usize = 8;

/// A text and who wants it said.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SpeechRequest {
    pub(crate) text: String,
    users: Vec<Use>,
}

/// The voice.
#[derive(Default)]
pub(crate) struct Speech {
    /// The text that is said now.
    now: Option<SpeechRequest>,
    /// True if the rest of that text is left out.
    cut: Arc<AtomicBool>,
    waiting: VecDeque<SpeechRequest>,
}

impl Speech {
    /// Wants a text said; what is too much is left out.
    pub(crate) fn say(&mut self, text: String, user: &Use) {
        let last = if self.waiting.is_empty() { self.now.as_mut() } else { self.waiting.back_mut() };
        let same = match last {
            Some(last) if last.text == text => Some(last),
            _ => self.now.as_mut().filter(|now| now.text == text),
        };
        if let Some(same) = same {
            if !same.users.contains(user) {
                same.users.push(user.clone());
            }
        } else if self.waiting.len() < QUEUE_MAX {
            self.waiting.push_back(SpeechRequest { text, users: vec![user.clone()] });
        }
    }

    /// Returns what is to be said next, if nothing is said now, and what tells that the rest of it is left out.
    pub(crate) fn begin(&mut self) -> Option<(String, Arc<AtomicBool>)> {
        if self.now.is_none() {
            self.now = self.waiting.pop_front();
            self.cut = Arc::default();
            return self.now.as_ref().map(|wish| (wish.text.clone(), Arc::clone(&self.cut)));
        }
        None
    }

    /// The rest of what is said now is left out; true if the robot has to be told, which it is once.
    pub(crate) fn cut(&mut self) -> bool {
        self.now.is_some() && !self.cut.swap(true, Ordering::SeqCst)
    }

    /// Notes that what was said is over.
    pub(crate) fn over(&mut self) {
        self.now = None;
    }

    /// A use ends; true if what is said now is wanted by nobody else, and the robot has to be told.
    pub(crate) fn end(&mut self, user: &Use) -> bool {
        for wish in self.waiting.iter_mut().chain(self.now.as_mut()) {
            wish.users.retain(|other| other != user);
        }
        self.waiting.retain(|wish| !wish.users.is_empty());
        self.now.as_ref().is_some_and(|now| now.users.is_empty()) && self.cut()
    }

    /// Nothing waits any more.
    pub(crate) fn clear(&mut self) {
        self.waiting.clear();
    }

    /// Returns what is said now, or an empty text.
    pub(crate) fn saying(&self) -> &str {
        self.now.as_ref().map_or("", |wish| &wish.text)
    }
}

#[cfg(test)]
mod tests {
    use super::Speech;
    use behaviour::Id;
    use robot::Use;

    fn user(stream: &str) -> Use {
        Use { run: 1, stream: Id::new(stream).unwrap() }
    }

    #[test]
    fn the_same_words_are_not_said_twice_and_the_ninth_text_is_left_out() {
        let mut speech = Speech::default();
        speech.say("red".into(), &user("a"));
        assert_eq!(speech.begin().map(|(text, _)| text).as_deref(), Some("red"));
        speech.say("red".into(), &user("b"));
        assert!(speech.begin().is_none());
        assert!(!speech.end(&user("a")) && speech.end(&user("b")), "the last who wants it");
        assert!(!speech.cut(), "the robot is told once");
        for text in 0..20 {
            speech.say(text.to_string(), &user("a"));
        }
        speech.over();
        let said = std::iter::from_fn(|| {
            let text = speech.begin().map(|(text, _)| text);
            speech.over();
            text
        });
        assert_eq!(said.count(), 8);
    }
}
