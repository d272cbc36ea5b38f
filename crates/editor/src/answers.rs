//! The server's answers to what the editor asked, or that there is none.

use crate::effect::{Announcement, Purpose};
use crate::{Editor, NoAnswer, typed};
use behaviour::Refusal;
use protocol::{AnyAnswer, Refused, answer};

/// The time until something that could not be done just now is asked again.
pub(crate) const AGAIN_MS: i32 = 1_000;

impl Editor {
    /// The server answered, or it was not reached, or the link broke before the answer came.
    pub fn hear_answer(&mut self, purpose: Purpose, answer: Result<AnyAnswer, NoAnswer>) {
        match purpose {
            Purpose::Open { behaviour, says } => match typed(answer) {
                Ok(opened) => self.hear_opened(opened),
                Err(NoAnswer::Refused(no)) => self.not_opened(&behaviour, &no, says),
                Err(NoAnswer::Unreachable) => {}
            },
            Purpose::Change(op) => match typed::<answer::Saved>(answer) {
                Ok(_) => self.answered(&op, Ok(())),
                Err(NoAnswer::Refused(no)) => self.answered(&op, Err(no)),
                Err(NoAnswer::Unreachable) => drop(self.queue.not_taken(&op)),
            },
            Purpose::Lock(number) => self.lock_answered(number, typed(answer)),
            Purpose::TakeOver => match typed::<answer::Locked>(answer) {
                Ok(locked) => self.hear_grant(&locked.grant),
                Err(why) => self.say_no_answer(why),
            },
            Purpose::LetMeEdit(number) => match typed::<answer::Asked>(answer) {
                Ok(answer::Asked { now_ms, asked }) => self.asked_for(number, now_ms, &asked),
                Err(why) => self.say_no_answer(why),
            },
            Purpose::Deed => {
                if let Err(why) = answer {
                    self.say_no_answer(why);
                }
            }
            Purpose::Nothing => {}
            Purpose::Newer => self.hear_newer(typed(answer)),
            Purpose::History { behaviour, before } => self.history_answered(behaviour, before, typed(answer)),
            Purpose::Log(reader) => self.log_answered(*reader, typed(answer).ok()),
        }
    }

    /// Tells a refusal, or that the server is not reached.
    fn say_no_answer(&mut self, why: NoAnswer) {
        self.say(match why {
            NoAnswer::Refused(no) => Announcement::Refused(no),
            NoAnswer::Unreachable => Announcement::Unreachable,
        });
    }
}

/// Returns true if what was refused may work in a moment.
#[must_use]
pub fn may_pass(no: &Refused) -> bool {
    matches!(no, Refused::Store(_) | Refused::TooFast | Refused::Change(Refusal::NotSaved(_)))
}
