//! The one error of the harness: a sentence, shown as it is when a test ends with it.

use std::fmt;

/// A failure, as a sentence.
pub struct Trouble(pub String);

/// A result with a sentence for an error.
pub type Outcome<T> = Result<T, Trouble>;

impl Trouble {
    /// A trouble that says `what` failed and why.
    pub(crate) fn of(what: &str, why: impl fmt::Display) -> Trouble {
        Trouble(format!("{what}: {why}"))
    }
}

impl fmt::Debug for Trouble {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.0)
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.0)
    }
}

impl std::error::Error for Trouble {}

impl From<String> for Trouble {
    fn from(sentence: String) -> Trouble {
        Trouble(sentence)
    }
}

impl From<&str> for Trouble {
    fn from(sentence: &str) -> Trouble {
        Trouble(sentence.to_owned())
    }
}

impl From<std::io::Error> for Trouble {
    fn from(error: std::io::Error) -> Trouble {
        Trouble(error.to_string())
    }
}

impl From<serde_json::Error> for Trouble {
    fn from(error: serde_json::Error) -> Trouble {
        Trouble(error.to_string())
    }
}

impl From<behaviour::BadId> for Trouble {
    fn from(bad: behaviour::BadId) -> Trouble {
        Trouble(bad.to_string())
    }
}

impl From<shell::ClientError> for Trouble {
    fn from(error: shell::ClientError) -> Trouble {
        Trouble(error.to_string())
    }
}

impl From<tokio_tungstenite::tungstenite::Error> for Trouble {
    fn from(error: tokio_tungstenite::tungstenite::Error) -> Trouble {
        Trouble(error.to_string())
    }
}

impl From<std::net::AddrParseError> for Trouble {
    fn from(error: std::net::AddrParseError) -> Trouble {
        Trouble(error.to_string())
    }
}

impl From<std::num::ParseIntError> for Trouble {
    fn from(error: std::num::ParseIntError) -> Trouble {
        Trouble(error.to_string())
    }
}

impl From<std::fmt::Error> for Trouble {
    fn from(error: std::fmt::Error) -> Trouble {
        Trouble(error.to_string())
    }
}
