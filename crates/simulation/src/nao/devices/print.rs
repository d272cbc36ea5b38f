//! Texts shown beside the room.

use super::{SimulatedAct, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{Printed, RobotFault, Use};

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "Print", open: |_| SimulatedDevice::act(Print) };

/// Texts shown; the oldest go first.
const PRINTED_MAX: usize = 20;
/// Longest printed text in characters.
const PRINT_MAX_CHARS: usize = 200;

#[derive(Debug)]
struct Print;

impl SimulatedAct for Print {
    fn moves(&self) -> bool {
        false
    }

    fn act(&self, nao: &mut SimulatedNao, user: &Use, value: &Value) -> Result<(), RobotFault> {
        let text = value.as_text().map_or_else(|| value.to_string(), str::to_owned);
        if nao.printed.len() >= PRINTED_MAX {
            nao.printed.pop_front();
        }
        let text = text.chars().take(PRINT_MAX_CHARS).collect();
        nao.printed.push_back(Printed { by: user.clone(), at_ms: nao.now, text });
        Ok(())
    }
}
