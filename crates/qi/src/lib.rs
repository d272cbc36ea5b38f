//! The qi protocol of libqi: values, calls and signals of services behind a TCP or TLS link.
//!
//! A [`Session`] connects to a service directory, logs in as the peer's generation wants it, and finds services. An
//! [`Object`] calls their methods by name, choosing overloads by the types of the arguments, and subscribes to signals.
//! A [`QiLink`] is what both stand on: one connection with bounded queues and its own ping.
//!
//! ```no_run
//! # async fn shown() -> Result<(), qi::QiError> {
//! let session = qi::Session::connect(&"tcp://192.168.1.20:9559".parse()?, qi::SessionOptions::default()).await?;
//! let speech = session.service("Speech").await?;
//! speech.call("say", &["Hello".into()]).await?;
//! # Ok(())
//! # }
//! ```
//!
//! Whatever a peer sends is data: malformed input is an error, never a panic, and takes no more memory than
//! [`FRAME_MAX_BYTES`] and [`VALUES_MAX`] allow. The format follows libqi 4.0.5, whose published description is out of date.
#![warn(missing_docs)]

mod address;
mod agreed;
mod auth;
mod choose;
mod error;
mod fingerprint;
mod link;
mod locked;
mod malformed;
mod meta;
mod object;
mod session;
mod signature;
mod tls;
mod value;
mod wire;

pub use address::{PeerAddress, Scheme};
pub use agreed::{Agreed, Generation};
pub use auth::Credentials;
pub use choose::ChosenMethod;
pub use error::{ConnectError, ConnectionStage, LinkEnding, QiError};
pub use fingerprint::Fingerprint;
pub use link::{
    CallAnswer, EventChoice, IN_FLIGHT_MAX, MemberTarget, QUEUE_MAX_BYTES, QUEUE_MAX_FRAMES, QiLink, SUBSCRIBERS_MAX,
    SignalEvent, Subscription, WAITING_MAX_BYTES,
};
pub use malformed::{DEPTH_MAX, Malformed, TypeMismatch, VALUES_MAX};
pub use meta::{MetaMethod, MetaObject, MetaSignal};
pub use object::{CALL_WITHIN, Object};
pub use session::{EndpointChoice, ServiceInfo, Session, SessionOptions, choose_endpoint};
pub use signature::{TupleNames, ValueSignature};
pub use tls::Trust;
pub use value::{Layout, ObjectRef, Value, decode, decode_arguments, encode, encode_arguments, fit};
pub use wire::{
    FLAG_DYNAMIC, FLAG_RETURN_SIGNATURE, FRAME_MAX_BYTES, Framer, HEADER_BYTES, MessageFrame, MessageHeader,
    MessageKind,
};
