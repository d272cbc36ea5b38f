//! Names with numbers, for when the wanted name is taken.

/// A name as it is wanted, then with the numbers from 2, each after `between`: `Ball`, `Ball 2`, `Ball 3` and so on.
pub fn numbered(wanted: &str, between: &str) -> impl Iterator<Item = String> {
    let more = (2_u64..).map(move |number| format!("{wanted}{between}{number}"));
    std::iter::once(wanted.to_owned()).chain(more)
}

#[cfg(test)]
mod tests {
    use super::numbered;

    #[test]
    fn the_name_itself_comes_first() {
        assert_eq!(numbered("Ball", " ").take(3).collect::<Vec<_>>(), ["Ball", "Ball 2", "Ball 3"]);
        assert_eq!(numbered("far", "").find(|name| name != "far").as_deref(), Some("far2"));
    }
}
