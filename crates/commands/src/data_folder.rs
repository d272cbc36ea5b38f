//! Where what is kept beside a store is: recordings, robots and orders.

use std::path::{Path, PathBuf};

/// The folder in the usual one that has a folder for each store elsewhere.
const STORES: &str = "stores";
/// The longest readable part of such a folder's name, in letters.
const NAME_MAX_LETTERS: usize = 60;

/// The folder that was said; else that of the embedded store; else, for a store elsewhere, one of its own in the usual
/// folder, so that servers of different stores never share one.
pub(crate) fn data_folder(store: Option<&str>, data: Option<&Path>, usual: Option<&Path>) -> Option<PathBuf> {
    let own = || {
        let Some(url) = store else { return usual.map(Path::to_owned) };
        match store::folder_of(url) {
            Some(folder) if !url.starts_with("files:") => Some(folder.to_owned()),
            _ => usual.map(|usual| usual.join(STORES).join(name_of(url))),
        }
    };
    data.map(Path::to_owned).or_else(own)
}

/// A name that only this address has: without user and password, the same wherever it is said from.
fn name_of(url: &str) -> String {
    let whole = match (store::folder_of(url), url.split_once("://")) {
        (Some(folder), _) => std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned()).display().to_string(),
        (None, Some((scheme, rest))) => {
            format!("{scheme}://{}", rest.rsplit_once('@').map_or(rest, |(_, place)| place))
        }
        (None, None) => url.to_owned(),
    };
    let plain = |letter: char| if letter.is_ascii_alphanumeric() || letter == '.' { letter } else { '-' };
    let words: String = whole.chars().map(plain).collect();
    let words = words.split('-').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-");
    let shown: String = words.chars().take(NAME_MAX_LETTERS).collect();
    let sum = whole.bytes().fold(0x811c_9dc5_u32, |sum, byte| (sum ^ u32::from(byte)).wrapping_mul(0x0100_0193));
    format!("{shown}-{sum:08x}")
}

#[cfg(test)]
mod tests {
    use super::data_folder;
    use std::path::{Path, PathBuf};

    const USUAL: &str = "/home/aiko/.local/share/rrp";

    fn of(store: Option<&str>, data: Option<&str>) -> PathBuf {
        data_folder(store, data.map(Path::new), Some(Path::new(USUAL))).unwrap()
    }

    #[test]
    fn what_is_said_counts() {
        assert_eq!(of(Some("bolt://db"), Some("/srv/rrp")), Path::new("/srv/rrp"));
        assert_eq!(of(Some("sqlite:/one"), Some("/two")), Path::new("/two"));
        assert_eq!(of(None, Some("/srv/rrp")), Path::new("/srv/rrp"));
    }

    #[test]
    fn the_embedded_store_keeps_everything_in_its_folder() {
        assert_eq!(of(None, None), Path::new(USUAL));
        assert_eq!([of(Some("sqlite:/one"), None), of(Some("/two"), None)], [Path::new("/one"), Path::new("/two")]);
    }

    #[test]
    fn every_store_elsewhere_has_a_folder_of_its_own() {
        let aiko = of(Some("bolt://aiko:secret@127.0.0.1:7687"), None);
        assert!(aiko.starts_with(Path::new(USUAL).join("stores")), "{}", aiko.display());
        assert!(!aiko.display().to_string().contains("secret"), "{}", aiko.display());
        assert_eq!(aiko, of(Some("bolt://ben@127.0.0.1:7687"), None), "it is the same store for everybody");
        let others = ["bolt://127.0.0.1:7688", "bolt://127.0.0.1:7687/lab", "files:/srv/a-b", "files:/srv/a/b"];
        for (at, url) in others.iter().enumerate() {
            let folder = of(Some(url), None);
            assert!(folder != aiko && others[..at].iter().all(|other| of(Some(other), None) != folder), "{url}");
        }
    }
}
