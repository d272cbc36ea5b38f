//! Speaking: a short queue, and a log of what was said.

use crate::hash::{RunningHash, digest_use};
use crate::nao::devices::Voice;
use robot::{Millis, RobotFault, Use};
use std::collections::VecDeque;

/// Most texts that wait.
const QUEUE_MAX: usize = 8;
/// Longest text in characters.
const TEXT_MAX_CHARS: usize = 1_000;
/// Entries of the log; the oldest go first.
const LOG_MAX: usize = 100;
/// Speaking speed; our planning value, no figure is published for a NAO.
const WORDS_PER_MINUTE: u64 = 170;
/// A pause for a comma in milliseconds.
const COMMA_MS: u64 = 60;
/// The shortest utterance in milliseconds.
const SHORTEST_MS: u64 = 400;

/// Something that was said, or is being said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spoken {
    /// The words.
    pub text: String,
    /// When it began, in robot time.
    pub from: Millis,
    /// When it ended; none while it is being said.
    pub until: Option<Millis>,
    /// True if it was stopped before its end.
    pub cut: bool,
}

/// The voice.
#[derive(Default)]
pub(crate) struct Speech {
    ends: Option<u64>,
    /// The uses that want what is being said.
    users: Vec<Use>,
    waiting: VecDeque<QueuedSpeech>,
    log: Vec<Spoken>,
    /// The way in which it speaks, and the use that wants that.
    pub(crate) voice: Option<(Use, Voice)>,
}

/// A text that waits.
struct QueuedSpeech {
    text: String,
    /// The uses that want it said.
    users: Vec<Use>,
}

impl Speech {
    /// Says a text, or queues it. The same text again, while it is said or last in the queue, is not said twice.
    pub(crate) fn say(&mut self, text: &str, user: &Use, now: u64) -> Result<(), RobotFault> {
        let text = text.trim();
        if text.is_empty() {
            return Err(RobotFault::NothingToSay);
        }
        if text.chars().count() > TEXT_MAX_CHARS {
            return Err(RobotFault::TextTooLong(TEXT_MAX_CHARS));
        }
        if let Some(users) = self.users_of(text) {
            if !users.contains(user) {
                users.push(user.clone());
            }
            return Ok(());
        }
        if self.waiting.len() >= QUEUE_MAX {
            return Err(RobotFault::TextsWait(QUEUE_MAX));
        }
        self.waiting.push_back(QueuedSpeech { text: text.to_owned(), users: vec![user.clone()] });
        self.step(now);
        Ok(())
    }

    /// Returns the uses that want this text, if it is being said or the last one that waits.
    fn users_of(&mut self, text: &str) -> Option<&mut Vec<Use>> {
        if text == self.saying() {
            return Some(&mut self.users);
        }
        self.waiting.back_mut().filter(|last| last.text == text).map(|last| &mut last.users)
    }

    /// A use ends: what nobody else wants is not said, and cut if it is being said.
    pub(crate) fn end(&mut self, user: &Use, now: u64) {
        for wish in &mut self.waiting {
            wish.users.retain(|other| other != user);
        }
        self.waiting.retain(|wish| !wish.users.is_empty());
        let before = self.users.len();
        self.users.retain(|other| other != user);
        if self.ends.is_some() && self.users.is_empty() && before > 0 {
            self.finish(now, true);
        }
    }

    /// Returns what is being said, or an empty text.
    pub(crate) fn saying(&self) -> &str {
        match (self.ends, self.log.last()) {
            (Some(_), Some(last)) => &last.text,
            _ => "",
        }
    }

    /// Returns what was said, oldest first.
    pub(crate) fn log(&self) -> &[Spoken] {
        &self.log
    }

    /// Ends and begins what is due.
    pub(crate) fn step(&mut self, now: u64) {
        if self.ends.is_some_and(|ends| ends <= now) {
            self.finish(now, false);
        }
        if self.ends.is_none()
            && let Some(wish) = self.waiting.pop_front()
        {
            self.begin(wish, now);
        }
    }

    /// Silent at once.
    pub(crate) fn stop(&mut self, now: u64) {
        self.waiting.clear();
        if self.ends.is_some() {
            self.finish(now, true);
        }
    }

    fn begin(&mut self, wish: QueuedSpeech, now: u64) {
        let QueuedSpeech { text, users } = wish;
        self.users = users;
        let speed = self.voice.as_ref().map_or(100, |(_, voice)| u64::from(voice.speed).max(1));
        self.ends = Some(now + duration_ms(&text) * 100 / speed);
        if self.log.len() >= LOG_MAX {
            self.log.remove(0);
        }
        self.log.push(Spoken { text, from: Millis(now), until: None, cut: false });
    }

    fn finish(&mut self, now: u64, cut: bool) {
        self.ends = None;
        self.users.clear();
        if let Some(last) = self.log.last_mut() {
            (last.until, last.cut) = (Some(Millis(now)), cut);
        }
    }

    /// Adds the queue and the log.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.whole(self.ends.unwrap_or_default());
        digest.count(self.waiting.len());
        self.users.iter().for_each(|user| digest_use(user, digest));
        for wish in &self.waiting {
            digest.text(&wish.text);
            wish.users.iter().for_each(|user| digest_use(user, digest));
        }
        if let Some((user, voice)) = &self.voice {
            digest_use(user, digest);
            digest.text(&format!("{voice:?}"));
        }
        digest.count(self.log.len());
        for spoken in &self.log {
            digest.text(&spoken.text);
            digest.whole(spoken.from.0);
            digest.whole(spoken.until.map_or(u64::MAX, |until| until.0));
            digest.truth(spoken.cut);
        }
    }
}

fn duration_ms(text: &str) -> u64 {
    let words = text.split_whitespace().count() as u64;
    let commas = text.matches(',').count() as u64;
    (words * 60_000 / WORDS_PER_MINUTE + commas * COMMA_MS).max(SHORTEST_MS)
}

#[cfg(test)]
mod tests {
    use super::Speech;
    use behaviour::Id;
    use robot::Use;

    fn user(stream: &str) -> Use {
        Use { run: 1, stream: Id::new(stream).expect("a short id") }
    }

    #[test]
    fn the_same_words_thirty_times_a_second_are_said_one_after_the_other_without_piling_up() {
        let mut speech = Speech::default();
        for now in (0..1_000).step_by(30) {
            speech.say("red", &user("a"), now).expect("present");
            speech.step(now);
        }
        assert_eq!(speech.log().len(), 3);
        assert!(speech.waiting.is_empty());
    }

    #[test]
    fn the_ninth_waiting_text_is_refused_and_stop_is_silence() {
        let mut speech = Speech::default();
        for text in 0..9 {
            speech.say(&text.to_string(), &user("a"), 0).expect("present");
        }
        assert!(speech.say("one more", &user("a"), 0).is_err());
        speech.stop(10);
        speech.step(20);
        assert_eq!((speech.saying(), speech.log().len(), speech.log()[0].cut), ("", 1, true));
        assert!(speech.say(" ", &user("a"), 20).is_err());
    }
}
