//! What the server takes of the memory.

use house::{Outcome, Server};

/// The most that it took since the last question, in KiB.
pub(crate) fn most_memory_kib(server: &Server) -> Outcome<u64> {
    let process = format!("/proc/{}", server.id().ok_or("The server is not running.")?);
    let status = std::fs::read_to_string(format!("{process}/status"))?;
    std::fs::write(format!("{process}/clear_refs"), "5")?;
    let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).ok_or("The process does not tell.")?;
    Ok(most.trim().trim_end_matches("kB").trim().parse()?)
}
