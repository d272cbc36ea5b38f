//! The catalogue: every sense and action, declared once; palette, forms, checks and help are drawn from it.

use crate::device::Device;
use crate::devices;
use crate::params::DeviceFault;
use behaviour::StreamKind;

/// All senses, in the order people see them.
pub fn sensors() -> impl Iterator<Item = &'static Device> {
    devices::ALL.iter().copied().filter(|device| device.kind == StreamKind::Sensor)
}

/// All actions, in the order people see them.
pub fn actuators() -> impl Iterator<Item = &'static Device> {
    devices::ALL.iter().copied().filter(|device| device.kind == StreamKind::Actuator)
}

/// One device by kind and name.
///
/// # Errors
/// The kind and name that were asked for, if there is no such device.
pub fn device(kind: StreamKind, name: &str) -> Result<&'static Device, DeviceFault> {
    let found = devices::ALL.iter().copied().find(|device| device.kind == kind && device.name == name);
    found.ok_or_else(|| DeviceFault::Unknown(kind, name.to_owned()))
}
