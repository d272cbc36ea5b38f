//! The subscriptions to what the robot measures for us only.

use std::collections::BTreeMap;

/// The subscriptions to what is measured only for us: service and the name that we subscribed by, and a number by which
/// one that began anew under the same name is another one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Subscribed {
    all: BTreeMap<(&'static str, String), u64>,
    last: u64,
}

impl Subscribed {
    /// It is asked for now; answers with its number.
    pub(crate) fn add(&mut self, service: &'static str, name: &str) -> u64 {
        self.last += 1;
        self.all.insert((service, name.to_owned()), self.last);
        self.last
    }

    /// True if nobody has ended it.
    pub(crate) fn has(&self, service: &'static str, name: &str, number: u64) -> bool {
        self.all.get(&(service, name.to_owned())) == Some(&number)
    }

    /// It has ended, unless another one began under its name.
    pub(crate) fn end(&mut self, service: &'static str, name: &str, number: u64) {
        if self.has(service, name, number) {
            self.all.remove(&(service, name.to_owned()));
        }
    }

    /// True if a service measures for us.
    pub(crate) fn uses(&self, service: &str) -> bool {
        self.all.keys().any(|(known, _)| *known == service)
    }

    /// All of them; none is left.
    pub(crate) fn take(&mut self) -> BTreeMap<(&'static str, String), u64> {
        std::mem::take(&mut self.all)
    }

    /// Those that are not known to have ended, but for what began anew.
    pub(crate) fn put_back(&mut self, taken: BTreeMap<(&'static str, String), u64>) {
        taken.into_iter().for_each(|(of, number)| {
            self.all.entry(of).or_insert(number);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::Subscribed;

    #[test]
    fn what_begins_anew_under_a_name_is_another_one() {
        let mut all = Subscribed::default();
        let first = all.add("ALSonar", "a");
        let taken = all.take();
        assert!(!all.has("ALSonar", "a", first) && !all.uses("ALSonar"));
        let second = all.add("ALSonar", "a");
        // The end of the first, and a Stop that did not come through, say nothing of the second.
        all.end("ALSonar", "a", first);
        all.put_back(taken);
        assert!(all.has("ALSonar", "a", second));
        all.end("ALSonar", "a", second);
        assert!(!all.uses("ALSonar"));
    }
}
