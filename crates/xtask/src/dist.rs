//! The folder of the finished page: written only where something changed, compressed beside each file.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

/// File contents by their name relative to a folder, with `/` between the parts.
pub(crate) type DistFiles = BTreeMap<String, Vec<u8>>;

/// Kinds that are compressed already.
const COMPRESSED: [&str; 15] =
    ["png", "jpg", "jpeg", "gif", "webp", "avif", "woff2", "mp3", "ogg", "opus", "mp4", "webm", "zip", "gz", "br"];
/// The effort of brotli, up to 11: as hard as it can.
const QUALITY: i32 = 11;
/// A way to compress a content, by the ending of the file that it makes.
type Compression = (&'static str, fn(&[u8]) -> io::Result<Vec<u8>>);
const PRESSES: [Compression; 2] = [("br", |content| compression::brotli(content, QUALITY)), ("gz", compression::gzip)];

/// The beginnings of the names of files that are loaded later.
pub(crate) const PIECES: [&str; 4] = ["later-", "operate-", "past-", "common-"];

/// True if a file of the page is one that is loaded later.
pub(crate) fn is_later(name: &str) -> bool {
    PIECES.iter().any(|piece| name.starts_with(piece))
}

/// Reads every file below `folder`; a folder that is not there holds none.
pub(crate) fn read(folder: &Path) -> Result<DistFiles, String> {
    let mut files = DistFiles::new();
    for (name, path) in walk(folder)? {
        let content = fs::read(&path).map_err(|error| trouble(&path, "read", &error))?;
        files.insert(name, content);
    }
    Ok(files)
}

/// The names and lengths in bytes of every file below `folder`.
pub(crate) fn listing(folder: &Path) -> Result<BTreeMap<String, u64>, String> {
    let length = |(name, path): (String, PathBuf)| {
        let found = fs::metadata(&path).map_err(|error| trouble(&path, "read", &error))?;
        Ok((name, found.len()))
    };
    walk(folder)?.into_iter().map(length).collect()
}

/// Makes `folder` hold exactly `files` and, if asked, `.br` and `.gz` beside them.
/// Answers how many of `files` were new or different.
pub(crate) fn write(folder: &Path, files: &DistFiles, compressed: bool) -> Result<usize, String> {
    let same = |name: &str, content: &[u8]| fs::read(folder.join(name)).is_ok_and(|old| old == *content);
    let changed: BTreeSet<&String> =
        files.iter().filter(|(name, content)| !same(name, content)).map(|(name, _)| name).collect();
    let mut kept: Vec<String> = Vec::new();
    if compressed {
        let wanted: Vec<(&String, &[u8], &Compression)> = files
            .iter()
            .filter(|(name, _)| !is_compressed(name))
            .flat_map(|(name, content)| PRESSES.iter().map(move |press| (name, content.as_slice(), press)))
            .collect();
        let there = |name: &String, kind: &str| !changed.contains(name) && folder.join(beside(name, kind)).is_file();
        let (ready, missing): (Vec<_>, Vec<_>) = wanted.into_iter().partition(|(name, _, press)| there(name, press.0));
        kept.extend(ready.into_iter().map(|(name, _, press)| beside(name, press.0)));
        for (name, smaller) in press_all(missing)? {
            replace(&folder.join(&name), &smaller)?;
            kept.push(name);
        }
    }
    // Last, so that a run cut short finds these files different and compresses them again.
    for (name, content) in files {
        if changed.contains(name) {
            replace(&folder.join(name), content)?;
        }
        kept.push(name.clone());
    }
    remove_others(folder, &kept)?;
    Ok(changed.len())
}

fn beside(name: &str, kind: &str) -> String {
    format!("{name}.{kind}")
}

/// Compresses all that waits, by the names of the compressed files, and leaves out what would not be smaller; the
/// longest first, on all cores.
fn press_all(mut waiting: Vec<(&String, &[u8], &Compression)>) -> Result<DistFiles, String> {
    waiting.sort_by_key(|(_, content, _)| content.len());
    let cores = thread::available_parallelism().map_or(1, usize::from).min(waiting.len());
    let (waiting, done) = (Mutex::new(waiting), Mutex::new(Ok(DistFiles::new())));
    let next = || lock(&waiting).pop();
    let work = || {
        while let Some((name, content, (kind, press))) = next() {
            let pressed = press(content).map_err(|error| format!("{name} cannot be compressed: {error}."));
            let mut done = lock(&done);
            match (pressed, done.as_mut()) {
                (Ok(smaller), Ok(files)) if smaller.len() < content.len() => {
                    files.insert(beside(name, kind), smaller);
                }
                (Err(sentence), Ok(_)) => *done = Err(sentence),
                _ => {}
            }
        }
    };
    thread::scope(|threads| (0..cores).for_each(|_| drop(threads.spawn(work))));
    done.into_inner().unwrap_or_else(PoisonError::into_inner)
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The size of a page in a few words: as it is and as it travels, first and later.
pub(crate) fn sizes(folder: &Path) -> Result<String, String> {
    let files = listing(folder)?;
    let sum = |wanted: &dyn Fn(&str) -> bool| -> u64 { files.iter().filter(|f| wanted(f.0)).map(|f| f.1).sum() };
    let whole = sum(&|name| !name.ends_with(".br") && !name.ends_with(".gz"));
    let code = sum(&|name| name.ends_with(".wasm"));
    // Words are fetched for one language at a time, and to understand what is typed.
    let is_words = |name: &str| name.ends_with(".txt.br");
    let first = sum(&|name| name.ends_with(".br") && !is_later(name) && !is_words(name));
    let later = sum(&|name| name.ends_with(".br") && is_later(name));
    let words = sum(&is_words);
    let kb = |bytes: u64| bytes / 1_000;
    let travels = if first > 0 {
        format!(
            "; with brotli the first load is {} KB, {} KB come later, and {} KB are words of single languages",
            kb(first),
            kb(later),
            kb(words)
        )
    } else {
        String::new()
    };
    Ok(format!("{} KB, of these {} KB wasm{travels}", kb(whole), kb(code)))
}

fn is_compressed(name: &str) -> bool {
    let kind = Path::new(name).extension().and_then(|kind| kind.to_str());
    kind.is_some_and(|kind| COMPRESSED.contains(&kind.to_ascii_lowercase().as_str()))
}

/// Puts `content` in place at once: a server that reads meanwhile sees the old file or the new one.
fn replace(path: &Path, content: &[u8]) -> Result<(), String> {
    if fs::read(path).is_ok_and(|old| old == content) {
        return Ok(());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let temporary = folder.join(".new");
    let done = fs::create_dir_all(folder)
        .and_then(|()| fs::write(&temporary, content))
        .and_then(|()| fs::rename(&temporary, path));
    done.map_err(|error| trouble(path, "written", &error))
}

/// Removes every file below `folder` that is not in `kept`, and then folders left empty.
fn remove_others(folder: &Path, kept: &[String]) -> Result<(), String> {
    for (name, path) in walk(folder)? {
        if !kept.contains(&name) {
            fs::remove_file(&path).map_err(|error| trouble(&path, "removed", &error))?;
            remove_empty(path.parent(), folder);
        }
    }
    Ok(())
}

/// Removes `empty` and its parents below `top`, up to the first that still holds something.
fn remove_empty(empty: Option<&Path>, top: &Path) {
    for folder in empty.into_iter().flat_map(Path::ancestors).take_while(|folder| *folder != top) {
        if fs::remove_dir(folder).is_err() {
            return;
        }
    }
}

/// Every file below `top` in the order of names.
fn walk(top: &Path) -> Result<Vec<(String, PathBuf)>, String> {
    let mut found = Vec::new();
    let mut waiting = vec![(String::new(), top.to_path_buf())];
    while let Some((prefix, folder)) = waiting.pop() {
        if !folder.is_dir() {
            continue;
        }
        for entry in fs::read_dir(&folder).map_err(|error| trouble(&folder, "read", &error))? {
            let path = entry.map_err(|error| trouble(&folder, "read", &error))?.path();
            let Some(last) = path.file_name().and_then(|name| name.to_str()) else {
                return Err(format!("{} has a name that is not text.", path.display()));
            };
            let name = format!("{prefix}{last}");
            if path.is_dir() {
                waiting.push((format!("{name}/"), path));
            } else {
                found.push((name, path));
            }
        }
    }
    found.sort();
    Ok(found)
}

fn trouble(path: &Path, deed: &str, error: &io::Error) -> String {
    format!("{} cannot be {deed}: {error}.", path.display())
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    type Tested = Result<(), Box<dyn std::error::Error>>;

    fn page(files: &[(&str, &str)]) -> DistFiles {
        files.iter().map(|(name, text)| ((*name).to_owned(), text.repeat(100).into_bytes())).collect()
    }

    fn names(folder: &Path) -> Vec<String> {
        listing(folder).unwrap_or_default().into_keys().collect()
    }

    #[test]
    fn each_file_gets_its_compressed_forms_and_a_picture_none() -> Tested {
        let folder = tempfile::tempdir()?;
        write(folder.path(), &page(&[("a.css", "a {}"), ("icons/b.png", "b")]), true)?;
        assert_eq!(names(folder.path()), ["a.css", "a.css.br", "a.css.gz", "icons/b.png"]);
        let mut text = String::new();
        let small = fs::read(folder.path().join("a.css.br"))?;
        brotli::Decompressor::new(small.as_slice(), 4_096).read_to_string(&mut text)?;
        assert_eq!(text, "a {}".repeat(100));
        Ok(())
    }

    #[test]
    fn only_what_changed_is_written() -> Tested {
        let folder = tempfile::tempdir()?;
        let time = |name: &str| fs::metadata(folder.path().join(name))?.modified();
        write(folder.path(), &page(&[("a.css", "a {}"), ("b.css", "b {}")]), true)?;
        let before = (time("a.css")?, time("a.css.br")?, time("b.css")?);
        let changed = write(folder.path(), &page(&[("a.css", "a {}"), ("b.css", "c {}")]), true)?;
        assert_eq!(changed, 1);
        assert_eq!((time("a.css")?, time("a.css.br")?), (before.0, before.1));
        assert!(time("b.css")? > before.2);
        Ok(())
    }

    #[test]
    fn what_is_stale_is_removed_with_its_folder() -> Tested {
        let folder = tempfile::tempdir()?;
        write(folder.path(), &page(&[("a.css", "a {}"), ("deep/er/b.css", "b {}")]), true)?;
        write(folder.path(), &page(&[("a.css", "a {}")]), false)?;
        assert_eq!(names(folder.path()), ["a.css"]);
        assert!(!folder.path().join("deep").exists());
        Ok(())
    }
}
