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
use phrase::{Phrase, Phrased, phrase, shown};
use protocol::{
    ADDRESS_MAX_CHARS, CODE_MAX_CHARS, HAND_MAX_BYTES, LOGIN_MAX_CHARS, MARK_MAX_CHARS, MARK_WORD_MAX_CHARS,
    RECORDING_TITLE_MAX_CHARS, ROBOT_NAME_MAX_CHARS, ROBOTS_MAX, SESSION_MAX_CHARS,
};
use store::files::FILE_MAX_BYTES;

shown!(
    ServeError,
    NoCertificate,
    NotIn,
    NotAllowed,
    NotImported,
    Unchecked,
    NotRecorded,
    Stuck,
    StartError,
    NotByHand,
    RunFailure,
    RobotsUnchanged,
    BackupMisfit
);

impl Phrased for ServeError {
    fn phrase(&self) -> Phrase {
        match self {
            Self::NotLoopback(address) => phrase!(
                "ServeError.NotLoopback",
                "At {ip} others could come in without an invitation. Let them in by the address for others, and use \
                 127.0.0.1:{port} for this computer.",
                ip = address.ip().to_string(),
                port = address.port()
            ),
            Self::Listen(address, error) => {
                phrase!(
                    "ServeError.Listen",
                    "The address {address} cannot be used ({error}). Choose another port with --listen.",
                    address = address.to_string()
                )
            }
            Self::Certificate(why) => why.phrase(),
            Self::Store(error) => error.phrase(),
            Self::Thread(error) => phrase!("ServeError.Thread", "The robot could not be started: {error}."),
        }
    }
}

impl Phrased for NoCertificate {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Own(file, reason) => {
                phrase!(
                    "NoCertificate.Own",
                    "{file} cannot be used ({reason}). It has to be a PEM file.",
                    file = file.display()
                )
            }
            Self::Misfit(reason) => phrase!(
                "NoCertificate.Misfit",
                "The certificate cannot be used ({reason}). See that --cert is the certificate as PEM, and --key its key."
            ),
            Self::NotMade(reason) => {
                phrase!(
                    "NoCertificate.NotMade",
                    "A certificate could not be made ({reason}). Use one of your own with --cert."
                )
            }
        }
    }
}

impl Phrased for NotIn {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Unknown => {
                phrase!("NotIn.Unknown", "This link does not work, or not any more. Ask for another invitation.")
            }
            Self::TooMany(seconds) => phrase!(
                "NotIn.TooMany",
                "This link does not work, and too many such links were tried from your network. Ask for another \
                 invitation, or wait {seconds} seconds before you try another link."
            ),
            Self::NotKept(reason) => phrase!(
                "NotIn.NotKept",
                "You could not be let in just now ({.reason}). Open your link again in a moment, or tell the person at the \
                 robot’s computer."
            ),
        }
    }
}

impl Phrased for NotAllowed {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Unreadable => phrase!("NotAllowed.Unreadable", "the request cannot be read"),
            Self::NoHost => phrase!("NotAllowed.NoHost", "the request does not say for which host it is"),
            Self::OtherHost => phrase!(
                "NotAllowed.OtherHost",
                "here only this computer itself may ask, by localhost, 127.0.0.1 or [::1]. Open it by one of these"
            ),
            Self::NoOrigin => phrase!("NotAllowed.NoOrigin", "the request does not say from which page it is"),
            Self::OtherPage => phrase!("NotAllowed.OtherPage", "another page may not use this server"),
            Self::NotInvited => phrase!("NotAllowed.NotInvited", "only who was invited may come in here"),
            Self::Forwarded => phrase!(
                "NotAllowed.Forwarded",
                "a proxy or a tunnel passes this on, and here only this computer itself may ask. Start rrp with \
                 --behind-proxy and the address that people use, and let the proxy speak to that port (rrp serve --help)"
            ),
        }
    }
}

impl Phrased for NotImported {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Fault(fault) => fault.phrase(),
            Self::Present => phrase!(
                "NotImported.Present",
                "This program is here already, perhaps in the bin. Import it as a copy, or restore it from the bin."
            ),
            Self::TooLarge => {
                phrase!(
                    "NotImported.TooLarge",
                    "The file is larger than {FILE_MAX_BYTES} bytes. Split it into several."
                )
            }
            Self::NotWhole => {
                phrase!("NotImported.NotWhole", "The file did not come whole, or took too long. Try again.")
            }
            Self::Refused(no) => no.phrase(),
        }
    }
}

impl Phrased for Unchecked {
    fn phrase(&self) -> Phrase {
        match self {
            Self::TooLong => phrase!("Unchecked.TooLong", "it is longer than {BODY_MAX_CHARS} characters"),
            Self::TooMuch => phrase!("Unchecked.TooMuch", "there is too much to check at once; do it in smaller steps"),
            Self::NobodyWaits => phrase!("Unchecked.NobodyWaits", "nobody waits for it any more"),
            Self::TooSlow => {
                phrase!(
                    "Unchecked.TooSlow",
                    "checking all procedures of the file takes too long; try again, or split the file"
                )
            }
        }
    }
}

