//! The places in a row: everything stands as near to what it is connected with as its neighbours leave it.

/// Something in a row: how far it reaches to both sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowReach {
    pub(super) left: f64,
    pub(super) right: f64,
}

/// The places nearest to the wanted ones at which nothing meets its neighbour, in this order. (Least squares under distances
/// that are kept is isotonic regression: neighbours that push each other become one block around the mean of what they want.)
pub(super) fn apart(wanted: &[f64], reaches: &[RowReach], gap: f64) -> Vec<f64> {
    let mut offset = 0.0;
    let mut offsets = Vec::with_capacity(wanted.len());
    for (at, reach) in reaches.iter().enumerate() {
        if at > 0 {
            offset += reaches[at - 1].right + gap + reach.left;
        }
        offsets.push(offset);
    }
    // Of each block the mean, and how many are in it.
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for (wanted, offset) in wanted.iter().zip(&offsets) {
        let mut block = (wanted - offset, 1_usize);
        while let Some((mean, many)) = blocks.last().copied().filter(|(mean, _)| *mean > block.0) {
            blocks.pop();
            let all = many + block.1;
            block = ((mean * many as f64 + block.0 * block.1 as f64) / all as f64, all);
        }
        blocks.push(block);
    }
    let starts = blocks.into_iter().flat_map(|(mean, many)| std::iter::repeat_n(mean, many));
    starts.zip(offsets).map(|(start, offset)| start + offset).collect()
}

#[cfg(test)]
mod tests {
    use super::{RowReach, apart};

    #[test]
    fn what_has_room_stands_where_it_wants_and_the_rest_around_its_mean() {
        let reaches = [RowReach { left: 10.0, right: 10.0 }; 3];
        assert_eq!(apart(&[0.0, 100.0, 200.0], &reaches, 5.0), [0.0, 100.0, 200.0]);
        assert_eq!(apart(&[0.0, 0.0, 0.0], &reaches, 5.0), [-25.0, 0.0, 25.0]);
        assert_eq!(apart(&[50.0, 0.0, 200.0], &reaches, 5.0), [12.5, 37.5, 200.0], "in their order");
    }
}
