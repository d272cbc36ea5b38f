//! The time that each test takes which needs a browser or a server: from when it asks for them until its thread ends.

use std::fs::OpenOptions;
use std::io::Write;
use std::time::Instant;

thread_local! {
    static TIMED: Option<Timed> = Timed::begun();
}

/// The test of a thread; noted for `cargo xtask test` as the thread ends, also where the test failed.
struct Timed {
    name: String,
    list: std::ffi::OsString,
    began: Instant,
}

impl Timed {
    fn begun() -> Option<Self> {
        let name = std::thread::current().name()?.to_owned();
        Some(Self { name, list: std::env::var_os("RRP_TIMES_LIST")?, began: Instant::now() })
    }
}

impl Drop for Timed {
    fn drop(&mut self) {
        let line = format!("{:.1} {}\n", self.began.elapsed().as_secs_f64(), self.name);
        // One write, as tests end beside each other.
        if let Ok(mut file) = OpenOptions::new().create(true).append(true).open(&self.list) {
            let _ = file.write_all(line.as_bytes());
        }
    }
}

/// From now on the time of this thread's test is taken, if somebody wants to know it.
pub(crate) fn begin() {
    TIMED.with(|_| ());
}
