//! Shows who uses a helper.

use super::ConsoleCommand;
use crate::console::{Console, or_nothing};
use crate::refusal::NotDone;
use protocol::{HelperUse, LIBRARY, answer, request};
use std::collections::BTreeMap;

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "where used",
    words: "HELPER",
    help: "Shows the programs and helpers that use a helper, also through other helpers.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let library = console.client()?.library();
    let all: Vec<_> = library.records.helpers().map(|(_, helper)| (helper.name.clone(), ())).collect();
    let (helper, ()) = crate::find::find("helper", wanted, &all)?;
    let answer::WhereUsed { uses, total } = console.ask(request::WhereUsed { helper: helper.clone() }).await?;
    let more = total.saturating_sub(uses.len() as u64);
    let mut lines = lines(&uses);
    lines.extend((more > 0).then(|| format!("and {more} more")));
    Ok(or_nothing(lines, &format!("Nothing uses {helper}.")))
}

/// A line for each program or helper: `Greeter (2 connectors)`, `helper far (through distance)`.
fn lines(uses: &[HelperUse]) -> Vec<String> {
    let (mut counts, mut order): (BTreeMap<String, usize>, Vec<String>) = Default::default();
    for used in uses {
        let through = used.through.as_ref().map_or_else(String::new, |helper| format!(" (through {helper})"));
        let kind = if used.behaviour.as_str() == LIBRARY { "helper " } else { "" };
        let line = format!("{kind}{}{through}", used.name);
        let count = counts.entry(line.clone()).or_default();
        *count += 1;
        if *count == 1 {
            order.push(line);
        }
    }
    let counted = |line: String| if counts[&line] > 1 { format!("{line}, {} times", counts[&line]) } else { line };
    order.into_iter().map(counted).collect()
}
