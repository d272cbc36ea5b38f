//! How often somebody is told that a link does not work, from one place. Who is in already is never asked this, nor who has
//! a link that works.

use std::collections::{BTreeSet, HashMap};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::net::{IpAddr, Ipv6Addr};

/// Links that do not work which a place may try at once.
const TRIES_MAX: u64 = 10;
/// How long until it may try one more, in milliseconds.
const AGAIN_MS: u64 = 6_000;
/// Places that are remembered; the one that is forgiven first is forgotten.
const PLACES_MAX: usize = 4_096;

/// Where a connection comes from: an address, or the network of 64 bits that one computer may have all addresses of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct GuessSource(IpAddr);

impl GuessSource {
    /// A number by which places are told apart when they take turns.
    pub(crate) fn number(self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.hash(&mut hasher);
        hasher.finish()
    }

    /// The place of this address.
    pub(crate) fn of(address: IpAddr) -> Self {
        match address.to_canonical() {
            IpAddr::V6(v6) => Self(Ipv6Addr::from_bits(v6.to_bits() & !u128::from(u64::MAX)).into()),
            v4 @ IpAddr::V4(_) => Self(v4),
        }
    }
}

/// What was tried in vain.
#[derive(Debug, Default)]
pub(super) struct Guesses {
    /// When all of it will be forgiven, by place.
    forgiven_ms: HashMap<GuessSource, u64>,
    /// The same, whoever is forgiven first.
    order: BTreeSet<(u64, GuessSource)>,
}

impl Guesses {
    /// Whether a place may be told of one more.
    ///
    /// # Errors
    /// The seconds that it has to wait.
    pub(super) fn check(&self, now_ms: u64, from: GuessSource) -> Result<(), u64> {
        let owed_ms = self.forgiven_ms.get(&from).map_or(0, |forgiven_ms| forgiven_ms.saturating_sub(now_ms));
        match owed_ms.checked_sub((TRIES_MAX - 1) * AGAIN_MS).filter(|wait_ms| *wait_ms > 0) {
            None => Ok(()),
            Some(wait_ms) => Err(wait_ms.div_ceil(1_000)),
        }
    }

    /// A place tried one that does not work.
    pub(super) fn failed(&mut self, now_ms: u64, from: GuessSource) {
        let before_ms = self.forgiven_ms.remove(&from).unwrap_or(0);
        self.order.remove(&(before_ms, from));
        if self.forgiven_ms.len() >= PLACES_MAX
            && let Some((_, first)) = self.order.pop_first()
        {
            self.forgiven_ms.remove(&first);
        }
        let forgiven_ms = before_ms.max(now_ms).saturating_add(AGAIN_MS);
        self.forgiven_ms.insert(from, forgiven_ms);
        self.order.insert((forgiven_ms, from));
    }
}

#[cfg(test)]
mod tests {
    use super::{AGAIN_MS, GuessSource, Guesses, PLACES_MAX, TRIES_MAX};
    use std::net::{IpAddr, Ipv4Addr};

    #[test]
    fn a_place_tries_a_few_at_once_and_then_one_now_and_then() {
        let (mut guesses, from) = (Guesses::default(), GuessSource::of(IpAddr::V4(Ipv4Addr::new(10, 0, 0, 1))));
        let (mut looked_up, hour_ms) = (0, 3_600_000);
        for now_ms in (0..hour_ms).step_by(36) {
            if guesses.check(now_ms, from).is_ok() {
                looked_up += 1;
                guesses.failed(now_ms, from);
            }
        }
        assert_eq!(looked_up, TRIES_MAX + (hour_ms - 1) / AGAIN_MS, "of a hundred thousand");
        assert_eq!(guesses.check(hour_ms, GuessSource::of("10.0.0.2".parse().unwrap())), Ok(()), "others may");
        assert!(guesses.check(hour_ms - 36, from).is_err_and(|seconds| (1..=6).contains(&seconds)));
    }

    #[test]
    fn a_hundred_thousand_places_take_no_more_memory_than_some() {
        let mut guesses = Guesses::default();
        for number in 0..100_000 {
            guesses.failed(u64::from(number), GuessSource::of(IpAddr::V4(Ipv4Addr::from_bits(number))));
            assert!(guesses.forgiven_ms.len() <= PLACES_MAX && guesses.order.len() <= PLACES_MAX);
        }
    }

    #[test]
    fn all_addresses_of_one_computer_are_one_place() {
        let of = |text: &str| GuessSource::of(text.parse().unwrap());
        assert_eq!(of("2001:db8:1:2::1"), of("2001:db8:1:2:ffff::9"));
        assert_ne!(of("2001:db8:1:2::1"), of("2001:db8:1:3::1"));
        assert_eq!(of("::ffff:10.0.0.1"), of("10.0.0.1"));
    }
}
