//! `rrp robot`: the robots of a running server, from a command line. It says to the server what the console says.

use crate::LineCommand;
use clap::{Args, Subcommand};
use server::PageFiles;
use shell::Console;
use std::process::ExitCode;

/// Adds, finds and looks after the robots of a running server.
///
/// A robot's password is taken from RRP_ROBOT_PASSWORD, so that it stands in no history. Exit codes: 0 done; 1 not.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp robot find
  rrp robot add \"NAO blue\" --address nao.local
  RRP_ROBOT_PASSWORD=... rrp robot add Pepper --address 192.168.1.7 --user nao
  rrp robot check 192.168.1.7:9559
  rrp robot reach \"NAO blue\" --address 192.168.1.9")]
pub(crate) struct RobotArgs {
    /// The server's address.
    #[arg(long, value_name = "URL", default_value = shell::DEFAULT_URL, global = true)]
    server: String,
    #[command(subcommand)]
    what: RobotCommand,
}

impl LineCommand for RobotArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp robot add NAO --address nao.local"];

    fn run(self, _: PageFiles) -> ExitCode {
        robot(&self)
    }
}

#[derive(Debug, Subcommand)]
enum RobotCommand {
    /// Lists the robots, how they are and what runs on them.
    List,
    /// Finds the robots that announce themselves in the server's network.
    Find,
    /// Looks step by step whether a NAO or Pepper can be reached.
    Check {
        /// Its name or number in the network, with a port if it is not 9559 or 9503.
        address: String,
        /// The user, for robots that ask for one.
        #[arg(long)]
        user: Option<String>,
    },
    /// Adds a robot: the one at an address, or without one a simulated robot.
    Add {
        /// What people shall call it.
        name: String,
        /// Its name or number in the network, with a port if it is not 9559 or 9503.
        #[arg(long)]
        address: Option<String>,
        /// The user, for robots that ask for one.
        #[arg(long, requires = "address")]
        user: Option<String>,
    },
    /// Gives a robot another name.
    Rename {
        /// Its name now.
        name: String,
        /// Its name then.
        new: String,
    },
    /// Gives a NAO or Pepper another address.
    Reach {
        /// Its name.
        name: String,
        /// Its name or number in the network now, with a port if it is not 9559 or 9503.
        #[arg(long)]
        address: String,
        /// The user, if another one is asked for than before.
        #[arg(long)]
        user: Option<String>,
    },
    /// Takes the other robot that answers at a robot's address for this one from now on.
    Accept {
        /// The robot's name here.
        name: String,
    },
    /// Makes a robot's eyes blink for a moment, so that people see which one it is.
    Blink {
        /// Its name.
        name: String,
    },
    /// Ends a robot's own life: it stands up, and programs have it.
    Take {
        /// Its name.
        name: String,
    },
    /// Stops what runs and gives a robot back to its own life.
    GiveBack {
        /// Its name.
        name: String,
    },
    /// Stops what runs and lets a robot sit down, its motors off.
    Rest {
        /// Its name.
        name: String,
    },
    /// Wakes a robot up: its motors go on.
    WakeUp {
        /// Its name.
        name: String,
    },
    /// Lets a robot stand up.
    Stand {
        /// Its name.
        name: String,
    },
    /// Lets a robot sit down, its motors on.
    Sit {
        /// Its name.
        name: String,
    },
    /// Has a robot forget all faces that it remembers, for good.
    ForgetFaces {
        /// Its name.
        name: String,
    },
    /// Shows the names under which a robot remembers faces.
    Faces {
        /// Its name.
        name: String,
    },
    /// Has a robot forget the face that it remembers under one name, for good.
    ForgetFace {
        /// The robot's name.
        name: String,
        /// The name under which it remembers the face.
        face: String,
    },
    /// Removes a robot on which nothing runs.
    Remove {
        /// Its name.
        name: String,
    },
}

impl RobotCommand {
    /// The same as a line of the console.
    fn line(&self) -> String {
        let at = |address: &str, user: &Option<String>| {
            let user = user.as_ref().map(|user| format!(" as {user}"));
            format!("{address}{}", user.unwrap_or_default())
        };
        match self {
            Self::List => "show robots".to_owned(),
            Self::Find => "find robots".to_owned(),
            Self::Check { address, user } => format!("check robot {}", at(address, user)),
            Self::Add { name, address: None, .. } => format!("add robot \"{name}\""),
            Self::Add { name, address: Some(address), user } => {
                format!("add robot \"{name}\" at {}", at(address, user))
            }
            Self::Rename { name, new } => format!("rename robot \"{name}\" to \"{new}\""),
            Self::Reach { name, address, user } => format!("reach robot \"{name}\" at {}", at(address, user)),
            Self::Accept { name } => format!("accept robot \"{name}\""),
            Self::Blink { name } => format!("blink robot \"{name}\""),
            Self::Take { name } => format!("take control \"{name}\""),
            Self::GiveBack { name } => format!("give back \"{name}\""),
            Self::Rest { name } => format!("rest \"{name}\""),
            Self::WakeUp { name } => format!("wake up \"{name}\""),
            Self::Stand { name } => format!("let stand \"{name}\""),
            Self::Sit { name } => format!("let sit \"{name}\""),
            Self::ForgetFaces { name } => format!("forget faces \"{name}\""),
            Self::Faces { name } => format!("show faces \"{name}\""),
            Self::ForgetFace { name, face } => format!("forget face \"{face}\" of \"{name}\""),
            Self::Remove { name } => format!("remove robot \"{name}\""),
        }
    }
}

/// Does it, and answers with the exit code.
fn robot(args: &RobotArgs) -> ExitCode {
    let Ok(runtime) = tokio::runtime::Builder::new_current_thread().enable_all().build() else {
        return ExitCode::FAILURE;
    };
    let done = runtime.block_on(async {
        let mut console = Console::new(Box::new(std::io::stdout()));
        console.obey(&format!("connect {}", args.server)).await && console.obey(&args.what.line()).await
    });
    runtime.shutdown_background();
    if done { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

#[cfg(test)]
mod tests {
    use super::RobotCommand;

    #[test]
    fn a_real_robot_has_an_address() {
        let add = |address: Option<&str>, user: Option<&str>| RobotCommand::Add {
            name: "NAO blue".into(),
            address: address.map(str::to_owned),
            user: user.map(str::to_owned),
        };
        let forget = RobotCommand::ForgetFaces { name: "NAO blue".into() };
        assert_eq!(forget.line(), "forget faces \"NAO blue\"");
        assert_eq!(RobotCommand::Faces { name: "NAO blue".into() }.line(), "show faces \"NAO blue\"");
        let forget = RobotCommand::ForgetFace { name: "NAO blue".into(), face: "face 1".into() };
        assert_eq!(forget.line(), "forget face \"face 1\" of \"NAO blue\"");
        assert_eq!(add(None, None).line(), "add robot \"NAO blue\"");
        assert_eq!(add(Some("nao.local"), Some("nao")).line(), "add robot \"NAO blue\" at nao.local as nao");
        let reach = RobotCommand::Reach { name: "NAO blue".into(), address: "10.0.0.9".into(), user: None };
        assert_eq!(reach.line(), "reach robot \"NAO blue\" at 10.0.0.9");
        assert_eq!(RobotCommand::Accept { name: "NAO blue".into() }.line(), "accept robot \"NAO blue\"");
        assert_eq!(RobotCommand::Blink { name: "NAO blue".into() }.line(), "blink robot \"NAO blue\"");
    }
}
