//! Adds a robot, simulated or real.

use super::ConsoleCommand;
use crate::client::unique;
use crate::console::Console;
use crate::find::unquoted;
use crate::refusal::NotDone;
use behaviour::Id;
use protocol::{RealRobot, RobotFindings, request};

/// The variable in which a password is looked for, so that it stands in no history.
pub(super) const PASSWORD: &str = "RRP_ROBOT_PASSWORD";

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "add robot",
    words: "NAME [at ADDRESS [as USER]]",
    help: "Adds a robot: a simulated one, or the NAO or Pepper at an address, with its password from RRP_ROBOT_PASSWORD.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let (name, real) = parse(words);
    if name.is_empty() {
        return Err(NotDone::NoRobotName);
    }
    let robot = Id::new(&format!("robot-{}", unique())).map_err(|reason| NotDone::Id(reason.to_string()))?;
    let Some(mut real) = real else {
        console.ask(request::AddRobot { robot: robot.clone(), name, real: None }).await?;
        let added = console.client()?.robot(Some(&robot)).await?;
        return Ok(format!("{} is there", added.name));
    };
    let checked = check(console, &real, None).await?;
    let failed = checked.steps.iter().find_map(|step| step.failed.clone());
    if let Some(why) = failed {
        return Err(NotDone::NotReached(why.to_string()));
    }
    (real.fingerprint, real.identity) = (checked.fingerprint, checked.identity);
    console.ask(request::AddRobot { robot: robot.clone(), name, real: Some(Box::new(real)) }).await?;
    // A number was appended if another one has the name.
    let robots = console.client()?.robots_that(|robots| robots.iter().any(|known| known.robot == robot)).await?;
    let added = robots.into_iter().find(|known| known.robot == robot).map(|known| known.name).unwrap_or_default();
    Ok(format!("{added} is added: {}", checked.model))
}

/// Looks whether a robot can be reached, with the login of `robot` where none is said.
pub(super) async fn check(
    console: &mut Console,
    real: &RealRobot,
    robot: Option<&Id>,
) -> Result<RobotFindings, NotDone> {
    let check = request::CheckRobot { real: Box::new(real.clone()), robot: robot.cloned() };
    Ok(*console.ask(check).await?.checked)
}

/// The name, and how a real robot is reached.
fn parse(words: &str) -> (String, Option<RealRobot>) {
    match words.rsplit_once(" at ") {
        None => (unquoted(words.trim()).to_owned(), None),
        Some((name, at)) => (unquoted(name.trim()).to_owned(), Some(real(at))),
    }
}

/// `ADDRESS [as USER]`, with the password from the environment.
pub(super) fn real(words: &str) -> RealRobot {
    let (address, user) = words.split_once(" as ").map_or((words, None), |(address, user)| (address, Some(user)));
    let password = user.and_then(|_| std::env::var(PASSWORD).ok());
    RealRobot {
        address: address.trim().to_owned(),
        user: user.map(|user| user.trim().to_owned()),
        password,
        fingerprint: None,
        identity: None,
    }
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn a_robot_is_simulated_unless_it_has_an_address() {
        assert_eq!(parse("\"Blue one\""), ("Blue one".to_owned(), None));
        let (name, real) = parse("\"Nao at home\" at 192.168.1.7:9503 as nao");
        let real = real.unwrap();
        assert_eq!(
            (name.as_str(), real.address.as_str(), real.user.as_deref()),
            ("Nao at home", "192.168.1.7:9503", Some("nao"))
        );
        assert_eq!(parse("blue at nao.local").1.unwrap().user, None);
    }
}
