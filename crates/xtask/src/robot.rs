//! A robot to try things with by hand: the stand-in of the tests, on the real libqi.

use std::process::Command;

use crate::qi_python;
use crate::tools::{self, ToolResult, Workspace};

/// The port on which NAOqi listens.
const PORT: u16 = 9559;

/// `words` are `[PORT]`; runs until Ctrl-C.
pub(crate) fn run(workspace: &Workspace, words: &[&str]) -> ToolResult<()> {
    let port = match words {
        [] => PORT,
        [port] => port.parse().map_err(|_| format!("`{port}` is no port; give one from 1 to 65535."))?,
        _ => return Err("Give a port, or nothing for 9559.".to_owned()),
    };
    let python = qi_python::ensure(workspace)?;
    println!(
        "A NAO that is not one, at tcp://127.0.0.1:{port}. With a server that runs (`cargo xtask serve`):\n\n  \
           in the page       the robot's name opens the list of robots; add one at the address 127.0.0.1:{port}\n  \
           in a terminal     rrp robot add Trial --address 127.0.0.1:{port}\n\n\
         Take control of it, let a program see the red ball and speak, and press Start. Each call that the server makes is\n\
         printed here. Ctrl-C ends it."
    );
    let mut robot = Command::new(python);
    robot.arg(workspace.root.join("tests/standin/nao.py")).args(["--stay", "--port", &port.to_string()]);
    tools::run(&mut robot, "The robot")
}
