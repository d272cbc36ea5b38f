//! Hearing what the server tells and only this page shows: the time of the run, what people press, marks.

use super::OperateShared;
use crate::{browser, link};
use leptos::prelude::*;
use protocol::{Event, request};

/// Hears it for as long as the page lives.
pub(super) fn overhear(op: OperateShared) {
    link::overhear(move |event| match event {
        Event::Values { values } if values.run == op.run_now() => {
            op.hear_time(values.run, values.at_ms);
        }
        Event::Pressed { press } => op.hear_press(press),
        Event::LiveMarks { run, at_ms, marks } => op.hear_marks((*run, *at_ms), marks),
        _ => {}
    });
    // The events that were told before this page listened come again.
    hear_anew(op);
    // Another run has marks of its own, also before the first of them is told; where nothing ran there are none.
    let newest = Memo::new(move |_| op.last().map_or(0, |run| run.run));
    Effect::new(move |_| op.belong_to(newest.get()));
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

/// Has the server tell the marks and values of the run anew.
pub(super) fn hear_anew(op: OperateShared) {
    link::ask(request::Watch { robot: op.desk.desk().robots.chosen_id(), scene: true, values: true }, |_| {});
}