impl Phrased for NotRecorded {
    fn phrase(&self) -> Phrase {
        match self {
            Self::NoFolder => {
                phrase!("NotRecorded.NoFolder", "this server has no data folder; start it with --data DIR")
            }
            Self::NoneMade(folder, error) => {
                phrase!("NotRecorded.NoneMade", "{folder} cannot be made ({error})", folder = folder.display())
            }
            Self::Full => {
                phrase!("NotRecorded.Full", "there is no room for another recording; download and remove some first")
            }
            Self::Unwritable(file, error) => {
                phrase!("NotRecorded.Unwritable", "{file} cannot be written ({error})", file = file.display())
            }
            Self::NameTaken => {
                phrase!("NotRecorded.NameTaken", "too many recordings have the same name; remove some first")
            }
            Self::NotBegun(error) => {
                phrase!(
                    "NotRecorded.NotBegun",
                    "it cannot be recorded ({error}); free some space, or start it without recording"
                )
            }
            Self::NotRemoved(error) => phrase!("NotRecorded.NotRemoved", "it cannot be removed ({error})"),
            Self::NoMark => phrase!("NotRecorded.NoMark", "there is no such mark any more; look at the list again"),
            Self::NotUndone => phrase!(
                "NotRecorded.NotUndone",
                "a mark is taken back within ten seconds, by who made it; later, remove it from the recording"
            ),
            Self::LongNote => {
                phrase!(
                    "NotRecorded.LongNote",
                    "a note has at most {MARK_MAX_CHARS} characters, and a word {MARK_WORD_MAX_CHARS}"
                )
            }
            Self::NoSpan => {
                phrase!("NotRecorded.NoSpan", "a mark ends after it begins, within the recording; look at its times")
            }
            Self::TooManyMarks => phrase!("NotRecorded.TooManyMarks", "it has as many marks as a recording may have"),
            Self::MarkUnwritten(error) => {
                phrase!("NotRecorded.MarkUnwritten", "the mark cannot be written ({error}); free some space")
            }
            Self::Unread(error) => phrase!("NotRecorded.Unread", "it cannot be read ({error})"),
            Self::GoesOn => phrase!("NotRecorded.GoesOn", "it is still being recorded; end its recording first"),
            Self::LongTitle => {
                phrase!(
                    "NotRecorded.LongTitle",
                    "a name has at most {RECORDING_TITLE_MAX_CHARS} characters; choose a shorter one"
                )
            }
            Self::TitleUnwritten(error) => {
                phrase!("NotRecorded.TitleUnwritten", "its name cannot be written ({error}); free some space")
            }
            Self::TooLarge => phrase!(
                "NotRecorded.TooLarge",
                "it is too large to be converted here; download it as it is and convert it by the command line"
            ),
            Self::StrangeCode => phrase!(
                "NotRecorded.StrangeCode",
                "a code has letters, digits, “-”, “_” and “.” alone, at most {CODE_MAX_CHARS} of them, and is no name"
            ),
            Self::LongSession => {
                phrase!("NotRecorded.LongSession", "the name of a session has at most {SESSION_MAX_CHARS} characters")
            }
        }
    }
}

impl Phrased for Stuck {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Full(bytes) => phrase!("Stuck.Full", "it reached {mib} MiB and ends here", mib = bytes >> 20),
            Self::Unwritable(error) => phrase!("Stuck.Unwritable", "it could not be written on ({error})"),
        }
    }
}

impl Phrased for StartError {
    fn phrase(&self) -> Phrase {
        match self {
            Self::TooMany => phrase!("StartError.TooMany", "too many programs run already; stop one first"),
            Self::NoThread(error) => phrase!("StartError.NoThread", "there is no room for another run ({error})"),
            Self::Unprepared => phrase!("StartError.Unprepared", "it failed while it was prepared"),
            Self::Late => phrase!("StartError.Late", "it took too long to prepare"),
            Self::Faults(faults) => first_of(faults),
            Self::Silent => phrase!("StartError.Silent", "the robot does not answer"),
            Self::Twin(name) => {
                phrase!("StartError.Twin", "it is the same robot as “{name}”; start it there, or remove one of the two")
            }
            Self::Unopened { stream, reason } => phrase!("StartError.Unopened", "“{stream}”: {reason}"),
            Self::Unordered(error) => {
                phrase!("StartError.Unordered", "its place in the order could not be kept ({error})")
            }
            Self::NotRecorded(why) => why.phrase(),
            Self::StopPressed(None) => phrase!("StartError.StopPressed", "Stop was pressed"),
            Self::StopPressed(Some(by)) => phrase!("StartError.StopPressed2", "{by} pressed Stop"),
            Self::StoppedSince => phrase!("StartError.StoppedSince", "the robot was stopped before this came"),
            Self::StoppedBefore => phrase!("StartError.StoppedBefore", "it was stopped before it began"),
            Self::StoppedMeanwhile => phrase!("StartError.StoppedMeanwhile", "it was stopped meanwhile"),
            Self::Ended => phrase!("StartError.Ended", "it does not run any more"),
            Self::AppliedJustNow => {
                phrase!("StartError.AppliedJustNow", "somebody applies a change just now; try again in a moment")
            }
            Self::StillApplying => {
                phrase!("StartError.StillApplying", "it takes very long; look in a moment which revision runs")
            }
            Self::Inside => inside(),
        }
    }
}

