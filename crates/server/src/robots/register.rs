//! Which robots there are, kept in the data folder before it counts.

use super::names::RobotNames;
use super::refusal::RobotsUnchanged;
use crate::support::atomic_file;
use behaviour::{Id, has_unseen, numbered};
use protocol::{ADDRESS_MAX_CHARS, LOGIN_MAX_CHARS, ROBOT_NAME_MAX_CHARS, RealRobot};
use robot::Identity;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Its file in the data folder.
const FILE: &str = "robots.json";
/// The robot that is there at first.
const FIRST: (&str, &str) = ("simulated-nao", "Simulated NAO");

/// The robots that are known, oldest first; never empty.
pub(super) struct Register {
    path: Option<PathBuf>,
    known: Vec<RegisteredRobot>,
    names: RobotNames,
    seed: u64,
}

/// A robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct RegisteredRobot {
    /// Its id.
    pub(super) robot: Id,
    /// What people call it.
    pub(super) name: String,
    /// The seed of its noise, if it is simulated.
    pub(super) seed: u64,
    /// How it is reached, with its password; none for a simulated one. Only the server's user may read the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) real: Option<RealRobot>,
}

impl Register {
    /// What is kept in a data folder, at first one robot with this seed.
    pub(super) fn within(data: Option<&Path>, seed: u64) -> Self {
        let path = data.map(|data| data.join(FILE));
        let known: Vec<RegisteredRobot> = path.as_deref().and_then(atomic_file::read).unwrap_or_default();
        let mut this = Self { path, known, names: RobotNames::within(data), seed };
        if let (true, Ok(robot)) = (this.known.is_empty(), Id::new(FIRST.0)) {
            this.known.push(RegisteredRobot { robot, name: FIRST.1.to_owned(), seed, real: None });
        }
        this
    }

    /// True if it was ever written: people added or removed a robot.
    pub(super) fn is_kept(&self) -> bool {
        self.path.as_ref().is_some_and(|path| path.is_file())
    }

    /// Others in their place.
    pub(super) fn replace(&mut self, known: Vec<RegisteredRobot>) -> std::io::Result<()> {
        self.keep(known)
    }

    /// All of them.
    pub(super) fn known(&self) -> &[RegisteredRobot] {
        &self.known
    }

    /// A robot to be, with a name and noise that no other has.
    ///
    /// # Errors
    /// What is wrong with the name, or with how it is reached.
    pub(super) fn newcomer(
        &self,
        robot: &Id,
        name: &str,
        real: Option<RealRobot>,
    ) -> Result<RegisteredRobot, RobotsUnchanged> {
        let name = self.name_for(robot, name)?;
        real.as_ref().map_or(Ok(()), check_real)?;
        let twin = real.as_ref().and_then(|real| self.twin(real.identity.as_ref()?, Some(robot)));
        twin.map_or(Ok(()), |twin| Err(RobotsUnchanged::Twin(twin.to_owned())))?;
        let seed = self.known.iter().map(|known| known.seed).fold(self.seed, u64::max).wrapping_add(1);
        Ok(RegisteredRobot { robot: robot.clone(), name, seed, real })
    }

    /// A name that no other robot has.
    fn name_for(&self, robot: &Id, name: &str) -> Result<String, RobotsUnchanged> {
        let name = name.trim();
        if name.is_empty() || has_unseen(name) {
            return Err(RobotsUnchanged::Nameless);
        }
        if name.chars().count() > ROBOT_NAME_MAX_CHARS {
            return Err(RobotsUnchanged::LongName);
        }
        let others = || self.known.iter().filter(|known| known.robot != *robot);
        Ok(numbered(name, " ")
            .find(|wanted| others().all(|known| !behaviour::look_same(&known.name, wanted)))
            .unwrap_or_default())
    }

    /// Another name for one; answers with the name that it got.
    ///
    /// # Errors
    /// What is wrong with the name, or that it could not be kept.
    pub(super) fn rename(&mut self, robot: &Id, name: &str) -> Result<String, RobotsUnchanged> {
        let (name, mut after) = (self.name_for(robot, name)?, self.known.clone());
        if let Some(known) = after.iter_mut().find(|known| known.robot == *robot) {
            known.name.clone_from(&name);
        }
        self.keep(after).map_err(RobotsUnchanged::Unkept)?;
        Ok(name)
    }

