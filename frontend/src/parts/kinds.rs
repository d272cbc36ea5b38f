//! The looks of the kinds of streams: a class of the stylesheet, and the icon of a device.

use behaviour::{Stream, StreamKind};

/// The class of a kind of stream.
pub(crate) fn kind_class(kind: StreamKind) -> &'static str {
    match kind {
        StreamKind::Sensor => "sensor",
        StreamKind::Ordinary => "ordinary",
        StreamKind::Actuator => "actuator",
    }
}

/// The icon of a stream's device.
pub(crate) fn device_icon(stream: &Stream) -> Option<&'static str> {
    robot::device(stream.kind, stream.device.as_deref()?).ok().map(|device| device.icon)
}
