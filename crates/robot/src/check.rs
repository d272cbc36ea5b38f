//! Checks what was chosen for a device.

use crate::{Device, DeviceFault, Param, ParamKind};
use behaviour::{Params, Value};

impl Device {
    /// Checks that these parameters fit: known names, right kinds, inside their ranges.
    ///
    /// # Errors
    /// The first parameter that does not fit.
    pub fn check(&self, params: &Params) -> Result<(), DeviceFault> {
        for (name, value) in params {
            let param = self.params.iter().find(|param| param.name == name);
            param.ok_or_else(|| DeviceFault::NoParam(name.clone()))?.check(self, value)?;
        }
        Ok(())
    }
}

impl Param {
    fn check(&self, of: &Device, value: &Value) -> Result<(), DeviceFault> {
        let label = || of.param_called(self);
        match self.kind {
            ParamKind::Choice(options) if options.iter().any(|option| value.as_text() == Some(option.0)) => Ok(()),
            ParamKind::Choice(options) => {
                let choices = options.iter().map(|option| of.choice_called(self, *option)).collect();
                Err(DeviceFault::Choice(label(), choices))
            }
            ParamKind::Number { min, max, .. } if value.as_number().is_some_and(|n| (min..=max).contains(&n)) => Ok(()),
            ParamKind::Number { min, max, unit, .. } => {
                Err(DeviceFault::Number { label: label(), min, max, unit: of.unit_called(self, unit) })
            }
            ParamKind::Text { max_chars, .. } => match value.as_text() {
                Some(text) if text.chars().count() <= max_chars => Ok(()),
                Some(_) => Err(DeviceFault::TooLong(label(), max_chars)),
                None => Err(DeviceFault::Text(label())),
            },
        }
    }
}
