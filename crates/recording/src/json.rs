//! Values as JSON.

use serde::Serialize;

/// Returns a value as JSON: floats bit for bit, whole numbers without a point.
pub fn json<T: Serialize + ?Sized>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}
