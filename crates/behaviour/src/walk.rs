//! The walk along the values: connectors in an order in which each comes after those that it takes from.

/// The inputs and the output of a connector. Streams are numbers here.
pub type Ends<'a> = (&'a [usize], usize);

/// The connectors between so many streams in an order in which values flow, by their places. Those that stand in a
/// circle, or behind one, are left out, and those that take from nothing.
#[must_use]
pub fn in_order(streams: usize, connectors: &[Ends]) -> Vec<usize> {
    let (mut takers, mut open) = (vec![Vec::new(); streams], vec![0_usize; streams]);
    for (at, (inputs, output)) in connectors.iter().enumerate().filter(|(_, (inputs, _))| !inputs.is_empty()) {
        open[*output] += 1;
        inputs.iter().for_each(|input| takers[*input].push(at));
    }
    let mut missing: Vec<usize> = connectors.iter().map(|(inputs, _)| inputs.len()).collect();
    let mut ready: Vec<usize> = (0..streams).rev().filter(|stream| open[*stream] == 0).collect();
    let mut order = Vec::with_capacity(connectors.len());
    while let Some(stream) = ready.pop() {
        for &at in &takers[stream] {
            missing[at] -= 1;
            if missing[at] == 0 {
                order.push(at);
                let output = connectors[at].1;
                open[output] -= 1;
                if open[output] == 0 {
                    ready.push(output);
                }
            }
        }
    }
    order
}

/// Returns the number of connectors on the longest way to each stream; none for the streams in a circle or behind one.
#[must_use]
pub fn ranks(streams: usize, connectors: &[Ends]) -> Vec<Option<usize>> {
    let (mut ranks, mut open) = (vec![0_usize; streams], vec![0_usize; streams]);
    connectors.iter().filter(|(inputs, _)| !inputs.is_empty()).for_each(|(_, output)| open[*output] += 1);
    for (inputs, output) in in_order(streams, connectors).into_iter().map(|at| connectors[at]) {
        let longest = inputs.iter().map(|input| ranks[*input] + 1).max().unwrap_or_default();
        ranks[output] = ranks[output].max(longest);
        open[output] -= 1;
    }
    ranks.into_iter().zip(open).map(|(rank, open)| (open == 0).then_some(rank)).collect()
}

/// A connector that stands in a circle, if one does: going up from the first that waits for a circle comes to it.
#[must_use]
pub fn in_circle(streams: usize, connectors: &[Ends]) -> Option<usize> {
    let ranks = ranks(streams, connectors);
    let waits = |at: &usize| connectors[*at].0.iter().any(|input| ranks[*input].is_none());
    let mut into = vec![None; streams];
    for at in (0..connectors.len()).rev().filter(waits) {
        into[connectors[at].1] = Some(at);
    }
    let (mut seen, mut at) = (vec![false; connectors.len()], (0..connectors.len()).find(waits)?);
    while !std::mem::replace(&mut seen[at], true) {
        at = connectors[at].0.iter().filter_map(|input| into[*input]).min()?;
    }
    Some(at)
}

#[cfg(test)]
mod tests {
    use super::{in_circle, in_order, ranks};

    #[test]
    fn each_comes_after_those_that_it_takes_from() {
        let connectors: [(&[usize], usize); 4] = [(&[2, 0], 3), (&[1], 2), (&[0], 1), (&[], 4)];
        assert_eq!(in_order(5, &connectors), [2, 1, 0]);
        assert_eq!(ranks(5, &connectors), [Some(0), Some(1), Some(2), Some(3), Some(0)]);
        assert_eq!(in_circle(5, &connectors), None);
    }

    #[test]
    fn a_circle_is_found_from_behind_it() {
        let connectors: [(&[usize], usize); 4] = [(&[3], 4), (&[0, 2], 1), (&[1], 2), (&[2], 3)];
        assert_eq!(in_order(5, &connectors), Vec::<usize>::new());
        assert_eq!(ranks(5, &connectors), [Some(0), None, None, None, None]);
        assert!(in_circle(5, &connectors).is_some_and(|at| at == 1 || at == 2));
        assert_eq!(in_circle(1, &[(&[0], 0)]), Some(0));
    }
}
