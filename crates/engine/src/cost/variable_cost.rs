//! The cost of a procedure's variables when it reads them again and again.
//!
//! Rhai copies the list that a variable holds in one step, however long the list is. So before it runs, a procedure is
//! read for how each of its variables is used; while it runs, every use costs by the size of the value then. What
//! certainly ends soon pays nothing here: without loops and closures each part is computed once.

mod reader;

use crate::cost::meter;
use rhai::{Dynamic, ImmutableString, Scope};
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// The uses of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum VariableUse {
    /// An item or field is read.
    Part,
    /// It is copied, or gone through, once in a call.
    Once,
    /// A function looks at it, or at a part of it.
    Touch,
    /// More is added to it.
    Grow,
    /// An item or field is put into it.
    Put,
    /// A letter is put into a text that it holds.
    Letter,
    /// It is copied.
    Copy,
    /// It is gone through or thrown, or a text is taken out of it.
    Through,
}

/// The cost of the variables of one procedure.
#[derive(Clone, Debug)]
pub(crate) struct VariableCost {
    /// Quarters of a step that each step counts.
    quarters: u64,
    /// True if a text may be gone through that a variable gave: its letters are taken one by one.
    texts_go_through: bool,
    /// By variable, in the order of their names; each use once.
    uses: Vec<(ImmutableString, Vec<VariableUse>)>,
}

/// Quarters of a step that a step counts.
pub(crate) const PLAIN_QUARTERS: u64 = 4;
/// Quarters that a step counts with closures: a call takes Rhai longer than a part does.
const CLOSURE_QUARTERS: u64 = 7;
/// Quarters that a step counts with a closure of hardly anything but the call.
const SMALL_CLOSURE_QUARTERS: u64 = 9;
/// Quarters that a step counts where errors are caught: they are told in words first.
const CATCH_QUARTERS: u64 = 15;
/// Quarters that a step counts with functions that are named: they are looked up at every call.
const NAMED_QUARTERS: u64 = 9;
/// Putting a letter into a text, or taking a text out of it.
const EDITED_BYTE_NANOS: usize = 14;
/// A copy that is made once in a call and costs less than this costs nothing.
const ONCE_NANOS: usize = 14_000;
/// Uses that cost less than this cost nothing.
const FREE_NANOS: usize = 128;

thread_local! {
    static QUARTERS: Cell<u64> = const { Cell::new(PLAIN_QUARTERS) };
    static COUNTS: Cell<bool> = const { Cell::new(false) };
    static CURRENT: RefCell<Option<Rc<VariableCost>>> = const { RefCell::new(None) };
}

/// While it lives, a procedure counts what its variables cost.
pub(crate) struct Counting;

impl Drop for Counting {
    fn drop(&mut self) {
        COUNTS.set(false);
        QUARTERS.set(PLAIN_QUARTERS);
        CURRENT.with(|current| current.borrow_mut().take());
    }
}

/// Quarters of a step that a step counts now.
#[inline]
pub(crate) fn quarters() -> u64 {
    QUARTERS.get()
}

/// Counts what a variable that is read costs.
#[inline]
pub(crate) fn read(name: &str, scope: &Scope) {
    if COUNTS.get() {
        count(name, scope);
    }
}

fn count(name: &str, scope: &Scope) {
    let Some(value) = scope.get(name).filter(|value| !meter::is_small(value)) else { return };
    CURRENT.with(|current| {
        let current = current.borrow();
        let Some(current) = current.as_ref() else { return };
        let uses = current.uses_of(name).iter().map(|kind| cost(value, *kind)).max();
        let letters = if current.texts_go_through { meter::text_bytes(value) * 3 / 2 } else { 0 };
        meter::owe(uses.unwrap_or(0).max(letters));
    });
}

/// Returns the cost of a use of a value, without what every step has time for.
fn cost(value: &Dynamic, kind: VariableUse) -> usize {
    whole_cost(value, kind).saturating_sub(FREE_NANOS)
}

fn whole_cost(value: &Dynamic, kind: VariableUse) -> usize {
    let bytes = meter::text_bytes(value);
    if bytes > 0 {
        return match kind {
            VariableUse::Part => bytes * 7 / 2,
            VariableUse::Copy | VariableUse::Grow => bytes / 16,
            VariableUse::Once => 0,
            VariableUse::Touch => bytes / 2,
            VariableUse::Put | VariableUse::Letter | VariableUse::Through => bytes * EDITED_BYTE_NANOS,
        };
    }
    match kind {
        VariableUse::Part => meter::largest_part(value),
        VariableUse::Once => meter::list_length(value) + meter::copying(value).saturating_sub(ONCE_NANOS),
        VariableUse::Touch | VariableUse::Grow | VariableUse::Put => meter::looking(value),
        VariableUse::Copy => meter::copying(value),
        VariableUse::Letter => meter::looking(value) + meter::longest_text(value) * EDITED_BYTE_NANOS,
        VariableUse::Through => meter::copying(value) * 2 + meter::longest_text(value) * EDITED_BYTE_NANOS,
    }
}

impl VariableCost {
    /// Adds what variables cost in a helper that is called.
    pub(crate) fn add(&mut self, helper: &Self) {
        self.quarters = self.quarters.max(helper.quarters);
        self.texts_go_through |= helper.texts_go_through;
        for (name, kinds) in &helper.uses {
            kinds.iter().for_each(|kind| self.used(name, *kind));
        }
    }

    /// Lets each step count so many steps more.
    pub(crate) fn lengthen(&mut self, steps: u64) {
        self.quarters = self.quarters.saturating_add(steps.saturating_mul(PLAIN_QUARTERS));
    }

    /// Returns the place of a variable; the error is where it belongs.
    fn place(&self, name: &str) -> Result<usize, usize> {
        self.uses.binary_search_by(|(known, _)| known.as_str().cmp(name))
    }

    fn uses_of(&self, name: &str) -> &[VariableUse] {
        self.place(name).map_or(&[], |at| &self.uses[at].1)
    }

    fn used(&mut self, name: &ImmutableString, kind: VariableUse) {
        let at = self.place(name).unwrap_or_else(|at| {
            self.uses.insert(at, (name.clone(), Vec::new()));
            at
        });
        let kinds = &mut self.uses[at].1;
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }

    /// Begins to count for a procedure.
    pub(crate) fn begin(self: &Rc<Self>) -> Counting {
        QUARTERS.set(self.quarters);
        COUNTS.set(true);
        CURRENT.with(|current| *current.borrow_mut() = Some(self.clone()));
        Counting
    }
}
