//! The row of each thing in its part.

/// A row for each of so many: below all that lead to it. Where values flow in a circle, the first of it begins.
pub(super) fn rows(count: usize, edges: &[(usize, usize)]) -> Vec<usize> {
    let mut waits = vec![0_usize; count];
    let mut below: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (from, to) in edges {
        waits[*to] += 1;
        below[*from].push(*to);
    }
    let mut rows = vec![0_usize; count];
    let mut done = vec![false; count];
    let mut ready: Vec<usize> = (0..count).filter(|at| waits[*at] == 0).collect();
    let mut begins = 0;
    loop {
        while let Some(at) = ready.pop() {
            done[at] = true;
            for next in &below[at] {
                waits[*next] = waits[*next].saturating_sub(1);
                if !done[*next] {
                    rows[*next] = rows[*next].max(rows[at] + 1);
                    if waits[*next] == 0 {
                        ready.push(*next);
                    }
                }
            }
        }
        while begins < count && done[begins] {
            begins += 1;
        }
        if begins == count {
            return rows;
        }
        waits[begins] = 0;
        ready.push(begins);
    }
}
