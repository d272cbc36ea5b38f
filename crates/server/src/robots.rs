//! The robots of this server and what runs on them. People add simulated ones, each in a room of its own, and remove
//! them again; who is there is kept in the data folder.

mod backup;
mod beats;
mod camera;
mod cancel_flag;
mod command_queue;
mod emission_sink;
mod fair;
mod host;
mod identities;
mod live;
mod mailbox;
mod names;
mod order;
pub(crate) mod real;
mod recent;
pub(crate) mod refusal;
mod register;
mod robot_thread;
mod run_marks;
mod run_table;
mod runner;
mod settling;
mod shared;
mod simulated;
mod status_feed;
mod stops;
mod successor;
mod surroundings;
mod tally;
#[cfg(test)]
mod tests;
mod told_times;

pub use backup::{check_robots, put_robots, robots_in};
pub(crate) use command_queue::ByHand;
pub(crate) use host::{Host, StartOrder};
pub(crate) use live::{LiveValues, SeenLive};
pub use refusal::BackupMisfit;
pub(crate) use refusal::StartError;
pub(crate) use run_marks::{MarkPress, PressOutcome, RunMarks};
pub(crate) use stops::Presser;

use crate::recordings::{NotRecorded, Recordings};
use crate::support::lock;
use axum::extract::ws::Utf8Bytes;
use behaviour::{Id, Value};
use engine::Limits;
use order::RobotOrder;
use protocol::{MarkEdit, ROBOTS_MAX, RealRobot, RecordedSession, RecordingMark, Refused, RobotState, RunState};
use refusal::RobotsUnchanged;
use register::{Register, RegisteredRobot};
use robot::SceneEdit;
use settling::Settling;
use status_feed::StatusFeed;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use tokio::sync::watch;

/// Places among those for robots that only the host fills, so that a real robot finds one.
const HOST_ROBOTS: usize = 4;

/// All robots. A clone is the same robots.
#[derive(Clone)]
pub(crate) struct Robots {
    fleet: Arc<Fleet>,
    settling: Settling,
}

struct Fleet {
    /// Oldest first, never empty; locked only for moments.
    hosts: Mutex<Vec<Host>>,
    feed: Arc<StatusFeed>,
    recordings: Recordings,
    data: Option<PathBuf>,
    /// Who is there after a restart; one change at a time.
    register: Mutex<Register>,
}

impl Robots {
    /// The robots that are kept in a data folder, at first one simulated NAO whose noise has this seed. Without a folder
    /// those that are added last as long as the server. Its `epoch` grows with every start of the server.
    ///
    /// # Errors
    /// If a thread cannot be made.
    pub(crate) fn within(
        data: Option<&Path>,
        (seed, epoch): (u64, u64),
        recordings: Recordings,
    ) -> std::io::Result<Self> {
        let (register, feed) = (Register::within(data, seed), Arc::new(StatusFeed::of(epoch)));
        let known = register.known().to_vec();
        let (data, register) = (data.map(Path::to_owned), Mutex::new(register));
        let fleet = Fleet { hosts: Mutex::default(), feed, recordings, data, register };
        let fleet = Arc::new(fleet);
        let hosts: std::io::Result<_> = known.iter().map(|known| fleet.host(known)).collect();
        *lock(&fleet.hosts) = hosts?;
        identities::start(&fleet)?;
        let settling = Settling::start(&fleet)?;
        Ok(Self { fleet, settling })
    }

    /// Adds a robot, simulated or real; asked twice with the same id, it adds one. The last places are for the host.
    ///
    /// # Errors
    /// Why there cannot be another one. Waits for the disk.
    pub(crate) fn add(&self, robot: &Id, name: &str, real: Option<RealRobot>, is_host: bool) -> Result<(), Refused> {
        let fleet = &self.fleet;
        let mut register = lock(&fleet.register);
        if register.known().iter().any(|known| known.robot == *robot) {
            return Ok(());
        }
        let known = register.newcomer(robot, name, real).map_err(RobotsUnchanged::not_added)?;
        if register.known().len() >= ROBOTS_MAX {
            return Err(RobotsUnchanged::TooMany.not_added());
        }
        if !is_host && register.known().len() >= ROBOTS_MAX - HOST_ROBOTS {
            return Err(RobotsUnchanged::KeptForHost.not_added());
        }
        let unkept = |error: std::io::Error| RobotsUnchanged::NewUnkept(error).not_added();
        register.add(known.clone()).map_err(unkept)?;
        let host = fleet.host(&known).inspect_err(|_| drop(register.remove(robot))).map_err(unkept)?;
        lock(&fleet.hosts).push(host);
        Ok(())
    }

