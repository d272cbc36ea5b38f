//! Looking step by step whether a robot can be reached, and saying what to do where it cannot.

use crate::identity;
use crate::outcome;
use crate::scan::scan;
use crate::settings::{Settings, is_secure};
use qi::{Cause, QiError, Session, Stage};
use robot::{Identity, Lacking};
use std::time::Duration;

/// The longest that a whole look may take, in milliseconds.
const LOOK_MS: u64 = 18_000;

/// The findings of a look at a robot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// The steps that went well, in order; the last one may have failed.
    pub steps: Vec<(Step, Option<String>)>,
    /// The name that the robot gives itself; may be empty.
    pub name: String,
    /// The kind of robot, with its system: "NAO, NAOqi 2.8.7"; empty if that is not known.
    pub model: String,
    /// The SHA-256 of the certificate that it showed, as `AB:CD:…`.
    pub fingerprint: Option<String>,
    /// Devices that it does not have, and why not.
    pub lacking: Vec<Lacking>,
    /// Which body it is, if it was reached.
    pub identity: Option<Identity>,
}

/// A step on the way to a robot, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Step {
    /// The name has a number in the network.
    Name,
    /// Something answers there.
    Tcp,
    /// The connection is secure; not all robots have this step.
    Tls,
    /// It lets us in.
    Login,
    /// It tells its services.
    Directory,
    /// It has what a robot needs.
    Services,
}

impl Step {
    const ALL: [Self; 6] = [Self::Name, Self::Tcp, Self::Tls, Self::Login, Self::Directory, Self::Services];

    fn of(stage: Stage) -> Self {
        match stage {
            Stage::Name => Self::Name,
            Stage::Tcp => Self::Tcp,
            Stage::Tls => Self::Tls,
            Stage::Login => Self::Login,
            Stage::Directory => Self::Directory,
            Stage::Service => Self::Services,
        }
    }
}

/// Looks, and ends the connection again. Takes 18 seconds at most.
pub async fn check(settings: &Settings) -> Found {
    let looked = tokio::time::timeout(Duration::from_millis(LOOK_MS), look(settings)).await;
    looked.unwrap_or_else(|_| {
        failed(Step::Tcp, "Nothing came in time. Look whether the robot is on, and near the network.")
    })
}

async fn look(settings: &Settings) -> Found {
    let addresses = settings.addresses();
    if addresses.is_empty() {
        return failed(
            Step::Name,
            "That is no address. Type the robot’s name or number in the network, like nao.local.",
        );
    }
    let mut furthest: Option<(Step, String)> = None;
    for address in addresses {
        let connected = match settings.check_secret(&address) {
            Ok(()) => Session::connect(&address, settings.options()).await,
            Err(error) => Err(error),
        };
        match connected {
            Ok(session) => return services(&session, is_secure(&address)).await,
            Err(error) => {
                let step = step_of(&error);
                let skipped = settings.check_secret(&address).is_err();
                if furthest.as_ref().is_none_or(|(known, _)| *known <= step) && (!skipped || furthest.is_none()) {
                    furthest = Some((step, sentence(&error)));
                }
            }
        }
    }
    let (step, why) = furthest.unwrap_or((Step::Name, String::new()));
    failed(step, &why)
}

async fn services(session: &Session, secure: bool) -> Found {
    let fingerprint = session.fingerprint().map(|fingerprint| fingerprint.to_string());
    let scanned = match scan(session).await {
        Ok(scanned) => scanned,
        Err(error) => {
            let why = format!(
                "It is no NAO or Pepper, or it is still starting ({error}). Wait a minute and look again.",
                error = outcome::why(&error)
            );
            return Found { fingerprint, ..failed(Step::Services, &why) };
        }
    };
    let steps = Step::ALL.into_iter().filter(|step| secure || *step != Step::Tls);
    Found {
        steps: steps.map(|step| (step, None)).collect(),
        model: scanned.model(),
        name: scanned.name,
        fingerprint,
        lacking: scanned.lacking,
        identity: identity::read(session, false).await.ok(),
    }
}

/// All steps before this one went well.
fn failed(at: Step, why: &str) -> Found {
    let before = Step::ALL.into_iter().filter(|step| *step < at && *step != Step::Tls);
    let steps = before.map(|step| (step, None)).chain([(at, Some(why.to_owned()))]);
    Found { steps: steps.collect(), ..Found::default() }
}

fn step_of(error: &QiError) -> Step {
    if let QiError::Connect { stage, .. } = error { Step::of(*stage) } else { Step::Services }
}

/// Why the robot is not reached, and what to do, in one sentence.
pub(crate) fn sentence(error: &QiError) -> String {
    let QiError::Connect { stage, cause } = error else {
        return format!("The robot does not answer as it should: {error}.", error = outcome::why(error));
    };
    match (stage, cause) {
        (Stage::Name, _) => {
            "Nobody in this network has this name. Press the robot’s chest button: it says its number.".to_owned()
        }
        (Stage::Tcp, Cause::Io(std::io::ErrorKind::ConnectionRefused)) => {
            "Something is there, but no robot answers. Wait until it has started, and look whether the address is right."
                .to_owned()
        }
        (Stage::Tcp, _) => {
            "Nothing answers there. Look whether the robot is on and in the same network as this server.".to_owned()
        }
        (Stage::Tls, Cause::CertificateChanged { .. }) => {
            "It shows another certificate than before: it is another robot, it was reset, or somebody is in between. If you \
             know why, choose “Change the address” here, and look at it again."
                .to_owned()
        }
        (Stage::Tls, Cause::Tls(why)) if why.contains("in the clear") => {
            "User and password are only said in secret. Leave them out, or leave out the port, or write :9503.".to_owned()
        }
        (Stage::Tls, _) => "It does not speak in secret as a robot does there. Look whether the address is right.".to_owned(),
        (Stage::Login, Cause::Refused(_)) => {
            "It does not let us in. Look whether user and password are right; the user is mostly “nao”.".to_owned()
        }
        (Stage::Login, _) => "It answers, but not like a robot. Look whether the address and its port are right.".to_owned(),
        (Stage::Directory | Stage::Service, cause) => {
            format!("It does not tell what it can do ({cause}). Wait until it has started, and look again.")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Step, check};
    use crate::settings::Settings;

    #[tokio::test]
    async fn the_first_step_that_fails_says_what_to_do() {
        let found = check(&Settings::at("nobody.invalid")).await;
        let (step, why) = found.steps.last().cloned().unwrap();
        assert_eq!(step, Step::Name);
        assert!(why.unwrap().contains("chest button"));
        let nothing = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
        let found = check(&Settings::at(&nothing.to_string())).await;
        assert_eq!(found.steps[0], (Step::Name, None));
        assert_eq!(found.steps[1].0, Step::Tcp);
        assert!(found.steps[1].1.is_some() && found.steps.len() == 2);
        assert!(check(&Settings::at("")).await.steps[0].1.is_some());
    }
}
