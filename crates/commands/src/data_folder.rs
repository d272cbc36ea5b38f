//! Where what is kept beside a store is: recordings, robots and orders.

use crate::failure::Failure;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The folder in the usual one that has a folder for each store elsewhere.
const STORES: &str = "stores";
/// The longest readable part of such a folder's name, in letters.
const NAME_MAX_LETTERS: usize = 60;

/// The folder of what is kept beside a store; none if nobody said one and there is no home.
///
/// # Errors
/// The usual folder is needed, and is said in a way that means another one from every place.
pub(crate) fn kept_in(store: Option<&str>, data: Option<&Path>) -> Result<Option<PathBuf>, Failure> {
    match data_folder(store, data, None) {
        Some(folder) => Ok(Some(folder)),
        None => Ok(data_folder(store, data, usual_data()?.as_deref())),
    }
}

/// The address of the store: the one that was given, or a folder.
pub(crate) fn store_url(store: Option<String>, data: Option<PathBuf>) -> Result<String, Failure> {
    if let Some(url) = store {
        return Ok(url);
    }
    let folder = data.map_or_else(usual_data, |data| Ok(Some(data)))?;
    folder.map(|folder| folder.display().to_string()).ok_or_else(no_home)
}

/// Nobody said where the data is, and there is no home folder.
pub(crate) fn no_home() -> Failure {
    Failure::of("There is no home folder. Say where the data is with --data DIR.")
}

/// The folder that is taken if none is said.
fn usual_data() -> Result<Option<PathBuf>, Failure> {
    usual(std::env::var_os("XDG_DATA_HOME"), std::env::var_os("HOME"))
}

/// Refuses a folder for what programs of this user remember (keys of running servers, the console's history) that would be
/// another one from every place from which rrp is started.
///
/// # Errors
/// `XDG_STATE_HOME` is a relative path.
pub(crate) fn state_is_whole() -> Result<(), Failure> {
    match std::env::var_os("XDG_STATE_HOME").filter(|folder| !folder.is_empty()).map(PathBuf::from) {
        Some(folder) if !folder.is_absolute() => Err(relative("XDG_STATE_HOME", &folder, "unset it")),
        Some(_) | None => Ok(()),
    }
}

/// From both variables. A relative path would be another folder from every place from which rrp is started.
fn usual(xdg: Option<OsString>, home: Option<OsString>) -> Result<Option<PathBuf>, Failure> {
    let xdg = xdg.filter(|folder| !folder.is_empty()).map(|folder| ("XDG_DATA_HOME", PathBuf::from(folder), "rrp"));
    let home = || home.map(|folder| ("HOME", PathBuf::from(folder), ".local/share/rrp"));
    match xdg.or_else(home) {
        Some((_, folder, below)) if folder.is_absolute() => Ok(Some(folder.join(below))),
        Some((name, folder, _)) => Err(relative(name, &folder, "say where the data is with --data DIR")),
        None => Ok(None),
    }
}

/// A variable that names no whole path, and what to do instead of setting it to one.
fn relative(name: &str, folder: &Path, instead: &str) -> Failure {
    if folder.as_os_str().is_empty() {
        let mut letters = instead.chars();
        let instead = letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect::<String>();
        return Failure::of(format!("{name} is empty. {instead}, or set {name} to your folder."));
    }
    Failure::of(format!(
        "{name} is “{}”, which is no whole path, as it does not begin with /. Set it to one, or {instead}.",
        folder.display()
    ))
}

/// The folder that was said; else that of the embedded store; else, for a store elsewhere, one of its own in the usual
/// folder, so that servers of different stores never share one.
fn data_folder(store: Option<&str>, data: Option<&Path>, usual: Option<&Path>) -> Option<PathBuf> {
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
    use super::{data_folder, usual};
    use std::path::{Path, PathBuf};

    const USUAL: &str = "/home/aiko/.local/share/rrp";

    fn of(store: Option<&str>, data: Option<&str>) -> PathBuf {
        data_folder(store, data.map(Path::new), Some(Path::new(USUAL))).unwrap()
    }

    #[test]
    fn the_usual_folder_is_the_same_from_every_place() {
        let of = |xdg: Option<&str>, home: Option<&str>| {
            let folder = usual(xdg.map(Into::into), home.map(Into::into));
            folder.map(|folder| folder.unwrap_or_default().display().to_string()).map_err(|why| why.to_string())
        };
        let table = [
            (None, Some("/home/aiko"), Ok("/home/aiko/.local/share/rrp")),
            (Some("/data"), Some("/home/aiko"), Ok("/data/rrp")),
            (Some(""), Some("/home/aiko"), Ok("/home/aiko/.local/share/rrp")),
            (None, None, Ok("")),
            (None, Some(""), Err("HOME is empty. Say where the data is with --data DIR, or set HOME to your folder.")),
            (
                Some("share"),
                Some("/home/aiko"),
                Err(
                    "XDG_DATA_HOME is “share”, which is no whole path, as it does not begin with /. Set it to one, or say \
                     where the data is with --data DIR.",
                ),
            ),
        ];
        for (xdg, home, folder) in table {
            assert_eq!(of(xdg, home), folder.map(str::to_owned).map_err(str::to_owned), "{xdg:?} {home:?}");
        }
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
