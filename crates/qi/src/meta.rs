//! The abilities of an object, as it tells them itself: methods, signals and properties with their numbers and types.

use crate::signature::ValueSignature;

/// A method.
#[derive(Debug, Clone, PartialEq)]
pub struct MetaMethod {
    /// The action that calls it. Another one in another version or after the service came back.
    pub uid: u32,
    /// The name of the method; several methods may share it.
    pub name: String,
    /// The type of what it returns.
    pub returns: ValueSignature,
    /// The types of its arguments: a tuple, or any type for a method that takes anything.
    pub parameters: ValueSignature,
    /// The purpose of the method, in its author's words; often empty.
    pub description: String,
}

/// A signal or a property.
#[derive(Debug, Clone, PartialEq)]
pub struct MetaSignal {
    /// The action that its events carry.
    pub uid: u32,
    /// The name of the signal or property.
    pub name: String,
    /// The type: of a signal the types of what its events carry, a tuple; of a property the type of its value.
    pub signature: ValueSignature,
}

/// The methods, signals and properties of an object.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MetaObject {
    /// Methods, by their numbers.
    pub methods: Vec<MetaMethod>,
    /// Signals, by their numbers.
    pub signals: Vec<MetaSignal>,
    /// Properties, by their numbers. Each may be a signal of the same number too.
    pub properties: Vec<MetaSignal>,
    /// The purpose of the object, in its author's words; often empty.
    pub description: String,
}

impl MetaObject {
    /// The signal of this name, or the property whose changes are told as one.
    pub fn signal(&self, name: &str) -> Option<&MetaSignal> {
        self.signals.iter().chain(&self.properties).find(|signal| signal.name == name)
    }

    /// The property of this name.
    pub fn property(&self, name: &str) -> Option<&MetaSignal> {
        self.properties.iter().find(|property| property.name == name)
    }
}
