//! Real robots by the console: reached at another address, accepted as another body, known by their lights, and what they
//! remember of faces.

use house::{Outcome, Server, StandIn};
use shell::Console;
use std::io::Write;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The longest time for an answer that has to come.
const PATIENCE: Duration = Duration::from_secs(60);

/// The text that the console said.
#[derive(Clone, Default)]
struct Said(Arc<Mutex<Vec<u8>>>);

impl Write for Said {
    fn write(&mut self, text: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend(text);
        Ok(text.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// The console of the host, and what it says.
struct Talk {
    console: Console,
    said: Said,
}

impl Talk {
    async fn with(server: &Server) -> Self {
        let said = Said::default();
        let mut talk = Self { console: Console::new(Box::new(said.clone())), said };
        talk.line(&format!("connect {}", server.url())).await;
        talk
    }

    async fn line(&mut self, line: &str) -> String {
        self.console.obey(line).await;
        let said = std::mem::take(&mut *self.said.0.lock().unwrap_or_else(PoisonError::into_inner));
        String::from_utf8_lossy(&said).trim_end().to_owned()
    }

    /// Says it until this is the answer.
    async fn until(&mut self, line: &str, answer: impl Fn(&str) -> bool) -> String {
        let end = Instant::now() + PATIENCE;
        loop {
            let said = self.line(line).await;
            if answer(&said) {
                return said;
            }
            assert!(Instant::now() < end, "{line}: {said}");
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    }
}

#[tokio::test]
async fn a_robot_is_reached_accepted_and_blinks_by_the_console() -> Outcome<()> {
    let part = "journey: robots by the console";
    let me = ["--name", "Momo", "--serial", "ALDR1312N090344"];
    let Some(momo) = StandIn::start(part, &me)? else { return Ok(()) };
    momo.world(r#"{"learned": {"1": "Hana", "2": "Ken"}}"#).await?;
    let folder = house::folder()?;
    let server = Server::start_with(folder.path(), &[]).await?;
    let mut talk = Talk::with(&server).await;
    let added = talk.line(&format!("add robot Blue at {}", momo.address())).await;
    assert!(added.starts_with("Blue is added: NAO, NAOqi "), "{added}");
    let listed = talk.until("show robots", |said| said.contains("Blue (ready")).await;
    assert!(listed.contains("itself “Momo”, NAO #0344"), "{listed}");

    assert_eq!(talk.line("blink robot Blue").await, "Blue makes its eyes blink");
    momo.until_called("ALLeds", "fadeRGB").await?;
    assert_eq!(talk.until("show faces blue", |said| said.contains("Ken")).await, "Hana\nKen");
    assert_eq!(
        talk.line("forget face Ke of Blue").await,
        "There is no face “Ke”. There are: Hana, Ken.",
        "the whole name has to be said"
    );
    assert_eq!(talk.line("forget face \"Ken\" of Blue").await, "Blue forgets Ken");
    talk.until("show faces Blue", |said| said == "Hana").await;
    // The number of faces that it knew is told a moment later than that one is gone.
    assert!(talk.line("forget faces Blue").await.starts_with("Blue forgets the "));
    talk.until("show faces Blue", |said| said == "Blue remembers no face").await;

    // The robot is not reached where nobody answers, and stays where it is.
    assert_eq!(talk.line("reach robot Blue").await, "Type “reach robot NAME at ADDRESS”.");
    let nowhere = talk.line("reach robot Blue at 127.0.0.1:9").await;
    assert!(nowhere.starts_with("The robot keeps its address. "), "{nowhere}");
    assert!(talk.line("show robots").await.contains(&format!("at {}", momo.address())));
    let Some(moved) = StandIn::start(part, &me)? else { return Ok(()) };
    drop(momo);
    let reached = talk.line(&format!("reach robot Blue at {}", moved.address())).await;
    assert!(reached.starts_with(&format!("Blue is reached at {}: NAO, NAOqi ", moved.address())), "{reached}");
    talk.until("show robots", |said| said.contains("Blue (ready")).await;

    // Another body at its address is accepted, and not before there is one.
    assert_eq!(talk.line("accept robot Blue").await, "No other robot answers in the place of Blue.");
    let port = moved.address().rsplit(':').next().unwrap_or_default().to_owned();
    drop(moved);
    let words = ["--port", &port, "--body", "pepper", "--name", "Pico", "--serial", "AP990438A02Y51000072"];
    let _pico = StandIn::start(part, &words)?;
    let accepted = talk.until("accept robot Blue", |said| !said.starts_with("No other robot answers")).await;
    assert_eq!(accepted, "Blue is “Pico”, Pepper #0072 from now on");
    let listed = talk.until("show robots", |said| said.contains("Blue (ready")).await;
    assert!(listed.contains("itself “Pico”, Pepper #0072"), "{listed}");
    Ok(())
}
