//! The calls among helpers: an order in which those that are called come first, and those that call themselves.

/// All of them, given for each by number those that it calls: each after those that it calls, also through others; in a circle, in some order.
pub(crate) fn called_first(calls: &[Vec<usize>]) -> Vec<usize> {
    let (mut seen, mut order) = (vec![false; calls.len()], Vec::with_capacity(calls.len()));
    for start in 0..calls.len() {
        walk(calls, start, &mut seen, &mut order);
    }
    order
}

/// Those that call themselves, also through others (by S. R. Kosaraju: who reaches each other both ways).
pub(crate) fn circular(calls: &[Vec<usize>]) -> Vec<bool> {
    let mut callers = vec![Vec::new(); calls.len()];
    for (at, called) in calls.iter().enumerate() {
        called.iter().for_each(|called| callers[*called].push(at));
    }
    let mut circular: Vec<bool> = calls.iter().enumerate().map(|(at, called)| called.contains(&at)).collect();
    let mut seen = vec![false; calls.len()];
    for start in called_first(calls).into_iter().rev() {
        let mut circle = Vec::new();
        walk(&callers, start, &mut seen, &mut circle);
        if circle.len() > 1 {
            circle.into_iter().for_each(|at| circular[at] = true);
        }
    }
    circular
}

/// Depth first from `start`, past those that were seen: each is put down after those that it leads to. A stack of its
/// own, since chains may be longer than the machine's.
fn walk(links: &[Vec<usize>], start: usize, seen: &mut [bool], order: &mut Vec<usize>) {
    if std::mem::replace(&mut seen[start], true) {
        return;
    }
    let mut path = vec![(start, 0)];
    while let Some((at, next)) = path.last_mut() {
        let Some(&link) = links[*at].get(*next) else {
            order.push(*at);
            path.pop();
            continue;
        };
        *next += 1;
        if !std::mem::replace(&mut seen[link], true) {
            path.push((link, 0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{called_first, circular};

    #[test]
    fn what_is_called_comes_first_however_long_the_chain() {
        let chain: Vec<Vec<usize>> = (1..100_000).map(|next| vec![next]).chain([Vec::new()]).collect();
        assert!(called_first(&chain).into_iter().eq((0..100_000).rev()));
        assert!(!circular(&chain).contains(&true));
        assert_eq!(called_first(&[vec![1, 2], vec![2], vec![]]), [2, 1, 0]);
    }

    #[test]
    fn only_those_in_a_circle_call_themselves() {
        // 0 leads to the circle of 1 and 2, from there on to 3, which leads to 4, which calls itself, and on to 5.
        let calls = vec![vec![1], vec![2], vec![1, 3], vec![4], vec![4, 5], vec![]];
        assert_eq!(circular(&calls), [false, true, true, false, true, false]);
    }
}
