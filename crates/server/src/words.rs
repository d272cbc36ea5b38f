//! Why the server did not do something, each reason said in English. What a reason is, its own folder knows.

use crate::http::network::NoCertificate;
use crate::http::origin::NotAllowed;
use crate::invitations::NotIn;
use crate::library::import::NotImported;
use crate::recordings::{NotRecorded, Stuck};
use crate::robots::refusal::{BackupMisfit, NotByHand, RobotsUnchanged, RunFailure, StartError};
use crate::rooms::knowledge::Unchecked;
use crate::serve::ServeError;
use behaviour::BODY_MAX_CHARS;
use engine::GraphFault;
use protocol::{
    ADDRESS_MAX_CHARS, CODE_MAX_CHARS, HAND_MAX_BYTES, LOGIN_MAX_CHARS, MARK_MAX_CHARS, MARK_WORD_MAX_CHARS,
    RECORDING_TITLE_MAX_CHARS, ROBOT_NAME_MAX_CHARS, ROBOTS_MAX, SESSION_MAX_CHARS,
};
use std::fmt;
use store::files::FILE_MAX_BYTES;

impl fmt::Display for ServeError {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NotLoopback(address) => write!(
                to,
                "At {} others could come in without an invitation. Let them in by the address for others, and use \
                 127.0.0.1:{} for this computer.",
                address.ip(),
                address.port()
            ),
            Self::Listen(address, error) => {
                write!(to, "The address {address} cannot be used ({error}). Choose another port with --listen.")
            }
            Self::Certificate(why) => write!(to, "{why}"),
            Self::Store(error) => write!(to, "{error}"),
            Self::Thread(error) => write!(to, "The robot could not be started: {error}."),
        }
    }
}

impl fmt::Display for NoCertificate {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Own(file, reason) => {
                write!(to, "{} cannot be used ({reason}). It has to be a PEM file.", file.display())
            }
            Self::Misfit(reason) => write!(
                to,
                "The certificate cannot be used ({reason}). See that --cert is the certificate as PEM, and --key its key."
            ),
            Self::NotMade(reason) => {
                write!(to, "A certificate could not be made ({reason}). Use one of your own with --cert.")
            }
        }
    }
}

impl fmt::Display for NotIn {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Unknown => to.write_str("This link does not work, or not any more. Ask for another invitation."),
            Self::TooMany(seconds) => write!(
                to,
                "This link does not work, and too many such links were tried from your network. Ask for another \
                 invitation, or wait {seconds} seconds before you try another link."
            ),
            Self::NotKept(reason) => write!(
                to,
                "You could not be let in just now ({reason}). Open your link again in a moment, or tell the person at the \
                 robot’s computer."
            ),
        }
    }
}

impl fmt::Display for NotAllowed {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(match self {
            Self::Unreadable => "the request cannot be read",
            Self::NoHost => "the request does not say for which host it is",
            Self::OtherHost => "here only this computer itself may ask, by localhost, 127.0.0.1 or [::1]. Open it by one of these",
            Self::NoOrigin => "the request does not say from which page it is",
            Self::OtherPage => "another page may not use this server",
            Self::NotInvited => "only who was invited may come in here",
            Self::Forwarded => {
                "a proxy or a tunnel passes this on, and here only this computer itself may ask. Start rrp with \
                 --behind-proxy and the address that people use, and let the proxy speak to that port (rrp serve --help)"
            }
        })
    }
}

impl fmt::Display for NotImported {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Fault(fault) => write!(to, "{fault}"),
            Self::Present => to.write_str(
                "This program is here already, perhaps in the bin. Import it as a copy, or restore it from the bin.",
            ),
            Self::TooLarge => {
                write!(to, "The file is larger than {FILE_MAX_BYTES} bytes. Split it into several.")
            }
            Self::NotWhole => to.write_str("The file did not come whole, or took too long. Try again."),
            Self::Refused(no) => write!(to, "{no}"),
        }
    }
}

impl fmt::Display for Unchecked {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::TooLong => write!(to, "it is longer than {BODY_MAX_CHARS} characters"),
            Self::TooMuch => to.write_str("there is too much to check at once; do it in smaller steps"),
            Self::NobodyWaits => to.write_str("nobody waits for it any more"),
            Self::TooSlow => {
                to.write_str("checking all procedures of the file takes too long; try again, or split the file")
            }
        }
    }
}

impl fmt::Display for NotRecorded {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoFolder => to.write_str("this server has no data folder; start it with --data DIR"),
            Self::NoneMade(folder, error) => write!(to, "{} cannot be made ({error})", folder.display()),
            Self::Full => to.write_str("there is no room for another recording; download and remove some first"),
            Self::Unwritable(file, error) => write!(to, "{} cannot be written ({error})", file.display()),
            Self::NameTaken => to.write_str("too many recordings have the same name; remove some first"),
            Self::NotBegun(error) => {
                write!(to, "it cannot be recorded ({error}); free some space, or start it without recording")
            }
            Self::NotRemoved(error) => write!(to, "it cannot be removed ({error})"),
            Self::NoMark => to.write_str("there is no such mark any more; look at the list again"),
            Self::NotUndone => to.write_str(
                "a mark is taken back within ten seconds, by who made it; later, remove it from the recording",
            ),
            Self::LongNote => {
                write!(to, "a note has at most {MARK_MAX_CHARS} characters, and a word {MARK_WORD_MAX_CHARS}")
            }
            Self::NoSpan => to.write_str("a mark ends after it begins, within the recording; look at its times"),
            Self::TooManyMarks => to.write_str("it has as many marks as a recording may have"),
            Self::MarkUnwritten(error) => write!(to, "the mark cannot be written ({error}); free some space"),
            Self::Unread(error) => write!(to, "it cannot be read ({error})"),
            Self::GoesOn => to.write_str("it is still being recorded; end its recording first"),
            Self::LongTitle => {
                write!(to, "a name has at most {RECORDING_TITLE_MAX_CHARS} characters; choose a shorter one")
            }
            Self::TitleUnwritten(error) => write!(to, "its name cannot be written ({error}); free some space"),
            Self::TooLarge => to.write_str(
                "it is too large to be converted here; download it as it is and convert it by the command line",
            ),
            Self::StrangeCode => write!(
                to,
                "a code has letters, digits, “-”, “_” and “.” alone, at most {CODE_MAX_CHARS} of them, and is no name"
            ),
            Self::LongSession => write!(to, "the name of a session has at most {SESSION_MAX_CHARS} characters"),
        }
    }
}

