//! Hearing what the server tells and only this page shows: the time of the run, what people press, marks.

use super::OperateShared;
use super::clock;
use crate::{browser, link};
use leptos::prelude::*;
use protocol::Reply;

/// Hears it for as long as the page lives.
pub(super) fn overhear(op: OperateShared) {
    link::overhear(move |reply| match reply {
        Reply::Values { values } if values.run == op.run_now() => {
            let told = clock::began(op.began.get_untracked(), values.run, values.at_ms, browser::today_ms());
            if op.began.get_untracked() != Some(told) {
                op.began.set(Some(told));
            }
        }
        Reply::Pressed { press } => op.hear_press(press),
        _ => op.hear_marks(reply),
    });
    // Another run has marks of its own, also before the first of them is told.
    let newest = Memo::new(move |_| op.last().map(|run| run.run));
    Effect::new(move |_| {
        if let Some(run) = newest.get() {
            op.belong_to(run);
        }
    });
    // Until its first values say more, a run that begins before one's eyes begins now.
    Effect::new(move |before: Option<Option<u64>>| {
        let now = op.run().map(|run| run.run);
        if let Some(run) = now.filter(|_| before.is_some_and(|before| before != now))
            && op.began.get_untracked().is_none_or(|(known, _)| known != run)
        {
            op.began.set(Some((run, browser::today_ms())));
        }
        now
    });
}

impl OperateShared {
    /// The number of the run; none is 0.
    fn run_now(self) -> u64 {
        untrack(|| self.run()).map_or(0, |run| run.run)
    }
}
