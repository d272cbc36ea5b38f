//! The console: what is connected, loaded and looked at, and where answers go.

use crate::refusal::NotDone;
use crate::{Client, Mirror};
use behaviour::{Graph, Id};
use protocol::{ListQuery, Request, RobotState, RunPhase, RunState, Summary, answer, request};
use std::io::Write;
use std::time::Instant;

/// Programs that completion knows: those that were changed last.
const KNOWN_MAX: usize = 200;
/// Programs that are named when none was meant.
pub(crate) const CHOICES_MAX: usize = 50;

/// A console that obeys one line after another.
pub struct Console {
    /// The server.
    pub(crate) client: Option<Client>,
    /// The loaded stream.
    pub(crate) stream: Option<Id>,
    /// The robot in use, if one was chosen.
    pub(crate) robot: Option<Id>,
    /// True if starts are recorded.
    pub(crate) records: bool,
    /// True once exit was typed.
    pub(crate) done: bool,
    /// The time at which the line was entered that is obeyed.
    pub(crate) entered: Instant,
    out: Box<dyn Write + Send>,
}

impl Console {
    /// A console that answers to `out`, not connected yet.
    #[must_use]
    pub fn new(out: Box<dyn Write + Send>) -> Self {
        Self { client: None, stream: None, robot: None, records: false, done: false, entered: Instant::now(), out }
    }

    /// True once exit was typed.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.done
    }

    /// Prints lines at once. Nobody may be reading any more; that is no error.
    pub(crate) fn say(&mut self, text: &str) {
        if !text.is_empty() {
            let _ = writeln!(self.out, "{text}").and_then(|()| self.out.flush());
        }
    }

    /// The server, if there is a connection.
    pub(crate) fn client(&mut self) -> Result<&mut Client, NotDone> {
        self.client.as_mut().ok_or(NotDone::NotConnected)
    }

    /// Asks the server.
    pub(crate) async fn ask<R: Request>(&mut self, request: R) -> Result<R::Answer, NotDone> {
        Ok(self.client()?.ask(request).await?)
    }

    /// At most so many programs that these words find, newest change first.
    pub(crate) async fn programs(&mut self, words: &str, most: usize) -> Result<Vec<Summary>, NotDone> {
        let query = ListQuery { words: words.to_owned(), ..ListQuery::default() };
        Ok(self.client()?.programs(query, most).await?)
    }

    /// The robots, oldest first.
    pub(crate) async fn robots(&mut self) -> Result<Vec<RobotState>, NotDone> {
        Ok(self.client()?.robots().await?)
    }

    /// The robot of that name.
    pub(crate) async fn robot_meant(&mut self, wanted: &str) -> Result<(String, Id), NotDone> {
        let robots = self.robots().await?;
        let all: Vec<_> = robots.into_iter().map(|robot| (robot.name, robot.robot)).collect();
        Ok(crate::find::find("robot", wanted, &all)?)
    }

    /// Returns the runs on the robot in use, or on all robots, each from the top of its order.
    pub(crate) async fn running(&mut self) -> Result<Vec<RunState>, NotDone> {
        let mut running = self.all_running().await?;
        running.retain(|run| self.robot.as_ref().is_none_or(|robot| run.robot == *robot));
        Ok(running)
    }

    /// Returns the runs on all robots, each from the top of its order.
    pub(crate) async fn all_running(&mut self) -> Result<Vec<RunState>, NotDone> {
        let robots = self.robots().await?;
        let answer::Runs { mut runs, .. } = self.ask(request::Runs {}).await?;
        runs.retain(|run| run.phase == RunPhase::Running);
        let at = |run: &RunState| robots.iter().position(|robot| robot.robot == run.robot);
        runs.sort_by_key(|run| (at(run), run.place));
        Ok(runs)
    }

    /// The loaded program as it is now.
    pub(crate) fn program(&mut self) -> Result<Mirror, NotDone> {
        self.client()?.open().ok_or(NotDone::NoProgram)
    }

    /// The program of that name, or the loaded one if none is named.
    pub(crate) async fn meant(&mut self, wanted: &str) -> Result<(String, Id), NotDone> {
        if wanted.is_empty() {
            let loaded = self.program()?;
            return Ok((loaded.records.name().to_owned(), loaded.behaviour));
        }
        let mut programs = self.programs(crate::find::unquoted(wanted), usize::MAX).await?;
        if programs.is_empty() {
            programs = self.programs("", CHOICES_MAX).await?;
        }
        let all: Vec<_> = programs.into_iter().map(|program| (program.name, program.id)).collect();
        let (name, id) = crate::find::find("program", wanted, &all)?;
        Ok((name, Id::new(&id).map_err(|reason| NotDone::Id(reason.to_string()))?))
    }

    /// The stream of that name in the loaded program, or the loaded one if none is named.
    pub(crate) fn stream_meant(&mut self, wanted: &str) -> Result<(Mirror, Id), NotDone> {
        if wanted.is_empty() {
            return self.looked_at();
        }
        let program = self.program()?;
        let streams = program.records.streams_in_order().into_iter();
        let all: Vec<_> = streams.map(|(id, stream)| (stream.name.clone(), id.clone())).collect();
        let (_, id) = crate::find::find("stream", wanted, &all)?;
        Ok((program, id))
    }

    /// The loaded stream in the program as it is now.
    pub(crate) fn looked_at(&mut self) -> Result<(Mirror, Id), NotDone> {
        let program = self.program()?;
        let loaded = self.stream.clone().filter(|stream| program.records.stream(stream).is_some());
        let stream = loaded.ok_or(NotDone::NoStream)?;
        Ok((program, stream))
    }

    /// Returns the names that can be typed now, for completion.
    pub(crate) async fn names(&mut self) -> Vec<String> {
        let programs = if self.client.is_some() { self.programs("", KNOWN_MAX).await } else { Ok(Vec::new()) };
        let programs = programs.unwrap_or_default();
        let mut names: Vec<_> = programs.into_iter().map(|program| program.name).collect();
        if let Ok(program) = self.program() {
            names.extend(program.records.streams_in_order().into_iter().map(|(_, stream)| stream.name.clone()));
        }
        names
    }
}

