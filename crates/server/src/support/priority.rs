//! How threads share the processor: those that carry messages and Stop come before those that compute for people.

/// What a thread is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Priority {
    /// Runs a behaviour.
    Run,
    /// Works on what people send.
    Work,
}

/// Gives the calling thread its priority. Threads for messages, the robot and Stop keep the usual one. Where the system
/// cannot, everything shares as before.
#[cfg(target_os = "linux")]
pub(crate) fn of_this_thread(priority: Priority) {
    let nice = match priority {
        Priority::Run => 5,
        Priority::Work => 10,
    };
    // On Linux the niceness belongs to a thread, named by its own id.
    if let Err(error) = rustix::process::setpriority_process(Some(rustix::thread::gettid()), nice) {
        tracing::debug!(%error, "a thread keeps the usual priority");
    }
}

/// Elsewhere niceness belongs to the whole process.
#[cfg(not(target_os = "linux"))]
pub(crate) fn of_this_thread(_: Priority) {}
