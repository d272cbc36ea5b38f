//! A server ends in order, whatever asks it to: the robots stop, people are told, and what is written is finished.

use house::{InTerminal, Outcome, Server, Terminal, Trouble, skip};
use protocol::{Event, RunPhase, request};
use shell::{Client, NoLink};
use std::path::Path;

#[tokio::test]
async fn a_closed_terminal_ends_the_server_in_order() -> Outcome<()> {
    skip::unless!(built("journey: a closed terminal"));
    skip::unless!(linux("journey: a closed terminal"));
    for terminal in [Terminal::Own, Terminal::Lent] {
        let folder = house::folder()?;
        let server = InTerminal::start(folder.path(), terminal).await?;
        let aiko = recorded_run(server.url()).await?;
        let status = server.close().ended().await?;
        assert!(status.success(), "{terminal:?}: {status}");
        ended_in_order(folder.path(), aiko).await?;
    }
    Ok(())
}

#[tokio::test]
async fn a_server_that_is_to_outlive_its_terminal_does() -> Outcome<()> {
    skip::unless!(built("journey: nohup"));
    skip::unless!(linux("journey: nohup"));
    let folder = house::folder()?;
    let server = InTerminal::start(folder.path(), Terminal::Outlived).await?;
    let url = server.url().to_owned();
    let aiko = recorded_run(&url).await?;
    let server = server.close();
    let ben = Client::connect(&url, "Ben").await?;
    drop(ben.ask(request::Runs {}).await?);
    house::signal(server.id(), "TERM").await?;
    let status = server.ended().await?;
    assert!(status.success(), "without a screen: {status}");
    ended_in_order(folder.path(), aiko).await
}

#[tokio::test]
async fn every_signal_that_ends_it_lets_the_robots_stop_first() -> Outcome<()> {
    skip::unless!(built("journey: signals"));
    for signal in ["HUP", "INT", "QUIT", "TERM"] {
        let folder = house::folder()?;
        let mut server = Server::start(folder.path()).await?;
        let aiko = recorded_run(&server.url()).await?;
        server.end_by(signal).await?;
        assert!(server.log().contains("the robots stop first"), "{signal}");
        ended_in_order(folder.path(), aiko).await?;
    }
    Ok(())
}

/// Somebody, and a program of theirs that runs and is recorded.
async fn recorded_run(url: &str) -> Outcome<Client> {
    let mut aiko = Client::connect(url, "Aiko").await?;
    let behaviour = behaviour::Id::new("recorded")?;
    let create = request::Create {
        behaviour: behaviour.clone(),
        name: "Recorded".into(),
        template: Some("Reflect ball color".into()),
    };
    drop(aiko.ask(create).await?);
    let session = protocol::RecordedSession::default();
    aiko.ask(request::Start { behaviour, robot: None, record: true, session }).await?;
    let runs = |event: &Event| match event {
        Event::Runs { runs, .. } => runs.iter().any(|run| run.phase == RunPhase::Running),
        _ => false,
    };
    drop(aiko.until(runs).await?);
    Ok(aiko)
}

/// The person was told goodbye, and the recording is whole.
async fn ended_in_order(folder: &Path, mut aiko: Client) -> Outcome<()> {
    while aiko.next().await.is_some() {}
    assert_eq!(aiko.why_ended(), Some(NoLink::Restart));
    let recording = std::fs::read_dir(folder.join("recordings"))?.next().ok_or("Nothing was recorded.")??;
    let lines = std::fs::read_to_string(recording.path())?;
    let last: serde_json::Value = serde_json::from_str(lines.lines().last().unwrap_or_default())?;
    if last["mark"] == "end" && last["why"] == "it was stopped" {
        return Ok(());
    }
    Err(Trouble(format!("The recording ends with {last}.")))
}
