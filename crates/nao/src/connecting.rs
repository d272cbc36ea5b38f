//! Finding a robot at its addresses, and noticing that it does not answer any more.

use crate::link::CALL;
use crate::settings::RobotSettings;
use crate::shared::NaoShared;
use qi::{PeerAddress, QiError, Session};
use std::sync::Arc;
use std::time::Duration;
use tokio::task::JoinHandle;
use tokio::time::MissedTickBehavior;

/// The pause before the robot is asked again whether it is there, in milliseconds.
const PING_MS: u64 = 1_000;
/// It is degraded when nothing came for so long, and lost then, in milliseconds.
const DEGRADED_MS: u128 = 2_200;
const LOST_MS: u128 = 5_000;

/// The first address that leads to a robot.
pub(crate) async fn find(settings: &RobotSettings) -> Result<(PeerAddress, Session), QiError> {
    let mut failed = QiError::Address(settings.address.clone());
    for address in settings.addresses() {
        if let Err(error) = settings.check_secret(&address) {
            failed = error;
            continue;
        }
        match Session::connect(&address, settings.options()).await {
            Ok(session) => return Ok((address, session)),
            Err(error) => failed = error,
        }
    }
    Err(failed)
}

/// A task that ends with its handle.
pub(crate) struct EndingTask(pub(crate) JoinHandle<()>);

impl Drop for EndingTask {
    fn drop(&mut self) {
        self.0.abort();
    }
}

/// Asks whether the robot is there; a link that is silent for too long is over.
pub(crate) async fn ping(session: Session, shared: Arc<NaoShared>) {
    let mut beat = tokio::time::interval(Duration::from_millis(PING_MS));
    beat.set_missed_tick_behavior(MissedTickBehavior::Delay);
    loop {
        beat.tick().await;
        let link = session.link().clone();
        tokio::spawn(async move { drop(link.ping(CALL).await) });
        let silent = session.link().silent_for().as_millis();
        if silent > LOST_MS {
            session.link().close();
            return;
        }
        shared.state().note_slow(silent > DEGRADED_MS);
    }
}
