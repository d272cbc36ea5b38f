//! Another body answers at the address. Nothing is asked of it but to make its eyes blink, so that people see which one it
//! is; a Stop that somebody presses meanwhile is carried out like any other.

use crate::connecting::{EndingTask, ping};
use crate::identity::{blink, read};
use crate::link_commands::LinkCommand;
use crate::link_commands::{LinkCommands, drain};
use crate::shared::NaoShared;
use phrase::{Phrase, phrase};
use qi::Session;
use robot::{Control, Health, Stranger};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// The pause before one that has just started is asked again who it is, in milliseconds.
const ASK_MS: u64 = 500;

/// Waits until it is gone; with the reason.
pub(crate) async fn meet(
    session: &Session,
    shared: &Arc<NaoShared>,
    orders: &mut LinkCommands,
    waiting: &AtomicUsize,
    mut who: Box<Stranger>,
) -> Phrase {
    tracing::warn!(expected = %who.expected.name, found = %who.found.name, "another robot answers");
    drain(orders, waiting);
    shared.state().health = Health::Stranger(who.clone());
    let mut asking = tokio::time::interval(Duration::from_millis(ASK_MS));
    let _pinging = EndingTask(tokio::spawn(ping(session.clone(), Arc::clone(shared))));
    let mut _blinking = None;
    loop {
        tokio::select! {
            biased;
            () = shared.ending.notified() => return phrase!("nao.it_is_not_used_any", "it is not used any more"),
            ending = session.link().ended() => return phrase!("nao.the_connection_ended", "the connection ended: {ending}"),
            // A robot that starts has its services one by one.
            _ = asking.tick(), if who.found.name.is_empty() || who.found.body.is_empty() => {
                if let Ok(found) = read(session, false).await {
                    who.found = found.or(&who.found);
                    shared.state().health = Health::Stranger(who.clone());
                }
            }
            order = orders.recv() => match order {
                None => return phrase!("nao.it_is_not_used_any", "it is not used any more"),
                Some(LinkCommand::Do(..)) => {
                    waiting.fetch_sub(1, Ordering::SeqCst);
                }
                Some(LinkCommand::Control(Control::Blink)) => {
                    // A sign that is asked for anew begins anew.
                    _blinking = Some(EndingTask(tokio::spawn(blink(session.clone(), None))));
                }
                Some(LinkCommand::Open(..) | LinkCommand::Close(_) | LinkCommand::Control(_)) => {}
            },
        }
    }
}
