//! Two computers with a wire between them, inside this one.

use house::{Outcome, Trouble};
use rustix::thread::{LinkNameSpaceType, move_into_link_name_space};
use std::fs::File;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr};
use std::os::fd::AsFd;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};
use tokio::process::{Child, Command};

/// The address of the server's computer.
pub(crate) const HERE: Ipv4Addr = Ipv4Addr::new(10, 77, 0, 1);
/// That of the other one.
pub(crate) const THERE: Ipv4Addr = Ipv4Addr::new(10, 77, 0, 2);
/// The address of the server's computer in IPv6.
pub(crate) const HERE_V6: Ipv6Addr = Ipv6Addr::new(0xfd77, 0, 0, 0, 0, 0, 0, 1);
/// That of the other one.
pub(crate) const THERE_V6: Ipv6Addr = Ipv6Addr::new(0xfd77, 0, 0, 0, 0, 0, 0, 2);
/// More computers behind the other end of the wire, in each protocol.
const STRANGERS: u8 = 8;
/// Set where the test runs in a network of its own.
const INSIDE: &str = "RRP_INSIDE_A_NETWORK";
/// How long the system may take to make a network.
const PATIENCE: Duration = Duration::from_secs(30);
/// Between two looks.
const LOOK: Duration = Duration::from_millis(10);

/// More addresses at the other computer, as if there were more of them.
pub(crate) fn strangers() -> impl Iterator<Item = IpAddr> {
    (3..3 + STRANGERS).map(|last| Ipv4Addr::new(10, 77, 0, last).into())
}

/// As `strangers`, in IPv6: of one network of 64 bits with the first address.
pub(crate) fn strangers_v6() -> impl Iterator<Item = IpAddr> {
    (3..3 + u16::from(STRANGERS)).map(|last| Ipv6Addr::new(0xfd77, 0, 0, 0, 0, 0, 0, last).into())
}

/// Whether this is the process in the network of its own.
pub(crate) fn is_inside() -> bool {
    std::env::var_os(INSIDE).is_some()
}

/// Why no network can be made, if so.
pub(crate) fn missing() -> Option<String> {
    let wire = "ip link add rrp0 type veth peer name rrp1 && command -v nsenter";
    let tried = std::process::Command::new("unshare").args(["-rn", "sh", "-c", wire]).output();
    match tried {
        Ok(done) if done.status.success() => None,
        Ok(done) => Some(format!("no network can be made: {}", String::from_utf8_lossy(&done.stderr).trim())),
        Err(error) => Some(format!("there is no `unshare` ({error})")),
    }
}

/// Runs one test of this binary again in a network of its own.
pub(crate) fn again_inside(test: &str) -> Outcome<()> {
    let mut again = std::process::Command::new("unshare");
    again.arg("-rn").arg(std::env::current_exe()?).args([test, "--exact", "--nocapture", "--include-ignored"]);
    let done = again.env(INSIDE, "1").output()?;
    let said = [done.stdout, done.stderr].map(|out| String::from_utf8_lossy(&out).into_owned()).concat();
    // A name that is none runs nothing and succeeds.
    let ran = said.contains("1 passed");
    if !done.status.success() || !ran {
        return Err(Trouble(said));
    }
    println!("{said}");
    Ok(())
}

/// The wire, and the other computer for as long as this is there.
pub(crate) struct Network(Child);

impl Network {
    /// Makes the other computer and lays the wire.
    pub(crate) async fn lay() -> Outcome<Self> {
        let mut holder = Command::new("unshare");
        holder.args(["--net", "sleep", "3600"]).stdin(Stdio::null()).kill_on_drop(true);
        let this = Self(holder.spawn()?);
        let began = Instant::now();
        while std::fs::read_link(this.space())? == std::fs::read_link("/proc/self/ns/net")? {
            if began.elapsed() > PATIENCE {
                return Err(Trouble("The other computer did not come about.".into()));
            }
            tokio::time::sleep(LOOK).await;
        }
        let other = this.id();
        let more: Vec<IpAddr> = strangers().chain(strangers_v6()).collect();
        let here = up("rrp0", &[HERE.into(), HERE_V6.into()]);
        let there = up("rrp1", &[&[THERE.into(), THERE_V6.into()], &more[..]].concat());
        sh(&format!("ip link add rrp0 type veth peer name rrp1 netns {other} && {here}")).await?;
        sh(&format!("nsenter -t {other} -n sh -c '{there}'")).await?;
        Ok(this)
    }

    fn id(&self) -> u32 {
        self.0.id().unwrap_or_default()
    }

    fn space(&self) -> String {
        format!("/proc/{}/ns/net", self.id())
    }

    /// A program that runs at the other computer and leaves this one's processors to everybody else, as if it had its own.
    pub(crate) fn there(&self, program: &Path) -> Command {
        let mut there = Command::new("nsenter");
        there.args(["-t", &self.id().to_string(), "-n", "nice", "-n", "19"]).arg(program);
        there
    }

    /// Does something at the other computer. Sockets that are made there stay there, whoever reads them.
    pub(crate) async fn do_there<T: Send + 'static>(
        &self,
        work: impl Future<Output = T> + Send + 'static,
    ) -> Outcome<T> {
        let (space, runtime) = (File::open(self.space())?, tokio::runtime::Handle::current());
        let there = std::thread::spawn(move || {
            move_into_link_name_space(space.as_fd(), Some(LinkNameSpaceType::Network))?;
            // Polled on this thread, so that what it connects leaves by the other computer's network.
            Ok::<_, std::io::Error>(runtime.block_on(work))
        });
        let joined =
            tokio::task::spawn_blocking(move || there.join()).await.map_err(|error| Trouble(error.to_string()))?;
        Ok(joined.map_err(|_| Trouble("What was done at the other computer failed.".into()))??)
    }
}

/// Gives one end of the wire these addresses.
fn up(name: &str, addresses: &[IpAddr]) -> String {
    let add = |address: &IpAddr| match address {
        IpAddr::V4(v4) => format!("ip addr add {v4}/24 dev {name}"),
        IpAddr::V6(v6) => format!("ip addr add {v6}/64 dev {name} nodad"),
    };
    let added: Vec<String> = addresses.iter().map(add).collect();
    format!("ip link set lo up && {} && ip link set {name} up", added.join(" && "))
}

async fn sh(line: &str) -> Outcome<()> {
    let done = Command::new("sh").args(["-c", line]).output().await?;
    let why = String::from_utf8_lossy(&done.stderr).into_owned();
    if done.status.success() { Ok(()) } else { Err(Trouble(format!("{line}: {why}"))) }
}
