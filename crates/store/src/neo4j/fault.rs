//! The complaints of Neo4j and its driver, in the words of the store.

use crate::{Damage, StoreError, Unkept};
use neo4rs::{Error, Neo4jClientErrorKind, Neo4jError, Neo4jErrorKind};
use phrase::{Phrase, phrase};
use std::fmt::Display;
use std::io::ErrorKind;
use std::time::Duration;

/// Codes that the driver takes for lasting, but that another attempt gets past: somebody else deleted meanwhile what
/// this attempt had found.
const PASSING: [&str; 2] = ["Neo.ClientError.Statement.EntityNotFound", "Neo.ClientError.Transaction.Outdated"];

/// The reasons why an attempt failed.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Neo4jFault {
    /// Undone by Neo4j; it may go well the next time. With the reason.
    Passing(Phrase),
    /// The connection broke; whether it was done is open.
    Broken,
    /// There is no server.
    Away,
    /// No answer in time; whether it was done is open.
    Silent,
    /// It will not go well, whoever tries again.
    Said(StoreError),
}

impl Neo4jFault {
    /// Returns the fault of a database whose content cannot be what we wrote.
    pub(super) fn damaged(reason: &impl Display) -> Self {
        Self::Said(StoreError::Damaged(Damage::Neo4j(reason.to_string().into())))
    }
}

impl From<Error> for Neo4jFault {
    fn from(error: Error) -> Self {
        match error {
            Error::IOError { detail } if detail.kind() == ErrorKind::ConnectionRefused => Self::Away,
            Error::IOError { .. } | Error::IncompleteBoltExchange | Error::ConnectionTimedOut => Self::Broken,
            Error::ConnectionError => {
                Self::Passing(phrase!("store.all_connections_are_in_use", "all connections are in use"))
            }
            Error::Neo4j(error) => of_server(&error),
            Error::AuthenticationError(_) => unknown_user(),
            Error::DeserializationError(error) => Self::damaged(&error),
            Error::ConversionError | Error::StringTooLong | Error::MapTooBig | Error::ListTooLong => {
                Self::Said(StoreError::Refused(Unkept::TooLarge))
            }
            other => Self::Said(StoreError::Unavailable(format!("Neo4j: {other}").into())),
        }
    }
}

fn unknown_user() -> Neo4jFault {
    let why = "Neo4j refuses this user and password; check the store's address and RRP_NEO4J_PASSWORD";
    Neo4jFault::Said(StoreError::Unavailable(why.into()))
}

fn of_server(error: &Neo4jError) -> Neo4jFault {
    let (code, message) = (error.code(), error.message());
    if PASSING.contains(&code) {
        return Neo4jFault::Passing(message.into());
    }
    match error.kind() {
        Neo4jErrorKind::Transient | Neo4jErrorKind::Client(Neo4jClientErrorKind::SessionExpired) => {
            Neo4jFault::Passing(message.into())
        }
        Neo4jErrorKind::Client(Neo4jClientErrorKind::Security(_)) => unknown_user(),
        Neo4jErrorKind::Client(_) | Neo4jErrorKind::Database | Neo4jErrorKind::Unknown => {
            Neo4jFault::Said(refused(code, message))
        }
    }
}

/// The guard of a change divides by zero when one of its ends is missing; the rest is said by Neo4j itself.
fn refused(code: &str, message: &str) -> StoreError {
    let why = if code.ends_with("Statement.ArithmeticError") {
        Unkept::NoStream
    } else if code.ends_with("ConstraintValidationFailed") && message.contains("still has relationships") {
        Unkept::StreamUsed
    } else if message.contains("too large to index") {
        Unkept::LongName
    } else {
        return StoreError::Unavailable(format!("Neo4j says: {}", message.lines().next().unwrap_or(code)).into());
    };
    StoreError::Refused(why)
}

/// Says a fault when no further attempt is made.
pub(super) fn told(fault: Neo4jFault, server: &str, at_most: Duration) -> StoreError {
    let why = match fault {
        Neo4jFault::Said(error) => return error,
        Neo4jFault::Passing(reason) => phrase!("store.neo4j_at_is_too_busy", "Neo4j at {server} is too busy: {reason}"),
        Neo4jFault::Broken => phrase!("store.the_connection_to_neo4j_at", "the connection to Neo4j at {server} broke"),
        Neo4jFault::Away => phrase!("store.there_is_no_neo4j_at", "there is no Neo4j at {server}; start it"),
        Neo4jFault::Silent => {
            phrase!("store.neo4j_at_did_not_answer", "Neo4j at {server} did not answer within {} s", at_most.as_secs())
        }
    };
    StoreError::Unavailable(why)
}
