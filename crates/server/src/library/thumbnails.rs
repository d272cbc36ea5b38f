//! Small pictures of graphs for lists, made from what is saved and kept for a while.

use crate::support::identity::Sender;
use crate::support::lock;
use crate::support::store_call::bounded;
use crate::support::workers::Workers;
use behaviour::{Behaviour, Graph, Id};
use futures_util::StreamExt;
use protocol::{GraphOutline, PICTURES_MAX, PictureOf, PictureStream, Refused, answer};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex};
use store::{Loaded, Store};

/// Pictures that are kept.
const KEPT_MAX: usize = 1_000;
/// Behaviours that are read at once for one answer.
const AT_ONCE: usize = 8;
/// Between streams that nobody placed, in canvas units.
const STEP: [f64; 2] = [180.0, 130.0];

/// The pictures made lately.
#[derive(Debug, Default)]
pub(crate) struct Thumbnails(Mutex<KeptThumbnail>);

#[derive(Debug, Default)]
struct KeptThumbnail {
    made: HashMap<Id, (u64, Arc<GraphOutline>)>,
    order: VecDeque<Id>,
}

impl Thumbnails {
    fn get(&self, of: &PictureOf) -> Option<Arc<GraphOutline>> {
        let kept = lock(&self.0);
        let (_, picture) = kept.made.get(&of.behaviour).filter(|(revision, _)| *revision >= of.revision)?;
        Some(Arc::clone(picture))
    }

    fn keep(&self, behaviour: Id, revision: u64, picture: &Arc<GraphOutline>) {
        let mut kept = lock(&self.0);
        if kept.made.insert(behaviour.clone(), (revision, Arc::clone(picture))).is_none() {
            kept.order.push_back(behaviour);
        }
        if kept.order.len() > KEPT_MAX
            && let Some(oldest) = kept.order.pop_front()
        {
            kept.made.remove(&oldest);
        }
    }
}

/// What drawing for somebody takes.
pub(crate) struct DrawingShare<'a> {
    /// Where behaviours are kept.
    pub(crate) store: &'a dyn Store,
    /// The pictures made lately.
    pub(crate) made: &'a Thumbnails,
    /// The threads that draw.
    pub(crate) workers: &'a Workers,
    /// For whom.
    pub(crate) sender: Sender,
}

/// The pictures of these behaviours, as far as they are there: some are read at once, and drawn one after the other.
pub(crate) async fn pictures(drawing: DrawingShare<'_>, of: Vec<PictureOf>) -> Result<answer::Pictures, Refused> {
    let wanted = of.into_iter().take(PICTURES_MAX).map(|of| find(&drawing, of));
    let mut found = std::pin::pin!(futures_util::stream::iter(wanted).buffered(AT_ONCE));
    let mut pictures = Vec::new();
    while let Some(one) = found.next().await {
        let Some((id, found)) = one else { continue };
        let picture = match found {
            FoundThumbnail::Made(picture) => picture,
            FoundThumbnail::Read(loaded) => draw(&drawing, &id, *loaded).await?,
        };
        pictures.push((id, (*picture).clone()));
    }
    Ok(answer::Pictures { pictures })
}

/// What there is of a behaviour to show.
enum FoundThumbnail {
    /// A picture that was made lately.
    Made(Arc<GraphOutline>),
    /// The behaviour, to be drawn.
    Read(Box<Loaded>),
}

async fn find(drawing: &DrawingShare<'_>, of: PictureOf) -> Option<(Id, FoundThumbnail)> {
    if let Some(picture) = drawing.made.get(&of) {
        return Some((of.behaviour, FoundThumbnail::Made(picture)));
    }
    let loaded = bounded(drawing.store.load(&of.behaviour)).await.ok()??;
    Some((of.behaviour, FoundThumbnail::Read(Box::new(loaded))))
}