impl fmt::Display for Stuck {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Full(bytes) => write!(to, "it reached {} MiB and ends here", bytes >> 20),
            Self::Unwritable(error) => write!(to, "it could not be written on ({error})"),
        }
    }
}

impl fmt::Display for StartError {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::TooMany => to.write_str("too many programs run already; stop one first"),
            Self::NoThread(error) => write!(to, "there is no room for another run ({error})"),
            Self::Unprepared => to.write_str("it failed while it was prepared"),
            Self::Late => to.write_str("it took too long to prepare"),
            Self::Faults(faults) => first_of(faults, to),
            Self::Silent => to.write_str("the robot does not answer"),
            Self::Twin(name) => {
                write!(to, "it is the same robot as “{name}”; start it there, or remove one of the two")
            }
            Self::Unopened { stream, reason } => write!(to, "“{stream}”: {reason}"),
            Self::Unordered(error) => write!(to, "its place in the order could not be kept ({error})"),
            Self::NotRecorded(why) => write!(to, "{why}"),
            Self::StopPressed(None) => to.write_str("Stop was pressed"),
            Self::StopPressed(Some(by)) => write!(to, "{by} pressed Stop"),
            Self::StoppedSince => to.write_str("the robot was stopped before this came"),
            Self::StoppedBefore => to.write_str("it was stopped before it began"),
            Self::StoppedMeanwhile => to.write_str("it was stopped meanwhile"),
            Self::Ended => to.write_str("it does not run any more"),
            Self::AppliedJustNow => to.write_str("somebody applies a change just now; try again in a moment"),
            Self::StillApplying => to.write_str("it takes very long; look in a moment which revision runs"),
            Self::Inside => inside(to),
        }
    }
}

impl fmt::Display for NotByHand {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::StopPressed => write!(to, "{}", StartError::StopPressed(None)),
            Self::Twin(name) => write!(to, "{}", StartError::Twin(name.clone())),
            Self::Large => write!(to, "what it is told has more than {HAND_MAX_BYTES} bytes; say less"),
            Self::Silent => write!(to, "{}", StartError::Silent),
            Self::Robot(fault) => write!(to, "{fault}"),
        }
    }
}

impl fmt::Display for RunFailure {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Engine(reason) => to.write_str(reason),
            Self::TooLong(stream) => {
                write!(to, "a procedure took too long three times; look at the one that makes “{stream}”")
            }
            Self::Late => write!(to, "{}", StartError::Late),
            Self::NotFollowed => to.write_str("it could not go on with what was applied; start it again"),
            Self::Robot => to.write_str("the robot failed and is started again"),
            Self::Halt(reason) => write!(to, "{reason}; look after the robot first"),
            Self::Inside => inside(to),
        }
    }
}

impl fmt::Display for RobotsUnchanged {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Nameless => to.write_str("it needs a name of letters and digits, all of which are seen"),
            Self::LongName => write!(to, "its name may have {ROBOT_NAME_MAX_CHARS} characters"),
            Self::Address => write!(
                to,
                "it needs an address: its name or number in the network, like “nao.local” or “192.168.1.7”, of at \
                 most {ADDRESS_MAX_CHARS} characters"
            ),
            Self::LongLogin => write!(to, "its user name and password may have {LOGIN_MAX_CHARS} characters"),
            Self::TooMany => write!(to, "there are {ROBOTS_MAX} already; remove one first"),
            Self::KeptForHost => to.write_str(
                "the places that are left are for robots of the host; ask at the robot’s computer, or remove one first",
            ),
            Self::NewUnkept(error) => write!(to, "it could not be kept ({error})"),
            Self::OnlyOne => to.write_str("it is the only one"),
            Self::InUse => to.write_str("something runs on it; press Stop first"),
            Self::Twin(name) => write!(
                to,
                "it is the same robot as “{name}”, which is here already; if it has another address now, change the \
                 address of “{name}”"
            ),
            Self::Simulated => to.write_str("it is a simulated one, which has no address"),
            Self::AnotherOne => to.write_str("another robot answers there by now; look again who it is"),
            Self::Unkept(error) => write!(to, "that could not be kept ({error})"),
        }
    }
}

impl fmt::Display for BackupMisfit {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Malformed => {
                to.write_str("The robots in the backup are not as a server keeps them. Take another backup.")
            }
            Self::Others(folder) => {
                let folder = folder.display();
                write!(
                    to,
                    "{folder} has robots that are not those of the backup. Choose an empty folder with --data DIR."
                )
            }
        }
    }
}

fn first_of(faults: &[GraphFault], to: &mut fmt::Formatter) -> fmt::Result {
    match faults {
        [] => Ok(()),
        [one] => write!(to, "{}", one.reason),
        [first, others @ ..] => write!(to, "{} (and {} more)", first.reason, others.len()),
    }
}

fn inside(to: &mut fmt::Formatter) -> fmt::Result {
    to.write_str("it failed inside; please tell the people who make rrp")
}
