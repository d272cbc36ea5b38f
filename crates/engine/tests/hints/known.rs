//! The knowledge that rules ask for, as a server has it: of the catalogue of devices and of procedures. Tests of several crates
//! share it.

use behaviour::{DeviceType, Helper, HelperCall, Knowledge, Params, Signature, StreamKind, ValueType};
use phrase::{Phrase, Phrased};

/// The catalogue, and procedures.
pub(crate) struct Known;

impl Knowledge for Known {
    fn device(&self, kind: StreamKind, device: &str, params: &Params) -> Result<(), Phrase> {
        robot::device(kind, device).and_then(|device| device.check(params)).map_err(|fault| fault.phrase())
    }

    fn body(&self, arguments: &[String], body: &str) -> Result<(), Phrase> {
        engine::check_body(arguments, body).map_err(|fault| fault.phrase())
    }

    fn device_type(&self, kind: StreamKind, device: &str, params: &Params) -> DeviceType {
        robot::device_type(kind, device, params)
    }

    fn result(&self, arguments: &[(String, ValueType)], body: &str, helper: HelperCall) -> ValueType {
        engine::result_type(arguments, body, helper)
    }

    fn signature(&self, helper: &Helper) -> Option<Signature> {
        robot::shipped_signature(helper)
    }

    fn misused(&self, arguments: &[(String, ValueType)], body: &str, helper: HelperCall) -> Option<(String, usize)> {
        engine::misused(arguments, body, helper)
    }

    fn stream_of(&self, helper: &str) -> Option<&'static str> {
        robot::helper_stream(helper)
    }

    fn unknown_name(
        &self,
        arguments: &[(String, ValueType)],
        body: &str,
        helpers: &[&str],
    ) -> Option<(String, Vec<String>)> {
        engine::unknown_name(arguments, body, helpers)
    }
}
