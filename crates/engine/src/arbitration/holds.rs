//! The holders of the robot's parts, and for how long: the common base of all rules of precedence.

use crate::arbitration::Claim;
use behaviour::Lookup;
use robot::Millis;

/// The parts that are held, each by one holder.
#[derive(Clone, Debug)]
pub(crate) struct Holds<B> {
    held: Lookup<String, PartHold<B>>,
}

/// A part that is held.
#[derive(Clone, Debug)]
pub(crate) struct PartHold<B> {
    pub(crate) by: B,
    pub(crate) priority: i64,
    pub(crate) until: Millis,
}

impl<B> Default for Holds<B> {
    fn default() -> Self {
        Self { held: Lookup::new() }
    }
}

impl<B: Clone + PartialEq> Holds<B> {
    /// A command. It is refused while a holder of one of the parts wins. Otherwise it takes its parts for its hold time,
    /// and every other holder of one of them loses all of its own.
    ///
    /// # Errors
    /// The first part that somebody keeps, and the hold on it.
    pub(crate) fn command(
        &mut self,
        at: Millis,
        by: &B,
        claim: &Claim,
        wins: impl Fn(&PartHold<B>) -> bool,
    ) -> Result<(), (String, PartHold<B>)> {
        self.held.retain(|_, hold| hold.until > at);
        let wanted = || claim.resources.iter().filter_map(|part| Some((part, self.held.get(part)?)));
        if let Some((part, hold)) = wanted().find(|(_, hold)| wins(hold)) {
            return Err((part.clone(), hold.clone()));
        }
        let losing: Vec<B> = wanted().map(|(_, hold)| hold.by.clone()).collect();
        self.held.retain(|_, hold| !losing.contains(&hold.by));
        let hold =
            PartHold { by: by.clone(), priority: claim.priority, until: Millis(at.0.saturating_add(claim.hold_ms)) };
        self.held.extend(claim.resources.iter().map(|part| (part.clone(), hold.clone())));
        Ok(())
    }

    /// Lets go of what these holders hold.
    pub(crate) fn let_go(&mut self, these: impl Fn(&B) -> bool) {
        self.held.retain(|_, hold| !these(&hold.by));
    }
}
