//! Measures how long a robot goes on by itself when whoever began it is killed, frozen or cut off: by the stand-in's
//! clock, in milliseconds.

use crate::figures::Verdict;
use crate::harm::{ACTIVITIES, HARMS, calm_after};

/// Each harm comes so much later in what goes on than the last, in milliseconds.
const LATER_MS: u64 = 90;

/// Each activity with each harm.
pub(crate) async fn measure(verdict: &mut Verdict) {
    println!("\nfrom a harm until the robot is calm, in ms");
    let names: String = HARMS.iter().map(|(name, _)| format!("{name:>15}")).collect();
    println!("  {:<22}{names}", "");
    for activity in ACTIVITIES {
        let (mut row, mut worst) = (format!("  {:<22}", activity.name), 0.0_f64);
        for ((_, harm), number) in HARMS.into_iter().zip(0..) {
            let Some(ms) = calm_after(&[], &activity, harm, number * LATER_MS).await else { return };
            row.push_str(&format!("{ms:>15.0}"));
            worst = worst.max(ms);
        }
        println!("{row}");
        verdict.at_most(&format!("{} until it is calm, worst", activity.name), worst * 1e3, activity.within_ms * 1e3);
    }
}
