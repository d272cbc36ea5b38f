//! The robots, and the one that this tab looks at: its Start, its Stop, its room and its live values.

use super::RobotsPanel;
use crate::browser::{self, Drawer};
use crate::desk::tab::{new_id, set_if_new};
use crate::link::NoAnswer;
use crate::{link, words};
use behaviour::Id;
use leptos::prelude::*;
use protocol::{FoundRobot, RealRobot, RobotFindings, RobotState, RunPhase, RunState, STOP_PATH, request};
use robot::{Control, Health, Identity, Scene};

const ROBOT_KEY: &str = "rrp.robot";

impl RobotsPanel {
    pub(in crate::desk) fn hear_robots(&self, robots: Vec<RobotState>) {
        set_if_new(&self.all, robots);
        self.look();
    }

    /// Looks at another robot; this tab goes on with it, and the next tab begins with it.
    pub(crate) fn choose(&self, robot: &Id) {
        for drawer in [Drawer::Tab, Drawer::Browser] {
            drawer.put(ROBOT_KEY, robot.as_str());
        }
        self.state().wanted = Some(robot.clone());
        self.look();
    }

    /// Adds a robot, simulated or real, and looks at it.
    pub(crate) fn add(&self, name: &str, real: Option<RealRobot>) {
        let (robots, robot) = (self.clone(), new_id());
        let request = request::AddRobot { robot: robot.clone(), name: name.to_owned(), real: real.map(Box::new) };
        self.tab.ask_or_say(request, move |_| robots.choose(&robot));
    }

    /// Adds a robot that was looked at, and says what it is and which certificate counts from now on.
    pub(crate) fn add_seen(&self, name: &str, real: RealRobot, checked: &RobotFindings) {
        if !checked.model.is_empty() {
            self.tab.say(&words::found_robot(&checked.name, &checked.model, checked.fingerprint.as_deref()), false);
        }
        self.add(
            name,
            Some(RealRobot { fingerprint: checked.fingerprint.clone(), identity: checked.identity.clone(), ..real }),
        );
    }

    /// Gives a robot another name.
    pub(crate) fn rename(&self, robot: &Id, name: &str) {
        self.tab.ask_or_say_no(request::RenameRobot { robot: robot.clone(), name: name.to_owned() });
    }

    /// Gives a robot another address.
    pub(crate) fn reach(&self, robot: &Id, real: RealRobot) {
        self.tab.ask_or_say_no(request::ReachRobot { robot: robot.clone(), real: Box::new(real) });
    }

    /// From now on the body that answers is the robot that this tab looks at.
    pub(crate) fn accept(&self, found: Identity) {
        if let Some(robot) = self.chosen_id() {
            self.tab.ask_or_say_no(request::AcceptRobot { robot, found: Box::new(found) });
        }
    }

    /// Looks step by step whether a robot can be reached, with the login of `robot` where none is said.
    pub(crate) fn check(
        &self,
        real: RealRobot,
        robot: Option<Id>,
        then: impl FnOnce(Result<RobotFindings, NoAnswer>) + 'static,
    ) {
        self.tab.look_up(request::CheckRobot { real: Box::new(real), robot }, move |answer| {
            then(answer.map(|answer| *answer.checked));
        });
    }

    /// Looks for robots that announce themselves; none if that cannot be done.
    pub(crate) fn find(&self, then: impl FnOnce(Vec<FoundRobot>) + 'static) {
        self.tab.look_up(request::FindRobots {}, move |answer| {
            then(answer.map_or_else(|_| Vec::new(), |answer| answer.robots));
        });
    }

    /// Takes control of the robot that this tab looks at, gives it back, or lets it rest.
    pub(crate) fn control(&self, control: Control) {
        if let Some(robot) = self.chosen.get_untracked() {
            self.control_of(robot, control);
        }
    }

    /// Has a robot do something, whichever this tab looks at meanwhile.
    pub(crate) fn control_of(&self, robot: RobotState, control: Control) {
        let tab = self.tab.clone();
        self.tab.ask_or_say(request::ControlRobot { robot: robot.robot, control: control.clone() }, move |_| {
            tab.say(&words::control_done(&robot.name, &control), false);
        });
    }

    /// The names under which a robot remembers faces; none if it does not say them.
    pub(crate) fn faces(&self, robot: &Id, then: impl FnOnce(Vec<String>) + 'static) {
        self.tab.look_up(request::Faces { robot: robot.clone() }, move |answer| {
            then(answer.map_or_else(|_| Vec::new(), |answer| answer.faces));
        });
    }