/// Streams with their kind, a line each.
pub(crate) fn stream_lines<'a>(program: &Mirror, streams: impl IntoIterator<Item = &'a Id>) -> String {
    let lines = streams.into_iter().filter_map(|id| program.records.stream(id)).map(|stream| {
        let kind = match stream.kind {
            behaviour::StreamKind::Sensor => "sensor",
            behaviour::StreamKind::Ordinary => "ordinary",
            behaviour::StreamKind::Actuator => "actuator",
        };
        let device = stream.device.as_ref().map_or_else(String::new, |device| format!(" {device}"));
        format!("{} ({kind}{device})", stream.name)
    });
    or_nothing(lines.collect(), "No streams.")
}

/// The connectors into or out of a stream, a line each: `map (distance): Red ball -> Far`.
pub(crate) fn connector_lines(program: &Mirror, stream: &Id, outgoing: bool) -> String {
    let graph = Graph::of(&program.records);
    let connectors = if outgoing { graph.out_of_stream(stream) } else { graph.into_stream(stream) };
    let name = |id: &Id| program.records.stream(id).map_or("?", |stream| stream.name.as_str());
    let lines = connectors.iter().map(|(_, connector)| {
        let inputs: Vec<_> = connector.inputs.iter().map(name).collect();
        format!("{}: {} -> {}", label(connector), inputs.join(", "), name(&connector.output))
    });
    or_nothing(lines.collect(), "No connectors.")
}

fn label(connector: &behaviour::Connector) -> String {
    let (word, chosen) = (connector.operation.word(), connector.operation.chosen());
    if chosen.is_empty() { word.to_owned() } else { format!("{word} ({})", chosen.join(", ").replace('\n', " ")) }
}

/// The lines, or a sentence if there are none.
pub(crate) fn or_nothing(lines: Vec<String>, nothing: &str) -> String {
    if lines.is_empty() { nothing.to_owned() } else { lines.join("\n") }
}

#[cfg(test)]
mod tests {
    use super::label;
    use behaviour::{Connector, Id, Operation, Parameters, Procedure, Value, connectors};

    fn shown(operation: Operation) -> String {
        let id = |text| Id::new(text).unwrap();
        label(&Connector { operation, inputs: vec![id("a")], output: id("b"), order: 0 })
    }

    #[test]
    fn connectors_are_shown_with_what_was_chosen_for_them() {
        let counts = Parameters { start: Some(Value::Int(0)), ..Procedure::body("soFar\n+ 1").into() };
        assert_eq!(shown(connectors::scan::SPEC.with(counts)), "scan (0, soFar + 1)");
        assert_eq!(shown(connectors::distinct::SPEC.with(())), "distinct");
        assert_eq!(shown(connectors::distinct::SPEC.with(Procedure::body("face.id"))), "distinct (face.id)");
        assert_eq!(shown(connectors::debounce::SPEC.with(Parameters::period(5_000))), "debounce (5 seconds)");
        assert_eq!(shown(connectors::delay::SPEC.with(Parameters::period(1))), "delay (1 ms)");
        assert_eq!(shown(connectors::with_latest::SPEC.with(Procedure::Helper("far".into()))), "withLatest (far)");
    }
}
