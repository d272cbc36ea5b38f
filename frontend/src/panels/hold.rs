//! The desk as something that closures can copy, and doing things a little later.

use crate::browser;
use crate::desk::{Desk, use_desk};
use leptos::prelude::*;
use std::cell::Cell;
use std::rc::Rc;

/// The desk, for the closures of one component.
#[derive(Clone, Copy)]
pub(crate) struct Hold(StoredValue<Desk, LocalStorage>);

/// The desk, held by the component that is being made.
pub(crate) fn hold() -> Hold {
    Hold(StoredValue::new_local(use_desk()))
}

impl Hold {
    /// The desk itself.
    pub(crate) fn desk(self) -> Desk {
        self.0.get_value()
    }
}

/// Does the same thing again soon after each call, but never twice within its time.
#[derive(Clone)]
pub(crate) struct Soon {
    waits: Rc<Cell<bool>>,
    act: Rc<dyn Fn()>,
}

impl Soon {
    /// What shall be done.
    pub(crate) fn new(act: impl Fn() + 'static) -> Self {
        Self { waits: Rc::default(), act: Rc::new(act) }
    }

    /// Does it within `ms`, once for all calls until then.
    pub(crate) fn within(&self, ms: i32) {
        if self.waits.replace(true) {
            return;
        }
        let me = self.clone();
        browser::after(ms, move || {
            me.waits.set(false);
            (me.act)();
        });
    }
}
