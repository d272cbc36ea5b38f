//! Times that were taken, how they are printed, and what is beyond its bar.

use rustix::time::ClockId;
use std::process::ExitCode;
use std::time::Duration;

/// The computer's monotonic clock, in microseconds; the stand-in notes calls by the same.
pub(crate) fn monotonic_us() -> f64 {
    at(ClockId::Monotonic)
}

/// Returns the time that this thread has computed, in microseconds.
pub(crate) fn computed_us() -> f64 {
    at(ClockId::ThreadCPUTime)
}

fn at(clock: ClockId) -> f64 {
    let time = rustix::time::clock_gettime(clock);
    time.tv_sec as f64 * 1e6 + time.tv_nsec as f64 / 1e3
}

pub(crate) fn micros(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e6
}

/// Times of one kind, in microseconds.
#[derive(Default)]
pub(crate) struct Times(pub(crate) Vec<f64>);

impl Times {
    /// The time that so many hundredths are within; none if nothing was measured, which holds no bar.
    pub(crate) fn within(&self, hundredths: usize) -> f64 {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        let at = (sorted.len() * hundredths / 100).min(sorted.len().saturating_sub(1));
        sorted.get(at).copied().unwrap_or(f64::NAN)
    }

    /// A line in milliseconds, beside others if there are some.
    pub(crate) fn print(&self, what: &str, beside: Option<&Self>) {
        let ms = |hundredths| self.within(hundredths) / 1e3;
        let ratio = |other: &Self| format!("{:>12.2}", self.within(50) / other.within(50));
        let beside = beside.map(ratio).unwrap_or_default();
        println!("  {what:<64}{:>8}{:>10.3}{:>10.3}{:>10.3}{beside}", self.0.len(), ms(50), ms(99), ms(100));
    }
}

/// Prints the names of the columns.
pub(crate) fn title(what: &str, beside: &str) {
    println!("\n{what:<66}{:>8}{:>10}{:>10}{:>10}{beside:>12}", "times", "p50 ms", "p99 ms", "worst ms");
}

/// The measurements that were beyond their bar.
#[derive(Default)]
pub(crate) struct Verdict(Vec<String>);

impl Verdict {
    /// Prints a measurement and whether it held its bar. A time that was not measured holds no bar either.
    pub(crate) fn at_most(&mut self, what: &str, measured_us: f64, bar_us: f64) {
        let holds = measured_us <= bar_us;
        println!(
            "  {}  {what}: {:.3} ms, at most {:.3}",
            if holds { "held  " } else { "MISSED" },
            measured_us / 1e3,
            bar_us / 1e3
        );
        if !holds {
            self.0.push(what.to_owned());
        }
    }

    /// A ratio of two times of one run.
    pub(crate) fn ratio_at_most(&mut self, what: &str, measured: f64, bar: f64) {
        let holds = measured <= bar;
        println!("  {}  {what}: {measured:.2}, at most {bar:.2}", if holds { "held  " } else { "MISSED" });
        if !holds {
            self.0.push(what.to_owned());
        }
    }

    /// A part came to no end; why is printed above.
    pub(crate) fn broke_off(&mut self, part: &str) {
        println!("  MISSED  {part} came to no end");
        self.0.push(format!("{part} came to no end"));
    }

    pub(crate) fn tell(&self) -> ExitCode {
        let all =
            if self.0.is_empty() { "No bar is missed.".to_owned() } else { format!("MISSED: {}", self.0.join("; ")) };
        println!("\n{all}");
        if self.0.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }
}