async fn draw(drawing: &DrawingShare<'_>, id: &Id, loaded: Loaded) -> Result<Arc<GraphOutline>, Refused> {
    let Loaded { revision, behaviour, .. } = loaded;
    let picture = drawing.workers.run(drawing.sender.clone(), move |_| Arc::new(picture_of(&behaviour))).await?;
    drawing.made.keep(id.clone(), revision, &picture);
    Ok(picture)
}

/// What a graph looks like: streams where people placed them, the others in rows by their way from the senses.
pub(crate) fn picture_of(behaviour: &Behaviour) -> GraphOutline {
    let graph = Graph::of(behaviour);
    let rows = rows(behaviour, &graph);
    let streams: Vec<_> = behaviour.streams_in_order().into_iter().take(GraphOutline::STREAMS_MAX).collect();
    let numbers: HashMap<&Id, u16> = streams.iter().map(|(id, _)| *id).zip(0..).collect();
    let ends = behaviour.connectors_in_order().into_iter();
    let ends = ends.flat_map(|(_, connector)| connector.inputs.iter().map(move |from| (from, &connector.output)));
    let lines = ends.filter_map(|(from, to)| Some([*numbers.get(from)?, *numbers.get(to)?])).collect();
    let streams = streams.into_iter().map(|(id, stream)| {
        let place = behaviour.place(id).map(|place| [place.x, place.y]);
        let [x, y] = place.or_else(|| rows.get(id).copied()).unwrap_or_default();
        PictureStream { x: x as f32, y: y as f32, kind: stream.kind }
    });
    GraphOutline { streams: streams.collect(), lines }
}

/// A place for every stream that has none: a row for each rank, each row in the middle.
fn rows<'a>(behaviour: &'a Behaviour, graph: &Graph<'a>) -> HashMap<&'a Id, [f64; 2]> {
    let ranks: HashMap<&Id, usize> = graph.ranks(behaviour).into_iter().collect();
    let mut rows: HashMap<usize, Vec<&Id>> = HashMap::new();
    for (id, _) in behaviour.streams_in_order() {
        if behaviour.place(id).is_none() {
            rows.entry(ranks.get(id).copied().unwrap_or_default()).or_default().push(id);
        }
    }
    let place =
        |row: usize, at: usize, of: usize| [(at as f64 - (of - 1) as f64 / 2.0) * STEP[0], row as f64 * STEP[1]];
    let placed = rows
        .iter()
        .flat_map(|(row, ids)| ids.iter().enumerate().map(move |(at, id)| (*id, place(*row, at, ids.len()))));
    placed.collect()
}

#[cfg(test)]
mod tests {
    use super::{KEPT_MAX, Thumbnails, picture_of};
    use crate::library::templates::templates;
    use behaviour::{Id, Kind};
    use protocol::{GraphOutline, PictureOf};
    use std::sync::Arc;

    #[test]
    fn streams_that_nobody_placed_stand_in_rows() {
        let mut behaviour = templates()[4].file().records(|_| None).unwrap();
        behaviour.records.retain(|id, _| id.kind != Kind::Place);
        let picture = picture_of(&behaviour);
        assert_eq!(picture.streams.len(), behaviour.streams().count());
        for [from, to] in &picture.lines {
            assert!(picture.streams[usize::from(*from)].y < picture.streams[usize::from(*to)].y);
        }
        let mut places: Vec<_> = picture.streams.iter().map(|stream| (stream.x as i64, stream.y as i64)).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), picture.streams.len(), "no two at one place");
    }

    #[test]
    fn pictures_are_kept_by_revision_and_not_for_ever() {
        let (pictures, picture) = (Thumbnails::default(), Arc::new(GraphOutline::default()));
        let id = |number: usize| Id::new(&format!("b{number}")).unwrap();
        pictures.keep(id(0), 3, &picture);
        let at = |number, revision| pictures.get(&PictureOf { behaviour: id(number), revision }).is_some();
        assert!(at(0, 3) && at(0, 2) && !at(0, 4));
        for number in 1..=KEPT_MAX {
            pictures.keep(id(number), 1, &picture);
        }
        assert!(!at(0, 3) && at(1, 1) && at(KEPT_MAX, 1));
    }
}
