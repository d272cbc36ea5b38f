//! What is said on standard error when a command fails, in English.

use crate::failure::{Failure, ListenConflict, TraceLineError, of_file};
use std::fmt;
use std::path::Path;
use store::backup::StoreDifference;
use store::files::{FILE_MAX_BYTES, FileFault};

/// A reading as it is written.
const READING: &str = "{\"t\":500,\"stream\":\"ball\",\"value\":1}";
/// Names that are shown to somebody who looks for another one.
const NAMES_MAX: usize = 10;

impl fmt::Display for ListenConflict {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::TwoOfAKind => to.write_str(
                "Say --listen once for this computer and once for others at most: one address of its own, such as \
                 127.0.0.1:7130, and one in the network.",
            ),
            Self::NoNetwork => to.write_str(
                "A certificate is for those who come from elsewhere. Say with --listen where they come in, or leave out \
                 --cert and --key.",
            ),
            Self::Address(said) => write!(
                to,
                "“{said}” is no address with a port. Write localhost:7130 for this computer, or the number of this computer \
                 in the network, such as 192.168.1.5:7130."
            ),
            Self::Origin(said) => {
                write!(to, "“{said}” is not what browsers reach the proxy by. Write it as https://rrp.example, without a path.")
            }
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NotStarted(error) => write!(to, "This could not start: {error}."),
            Self::ServerNotStarted(error) => write!(to, "The server could not start: {error}."),
            Self::Serve(error) => write!(to, "{error}"),
            Self::Listening(muddle) => write!(to, "{muddle}"),
            Self::NoHome => to.write_str("There is no home folder. Say where the data is with --data DIR."),
            Self::RelativeFolder(name, folder) => relative(name, folder, "say where the data is with --data DIR", to),
            Self::RelativeState(folder) => relative("XDG_STATE_HOME", folder, "unset it", to),
            Self::Store(error) => write!(to, "{error}"),
            Self::Busy(folder) => {
                write!(to, "A running rrp server uses {}. Stop it, then do this again.", folder.display())
            }
            Self::Backup(error) => write!(to, "{error}"),
            Self::Robots(why) => write!(to, "{why}"),
            Self::NoRobotsFolder => {
                to.write_str("There is no folder for the robots in the backup. Say one with --data DIR.")
            }
            Self::DataFolder(error) => {
                write!(to, "The data folder cannot be written ({error}). Look at the disk, then do this again.")
            }
            Self::Differences(all) => differences(all, to),
            Self::Unopened(path, error) => write!(to, "{} could not be opened: {error}.", path.display()),
            Self::Unwritten(path, error) => write!(to, "{} could not be written: {error}.", path.display()),
            Self::UnwrittenOut(error) => write!(to, "The file could not be written: {error}."),
            Self::InDoubt { words, suggestions, why } => in_doubt(words, suggestions, why.as_deref(), to),
            Self::Untold(error) => write!(to, "{error}"),
            Self::Unknown { wanted, names } => unknown(wanted, names, to),
            Self::Several { wanted, ids } => {
                write!(to, "Several behaviours are called “{wanted}”. Say which one by its id: {}.", ids.join(", "))
            }
            Self::Gone => to.write_str("The behaviour is gone. Choose another one."),
            Self::NoXml(why) => write!(to, "{why}"),
            Self::NoServer(folder) => write!(
                to,
                "No rrp server of yours runs on {}. Start one with `rrp serve`, or say with --data DIR on which folder it \
                 runs.",
                folder.display()
            ),
            Self::Silent(address, error) => {
                write!(to, "The rrp server at http://{address}/ does not answer ({error}). Look whether it runs.")
            }
            Self::CutOff(error) => {
                write!(to, "The rrp server stopped in the middle of its answer ({error}). Try again.")
            }
            Self::StrangeList(error) => {
                write!(to, "The rrp server gave a list that cannot be read ({error}). Is it of another version?")
            }
            Self::StrangeAnswer(error) => {
                write!(to, "The rrp server gave an answer that cannot be read ({error}). Is it of another version?")
            }
            Self::ServerSaysOf(path, error) => write!(to, "{}: {error}", path.display()),
            Self::TooLarge(path) => {
                write!(to, "{} is larger than {FILE_MAX_BYTES} bytes. Split it into several.", path.display())
            }
            Self::Faults(path, all) => faults(path, all, to),
            Self::Present(name) => {
                write!(to, "“{name}” is there already, perhaps in the bin. Import it without --restore to get a copy.")
            }
            Self::Unfit(why) => write!(to, "{why}"),
            Self::Refused(refusal) => write!(to, "{refusal}"),
            Self::Overtaken => to.write_str("Somebody else changed the store just now. Try again."),
            Self::Large(path, bytes) => write!(to, "{}: it is larger than {bytes} bytes", path.display()),
            Self::NoTrace(path, what) => write!(
                to,
                "{}: This is {what}, and here should be readings: one JSON object a line, such as {READING}, or a \
                 recording of a run.",
                path.display()
            ),
            Self::Engine(fault) => write!(to, "{fault}"),
            Self::EngineOfFile(fault) => write!(to, "{}", of_file(fault)),
            Self::Differs(different) => write!(to, "{different}"),
            Self::EndedOf(name, reason) => write!(to, "{name}: {reason}"),
            Self::Id(why) | Self::ServerSays(why) | Self::Ended(why) => to.write_str(why),
            Self::Record(why) => write!(to, "{why}"),
            Self::Traces { traces, behaviours } => {
                write!(to, "{traces} traces for {behaviours} behaviours; give one for all, or one for each")
            }
            Self::NoAnswer(why) => write!(to, "{why}"),
            Self::NoReadings => to.write_str("the trace has no readings; give it at least one line"),
            Self::TraceLine(number, why) => write!(to, "trace line {number}: {why}"),
            Self::RecordingLine(number, why) => write!(to, "recording line {number}: {why}"),
        }
    }
}

