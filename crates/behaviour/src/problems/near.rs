//! Names that are nearly the same: what somebody meant who mistyped.

use std::cmp::Reverse;

/// Names longer than this are not compared.
const NAME_MAX_CHARS: usize = 40;
/// The most names that are compared.
const NAMES_MAX: usize = 1_000;

/// The name of these that is nearest to a mistyped one; none if all are too far away.
#[must_use]
pub fn near(name: &str, known: &[String]) -> Option<String> {
    let allowed = match name.chars().count() {
        0..=1 => return None,
        2..=4 => 1,
        _ => 2,
    };
    let away = |known: &&String| distance(&name.to_lowercase(), &known.to_lowercase());
    let near = known.iter().take(NAMES_MAX).filter(|known| away(known).is_some_and(|away| away <= allowed));
    near.min_by_key(|known| (away(known), Reverse(alike(name, known)), (*known).clone())).cloned()
}

/// Counts the letters that both have at their beginnings and at their ends.
fn alike(one: &str, other: &str) -> usize {
    let same = |(one, other): &(char, char)| one.eq_ignore_ascii_case(other);
    let begins = one.chars().zip(other.chars()).take_while(same).count();
    begins + one.chars().rev().zip(other.chars().rev()).take_while(same).count()
}

/// Counts the letters to put, take, change or exchange with their neighbour to get from one to the other.
fn distance(one: &str, other: &str) -> Option<usize> {
    let (one, other): (Vec<char>, Vec<char>) = (one.chars().collect(), other.chars().collect());
    if one.len().max(other.len()) > NAME_MAX_CHARS {
        return None;
    }
    let mut rows: [Vec<usize>; 2] = [Vec::new(), (0..=other.len()).collect()];
    for at in 1..=one.len() {
        let mut row = vec![at];
        for to in 1..=other.len() {
            let same = one[at - 1] == other[to - 1];
            let mut best = (rows[1][to] + 1).min(row[to - 1] + 1).min(rows[1][to - 1] + usize::from(!same));
            if at > 1 && to > 1 && one[at - 1] == other[to - 2] && one[at - 2] == other[to - 1] {
                best = best.min(rows[0][to - 2] + 1);
            }
            row.push(best);
        }
        rows.swap(0, 1);
        rows[1] = row;
    }
    rows[1].last().copied()
}

#[cfg(test)]
mod tests {
    use super::near;

    #[test]
    fn a_mistyped_name_finds_what_was_meant() {
        let known = ["ball", "distance", "ball_to_distance", "x"].map(str::to_owned);
        let meant = |name: &str| near(name, &known);
        assert_eq!(meant("bal").as_deref(), Some("ball"));
        assert_eq!(meant("blal").as_deref(), Some("ball"));
        assert_eq!(meant("Ball").as_deref(), Some("ball"));
        assert_eq!(meant("distnace").as_deref(), Some("distance"));
        assert_eq!(meant("ball_to_distanc").as_deref(), Some("ball_to_distance"));
        assert_eq!(near("siin", &["sign", "sin"].map(str::to_owned)).as_deref(), Some("sin"));
        assert_eq!([meant("head"), meant("y"), meant(""), meant(&"a".repeat(9_000))], [const { None }; 4]);
    }
}