    /// Whether it is there and no simulated one.
    pub(crate) fn is_real(&self, robot: &Id) -> bool {
        let register = lock(&self.fleet.register);
        register.known().iter().any(|known| known.robot == *robot && known.real.is_some())
    }

    /// Gives a robot another name.
    ///
    /// # Errors
    /// Why it keeps the old one. Waits for the disk.
    pub(crate) fn rename(&self, robot: &Id, name: &str) -> Result<(), Refused> {
        let mut register = lock(&self.fleet.register);
        self.meant(Some(robot))?;
        let name = register.rename(robot, name).map_err(RobotsUnchanged::stays)?;
        self.fleet.feed.edit(robot, |state| state.name = name);
        Ok(())
    }

    /// Removes a robot on which nothing runs.
    ///
    /// # Errors
    /// Why it stays. Waits for the disk.
    pub(crate) fn remove(&self, robot: &Id) -> Result<(), Refused> {
        let mut register = lock(&self.fleet.register);
        let host = self.meant(Some(robot))?;
        if register.known().len() == 1 {
            return Err(RobotsUnchanged::OnlyOne.stays());
        }
        // Who removes it just after a Stop need not wait until that is written down.
        host.settle();
        if !host.is_idle() {
            return Err(RobotsUnchanged::InUse.stays());
        }
        register.remove(robot).map_err(|error| RobotsUnchanged::Unkept(error).stays())?;
        lock(&self.fleet.hosts).retain(|known| known.id() != robot);
        host.leave();
        Ok(())
    }

    /// The robot that is meant: the first one if none is named.
    ///
    /// # Errors
    /// If there is no such robot.
    pub(crate) fn meant(&self, robot: Option<&Id>) -> Result<Host, Refused> {
        let hosts = lock(&self.fleet.hosts);
        let is_meant = |host: &&Host| robot.is_none_or(|robot| host.id() == robot);
        hosts.iter().find(is_meant).cloned().ok_or(Refused::NoRobot)
    }

    /// The robots on which a behaviour runs, or only the named one of them.
    ///
    /// # Errors
    /// If it runs nowhere there.
    pub(crate) fn running(&self, behaviour: &Id, robot: Option<&Id>) -> Result<Vec<Host>, Refused> {
        let is_meant = |host: &Host| robot.is_none_or(|robot| host.id() == robot) && host.is_running(behaviour);
        let hosts: Vec<_> = self.hosts().into_iter().filter(is_meant).collect();
        if hosts.is_empty() { Err(Refused::NotRunning) } else { Ok(hosts) }
    }

    /// The robots on which a behaviour runs, or only the named one of them, for somebody who had heard of Stops up to `stops`.
    ///
    /// # Errors
    /// If it runs nowhere there, or not any more since a Stop that they had not heard of.
    pub(crate) fn running_since(
        &self,
        behaviour: &Id,
        robot: Option<&Id>,
        stops: Option<u64>,
    ) -> Result<Vec<Host>, Refused> {
        let is_stopped =
            |host: &Host| robot.is_none_or(|robot| host.id() == robot) && host.is_stopped_since(behaviour, stops);
        self.running(behaviour, robot)
            .map_err(|no| if self.hosts().iter().any(is_stopped) { Refused::StoppedSince } else { no })
    }