impl Phrased for NotByHand {
    fn phrase(&self) -> Phrase {
        match self {
            Self::StopPressed => StartError::StopPressed(None).phrase(),
            Self::Twin(name) => StartError::Twin(name.clone()).phrase(),
            Self::Large => phrase!("NotByHand.Large", "what it is told has more than {HAND_MAX_BYTES} bytes; say less"),
            Self::Silent => StartError::Silent.phrase(),
            Self::Robot(fault) => fault.phrase(),
        }
    }
}

impl Phrased for RunFailure {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Engine(reason) => reason.clone(),
            Self::TooLong(stream) => {
                phrase!(
                    "RunFailure.TooLong",
                    "a procedure took too long three times; look at the one that makes “{stream}”"
                )
            }
            Self::Late => StartError::Late.phrase(),
            Self::NotFollowed => {
                phrase!("RunFailure.NotFollowed", "it could not go on with what was applied; start it again")
            }
            Self::Robot => phrase!("RunFailure.Robot", "the robot failed and is started again"),
            Self::Halt(reason) => phrase!("RunFailure.Halt", "{reason}; look after the robot first"),
            Self::Inside => inside(),
        }
    }
}

impl Phrased for RobotsUnchanged {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Nameless => {
                phrase!("RobotsUnchanged.Nameless", "it needs a name of letters and digits, all of which are seen")
            }
            Self::LongName => {
                phrase!("RobotsUnchanged.LongName", "its name may have {ROBOT_NAME_MAX_CHARS} characters")
            }
            Self::Address => phrase!(
                "RobotsUnchanged.Address",
                "it needs an address: its name or number in the network, like “nao.local” or “192.168.1.7”, of at \
                 most {ADDRESS_MAX_CHARS} characters"
            ),
            Self::LongLogin => {
                phrase!("RobotsUnchanged.LongLogin", "its user name and password may have {LOGIN_MAX_CHARS} characters")
            }
            Self::TooMany => phrase!("RobotsUnchanged.TooMany", "there are {ROBOTS_MAX} already; remove one first"),
            Self::KeptForHost => phrase!(
                "RobotsUnchanged.KeptForHost",
                "the places that are left are for robots of the host; ask at the robot’s computer, or remove one first"
            ),
            Self::NewUnkept(error) => phrase!("RobotsUnchanged.NewUnkept", "it could not be kept ({error})"),
            Self::OnlyOne => phrase!("RobotsUnchanged.OnlyOne", "it is the only one"),
            Self::InUse => phrase!("RobotsUnchanged.InUse", "something runs on it; press Stop first"),
            Self::Twin(name) => phrase!(
                "RobotsUnchanged.Twin",
                "it is the same robot as “{name}”, which is here already; if it has another address now, change the \
                 address of “{name}”"
            ),
            Self::Simulated => phrase!("RobotsUnchanged.Simulated", "it is a simulated one, which has no address"),
            Self::AnotherOne => {
                phrase!("RobotsUnchanged.AnotherOne", "another robot answers there by now; look again who it is")
            }
            Self::Unkept(error) => phrase!("RobotsUnchanged.Unkept", "that could not be kept ({error})"),
        }
    }
}

impl Phrased for BackupMisfit {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Malformed => {
                phrase!(
                    "BackupMisfit.Malformed",
                    "The robots in the backup are not as a server keeps them. Take another backup."
                )
            }
            Self::Others(folder) => {
                let folder = folder.display();
                phrase!(
                    "BackupMisfit.Others",
                    "{folder} has robots that are not those of the backup. Choose an empty folder with --data DIR."
                )
            }
        }
    }
}

fn first_of(faults: &[GraphFault]) -> Phrase {
    match faults {
        [] => Phrase::default(),
        [one] => one.reason.phrase(),
        [first, others @ ..] => {
            phrase!("StartError.Faults", "{first} (and {more} more)", first = first.reason, more = others.len())
        }
    }
}

fn inside() -> Phrase {
    phrase!("StartError.Inside", "it failed inside; please tell the people who make rrp")
}
