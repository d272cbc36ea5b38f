//! The CPU time and memory that this process and others have used; and how measurements become one number.

use std::fs::read_to_string;

/// Returns the CPU time of this process so far, in nanoseconds; the clock where the system does not say.
pub(crate) fn cpu_nanos() -> u64 {
    let told = read_to_string("/proc/self/schedstat").ok();
    let nanos = told.as_deref().and_then(|text| text.split_whitespace().next()?.parse().ok());
    let clock = || std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_nanos();
    nanos.unwrap_or_else(|| u64::try_from(clock()).unwrap())
}

/// CPU time of `work`, in nanoseconds.
pub(crate) fn cpu_of(work: impl FnOnce()) -> u64 {
    let before = cpu_nanos();
    work();
    (cpu_nanos() - before).max(1)
}

/// Memory of a process in KiB, where the system says.
pub(crate) fn memory_kib(process: &str) -> Option<u64> {
    let status = read_to_string(format!("/proc/{process}/status")).ok()?;
    status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?.split_whitespace().next()?.parse().ok()
}

/// The middle one.
pub(crate) fn median(measured: Vec<f64>) -> f64 {
    share(measured, 50, 100)
}

/// The smallest one that so many of a hundred (or thousand) do not exceed.
pub(crate) fn share(mut measured: Vec<f64>, part: usize, of: usize) -> f64 {
    measured.sort_by(f64::total_cmp);
    measured[(measured.len() * part / of).min(measured.len() - 1)]
}