    /// The name of another robot that is this body.
    pub(super) fn twin(&self, identity: &Identity, but: Option<&Id>) -> Option<&str> {
        let is_it = |real: &RealRobot| real.identity.as_ref().is_some_and(|known| known.is_same(identity));
        let mut others = self.known.iter().filter(|known| Some(&known.robot) != but && identity.is_proven());
        others.find(|known| known.real.as_ref().is_some_and(is_it)).map(|known| known.name.as_str())
    }

    /// How a real robot is reached.
    pub(super) fn real(&self, robot: &Id) -> Option<&RealRobot> {
        self.known.iter().find(|known| known.robot == *robot)?.real.as_ref()
    }

    /// Returns the name that a robot's subscriptions begin with, and the names that no robot has any more.
    pub(super) fn names(&self, robot: &Id) -> (String, Vec<String>) {
        (self.names.own(robot), self.names.former(self.known.iter().map(|known| &known.robot)))
    }

    /// Another way to a real robot; answers with the robot as it is kept then.
    ///
    /// # Errors
    /// What is wrong with that way, or that it could not be kept.
    pub(super) fn reach(&mut self, robot: &Id, real: RealRobot) -> Result<RegisteredRobot, RobotsUnchanged> {
        check_real(&real)?;
        let mut after = self.known.clone();
        let known = after.iter_mut().find(|known| known.robot == *robot && known.real.is_some());
        let known = known.ok_or(RobotsUnchanged::Simulated)?;
        let before = known.real.replace(real);
        let known = known.clone();
        self.keep(after).map_err(RobotsUnchanged::Unkept)?;
        let body = |real: Option<&RealRobot>| real.and_then(|real| real.identity.clone());
        if let (Some(before), Some(now)) = (body(before.as_ref()), body(known.real.as_ref()))
            && !before.is_same(&now)
        {
            self.names.change(robot);
        }
        Ok(known)
    }

    /// One more.
    pub(super) fn add(&mut self, known: RegisteredRobot) -> std::io::Result<()> {
        let mut after = self.known.clone();
        after.push(known);
        self.keep(after)
    }

    /// One less.
    pub(super) fn remove(&mut self, robot: &Id) -> std::io::Result<()> {
        let mut after = self.known.clone();
        after.retain(|known| known.robot != *robot);
        self.keep(after)?;
        self.names.leave(robot);
        Ok(())
    }

    fn keep(&mut self, after: Vec<RegisteredRobot>) -> std::io::Result<()> {
        if let Some(path) = &self.path {
            atomic_file::put(path, &serde_json::to_string(&after).map_err(std::io::Error::other)?)?;
        }
        self.known = after;
        Ok(())
    }
}

