//! The English sentences for something that was asked or typed and is not done.

use crate::moment::NoMoment;
use crate::refusal::{NotDone, NotFound};
use crate::{ClientError, NoLink};
use std::fmt;

impl fmt::Display for ClientError {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::No(no) => write!(to, "{no}"),
            Self::Link(why) => write!(to, "{why}"),
        }
    }
}

impl fmt::Display for NoLink {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoServer { url, error } => write!(to, "There is no rrp server at {url} ({error})."),
            Self::Silent(url) => write!(to, "The server at {url} does not answer."),
            Self::NotHost(url) => write!(
                to,
                "The server at {url} does not know you as its host. Do this as the user who runs it, on its computer."
            ),
            Self::Id(reason) => to.write_str(reason),
            Self::OtherAnswer => to.write_str(
                "The server answers something else than what was asked. Use the rrp of the server's version.",
            ),
            Self::Unanswered => to.write_str("The server does not answer. Try again."),
            Self::Awaited => to.write_str("What was awaited did not come."),
            Self::Ended => to.write_str("The connection has ended. Connect again."),
            Self::Closed => to.write_str("The connection was closed."),
            Self::Lost(error) => write!(to, "The connection was lost ({error}). Connect again."),
            Self::EndedByServer => to.write_str("The server ended the connection. Connect again."),
            Self::Unheard => {
                to.write_str("The server has been silent for too long. Look whether it runs, and connect again.")
            }
            Self::Restart => to.write_str("The server ended. Connect again when it is back."),
            Self::TooSlow => to.write_str("This connection was too slow for the server (resync). Connect again."),
            Self::Replaced => to.write_str("The same client connected again elsewhere (replaced)."),
            Self::EndedBecause(reason) => write!(to, "The server ended the connection ({reason})."),
        }
    }
}

impl fmt::Display for NoMoment {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(
            "this is no time; write milliseconds since Start, such as 4200, minutes and seconds since Start, such as \
             0:04.2, or the time of day of a recording, such as 12:04:17.2",
        )
    }
}

impl std::error::Error for NoMoment {}

impl fmt::Display for NotDone {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Trouble(trouble) => write!(to, "{trouble}"),
            Self::NoCommand(typed) => {
                write!(to, "There is no command “{typed}”. Type “show commands” to see all.")
            }
            Self::SeveralCommands { typed, names } => {
                write!(to, "“{typed}” could be one of these: {}. Type more of it.", names.join(", "))
            }
            Self::NotFound(why) => write!(to, "{why}"),
            Self::NotConnected => to.write_str("Not connected. Type “connect” first."),
            Self::NoProgram => to.write_str("No program is loaded. Type “load program NAME” first."),
            Self::NoStream => to.write_str("No stream is loaded. Type “load stream NAME” first."),
            Self::NoRobotName => to.write_str("Type “add robot NAME”, or “add robot NAME at ADDRESS” for a real one."),
            Self::NotReached(why) => write!(to, "The robot was not added. {why}"),
            Self::NotMoved(why) => write!(to, "The robot keeps its address. {why}"),
            Self::NoNewAddress => to.write_str("Type “reach robot NAME at ADDRESS”."),
            Self::NoStranger(name) => write!(to, "No other robot answers in the place of {name}."),
            Self::NoNewName => to.write_str("Type “rename robot NAME to NEW”."),
            Self::NoFaceOf => to.write_str("Type “forget face FACE of NAME”; “show faces NAME” shows what there is."),
            Self::NoWay => to.write_str("Type “order NAME up” or “order NAME down”."),
            Self::There(name) => write!(to, "{name} is there already."),
            Self::NeitherOnNorOff => to.write_str("Type “record on”, “record now” or “record off”."),
            Self::Seconds(most) => write!(to, "Type a number of seconds from 1 to {most}."),
            Self::Id(reason) | Self::NoSense(reason) => to.write_str(reason),
            Self::NoJson(error) => write!(
                to,
                "Type the value and the settings as JSON, such as \"Hello\" with {{\"speed\": 0.5}} ({error})."
            ),
            Self::NoExample(error) => write!(to, "{error}"),
            Self::NoAction => {
                to.write_str("Type “why ACTION”, “why ACTION at 0:04.2” or “why ACTION at 0:04.2 in RECORDING”.")
            }
            Self::NoTime(word) => write!(
                to,
                "“{word}” is no time. Type milliseconds since Start, such as 4200, minutes and seconds, such as 0:04.2, or \
                 the time of day, such as 12:04:17."
            ),
            Self::NotThen => to.write_str("It did not run at that time. Type a time since Start, such as 0:04.2."),
            Self::NeverRan => to.write_str("This program has not run yet. Type “start”, or “why ACTION in RECORDING”."),
        }
    }
}

impl fmt::Display for NotFound {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Nameless { what, names } => write!(to, "Which {what}? {}", choices(what, names)),
            Self::Several { wanted, names } => {
                write!(to, "“{wanted}” could be one of these: {}. Type more of the name.", names.join(", "))
            }
            Self::Unknown { what, wanted, names } => {
                write!(to, "There is no {what} “{wanted}”. {}", choices(what, names))
            }
        }
    }
}

fn choices(what: &str, names: &[String]) -> String {
    if names.is_empty() { format!("There is no {what} yet.") } else { format!("There are: {}.", names.join(", ")) }
}
