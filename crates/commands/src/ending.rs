//! Ends of a server: signals, and the end of the terminal that it was started in.

use std::io;
use std::task::Poll;
use tokio::sync::oneshot;

/// Hears from now on what asks the server to end, and waits for the first of it: Ctrl-C, SIGTERM, SIGQUIT, SIGHUP, or a
/// terminal that is gone. Who starts it with SIGHUP ignored, as `nohup` does, wants it to outlive the terminal.
///
/// # Errors
/// If signals cannot be heard.
pub(crate) fn asked() -> io::Result<impl Future<Output = ()>> {
    let outlives = outlives_terminal();
    let mut signals = signals::heard(outlives)?;
    let mut terminal = (!outlives).then(terminal_gone).flatten();
    Ok(std::future::poll_fn(move |context| {
        let is_gone =
            terminal.as_mut().is_some_and(|gone| std::pin::Pin::new(gone).poll(context) == Poll::Ready(Ok(())));
        // Each is asked, so that each wakes this.
        let is_asked = signals.iter_mut().fold(false, |asked, signal| asked | signal.poll_recv(context).is_ready());
        if is_gone || is_asked { Poll::Ready(()) } else { Poll::Pending }
    }))
}

#[cfg(unix)]
mod signals {
    use std::io;
    use tokio::signal::unix::{Signal, SignalKind, signal};

    pub(super) fn heard(outlives_terminal: bool) -> io::Result<Vec<Signal>> {
        let always = [SignalKind::interrupt(), SignalKind::terminate(), SignalKind::quit()];
        let all = always.into_iter().chain((!outlives_terminal).then(SignalKind::hangup));
        all.map(signal).collect()
    }
}

#[cfg(not(unix))]
mod signals {
    use std::io;
    use std::task::{Context, Poll};
    use tokio::signal::windows::{CtrlBreak, CtrlC, CtrlClose, CtrlLogoff, CtrlShutdown};
    use tokio::signal::windows::{ctrl_break, ctrl_c, ctrl_close, ctrl_logoff, ctrl_shutdown};

    /// All that Windows tells.
    pub(super) struct Signals(CtrlC, CtrlBreak, CtrlClose, CtrlLogoff, CtrlShutdown);

    impl Signals {
        pub(super) fn poll_recv(&mut self, context: &mut Context) -> Poll<Option<()>> {
            let Self(c, pause, close, logoff, shutdown) = self;
            let all = [c.poll_recv(context), pause.poll_recv(context), close.poll_recv(context)];
            let others = [logoff.poll_recv(context), shutdown.poll_recv(context)];
            all.into_iter().chain(others).find(Poll::is_ready).unwrap_or(Poll::Pending)
        }
    }

    pub(super) fn heard(_: bool) -> io::Result<Vec<Signals>> {
        Ok(vec![Signals(ctrl_c()?, ctrl_break()?, ctrl_close()?, ctrl_logoff()?, ctrl_shutdown()?)])
    }
}

/// Whether SIGHUP was ignored when this began; told on Linux only.
fn outlives_terminal() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    // One bit a signal; that of SIGHUP, which is 1, is the lowest.
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask & 1 == 1)
}

/// Told when the terminal on standard error has gone without a signal, as where a shell in between was killed; none where
/// there is no terminal.
#[cfg(unix)]
fn terminal_gone() -> Option<oneshot::Receiver<()>> {
    use rustix::event::{PollFd, PollFlags, poll};
    use std::io::IsTerminal;
    if !io::stderr().is_terminal() {
        return None;
    }
    let (tell, gone) = oneshot::channel();
    let wait = move || {
        let error = io::stderr();
        // Nothing is asked for, so that only a terminal that has gone is told; a signal may come in between.
        while poll(&mut [PollFd::new(&error, PollFlags::empty())], None) == Err(rustix::io::Errno::INTR) {}
        let _ = tell.send(());
    };
    std::thread::Builder::new().name("terminal".into()).spawn(wait).ok()?;
    Some(gone)
}

#[cfg(not(unix))]
fn terminal_gone() -> Option<oneshot::Receiver<()>> {
    None
}
