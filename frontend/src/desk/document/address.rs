//! The address of the page holds which behaviour is open: `#/b/<id>`.

use super::Document;
use crate::browser::{self, Drawer};
use behaviour::Id;

const LAST_KEY: &str = "rrp.last";

impl Document {
    /// Takes what is to be open from the address, else what was open last, and follows the address from now on.
    pub(in crate::desk) fn follow_address(&self) {
        let wanted =
            in_hash(&browser::hash()).or_else(|| Drawer::Browser.get(LAST_KEY).and_then(|id| Id::new(&id).ok()));
        if let Some(id) = &wanted {
            browser::set_hash(&hash_of(id));
        }
        self.input(|editor| editor.begin_with(wanted));
        let document = self.clone();
        if let Some(window) = browser::window() {
            browser::hear(&window, "hashchange", move |_| document.address_changed());
        }
    }

    fn address_changed(&self) {
        let wanted = self.state().editor.wanted().cloned();
        match in_hash(&browser::hash()) {
            Some(id) if Some(&id) != wanted.as_ref() => self.open_program(&id),
            None if wanted.is_some() => self.close_program(),
            Some(_) | None => {}
        }
    }

    pub(super) fn remember_address(&self, id: Option<&Id>) {
        match id {
            Some(id) => {
                Drawer::Browser.put(LAST_KEY, id.as_str());
                browser::set_hash(&hash_of(id));
            }
            None => {
                Drawer::Browser.drop(LAST_KEY);
                browser::set_hash("#/");
            }
        }
    }
}

fn hash_of(id: &Id) -> String {
    format!("#/b/{id}")
}

fn in_hash(hash: &str) -> Option<Id> {
    Id::new(hash.strip_prefix("#/b/")?).ok()
}

#[cfg(test)]
mod tests {
    use super::{hash_of, in_hash};

    #[test]
    fn the_address_names_the_open_behaviour() {
        let id = in_hash("#/b/a-1").unwrap();
        assert_eq!(hash_of(&id), "#/b/a-1");
        assert!(in_hash("#/").is_none() && in_hash("").is_none() && in_hash("#/b/").is_none());
    }
}