    /// Stops a behaviour, or everything, on one robot or on all of them, and lets them hold safely. A robot that is not
    /// there any more means all: better too much than too little. Waits for nobody: what is left to do, another thread
    /// does.
    pub(crate) fn stop_now(&self, behaviour: Option<&Id>, robot: Option<&Id>, by: &str) {
        let hosts = self.hosts();
        let one = robot.and_then(|robot| hosts.iter().find(|host| host.id() == robot));
        let meant = one.map_or(&hosts[..], std::slice::from_ref);
        for host in meant {
            host.stop_now(behaviour, by);
        }
        self.settling.ring();
    }

    /// Stops, with all that follows; true if something ran.
    #[cfg(test)]
    fn stop(&self, behaviour: Option<&Id>, robot: Option<&Id>, by: &str) -> bool {
        let hosts = self.hosts();
        let one = robot.and_then(|robot| hosts.iter().find(|host| host.id() == robot));
        let meant = one.map_or(&hosts[..], std::slice::from_ref);
        meant.iter().filter(|host| host.stop(behaviour, by)).count() > 0
    }

    /// The number of the newest Stop of all robots.
    pub(crate) fn newest_stop(&self) -> u64 {
        self.fleet.feed.stops().newest()
    }

    /// Gives a value to a sensor stream of a running behaviour, as if a robot had sensed it.
    ///
    /// # Errors
    /// If the behaviour does not run there, if it has no such sensor stream, or if the robot was stopped since the press.
    pub(crate) fn stimulate(
        &self,
        behaviour: &Id,
        robot: Option<&Id>,
        (stream, value): (&Id, &Value),
        presser: Presser,
    ) -> Result<(), Refused> {
        let hosts = self.running_since(behaviour, robot, presser.stops)?;
        hosts.iter().try_for_each(|host| host.stimulate(behaviour, stream, value.clone(), presser))
    }

    /// Marks the moment of a press in the runs of a behaviour, wherever it runs. Where it runs no more, the run that ended lately
    /// takes what was pressed before its end.
    ///
    /// # Errors
    /// If the behaviour did not run there then, a text is too long, or that was too much at once.
    pub(crate) fn mark(
        &self,
        behaviour: &Id,
        robot: Option<&Id>,
        mark: &RecordingMark,
        press: MarkPress,
    ) -> Result<Vec<PressOutcome>, Refused> {
        let is_meant = |host: &Host| robot.is_none_or(|robot| host.id() == robot);
        match self.running(behaviour, robot) {
            Ok(hosts) => hosts.iter().map(|host| host.mark(behaviour, mark.clone(), press)).collect(),
            Err(no) => {
                let hosts: Vec<_> = self.hosts().into_iter().filter(is_meant).collect();
                let marked = hosts.iter().find_map(|host| host.mark(behaviour, mark.clone(), press).ok());
                marked.map(|marked| vec![marked]).ok_or(no)
            }
        }
    }

    /// Marks the moment of a press in one run, be it over or not.
    ///
    /// # Errors
    /// If that run is forgotten, or did not go on then, if a text is too long, or if that was too much at once.
    pub(crate) fn mark_in(&self, run: u64, mark: &RecordingMark, press: MarkPress) -> Result<PressOutcome, Refused> {
        let marked = self.hosts().iter().find_map(|host| host.mark_in(run, mark.clone(), press));
        marked.unwrap_or(Err(Refused::NotRunning))
    }

    /// Changes a mark of a run.
    ///
    /// # Errors
    /// If the run is forgotten, if there is no such mark, or if that cannot be done to it.
    pub(crate) fn edit_mark(
        &self,
        run: u64,
        id: &Id,
        edit: &MarkEdit,
        press: MarkPress,
    ) -> Result<PressOutcome, Refused> {
        let edited = self.hosts().iter().find_map(|host| host.edit_mark(run, id, edit.clone(), press));
        edited.unwrap_or_else(|| Err(NotRecorded::NoMark.into()))
    }

    /// The marks of a run, also of one that ended lately.
    pub(crate) fn marks(&self, run: u64) -> Option<Arc<RunMarks>> {
        self.hosts().iter().find_map(|host| host.marks(run))
    }

    /// Ends the recordings of a running behaviour.
    ///
    /// # Errors
    /// If the behaviour does not run there.
    pub(crate) fn end_recording(&self, behaviour: &Id, robot: Option<&Id>, by: &str) -> Result<(), Refused> {
        let hosts = self.running(behaviour, robot)?;
        hosts.iter().try_for_each(|host| host.end_recording(behaviour, by))
    }

