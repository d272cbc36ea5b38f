//! Tells the others at which moment this person looks: the newest, at most ten times a second.

use super::{PastShared, clock};
use crate::{browser, link};
use leptos::prelude::*;
use protocol::{LookedMoment, request};
use std::time::Duration;

/// The least time between two messages, in milliseconds.
const TELL_MS: f64 = 100.0;
/// The time after which it is looked whether the others know the moment: a link may have been lost meanwhile.
const KNOWN_EVERY: Duration = Duration::from_millis(1_000);

/// The moment that the others were told last, and when.
#[derive(Clone, Copy)]
pub(super) struct TellState {
    told_ms: StoredValue<f64>,
    is_planned: StoredValue<bool>,
    /// None where nobody knows what they were told.
    told: StoredValue<Option<Option<LookedMoment>>>,
}

impl TellState {
    /// They were told nothing yet.
    pub(super) fn new() -> Self {
        Self { told_ms: StoredValue::new(0.0), is_planned: StoredValue::new(false), told: StoredValue::new(Some(None)) }
    }
}

impl PastShared {
    /// Tells the others at which moment this person looks, for as long as the panel is there.
    pub(super) fn tell_moments(self) {
        let looked = Memo::new(move |_| self.looked_moment());
        Effect::new(move |_| {
            // Read, as what is only tracked is never made.
            looked.with(|_| ());
            self.plan_telling();
        });
        let again = set_interval(
            move || {
                if !self.is_gone() && untrack(|| self.is_known()) == Some(false) {
                    self.telling.told.set_value(None);
                    self.plan_telling();
                }
            },
            KNOWN_EVERY,
        )
        .ok();
        on_cleanup(move || {
            if let Some(again) = again {
                again.clear();
            }
            if self.telling.told.try_get_value() != Some(Some(None)) {
                link::tell(request::PresentMoment { at: None });
            }
        });
    }

    /// The moment under the cursor; none while now is followed. Whoever follows somebody says with whom. Reactive.
    fn looked_moment(self) -> Option<LookedMoment> {
        let opened = self.opened.read();
        let (opened, viewer) = (opened.as_ref()?, self.viewer.read());
        if viewer.follows() {
            return None;
        }
        let at_ms = viewer.cursor().round() as u64 + opened.from_ms;
        let clock_ms = clock::began(opened) as u64 + at_ms;
        Some(LookedMoment { past: self.of.get_value()?, at_ms, clock_ms, with: self.desk.desk().looks_with.get() })
    }

    /// True if the server knows the moment; none if this person is in no program that the server tells of.
    fn is_known(self) -> Option<bool> {
        let desk = self.desk.desk();
        let me = desk.me.get()?.client;
        let known = desk
            .document
            .people
            .with(|people| people.iter().find(|person| person.client == me).map(|person| person.looks_at.is_some()))?;
        Some(known == self.looked_moment().is_some())
    }

    /// At once if the others were told long enough ago, else as soon as that is so.
    fn plan_telling(self) {
        let TellState { told_ms, is_planned, .. } = self.telling;
        if is_planned.get_value() {
            return;
        }
        let wait_ms = told_ms.get_value() + TELL_MS - browser::now_ms();
        if wait_ms <= 0.0 {
            return self.tell_moment();
        }
        is_planned.set_value(true);
        browser::after(wait_ms.ceil() as i32, move || {
            if !self.is_gone() {
                is_planned.set_value(false);
                self.tell_moment();
            }
        });
    }

    fn tell_moment(self) {
        let now = untrack(|| self.looked_moment());
        if link::is_up() && self.telling.told.with_value(|told| told.as_ref() != Some(&now)) {
            self.telling.told.set_value(Some(now.clone()));
            self.telling.told_ms.set_value(browser::now_ms());
            link::tell(request::PresentMoment { at: now });
        }
    }
}
