//! Looking step by step whether a robot can be reached, and saying what to do where it cannot.

use crate::identity;
use crate::outcome;
use crate::scan::scan;
use crate::settings::{RobotSettings, is_secure};
use phrase::{Phrase, phrase};
use qi::{ConnectError, ConnectionStage, QiError, Session};
use robot::{Identity, Lacking};
use std::time::Duration;

/// The longest that a whole look may take, in milliseconds.
const LOOK_MS: u64 = 18_000;

/// The findings of a look at a robot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RobotCheck {
    /// The steps that went well, in order; the last one may have failed.
    pub steps: Vec<(ReachStep, Option<Phrase>)>,
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
pub enum ReachStep {
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

impl ReachStep {
    const ALL: [Self; 6] = [Self::Name, Self::Tcp, Self::Tls, Self::Login, Self::Directory, Self::Services];

    fn of(stage: ConnectionStage) -> Self {
        match stage {
            ConnectionStage::Name => Self::Name,
            ConnectionStage::Tcp => Self::Tcp,
            ConnectionStage::Tls => Self::Tls,
            ConnectionStage::Login => Self::Login,
            ConnectionStage::Directory => Self::Directory,
            ConnectionStage::Service => Self::Services,
        }
    }
}

/// Looks, and ends the connection again. Takes 18 seconds at most.
pub async fn check(settings: &RobotSettings) -> RobotCheck {
    let looked = tokio::time::timeout(Duration::from_millis(LOOK_MS), look(settings)).await;
    looked.unwrap_or_else(|_| {
        failed(
            ReachStep::Tcp,
            phrase!(
                "nao.nothing_came_in_time_look",
                "Nothing came in time. Look whether the robot is on, and near the network."
            ),
        )
    })
}

async fn look(settings: &RobotSettings) -> RobotCheck {
    let addresses = settings.addresses();
    if addresses.is_empty() {
        return failed(
            ReachStep::Name,
            phrase!(
                "nao.that_is_no_address_type",
                "That is no address. Type the robot’s name or number in the network, like nao.local."
            ),
        );
    }
    let mut furthest: Option<(ReachStep, Phrase)> = None;
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
    let (step, why) = furthest.unwrap_or((ReachStep::Name, Phrase::default()));
    failed(step, why)
}

async fn services(session: &Session, secure: bool) -> RobotCheck {
    let fingerprint = session.fingerprint().map(|fingerprint| fingerprint.to_string());
    let scanned = match scan(session).await {
        Ok(scanned) => scanned,
        Err(error) => {
            let why = phrase!(
                "nao.it_is_no_nao_or",
                "It is no NAO or Pepper, or it is still starting ({error}). Wait a minute and look again.",
                error = outcome::why(&error)
            );
            return RobotCheck { fingerprint, ..failed(ReachStep::Services, why) };
        }
    };
    let steps = ReachStep::ALL.into_iter().filter(|step| secure || *step != ReachStep::Tls);
    RobotCheck {
        steps: steps.map(|step| (step, None)).collect(),
        model: scanned.model(),
        name: scanned.name,
        fingerprint,
        lacking: scanned.lacking,
        identity: identity::read(session, false).await.ok(),
    }
}

/// All steps before this one went well.
fn failed(at: ReachStep, why: Phrase) -> RobotCheck {
    let before = ReachStep::ALL.into_iter().filter(|step| *step < at && *step != ReachStep::Tls);
    let steps = before.map(|step| (step, None)).chain([(at, Some(why))]);
    RobotCheck { steps: steps.collect(), ..RobotCheck::default() }
}

fn step_of(error: &QiError) -> ReachStep {
    if let QiError::Connect { stage, .. } = error { ReachStep::of(*stage) } else { ReachStep::Services }
}

/// Why the robot is not reached, and what to do, in one sentence.
pub(crate) fn sentence(error: &QiError) -> Phrase {
    let QiError::Connect { stage, cause } = error else {
        return phrase!(
            "nao.the_robot_does_not_answer",
            "The robot does not answer as it should: {error}.",
            error = outcome::why(error)
        );
    };
    match (stage, cause) {
        (ConnectionStage::Name, _) => {
            phrase!(
                "nao.nobody_in_this_network_has",
                "Nobody in this network has this name. Press the robot’s chest button: it says its number."
            )
        }
        (ConnectionStage::Tcp, ConnectError::Io(std::io::ErrorKind::ConnectionRefused)) => {
            phrase!(
                "nao.something_is_there_but_no",
                "Something is there, but no robot answers. Wait until it has started, and look whether the address is right."
            )
        }
        (ConnectionStage::Tcp, _) => {
            phrase!(
                "nao.nothing_answers_there_look_whether",
                "Nothing answers there. Look whether the robot is on and in the same network as this server."
            )
        }
        (ConnectionStage::Tls, ConnectError::CertificateChanged { .. }) => {
            phrase!(
                "nao.it_shows_another_certificate_than",
                "It shows another certificate than before: it is another robot, it was reset, or somebody is in between. If you \
             know why, choose “Change the address” here, and look at it again."
            )
        }
        (ConnectionStage::Tls, ConnectError::InTheClear) => {
            phrase!(
                "nao.user_and_password_are_only",
                "User and password are only said in secret. Leave them out, or leave out the port, or write :9503."
            )
        }
        (ConnectionStage::Tls, _) => phrase!(
            "nao.it_does_not_speak_in",
            "It does not speak in secret as a robot does there. Look whether the address is right."
        ),
        (ConnectionStage::Login, ConnectError::Refused(_)) => {
            phrase!(
                "nao.it_does_not_let_us",
                "It does not let us in. Look whether user and password are right; the user is mostly “nao”."
            )
        }
        (ConnectionStage::Login, _) => phrase!(
            "nao.it_answers_but_not_like",
            "It answers, but not like a robot. Look whether the address and its port are right."
        ),
        (ConnectionStage::Directory | ConnectionStage::Service, cause) => {
            phrase!(
                "nao.it_does_not_tell_what",
                "It does not tell what it can do ({cause}). Wait until it has started, and look again."
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ReachStep, check};
    use crate::settings::RobotSettings;

    #[tokio::test]
    async fn the_first_step_that_fails_says_what_to_do() {
        let found = check(&RobotSettings::at("nobody.invalid")).await;
        let (step, why) = found.steps.last().cloned().unwrap();
        assert_eq!(step, ReachStep::Name);
        assert!(why.unwrap().to_string().contains("chest button"));
        let nothing = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
        let found = check(&RobotSettings::at(&nothing.to_string())).await;
        assert_eq!(found.steps[0], (ReachStep::Name, None));
        assert_eq!(found.steps[1].0, ReachStep::Tcp);
        assert!(found.steps[1].1.is_some() && found.steps.len() == 2);
        assert!(check(&RobotSettings::at("")).await.steps[0].1.is_some());
    }
}
