//! The settings that were changed on a robot for us and have to be put back: how they were is kept in the robot's own
//! memory, so that the next connection finds it, whatever became of who set them.

use crate::deed::Call;
use crate::link::try_call;
use crate::{hearing, voicing};
use qi::{Session, Value};
use std::collections::BTreeSet;

fn key(own_name: &str, what: &str) -> String {
    format!("{own_name}/{what}")
}

fn memory(method: &'static str, arguments: impl Into<Vec<Value>>) -> Call {
    Call::new("ALMemory", method, arguments)
}

/// Returns what was kept, if something was.
pub(crate) async fn kept(session: &Session, own_name: &str, what: &str) -> Option<Value> {
    let value = try_call(session, &memory("getData", [key(own_name, what).into()])).await?;
    let is_gone = value.as_text().is_some_and(|text| text.is_empty());
    (!is_gone).then_some(value)
}

/// Keeps it.
pub(crate) async fn keep(session: &Session, own_name: &str, what: &str, value: Value) {
    try_call(session, &memory("insertData", [key(own_name, what).into(), Value::dynamic(value)])).await;
}

/// It was put back.
pub(crate) async fn forget(session: &Session, own_name: &str, what: &str) {
    // Before it is gone for good: some robots cannot take data away.
    keep(session, own_name, what, "".into()).await;
    try_call(session, &memory("removeData", [key(own_name, what).into()])).await;
}

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