/// True if a robot may be reached like this.
pub(super) fn check_real(real: &RealRobot) -> Result<(), RobotsUnchanged> {
    let is_short = |text: &Option<String>| text.as_ref().is_none_or(|text| text.chars().count() <= LOGIN_MAX_CHARS);
    let address = &real.address;
    if address.trim().is_empty() || has_unseen(address) || address.chars().count() > ADDRESS_MAX_CHARS {
        return Err(RobotsUnchanged::Address);
    }
    if !is_short(&real.user) || !is_short(&real.password) {
        return Err(RobotsUnchanged::LongLogin);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::Register;
    use behaviour::Id;
    use protocol::RealRobot;

    #[test]
    fn who_is_there_is_kept_under_names_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let id = |text: &str| Id::new(text).unwrap();
        let mut register = Register::within(Some(folder.path()), 7);
        for robot in ["a", "b"] {
            let known = register.newcomer(&id(robot), " Simulated NAO ", None).unwrap();
            register.add(known).unwrap();
        }
        register.remove(&id("simulated-nao")).unwrap();
        let again = Register::within(Some(folder.path()), 1);
        let known: Vec<_> = again.known().iter().map(|known| (known.name.as_str(), known.seed)).collect();
        assert_eq!(known, [("Simulated NAO 2", 8), ("Simulated NAO 3", 9)]);
    }

    #[test]
    fn a_file_from_before_identities_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let before = r#"[{"robot":"a","name":"Blue","seed":1,"real":{"address":"nao.local"}}]"#;
        std::fs::write(folder.path().join("robots.json"), before).unwrap();
        let mut register = Register::within(Some(folder.path()), 1);
        let robot = Id::new("a").unwrap();
        let real = register.real(&robot).cloned().unwrap();
        assert_eq!((real.address.as_str(), &real.identity), ("nao.local", &None));
        let identity = robot::Identity { serial: "B1".into(), ..robot::Identity::default() };
        register.reach(&robot, RealRobot { identity: Some(identity.clone()), ..real }).unwrap();
        let again = Register::within(Some(folder.path()), 1);
        assert_eq!(again.real(&robot).unwrap().identity, Some(identity.clone()));
        assert_eq!(again.twin(&identity, None), Some("Blue"));
        assert_eq!(again.twin(&identity, Some(&robot)), None, "not of itself");
        assert_eq!(again.names(&robot), ("rrp-a".to_owned(), Vec::new()));
    }

    #[test]
    fn what_is_left_on_a_body_is_found_whoever_it_is_by_then() {
        let folder = tempfile::tempdir().unwrap();
        let mut register = Register::within(Some(folder.path()), 1);
        let body = |serial: &str| RealRobot {
            address: "nao.local".into(),
            user: None,
            password: None,
            fingerprint: None,
            identity: Some(robot::Identity { serial: serial.into(), ..robot::Identity::default() }),
        };
        let (blue, green) = (Id::new("blue").unwrap(), Id::new("green").unwrap());
        for (robot, serial) in [(&blue, "B1"), (&green, "B2")] {
            let known = register.newcomer(robot, robot.as_str(), Some(body(serial))).unwrap();
            register.add(known).unwrap();
        }
        let elsewhere = RealRobot { address: "10.0.0.9".into(), ..body("B1") };
        register.reach(&blue, elsewhere).unwrap();
        assert_eq!(register.names(&blue), ("rrp-blue".to_owned(), Vec::new()), "it is the same body");
        register.reach(&blue, body("B3")).unwrap();
        assert_eq!(register.names(&blue), ("rrp-blue-2".to_owned(), vec!["rrp-blue".to_owned()]));
        register.remove(&blue).unwrap();
        let again = Register::within(Some(folder.path()), 1);
        let both = vec!["rrp-blue".to_owned(), "rrp-blue-2".to_owned()];
        assert_eq!(again.names(&green), ("rrp-green".to_owned(), both));
    }

    #[test]
    fn a_name_is_needed() {
        let register = Register::within(None, 1);
        let robot = Id::new("a").unwrap();
        assert!(register.newcomer(&robot, " \t ", None).is_err());
        assert!(register.newcomer(&robot, "a\u{7}", None).is_err());
        assert!(register.newcomer(&robot, "NAO\u{202e}", None).is_err());
        assert!(register.newcomer(&robot, &"x".repeat(41), None).is_err());
        assert!(register.newcomer(&robot, &"x".repeat(40), None).is_ok());
    }

    #[test]
    fn a_real_robot_is_kept_with_its_password_for_the_servers_user_only() {
        let folder = tempfile::tempdir().unwrap();
        let mut register = Register::within(Some(folder.path()), 1);
        let real = RealRobot {
            address: "nao.local".into(),
            user: Some("nao".into()),
            password: Some("hush".into()),
            fingerprint: None,
            identity: None,
        };
        let robot = Id::new("a").unwrap();
        let nowhere = RealRobot { address: " ".into(), ..real.clone() };
        assert!(register.newcomer(&robot, "NAO", Some(nowhere)).is_err());
        let long = RealRobot { password: Some("x".repeat(201)), ..real.clone() };
        assert!(register.newcomer(&robot, "NAO", Some(long)).is_err());
        let known = register.newcomer(&robot, "NAO", Some(real.clone())).unwrap();
        register.add(known).unwrap();
        assert_eq!(register.rename(&robot, "Simulated NAO").unwrap(), "Simulated NAO 2");
        let again = Register::within(Some(folder.path()), 1);
        assert_eq!((again.known()[1].name.as_str(), &again.known()[1].real), ("Simulated NAO 2", &Some(real)));
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = std::fs::metadata(folder.path().join("robots.json")).unwrap().permissions().mode();
            assert_eq!(mode & 0o077, 0, "nobody else may read it");
        }
    }
}