    /// Removes a robot.
    pub(crate) fn remove(&self, robot: &Id) {
        self.tab.ask_or_say_no(request::RemoveRobot { robot: robot.clone() });
    }

    /// Stops everything on all robots.
    pub(crate) fn stop_all(&self) {
        self.tab.ask_or_say_no(request::Stop { behaviour: None, robot: None });
    }

    /// The robot that this tab looks at; not reactive.
    pub(crate) fn chosen_id(&self) -> Option<Id> {
        self.chosen.with_untracked(|robot| robot.as_ref().map(|robot| robot.robot.clone()))
    }

    /// Returns the health of the robot. Reactive.
    pub(crate) fn health(&self) -> Health {
        self.chosen.read().as_ref().map_or(Health::Connecting, |robot| robot.health.clone())
    }

    /// True if its room can be played with. Reactive.
    pub(crate) fn is_simulated(&self) -> bool {
        self.chosen.read().as_ref().is_some_and(|robot| robot.address.is_none())
    }

    /// Returns the robot, if people may look through a camera of it. Reactive.
    pub(crate) fn with_camera(&self) -> Option<Id> {
        self.chosen.read().as_ref().filter(|robot| robot.camera).map(|robot| robot.robot.clone())
    }

    /// Returns the name that people gave it. Reactive.
    pub(crate) fn name(&self) -> String {
        self.chosen.read().as_ref().map(|robot| robot.name.clone()).unwrap_or_default()
    }

    /// Returns the runs on it, with those that ended there lately, oldest first. Reactive.
    pub(crate) fn runs_here(&self) -> Vec<RunState> {
        let robot = self.chosen.read().as_ref().map(|robot| robot.robot.clone());
        let mut runs = self.runs.get();
        runs.retain(|run| robot.as_ref() == Some(&run.robot));
        runs
    }

    /// The name of a robot on which the open program runs, if there is one. Reactive.
    pub(crate) fn runs_on(&self) -> Option<String> {
        let open = self.document.open.get()?;
        let is_it = |run: &&RunState| run.behaviour == open && run.phase == RunPhase::Running;
        let on = self.runs.read().iter().find(is_it).map(|run| run.robot.clone())?;
        self.all.read().iter().find(|robot| robot.robot == on).map(|robot| robot.name.clone())
    }

    /// Hears how the room of a robot looks now; drops it if this tab looks at another one.
    pub(in crate::desk) fn hear_scene(&self, robot: &Id, scene: Scene) {
        if self.chosen_id().as_ref() == Some(robot) {
            set_if_new(&self.scene, scene);
        }
    }

    /// The wanted robot if it is there, else the first one.
    fn look(&self) {
        let wanted = self.wanted();
        let found = self.all.with_untracked(|robots| {
            let is_it = |known: &&RobotState| wanted.as_ref() == Some(&known.robot);
            robots.iter().find(is_it).or_else(|| robots.first()).cloned()
        });
        let Some(found) = found else { return };
        self.say_if_gone(&found);
        let watched = self.state().watched.replace(found.robot.clone());
        let id = found.robot.clone();
        set_if_new(&self.chosen, Some(found));
        self.aim_stop();
        if watched.as_ref() != Some(&id) {
            set_if_new(&self.scene, Scene::default());
            link::ask(request::Watch { robot: Some(id), scene: true, values: true }, |_| {});
            self.values_of_open();
        }
    }

    fn wanted(&self) -> Option<Id> {
        let kept = || Drawer::Tab.get(ROBOT_KEY).or_else(|| Drawer::Browser.get(ROBOT_KEY));
        let chosen = self.state().wanted.clone();
        chosen.or_else(|| kept().and_then(|text| Id::new(&text).ok()))
    }

    fn say_if_gone(&self, now: &RobotState) {
        let Some(before) = self.chosen.get_untracked() else { return };
        let is_gone = self.all.with_untracked(|robots| robots.iter().all(|known| known.robot != before.robot));
        if is_gone {
            self.tab.say(&words::robot_gone(&before.name, &now.name), false);
        }
    }

    /// The plain Stop button stops the robot that this tab looks at.
    fn aim_stop(&self) {
        let several = self.all.with_untracked(|robots| robots.len() > 1);
        let robot = self.chosen.get_untracked().filter(|_| several);
        let address = robot.as_ref().map_or(STOP_PATH.to_owned(), |robot| format!("{STOP_PATH}?robot={}", robot.robot));
        browser::set_attribute("stop-form", "action", &address);
        let name = robot.map_or(words::the_robot().to_owned(), |robot| robot.name);
        browser::set_attribute("stop", "title", &words::stop_title(&name));
    }
}