    /// Records a running behaviour from now on. Waits for the disk.
    ///
    /// # Errors
    /// If the behaviour does not run there, or why it cannot be recorded.
    pub(crate) fn record(
        &self,
        behaviour: &Id,
        robot: Option<&Id>,
        by: &str,
        session: &RecordedSession,
    ) -> Result<(), Refused> {
        let hosts = self.running(behaviour, robot)?;
        hosts.iter().try_for_each(|host| host.record(behaviour, by, session))
    }

    /// Shows of what runs that the invitation of who started it was revoked. It runs on until somebody stops it: what it
    /// does beside a child, the one who is there decides.
    pub(crate) fn revoked(&self, invitation: &Id) {
        self.hosts().iter().for_each(|host| host.revoked(invitation));
    }

    /// Moves something in a robot's room.
    pub(crate) fn edit_scene(&self, robot: Option<&Id>, edit: SceneEdit) {
        if let Ok(host) = self.meant(robot) {
            host.edit_scene(edit);
        }
    }

    /// Pictures of a robot in its room, as messages: of the first one if the named one is not there.
    pub(crate) fn pictures(&self, robot: Option<&Id>) -> Option<watch::Receiver<Utf8Bytes>> {
        let host = self.meant(robot).or_else(|_| self.meant(None)).ok()?;
        Some(host.pictures().subscribe())
    }

    /// What runs and what ended lately, oldest first.
    pub(crate) fn runs(&self) -> watch::Receiver<Arc<Vec<RunState>>> {
        self.fleet.feed.runs()
    }

    /// The robots, oldest first.
    pub(crate) fn states(&self) -> watch::Receiver<Arc<Vec<RobotState>>> {
        self.fleet.feed.robots()
    }

    /// The live values of a run, also of one that ended lately.
    pub(crate) fn values(&self, run: u64) -> Option<LiveValues> {
        self.hosts().iter().find_map(|host| host.values(run))
    }

    /// The robots as a backup keeps them. Reads the data folder: not for the async threads.
    pub(crate) fn kept(&self) -> Vec<store::backup::BackedUpRobot> {
        self.fleet.data.as_deref().map(robots_in).unwrap_or_default()
    }

    /// Whether a behaviour runs on any robot, or is about to.
    pub(crate) fn has(&self, behaviour: &Id) -> bool {
        self.hosts().iter().any(|host| host.has(behaviour))
    }

    /// Stops everything and ends the threads; waits for all of them together about two seconds at most.
    pub(crate) fn shut_down(&self) {
        let hosts = self.hosts();
        hosts.iter().for_each(Host::end);
        hosts.iter().for_each(Host::shut_down);
    }

    /// All of them, oldest first.
    pub(crate) fn hosts(&self) -> Vec<Host> {
        lock(&self.fleet.hosts).clone()
    }
}

impl Fleet {
    /// A robot of the register, on a thread of its own.
    fn host(self: &Arc<Self>, known: &RegisteredRobot) -> std::io::Result<Host> {
        let address = known.real.as_ref().map(|real| real.address.clone());
        let identity = known.real.as_ref().and_then(|real| real.identity.clone());
        let state = RobotState { address, identity, ..RobotState::connecting(known.robot.clone(), known.name.clone()) };
        let (order, known) = (RobotOrder::within(self.data.as_deref(), &known.robot), known.clone());
        let fleet = Arc::downgrade(self);
        let make: robot_thread::Make = Box::new(move || {
            // Made anew, it may be reached in another way than at first.
            let now = fleet.upgrade().and_then(|fleet| {
                let register = lock(&fleet.register);
                Some((register.names(&known.robot), register.real(&known.robot)?.clone()))
            });
            match now {
                Some((names, real)) => Box::new(real::nao(names, &real)),
                None => Box::new(simulated::nao(known.seed)),
            }
        });
        Host::new(state, self.feed.clone(), make, Limits::default, self.recordings.clone(), order)
    }
}
