//! Things to put into the store.
