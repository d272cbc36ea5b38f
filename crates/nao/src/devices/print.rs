//! Showing a value on the page.

use super::{NaoDriver, OpenActuator, OpenDevice};
use crate::deed::Action;
use behaviour::Value;
use robot::RobotFault;

pub(super) const DRIVER: NaoDriver =
    NaoDriver { name: "Print", services: &[], joints: &[], open: |_| OpenDevice::act(Print) };

/// Longest printed text in characters.
const PRINT_MAX_CHARS: usize = 200;

struct Print;

impl OpenActuator for Print {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let text = value.as_text().map_or_else(|| value.to_string(), str::to_owned);
        Ok(Action::Print(text.chars().take(PRINT_MAX_CHARS).collect()))
    }
}
