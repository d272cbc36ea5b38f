//! Putting back all that was set on a robot for us, also by a server that is gone.

use crate::kept::{key, memory};
use crate::link::try_call;
use crate::{hearing, voicing};
use qi::{Session, Value};
use std::collections::BTreeSet;

/// Puts back what was set under a name of ours, and under names that nobody has any more.
pub(crate) async fn put_back(session: &Session, own_name: &str, former: &[String]) {
    let mut names = BTreeSet::from([own_name.to_owned()]);
    if !former.is_empty() {
        for what in [hearing::WHAT, voicing::WHAT] {
            let keys = try_call(session, &memory("getDataList", [key("", what).into()])).await;
            let keys = keys.as_ref().and_then(Value::items).unwrap_or_default();
            let keys: BTreeSet<_> = keys.iter().filter_map(Value::as_text).collect();
            names.extend(former.iter().filter(|name| keys.contains(key(name, what).as_str())).cloned());
        }
    }
    for name in &names {
        hearing::put_back(session, name).await;
        voicing::put_back_left(session, name).await;
    }
}
