//! The desk as something that closures can copy, and doing things a little later.

use crate::browser;
use crate::desk::{Desk, use_desk};
use leptos::prelude::*;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// The desk, for the closures of one component.
#[derive(Clone, Copy)]
pub(crate) struct DeskHold(StoredValue<Desk, LocalStorage>);

thread_local! {
    /// The page has one desk. What a component began, like an answer that comes late, may outlive the component.
    static DESK: RefCell<Option<Desk>> = const { RefCell::new(None) };
}

/// The desk, held by the component that is being made.
pub(crate) fn hold() -> DeskHold {
    let desk = use_desk();
    DESK.with_borrow_mut(|kept| {
        kept.get_or_insert_with(|| desk.clone());
    });
    DeskHold(StoredValue::new_local(desk))
}

impl DeskHold {
    /// The desk itself.
    pub(crate) fn desk(self) -> Desk {
        let kept = || DESK.with_borrow(Option::clone);
        self.if_there().or_else(kept).unwrap_or_else(|| self.0.get_value())
    }

    /// The desk, unless the component that held it is gone.
    pub(crate) fn if_there(self) -> Option<Desk> {
        self.0.try_get_value()
    }
}

/// Does the same thing again soon after each call, but never twice within its time.
#[derive(Clone)]
pub(crate) struct Soon {
    waits: Rc<Cell<bool>>,
    act: Rc<dyn Fn()>,
}

impl Soon {
    /// The work that waits.
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
