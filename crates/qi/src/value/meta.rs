//! Reading and writing what an object can do.

use super::{Decoder, Layout, bytes, count};
use crate::malformed::{Malformed, TypeMismatch};
use crate::meta::{MetaMethod, MetaObject, MetaSignal};

impl MetaObject {
    /// Reads what the method `metaObject` answers.
    ///
    /// # Errors
    /// Fails if the bytes are malformed.
    pub fn decode(bytes: &[u8]) -> Result<Self, Malformed> {
        Self::read(&mut Decoder::new(bytes, Layout::default()))
    }

    /// The bytes that the method `metaObject` answers with.
    ///
    /// # Errors
    /// [`TypeMismatch::TooLarge`].
    pub fn encode(&self) -> Result<Vec<u8>, TypeMismatch> {
        let mut out = Vec::new();
        self.write(&mut out)?;
        Ok(out)
    }

    pub(crate) fn read(from: &mut Decoder) -> Result<Self, Malformed> {
        Ok(Self {
            methods: from.several(method)?,
            signals: from.several(signal)?,
            properties: from.several(signal)?,
            description: from.lossy()?,
        })
    }

    pub(crate) fn write(&self, out: &mut Vec<u8>) -> Result<(), TypeMismatch> {
        count(self.methods.len(), out)?;
        for method in &self.methods {
            numbers(method.uid, out);
            for text in [&method.returns.to_string(), &method.name, &method.parameters.to_string(), &method.description]
            {
                bytes(text.as_bytes(), out)?;
            }
            // No names of parameters, no description of the result.
            count(0, out)?;
            bytes(&[], out)?;
        }
        for members in [&self.signals, &self.properties] {
            count(members.len(), out)?;
            for member in members {
                numbers(member.uid, out);
                bytes(member.name.as_bytes(), out)?;
                bytes(member.signature.to_string().as_bytes(), out)?;
            }
        }
        bytes(self.description.as_bytes(), out)
    }
}

/// The key of the map and the same number in its entry.
fn numbers(uid: u32, out: &mut Vec<u8>) {
    out.extend_from_slice(&uid.to_le_bytes());
    out.extend_from_slice(&uid.to_le_bytes());
}

fn method(from: &mut Decoder) -> Result<MetaMethod, Malformed> {
    let _key = from.u32()?;
    let uid = from.u32()?;
    let returns = from.signature()?;
    let name = from.lossy()?;
    let parameters = from.signature()?;
    let description = from.lossy()?;
    let _names_of_parameters = from.several(|from| Ok((from.text()?, from.text()?)))?;
    let _result = from.text()?;
    Ok(MetaMethod { uid, name, returns, parameters, description })
}

fn signal(from: &mut Decoder) -> Result<MetaSignal, Malformed> {
    let _key = from.u32()?;
    let uid = from.u32()?;
    let name = from.lossy()?;
    Ok(MetaSignal { uid, name, signature: from.signature()? })
}
