//! The operator's console against a server: the words people read.

use crate::house::{House, make};
use shell::Console;
use std::io::Write;
use std::sync::{Arc, Mutex};

/// What the console said.
#[derive(Clone, Default)]
pub(crate) struct Said(Arc<Mutex<Vec<u8>>>);

impl Said {
    pub(crate) fn text(&self) -> String {
        String::from_utf8(self.0.lock().unwrap().clone()).unwrap()
    }
}

impl Write for Said {
    fn write(&mut self, text: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend(text);
        Ok(text.len())
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

const TALK: &str = "\
> show programs
Not connected. Type “connect” first.
> CONNECT URL
Connected to URL
> Show Programs
Far away
Far
> load program f
“f” could be one of these: Far away, Far. Type more of the name.
> show streams
No program is loaded. Type “load program NAME” first.
> load program far
Loaded Far: 6 streams, 5 connectors, revision 1
> show streams
Ball (sensor RedBall)
Distance (ordinary)
Far ball (ordinary)
Close ball (ordinary)
Head tracker (actuator Tracker)
Head and body tracker (actuator Tracker)
> show out ops
No stream is loaded. Type “load stream NAME” first.
> load stream dist
Loaded stream Distance
> show in streams
Ball (sensor RedBall)
> show start streams
Ball (sensor RedBall)
> stimulate ball
This program does not run. Press Start first.
> start
Far runs
> record
Type “record on”, “record now” or “record off”.
> record on
What you start from now on is recorded
> start
It cannot start: this server has no data folder; start it with --data DIR.
> mark she smiles
Marked for those who watch; nothing is recorded, so nothing keeps it
> record off
Nothing is recorded
> recordings
No recordings. Type “record on” before “start”.
> order
Far
> order far up
Far is there already.
> apply
Far goes on as it is saved now
> stimulate ba {\"x\": 0.5}
Ball got #{x: 0.5}
> hand say
“say” could be one of these: SayInput, SayParameter. Type more of the name.
> hand SayInput Hello
Type the value and the settings as JSON, such as \"Hello\" with {\"speed\": 0.5} (expected value at line 1 column 1).
> hand sayinput \"Hello\" with {}
SayInput got \"Hello\" by hand
> stop far
Far is stopped
> apply far
This program does not run. Press Start first.
> below
Far ball (ordinary)
Close ball (ordinary)
Head tracker (actuator Tracker)
Head and body tracker (actuator Tracker)
> below close
Head and body tracker (actuator Tracker)
> dead streams
Every stream leads to an action.
> can run
Far can run on Simulated NAO.
> similar
Far away: 2 senses and actions in common
> where used ball_to
Far
Far away
> drivers of track
Far: from Ball
Far away: from Ball
> drivers of say
“say” could be one of these: SayInput, SayParameter. Type more of the name.
> contested
Tracker: Far, Far away
> show robots
Simulated NAO (ready, battery 100 %, awake, motors on, own life off, nothing runs)
> add robot Momo
Momo is there
> use robot mo
Momo is chosen
> start far away
Far away runs
> order
Far away on Momo
> use robot
No robot is chosen
> start far
Far runs
> order
Far on Simulated NAO
Far away on Momo
> remove robot momo
The robot stays: something runs on it; press Stop first.
> use robot momo
Momo is chosen
> stop
Everything on Momo is stopped
> remove robot momo
Momo is removed
> use robot momo
There is no robot “momo”. There are: Simulated NAO.
> show robots
Simulated NAO (ready, battery 100 %, awake, motors on, own life off, runs Far)
> disconnect
Disconnected.
";

#[tokio::test]
async fn the_console_says_what_the_thesis_promises() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    for name in ["Far", "Far away"] {
        make(&aiko, name, Some("Track far and close balls")).await;
        tokio::time::sleep(std::time::Duration::from_millis(5)).await;
    }
    let said = Said::default();
    let mut console = Console::new(Box::new(said.clone()));
    let url = house.url();
    let mut talk = String::new();
    for line in TALK.lines().filter_map(|line| line.strip_prefix("> ")) {
        console.obey(&line.replace("URL", &url)).await;
        let answer = String::from_utf8(std::mem::take(&mut *said.0.lock().unwrap())).unwrap();
        talk += &format!("> {line}\n{}", answer.replace(&url, "URL"));
    }
    assert_eq!(talk, TALK, "{talk}");
    house.close().await;
}