impl fmt::Display for TraceLineError {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoReading => write!(
                to,
                "this is no reading. Write one JSON object a line, such as {READING}: t in milliseconds since Start, stream \
                 the id of a sensor"
            ),
            Self::NoTime => to.write_str("t is missing; it is the time in whole milliseconds since Start, such as 500"),
            Self::OtherTime(name) => {
                write!(to, "t is missing; write t instead of “{name}”, in whole milliseconds since Start")
            }
            Self::Time => {
                to.write_str("t must be a whole number of milliseconds since Start, such as 500, without quotes")
            }
            Self::Seconds { t, ms } => {
                write!(to, "t is {t}; it counts whole milliseconds since Start. If this is in seconds, write {ms}")
            }
            Self::Epoch(t) => write!(
                to,
                "t is {t}, a time since 1970; it counts milliseconds since Start. Take the first time off every one, so \
                 that the first t is 0"
            ),
            Self::Negative => to.write_str("t must not be negative"),
            Self::Stream => to.write_str("stream must be a text"),
            Self::Value => to.write_str("value is missing"),
            Self::Backwards { from, to: back } => write!(to, "time goes back from {from} to {back}"),
            Self::Unknown(stream) => write!(to, "there is no stream {stream:?}"),
            Self::NoSensor(stream) => write!(to, "{stream:?} is no sensor stream"),
        }
    }
}

fn in_doubt(words: &str, suggestions: &[String], why: Option<&str>, to: &mut fmt::Formatter) -> fmt::Result {
    if words.is_empty() {
        return write!(to, "Something is missing: say what happens and what the robot does then.");
    }
    write!(to, "“{words}” is not understood.")?;
    if let Some(why) = why {
        return write!(to, " {why}");
    }
    if suggestions.is_empty() {
        return write!(to, " Say it in other words.");
    }
    let quoted: Vec<String> = suggestions.iter().map(|suggestion| format!("“{suggestion}”")).collect();
    write!(to, " Is it {}?", quoted.join(" or "))
}

/// A variable that names no whole path, and what to do instead of setting it to one.
fn relative(name: &str, folder: &Path, instead: &str, to: &mut fmt::Formatter) -> fmt::Result {
    if folder.as_os_str().is_empty() {
        let mut letters = instead.chars();
        let instead = letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect::<String>();
        return write!(to, "{name} is empty. {instead}, or set {name} to your folder.");
    }
    write!(
        to,
        "{name} is “{}”, which is no whole path, as it does not begin with /. Set it to one, or {instead}.",
        folder.display()
    )
}

fn differences(all: &[StoreDifference], to: &mut fmt::Formatter) -> fmt::Result {
    to.write_str("The stores are not the same. Empty the second one and try again:")?;
    all.iter().try_for_each(|one| write!(to, "\n  {}: {} differs", one.behaviour, one.what))
}

fn faults(path: &Path, all: &[FileFault], to: &mut fmt::Formatter) -> fmt::Result {
    for (number, FileFault { line, column, reason }) in all.iter().enumerate() {
        let end = if number == 0 { "" } else { "\n" };
        write!(to, "{end}{}:{line}:{column}: {reason}", path.display())?;
    }
    Ok(())
}

fn unknown(wanted: &str, names: &[String], to: &mut fmt::Formatter) -> fmt::Result {
    write!(to, "There is no behaviour “{wanted}”. ")?;
    if names.is_empty() {
        return to.write_str("The store is empty; look whether --store or --data is right.");
    }
    let shown: Vec<_> = names.iter().take(NAMES_MAX).map(|name| format!("“{name}”")).collect();
    let more = if names.len() > NAMES_MAX { ", …" } else { "" };
    write!(to, "There are {}{more}.", shown.join(", "))
}
