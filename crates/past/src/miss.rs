//! The nearest misses of a time: of all values that a test kept back, the one that was nearest to passing.

use crate::cut::cut;
use crate::past::Past;
use behaviour::{BehaviourFile, Id};
use causes::KeptValue;
use protocol::{Because, BlockedConnector, WhyNot};
use sentences::TestMeasure;
use std::collections::BTreeMap;

/// Gathers the nearest misses of one program since a moment.
pub(crate) struct NearestMisses {
    /// The place of the program.
    program: usize,
    from_ms: u64,
    /// True while that program runs.
    is_on: bool,
    /// By the place of a connector how its misses are measured.
    measures: Vec<Option<TestMeasure>>,
    /// By the place of a connector.
    nearest: BTreeMap<usize, Miss>,
}

/// A value that was kept back, and how far it was from passing.
struct Miss {
    distance: f64,
    kept: KeptValue,
}

/// A way on which a value would have come: what kept it back, told by one value or by another one. The first is the nearest miss.
pub(crate) struct BlockedWay {
    pub(crate) told_by: Vec<BlockedConnector>,
    /// The distance of the nearest miss from passing; none where nothing can be measured.
    distance: Option<f64>,
}

impl BlockedWay {
    /// The part that is told of it, short enough to be sent.
    pub(crate) fn told(&self) -> Option<BlockedConnector> {
        let told = self.told_by.first()?;
        Some(BlockedConnector { value: cut(&told.value), ..told.clone() })
    }
}

impl NearestMisses {
    pub(crate) fn of(past: &Past, program: usize, from_ms: u64) -> Self {
        let measures = measures(&past.programs[program].file);
        Self { program, from_ms, is_on: false, measures, nearest: BTreeMap::new() }
    }

    /// A program begins, or goes on.
    pub(crate) fn enter(&mut self, program: usize) {
        self.is_on = program == self.program;
        self.nearest.clear();
    }

    /// A test of the program that runs kept a value back. Of several that are equally near the newest counts.
    pub(crate) fn hear(&mut self, kept: KeptValue) {
        if !self.is_on || kept.at().0 < self.from_ms {
            return;
        }
        let at = kept.connector().index();
        let Some(distance) = self.measures.get(at).and_then(Option::as_ref).and_then(|it| it.distance(kept.value()))
        else {
            return;
        };
        if self.nearest.get(&at).is_none_or(|nearest| distance <= nearest.distance) {
            self.nearest.insert(at, Miss { distance, kept });
        }
    }

    /// The ways of an answer, the nearest miss first; those that cannot be measured follow as they stood.
    pub(crate) fn ways(&self, file: &BehaviourFile, why: &WhyNot) -> Vec<BlockedWay> {
        let mut ways: Vec<BlockedWay> = why.blocked.iter().map(|blocked| self.way(file, blocked)).collect();
        let far = |way: &BlockedWay| way.distance.unwrap_or(f64::INFINITY);
        ways.sort_by(|one, other| far(one).total_cmp(&far(other)));
        ways
    }

    fn way(&self, file: &BehaviourFile, blocked: &BlockedConnector) -> BlockedWay {
        let at = file.connectors.iter().position(|known| known.id == blocked.connector);
        let miss = at.and_then(|at| self.nearest.get(&at)).filter(|_| blocked.because == Because::Kept);
        let Some(Miss { distance, kept }) = miss else {
            return BlockedWay { told_by: vec![blocked.clone()], distance: None };
        };
        let stream = file.streams.get(kept.stream().index()).map_or_else(String::new, |stream| stream.id.clone());
        let (t, value) = (Some(kept.at().0), kept.value().clone());
        let nearest = BlockedConnector { stream, t, value, ..blocked.clone() };
        let last = Some(blocked.clone()).filter(|last| *last != nearest);
        BlockedWay { told_by: std::iter::once(nearest).chain(last).collect(), distance: Some(*distance) }
    }
}

fn measures(file: &BehaviourFile) -> Vec<Option<TestMeasure>> {
    let Ok(behaviour) = file.records(|_| None) else { return Vec::new() };
    let measure = |id: &String| TestMeasure::of(&behaviour, behaviour.connector(&Id::new(id).ok()?)?);
    file.connectors.iter().map(|connector| measure(&connector.id)).collect()
}
