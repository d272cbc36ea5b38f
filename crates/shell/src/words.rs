//! The English sentences for something that was asked or typed and is not done.

use crate::refusal::{ExpectedAnswer, NotDone, NotFound};
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
            Self::Greeting(reply) => write!(to, "The server greets in a strange way: {reply:?}"),
            Self::NoList(reply) => write!(to, "The server gave no list of programs: {reply:?}"),
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
            Self::NoAnswer(wanted) => write!(to, "{wanted} Try again."),
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
        }
    }
}

/// Says that the answer did not come.
impl fmt::Display for ExpectedAnswer {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(match self {
            Self::Runs => "The server did not say what runs.",
            Self::Actions => "The server gave no actions.",
            Self::Programs => "The server gave no programs.",
            Self::Uses => "The server gave no uses.",
            Self::Check => "The server did not say how the robot is.",
            Self::Found => "The server gave no robots.",
            Self::Faces => "The server gave no faces.",
            Self::Recordings => "The server did not answer with a list.",
        })
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
