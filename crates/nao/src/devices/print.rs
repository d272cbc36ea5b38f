//! Showing a value on the page.

use super::{Act, Driver, Opened};
use crate::deed::Deed;
use behaviour::Value;
use robot::RobotFault;

pub(super) const DRIVER: Driver = Driver { name: "Print", services: &[], joints: &[], open: |_| Opened::act(Print) };

/// Longest printed text in characters.
const PRINT_MAX_CHARS: usize = 200;

struct Print;

impl Act for Print {
    fn deed(&self, value: &Value) -> Result<Deed, RobotFault> {
        let text = value.as_text().map_or_else(|| value.to_string(), str::to_owned);
        Ok(Deed::Print(text.chars().take(PRINT_MAX_CHARS).collect()))
    }
}
