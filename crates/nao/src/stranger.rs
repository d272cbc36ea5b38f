//! Another body answers at the address. Nothing is asked of it but to make its eyes blink, so that people see which one it
//! is; a Stop that somebody presses meanwhile is carried out like any other.

use crate::front::Order;
use crate::identity::blink;
use crate::shared::Shared;
use crate::supervisor::{Ended, Orders, drain, ping};
use qi::Session;
use robot::{Control, Health, Stranger};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Waits until it is gone; with the reason.
pub(crate) async fn meet(
    session: &Session,
    shared: &Arc<Shared>,
    orders: &mut Orders,
    waiting: &AtomicUsize,
    who: Box<Stranger>,
) -> String {
    tracing::warn!(expected = %who.expected.name, found = %who.found.name, "another robot answers");
    drain(orders, waiting);
    shared.state().health = Health::Stranger(who);
    let _pinging = Ended(tokio::spawn(ping(session.clone(), Arc::clone(shared))));
    let mut _blinking = None;
    loop {
        tokio::select! {
            biased;
            () = shared.ending.notified() => return "it is not used any more".to_owned(),
            ending = session.link().ended() => return format!("the connection ended: {ending}"),
            order = orders.recv() => match order {
                None => return "it is not used any more".to_owned(),
                Some(Order::Do(..)) => {
                    waiting.fetch_sub(1, Ordering::SeqCst);
                }
                Some(Order::Control(Control::Blink)) => {
                    // A sign that is asked for anew begins anew.
                    _blinking = Some(Ended(tokio::spawn(blink(session.clone(), None))));
                }
                Some(Order::Open(..) | Order::Close(_) | Order::Control(_)) => {}
            },
        }
    }
}
